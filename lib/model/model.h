/* model.h - what is integrated: a system, its effects, the clock it runs in, and the clocks it carries.
 *
 * A model is assembled once, and holds exactly what was asked for. A free ball in its own time is the six equations
 * (9) and nothing else. An effect adds its torque and its states, and what it does not do costs nothing. Asked to run
 * in another clock c, every equation is multiplied by d(own clock)/dc, the time change of the isomorphism (section 4
 * of the paper); asked to carry a clock, that clock is one more state.
 *
 *     y = (omega, n | e of gravity | lambda of twist | Q, x of attitude | clocks)      what is there, in this order
 */
#ifndef ISO_MODEL_MODEL_H
#define ISO_MODEL_MODEL_H

#include "model/effects/effect.h"

/* Room for the states of effects; a model with more is refused. */
enum { ISO_MOST_EFFECT_STATES = 16, ISO_MAX_STATE = ISO_STATE + ISO_MOST_EFFECT_STATES + ISO_CLOCKS - 1 };

typedef struct iso_model iso_model;
struct iso_model {
    const iso_system *system;
    iso_problem problem;
    iso_clock clock;                /* the independent variable                                  */
    int moving;                     /* states of the system and of the effects                   */
    int clocks;                     /* number of clocks that are states, after those             */
    iso_clock clock_of[ISO_CLOCKS]; /* which                                                    */
    int dim;                        /* moving + clocks                                           */
    void (*rhs)(const iso_model *m, const double y[], double dy[]);       /* y' = f(y)          */
    void (*jacobian)(const iso_model *m, const double y[], double jac[]); /* row-major dim x dim */

    /* Of what `rhs` is made: the equations in the system's own clock; the contact; the effects with states. */
    void (*own_rhs)(const iso_model *m, const double y[], double dy[]);
    void (*contact)(const iso_problem *f, const double y[], const double T[3], double dy[]);
    int with_states_count;
    const iso_effect *with_states[ISO_EFFECTS];
    const iso_effect *without_formula; /* the first effect whose equations are no formula; NULL: none */
};

#endif
