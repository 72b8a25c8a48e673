/* oscillation_impl.h - one sphero-conical coordinate in the clock sigma, by an angle that grows evenly.
 *
 * (dz/dsigma)^2 is a product of distances to roots. Of the two that bound the motion z starts at one, where sn = 0, and
 * turns at the other, where cn = 0. Two more may come close to them; elliptic functions take in all four:
 *
 *     |z - root of sn| = span sn^2/B^2     |z - root of cn| = to_cn cn^2/B^2     B^2 = 1 + bend sn^2
 *     |z - root of dn| = to_dn dn^2/B^2    |z - base|       = to_base/B^2
 *     dx/dsigma = sqrt(2 C {|z - rest| or 1/z}),   |z - rest| = far + |z - nearest root|
 *
 * What is left of dx/dsigma is smooth. With xi = pi x/K the angle theta = omega sigma is
 *
 *     theta = xi + sum_n beta_n sin n xi,    xi = theta + sum_n gamma_n sin n theta,
 *
 * and z = sum_n z_n cos n theta. Both xi and theta grow by 2 pi where x grows by 2 K, one swing of z; sn and cn
 * change sign there, and have period 4 pi.
 */
#ifndef ISO_EXACT_OSCILLATION_IMPL_H
#define ISO_EXACT_OSCILLATION_IMPL_H

#include <stdbool.h>

#include "exact/elliptic_impl.h"

enum { MOST_MODES = 1024 }; /* a power of 2 */

typedef struct oscillation {
    real origin, span, bend, left, to_cn, to_dn, to_base; /* left: 1 + bend; all but origin and bend are >= 0 */
    int upwards;                                          /* 1: z grows from origin, -1: it falls                */
    real C, far;
    bool over_z, rest_by_sn; /* no rest but 1/z; the root next to the rest is that of sn, not of cn              */
    elliptic f;
    real omega; /* dtheta/dsigma                     */
    real beta[MOST_MODES + 1];
    double gamma[MOST_MODES + 1], z[MOST_MODES + 1];
    int modes, samples, terms; /* of beta; intervals of [0, pi] that resolve the functions of theta; of gamma and z */
    real at[MOST_MODES + 1];   /* z where theta = pi j/samples      */
    real start;                /* theta at sigma = 0                */
} oscillation;

/* Finds the series; all above `f` is given, and 1 - m. False: MOST_MODES are not enough. */
bool iso_oscillation_solve(oscillation *o, real m1);

real iso_oscillation_theta(const oscillation *o, real xi);
double iso_oscillation_xi(const oscillation *o, double theta);

#endif
