/* elliptic_impl.h - Jacobi's elliptic functions of parameter m = 1 - m1. m1 itself is given and kept: where it is
 * small, 1 - m would have no digits. Small values of any of the functions keep their relative accuracy.
 *
 * Angles are xi = pi x/K: sn and cn have period 4 pi, dn has 2 pi.
 */
#ifndef ISO_EXACT_ELLIPTIC_IMPL_H
#define ISO_EXACT_ELLIPTIC_IMPL_H

#include <math.h>

#include "base/math_impl.h"

typedef long double real;

/* An orbit on a separatrix is computed as one at this relative distance from it. The difference is below all digits
 * until the orbit has come back. */
#define ISO_OFF_SEPARATRIX 1e-38L

/* x minus the nearest multiple of `period` */
static inline real less_turns(real x, real period)
{
    return x - period * rintl(x / period);
}

enum { MOST_MEANS = 20 };

typedef struct elliptic {
    real m1, K, mean[MOST_MEANS], root[MOST_MEANS]; /* of the arithmetic-geometric mean of 1 and sqrt(m1) */
    int steps;
} elliptic;

void iso_elliptic_set(elliptic *e, real m1);

void iso_elliptic_at(const elliptic *e, real xi, real *sn, real *cn, real *dn);

/* xi in [-2 pi, 2 pi] at which sn and cn are in the ratio of those given, with their signs. */
real iso_elliptic_inverse(const elliptic *e, real sn, real cn);

#endif
