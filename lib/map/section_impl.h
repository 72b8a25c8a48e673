/* section_impl.h - what the files of the section's chart share, and those of crossings. */
#ifndef ISO_MAP_SECTION_IMPL_H
#define ISO_MAP_SECTION_IMPL_H

#include "map/section.h"

/* |M| where (gamma, J gamma) = q; 0 where the point cannot be */
double iso_section_momentum_at(double k, double eps, double energy, double q);

/* The least and the largest q where the point can be: E + eps q^(-1/k) >= 0. */
void iso_section_range(iso_point_motion m, double q[2]);

/* Whether the point can be on the section at l, and moves there: G(l) > 0. Where it is neither at l = 0 nor at pi/2,
 * it is nowhere on the section. */
bool iso_section_is_open(iso_point_motion m, int axis, double l);

/* Whether a free orbit is the rotation about this axis, in the plane n_axis = 0 itself: at y, which is (omega, n) or
 * (M, gamma), n_axis is 0 up to rounding, and so is its rate. */
bool iso_section_is_rotation(const double y[ISO_STATE], int axis);

/* The derivatives of iso_section_point by l and by x. |x| < 1, G > 0. */
void iso_section_deviations(iso_point_motion m, int axis, double l, double x, double by_l[ISO_STATE],
                            double by_x[ISO_STATE]);

/* slope = (dl, dx) of a deviation (dM, dgamma) of the crossing `point`. The neighbouring orbit starts at
 * point + deviation. It is followed along the flow until it crosses the section, and (l, x) is taken there, all to
 * first order. So a part of the deviation along the flow changes nothing. */
void iso_section_slope(iso_point_motion m, int axis, const double point[ISO_STATE], const double deviation[ISO_STATE],
                       double slope[2]);

/* The closest bounds W[0] <= W <= W[1] for all gamma where the point can be. If W^2 is 0 or less anywhere, W[0] is
 * 0. By Sturm's comparison two successive crossings are at least 2 pi/W[1] and at most 2 pi/W[0] apart
 * in s (infinity for W[0] = 0). The bounds are rounded, and an orbit can reach them: allow a rounding error. */
void iso_section_bounds(iso_point_motion m, int axis, double W[2]);

#endif
