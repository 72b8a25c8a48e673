/* model.h - what is integrated: a system, the clock it runs in, and the clocks it carries.
 *
 * A model is assembled once, and holds exactly what was asked for. A free ball in its own time is the six equations
 * (9) and nothing else. Asked to run in another clock c, every equation is multiplied by d(own clock)/dc, the time
 * change of the isomorphism (section 4 of the paper); asked to carry a clock, that clock is one more state.
 */
#ifndef ISO_MODEL_MODEL_H
#define ISO_MODEL_MODEL_H

#include "system.h"

enum { ISO_MAX_STATE = ISO_STATE + ISO_CLOCKS - 1 };

typedef struct iso_model iso_model;
struct iso_model {
    const iso_system *system;
    iso_field field;
    iso_clock clock;               /* the independent variable                                  */
    int carried;                   /* number of clocks that are states, after the system's six  */
    iso_clock carry[ISO_CLOCKS];   /* which                                                     */
    int dim;                       /* ISO_STATE + carried                                       */
    void (*rhs)(const iso_model *m, const double y[], double dy[]);       /* y' = f(y)          */
    void (*jacobian)(const iso_model *m, const double y[], double jac[]); /* row-major dim x dim */
};

/* Assembles. carry[c] asks for clock c as a state; the independent clock is never one. */
iso_model iso_model_assemble(const iso_system *system, const iso_field *field, iso_clock clock,
                             const bool carry[ISO_CLOCKS]);

/* Restores the system's constraints and energy in y; gives the relative size of the correction. */
double iso_model_project(const iso_model *m, double y[]);

/* The size of each component for error control: of the vector of R^3 it belongs to; of the clock, and of its
 * progress in one unit of the independent variable. Errors of a step are measured in units of tolerance * size. */
void iso_model_size(const iso_model *m, const double y[], double size[]);

#endif
