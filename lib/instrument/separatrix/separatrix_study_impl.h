/* separatrix_study_impl.h - what the study of the splitting is asked. */
#ifndef ISO_STUDY_SEPARATRIX_STUDY_IMPL_H
#define ISO_STUDY_SEPARATRIX_STUDY_IMPL_H

#include "instrument/separatrix/separatrix.h"
#include "study/options_impl.h"

/* Values of --k or --level: as they are typed (NULL: not given), and as numbers. */
typedef struct iso_separatrix_list {
    const char *name, *text;
    double *x;
    size_t count;
} iso_separatrix_list;

typedef struct iso_separatrix_request {
    iso_separatrix_list k, level;
    iso_separatrix_options how; /* digits and threads */
} iso_separatrix_request;

/* Its text, and the lines of its table (separatrix_print.c). */
void iso_separatrix_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);

iso_status iso_separatrix_describe(iso_context *ctx, const iso_scene *scene, const void *options,
                                   iso_study_result *result);

/* The row whose curves are best seen: |m| is about 1/30. NULL: there is none. */
const iso_separatrix_splitting *iso_separatrix_clearest(const iso_separatrix_table *s);

#endif
