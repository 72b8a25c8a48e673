/* effect_rotor.c - a rotor that turns evenly in the ball: a gyrostat. Its angular momentum K is fixed in the body.
 *
 *     J w' = (J w + K) x w + lambda n:     MQ = K x w,  which does no work
 *
 * On the point it is a magnetic field normal to the sphere, for every k and J (section 7 of lib/doc/theory.md):
 *
 *     M' = gamma x dV/dgamma + B gamma',     B = (sqrt(det J)/k^2) q^(-1 - 1/(2k)) (J^(1/2) K, gamma)
 *
 * V stays, and with it the level of H, the chart of sections, the map and the clocks. On H = 0 these are integrals
 * (L = J w + K, and on the point its image):
 *
 *     k = 1                      |L x n|^2,    since (L x n)' = (L x n) x w
 *     J_b = J_c, K along axis a  rho^(1/k) w_a + K_a (rho^(1/k) - J_b^(-1/(2k)))/(J_a - J_b),    rho^2 = g = 1/q
 *     J = c 1                    c (K,w) - (K,n)^2/(2k)                                          Demchenko's case
 *
 * The second is the momentum M_a of the point and the flux of B through the cap of the sphere about the axis: M_a' =
 * B gamma_a', with B a function of gamma_a alone. It and the third hold on every level. The first does not: on another
 * level (K, n x J^-1 n) remains of its change.
 */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/formula/formula_impl.h"
#include "model/integrals_impl.h"

static const double *momentum(const iso_problem *f)
{
    return f->effects.number[ISO_ROTOR];
}

/* K x omega, as a matrix times omega */
static void motion(iso_formula *F, const iso_problem *f)
{
    const double *K = momentum(f), cross_K[9] = {0, -K[2], K[1], K[2], 0, -K[0], -K[1], K[0], 0};
    add_torque(F, constant(F, 1), matrix_c(F, constants(F, 9, cross_K), formula_omega(F)));
}

static void image(iso_formula *F, const iso_problem *f)
{
    const iso_constant k = constant_k(F), det_J = det_of(F, constant_J(F));
    const iso_constant factor = div_c(F, function_c(F, ISO_C_ROOT, det_J, det_J), mul_c(F, k, k));
    const iso_constant power = sub_c(F, constant(F, -1), div_c(F, constant(F, 0.5), k));
    const iso_vector z = by_c(F, constant_root_J(F), formula_gamma(F));
    const iso_scalar along = dot_c(F, constants(F, 3, momentum(f)), z);
    add_magnetic(F, factor, mul(F, power_of(F, formula_q(F), power), along));
}

/* Backwards in time the rotor turns the other way: R K = -det R K. */
static bool reversible(const iso_problem *f, const double sign[3])
{
    const double turned = -sign[0] * sign[1] * sign[2];
    bool holds = true;
    for (int i = 0; i < 3; i++) holds = holds && (momentum(f)[i] == 0 || sign[i] == turned);
    return holds;
}

/* --- integrals -------------------------------------------------------------------------------------------------- */

/* Whether the other effects keep an integral. Those of the free ball change; the row has its own instead. */
static bool others_keep(const iso_problem *f, iso_additional integral)
{
    iso_problem others = *f;
    others.effects.on[ISO_ROTOR] = false;
    return iso_effects_keep(&others, integral);
}

static bool holds_momentum_plane(const iso_problem *f)
{
    return f->p.k == 1 && others_keep(f, ISO_F_PLANE) && !iso_effects_have_level(&f->effects);
}

static double of_plane(const iso_problem *f, const double ball[], double *size)
{
    double L[3], across[3];
    diag(f->p.J, ball, L);
    *size = dot(L, L) + dot(momentum(f), momentum(f));
    add_scaled(L, 1, momentum(f));
    cross(L, ball + 3, across);
    return dot(across, across);
}

/* K is along the axis. */
static bool holds_about(const iso_problem *f, int axis)
{
    const double *K = momentum(f);
    return iso_params_symmetric(&f->p, axis) && K[(axis + 1) % 3] == 0 && K[(axis + 2) % 3] == 0 &&
           others_keep(f, (iso_additional)(ISO_F_AXIS1 + axis));
}

/* x = (J_a - J_b)/J_b gamma_a^2: q = J_b (1 + x). The difference of two powers keeps its digits for nearly equal
 * moments; at J_a = J_b it is its limit. */
static double of_axis(const iso_problem *f, const double ball[], int axis, double *size)
{
    const double K = momentum(f)[axis], k = f->p.k, J_b = f->p.J[(axis + 1) % 3], *n = ball + 3;
    const double g = dot_diag(n, f->p.inv_J, n), gamma = n[axis] / f->p.root_J[axis] / sqrt(g);
    const double relative = (f->p.J[axis] - J_b) / J_b, x = relative * gamma * gamma;
    const double change = x == 0 ? -gamma * gamma / (2 * k) : expm1(-log1p(x) / (2 * k)) / relative;
    const double moving = pow(g, 1 / (2 * k)), flux = K / J_b * pow(J_b, -1 / (2 * k)) * change;
    *size = moving * norm(ball) + fabs(flux);
    return moving * ball[axis] + flux;
}

static bool holds_round(const iso_problem *f)
{
    const bool round = iso_params_symmetric(&f->p, 0) && iso_params_symmetric(&f->p, 1);
    bool keep = round;
    for (int axis = 0; axis < 3; axis++) keep = keep && others_keep(f, (iso_additional)(ISO_F_AXIS1 + axis));
    return keep;
}

static double of_round(const iso_problem *f, const double ball[], double *size)
{
    const double *K = momentum(f), along = dot(K, ball + 3), moving = f->p.J[0] * dot(K, ball);
    *size = f->p.J[0] * norm(K) * norm(ball) + along * along / fabs(2 * f->p.k);
    return moving - along * along / (2 * f->p.k);
}

#define ABOUT_AXIS(i)                                                                                                \
    static bool holds_about##i(const iso_problem *f)                                                                 \
    {                                                                                                                \
        return holds_about(f, i - 1);                                                                                \
    }                                                                                                                \
    ISO_OF_BALL_AND_POINT(axis##i, of_axis(f, ball, i - 1, size))

ISO_OF_BALL_AND_POINT(plane, of_plane(f, ball, size))
ISO_OF_BALL_AND_POINT(all_round, of_round(f, ball, size))
ABOUT_AXIS(1)
ABOUT_AXIS(2)
ABOUT_AXIS(3)

#define AXIS_ROW(i, of, doc_) ISO_INTEGRAL("F_rotor" #i, 0, -1, 1, axis##i##of, .holds = holds_about##i, .doc = doc_)
#define ROWS(of)                                                                                                     \
    {                                                                                                                \
        ISO_INTEGRAL("F_rotor", 2, 0, 2, plane##of, .holds = holds_momentum_plane,                                   \
                     .doc = "((Jw + K) x n)^2, k = 1"),                                                              \
            AXIS_ROW(1, of, "F_axis1 and the flux of the rotor's field, J2 = J3, K along axis 1"),                   \
            AXIS_ROW(2, of, "F_axis2 and the flux of the rotor's field, J3 = J1, K along axis 2"),                   \
            AXIS_ROW(3, of, "F_axis3 and the flux of the rotor's field, J1 = J2, K along axis 3"),                   \
            ISO_INTEGRAL("F_round", 2, 0, 2, all_round##of, .holds = holds_round,                                    \
                         .doc = "J (K,w) - (K,n)^2/(2k), three equal moments"),                                      \
        {                                                                                                            \
            0                                                                                                        \
        }                                                                                                            \
    }
static const iso_integral integrals[] = ROWS(), image_integrals[] = ROWS(_of_point);

static const iso_effect_number numbers[] = {
    {.name = "momentum", .count = 3, .dimension = {1, 0, 1}, .required = true},
    {0},
};

const iso_effect iso_effect_rotor = {
    .name = "rotor",
    .point_name = "magnetic",
    .doc = "a rotor of constant momentum K in the ball: torque K x omega; on the point a magnetic field",
    .work = iso_no_work,
    .numbers = numbers,
    .motion = motion,
    .image = image,
    .reversible = reversible,
    .integrals = integrals,
    .image_integrals = image_integrals,
};
