/* system.h - the two systems of the isomorphism behind one table: `ball` (9) and `point` (24).
 *
 * A row is everything the rest of the library knows of a system. lib/README.md says how to add one; it does not enter
 * the registry. All functions work in any consistent units; iso_orbit calls them in the ball's own units.
 *
 *     ball    y = (omega, n)   clock t    J w' = J w x w + lambda n,  n' = k n x w,  (w,n) = 0,  |n| = 1       (9)
 *     point   y = (M, gamma)   clock s    M' = gamma x dV/dgamma,     gamma' = gamma x M,
 *                                         V = -eps (gamma, J gamma)^(-1/k),  (M,gamma) = 0,  |gamma| = 1       (24)
 */
#ifndef ISO_MODEL_SYSTEM_H
#define ISO_MODEL_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>

#include "model/problem.h"

enum { ISO_STATE = 6 }; /* numbers in a state of either system: two vectors of R^3 */

/* Clocks: the ball's time t, the time tau in which the ball is Hamiltonian (16), the point's time s (24). */
typedef enum iso_clock { ISO_CLOCK_T, ISO_CLOCK_TAU, ISO_CLOCK_S, ISO_CLOCKS } iso_clock;

/* "t", "tau", "s". */
const char *iso_clock_name(iso_clock clock);

/* A first integral. y is the state of the whole model, of which most integrals read six numbers. `value` gives I(y)
 * and, in *size, the magnitude of its terms. Drift is measured by this size: if I is conserved,
 * |I(y) - I(y0)| / size is of the order of the rounding error. */
typedef struct iso_integral {
    const char *name, *doc;
    iso_dimension dimension;
    enum { ISO_ANY_VALUE, ISO_ZERO, ISO_ONE } known; /* constraints have a known value     */
    bool (*holds)(const iso_problem *f);             /* for which k, J and effects; NULL: always */
    double (*value)(const iso_problem *f, const double y[], double *size);
    bool claimed; /* by the scene: nobody has proved it, so nothing may follow from it */
} iso_integral;

typedef struct iso_system {
    const char *name, *doc;
    iso_clock clock;               /* the clock its equations are written in                               */
    const char *const *state;      /* the six names, as in trajectory files                                */
    iso_dimension fast_dimension;  /* of the first vector, omega or M; the second is a unit vector         */
    const iso_integral *integrals; /* ended by a row without a name                                        */

    void (*rhs)(const iso_problem *f, const double y[ISO_STATE], double dy[ISO_STATE]);

    /* q = (gamma, J gamma), which fixes all clock rates, and its gradient (may be NULL). */
    double (*q)(const iso_params *p, const double y[ISO_STATE], double gradient[ISO_STATE]);

    /* The energy, h or H; *size as in iso_integral. It is also one of the integrals. */
    double (*energy)(const iso_problem *f, const double y[], double *size);

    /* Restores the unit vector, orthogonality and f->energy; returns the relative size of the correction. y is the
     * state of the whole model. */
    double (*project)(const iso_problem *f, double y[]);

    /* The size of the first vector against which its errors are measured. */
    double (*speed)(const iso_problem *f, const double y[]);
} iso_system;

/* ball, point, NULL */
extern const iso_system *const iso_systems[];

#endif
