/* formula_values.c - computes the values of a formula at one state, in doubles: torques, rates, energies. */
#include "model/series/double_impl.h"

#define LANES 1
#define ROUND_POWERS_ONCE /* splittings add up a rounding error of each kick, without end */

enum { KEPT = 2 }; /* coefficients of each series: the value, and of a state the rate */

#include "model/formula/formula_lines_impl.h"
#include "model/series/evaluate_impl.h"

typedef struct values {
    real scalar[ISO_FORMULA_SCALARS * KEPT];
    vector vector[ISO_FORMULA_VECTORS * KEPT];
    vector torque, gradient;
    real potential, magnetic;
    nodes nodes;
} values;

static const real one[] = {0, 1};

static vector vector_at(const double x[3])
{
    return (vector){{x[0], x[1], x[2]}};
}

/* Sets what is given at y, and the states. `point`: y is (M, gamma), not (omega, n). */
static void set_given(values *v, const iso_formula *F, const iso_params *p, const double y[], bool point)
{
    const vector n = vector_at(y + 3),
                 u = vector_at((const double[]){n.at[0] / p->J[0], n.at[1] / p->J[1], n.at[2] / p->J[2]});
    v->vector[ISO_GIVEN_OMEGA * KEPT] = vector_at(y);
    v->vector[ISO_GIVEN_N * KEPT] = n;
    v->vector[ISO_GIVEN_U * KEPT] = u;
    v->scalar[ISO_GIVEN_BASE * KEPT] = point ? total(by(n, by(vector_at(p->J), n))) : total(by(n, u));
    v->scalar[ISO_GIVEN_SPIN * KEPT] = total(by(vector_at(y), n));
    for (int i = 0; i < F->states; i++)
        if (F->state[i].is_vector)
            v->vector[F->state[i].node * KEPT] = vector_at(y + F->state[i].at);
        else
            v->scalar[F->state[i].node * KEPT] = y[F->state[i].at];
    v->torque = v->gradient = nought;
    v->potential = v->magnetic = 0;
    v->nodes = (nodes){.kept = KEPT,
                       .c = F->value,
                       .scalar = v->scalar,
                       .vector = v->vector,
                       .count = one,
                       .inverse = one,
                       .torque = &v->torque,
                       .gradient = &v->gradient,
                       .potential = &v->potential,
                       .magnetic = &v->magnetic};
}

/* Sets the rates in dy: those of late lines, or those of all others. */
static void get_rates(const values *v, const iso_formula *F, bool late, double dy[])
{
    for (int s = 0; s < F->states; s++) {
        const int node = F->state[s].node;
        const bool is_vector = F->state[s].is_vector;
        double *rate = dy + F->state[s].at;
        for (int i = 0; i < F->lines; i++) {
            const iso_formula_line *l = &F->line[i];
            if (F->late_line[i] != late || l->to != node) continue;
            for (int j = 0; is_vector && l->operation == ISO_R_VECTOR_RATE && j < 3; j++)
                rate[j] = v->vector[node * KEPT + 1].at[j];
            if (!is_vector && l->operation == ISO_R_SCALAR_RATE) *rate = v->scalar[node * KEPT + 1];
        }
    }
}

void iso_formula_rates(const iso_formula *F, const iso_params *p, const double y[], double T[3], double dy[])
{
    values v;
    set_given(&v, F, p, y, false);
    evaluate(F, &v.nodes, false, 0, 0);
    for (int i = 0; i < 3; i++) T[i] += v.torque.at[i];
    get_rates(&v, F, false, dy);
}

void iso_formula_late_rates(const iso_formula *F, const iso_params *p, const double y[], double dy[])
{
    values v;
    set_given(&v, F, p, y, false);
    v.vector[ISO_GIVEN_OMEGA_DOT * KEPT] = vector_at(dy);
    evaluate(F, &v.nodes, false, 0, 0);
    evaluate(F, &v.nodes, true, 0, 0);
    get_rates(&v, F, true, dy);
}

double iso_formula_energy(const iso_formula *F, const iso_params *p, const double y[])
{
    values v;
    set_given(&v, F, p, y, false);
    evaluate(F, &v.nodes, false, 0, 0);
    return v.potential;
}

iso_image iso_formula_image(const iso_formula *F, const iso_params *p, const double y[])
{
    values v;
    set_given(&v, F, p, y, true);
    evaluate(F, &v.nodes, false, 0, 0);
    return (iso_image){v.potential, {v.gradient.at[0], v.gradient.at[1], v.gradient.at[2]}, v.magnetic};
}

void iso_formula_finish(iso_formula *F, const iso_params *p)
{
    if (F->overrun || F->wrong) { /* some lines point at places that are not there */
        F->constants = F->lines = F->states = 0;
        F->late = F->torques = F->magnetic = false;
    }
    iso_formula_shorten(F);
    find_constants(F, p, F->value);
}
