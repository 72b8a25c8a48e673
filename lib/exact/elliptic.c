/* elliptic.c - elliptic functions by Bulirsch's algorithms, which use the arithmetic-geometric mean (Numer. Math. 7
 * (1965) 78-90). */
#include "exact/elliptic_impl.h"

#include <float.h>
#include <math.h>

void iso_elliptic_set(elliptic *e, real m1)
{
    real a = 1, b = sqrtl(m1);
    e->m1 = m1;
    e->steps = 0;
    while (a - b > 4 * LDBL_EPSILON * a && e->steps < MOST_MEANS - 1) {
        e->mean[e->steps] = a;
        e->root[e->steps++] = b;
        const real mean = (a + b) / 2;
        b = sqrtl(a * b);
        a = mean;
    }
    e->mean[e->steps] = a;
    e->K = ISO_PI_LONG / (2 * a);
}

/* sin and cos by those of an angle within an eighth of a turn, for which the C library is quick. */
static void sine_and_cosine(real x, real *sine, real *cosine)
{
    const real quarters = rintl(x / (ISO_PI_LONG / 2)), rest = x - quarters * (ISO_PI_LONG / 2), s = sinl(rest),
               c = cosl(rest);
    const int quarter =
        (fabsl(quarters) < 1e9L ? (int)quarters : 0) & 3; /* NaN has no quarter; xi is a turn at most */
    *sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
    *cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
}

void iso_elliptic_at(const elliptic *e, real xi, real *sn, real *cn, real *dn)
{
    sine_and_cosine(xi / 2, sn, cn);
    *dn = 1;
    if (*sn == 0) return;
    real a = *cn / *sn, c = a * e->mean[e->steps];
    for (int i = e->steps - 1; i >= 0; i--) {
        const real b = e->mean[i];
        a *= c;
        c *= *dn;
        *dn = (e->root[i] + a) / (b + a);
        a = c / b;
    }
    a = 1 / sqrtl(c * c + 1);
    *sn = *sn < 0 ? -a : a;
    *cn = c * *sn;
}

real iso_elliptic_inverse(const elliptic *e, real sn, real cn)
{
    real kc = sqrtl(e->m1), m = 1, y = fabsl(cn / sn);
    int turns = 0;
    if (sn == 0) return cn < 0 ? 2 * ISO_PI_LONG : 0;
    if (!(kc > 0) || isnan(y)) return NAN; /* m1 too small for a number: the loop would not end */
    for (;;) {
        const real product = m * kc, before = m;
        m += kc;
        y -= product / y;
        if (fabsl(before - kc) <= 4 * LDBL_EPSILON * before) break;
        kc = 2 * sqrtl(product);
        turns = 2 * turns + (y < 0);
    }
    const real xi = ISO_PI_LONG / e->K * (atanl(m / y) + ISO_PI_LONG * (turns + (y < 0))) / m;
    return copysignl(cn < 0 ? 2 * ISO_PI_LONG - xi : xi, sn);
}
