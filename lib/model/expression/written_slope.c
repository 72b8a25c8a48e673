/* written_slope.c - the slope dU/dn of an expression, as lines of a formula.
 *
 * By the chain rule from the whole to its parts: `slope` of a node is dU/d(node). A part that is a polynomial in n adds
 * its own slope l + C n times this.
 */
#include "model/expression/written_impl.h"

typedef struct slopes {
    iso_quantity of[ISO_EXPRESSION_NODES], along;
    bool has_sum;
    iso_vector sum; /* dU/dn so far */
} slopes;

/* slope of a node += x */
static void add_slope(iso_writer *w, slopes *s, int node, iso_quantity x)
{
    if (w->e.node[node].degree != ISO_CONSTANT) s->of[node] = add_q(w->F, s->of[node], x);
}

/* dU/da of a power a^b, whose own slope is `own`. A torque needs no value: there a^(b-1) is a power of its own, and
 * nothing is divided. */
static iso_quantity base_slope(iso_writer *w, const iso_expression_node *x, iso_quantity own, iso_quantity value)
{
    iso_formula *F = w->F;
    const int whole = iso_writer_exponent(&w->e, x);
    const iso_quantity a = iso_writer_value_of(w, x->a), b = iso_writer_value_of(w, x->b), factor = mul_q(F, own, b);
    if (whole > 0) return mul_q(F, factor, power_q(F, a, whole - 1));
    if (F->kind != ISO_FORMULA_MOTION || !is_fixed_q(b) || is_fixed_q(a)) return mul_q(F, factor, div_q(F, value, a));
    const iso_constant lower = sub_c(F, fixed_q(F, b), constant(F, 1));
    return mul_q(F, factor, variable_q(power_of(F, (iso_scalar){a.at}, lower)));
}

/* The cosine of a sine, which stands behind it in the formula; the sine of a cosine. */
static iso_quantity other_of_circle(iso_writer *w, const iso_expression_node *x, iso_quantity value)
{
    const int away = w->F->overrun ? 0 : x->term == ISO_TERM_SIN ? 1 : -1;
    return (iso_quantity){ISO_IS_SCALAR, value.at + away};
}

/* Hands the slope of an operation on to what it is made of. */
static void hand_on(iso_writer *w, slopes *s, int node)
{
    iso_formula *F = w->F;
    const iso_expression_node *x = &w->e.node[node];
    const iso_quantity own = s->of[node], value = iso_writer_value_of(w, node), a = iso_writer_value_of(w, x->a);
    const iso_quantity b = has_two(x->term) ? iso_writer_value_of(w, x->b) : zero_q;
    iso_quantity to_a = own, to_b = own; /* of a sum */
    switch (x->term) {
    case ISO_TERM_SUB: to_b = negative_q(F, own); break;
    case ISO_TERM_NEGATIVE: to_a = negative_q(F, own); break;
    case ISO_TERM_MUL: to_a = mul_q(F, own, b), to_b = mul_q(F, own, a); break;
    case ISO_TERM_DIV:
        if (w->e.node[x->a].degree != ISO_CONSTANT)
            to_a = div_q(F, own, b), to_b = mul_q(F, to_a, value);
        else
            to_b = div_q(F, mul_q(F, own, value), b);
        to_b = negative_q(F, to_b);
        break;
    case ISO_TERM_POWER:
        to_a = base_slope(w, x, own, value);
        to_b = is_fixed_q(b) ? zero_q : mul_q(F, own, mul_q(F, value, log_q(F, a)));
        break;
    case ISO_TERM_SQRT: to_a = div_q(F, mul_q(F, constant_q(constant(F, 0.5)), own), value); break;
    case ISO_TERM_EXP: to_a = mul_q(F, own, value); break;
    case ISO_TERM_LOG: to_a = div_q(F, own, a); break;
    case ISO_TERM_SIN: to_a = mul_q(F, own, other_of_circle(w, x, value)); break;
    case ISO_TERM_COS: to_a = negative_q(F, mul_q(F, own, other_of_circle(w, x, value))); break;
    default: break;
    }
    add_slope(w, s, x->a, to_a);
    if (has_two(x->term)) add_slope(w, s, x->b, to_b);
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
    if (!is_fixed_q(own)) {
        add_to_sum(w, s, scale_c(F, (iso_scalar){own.at}, l));
        return;
    }
    for (int i = 0; i < 3; i++) scaled[i] = mul_q(F, own, constant_q((iso_constant){l.at + i}));
    const iso_constant whole = own.kind == ISO_IS_ONE ? l : row_q(F, 3, scaled);
    s->sum = plus_v(F, whole, s->has_sum ? s->sum : sub_v(F, w->n, w->n));
    s->has_sum = true;
}

/* slope * (l + C n) of a polynomial, which has been written: the value of the whole needs it */
static void add_form(iso_writer *w, slopes *s, int node)
{
    const iso_quantity own = s->of[node];
    const iso_vector C_n = w->form[node].C_n;
    if (w->form[node].has_C)
        add_to_sum(w, s,
                   own.kind == ISO_IS_ONE        ? C_n
                   : own.kind == ISO_IS_CONSTANT ? times_v(w->F, (iso_constant){own.at}, C_n)
                                                 : scale_v(w->F, (iso_scalar){own.at}, C_n));
    if (w->form[node].has_l) add_fixed(w, s, own, w->form[node].l);
    s->along = add_q(w->F, s->along, mul_q(w->F, own, w->form[node].along));
}

void iso_writer_slope(iso_writer *w, iso_scalar *U, iso_vector *dU, iso_scalar *along)
{
    slopes s = {.along = zero_q};
    *U = iso_writer_value(w);
    for (int i = 0; i < w->e.nodes; i++) s.of[i] = zero_q;
    s.of[w->e.root] = one_q;
    for (int i = w->e.root; i >= 0; i--) {
        if (s.of[i].kind == ISO_IS_ZERO || w->e.node[i].degree == ISO_CONSTANT) continue;
        iso_writer_is_form(w, i) ? add_form(w, &s, i) : hand_on(w, &s, i);
    }
    *dU = s.has_sum ? s.sum : sub_v(w->F, w->n, w->n);
    *along = scalar_q(w->F, s.along);
}
