/* periodic_chart.h - `isoroll periodic --chart`: where the rotations are stable, in the plane of k and one moment. */
#ifndef ISOROLL_PERIODIC_CHART_H
#define ISOROLL_PERIODIC_CHART_H

#include <stdbool.h>

#include "isoroll.h"

typedef struct periodic_chart {
    const char *moment; /* "J2", "J3=1:4": which one varies, and where */
    const char *k;      /* "A:B"; NULL: -3:3                           */
    double steps;
    const char *output, *plot; /* NULL: not given */
    bool json;
} periodic_chart;

/* "A:B", A < B. False: it is none. */
bool read_range(const char *text, double range[2]);

/* Gives the exit status. */
int draw_chart(iso_context *ctx, const iso_scene *scene, const periodic_chart *c);

#endif
