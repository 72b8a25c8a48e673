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
 * first order. So a part of the deviation along the flow changes nothing. rate: (M', gamma') at `point`, by any
 * clock. */
void iso_section_slope(int axis, const double point[ISO_STATE], const double rate[ISO_STATE],
                       const double deviation[ISO_STATE], double slope[2]);

/* The closest bounds W[0] <= W <= W[1] for all gamma where the point can be. If W^2 is 0 or less anywhere, W[0] is
 * 0. By Sturm's comparison two successive crossings are at least 2 pi/W[1] and at most 2 pi/W[0] apart
 * in s (infinity for W[0] = 0). The bounds are rounded, and an orbit can reach them: allow a rounding error. */
void iso_section_bounds(iso_point_motion m, int axis, double W[2]);

/* Whether every orbit crosses the section of `axis` for ever: it is such an axis (of equal moments each one is), or
 * W^2 > 0 wherever the point can be. */
bool iso_section_is_global(iso_point_motion m, int axis);

/* G(l): the largest |L| at l; 0 where the point cannot be. The derivative of the return map in (l, x) has the
 * determinant G(l)/G(l'), where l' is that of the image. */
double iso_section_momentum(iso_point_motion m, int axis, double l);

/* Which reversors the return map of a problem has, S f S = f^-1: bit 0 for S1 (l, x) -> (l, -x), bit 1 for S2 (-l, x),
 * bit 2 for S3 (pi - l, x). Each is the motion backwards in time, in a mirror. The free ball has all of them. */
unsigned iso_section_reversors(const iso_problem *f, int axis);

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
    /* Above 0: point i is the next point of copy i modulo `copies`, which has a random shift of its own. The caller sets
     * it after iso_section_spread_prepare. */
    unsigned copies;
} iso_section_spread;
void iso_section_spread_prepare(iso_section_spread *spread, iso_point_motion m, int axis, uint64_t seed);
void iso_section_spread_point(const iso_section_spread *spread, uint64_t i, double *l, double *x);

/* The energy H of the point for eps = 1, in the units of J, from its level (study/level.h), and back. */
double iso_level_energy(const iso_params *p, double level);
double iso_level_of(const iso_params *p, double energy);

#endif
