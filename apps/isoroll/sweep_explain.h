/* sweep_explain.h - `isoroll explain` for a sweep. */
#ifndef ISOROLL_SWEEP_EXPLAIN_H
#define ISOROLL_SWEEP_EXPLAIN_H

#include "report.h"

/* Whether the file is a sweep rather than a scene. False for standard input, which can be read only once. */
bool is_sweep(const char *path);

/* Tells what a sweep computes and how long that takes. Gives the exit status. */
int explain_sweep(iso_context *ctx, const char *path);

#endif
