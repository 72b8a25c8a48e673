/* method.h - integrators behind one table, and one contract for all of them.
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
 * - After a failing call times before the last good one can still be asked; times behind it fail again.
 */
#ifndef ISO_METHOD_METHOD_H
#define ISO_METHOD_METHOD_H

#include "model/model.h"

typedef struct iso_integrator iso_integrator;

typedef struct iso_method_options {
    double tolerance;  /* from ISO_LEAST_TOLERANCE to ISO_MOST_TOLERANCE                               */
    double fixed_step; /* > 0: steps of exactly this size without error control, to measure an order   */
    bool no_projection;
    double time_unit; /* times in messages are multiplied by it; 0: 1                                 */
    long max_steps;   /* 0: no bound; else ISO_NUMERICAL when more are needed, from the start on      */
    size_t memory;    /* bytes in which the ends of steps are kept, for each direction; 0: none is    */
} iso_method_options;

#define ISO_LEAST_TOLERANCE 1e-15
#define ISO_MOST_TOLERANCE 0.1
#define ISO_TOLERANCE_RANGE "[1e-15, 0.1]"
static inline bool iso_tolerance_is_good(double tolerance)
{
    return tolerance >= ISO_LEAST_TOLERANCE && tolerance <= ISO_MOST_TOLERANCE;
}

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

    /* What it needs of a model. A model that lacks it is refused, in words. */
    bool implicit;            /* solves with the Jacobian, for stiff models: every effect must have its slopes  */
    bool own_equations;       /* has a form of its own of the equations of motion, and does not call model.rhs  */
    bool steps_in_s;          /* all its steps have one length in the clock s, whatever the model's clock is    */
    bool splits;              /* its flows are those of M^2/2 and of a potential: no magnetic field fits in      */
    const iso_system *system; /* the only system it serves; NULL: every one                               */
    const char *system_why;   /* why only that one                                                        */

    /* How well it suits a model that it serves, for iso_method_auto; NULL: ISO_NEVER. */
    iso_suits (*suits)(const iso_model *model);

    /* Make and release the method's own data; begin at it->at_right; take one step, see integrator_impl.h. */
    iso_status (*create)(iso_integrator *it);
    iso_status (*start)(iso_integrator *it);
    iso_status (*step)(iso_integrator *it, double y[], double *h);
    /* The state at dt from the step's left end, |dt| < |h|, by the method itself; NULL: by gsl.c. */
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

/* The method called `name`, or NULL. Upper and lower case, '-' and '_' are the same, the family may stand before
 * ("gsl-rk8pd", "cvode_adams"), and a beginning that fits only one method is enough ("dormand_prince"). */
const iso_method *iso_method_find(const char *name);

#endif
