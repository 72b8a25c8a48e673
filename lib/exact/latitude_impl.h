/* latitude_impl.h - how gamma swings along an axis of revolution, for every k and H.
 *
 * With x the component of gamma along the axis (moment J_a, across it J_e), y = x^2 and q = J_e + (J_a - J_e) y,
 *
 *     M^2 = m(y) = 2 (H + eps q^(-1/k)),     (dx/ds)^2 = P(y) = (1 - y) m(y) - M_x^2
 *
 * with M_x, the part of M along the axis, constant, but for a rotor with K along the axis: its field
 * (model/effects/effect_rotor.c) makes dM_x/dy = field q^(-1 - 1/(2k)). With a and b the roots of P about y,
 *
 *     equator:  x = sqrt(a) cn,    between -sqrt(a) and sqrt(a)     b <= 0, or too far to matter: cn is cos
 *     side:     x = +-sqrt(a) dn,  between sqrt(b) and sqrt(a)      b > 0
 *
 * What is left, Q = P/((a - y)(y - b)), comes of divided differences f[y,a,b], without cancellation (rate_squared).
 */
#ifndef ISO_EXACT_LATITUDE_IMPL_H
#define ISO_EXACT_LATITUDE_IMPL_H

#include <stdbool.h>

#include "exact/elliptic_impl.h"

typedef struct latitude {
    real Je, Ja, eps, H, power;     /* power = -1/k                                  */
    real field;                     /* of a rotor; 0: none                           */
    real x0, dx0, y0, M2, Mx;       /* at the start                                  */
    bool side, has_b, homoclinic;   /* x keeps its sign; b is near; b is 0           */
    real a, b, a_b, rest_a, rest_b; /* a - b, 1 - a; 1 - b on one side, 1 on both    */
    real sense, Mx_a;               /* sign and size of M_x at a                     */
    real distance;                  /* P(0)/m(0): 0 on the separatrix of the equator */
} latitude;

/* Finds a ... distance from the rest. */
void iso_latitude_range(latitude *r);

real iso_latitude_q(const latitude *r, real y);
real iso_latitude_m(const latitude *r, real y);
real iso_latitude_Mx(const latitude *r, real y);
real iso_latitude_Mx_slope(const latitude *r, real y, real z); /* M_x[y,z] */

/* |y0 - root| for a root of P */
real iso_latitude_distance(const latitude *r, real root);

/* dx/ds at y, x being the argument of the elliptic functions; dn is its dn(x). *psi (may be NULL) is the rate of the
 * longitude by x, in the sense in which it grows next to a, without its elementary part S dn/(1 - y),
 * S = sqrt((1 - a)(1 - b)): psi = (sense M_x/(dx/ds) - S dn)/(1 - y). */
real iso_latitude_rate(const latitude *r, real y, real dn, real *psi);

#endif
