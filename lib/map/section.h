/* section.h - the chart of a Poincare section of free orbits, common to both models.
 *
 * gamma_a = 0 exactly where n_a = 0 (18): ball and point cross the section at the same events. On the level H = 0 the
 * point obeys
 *
 *     gamma_a'' = -W^2 gamma_a  (d/ds),    W^2 = (2 eps/k) q^(-1-1/k) [J_a - (1-k) q],    q = (gamma, J gamma)
 *
 * A crossing is a zero of gamma_a with gamma_a' > 0. Its coordinates are l and x, here for a = 3; for other axes the
 * components (b, c, a) = (a+1, a+2, a), counted cyclically, take the places of (1, 2, 3):
 *
 *     M = G (sqrt(1-x^2) sin l, sqrt(1-x^2) cos l, x),        gamma = (cos l, -sin l, 0)
 *     G = |M| = sqrt(2 eps) q^(-1/(2k)),                      q = J_b cos^2 l + J_c sin^2 l
 *
 * l is in (-pi, pi], x in (-1, 1). The ball's crossing is the image of this point (iso_point_to_ball), and has the
 * same (l, x). The return map keeps the area dL dl, L = M_a = G x. The boundary x = +-1 is the rotation about axis a,
 * which stays in the plane gamma_a = 0.
 *
 * An axis is 0, 1 or 2. Units: any consistent ones; eps > 0 is the coupling of the orbit (iso_coupling). In the
 * ball's own units all calls are accurate for max J/min J up to 1e6 with |k| from 0.05 to 1000, and wherever eps and
 * q^(1/k) do not overflow.
 */
#ifndef ISO_MAP_SECTION_H
#define ISO_MAP_SECTION_H

#include <stdint.h>

#include "../base/api.h"
#include "../model/system.h"

ISO_C_BEGIN

/* The axis whose section is global: that of the largest moment for k > 0, that of the smallest for k < 0. If several
 * moments are equal it is the first of them. There W^2 > 0 for every q. So every orbit crosses the section for ever,
 * except the rotation in the plane gamma_a = 0, and no orbit only touches it. */
ISO_API int iso_section_axis(const iso_params *p);

/* Whether `axis` is such an axis; of equal moments each one is. For some k and J the sections of other axes are
 * global as well: exactly where iso_section_bounds gives W[0] > 0. */
ISO_API bool iso_section_is_global(const iso_params *p, int axis);

/* Whether a free orbit is the rotation about this axis, in the plane n_axis = 0 itself: at y, which is (omega, n) or
 * (M, gamma), n_axis is 0 up to rounding, and so is its rate. */
bool iso_section_is_rotation(const double y[ISO_STATE], int axis);

/* The crossing at (l, x), as a point (M, gamma) on H = 0. |x| <= 1. */
ISO_API void iso_section_point(const iso_params *p, double eps, int axis, double l, double x,
                               double point[ISO_STATE]);

/* The chart of a crossing (M, gamma). l is the angle of (gamma_b, gamma_c), so it keeps its digits where |x| is near
 * 1; x is M_a/|M|. Small errors of gamma_a do not matter. */
ISO_API void iso_section_chart(int axis, const double point[ISO_STATE], double *l, double *x);

/* The derivatives of iso_section_point by l and by x. |x| < 1. */
ISO_API void iso_section_deviations(const iso_params *p, double eps, int axis, double l, double x,
                                    double by_l[ISO_STATE], double by_x[ISO_STATE]);

/* slope = (dl, dx) of a deviation (dM, dgamma) of the crossing `point`. The neighbouring orbit starts at
 * point + deviation. It is followed along the flow until it crosses the section, and (l, x) is taken there, all to
 * first order. So a part of the deviation along the flow changes nothing. */
ISO_API void iso_section_slope(const iso_params *p, double eps, int axis, const double point[ISO_STATE],
                               const double deviation[ISO_STATE], double slope[2]);

/* G(l): the largest |L| at l. The derivative of the return map in (l, x) has the determinant G(l)/G(l'), where l' is
 * that of the image. */
ISO_API double iso_section_momentum(const iso_params *p, double eps, int axis, double l);

/* The area of the whole section, the integral of 2 G dl over the circle. Its relative error is about 1e-15. */
ISO_API double iso_section_area(const iso_params *p, double eps, int axis);

/* The closest bounds W[0] <= W <= W[1] for all gamma on the sphere. If W^2 is 0 or less anywhere, W[0] is 0; W[1] is
 * always above 0. By Sturm's comparison two successive crossings are at least 2 pi/W[1] and at most 2 pi/W[0] apart
 * in s (infinity for W[0] = 0). The bounds are rounded, and an orbit can reach them: allow a rounding error. */
ISO_API void iso_section_bounds(const iso_params *p, double eps, int axis, double W[2]);

/* Points spread evenly over the section by the area dL dl. For every N, the first N points leave smaller holes than N
 * random points. They do not depend on eps.
 *
 *     iso_section_spread spread;
 *     iso_section_spread_prepare(&spread, &p, axis, seed);
 *     iso_section_spread_point(&spread, i, &l, &x);
 *
 * Point i does not depend on earlier calls; it takes a few microseconds. Equal seeds give equal points. The points
 * are those of the additive recurrence R2, (u_1, u_2) = shift + i (1/r, 1/r^2) modulo 1, r^3 = r + 1. The shift comes
 * from the seed. Integers of 64 bits make this exact for every i below 2^64. x = 2 u_2 - 1, and l is the angle up to
 * which the integral of G is the part u_1 of the whole. */
enum { ISO_SPREAD_STEPS = 184 };
typedef struct iso_section_spread {
    double exponent, Jb, Jc, largest;  /* G ~ (q/largest)^exponent <= 1          */
    double part[ISO_SPREAD_STEPS + 1]; /* of the integral of G over a quarter    */
    uint64_t shift[2];                 /* in units of 2^-64                      */
} iso_section_spread;
ISO_API void iso_section_spread_prepare(iso_section_spread *spread, const iso_params *p, int axis, uint64_t seed);
ISO_API void iso_section_spread_point(const iso_section_spread *spread, uint64_t i, double *l, double *x);

ISO_C_END

#endif
