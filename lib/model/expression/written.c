/* written.c - writes an expression (expression_impl.h) down as lines of a formula.
 *
 * A part that is a polynomial c + (l,n) + (n,Cn)/2 in n is written with vectors: its slope l + C n then costs no
 * product of series.
 */
#include "model/expression/written_impl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"

/* --- values ----------------------------------------------------------------------------------------------------- */

bool iso_writer_begin(iso_writer *w, iso_formula *F, const iso_problem *f, iso_effect_id id, int which, iso_vector n)
{
    if (!iso_written_read(&f->effects, id, which, &w->e)) return false;
    w->F = F;
    w->number = f->effects.number[id];
    w->n = w->vertical = n;
    w->omega = formula_omega(F);
    w->most = ISO_QUADRATIC;
    w->has_J = false;
    memset(w->has_value, 0, sizeof w->has_value);
    return true;
}

static iso_constant unit(iso_writer *w, int which)
{
    return constant(w->F, w->number[which]);
}

iso_constant iso_writer_over_energy(iso_writer *w)
{
    const iso_constant J = unit(w, ISO_WRITTEN_J), W = unit(w, ISO_WRITTEN_W);
    return div_c(w->F, constant(w->F, 1), mul_c(w->F, J, mul_c(w->F, W, W)));
}

/* J1, J2 or J3 in the caller's units. */
static iso_constant moment(iso_writer *w, int which)
{
    iso_formula *F = w->F;
    if (!w->has_J) {
        const iso_constant own = constant_J(F), U = unit(w, ISO_WRITTEN_J);
        w->J = mul_c(F, U, own);
        for (int i = 1; i < 3; i++) mul_c(F, U, (iso_constant){own.at + i});
    }
    w->has_J = true;
    return (iso_constant){w->J.at + which};
}

/* One of the three numbers of a vector, times a factor. */
static iso_quantity part_of(iso_writer *w, iso_vector v, int which, double factor)
{
    const double along[3] = {which == 0 ? factor : 0, which == 1 ? factor : 0, which == 2 ? factor : 0};
    return variable_q(dot_c(w->F, constants(w->F, 3, along), v));
}

int iso_writer_exponent(const iso_expression *e, const iso_expression_node *power)
{
    const iso_expression_node *p = &e->node[power->b];
    return p->term == ISO_TERM_NUMBER && p->value >= 1 && p->value <= 64 && p->value == floor(p->value)
               ? (int)p->value
               : 0;
}

static iso_quantity power_value(iso_writer *w, const iso_expression_node *node)
{
    iso_formula *F = w->F;
    const iso_quantity a = iso_writer_value_of(w, node->a);
    const int whole = iso_writer_exponent(&w->e, node);
    if (whole > 0) return power_q(F, a, whole);
    const iso_quantity b = iso_writer_value_of(w, node->b);
    if (is_fixed_q(a) && is_fixed_q(b)) return constant_q(function_c(F, ISO_C_POWER, fixed_q(F, a), fixed_q(F, b)));
    if (is_fixed_q(b)) return variable_q(power_of(F, (iso_scalar){a.at}, fixed_q(F, b)));
    return variable_q(exp_of(F, scalar_q(F, mul_q(F, b, log_q(F, a)))));
}

/* sin or cos; the formula has both of them, and the other one is kept as well, if the text has it. */
static iso_quantity circle_value(iso_writer *w, const iso_expression_node *node)
{
    iso_scalar cosine;
    const iso_scalar sine = sin_of(w->F, scalar_q(w->F, iso_writer_value_of(w, node->a)), &cosine);
    for (int i = 0; i < w->e.nodes; i++) {
        const iso_expression_node *other = &w->e.node[i];
        if ((other->term != ISO_TERM_SIN && other->term != ISO_TERM_COS) || other->a != node->a) continue;
        w->value[i] = variable_q(other->term == ISO_TERM_SIN ? sine : cosine);
        w->has_value[i] = true;
    }
    return variable_q(node->term == ISO_TERM_SIN ? sine : cosine);
}

static iso_quantity function_value(iso_writer *w, const iso_expression_node *node)
{
    static const iso_operation of_constants[] = {[ISO_TERM_SQRT] = ISO_C_ROOT,
                                                 [ISO_TERM_EXP] = ISO_C_EXP,
                                                 [ISO_TERM_LOG] = ISO_C_LOG,
                                                 [ISO_TERM_SIN] = ISO_C_SIN,
                                                 [ISO_TERM_COS] = ISO_C_COS};
    iso_formula *F = w->F;
    if (node->degree == ISO_CONSTANT) {
        const iso_constant c = fixed_q(F, iso_writer_value_of(w, node->a));
        return constant_q(function_c(F, of_constants[node->term], c, c));
    }
    if (node->term == ISO_TERM_SIN || node->term == ISO_TERM_COS) return circle_value(w, node);
    const iso_scalar a = scalar_q(F, iso_writer_value_of(w, node->a));
    if (node->term == ISO_TERM_EXP) return variable_q(exp_of(F, a));
    if (node->term == ISO_TERM_LOG) return variable_q(log_of(F, a));
    return variable_q(power_of(F, a, constant(F, 0.5)));
}

/* Of a node that is not written with vectors. */
static iso_quantity plain_value(iso_writer *w, const iso_expression_node *node)
{
    iso_formula *F = w->F;
    switch (node->term) {
    case ISO_TERM_NUMBER: return constant_q(constant(F, node->value));
    case ISO_TERM_PARAMETER: return constant_q(constant(F, w->number[node->a]));
    case ISO_TERM_K: return constant_q(constant_k(F));
    case ISO_TERM_J: return constant_q(moment(w, node->a));
    case ISO_TERM_N: return part_of(w, w->n, node->a, 1);
    case ISO_TERM_OMEGA: return part_of(w, w->omega, node->a, w->number[ISO_WRITTEN_W]);
    case ISO_TERM_E: return part_of(w, w->vertical, node->a, 1);
    case ISO_TERM_ADD: return add_q(F, iso_writer_value_of(w, node->a), iso_writer_value_of(w, node->b));
    case ISO_TERM_SUB: return sub_q(F, iso_writer_value_of(w, node->a), iso_writer_value_of(w, node->b));
    case ISO_TERM_MUL: return mul_q(F, iso_writer_value_of(w, node->a), iso_writer_value_of(w, node->b));
    case ISO_TERM_DIV: return div_q(F, iso_writer_value_of(w, node->a), iso_writer_value_of(w, node->b));
    case ISO_TERM_POWER: return power_value(w, node);
    case ISO_TERM_NEGATIVE: return negative_q(F, iso_writer_value_of(w, node->a));
    default: return function_value(w, node);
    }
}

/* --- polynomials in n ------------------------------------------------------------------------------------------- */

typedef struct form {
    iso_quantity c, l[3], C[3][3];
} form;

bool iso_writer_is_form(const iso_writer *w, int node)
{
    const int degree = w->e.node[node].degree;
    return degree != ISO_CONSTANT && degree <= w->most;
}

/* f += factor * node */
static void collect(iso_writer *w, int node, iso_quantity factor, form *f);

/* f += factor * a * b for two of degree 1 */
static void collect_product(iso_writer *w, int a, int b, iso_quantity factor, form *f)
{
    iso_formula *F = w->F;
    form of_a = {0}, of_b = {0};
    collect(w, a, factor, &of_a);
    collect(w, b, one_q, &of_b);
    f->c = add_q(F, f->c, mul_q(F, of_a.c, of_b.c));
    for (int i = 0; i < 3; i++) {
        f->l[i] = add_q(F, f->l[i], mul_q(F, of_a.c, of_b.l[i]));
        f->l[i] = add_q(F, f->l[i], mul_q(F, of_a.l[i], of_b.c));
        for (int j = 0; j < 3; j++) {
            const iso_quantity product = mul_q(F, of_a.l[i], of_b.l[j]);
            f->C[i][j] = add_q(F, f->C[i][j], product);
            f->C[j][i] = add_q(F, f->C[j][i], product);
        }
    }
}

static void collect(iso_writer *w, int node, iso_quantity factor, form *f)
{
    iso_formula *F = w->F;
    const iso_expression_node *x = &w->e.node[node];
    if (x->degree == ISO_CONSTANT) {
        f->c = add_q(F, f->c, mul_q(F, factor, iso_writer_value_of(w, node)));
        return;
    }
    switch (x->term) {
    case ISO_TERM_N: f->l[x->a] = add_q(F, f->l[x->a], factor); return;
    case ISO_TERM_NEGATIVE: collect(w, x->a, negative_q(F, factor), f); return;
    case ISO_TERM_DIV: collect(w, x->a, div_q(F, factor, iso_writer_value_of(w, x->b)), f); return;
    case ISO_TERM_POWER: collect_product(w, x->a, x->a, factor, f); return; /* a square */
    case ISO_TERM_MUL:
        if (w->e.node[x->a].degree == ISO_CONSTANT)
            collect(w, x->b, mul_q(F, factor, iso_writer_value_of(w, x->a)), f);
        else if (w->e.node[x->b].degree == ISO_CONSTANT)
            collect(w, x->a, mul_q(F, factor, iso_writer_value_of(w, x->b)), f);
        else
            collect_product(w, x->a, x->b, factor, f);
        return;
    default: /* a sum or a difference */
        collect(w, x->a, factor, f);
        collect(w, x->b, x->term == ISO_TERM_SUB ? negative_q(F, factor) : factor, f);
    }
}

static bool has_any(int count, const iso_quantity x[])
{
    bool any = false;
    for (int i = 0; i < count; i++) any = any || x[i].kind != ISO_IS_ZERO;
    return any;
}

/* C n; a diagonal matrix is a vector. */
static iso_vector matrix_n(iso_writer *w, const form *f)
{
    const iso_quantity *C = &f->C[0][0], diagonal[3] = {C[0], C[4], C[8]};
    const iso_quantity others[] = {C[1], C[2], C[5]};
    if (!has_any(3, others)) return by_c(w->F, row_q(w->F, 3, diagonal), w->n);
    return matrix_c(w->F, row_q(w->F, 9, C), w->n);
}

/* Notes the parts n_i^2/J_i of a sum; false: it has others, or one of them twice. */
static bool note_moments(const iso_expression *e, int node, bool seen[3])
{
    const iso_expression_node *x = &e->node[node];
    if (x->term == ISO_TERM_ADD) return note_moments(e, x->a, seen) && note_moments(e, x->b, seen);
    if (x->term != ISO_TERM_DIV || e->node[x->b].term != ISO_TERM_J) return false;
    const iso_expression_node *square = &e->node[x->a], *n = &e->node[square->a];
    const int i = e->node[x->b].a;
    const bool is_square =
        square->degree == ISO_QUADRATIC &&
        (square->term == ISO_TERM_POWER || (square->term == ISO_TERM_MUL && square->a == square->b));
    if (!is_square || n->term != ISO_TERM_N || n->a != i || seen[i]) return false;
    return seen[i] = true;
}

/* Of (n, J^-1 n), which the ball has at hand as g, together with u = J^-1 n. */
static iso_quantity g_value(iso_writer *w, int node)
{
    iso_formula *F = w->F;
    const iso_constant over_J = div_c(F, constant(F, 1), unit(w, ISO_WRITTEN_J)), two = constant(F, 2);
    const iso_quantity g = variable_q(times_c(F, over_J, formula_g(F)));
    w->form[node].has_l = false;
    w->form[node].has_C = true;
    w->form[node].C_n = times_v(F, mul_c(F, two, over_J), formula_u(F));
    w->form[node].along = mul_q(F, constant_q(two), g);
    return g;
}

static iso_quantity form_value(iso_writer *w, int node)
{
    iso_formula *F = w->F;
    form f = {0};
    bool seen[3] = {false};
    if (F->kind != ISO_FORMULA_IMAGE && note_moments(&w->e, node, seen) && seen[0] && seen[1] && seen[2])
        return g_value(w, node);
    collect(w, node, one_q, &f);
    iso_quantity value = f.c, along = zero_q;
    w->form[node].has_l = has_any(3, f.l);
    w->form[node].has_C = has_any(9, &f.C[0][0]);
    if (w->form[node].has_C) {
        w->form[node].C_n = matrix_n(w, &f);
        along = variable_q(dot_of(F, w->n, w->form[node].C_n));
        value = add_q(F, value, mul_q(F, constant_q(constant(F, 0.5)), along));
    }
    if (w->form[node].has_l) {
        w->form[node].l = row_q(F, 3, f.l);
        const iso_quantity linear = variable_q(dot_c(F, w->form[node].l, w->n));
        value = add_q(F, value, linear);
        along = add_q(F, along, linear);
    }
    w->form[node].along = along;
    return value;
}

iso_quantity iso_writer_value_of(iso_writer *w, int node)
{
    if (w->has_value[node]) return w->value[node];
    const iso_quantity value = iso_writer_is_form(w, node) ? form_value(w, node) : plain_value(w, &w->e.node[node]);
    w->has_value[node] = true;
    return w->value[node] = value;
}

iso_scalar iso_writer_value(iso_writer *w)
{
    return scalar_q(w->F, iso_writer_value_of(w, w->e.root));
}

/* --- of an effect ----------------------------------------------------------------------------------------------- */

const double iso_written_one = 1;

bool iso_written_has(const iso_effects *effects, iso_effect_id id, int which)
{
    const iso_effect *effect = iso_effect_list[id];
    return which == 0 || effect->expressions_key || effects->written[effect->written].expression[which][0];
}

bool iso_written_drives(const iso_effects *effects, iso_effect_id id)
{
    return effects->on[id] && iso_effect_list[id]->expressions && !iso_effect_list[id]->observes;
}

iso_expression_state iso_written_state(const iso_problem *f, iso_effect_id id, const double y[])
{
    const double *number = f->effects.number[id];
    iso_expression_state s = {.k = f->p.k, .parameter = number};
    copy(y + 3, s.n, 3);
    copy(f->at[ISO_GRAVITY] > 0 ? y + f->at[ISO_GRAVITY] : y + 3, s.e, 3);
    for (int i = 0; i < 3; i++) {
        s.J[i] = number[ISO_WRITTEN_J] * f->p.J[i];
        s.omega[i] = number[ISO_WRITTEN_W] * y[i];
    }
    return s;
}

bool iso_written_read(const iso_effects *effects, iso_effect_id id, int which, iso_expression *e)
{
    const iso_written *text = &effects->written[iso_effect_list[id]->written];
    const bool torque = !iso_effect_list[id]->potential;
    const iso_expression_names names = {torque, text->parameter};
    return iso_expression_read(text->expression[which], &names, e);
}

bool iso_written_decided(const iso_params *p, const iso_effects *effects, iso_effect_id id, iso_expression *e)
{
    const double *number = effects->number[id], U = number[ISO_WRITTEN_J];
    const iso_expression_state s = {.k = p->k, .J = {U * p->J[0], U * p->J[1], U * p->J[2]}, .parameter = number};
    for (int i = 0; i < e->nodes && e->reads[ISO_TERM_E] && !effects->on[ISO_GRAVITY]; i++) {
        if (e->node[i].term != ISO_TERM_E) continue;
        e->at = e->node[i].at;
        snprintf(e->wrong, sizeof e->wrong,
                 "e%d is the vertical in the body's axes: it needs the effect 'gravity' (without weight: gravity: "
                 "{mgb: 0, up: [...]}, or g: 0 for a ball with mass)",
                 e->node[i].a + 1);
        return false;
    }
    return iso_expression_constants(e, &s) && !(iso_written_drives(effects, id) && iso_expression_has_corner(e, &s));
}

iso_status iso_written_check(iso_context *ctx, const iso_params *p, const iso_effects *effects, iso_effect_id id,
                             int which, iso_expression *e)
{
    const iso_effect *effect = iso_effect_list[id];
    const char *name = effect->expressions[which], *key = effect->expressions_key ? effect->expressions_key : name;
    if (iso_written_read(effects, id, which, e) && iso_written_decided(p, effects, id, e)) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, key, "%s, column %d of the text: %s", name, e->at + 1, e->wrong);
}
