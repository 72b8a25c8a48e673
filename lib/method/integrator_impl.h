/* integrator_impl.h - what a method sees of an integrator. */
#ifndef ISO_METHOD_INTEGRATOR_IMPL_H
#define ISO_METHOD_INTEGRATOR_IMPL_H

#include "base/sum_impl.h"
#include "method/method.h"

typedef struct iso_dense iso_dense;

/* A time as an unevaluated sum of two doubles. */
typedef struct iso_instant {
    double head, tail;
} iso_instant;

/* a + h without rounding, renormalised */
static inline iso_instant iso_instant_later(iso_instant a, double h)
{
    double lost;
    const double sum = iso_two_sum(a.head, h, &lost);
    const double tail = a.tail + lost, head = sum + tail;
    return (iso_instant){head, tail - (head - sum)};
}

/* t - a: exact but for the last bit */
static inline double iso_instant_since(iso_instant a, double t)
{
    return (t - a.head) - a.tail;
}

struct iso_integrator {
    iso_context *ctx;
    const iso_method *method;
    iso_model model;
    iso_method_options options;
    iso_statistics statistics;

    double y0[ISO_MAX_STATE]; /* the state at time 0                                                  */
    int direction;            /* of the steps: 1, -1, or 0 before the first                           */
    bool stopped;             /* by a failure: no further steps before the next start from 0           */
    bool resting;             /* the current step is one of a model at rest                            */
    bool called;              /* a call of the library has begun since the method last cleared this    */
    iso_instant left;         /* the current step runs from here ...                                  */
    double h;                 /* ... by this signed length                                            */
    double at_left[ISO_MAX_STATE], at_right[ISO_MAX_STATE];

    void *data;         /* the method's own                                                           */
    iso_dense *dense;   /* reaches times within a step; NULL where the method does                    */
};

/* The contract of iso_method.step: y holds the state at the end of the last step, after `start` that at time 0.
 * The method advances y by one step in it->direction, and gives the exact step length in *h, with the sign of the
 * direction. It chooses the length itself, or takes it->options.fixed_step where that is above 0 (if its row says
 * `fixed`). A step that cannot be taken returns iso_integrator_stopped(). Functions for the methods: */

/* y' = f(y), counted; false when a derivative is not finite. */
bool iso_integrator_rhs(iso_integrator *it, const double y[], double dy[]);

/* Projects y if the options want it, and notes the correction. */
void iso_integrator_project(iso_integrator *it, double y[]);

/* Records ISO_NUMERICAL in words: method, reason, last good time. */
iso_status iso_integrator_stopped(iso_integrator *it, const char *reason);

/* The largest rate at which a component changes, in units of its size. */
double iso_integrator_rate(iso_integrator *it, const double y[]);

/* A first step length for a method of the given order: a fraction of the time in which the state changes by its
 * own size, signed. */
double iso_integrator_first_step(iso_integrator *it, int order);

/* Whether steps can be held to a tolerance. Errors: ISO_BAD_ARGUMENT about "tolerance". */
iso_status iso_tolerance_check(iso_context *ctx, double tolerance);

/* Takes one step. */
iso_status iso_integrator_advance(iso_integrator *it);

/* Takes steps in `direction` until t lies within the current one; begins again from 0 when t lies behind it. With a
 * method that has `at`, the current step begins at t. */
iso_status iso_integrator_reach(iso_integrator *it, int direction, double t);

/* t minus the time of the step's left end: exact but for the last bit. */
double iso_integrator_since(const iso_integrator *it, double t);

/* The state at dt from the step's left end: an end of the step, or dense output. */
iso_status iso_integrator_within(iso_integrator *it, double dt, double y[]);

/* dense.c: from at_left by dt, |dt| <= |h|, at the integrator's tolerance. Created into it->dense. */
iso_status iso_dense_create(iso_integrator *it);
void iso_dense_free(iso_dense *dense);
iso_status iso_dense_at(iso_integrator *it, double dt, double y[]);

#endif
