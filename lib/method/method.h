/* method.h - integrators behind one table, and one contract for all of them.
 *
 *     iso_integrator *it;
 *     iso_integrator_create(ctx, iso_method_find("rk8pd"), &model, &(iso_method_options){.tolerance = 1e-12}, &it);
 *     iso_integrator_start(it, y0);            the state at time 0
 *     iso_integrator_at(it, 10, y);            the state at time 10, or at any other, in any order
 *     iso_integrator_free(it);
 *
 * Times are those of the model's independent clock. The contract:
 * - A method takes its own steps. A time between their ends is reached from the left end of the step: by the method
 *   itself where it can (`dense`), else by steps of GSL's rk8pd (bsimp for stiff models) at the same tolerance,
 *   as a rule 13 right-hand sides. So a state depends on the method and the tolerance, never on which other times
 *   were asked.
 * - `tolerance` bounds the estimated error of one step in units of iso_model_size(): of the largest component for
 *   GSL's methods, of the root mean square for SUNDIALS'. Splittings keep one step in s, which trial runs over the
 *   first two turns choose. The error of a long orbit is larger, because the errors of its steps add up.
 * - The elapsed time is the compensated sum of the steps taken, exact to 1e-30 relative. (The equations do not depend
 *   on the time. The t += h of the other libraries would cost 1e-9 at t = 1000.)
 * - After each step the constraints and the energy of the model are restored where the method allows it (`projects`).
 *   The statistics hold the largest correction, because restored integrals look perfect whatever the error is.
 * - A method may know the state at any time without steps (`at`). Then tolerance and max_steps mean nothing, and only
 *   a search for events takes steps.
 * - After a failing call the last good time and state can be read (iso_integrator_last). Times before it can still be
 *   asked; times behind it fail again.
 */
#ifndef ISO_METHOD_METHOD_H
#define ISO_METHOD_METHOD_H

#include "../base/api.h"
#include "../model/model.h"

ISO_C_BEGIN

typedef struct iso_integrator iso_integrator;

#define ISO_LEAST_TOLERANCE 1e-15
#define ISO_MOST_TOLERANCE  0.1

typedef struct iso_method_options {
    double tolerance;  /* from ISO_LEAST_TOLERANCE to ISO_MOST_TOLERANCE                               */
    double fixed_step; /* > 0: steps of exactly this size without error control, to measure an order   */
    bool no_projection;
    double time_unit;  /* times in messages are multiplied by it; 0: 1                                 */
    long max_steps;    /* 0: no bound; else ISO_NUMERICAL when more are needed, from the start on      */
    size_t memory;     /* bytes in which the ends of steps are kept, for each direction; 0: none is    */
} iso_method_options;

typedef struct iso_statistics {
    long steps, rejected, rhs, jacobians; /* rhs includes dense output                                 */
    long states;                          /* found without steps, by iso_method.at                     */
    double correction;                    /* largest relative correction by projection                 */
} iso_statistics;

/* How well a method suits a model, for "auto". */
typedef enum iso_suits {
    ISO_NEVER,      /* auto does not take it                     */
    ISO_IF_NEED_BE, /* only where nothing better serves          */
    ISO_WELL,       /* where the best does not serve             */
    ISO_BEST        /* the cheapest method that is exact enough  */
} iso_suits;

/* A row of the registry: everything that the library knows of a method. methods_impl.h tells how to add one. */
typedef struct iso_method {
    const char *name, *family, *doc;
    int variant;    /* which of its family                                                         */
    int order;      /* of the solution that is carried on; 0: varies from step to step             */
    bool projects;  /* restores constraints after each step                                        */
    bool fixed;     /* can take fixed steps                                                        */
    int digits;     /* of the numbers it computes with; 0: those of a double, ISO_DOUBLE_DIGITS    */
    bool reference; /* exact to the rounding of doubles at any tolerance, and slow                 */
    /* Place among the methods that confirm a reference (iso_method_witness), 1 is asked first; 0: none. */
    int witness;

    /* What it needs of a model. iso_integrator_create refuses a model that lacks it, in words. */
    bool implicit;            /* solves with the Jacobian, for stiff models: every effect must have its slopes  */
    bool own_equations;       /* has a form of its own of the equations of motion, and does not call model.rhs  */
    bool steps_in_s;          /* all its steps have one length in the clock s, whatever the model's clock is    */
    const iso_system *system; /* the only system it serves; NULL: every one                               */
    const char *system_why;   /* why only that one                                                        */

    /* How well it suits a model that it serves, for iso_method_auto; NULL: ISO_NEVER. */
    iso_suits (*suits)(const iso_model *model);

    /* Make and release the method's own data; begin at it->at_right; take one step, see integrator_impl.h. */
    iso_status (*create)(iso_integrator *it);
    iso_status (*start)(iso_integrator *it);
    iso_status (*step)(iso_integrator *it, double y[], double *h);
    /* The state at dt from the step's left end, |dt| < |h|, by the method itself; NULL: by dense.c. */
    iso_status (*dense)(iso_integrator *it, double dt, double y[]);
    /* The state at any time t but 0, without steps; NULL: by steps. With it iso_integrator_start calls `start` once,
     * and only a search for events calls `step`. */
    iso_status (*at)(iso_integrator *it, double t, double y[]);
    /* Writes all that the next step depends on, it->saved bytes (set by `create`); goes back to it, and gives the
     * state there in y. NULL: the method has a history that cannot be saved. See past.c. */
    void (*save)(const iso_integrator *it, void *to);
    void (*recall)(iso_integrator *it, const void *from, double y[]);
    void (*free)(iso_integrator *it);
} iso_method;

enum { ISO_DOUBLE_DIGITS = 16 };

/* The registry, ended by NULL. */
ISO_API extern const iso_method *const iso_methods[];

/* The method called `name`, or NULL. Upper and lower case, '-' and '_' are the same, the family may stand before
 * ("gsl-rk8pd", "cvode_adams"), and a beginning that fits only one method is enough ("dormand_prince"). */
ISO_API const iso_method *iso_method_find(const char *name);

/* The names that a scene can give its method: "auto", then those of the methods. NULL past the last. */
const char *iso_method_word(int i);

/* Whether a scene's method is one of them. Errors: ISO_BAD_ARGUMENT about "method", with the nearest name. */
iso_status iso_method_check(iso_context *ctx, const char *name);

/* Whether the method can simulate the model. If not, `why` says what is missing, in words that follow the method's
 * name. */
enum { ISO_WHY_SIZE = 256 };
bool iso_method_serves(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE]);

/* What "auto" means for a model: of the methods that serve it the one that suits it best (iso_method.suits), the
 * first of equals in the registry. As a rule:
 * - stiff models (iso_effects_stiffness): `bsimp`, the stiffest `bdf`;
 * - (24) with |k| so small that (max J/min J)^(1/|k|) > 1e10: `rk8pd`;
 * - all others: `taylor`. */
const iso_method *iso_method_auto(const iso_model *model);

/* For references: the method with the least digits above `digits`; and the method asked as `place`-th whether another
 * code confirms a result (iso_method.witness). NULL: there is none. */
const iso_method *iso_method_with_more_digits(int digits);
const iso_method *iso_method_witness(int place);

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

ISO_C_END

#endif
