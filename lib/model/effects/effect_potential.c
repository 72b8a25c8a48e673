/* effect_potential.c - a potential U(n) as the scene writes it, fixed in the body.
 *
 *     MQ = k n x dU/dn,     on the point V = U/G,  1/G = (det J/k^2) q^(-1/k)
 *
 * With g = dU/dn, z = J^(1/2) gamma and n = z/sqrt(q) the slope of V is
 *
 *     dV/dgamma = (det J/k^2) [ q^(-1/k - 1/2) J^(1/2) g - q^(-1/k - 1) ((n,g) + (2/k) U) J gamma ]
 *
 * The text is read anew whenever the formulas of an orbit are written.
 */
#include <math.h>

#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "model/expression/written_impl.h"

static void motion(iso_formula *F, const iso_problem *f)
{
    iso_writer w;
    iso_scalar U, along;
    iso_vector g;
    if (!iso_writer_begin(&w, F, f, ISO_POTENTIAL, 0, formula_n(F))) return;
    iso_writer_slope(&w, &U, &g, &along);
    add_torque(F, mul_c(F, constant_k(F), iso_writer_over_energy(&w)), cross_of(F, formula_n(F), g));
}

static void potential(iso_formula *F, const iso_problem *f)
{
    iso_writer w;
    if (!iso_writer_begin(&w, F, f, ISO_POTENTIAL, 0, formula_n(F))) return;
    const iso_scalar U = iso_writer_value(&w);
    add_energy(F, iso_writer_over_energy(&w), U);
}

static void image(iso_formula *F, const iso_problem *f)
{
    iso_writer w;
    iso_scalar U, along;
    iso_vector g;
    const iso_constant J = constant_J(F), root_J = constant_root_J(F), k = constant_k(F);
    const iso_scalar q = formula_q(F), over_root = power_of(F, q, constant(F, -0.5)),
                     power = power_of(F, q, div_c(F, constant(F, -1), k));
    const iso_vector n = scale_v(F, over_root, by_c(F, root_J, formula_gamma(F)));
    if (!iso_writer_begin(&w, F, f, ISO_POTENTIAL, 0, n)) return;
    iso_writer_slope(&w, &U, &g, &along);
    const iso_constant over_G = div_c(F, det_of(F, J), mul_c(F, k, k));
    const iso_constant scale = mul_c(F, iso_writer_over_energy(&w), over_G); /* one unit of energy in the caller's */
    const iso_scalar falling = add(F, along, times_c(F, div_c(F, constant(F, 2), k), U));
    const iso_vector push = scale_v(F, mul(F, power, over_root), by_c(F, root_J, g));
    const iso_vector back = scale_v(F, quotient_of(F, mul(F, power, falling), q), by_c(F, J, formula_gamma(F)));
    add_potential(F, scale, mul(F, power, U));
    add_gradient(F, scale, sub_v(F, push, back));
}

static double strength(const iso_problem *f, const double y[])
{
    (void)y;
    return f->effects.number[ISO_POTENTIAL][ISO_WRITTEN_STRENGTH];
}

/* The largest finite change of U from that at y to one in a random direction. A constant in U moves nothing. */
static double largest_change(const iso_formula *F, const iso_params *p, const double start[])
{
    const double first = iso_formula_energy(F, p, start);
    iso_random *r = iso_random_create(1);
    double y[ISO_STATE] = {0}, most = 0;
    for (int i = 0; r && i < 64; i++) {
        iso_random_direction(r, y + 3);
        const double change = fabs(iso_formula_energy(F, p, y) - first);
        if (isfinite(change)) most = fmax(most, change);
    }
    iso_random_free(r);
    return most;
}

static iso_status check(iso_context *ctx, const iso_params *p, const double n[3], iso_effects *effects)
{
    const iso_problem f = {.p = *p, .effects = *effects};
    const double y[ISO_STATE] = {0, 0, 0, n[0], n[1], n[2]};
    iso_expression e;
    iso_formula F;
    ISO_TRY(iso_written_check(ctx, p, effects, ISO_POTENTIAL, 0, &e));
    if (e.node[e.root].degree == ISO_CONSTANT)
        return ISO_FAIL_INPUT(ctx, "U", "U does not depend on n, and changes nothing: take the effect out");
    iso_formula_begin(&F, ISO_FORMULA_ENERGY, false);
    potential(&F, &f);
    iso_formula_finish(&F, p);
    if (F.overrun) return ISO_OK; /* the model is refused */
    effects->number[ISO_POTENTIAL][ISO_WRITTEN_STRENGTH] = largest_change(&F, p, y);
    return ISO_OK;
}

static const char *const expressions[] = {"U", NULL};

static const iso_effect_number numbers[] = {ISO_WRITTEN_NUMBERS, {0}};

const iso_effect iso_effect_potential = {
    .name = "potential",
    .doc = "a potential U(n) as the scene writes it: torque k n x dU/dn",
    .work = iso_no_work,
    .expressions = expressions,
    .written = 0,
    .numbers = numbers,
    .check = check,
    .motion = motion,
    .potential = potential,
    .image = image,
    .strength = strength,
};
