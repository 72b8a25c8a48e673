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
 * which stays in the plane gamma_a = 0. The point can be only where E + eps q^(-1/k) >= 0. For E < 0 (eps > 0) this
 * may close a part of the circle of l; on its border the point rests, G = 0.
 *
 * An axis is 0, 1 or 2. Units: any consistent ones; eps is the coupling of the orbit (iso_coupling). In the
 * ball's own units all calls are accurate for max J/min J up to 1e6 with |k| from 0.05 to 1000, and wherever eps and
 * q^(1/k) do not overflow.
 */
#ifndef ISO_MAP_SECTION_H
#define ISO_MAP_SECTION_H

#include <stdint.h>

#include "model/system.h"

/* The motions of a point in the potential -eps q^(-1/k) on the level H = energy. The point of a free ball has
 * H = 0. */
typedef struct iso_point_motion {
    const iso_params *p;
    double eps, energy;
} iso_point_motion;

static inline iso_point_motion iso_free_point(const iso_params *p, double eps)
{
    return (iso_point_motion){p, eps, 0};
}

/* The axis whose section is global: that of the largest moment for eps/k > 0, that of the smallest for eps/k < 0. If
 * several moments are equal it is the first of them. There W^2 = |gamma'|^2 + (2 eps/k) q^(-1-1/k) (J_a - q), and
 * both terms are 0 or more wherever the point can be. Both are 0 only at rest on axis a. So every orbit crosses the
 * section for ever, except the rotation in the plane gamma_a = 0 and, where E = V on axis a, the orbits that come to
 * rest there; and no orbit only touches it. */
int iso_section_axis(iso_point_motion m);

/* The crossing at (l, x), as a point (M, gamma) on H = E. |x| <= 1. */
void iso_section_point(iso_point_motion m, int axis, double l, double x, double point[ISO_STATE]);

/* The chart of a crossing (M, gamma). l is the angle of (gamma_b, gamma_c), so it keeps its digits where |x| is near
 * 1; x is M_a/|M|. Small errors of gamma_a do not matter. */
void iso_section_chart(int axis, const double point[ISO_STATE], double *l, double *x);

#endif
