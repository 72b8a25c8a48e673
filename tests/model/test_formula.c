/* Formulas (model/formula/formula.h): every operation gives the value it is named for, and one that cannot be
 * computed is refused: no room, omega' where it is not known, states without a rate. */
#include "laws.h"
#include "model/formula/formula_impl.h"

static const double y[ISO_STATE] = {0.3, -0.7, 0.2, 0.36, 0.48, 0.8};
static const double J[3] = {1.4, 2.1, 3.0};

/* The value of the scalar that `write` makes. All numbers here are of order one. */
static void equals(iso_scalar (*write)(iso_formula *F), double wanted, const char *what)
{
    const iso_params p = laws_params(0.5, J);
    iso_formula F;
    iso_formula_begin(&F, ISO_FORMULA_ENERGY, false);
    add_energy(&F, constant(&F, 1), write(&F));
    iso_formula_finish(&F, &p);
    const double value = iso_formula_energy(&F, &p, y);
    gsl_test(F.wrong || F.overrun || !(fabs(value - wanted) <= 1e-14), "%s: %.17g, not %.17g", what, value, wanted);
}

/* --- operations: n = (0.36, 0.48, 0.8), u = J^-1 n, g = (n,u) --------------------------------------------------- */

static const double two_three_five[] = {2, 3, 5}, matrix[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};

static iso_scalar first_of(iso_formula *F, iso_vector v)
{
    return dot_c(F, constants(F, 3, (const double[]){1, 0, 0}), v);
}

static iso_scalar square(iso_formula *F)
{
    return dot_of(F, formula_n(F), formula_n(F));
}

static iso_scalar sums(iso_formula *F)
{
    const iso_scalar one = square(F), five = plus_c(F, constant(F, 4), one);
    return add(F, five, sub(F, one, times_c(F, constant(F, 3), one)));
}

static iso_scalar products(iso_formula *F)
{
    const iso_scalar three = plus_c(F, constant(F, 2), square(F)), four = plus_c(F, constant(F, 3), square(F));
    return power_of(F, quotient_of(F, mul(F, three, three), four), constant(F, 0.5));
}

static iso_scalar of_constants(iso_formula *F)
{
    const iso_constant k = constant_k(F), J1 = constant_J(F), two = add_c(F, k, constant(F, 1.5));
    const iso_constant c = div_c(F, mul_c(F, two, sub_c(F, J1, k)), constant(F, 3));
    return times_c(F, c, square(F));
}

static iso_scalar with_D(iso_formula *F)
{
    return times_c(F, add_c(F, constant_D(F), constant_root_J(F)), square(F));
}

static iso_scalar vector_sums(iso_formula *F)
{
    const iso_vector n = formula_n(F), twice = add_v(F, n, n), thrice = times_v(F, constant(F, 3), n);
    return first_of(F, plus_v(F, constants(F, 3, two_three_five), sub_v(F, twice, thrice)));
}

static iso_scalar vector_products(iso_formula *F)
{
    const iso_vector n = formula_n(F), turned = cross_of(F, n, by_c(F, constants(F, 3, two_three_five), n));
    return first_of(F, scale_v(F, plus_c(F, constant(F, 1), square(F)), turned));
}

static iso_scalar matrices(iso_formula *F)
{
    const iso_vector M_n = matrix_c(F, constants(F, 9, matrix), formula_n(F));
    return first_of(F, add_v(F, M_n, scale_c(F, square(F), constants(F, 3, two_three_five))));
}

static iso_scalar normals(iso_formula *F)
{
    return sub(F, formula_g(F), dot_of(F, formula_n(F), formula_u(F)));
}

static void check_operations(void)
{
    equals(sums, 5 + (1 - 3), "sums");
    equals(products, 1.5, "products, quotients and powers");
    equals(of_constants, 2 * (1.4 - 0.5) / 3, "constants");
    equals(with_D, sqrt(1.4), "D and roots of J");
    equals(vector_sums, 2 - 0.36, "sums of vectors");
    equals(vector_products, 2 * (0.48 * 5 * 0.8 - 0.8 * 3 * 0.48), "products of vectors");
    equals(matrices, 0.36 + 2 * 0.48 + 3 * 0.8 + 2, "matrices");
    equals(normals, 0, "g = (n,u)");
}

/* --- what is refused -------------------------------------------------------------------------------------------- */

enum { CONSTANTS, SCALARS, VECTORS, LINES, STATES, LATE, OMEGA, U, STATE };

/* Writes something that cannot be computed. */
static void write_wrong(iso_formula *F, int what)
{
    const int most[] = {ISO_FORMULA_CONSTANTS / 3 + 1, ISO_FORMULA_SCALARS, ISO_FORMULA_VECTORS,
                        ISO_FORMULA_LINES + 1, ISO_FORMULA_STATES + 1};
    for (int i = 0; what <= STATES && i < most[what]; i++) {
        if (what == CONSTANTS) constant_J(F);
        if (what == SCALARS) add(F, formula_g(F), formula_g(F));
        if (what == VECTORS) add_v(F, formula_n(F), formula_n(F));
        if (what == LINES) add_torque(F, constant_k(F), formula_n(F));
        if (what == STATES) scalar_state(F, ISO_STATE + i);
    }
    if (what == LATE) add_torque(F, constant(F, 1), cross_of(F, formula_n(F), formula_omega_dot(F)));
    if (what == OMEGA) add_energy(F, constant(F, 1), dot_of(F, formula_omega(F), formula_n(F)));
    if (what == U) add_potential(F, constant(F, 1), dot_of(F, formula_u(F), formula_gamma(F)));
    if (what == STATE) add_torque(F, constant(F, 1), vector_state(F, 0));
}

/* The formula must say that it cannot be computed, and be empty. */
static void check_refusals(void)
{
    static const struct {
        iso_formula_kind kind;
        int what;
        const char *words;
    } cases[] = {{ISO_FORMULA_MOTION, CONSTANTS, "too many constants"},
                 {ISO_FORMULA_MOTION, SCALARS, "too many scalars"},
                 {ISO_FORMULA_MOTION, VECTORS, "too many vectors"},
                 {ISO_FORMULA_MOTION, LINES, "too many lines"},
                 {ISO_FORMULA_MOTION, STATES, "too many states"},
                 {ISO_FORMULA_MOTION, LATE, "a torque that depends on omega'"},
                 {ISO_FORMULA_ENERGY, OMEGA, "an energy that depends on omega"},
                 {ISO_FORMULA_IMAGE, U, "an image that depends on J^-1 n"},
                 {ISO_FORMULA_IMAGE, STATE, "an image that depends on a state"},
                 {ISO_FORMULA_MOTION, STATE, "a state that is not there"}};
    const iso_params p = laws_params(0.5, J);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        iso_formula F;
        iso_formula_begin(&F, cases[i].kind, false);
        write_wrong(&F, cases[i].what);
        iso_formula_finish(&F, &p);
        gsl_test(!(F.wrong || F.overrun) || F.lines > 0 || F.constants > 0, "%s", cases[i].words);
    }
}

int main(void)
{
    check_operations();
    check_refusals();
    exit(gsl_test_summary());
}
