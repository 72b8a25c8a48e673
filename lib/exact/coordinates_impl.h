/* coordinates_impl.h - separated coordinates of the point, and the constant of separation.
 *
 *     iso_conical at;
 *     double excess[3];
 *     iso_separation_coordinates(&problem.p, point, &at);         (M, gamma) -> angles of u and v, and back
 *     iso_separation_point(&problem.p, &at, point);
 *     double c = iso_separation_constant(&problem, &at, excess);  excess[1] > 0: u librates, < 0: v librates
 *
 * u <= v are the coordinates of gamma (model/conical_impl.h) in b = 1/J for k = 1, where they are 1/mu and 1/lam of
 * the ball (section 3 of the paper), and in b = J for other k. The problem separates in them at k = -1 and at k = 1,
 * H = 0. Their momenta p_u, p_v in s are infinite where u or v meets a b. Those of the angles are finite, p_phi = p_u
 * du/dphi = length1 speed1 and p_psi = p_v dv/dpsi = length2 speed2 of iso_conical:
 *
 *     2 A(u) p_u^2 = -(b3 - u) p_phi^2/2,   2 A(v) p_v^2 = (v - b1) p_psi^2/2,   A(z) = (b1 - z)(b2 - z)(b3 - z).
 *
 * At an umbilic, u = b2 = v, they vanish, and the direction of M is in the speeds alone.
 */
#ifndef ISO_EXACT_COORDINATES_IMPL_H
#define ISO_EXACT_COORDINATES_IMPL_H

#include "model/conical_impl.h"
#include "model/system.h"

/* Both ways between (M, gamma), |gamma| = 1, (M,gamma) = 0, and the coordinates nothing is lost but rounding: some
 * units in the last place of each component of gamma, and of |M|. At k = 1 they are those of 1/J as rounded. */
void iso_separation_coordinates(const iso_params *p, const double point[ISO_STATE], iso_conical *c);
void iso_separation_point(const iso_params *p, const iso_conical *c, double point[ISO_STATE]);

/* The constant of 2 A(z) p_z^2 = R(z) + c, z = u and v of a point on the level H = problem->energy with coupling eps:
 *
 *     k = -1:  R(z) = eps z (b1 + b2 + b3 - z) + H z,        k = 1, H = 0:  R(z) = -eps b1 b2 b3/z.
 *
 * `excess` (may be NULL) are the three R(b_j) + c, computed without the cancellation of that sum. They are how far c
 * is above its values of bifurcation. excess[0] <= 0 always. excess[1] = 0 is the separatrix. Where excess[1] > 0,
 * R + c has a root between b1 and b2, and u librates below it. Where excess[1] < 0, it has one between b2 and b3, and
 * v librates above it. For other k and levels all four numbers are NaN. */
double iso_separation_constant(const iso_problem *problem, const iso_conical *at, double excess[3]);

/* A value of c at which the motion changes its kind. */
typedef struct iso_bifurcation {
    double c;
    double z;        /* the root of R + c, simple at a moment or double between two                             */
    int axis;        /* z is the moment of this axis: orbits in the plane gamma_axis = 0; -1 at a double root   */
    bool separatrix; /* those orbits are unstable, c may be on both sides; else c ends there                   */
} iso_bifurcation;

enum { ISO_MOST_BIFURCATIONS = 4 };

/* All of them for problem->p, eps > 0 and energy, c descending; returns their number, 0 for other k and levels and
 * where no motion has this energy. Equal moments give one. */
int iso_bifurcations(const iso_problem *problem, iso_bifurcation list[ISO_MOST_BIFURCATIONS]);

#endif
