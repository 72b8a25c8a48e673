/* section.h - the chart of a Poincare section, common to both models, on every level of the point's energy.
 *
 * gamma_a = 0 exactly where n_a = 0 (18): ball and point cross the section at the same events. On the level H = E the
 * point obeys
 *
 *     gamma_a'' = -W^2 gamma_a  (d/ds),    W^2 = 2 E + (2 eps/k) q^(-1-1/k) [J_a - (1-k) q],    q = (gamma, J gamma)
 *
 * A crossing is a zero of gamma_a with gamma_a' > 0. Its coordinates are l and x, here for a = 3; for other axes the
 * components (b, c, a) = (a+1, a+2, a), counted cyclically, take the places of (1, 2, 3):
 *
 *     M = G (sqrt(1-x^2) sin l, sqrt(1-x^2) cos l, x),        gamma = (cos l, -sin l, 0)
 *     G = |M| = sqrt(2 (E + eps q^(-1/k))),                   q = J_b cos^2 l + J_c sin^2 l
 *
 * l is in (-pi, pi], x in (-1, 1). The ball's crossing is the image of this point (iso_point_to_ball), and has the
 * same (l, x). The return map keeps the area dL dl, L = M_a = G x. The boundary x = +-1 is the rotation about axis a,
 * which stays in the plane gamma_a = 0. The point can be only where E + eps q^(-1/k) >= 0. For E < 0 (eps > 0) this may
 * close a part of the circle of l; on its border the point rests, G = 0.
 *
 * An axis is 0, 1 or 2. Units: any consistent ones; eps is the coupling of the orbit (iso_coupling). In the
 * ball's own units all calls are accurate for max J/min J up to 1e6 with |k| from 0.05 to 1000, and wherever eps and
 * q^(1/k) do not overflow.
 */
#ifndef ISO_MAP_SECTION_H
#define ISO_MAP_SECTION_H

#include <stdint.h>

#include "../base/api.h"
#include "../model/system.h"

ISO_C_BEGIN

/* The motions of a point in the potential -eps q^(-1/k) on the level H = energy. The point of a free ball has H = 0. */
typedef struct iso_point_motion {
    const iso_params *p;
    double eps, energy;
} iso_point_motion;

static inline iso_point_motion iso_free_point(const iso_params *p, double eps)
{
    iso_point_motion m;
    m.p = p;
    m.eps = eps;
    m.energy = 0;
    return m;
}

/* The axis whose section is global: that of the largest moment for eps/k > 0, that of the smallest for eps/k < 0. If
 * several moments are equal it is the first of them. There W^2 = |gamma'|^2 + (2 eps/k) q^(-1-1/k) (J_a - q), and both
 * terms are 0 or more wherever the point can be. Both are 0 only at rest on axis a. So every orbit crosses the section
 * for ever, except the rotation in the plane gamma_a = 0 and, where E = V on axis a, the orbits that come to rest
 * there; and no orbit only touches it. */
ISO_API int iso_section_axis(iso_point_motion m);

/* Whether every orbit crosses the section of `axis` for ever: it is such an axis (of equal moments each one is), or
 * W^2 > 0 wherever the point can be. */
ISO_API bool iso_section_is_global(iso_point_motion m, int axis);

/* The crossing at (l, x), as a point (M, gamma) on H = E. |x| <= 1. */
ISO_API void iso_section_point(iso_point_motion m, int axis, double l, double x, double point[ISO_STATE]);

/* The chart of a crossing (M, gamma). l is the angle of (gamma_b, gamma_c), so it keeps its digits where |x| is near
 * 1; x is M_a/|M|. Small errors of gamma_a do not matter. */
ISO_API void iso_section_chart(int axis, const double point[ISO_STATE], double *l, double *x);

/* G(l): the largest |L| at l; 0 where the point cannot be. The derivative of the return map in (l, x) has the
 * determinant G(l)/G(l'), where l' is that of the image. */
ISO_API double iso_section_momentum(iso_point_motion m, int axis, double l);

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
    double k, eps, energy;             /* G ~ sqrt(energy + eps (q/largest)^(-1/k))          */
    double J[2], largest;              /* q = J[0] cos^2 + J[1] sin^2, from the middle of an open arc */
    double reach;                      /* of sin^2 to the border of this arc; 1: all is open   */
    double middle;                     /* l of the middle: 0 or pi/2                         */
    double part[ISO_SPREAD_STEPS + 1]; /* of the integral of G over half of an arc           */
    uint64_t shift[2];                 /* in units of 2^-64                                  */
} iso_section_spread;
ISO_API void iso_section_spread_prepare(iso_section_spread *spread, iso_point_motion m, int axis, uint64_t seed);
ISO_API void iso_section_spread_point(const iso_section_spread *spread, uint64_t i, double *l, double *x);

ISO_C_END

#endif
