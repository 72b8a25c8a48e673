/* sweep_plot.h - `isoroll plot` for the result of a sweep. */
#ifndef ISOROLL_SWEEP_PLOT_H
#define ISOROLL_SWEEP_PLOT_H

#include "report.h"

/* Draws a column (NULL: the first that is there of a list of usual ones) over the numbers that vary. Errors:
 * ISO_BAD_INPUT about a column that is not there, or a sweep that no picture shows. */
iso_status plot_sweep(iso_context *ctx, const char *path, const char *value, const char *output);

#endif
