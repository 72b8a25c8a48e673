/* effect_twist.c - a contact that can twist: it resists with the torque lambda n = -c (w,n) n.
 *
 *     K = J w - D (w,n) n,     K' = K x w - c (w,n) n + MQ,     D = m b^2
 *
 * The spin (w,n) is free. c -> infinity is the rubber ball, c = 0 the classical Chaplygin ball with the further
 * integral (K,K), and at k = -1 also (A K,n), A = tr J - 2 J. The energy is (K,w)/2. The equations are solved for w'
 * in contact.c.
 *
 * A stiff contact (large c) takes the spin out in a time of order 1/c, until a part of order 1/c is left. Then -c
 * (w,n) is a large number times a small one, which is nearly lost in the rounding of w. Also, the direction in which
 * the equations are stiff is n, which turns with the motion. Both end when the torque is a state of its own:
 *
 *     lambda' = -c (w',n),     (w,n) = -lambda/c restored after each step           since (w,n') = 0
 *
 * Then one component of the state is stiff, and implicit methods solve it well: bdf needs as many steps at c = 1e8 as
 * at 1e2. Series use lambda = -c (w,n) directly.
 */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/contact_impl.h"
#include "model/effects/effects_impl.h"
#include "model/formula/formula_impl.h"
#include "model/integrals_impl.h"

static double c_of(const iso_problem *f)
{
    return f->effects.number[ISO_TWIST][0];
}

/* (w,n)' = -c (n, A^-1 n) (w,n) + ..., A = J - D n n^T: spin dies away at the rate c g/(1 - D g), g = (n, J^-1 n) */
static double stiffness(const iso_problem *f)
{
    const double g = 1 / min3(f->p.J);
    return c_of(f) * g / (1 - f->p.D * g) / fmax(1, fabs(f->p.k));
}

static bool is_stiff(const iso_problem *f)
{
    return stiffness(f) > ISO_STIFF;
}

static void motion(iso_formula *F, const iso_problem *f)
{
    const iso_vector n = formula_n(F);
    if (c_of(f) == 0) return; /* the classical ball twists freely */
    const iso_constant resistance = constant(F, -c_of(f));
    if (F->series || !is_stiff(f)) {
        add_torque(F, resistance, scale_v(F, formula_spin(F), n));
        return;
    }
    const iso_scalar lambda = scalar_state(F, f->at[ISO_TWIST]);
    add_torque(F, constant(F, 1), scale_v(F, lambda, n));
    set_rate(F, lambda, resistance, dot_of(F, formula_omega_dot(F), n));
}

/* lambda, which omega and n give at any time */
static void begin(const iso_problem *f, double y[])
{
    if (f->at[ISO_TWIST] > 0) y[f->at[ISO_TWIST]] = -c_of(f) * dot(y, y + 3);
}

/* That of the torques of the motion, (Jw,w), or of other resistance, which are more when little motion is left. */
static void size(const iso_problem *f, const double y[], double size[])
{
    iso_problem others = *f;
    others.effects.on[ISO_TWIST] = false;
    const double resists = iso_effects_stiffness(&others) * min3(f->p.J);
    const double moves = dot_diag(y, f->p.J, y) + resists * largest(y);
    size[f->at[ISO_TWIST]] = fmax(fabs(y[f->at[ISO_TWIST]]) + moves, ISO_REST);
}

static double restore(const iso_problem *f, double y[])
{
    if (f->at[ISO_TWIST] == 0) return 0;
    const double length = norm(y + 3), speed = norm(y); /* n is made a unit vector after this */
    const double error = dot(y, y + 3) / length + y[f->at[ISO_TWIST]] / c_of(f);
    add_scaled(y, -error / length, y + 3);
    return speed > 0 ? fabs(error) / speed : 0;
}

static iso_work work(const iso_problem *f)
{
    return c_of(f) > 0 ? ISO_WORK_LOST : ISO_WORK_NONE;
}

/* On a plane the torque along n leaves Jw x n alone; a level's part of F_plane changes with it. */
static bool keeps(const iso_problem *f, iso_additional integral)
{
    return integral == ISO_F_PLANE && !iso_effects_have_level(&f->effects);
}

/* --- integrals of the classical ball, whose momentum about the contact stands still in space -------------------- */

/* K, and the size of its terms */
static double momentum(const iso_problem *f, const double y[], double K[3])
{
    double Jw[3];
    diag(f->p.J, y, Jw);
    contact_momentum(&f->p, y, K);
    return norm(Jw);
}

static double momentum_square(const iso_problem *f, const double y[], double *value_size)
{
    double K[3];
    const double size = momentum(f, y, K);
    *value_size = size * size;
    return dot(K, K);
}

static double momentum_normal(const iso_problem *f, const double y[], double *value_size)
{
    double K[3];
    *value_size = momentum(f, y, K);
    return dot(K, y + 3);
}

static double momentum_up(const iso_problem *f, const double y[], double *value_size)
{
    double K[3];
    *value_size = momentum(f, y, K);
    return dot(K, iso_vertical(f, y));
}

/* A = tr J - 2 J = diag(J2 + J3 - J1, J3 + J1 - J2, J1 + J2 - J3), which is positive for a solid body */
static double momentum_turned(const iso_problem *f, const double y[], double *value_size)
{
    const double trace = f->p.J[0] + f->p.J[1] + f->p.J[2], *n = y + 3;
    double K[3], A[3];
    const double size = momentum(f, y, K);
    for (int i = 0; i < 3; i++) A[i] = trace - 2 * f->p.J[i];
    *value_size = size * largest(A);
    return dot_diag(K, A, n);
}

/* No torque acts, or only the weight's. */
static bool is_classical(const iso_problem *f)
{
    iso_effects others = iso_effects_acting(&f->effects);
    others.on[ISO_TWIST] = others.on[ISO_GRAVITY] = false;
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (others.on[e]) return false;
    return c_of(f) == 0;
}

static bool keeps_square(const iso_problem *f)
{
    return is_classical(f) && !iso_effect_acts(&f->effects, ISO_GRAVITY);
}

/* (K,n)' = (MQ,n) where k = 1: the torques of potentials are orthogonal to n. */
static bool keeps_normal(const iso_problem *f)
{
    bool orthogonal = true;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        if (e != ISO_TWIST && iso_effect_acts(&f->effects, e))
            orthogonal = orthogonal && iso_effect_list[e]->potential;
    return f->p.k == 1 && c_of(f) == 0 && orthogonal;
}

/* At k = -1, n' = w x n. (A K,n)' = (A (K x w),n) + (A K,w x n) = (n,K,(tr A - A) w) = 2 (n,K,J w) = 2 (n,K,K) = 0:
 * J w is K and a part along n. */
static bool keeps_turned(const iso_problem *f)
{
    return f->p.k == -1 && keeps_square(f);
}

static bool keeps_up(const iso_problem *f)
{
    return is_classical(f) && f->effects.on[ISO_GRAVITY];
}

static const iso_integral integrals[] = {
    ISO_INTEGRAL("K.K", 2, 0, 2, momentum_square, .holds = keeps_square,
                 .doc = "(K,K), K = J w - D (w,n) n, momentum about the contact; c = 0 and no torque"),
    ISO_INTEGRAL("K.n", 1, 0, 1, momentum_normal, .holds = keeps_normal,
                 .doc = "(K,n), k = 1, c = 0 and no rolling resistance"),
    ISO_INTEGRAL("AK.n", 2, 0, 1, momentum_turned, .holds = keeps_turned,
                 .doc = "(A K,n), A = J1 + J2 + J3 - 2 J, k = -1, c = 0 and no torque"),
    ISO_INTEGRAL("K.e", 1, 0, 1, momentum_up, .holds = keeps_up,
                 .doc = "(K,e), c = 0 and no torque but the weight's"),
    {0},
};

static const iso_effect_number numbers[] = {
    {.name = "resistance", .count = 1, .dimension = {1, 0, 1}, .kind = ISO_NUMBER_NOT_NEGATIVE, .required = true},
    {0},
};

static const char *const state_names[] = {"lambda"};

static const iso_effect_state states[] = {
    {.name = state_names, .count = 1, .kind = ISO_STATE_DERIVED, .there = is_stiff},
    {0},
};

const iso_effect iso_effect_twist = {
    .name = "twist",
    .doc = "finite resistance of the contact against twisting: torque -c (omega,n) n; c = 0: classical ball",
    .breaks = "the ball is free to twist: (omega,n) is not 0",
    .needs_D = true,
    .twists = true,
    .work = work,
    .keeps = keeps,
    .numbers = numbers,
    .motion = motion,
    .states = states,
    .states_doc = "torque of the contact against twisting, which is stiff",
    .begin = begin,
    .size = size,
    .restore = restore,
    .stiffness = stiffness,
    .integrals = integrals,
};
