/* elliptic_impl.h - Jacobi's elliptic functions of parameter m = 1 - m1, by Landen's transformation (Abramowitz,
 * Stegun, 16.4). m1 itself is carried, which 1 - m would lose.
 *
 * Angles are xi = pi x/K: sn and cn have period 4 pi, dn has 2 pi.
 */
#ifndef ISO_EXACT_ELLIPTIC_IMPL_H
#define ISO_EXACT_ELLIPTIC_IMPL_H

typedef long double real;

#define ISO_PI 3.141592653589793238462643383279502884L

enum { MOST_LANDEN = 20 };

typedef struct elliptic {
    real m1, K, ratio[MOST_LANDEN];
    double mean[MOST_LANDEN], root[MOST_LANDEN]; /* of the arithmetic-geometric mean */
    int steps;
} elliptic;

void iso_elliptic_set(elliptic *e, real m1);

void iso_elliptic_at(const elliptic *e, real xi, real *sn, real *cn, real *dn);

/* In double precision, in a fraction of the time. */
void iso_elliptic_double(const elliptic *e, double xi, double *sn, double *cn, double *dn);

/* xi for the amplitude phi = am(x|m). */
real iso_elliptic_inverse(const elliptic *e, real phi);

#endif
