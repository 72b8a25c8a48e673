/* periodic_follow.h - `isoroll periodic --follow`: orbits while k or a moment changes. */
#ifndef ISOROLL_PERIODIC_FOLLOW_H
#define ISOROLL_PERIODIC_FOLLOW_H

#include <stdbool.h>

#include "io/output.h"
#include "isoroll.h"
#include "study/periodic/periodic.h"

typedef struct periodic_follow {
    const char *range; /* "k=0.4:0.6"                     */
    double orbit;      /* from 1; 0: all with a symmetry  */
    int period;        /* the longest that was looked for */
    int threads;       /* 0: one for each processor      */
    bool branches, json;
    iso_output *rows; /* is closed here; NULL: none                  */
    bool alone;       /* rows go to standard output: no table there  */
    const char *plot; /* NULL: none                                  */
} periodic_follow;

/* Whether "k=0.4:0.6" can be followed from this scene. */
iso_status follow_check(iso_context *ctx, const iso_scene *scene, const char *range);

/* Gives the exit status. */
int follow_orbits(iso_context *ctx, const iso_scene *scene, const iso_periodic *found, const periodic_follow *how);

#endif
