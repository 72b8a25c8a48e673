/* effect_level.c - the potential that gives the twin of a point at any energy (section 5 of theory).
 *
 *     U = -c g^(-1/k),  g = (n, J^-1 n):     MQ = k n x dU/dn = 2 c g^(-1/k - 1) n x J^-1 n
 *
 * On the point U/G = -c det J/k^2 is a constant, which makes no force. The point's equations stay the same, but its
 * orbit is on the level H = c det J/k^2, not on H = 0. That level is the problem's `energy`. With three equal moments
 * U is a constant as well: the ball moves as a free one, and still its point has this H.
 */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/formula/formula_impl.h"

static double c_of(const iso_problem *f)
{
    return f->effects.number[ISO_LEVEL][0];
}

/* -1/k */
static iso_constant exponent(iso_formula *F)
{
    return div_c(F, constant(F, -1), constant_k(F));
}

static void motion(iso_formula *F, const iso_problem *f)
{
    const iso_scalar power = power_of(F, formula_g(F), sub_c(F, exponent(F), constant(F, 1)));
    const iso_vector n_u = cross_of(F, formula_n(F), formula_u(F));
    add_torque(F, constant(F, 2 * c_of(f)), scale_v(F, power, n_u));
}

static void potential(iso_formula *F, const iso_problem *f)
{
    add_energy(F, constant(F, -c_of(f)), power_of(F, formula_g(F), exponent(F)));
}

static double strength(const iso_problem *f, const double y[])
{
    return fabs(c_of(f)) * pow(dot_diag(y + 3, f->p.inv_J, y + 3), -1 / f->p.k);
}

static bool reversible(const iso_problem *f, const double sign[3])
{
    (void)f, (void)sign;
    return true;
}

static bool keeps(const iso_problem *f, iso_additional integral)
{
    (void)f, (void)integral;
    return true;
}

/* c follows from the energy of a point, not from that of a ball. */
static iso_status complete(iso_context *ctx, const iso_params *p, int model, double number[],
                           bool (*given)(const void *scene, const char *key), const void *scene)
{
    (void)p, (void)number;
    if (model != 0 || given(scene, "c")) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "level", "missing 'c' in 'level': a ball's energy does not tell it");
}

static const double unknown[] = {NAN};

static const iso_effect_number numbers[] = {
    {.name = "c", .count = 1, .dimension = {1, -2, 2}, .kind = ISO_NUMBER_NOT_ZERO, .initially = unknown},
    {0},
};

const iso_effect iso_effect_level = {
    .name = "level",
    .doc = "potential U = -c (n,J^-1 n)^(-1/k): the ball of a point at the energy H = c det J/k^2",
    .work = iso_no_work,
    .keeps = keeps,
    .reversible = reversible,
    .numbers = numbers,
    .complete = complete,
    .motion = motion,
    .potential = potential,
    .strength = strength,
};
