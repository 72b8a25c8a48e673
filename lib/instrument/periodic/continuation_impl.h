/* continuation_impl.h - what the files of followed orbits share.
 *
 *     continuation.c          the call, the two directions, the branches that are switched to
 *     continuation_curve.c    the curve F(u, value) = 0: one evaluation, the corrector, one step; what happens between
 *                             two points, and exactly where; what branches off
 */
#ifndef ISO_INSTRUMENT_PERIODIC_CONTINUATION_IMPL_H
#define ISO_INSTRUMENT_PERIODIC_CONTINUATION_IMPL_H

#include "instrument/periodic/continuation.h"
#include "instrument/periodic/periodic_impl.h"

/* A family of orbits: one line, one period, one parameter. */
typedef struct iso_continuation {
    iso_context *ctx;
    iso_continuation_options options;
    iso_params base;
    double level; /* of base, see study/level.h */
    int axis;     /* of the section, which must stay */
    int line, period;
    double width; /* of the range */
} iso_continuation;

/* A point of the curve. Coordinates are u and v = value/width. */
typedef struct iso_continuation_point {
    double u, v, value;
    double z[2];    /* the first point on the section: l, x                                */
    double off;     /* F                                                                   */
    double by_v;    /* its slope by v                                                      */
    double D[2][2]; /* see iso_periodic_shot; D_10 is the slope of F by u                  */
    double trace;
    double tangent[2]; /* (du, dv), of length 1                                               */
} iso_continuation_point;

/* The parameters at a value, and H there for eps = 1. False: there are none, or their section has another axis. */
bool iso_continuation_params(const iso_continuation *f, double value, iso_params *p, double *energy);

/* F and all slopes; by_v only if asked. False: it failed. */
bool iso_continuation_evaluate(const iso_continuation *f, double u, double v, bool slopes,
                               iso_continuation_point *at);

/* From `at` by `ds` along its tangent: predictor and corrector. *steps: of the corrector. */
bool iso_continuation_step(const iso_continuation *f, const iso_continuation_point *at, double ds,
                           iso_continuation_point *to, int *steps);

/* Sets the tangent, so that it goes on like `like` (NULL: v grows). */
void iso_continuation_turn(iso_continuation_point *at, const double like[2]);

iso_branch_point iso_continuation_read(const iso_continuation_point *at, double arc);

/* Adds the events between a and b, ds apart. */
iso_status iso_continuation_events(const iso_continuation *f, iso_branch *b, const iso_continuation_point *a,
                                   const iso_continuation_point *to, double ds, double arc);
static inline iso_status iso_continuation_add_event(const iso_continuation *f, iso_branch *b,
                                                    const iso_branch_event *e)
{
    return iso_periodic_append(f->ctx, &b->event, &b->events, e, sizeof *e);
}

/* The collision beyond a point near the end of the line; false: there is none near. */
bool iso_continuation_collision(const iso_continuation *f, const iso_continuation_point *a,
                                const iso_continuation_point *b, iso_branch_event *e);

/* Whether orbits of twice the period can branch off there: the trace is -2. */
static inline bool iso_continuation_doubles(iso_branch_kind kind)
{
    return kind == ISO_BRANCH_DOUBLING || kind == ISO_BRANCH_TOUCH || kind == ISO_BRANCH_UNDECIDED;
}

/* Looks for an orbit that branches off at an event: its family, and its u and value in at. *found: there is one. */
iso_status iso_continuation_switch(const iso_continuation *f, const iso_branch_event *e, iso_continuation *beside,
                                   double at[2], bool *found);

#endif
