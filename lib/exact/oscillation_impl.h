/* oscillation_impl.h - one sphero-conical coordinate in the clock sigma, by an angle that grows evenly.
 *
 * (dz/dsigma)^2 is a product of distances to branch points, at most six with 0 and infinity. Two bound the motion: z
 * starts at one, where sn = 0, and turns at the other, where cn = 0. The next one on either side, dn's and the base,
 * may come close to them; elliptic functions take in all four:
 *
 *     |z - root of sn| = span sn^2/B^2     |z - root of cn| = to_cn cn^2/B^2     B^2 = cn^2 + left sn^2
 *     |z - root of dn| = to_dn dn^2/B^2    |z - base|       = to_base/B^2        (B = 1: the base is infinite)
 *     dx/dsigma = sqrt(2 C z^power |z - rest| ...),   |z - rest| = far + |z - root of cn|
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

enum { MOST_XI_MODES = 512, MOST_MODES = 1 << 15 }; /* powers of 2: of functions of xi, and of theta */
enum { MOST_PARTS = 64 };

typedef struct oscillation {
    real zero, origin, span, left, to_cn, to_dn, to_base; /* z, `at` too, is counted from `zero` */
    int upwards, power; /* 1: z grows from origin, -1: it falls; of z in dx/dsigma */
    real C, far[2];
    int rests;
    elliptic f;
    real omega, start;         /* dtheta/dsigma; theta at sigma = 0                                         */
    int modes, samples, terms; /* of beta; intervals of [0, pi] that resolve functions of theta; of gamma, z */
    real beta[MOST_XI_MODES + 1], *at; /* at: z where theta = pi j/samples                                 */
    double *gamma, *z;
    bool no_memory; /* for samples: why a solution failed */
    int parts;      /* of sn = sum sn_part[n] sin (n + 1/2) theta and cn likewise, in double precision; 0: not made */
    double sn_part[MOST_PARTS], cn_part[MOST_PARTS];
} oscillation;

/* Finds the series; all above `f` is given, and 1 - m. False: too many terms would be needed, or no memory. */
bool iso_oscillation_solve(oscillation *o, real m1);
void iso_oscillation_release(oscillation *o);

/* Twice the samples, for functions of z that are sharper than z. */
bool iso_oscillation_refine(oscillation *o);

real iso_oscillation_theta(const oscillation *o, real xi);

/* sn, cn and dn at theta, to the rounding of doubles; where they become small next to a separatrix, relatively. */
void iso_oscillation_at(const oscillation *o, real theta, double *sn, double *cn, double *dn);

#endif
