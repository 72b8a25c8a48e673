/* separation_impl.h - the free problem on H = 0 for k = 1, -1 in sphero-conical coordinates u <= v of gamma.
 *
 * With b = J (k = -1) or 1/J (k = 1), ascending, and D = b1 b2 b3,
 *
 *     k = -1:  q = b1 + b2 + b3 - u - v,   R(z) = eps z (b1 + b2 + b3 - z)
 *     k = 1:   q = u v/D,                  R(z) = -eps D/z
 *
 *     (dz/dsigma)^2 = 8 A(z) (R(z) + c),   A(z) = (b1-z)(b2-z)(b3-z),   z = u and z = v,   ds = (v - u) dsigma.
 *
 * The constant c is a polynomial in M and gamma,
 *
 *     c = -(M,bM)/2 + eps x { -D (gamma,b^-1 gamma)  |  (b1+b2+b3 - (gamma,b gamma))/q }.
 *
 * Between b1 and b3 lies one root al of R + c. Below b2 it is the upper end of u (`librates_low`), else the lower end
 * of v.
 */
#ifndef ISO_EXACT_SEPARATION_IMPL_H
#define ISO_EXACT_SEPARATION_IMPL_H

#include "exact/oscillation_impl.h"
#include "model/system.h"

typedef struct separation {
    int k, axis[3];                 /* axis[i]: the caller's axis with b[i]                                   */
    real b[3], eps, c, distance, det;
    bool librates_low, below_b3;    /* below_b3: k = -1 and v ends at the other root of R + c, not at b3      */
    real top, above, below, bottom; /* the roots that bound v and u: bottom <= u <= below < above <= v <= top */
    real size[3];                   /* of the components of gamma                                             */
    oscillation u, v;
    int turn, side;                 /* the sense of the turning pair of components; the sign of gamma3 if
                                       below_b3                                                               */
} separation;

/* From (M, gamma). False: on the separatrix, or too close. */
bool iso_separation_make(separation *s, const iso_field *field, const double point[ISO_STATE]);

/* (M, gamma) at the angles of u and v. */
void iso_separation_state(const separation *s, const double theta[2], double point[ISO_STATE]);

/* d clock/dsigma: ds = (v - u) dsigma, d tau = (det J/k^2) q^(-1/k) ds, dt = (det J/k^2) q^(-1 - 1/(2k)) ds. */
real iso_separation_rate(const separation *s, iso_clock clock, real u, real v);

/* (1/2 pi) times the integral of |p_z dz| over one swing of z */
real iso_separation_action(const separation *s, const oscillation *o);

#endif
