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
 * l is in (-pi, pi], x in (-1, 1). The ball's crossing is the image (iso_point_to_ball): the same (l, x). The return
 * map keeps the area dL dl, L = M_a = G x. The boundary x = +-1 is the rotation in the plane gamma_a = 0 itself.
 *
 * An axis is 0, 1 or 2. Units: any consistent ones; eps > 0 is the coupling of the orbit (iso_coupling). In
 * the ball's own units all calls hold for max J/min J up to 1e6 with |k| from 0.05 to 1000, and wherever eps and
 * q^(1/k) do not overflow.
 */
#ifndef ISO_MAP_SECTION_H
#define ISO_MAP_SECTION_H

#include <stdint.h>

#include "../base/api.h"
#include "../model/system.h"

ISO_C_BEGIN

/* The axis whose section is global: that of the largest moment for k > 0, of the smallest for k < 0; of equal ones
 * the first. There W^2 > 0 for every q: every orbit but the rotation in the plane gamma_a = 0 crosses for ever, and
 * none only touches. */
ISO_API int iso_section_axis(const iso_params *p);

/* Whether `axis` is such an axis; of equal moments each one is. Sections of other axes may be met by every orbit as
 * well, for some k and J: exactly where iso_section_bounds gives W[0] > 0. */
ISO_API bool iso_section_is_global(const iso_params *p, int axis);

/* The crossing at (l, x), as a point (M, gamma) on H = 0. |x| <= 1. */
ISO_API void iso_section_point(const iso_params *p, double eps, int axis, double l, double x,
                               double point[ISO_STATE]);

/* The chart of a crossing (M, gamma). l comes from gamma, and keeps its digits where |x| is near 1. Small errors of
 * gamma_a do not matter: l and x are those of the direction of (gamma_b, gamma_c), and of M_a/|M|. */
ISO_API void iso_section_chart(int axis, const double point[ISO_STATE], double *l, double *x);

/* The derivatives of iso_section_point by l and by x. |x| < 1. */
ISO_API void iso_section_deviations(const iso_params *p, double eps, int axis, double l, double x,
                                    double by_l[ISO_STATE], double by_x[ISO_STATE]);

/* slope = (dl, dx) of a deviation (dM, dgamma) of the crossing `point`: the neighbouring orbit, point + deviation, is
 * followed along the flow until it crosses itself, gamma_a + dgamma_a = 0, and its chart is taken there, all to first
 * order. A part of the deviation along the flow therefore changes nothing. */
ISO_API void iso_section_slope(const iso_params *p, double eps, int axis, const double point[ISO_STATE],
                               const double deviation[ISO_STATE], double slope[2]);

/* G(l): the largest |L| at l. The return map's derivative in (l, x) has the determinant G(l)/G(l of the image). */
ISO_API double iso_section_momentum(const iso_params *p, double eps, int axis, double l);

/* The whole section's area, the integral of 2 G dl over the turn, to about 1e-15 of it. */
ISO_API double iso_section_area(const iso_params *p, double eps, int axis);

/* W[0] <= W <= W[1] for every gamma of the sphere, the closest such bounds. Where W^2 reaches 0 or less, W[0] is 0;
 * W[1] is always above 0. By Sturm's comparison two crossings that follow each other are at least 2 pi/W[1] and at
 * most 2 pi/W[0] apart in s (infinite for 0). The bounds are rounded, and orbits may meet them: allow a rounding
 * error. */
ISO_API void iso_section_bounds(const iso_params *p, double eps, int axis, double W[2]);

/* Points spread evenly over the section by the area dL dl. The first N of them, for every N, leave smaller holes than
 * random ones. They do not depend on eps.
 *
 *     iso_section_spread spread;
 *     iso_section_spread_prepare(&spread, &p, axis, seed);
 *     iso_section_spread_point(&spread, i, &l, &x);
 *
 * Point i is the same whatever was asked before; it takes a few microseconds. Equal seeds give equal points.
 * (u_1, u_2) = seed's shift + i (1/r, 1/r^2) modulo 1, r^3 = r + 1 (the additive recurrence R2, in integers of 64
 * bits: for every i below 2^64); x = 2 u_2 - 1, and l is where the part u_1 of the integral of G lies on one side. */
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
