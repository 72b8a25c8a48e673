/* periodic_chart.h - `isoroll periodic --chart`: where the rotations are stable, in the plane of k and one moment,
 * or of k and the level. */
#ifndef ISOROLL_PERIODIC_CHART_H
#define ISOROLL_PERIODIC_CHART_H

#include <stdbool.h>

#include "io/output.h"
#include "isoroll.h"

typedef struct periodic_chart {
    const char *moment; /* "J2", "J3=1:4", "level=-1:1": which one varies, and where */
    const char *k;      /* "A:B"; NULL: -3:3                           */
    const char *level;  /* a number; NULL: the scene's                 */
    double steps;
    int threads;      /* 0: one for each processor */
    iso_output *rows; /* is closed there; NULL: none                   */
    bool alone;       /* rows go to standard output: no table there  */
    const char *plot; /* NULL: none                                  */
    bool json;
} periodic_chart;

/* "A:B", A < B. False: it is none. */
bool read_range(const char *text, double range[2]);

/* Gives the exit status. */
int draw_chart(iso_context *ctx, const iso_scene *scene, const periodic_chart *c);

#endif
