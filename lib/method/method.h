/* method.h - integrators behind one table, and one contract for all of them.
 *
 *     iso_integrator *it;
 *     iso_integrator_create(ctx, iso_method_find("rk8pd"), &model, &(iso_method_options){.tolerance = 1e-12}, &it);
 *     iso_integrator_start(it, y0);            the state at time 0
 *     iso_integrator_at(it, 10, y);            the state at time 10, or at any other, in any order
 *     iso_integrator_free(it);
 *
 * Times are those of the model's independent clock. The contract:
 * - A method takes its own steps; what is asked between them is reached from the step's left end by the method itself
 *   where it can (`within`), else by a leap with GSL's rk8pd (bsimp for stiff models) at the same tolerance (13
 *   right-hand sides as a rule). So a state at time t depends on the method and the tolerance, never on which other
 *   times were asked.
 * - `tolerance` bounds the estimated error of one step in units of iso_model_size(): the largest component for
 *   GSL methods, the root mean square for SUNDIALS. Splittings keep one step in s, chosen by trial runs over the
 *   first two turns. The error of a long orbit is larger: it adds up.
 * - The elapsed time is the compensated sum of the steps taken, exact to 1e-30 relative: systems are autonomous, and
 *   the library's own uncompensated t += h would cost 1e-9 at t = 1000 (see SUNDIALS in the README).
 * - After each step the model's constraints and energy are restored where the method allows it (`projects`); the
 *   statistics hold the largest correction, because corrected integrals look perfect whatever the error.
 * - A method may know the state at any time without steps (`at`): then tolerance and max_steps mean nothing, only the
 *   search for events goes from part to part of the way.
 * - A failing call leaves the last good time and state to be read (iso_integrator_last). Times before it can still be
 *   asked; times behind it fail again.
 */
#ifndef ISO_METHOD_METHOD_H
#define ISO_METHOD_METHOD_H

#include "../model/model.h"

typedef struct iso_integrator iso_integrator;

#define ISO_LEAST_TOLERANCE 1e-15
#define ISO_MOST_TOLERANCE  0.1

typedef struct iso_method_options {
    double tolerance;  /* from ISO_LEAST_TOLERANCE to ISO_MOST_TOLERANCE                               */
    double fixed_step; /* > 0: steps of exactly this size without error control, to measure an order   */
    bool no_projection;
    double time_unit;  /* times in messages are multiplied by it; 0: 1                                 */
    long max_steps;    /* 0: no bound; else ISO_NUMERICAL when more are needed, from the start on      */
} iso_method_options;

typedef struct iso_statistics {
    long steps, rejected, rhs, jacobians; /* rhs includes the leaps to output times                    */
    long states;                          /* found without steps, by iso_method.at                     */
    double correction;                    /* largest relative correction by projection                 */
} iso_statistics;

typedef struct iso_method {
    const char *name, *family, *doc;
    int order;     /* of the solution that is carried on; 0: varies from step to step                  */
    bool implicit; /* solves with the Jacobian: for stiff models                                       */
    bool projects; /* restores constraints after each step                                             */
    bool fixed;    /* can take fixed steps                                                             */
    int variant;   /* which of its family                                                              */
    bool reference;           /* exact to the rounding of doubles at any tolerance, and slow             */
    bool own_equations;       /* its own form of the equations of motion, not the model's rhs            */
    const iso_system *system; /* the only one it serves; NULL: every model                              */

    /* Make and release the method's own data; begin at it->right; take one step, see integrator_impl.h. */
    iso_status (*create)(iso_integrator *it);
    iso_status (*start)(iso_integrator *it);
    iso_status (*step)(iso_integrator *it, double y[], double *h);
    /* The state at dt from the step's left end, |dt| < |h|, by the method's own; NULL: by a leap. */
    iso_status (*within)(iso_integrator *it, double dt, double y[]);
    /* The state at any time t but 0, without steps; NULL: by steps. With it `start` is called once, by
     * iso_integrator_start, and `step` only leads a search for events on. */
    iso_status (*at)(iso_integrator *it, double t, double y[]);
    void (*free)(iso_integrator *it);
} iso_method;

/* The registry, ended by NULL. */
extern const iso_method *const iso_methods[];

/* The method called `name`, or NULL. Upper and lower case, '-' and '_' are the same, the family may stand before
 * ("gsl-rk8pd", "cvode_adams"), and a beginning that fits only one method is enough ("dormand_prince"). */
const iso_method *iso_method_find(const char *name);

/* What "auto" means for a model: the cheapest method that is exact enough. `taylor`; `rk8pd` for (24) with |k| so small
 * that (max J/min J)^(1/|k|) > 1e10; for stiff models (iso_effects_stiffness) `bsimp`, or `bdf`. */
const iso_method *iso_method_auto(const iso_model *model);

/* Errors: ISO_BAD_ARGUMENT (no method, one that does not serve the model, tolerance out of range, fixed steps with a
 * method that has none, or not in this clock), ISO_NO_MEMORY. */
iso_status iso_integrator_create(iso_context *ctx, const iso_method *method, const iso_model *model,
                                 const iso_method_options *options, iso_integrator **integrator);
void iso_integrator_free(iso_integrator *it);

/* Begins anew with state y0 (model.dim numbers) at time 0. Errors: ISO_BAD_ARGUMENT when y0 is not finite, or there is
 * no such orbit for a method with `at`. */
iso_status iso_integrator_start(iso_integrator *it, const double y0[]);

/* The state at time t, before or after 0. Cheap when times run away from 0; turning back starts again from 0.
 * Errors: ISO_NUMERICAL with method, reason and the last good time; y is then not written. */
iso_status iso_integrator_at(iso_integrator *it, double t, double y[]);

/* An event: g(y) passes zero upwards (direction 1, in the sense of growing time), downwards (-1) or either way (0). */
typedef struct iso_event {
    double (*g)(const iso_model *model, const double y[], const void *data);
    const void *data;
    int direction;
} iso_event;

/* The first event after `from`, at or before `to`, going away from 0 (0 <= from <= to, or 0 >= from >= to). Found:
 * *found = true with its time and state, good to rounding (at the end of a step: to the error of a step). Two zeros
 * between which the state changes by less than a quarter of its size are found if g turns round just once between
 * them; a zero that g only touches is no event, nor is one at `from` itself, or within 1e-9 steps of it.
 * Errors: as iso_integrator_at, and ISO_NUMERICAL when g is not finite. */
iso_status iso_integrator_event(iso_integrator *it, const iso_event *event, double from, double to, bool *found,
                                double *t, double y[]);

/* The end of the last good step: time and state. */
void iso_integrator_last(const iso_integrator *it, double *t, double y[]);

iso_statistics iso_integrator_statistics(const iso_integrator *it);

#endif
