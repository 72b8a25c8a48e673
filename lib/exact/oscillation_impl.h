/* oscillation_impl.h - one sphero-conical coordinate in the clock sigma, by an angle that grows evenly.
 *
 *     z = origin + span sn^2(x|m)/(1 + bend sn^2(x|m)),   dx/dsigma = sqrt(2 C {|e - z| or 1/z})
 *
 * Of the five roots of (dz/dsigma)^2 two bound the motion, and two more may come close to them: elliptic functions
 * take in all four. What is left of dx/dsigma is smooth. With xi = pi x/K the angle theta = omega sigma is
 *
 *     theta = xi + sum_n beta_n sin n xi,    xi = theta + sum_n gamma_n sin n theta,
 *
 * and z = sum_n z_n cos n theta. Both xi and theta grow by 2 pi where x grows by 2 K, one swing of z; sn and cn
 * change sign there, and have period 4 pi.
 */
#ifndef ISO_EXACT_OSCILLATION_IMPL_H
#define ISO_EXACT_OSCILLATION_IMPL_H

#include <stdbool.h>

typedef long double real;

#define ISO_PI 3.141592653589793238462643383279502884L

enum { MOST_MODES = 1024, MOST_LANDEN = 16 }; /* modes: a power of 2 */

/* sn, cn, dn of parameter m = 1 - m1, by Landen's transformation; m1 itself is carried, which 1 - m would lose. */
typedef struct elliptic {
    real m1, K, a[MOST_LANDEN], c[MOST_LANDEN];
    int steps;
} elliptic;

void iso_elliptic_set(elliptic *e, real m1);

/* At xi = pi x/K. */
void iso_elliptic_at(const elliptic *e, real xi, real *sn, real *cn, real *dn);

/* pi x/K for the amplitude phi = am(x|m). */
real iso_elliptic_inverse(const elliptic *e, real phi);

typedef struct oscillation {
    real origin, span, bend, C, e;
    bool over_z;
    elliptic f;
    real omega; /* dtheta/dsigma                     */
    real beta[MOST_MODES + 1];
    double gamma[MOST_MODES + 1], z[MOST_MODES + 1];
    int modes, samples;      /* of beta; intervals of [0, pi] that resolve the functions of theta */
    real at[MOST_MODES + 1]; /* z where theta = pi j/samples */
    real start;              /* theta at sigma = 0                */
} oscillation;

/* dx/dsigma */
real iso_oscillation_rate(const oscillation *o, real z);

/* The rest from origin ... over_z and 1 - m. False: MOST_MODES are not enough. */
bool iso_oscillation_solve(oscillation *o, real m1);

real iso_oscillation_theta(const oscillation *o, real xi);
double iso_oscillation_xi(const oscillation *o, double theta);

#endif
