/* elliptic_impl.h - Jacobi's elliptic functions of parameter m = 1 - m1. m1 itself is carried, which 1 - m would
 * lose, and small values of any function keep their digits.
 *
 * Angles are xi = pi x/K: sn and cn have period 4 pi, dn has 2 pi.
 */
#ifndef ISO_EXACT_ELLIPTIC_IMPL_H
#define ISO_EXACT_ELLIPTIC_IMPL_H

#include <math.h>

#include "base/pi_impl.h"

typedef long double real;

/* What an orbit on a separatrix is taken off it, relatively: nothing to be seen before it has come back. */
#define ISO_OFF_SEPARATRIX 1e-38L

/* x less the nearest multiple of `period`: as exact as x is. */
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

/* xi in [-2 pi, 2 pi] where sn and cn are as sn and cn given, which need not be of length 1. */
real iso_elliptic_inverse(const elliptic *e, real sn, real cn);

#endif
