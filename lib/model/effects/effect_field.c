/* effect_field.c - a potential that is fixed in the body, U(n) = (n,Cn)/2 + (l,n), as magnets in the ball have it.
 *
 *     MQ = k n x dU/dn = k n x (C n + l)
 *
 * Its image on the point (section 5 of the paper) is V = U/G with 1/G = (det J/k^2) q^(-1/k). With z = J^(1/2) gamma
 * the normal is n = z/sqrt(q), so that
 *
 *     V = (det J/k^2) [ q^a (z,Cz)/2 + q^b (l,z) ],     a = -1/k - 1,   b = -1/k - 1/2
 *     dV/dgamma = (det J/k^2) [ J^(1/2) (q^a C z + q^b l) + (a q^a (z,Cz)/2 + b q^b (l,z))/q 2 J gamma ]
 */
#include <math.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/formula/formula_impl.h"

/* Where its numbers are: C by rows, and l. */
enum { QUADRATIC = 0, LINEAR = 9 };

static const double *quadratic(const iso_problem *f)
{
    return f->effects.number[ISO_FIELD] + QUADRATIC;
}

static const double *linear(const iso_problem *f)
{
    return f->effects.number[ISO_FIELD] + LINEAR;
}

static void motion(iso_formula *F, const iso_problem *f)
{
    const iso_vector n = formula_n(F), C_n = matrix_c(F, constants(F, 9, quadratic(f)), n);
    add_torque(F, constant_k(F), cross_of(F, n, plus_v(F, constants(F, 3, linear(f)), C_n)));
}

static void potential(iso_formula *F, const iso_problem *f)
{
    const iso_vector n = formula_n(F), C_n = matrix_c(F, constants(F, 9, quadratic(f)), n);
    add_energy(F, constant(F, 0.5), dot_of(F, n, C_n));
    add_energy(F, constant(F, 1), dot_c(F, constants(F, 3, linear(f)), n));
}

static void image(iso_formula *F, const iso_problem *f)
{
    const iso_constant C = constants(F, 9, quadratic(f)), l = constants(F, 3, linear(f)), root_J = constant_root_J(F);
    const iso_constant J = constant_J(F), k = constant_k(F), scale = div_c(F, det_of(F, J), mul_c(F, k, k));
    const iso_constant exponent = div_c(F, constant(F, -1), k);
    const iso_constant a = sub_c(F, exponent, constant(F, 1)), b = sub_c(F, exponent, constant(F, 0.5));
    const iso_scalar q = formula_q(F), q_a = power_of(F, q, a), q_b = power_of(F, q, b);
    const iso_vector z = by_c(F, root_J, formula_gamma(F)), C_z = matrix_c(F, C, z);
    const iso_scalar P = times_c(F, constant(F, 0.5), dot_of(F, z, C_z)), L = dot_c(F, l, z);
    const iso_scalar V_P = mul(F, q_a, P), V_L = mul(F, q_b, L);
    const iso_scalar along = quotient_of(F, add(F, times_c(F, a, V_P), times_c(F, b, V_L)), q);
    const iso_vector push = by_c(F, root_J, add_v(F, scale_v(F, q_a, C_z), scale_c(F, q_b, l)));
    const iso_vector twice_J_gamma = times_v(F, constant(F, 2), by_c(F, J, formula_gamma(F)));
    add_potential(F, scale, V_P);
    add_potential(F, scale, V_L);
    add_gradient(F, scale, add_v(F, push, scale_v(F, along, twice_J_gamma)));
}

static double strength(const iso_problem *f, const double y[])
{
    double most = largest(linear(f));
    (void)y;
    for (int i = 0; i < 9; i++) most = fmax(most, fabs(quadratic(f)[i]));
    return most;
}

/* Symmetric about an axis: C = diag with two equal entries, l along the axis. */
static bool is_symmetric(const iso_problem *f, int axis)
{
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    const double *C = quadratic(f), *l = linear(f);
    return C[4 * j] == C[4 * k] && C[3 * j + k] == 0 && C[3 * axis + j] == 0 && C[3 * axis + k] == 0 && l[j] == 0 &&
           l[k] == 0;
}

static bool keeps(const iso_problem *f, iso_additional integral)
{
    return integral >= ISO_F_AXIS1 && is_symmetric(f, (int)integral - ISO_F_AXIS1);
}

/* Makes the matrix exactly symmetric, and refuses a potential that is constant on the sphere. */
static iso_status check(iso_context *ctx, const iso_params *p, const double n[3], iso_effects *e)
{
    double *C = e->number[ISO_FIELD] + QUADRATIC, most = 0, varies = largest(e->number[ISO_FIELD] + LINEAR);
    (void)p, (void)n;
    for (int i = 0; i < 9; i++) most = fmax(most, fabs(C[i]));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++) {
            if (!(fabs(C[3 * i + j] - C[3 * j + i]) <= 1e-12 * most))
                return ISO_FAIL_INPUT(ctx, "quadratic",
                                      "the matrix of a quadratic form is symmetric: C%d%d = %s is not C%d%d = %s",
                                      i + 1, j + 1, ISO_SHORT(C[3 * i + j]), j + 1, i + 1, ISO_SHORT(C[3 * j + i]));
            C[3 * j + i] = C[3 * i + j];
            varies = fmax(varies, fmax(fabs(C[3 * i + j]), fabs(C[4 * i] - C[4 * j])));
        }
    if (varies > 0 && varies < 1e-10 * most)
        return ISO_FAIL_INPUT(ctx, "quadratic",
                              "all but %.1g of this matrix is a constant on the unit sphere, which does nothing but "
                              "cost digits: subtract it from the diagonal",
                              varies / most);
    if (varies > 0) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "field",
                          "this potential is a constant on the unit sphere and changes nothing: take it out");
}

static iso_status complete(iso_context *ctx, const iso_params *p, int model, double number[],
                           bool (*given)(const void *scene, const char *key), const void *scene)
{
    (void)p, (void)model, (void)number;
    if (given(scene, "quadratic") || given(scene, "linear")) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "field", "missing 'quadratic' or 'linear' in 'field'");
}

static const iso_effect_number numbers[] = {
    {.name = "quadratic", .at = QUADRATIC, .count = 9, .dimension = {1, 0, 2}},
    {.name = "linear", .at = LINEAR, .count = 3, .dimension = {1, 0, 2}},
    {0},
};

const iso_effect iso_effect_field = {
    .name = "field",
    .doc = "body-fixed potential U = (n,Cn)/2 + (l,n): torque k n x dU/dn",
    .work = iso_no_work,
    .keeps = keeps,
    .numbers = numbers,
    .complete = complete,
    .check = check,
    .motion = motion,
    .potential = potential,
    .image = image,
    .strength = strength,
};
