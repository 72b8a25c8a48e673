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
static void give(iso_writer *w, slopes *s, int node, iso_quantity x)
{
    if (w->e.node[node].degree != ISO_CONSTANT) s->of[node] = add_q(w->F, s->of[node], x);
}

/* a^(b-1) of value = a^b. A torque needs no value: there it is a power of its own, and nothing is divided. */
static iso_quantity lower_power(iso_writer *w, iso_quantity a, iso_quantity b, iso_quantity value)
{
    iso_formula *F = w->F;
    if (F->kind != ISO_FORMULA_MOTION || !is_fixed_q(b) || is_fixed_q(a)) return div_q(F, value, a);
    return variable_q(power_of(F, (iso_scalar){a.at}, sub_c(F, fixed_q(F, b), constant(F, 1))));
}

static void give_power(iso_writer *w, slopes *s, const iso_expression_node *x, iso_quantity own, iso_quantity value)
{
    iso_formula *F = w->F;
    const int whole = iso_writer_exponent(&w->e, x);
    const iso_quantity a = iso_writer_value_of(w, x->a), b = iso_writer_value_of(w, x->b);
    give(w, s, x->a, mul_q(F, mul_q(F, own, b), whole > 0 ? power_q(F, a, whole - 1) : lower_power(w, a, b, value)));
    if (is_fixed_q(b)) return;
    give(w, s, x->b, mul_q(F, own, mul_q(F, value, log_q(F, a))));
}

static void give_quotient(iso_writer *w, slopes *s, const iso_expression_node *x, iso_quantity own,
                          iso_quantity value)
{
    iso_formula *F = w->F;
    const iso_quantity b = iso_writer_value_of(w, x->b);
    if (w->e.node[x->a].degree == ISO_CONSTANT) {
        give(w, s, x->b, negative_q(F, div_q(F, mul_q(F, own, value), b)));
        return;
    }
    const iso_quantity over = div_q(F, own, b);
    give(w, s, x->a, over);
    give(w, s, x->b, negative_q(F, mul_q(F, over, value)));
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
    const iso_expression_node *x = &w->e.node[node];
    const iso_quantity own = s->of[node], value = iso_writer_value_of(w, node);
    switch (x->term) {
    case ISO_TERM_ADD: give(w, s, x->a, own), give(w, s, x->b, own); break;
    case ISO_TERM_SUB: give(w, s, x->a, own), give(w, s, x->b, negative_q(F, own)); break;
    case ISO_TERM_NEGATIVE: give(w, s, x->a, negative_q(F, own)); break;
    case ISO_TERM_MUL:
        give(w, s, x->a, mul_q(F, own, iso_writer_value_of(w, x->b)));
        give(w, s, x->b, mul_q(F, own, iso_writer_value_of(w, x->a)));
        break;
    case ISO_TERM_DIV: give_quotient(w, s, x, own, value); break;
    case ISO_TERM_POWER: give_power(w, s, x, own, value); break;
    case ISO_TERM_SQRT: give(w, s, x->a, div_q(F, mul_q(F, constant_q(constant(F, 0.5)), own), value)); break;
    case ISO_TERM_EXP: give(w, s, x->a, mul_q(F, own, value)); break;
    case ISO_TERM_LOG: give(w, s, x->a, div_q(F, own, iso_writer_value_of(w, x->a))); break;
    case ISO_TERM_SIN: give(w, s, x->a, mul_q(F, own, other_of_circle(w, x, value))); break;
    default: give(w, s, x->a, negative_q(F, mul_q(F, own, other_of_circle(w, x, value)))); break; /* cos */
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
