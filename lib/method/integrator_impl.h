/* integrator_impl.h - an integrator (method.h): how it is asked, and what a method sees of it.
 *
 *     iso_integrator *it;
 *     iso_integrator_create(ctx, iso_method_find("rk8pd"), &model, &(iso_method_options){.tolerance = 1e-12}, &it);
 *     iso_integrator_start(it, y0);            the state at time 0
 *     iso_integrator_at(it, 10, y);            the state at time 10, or at any other, in any order
 *     iso_integrator_free(it);
 */
#ifndef ISO_METHOD_INTEGRATOR_IMPL_H
#define ISO_METHOD_INTEGRATOR_IMPL_H

#include "base/math_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"

typedef struct iso_gsl iso_gsl;

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

/* What is kept of the steps taken in one direction (past.c). */
typedef struct iso_past {
    char *places;       /* ends of steps */
    size_t count, room; /* places kept, and how many there is room for */
    long first, stride; /* place i is the end of step first + i stride, counted from 1 */
    long steps;         /* taken so far */
} iso_past;

struct iso_integrator {
    iso_context *ctx;
    const iso_method *method;
    iso_model model;
    iso_method_options options;
    iso_statistics statistics;

    double y0[ISO_MAX_STATE]; /* the state at time 0                                                  */
    int direction;            /* of the steps: 1, -1, or 0 before the first                           */
    double fast;              /* |omega| above which iso_model_speeds_up is asked                      */
    bool claims;              /* iso_model_has_claim: steps are looked into                            */
    const char *end;          /* why the current step is the last one; NULL: it is not                 */
    bool stopped;             /* by a failure: no further steps before the next start from 0           */
    bool resting;             /* the current step is one of a model at rest                            */
    bool called;              /* a call of the library has begun since the method last cleared this    */
    iso_instant left;         /* the current step runs from here ...                                  */
    double h;                 /* ... by this signed length                                            */
    double at_left[ISO_MAX_STATE], at_right[ISO_MAX_STATE];
    long number; /* of the current step, counted from 1; 0: none yet                      */

    iso_past past[2];     /* forwards, backwards                                        */
    int method_direction; /* where the method itself stands: it can go on from the      */
    long method_number;   /* right end of this step in this direction                   */
    size_t saved;         /* bytes of method.save, set by method.create                 */

    iso_inside *inside; /* expressions that the scene writes; NULL: none act                        */
    double longest;     /* of the next step, for methods that choose their steps; infinite: any     */
    void *data;         /* the method's own                                                           */
    iso_gsl *dense;     /* reaches times within a step; NULL where the method does                    */
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

/* Goes on to the next step: a new one, or one taken before. */
iso_status iso_integrator_advance(iso_integrator *it);

/* Goes to the step in `direction` in which t lies: from the current step, from the nearest place kept, or from 0.
 * With a method that has `at`, the current step begins at t. */
iso_status iso_integrator_reach(iso_integrator *it, int direction, double t);

/* t minus the time of the step's left end: exact but for the last bit. */
static inline double iso_integrator_since(const iso_integrator *it, double t)
{
    return iso_instant_since(it->left, t);
}

/* The state at dt from the step's left end: an end of the step, or dense output. */
iso_status iso_integrator_within(iso_integrator *it, double dt, double y[]);

static inline iso_past *iso_past_of(iso_integrator *it, int direction)
{
    return &it->past[direction < 0];
}

/* past.c: keeps the end of the current step, if there is memory; forgets all places. */
void iso_past_keep(iso_integrator *it);
void iso_past_forget(iso_integrator *it);

/* past.c: goes to the step in which t lies, or to one before it that is nearer than the current one. False: none is
 * kept, and the current step lies behind t. */
bool iso_past_recall(iso_integrator *it, int direction, double t);

/* past.c: goes to the next step without the method, where it is kept. */
bool iso_past_next(iso_integrator *it);

/* gsl.c: from at_left by dt, |dt| <= |h|, at the integrator's tolerance. Created into it->dense. */
iso_status iso_dense_create(iso_integrator *it);
void iso_dense_free(iso_gsl *dense);
iso_status iso_dense_at(iso_integrator *it, double dt, double y[]);

/* Errors: ISO_NO_MEMORY; ISO_BAD_ARGUMENT:
 * - about "method": there is none, or it does not serve the model, or its fixed steps are not those of this clock;
 *   the message says what is missing and what to take instead;
 * - about "tolerance": it is out of range;
 * - else: a fixed step that is negative or not finite, or a method that takes no fixed steps. */
iso_status iso_integrator_create(iso_context *ctx, const iso_method *method, const iso_model *model,
                                 const iso_method_options *options, iso_integrator **integrator);
void iso_integrator_free(iso_integrator *it);

/* Begins anew with state y0 (model.dim numbers) at time 0. Errors: ISO_BAD_ARGUMENT when y0 is not finite, or when a
 * method with `at` knows no orbit that begins there. */
iso_status iso_integrator_start(iso_integrator *it, const double y0[]);

/* The state at time t, before or after 0, the same bits in whatever order times are asked. Cheap when times run away
 * from 0, and where options.memory holds the ends of steps: a time passed before then takes one step, or a few, or
 * dense output. Else turning back starts again from 0. Steps that are taken again do not count.
 * Errors: ISO_NUMERICAL with method, reason and the last good time; y is then not written. */
iso_status iso_integrator_at(iso_integrator *it, double t, double y[]);

/* An event: g(y) passes zero upwards (direction 1, in the sense of growing time), downwards (-1) or either way
 * (0). */
typedef struct iso_event {
    double (*g)(const iso_model *model, const double y[], const void *data);
    const void *data;
    int direction;
} iso_event;

/* The first event after `from`, at or before `to`, going away from 0 (0 <= from <= to, or 0 >= from >= to). If there
 * is one, *found is true and t and y are its time and state, good to rounding (at the end of a step: to the error of
 * a step). Two zeros between which the state changes by less than a quarter of its size are found if g turns round
 * just once between them. No events are: a zero that g only touches, a zero at `from` itself or within 1e-9 steps of
 * it. Errors: as iso_integrator_at, and ISO_NUMERICAL when g is not finite. */
iso_status iso_integrator_event(iso_integrator *it, const iso_event *event, double from, double to, bool *found,
                                double *t, double y[]);

/* The end of the last good step: time and state. */
void iso_integrator_last(const iso_integrator *it, double *t, double y[]);

iso_statistics iso_integrator_statistics(const iso_integrator *it);

#endif
