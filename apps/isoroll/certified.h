/* certified.h - files of enclosures, which 'run --certify' writes and convert carries: lines of text. */
#ifndef ISOROLL_CERTIFIED_H
#define ISOROLL_CERTIFIED_H

#include "instrument/certify/certify_impl.h"
#include "io/output_impl.h"
#include "report.h"

/* `out` is opened by the first line: before it nothing is written. */
typedef struct certified_file {
    iso_context *ctx;
    const char *path;
    iso_output *out;
} certified_file;

/* A sink's line (data: a certified_file). */
iso_status certified_line(void *data, const char *text);

/* A sink's progress. */
void certified_progress(void *data, double part);

/* Says what went wrong and closes the file, which keeps its lines if keep. Gives the exit status. */
int certified_close(const certified_file *f, iso_status status, bool keep);

/* An option, and whether it was given. */
typedef struct certified_option {
    bool given;
    const char *name;
} certified_option;

/* Refuses the first one that was given, in a list that ends with a name NULL; why: in words. */
iso_status certified_refuse(iso_context *ctx, const certified_option list[], const char *why);

#endif
