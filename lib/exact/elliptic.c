#include "exact/elliptic_impl.h"

#include <float.h>
#include <math.h>

void iso_elliptic_set(elliptic *e, real m1)
{
    real a = 1, b = sqrtl(m1);
    e->m1 = m1;
    e->steps = 0;
    while (a - b > 4 * LDBL_EPSILON * a && e->steps < MOST_LANDEN - 1) {
        const real mean = (a + b) / 2;
        e->mean[e->steps] = (double)a;
        e->root[e->steps++] = (double)b;
        e->ratio[e->steps] = (a - b) / (a + b);
        b = sqrtl(a * b);
        a = mean;
    }
    e->mean[e->steps] = (double)a;
    e->K = ISO_PI / (2 * a);
}

void iso_elliptic_at(const elliptic *e, real xi, real *sn, real *cn, real *dn)
{
    real phi = ldexpl(xi / 2, e->steps);
    for (int i = e->steps; i > 0; i--) phi = (phi + asinl(e->ratio[i] * sinl(phi))) / 2;
    *sn = sinl(phi);
    *cn = cosl(phi);
    *dn = sqrtl(e->m1 + (1 - e->m1) * *cn * *cn);
}

/* Bulirsch's way up the same ladder, without trigonometric functions after the first. */
void iso_elliptic_double(const elliptic *e, double xi, double *sn, double *cn, double *dn)
{
    *sn = sin(xi / 2);
    *cn = cos(xi / 2);
    *dn = 1;
    if (*sn == 0) return;
    double a = *cn / *sn, c = a * e->mean[e->steps];
    for (int i = e->steps - 1; i >= 0; i--) {
        const double b = e->mean[i];
        a *= c;
        c *= *dn;
        *dn = (e->root[i] + a) / (b + a);
        a = c / b;
    }
    a = 1 / sqrt(c * c + 1);
    *sn = *sn < 0 ? -a : a;
    *cn = c * *sn;
}

real iso_elliptic_inverse(const elliptic *e, real phi)
{
    real a = 1, b = sqrtl(e->m1);
    for (int i = 1; i <= e->steps; i++) {
        /* phi' - phi with tan(phi' - phi) = (b/a) tan phi, on the branch next to phi */
        const real more = atan2l(b * sinl(phi), a * cosl(phi));
        phi += more + 2 * ISO_PI * roundl((phi - more) / (2 * ISO_PI));
        const real mean = (a + b) / 2;
        b = sqrtl(a * b);
        a = mean;
    }
    return ldexpl(phi, 1 - e->steps);
}
