/* periodic_study_impl.h - what the study of periodic orbits is asked, and what it finds for a chart. */
#ifndef ISO_INSTRUMENT_PERIODIC_PERIODIC_STUDY_IMPL_H
#define ISO_INSTRUMENT_PERIODIC_PERIODIC_STUDY_IMPL_H

#include "instrument/periodic/continuation.h"
#include "instrument/periodic/stability_chart.h"
#include "study/options_impl.h"

typedef struct iso_periodic_request {
    iso_periodic_options how;
    /* NULL: not given. */
    const char *follow;    /* "k=0.4:0.6"                                                       */
    const char *chart;     /* "J2", "J3=1:4", "level=-1:1": which one varies, and where         */
    const char *k, *level; /* of the chart: "A:B", -3:3 if it is not given; the scene's level if not */
    int steps;             /* of the chart                                                      */
    double orbit;          /* to follow, from 1; 0: all with a symmetry                         */
    bool branches;
} iso_periodic_request;

/* What the study finds for a chart. */
typedef struct iso_chart_found {
    iso_stability_options how;
    double level; /* NaN: it varies */
    iso_record *grid, *borders;
} iso_chart_found;

extern const iso_field iso_chart_fields[];

/* Its text, and the lines of its table (periodic_print.c). */
void iso_periodic_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);
iso_status iso_periodic_describe(iso_context *ctx, const iso_scene *scene, const void *options,
                                 iso_study_result *result);

#endif
