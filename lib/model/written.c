/* written.c - writes an expression (expression_impl.h) down as lines of a formula: its value, and its slope in n.
 *
 * A part that is a polynomial c + (l,n) + (n,Cn)/2 in n is written with vectors: its slope l + C n then costs no
 * product of series. What is made of such parts has its slope by the chain rule, from the whole to its parts: `slope`
 * of a node is dU/d(node), and each part that is a polynomial adds its own slope times this.
 */
#include "model/written_impl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* --- quantities ------------------------------------------------------------------------------------------------- */

static const iso_quantity nothing = {ISO_IS_ZERO, 0}, one = {ISO_IS_ONE, 0};

static iso_quantity of_constant(iso_constant c)
{
    return (iso_quantity){ISO_IS_CONSTANT, c.at};
}

static iso_quantity of_scalar(iso_scalar s)
{
    return (iso_quantity){ISO_IS_SCALAR, s.at};
}

static bool is_fixed(iso_quantity a)
{
    return a.kind != ISO_IS_SCALAR;
}

static iso_constant constant_of(iso_formula *F, iso_quantity a)
{
    return a.kind == ISO_IS_CONSTANT ? (iso_constant){a.at} : constant(F, a.kind == ISO_IS_ONE);
}

iso_scalar iso_quantity_scalar(iso_formula *F, iso_quantity a)
{
    if (a.kind == ISO_IS_SCALAR) return (iso_scalar){a.at};
    const iso_scalar base = {ISO_GIVEN_BASE}; /* of ball and point */
    return plus_c(F, constant_of(F, a), sub(F, base, base));
}

iso_quantity iso_quantity_add(iso_formula *F, iso_quantity a, iso_quantity b)
{
    if (a.kind == ISO_IS_ZERO) return b;
    if (b.kind == ISO_IS_ZERO) return a;
    if (is_fixed(a) && is_fixed(b)) return of_constant(add_c(F, constant_of(F, a), constant_of(F, b)));
    if (is_fixed(a)) return of_scalar(plus_c(F, constant_of(F, a), (iso_scalar){b.at}));
    if (is_fixed(b)) return of_scalar(plus_c(F, constant_of(F, b), (iso_scalar){a.at}));
    return of_scalar(add(F, (iso_scalar){a.at}, (iso_scalar){b.at}));
}

iso_quantity iso_quantity_mul(iso_formula *F, iso_quantity a, iso_quantity b)
{
    if (a.kind == ISO_IS_ZERO || b.kind == ISO_IS_ONE) return a;
    if (b.kind == ISO_IS_ZERO || a.kind == ISO_IS_ONE) return b;
    if (is_fixed(a) && is_fixed(b)) return of_constant(mul_c(F, (iso_constant){a.at}, (iso_constant){b.at}));
    if (is_fixed(a)) return of_scalar(times_c(F, (iso_constant){a.at}, (iso_scalar){b.at}));
    if (is_fixed(b)) return of_scalar(times_c(F, (iso_constant){b.at}, (iso_scalar){a.at}));
    return of_scalar(mul(F, (iso_scalar){a.at}, (iso_scalar){b.at}));
}

static iso_quantity negative(iso_formula *F, iso_quantity a)
{
    return iso_quantity_mul(F, of_constant(constant(F, -1)), a);
}

static iso_quantity subtract(iso_formula *F, iso_quantity a, iso_quantity b)
{
    if (!is_fixed(a) && !is_fixed(b)) return of_scalar(sub(F, (iso_scalar){a.at}, (iso_scalar){b.at}));
    if (is_fixed(a) && is_fixed(b)) return of_constant(sub_c(F, constant_of(F, a), constant_of(F, b)));
    return iso_quantity_add(F, a, negative(F, b));
}

static iso_quantity divide(iso_formula *F, iso_quantity a, iso_quantity b)
{
    if (is_fixed(b)) {
        if (is_fixed(a)) return of_constant(div_c(F, constant_of(F, a), constant_of(F, b)));
        return iso_quantity_mul(F, of_constant(div_c(F, constant(F, 1), constant_of(F, b))), a);
    }
    if (!is_fixed(a)) return of_scalar(quotient_of(F, (iso_scalar){a.at}, (iso_scalar){b.at}));
    return iso_quantity_mul(F, a, of_scalar(power_of(F, (iso_scalar){b.at}, constant(F, -1))));
}

/* a^n, n from 1 on: products alone, which hold for every a */
static iso_quantity whole_power(iso_formula *F, iso_quantity a, int n)
{
    iso_quantity power = one;
    for (; n > 0; n /= 2) {
        if (n % 2 == 1) power = iso_quantity_mul(F, power, a);
        if (n > 1) a = iso_quantity_mul(F, a, a);
    }
    return power;
}

/* --- values ----------------------------------------------------------------------------------------------------- */

void iso_writer_begin(iso_writer *w, iso_formula *F, const iso_expression *e, const double number[], iso_vector n)
{
    w->F = F;
    w->e = e;
    w->number = number;
    w->n = w->vertical = n;
    w->omega = formula_omega(F);
    w->most = ISO_QUADRATIC;
    w->has_J = false;
    memset(w->has_value, 0, sizeof w->has_value);
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

static iso_quantity value_of(iso_writer *w, int node);

static iso_constant fixed_of(iso_writer *w, int node)
{
    return constant_of(w->F, value_of(w, node));
}

/* A function of a constant. */
static iso_quantity fixed_function(iso_writer *w, const iso_expression_node *node)
{
    static const iso_operation operations[] = {[ISO_TERM_SQRT] = ISO_C_ROOT,
                                               [ISO_TERM_EXP] = ISO_C_EXP,
                                               [ISO_TERM_LOG] = ISO_C_LOG,
                                               [ISO_TERM_SIN] = ISO_C_SIN,
                                               [ISO_TERM_COS] = ISO_C_COS};
    const iso_constant a = fixed_of(w, node->a);
    return of_constant(function_c(w->F, operations[node->term], a, a));
}

/* One of the three numbers of a vector, times a factor. */
static iso_quantity part_of(iso_writer *w, iso_vector v, int which, double factor)
{
    const double along[3] = {which == 0 ? factor : 0, which == 1 ? factor : 0, which == 2 ? factor : 0};
    return of_scalar(dot_c(w->F, constants(w->F, 3, along), v));
}

/* The exponent of a power, where the text itself says which whole number it is, from 1 to 64; else 0. */
static int whole_exponent(const iso_expression *e, const iso_expression_node *power)
{
    const iso_expression_node *p = &e->node[power->b];
    return p->term == ISO_TERM_NUMBER && p->value >= 1 && p->value <= 64 && p->value == floor(p->value)
               ? (int)p->value
               : 0;
}

static iso_quantity power_value(iso_writer *w, const iso_expression_node *node)
{
    iso_formula *F = w->F;
    const iso_quantity a = value_of(w, node->a);
    const int whole = whole_exponent(w->e, node);
    if (whole > 0) return whole_power(F, a, whole);
    const iso_quantity b = value_of(w, node->b);
    if (is_fixed(a) && is_fixed(b))
        return of_constant(function_c(F, ISO_C_POWER, constant_of(F, a), constant_of(F, b)));
    if (is_fixed(b)) return of_scalar(power_of(F, (iso_scalar){a.at}, constant_of(F, b)));
    const iso_constant base = constant_of(F, a);
    const iso_quantity log_a =
        is_fixed(a) ? of_constant(function_c(F, ISO_C_LOG, base, base)) : of_scalar(log_of(F, (iso_scalar){a.at}));
    return of_scalar(exp_of(F, iso_quantity_scalar(F, iso_quantity_mul(F, b, log_a))));
}

/* sin or cos; the formula has both of them, and the other one is kept as well, if the text has it. */
static iso_quantity circle_value(iso_writer *w, const iso_expression_node *node)
{
    iso_scalar cosine;
    const iso_scalar sine = sin_of(w->F, iso_quantity_scalar(w->F, value_of(w, node->a)), &cosine);
    for (int i = 0; i < w->e->nodes; i++) {
        const iso_expression_node *other = &w->e->node[i];
        if ((other->term != ISO_TERM_SIN && other->term != ISO_TERM_COS) || other->a != node->a) continue;
        w->value[i] = of_scalar(other->term == ISO_TERM_SIN ? sine : cosine);
        w->has_value[i] = true;
    }
    return of_scalar(node->term == ISO_TERM_SIN ? sine : cosine);
}

static iso_quantity function_value(iso_writer *w, const iso_expression_node *node)
{
    if (node->term == ISO_TERM_SIN || node->term == ISO_TERM_COS) return circle_value(w, node);
    const iso_scalar a = iso_quantity_scalar(w->F, value_of(w, node->a));
    if (node->term == ISO_TERM_EXP) return of_scalar(exp_of(w->F, a));
    if (node->term == ISO_TERM_LOG) return of_scalar(log_of(w->F, a));
    return of_scalar(power_of(w->F, a, constant(w->F, 0.5)));
}

static iso_quantity operation_value(iso_writer *w, const iso_expression_node *node)
{
    iso_formula *F = w->F;
    switch (node->term) {
    case ISO_TERM_ADD: return iso_quantity_add(F, value_of(w, node->a), value_of(w, node->b));
    case ISO_TERM_SUB: return subtract(F, value_of(w, node->a), value_of(w, node->b));
    case ISO_TERM_MUL: return iso_quantity_mul(F, value_of(w, node->a), value_of(w, node->b));
    case ISO_TERM_DIV: return divide(F, value_of(w, node->a), value_of(w, node->b));
    case ISO_TERM_POWER: return power_value(w, node);
    case ISO_TERM_NEGATIVE: return negative(F, value_of(w, node->a));
    default: return node->degree == ISO_CONSTANT ? fixed_function(w, node) : function_value(w, node);
    }
}

static iso_quantity name_value(iso_writer *w, const iso_expression_node *node)
{
    iso_formula *F = w->F;
    switch (node->term) {
    case ISO_TERM_NUMBER: return of_constant(constant(F, node->value));
    case ISO_TERM_PARAMETER: return of_constant(constant(F, w->number[node->a]));
    case ISO_TERM_K: return of_constant(constant_k(F));
    case ISO_TERM_J: return of_constant(moment(w, node->a));
    case ISO_TERM_N: return part_of(w, w->n, node->a, 1);
    case ISO_TERM_OMEGA: return part_of(w, w->omega, node->a, w->number[ISO_WRITTEN_W]);
    default: return part_of(w, w->vertical, node->a, 1); /* ISO_TERM_E */
    }
}

/* --- polynomials in n ------------------------------------------------------------------------------------------- */

typedef struct form {
    iso_quantity c, l[3], C[3][3];
} form;

static bool is_form(const iso_writer *w, int node)
{
    const int degree = w->e->node[node].degree;
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
    collect(w, b, one, &of_b);
    f->c = iso_quantity_add(F, f->c, iso_quantity_mul(F, of_a.c, of_b.c));
    for (int i = 0; i < 3; i++) {
        f->l[i] = iso_quantity_add(F, f->l[i], iso_quantity_mul(F, of_a.c, of_b.l[i]));
        f->l[i] = iso_quantity_add(F, f->l[i], iso_quantity_mul(F, of_a.l[i], of_b.c));
        for (int j = 0; j < 3; j++) {
            const iso_quantity product = iso_quantity_mul(F, of_a.l[i], of_b.l[j]);
            f->C[i][j] = iso_quantity_add(F, f->C[i][j], product);
            f->C[j][i] = iso_quantity_add(F, f->C[j][i], product);
        }
    }
}

static void collect(iso_writer *w, int node, iso_quantity factor, form *f)
{
    iso_formula *F = w->F;
    const iso_expression_node *x = &w->e->node[node];
    if (x->degree == ISO_CONSTANT) {
        f->c = iso_quantity_add(F, f->c, iso_quantity_mul(F, factor, value_of(w, node)));
        return;
    }
    switch (x->term) {
    case ISO_TERM_N: f->l[x->a] = iso_quantity_add(F, f->l[x->a], factor); return;
    case ISO_TERM_NEGATIVE: collect(w, x->a, negative(F, factor), f); return;
    case ISO_TERM_DIV: collect(w, x->a, divide(F, factor, value_of(w, x->b)), f); return;
    case ISO_TERM_POWER: collect_product(w, x->a, x->a, factor, f); return; /* a square */
    case ISO_TERM_MUL:
        if (w->e->node[x->a].degree == ISO_CONSTANT)
            collect(w, x->b, iso_quantity_mul(F, factor, value_of(w, x->a)), f);
        else if (w->e->node[x->b].degree == ISO_CONSTANT)
            collect(w, x->a, iso_quantity_mul(F, factor, value_of(w, x->b)), f);
        else
            collect_product(w, x->a, x->b, factor, f);
        return;
    default: /* a sum or a difference */
        collect(w, x->a, factor, f);
        collect(w, x->b, x->term == ISO_TERM_SUB ? negative(F, factor) : factor, f);
    }
}

/* Constants one after the other. */
static iso_constant in_a_row(iso_formula *F, int count, const iso_quantity x[])
{
    const iso_constant once = constant(F, 1);
    iso_constant first = {0};
    for (int i = 0; i < count; i++) {
        const iso_constant c = x[i].kind == ISO_IS_CONSTANT ? mul_c(F, once, (iso_constant){x[i].at})
                                                            : constant(F, x[i].kind == ISO_IS_ONE);
        if (i == 0) first = c;
    }
    return first;
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
    if (!has_any(3, others)) return by_c(w->F, in_a_row(w->F, 3, diagonal), w->n);
    return matrix_c(w->F, in_a_row(w->F, 9, C), w->n);
}

static iso_quantity form_value(iso_writer *w, int node)
{
    iso_formula *F = w->F;
    form f = {0};
    collect(w, node, one, &f);
    iso_quantity value = f.c, along = nothing;
    w->form[node].has_l = has_any(3, f.l);
    w->form[node].has_C = has_any(9, &f.C[0][0]);
    if (w->form[node].has_C) {
        w->form[node].C_n = matrix_n(w, &f);
        along = of_scalar(dot_of(F, w->n, w->form[node].C_n));
        value = iso_quantity_add(F, value, iso_quantity_mul(F, of_constant(constant(F, 0.5)), along));
    }
    if (w->form[node].has_l) {
        w->form[node].l = in_a_row(F, 3, f.l);
        const iso_quantity linear = of_scalar(dot_c(F, w->form[node].l, w->n));
        value = iso_quantity_add(F, value, linear);
        along = iso_quantity_add(F, along, linear);
    }
    w->form[node].along = along;
    return value;
}

static iso_quantity value_of(iso_writer *w, int node)
{
    const iso_expression_node *x = &w->e->node[node];
    if (w->has_value[node]) return w->value[node];
    const iso_quantity value = is_form(w, node)          ? form_value(w, node)
                               : x->term >= ISO_TERM_ADD ? operation_value(w, x)
                                                         : name_value(w, x);
    w->has_value[node] = true;
    return w->value[node] = value;
}

iso_scalar iso_writer_value(iso_writer *w)
{
    return iso_quantity_scalar(w->F, value_of(w, w->e->root));
}

/* --- slopes ----------------------------------------------------------------------------------------------------- */

typedef struct slopes {
    iso_quantity of[ISO_EXPRESSION_NODES], along;
    bool has_sum;
    iso_vector sum; /* dU/dn so far */
} slopes;

/* slope of a node += x */
static void give(iso_writer *w, slopes *s, int node, iso_quantity x)
{
    if (w->e->node[node].degree != ISO_CONSTANT) s->of[node] = iso_quantity_add(w->F, s->of[node], x);
}

static void give_power(iso_writer *w, slopes *s, const iso_expression_node *x, iso_quantity own, iso_quantity value)
{
    iso_formula *F = w->F;
    const int whole = whole_exponent(w->e, x);
    const iso_quantity a = value_of(w, x->a), b = value_of(w, x->b);
    const iso_quantity lower = whole > 0 ? whole_power(F, a, whole - 1) : divide(F, value, a);
    give(w, s, x->a, iso_quantity_mul(F, own, iso_quantity_mul(F, b, lower)));
    if (is_fixed(b)) return;
    const iso_constant base = constant_of(F, a);
    const iso_quantity log_a =
        is_fixed(a) ? of_constant(function_c(F, ISO_C_LOG, base, base)) : of_scalar(log_of(F, (iso_scalar){a.at}));
    give(w, s, x->b, iso_quantity_mul(F, own, iso_quantity_mul(F, value, log_a)));
}

static void give_quotient(iso_writer *w, slopes *s, const iso_expression_node *x, iso_quantity own,
                          iso_quantity value)
{
    iso_formula *F = w->F;
    const iso_quantity b = value_of(w, x->b);
    if (w->e->node[x->a].degree == ISO_CONSTANT) {
        give(w, s, x->b, negative(F, divide(F, iso_quantity_mul(F, own, value), b)));
        return;
    }
    const iso_quantity over = divide(F, own, b);
    give(w, s, x->a, over);
    give(w, s, x->b, negative(F, iso_quantity_mul(F, over, value)));
}

/* The cosine of a sine, the sine of a cosine. */
static iso_quantity other_of_circle(iso_writer *w, const iso_expression_node *x, iso_quantity value)
{
    const bool sine = x->term == ISO_TERM_SIN; /* the formula has the cosine behind the sine */
    return (iso_quantity){ISO_IS_SCALAR, w->F->overrun ? value.at : sine ? value.at + 1 : value.at - 1};
}

/* Hands the slope of an operation on to what it is made of. */
static void hand_on(iso_writer *w, slopes *s, int node)
{
    iso_formula *F = w->F;
    const iso_expression_node *x = &w->e->node[node];
    const iso_quantity own = s->of[node], value = value_of(w, node);
    switch (x->term) {
    case ISO_TERM_ADD: give(w, s, x->a, own), give(w, s, x->b, own); break;
    case ISO_TERM_SUB: give(w, s, x->a, own), give(w, s, x->b, negative(F, own)); break;
    case ISO_TERM_NEGATIVE: give(w, s, x->a, negative(F, own)); break;
    case ISO_TERM_MUL:
        give(w, s, x->a, iso_quantity_mul(F, own, value_of(w, x->b)));
        give(w, s, x->b, iso_quantity_mul(F, own, value_of(w, x->a)));
        break;
    case ISO_TERM_DIV: give_quotient(w, s, x, own, value); break;
    case ISO_TERM_POWER: give_power(w, s, x, own, value); break;
    case ISO_TERM_SQRT:
        give(w, s, x->a, divide(F, iso_quantity_mul(F, of_constant(constant(F, 0.5)), own), value));
        break;
    case ISO_TERM_EXP: give(w, s, x->a, iso_quantity_mul(F, own, value)); break;
    case ISO_TERM_LOG: give(w, s, x->a, divide(F, own, value_of(w, x->a))); break;
    case ISO_TERM_SIN: give(w, s, x->a, iso_quantity_mul(F, own, other_of_circle(w, x, value))); break;
    default: give(w, s, x->a, negative(F, iso_quantity_mul(F, own, other_of_circle(w, x, value)))); break; /* cos */
    }
}

static void add_to_sum(iso_writer *w, slopes *s, iso_vector v)
{
    s->sum = s->has_sum ? add_v(w->F, s->sum, v) : v;
    s->has_sum = true;
}

/* A constant vector times the slope, which may be a constant or 1. */
static void add_fixed(iso_writer *w, slopes *s, iso_quantity own, iso_constant l)
{
    iso_formula *F = w->F;
    iso_quantity scaled[3];
    if (!is_fixed(own)) {
        add_to_sum(w, s, scale_c(F, (iso_scalar){own.at}, l));
        return;
    }
    for (int i = 0; i < 3; i++) scaled[i] = iso_quantity_mul(F, own, of_constant((iso_constant){l.at + i}));
    const iso_constant whole = own.kind == ISO_IS_ONE ? l : in_a_row(F, 3, scaled);
    s->sum = plus_v(F, whole, s->has_sum ? s->sum : sub_v(F, w->n, w->n));
    s->has_sum = true;
}

/* slope * (l + C n) of a polynomial */
static void add_form(iso_writer *w, slopes *s, int node)
{
    const iso_quantity own = s->of[node];
    const iso_vector C_n = w->form[node].C_n;
    value_of(w, node);
    if (w->form[node].has_C)
        add_to_sum(w, s,
                   own.kind == ISO_IS_ONE        ? C_n
                   : own.kind == ISO_IS_CONSTANT ? times_v(w->F, (iso_constant){own.at}, C_n)
                                                 : scale_v(w->F, (iso_scalar){own.at}, C_n));
    if (w->form[node].has_l) add_fixed(w, s, own, w->form[node].l);
    s->along = iso_quantity_add(w->F, s->along, iso_quantity_mul(w->F, own, w->form[node].along));
}

void iso_writer_slope(iso_writer *w, iso_scalar *U, iso_vector *dU, iso_scalar *along)
{
    slopes s = {.along = nothing};
    *U = iso_writer_value(w);
    for (int i = 0; i < w->e->nodes; i++) s.of[i] = nothing;
    s.of[w->e->root] = one;
    for (int i = w->e->root; i >= 0; i--) {
        if (s.of[i].kind == ISO_IS_ZERO || w->e->node[i].degree == ISO_CONSTANT) continue;
        is_form(w, i) ? add_form(w, &s, i) : hand_on(w, &s, i);
    }
    *dU = s.has_sum ? s.sum : sub_v(w->F, w->n, w->n);
    *along = iso_quantity_scalar(w->F, s.along);
}

/* --- of an effect ----------------------------------------------------------------------------------------------- */

const double iso_written_one = 1;

bool iso_written_read(const iso_effects *effects, iso_effect_id id, int which, iso_expression *e)
{
    const iso_written *text = &effects->written[iso_effect_list[id]->written];
    const bool torque = !iso_effect_list[id]->potential;
    const iso_expression_names names = {torque, torque, text->parameter};
    return iso_expression_read(text->expression[which], &names, e);
}

bool iso_written_decided(iso_expression *e, const iso_effects *effects, double k, const double J[3],
                         const double parameter[])
{
    for (int i = 0; i < e->nodes && e->reads[ISO_TERM_E] && !effects->on[ISO_GRAVITY]; i++) {
        if (e->node[i].term != ISO_TERM_E) continue;
        e->at = e->node[i].at;
        snprintf(e->wrong, sizeof e->wrong,
                 "e%d is the vertical in the body, which is there with 'gravity' alone (without weight: gravity: "
                 "{mgb: 0, up: [...]}, or g: 0 for a ball with mass)",
                 e->node[i].a + 1);
        return false;
    }
    return iso_expression_constants(e, k, J, parameter);
}

static iso_status refuse(iso_context *ctx, iso_effect_id id, int which, const iso_expression *e)
{
    const char *name = iso_effect_list[id]->expressions[which];
    return ISO_FAIL_INPUT(ctx, name, "%s, column %d of the text: %s", name, e->at + 1, e->wrong);
}

iso_status iso_written_check(iso_context *ctx, const iso_params *p, const iso_effects *effects, iso_effect_id id,
                             int which, iso_expression *e)
{
    const char *name = iso_effect_list[id]->expressions[which];
    if (!iso_written_read(effects, id, which, e)) return refuse(ctx, id, which, e);
    const double *number = effects->number[id], U = number[ISO_WRITTEN_J];
    const double J[3] = {U * p->J[0], U * p->J[1], U * p->J[2]};
    if (U == 0 || number[ISO_WRITTEN_W] == 0)
        return ISO_FAIL_INPUT(ctx, name, "%s: the effects have no units, they begin with iso_effects_default()",
                              name);
    return iso_written_decided(e, effects, p->k, J, number) ? ISO_OK : refuse(ctx, id, which, e);
}
