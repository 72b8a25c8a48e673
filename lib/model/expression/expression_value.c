/* expression_value.c - what an expression is worth: its constants, its value at a state, and why it has none. */
#include "model/expression/expression_impl.h"

#include <math.h>
#include <stdio.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"

/* The value of a node, those that it is made of being known. */
static double value_of(const iso_expression_node *node, const double x[], const iso_expression_state *s)
{
    const double a = is_operation(node->term) ? x[node->a] : 0, b = has_two(node->term) ? x[node->b] : 0;
    switch (node->term) {
    case ISO_TERM_K: return s->k;
    case ISO_TERM_J: return s->J[node->a];
    case ISO_TERM_PARAMETER: return s->parameter[node->a];
    case ISO_TERM_N: return s->n[node->a];
    case ISO_TERM_OMEGA: return s->omega[node->a];
    case ISO_TERM_E: return s->e[node->a];
    case ISO_TERM_ADD: return a + b;
    case ISO_TERM_SUB: return a - b;
    case ISO_TERM_MUL: return a * b;
    case ISO_TERM_DIV: return a / b;
    case ISO_TERM_POWER: return pow(a, b);
    case ISO_TERM_NEGATIVE: return -a;
    case ISO_TERM_SQRT: return sqrt(a);
    case ISO_TERM_EXP: return exp(a);
    case ISO_TERM_LOG: return log(a);
    case ISO_TERM_SIN: return sin(a);
    case ISO_TERM_COS: return cos(a);
    default: return node->value; /* ISO_TERM_NUMBER */
    }
}

static void note_undefined(iso_expression *e, const iso_expression_node *node, const double x[])
{
    e->at = node->at;
    const double a = is_operation(node->term) ? x[node->a] : 0, b = has_two(node->term) ? x[node->b] : 0;
    if (node->term == ISO_TERM_DIV && b == 0)
        snprintf(e->wrong, sizeof e->wrong, "a division by 0");
    else if (node->term == ISO_TERM_LOG && a <= 0)
        snprintf(e->wrong, sizeof e->wrong, "log of %s: log needs a number above 0", ISO_SHORT(a));
    else if (node->term == ISO_TERM_SQRT && a < 0)
        snprintf(e->wrong, sizeof e->wrong, "sqrt of %s: sqrt needs 0 or a number above 0", ISO_SHORT(a));
    else if (node->term == ISO_TERM_POWER)
        snprintf(e->wrong, sizeof e->wrong, "%s to the power %s is not a finite number", ISO_SHORT(a), ISO_SHORT(b));
    else
        snprintf(e->wrong, sizeof e->wrong, "this is not a finite number");
}

/* --- constants -------------------------------------------------------------------------------------------------- */

bool iso_expression_constants(iso_expression *e, const iso_expression_state *s)
{
    double x[ISO_EXPRESSION_NODES];
    for (int i = 0; i < e->nodes; i++) {
        const iso_expression_node *node = &e->node[i];
        const bool fixed = node->degree == ISO_CONSTANT;
        if (!fixed && (node->term != ISO_TERM_DIV || e->node[node->b].degree != ISO_CONSTANT || x[node->b] != 0))
            continue;
        x[i] = fixed ? value_of(node, x, s) : INFINITY;
        if (isfinite(x[i])) continue;
        note_undefined(e, node, x);
        return false;
    }
    return true;
}

/* Whether node i is 0 or more by its form. x: the constants. */
static bool is_never_negative(const iso_expression *e, int i, const double x[])
{
    const iso_expression_node *node = &e->node[i];
    if (node->degree == ISO_CONSTANT) return x[i] >= 0;
    switch (node->term) {
    case ISO_TERM_SQRT: return true;
    case ISO_TERM_POWER: return e->node[node->b].degree == ISO_CONSTANT && fmod(x[node->b], 2) == 0;
    case ISO_TERM_MUL:
        if (node->a == node->b) return true; /* equal parts of a text are one node */
        /* fallthrough */
    case ISO_TERM_DIV:
    case ISO_TERM_ADD: return is_never_negative(e, node->a, x) && is_never_negative(e, node->b, x);
    default: return false;
    }
}

/* Whether the power p of node i has a factor |x|^m with m odd, from an even power of x: such a corner has no series,
 * and the series of one side goes on smoothly into the other one with the wrong sign. Other powers are smooth, or stop
 * a series by themselves. x: the constants. */
static bool is_root_of_even(const iso_expression *e, int i, double p, const double x[])
{
    const iso_expression_node *node = &e->node[i];
    const int a = node->a, b = node->b;
    if (node->degree == ISO_CONSTANT) return false;
    switch (node->term) {
    case ISO_TERM_MUL:
        if (a == b && fabs(fmod(2 * p, 2)) == 1 && !is_never_negative(e, a, x)) return true;
        if (a == b) return is_root_of_even(e, a, 2 * p, x);
        return is_root_of_even(e, a, p, x) || is_root_of_even(e, b, p, x);
    case ISO_TERM_POWER:
        if (e->node[b].degree != ISO_CONSTANT) return false;
        if (fmod(x[b], 2) == 0 && fabs(fmod(x[b] * p, 2)) == 1 && !is_never_negative(e, a, x)) return true;
        return is_root_of_even(e, a, p * x[b], x);
    case ISO_TERM_DIV: return is_root_of_even(e, a, p, x) || is_root_of_even(e, b, -p, x);
    case ISO_TERM_NEGATIVE: return is_root_of_even(e, a, p, x);
    case ISO_TERM_SQRT: return is_root_of_even(e, a, p / 2, x);
    default: return false;
    }
}

bool iso_expression_has_corner(iso_expression *e, const iso_expression_state *s)
{
    double x[ISO_EXPRESSION_NODES];
    for (int i = 0; i < e->nodes; i++) {
        const iso_expression_node *node = &e->node[i];
        if (node->degree == ISO_CONSTANT) x[i] = value_of(node, x, s);
        if (node->term != ISO_TERM_SQRT && node->term != ISO_TERM_POWER) continue;
        if (!is_root_of_even(e, i, 1, x)) continue;
        e->at = node->at;
        snprintf(
            e->wrong, sizeof e->wrong,
            "this is the root of an even power, which can have a corner where the power is 0, as sqrt(x^2) = |x|. A "
            "corner has no series: write x if it keeps its sign, or sqrt(x^2 + a^2) with a small a");
        return true;
    }
    return false;
}

/* --- at a state ------------------------------------------------------------------------------------------------- */

/* The size of a node, see iso_expression_value: by |d value/d a| and |d value/d b| of an operation. A constant has no
 * error. */
static double size_of(const iso_expression_node *node, const double x[], const double size[], double value,
                      const iso_expression_state *s)
{
    if (node->term == ISO_TERM_N) return norm(s->n);
    if (node->term == ISO_TERM_OMEGA) return norm(s->omega);
    if (node->term == ISO_TERM_E) return norm(s->e);
    if (node->degree == ISO_CONSTANT) return 0;
    const double a = x[node->a], b = has_two(node->term) ? x[node->b] : 0;
    double by_a = 1, by_b = 1, change = 0; /* of a sum, a difference, a sign */
    switch (node->term) {
    case ISO_TERM_MUL: by_a = fabs(b), by_b = fabs(a); break;
    case ISO_TERM_DIV: by_a = fabs(1 / b), by_b = fabs(value / b); break;
    case ISO_TERM_POWER: by_a = fabs(b * pow(a, b - 1)), by_b = a > 0 ? fabs(value * log(a)) : 0; break;
    case ISO_TERM_SQRT: by_a = 0.5 / value; break;
    case ISO_TERM_EXP: by_a = value; break;
    case ISO_TERM_LOG: by_a = fabs(1 / a); break;
    case ISO_TERM_SIN: by_a = fabs(cos(a)); break;
    case ISO_TERM_COS: by_a = fabs(sin(a)); break;
    default: break;
    }
    if (size[node->a] > 0) change += by_a * size[node->a];
    if (has_two(node->term) && size[node->b] > 0) change += by_b * size[node->b];
    return fmax(fabs(value), change);
}

void iso_expression_values(const iso_expression *e, const iso_expression_state *s, double x[ISO_EXPRESSION_NODES])
{
    for (int i = 0; i < e->nodes; i++) x[i] = value_of(&e->node[i], x, s);
}

/* The values of all nodes, and their sizes. */
static void compute(const iso_expression *e, const iso_expression_state *s, double x[], double size[])
{
    for (int i = 0; i < e->nodes; i++) {
        x[i] = value_of(&e->node[i], x, s);
        size[i] = size_of(&e->node[i], x, size, x[i], s);
    }
}

double iso_expression_value(const iso_expression *e, const iso_expression_state *s, double *size)
{
    double x[ISO_EXPRESSION_NODES], sizes[ISO_EXPRESSION_NODES];
    compute(e, s, x, sizes);
    *size = sizes[e->root];
    return x[e->root];
}

/* The node that must not be 0 where this one is computed; -1: none. */
static int divisor_of(const iso_expression *e, const iso_expression_node *node, const double x[])
{
    if (node->degree == ISO_CONSTANT) return -1;
    if (node->term == ISO_TERM_DIV) return node->b;
    if (node->term == ISO_TERM_SQRT || node->term == ISO_TERM_LOG) return node->a;
    const bool whole = node->term == ISO_TERM_POWER && e->node[node->b].term == ISO_TERM_NUMBER && x[node->b] >= 0 &&
                       x[node->b] == floor(x[node->b]);
    return node->term == ISO_TERM_POWER && !whole ? node->a : -1;
}

/* What is computed with a number that is nearly 0. */
static void note_nearly_undefined(iso_expression *e, const iso_expression_node *node, double a, double exponent)
{
    e->at = node->at;
    if (node->term == ISO_TERM_POWER)
        snprintf(e->wrong, sizeof e->wrong, "%s to the power %s", ISO_ROUNDED(a, 3), ISO_ROUNDED(exponent, 6));
    else
        snprintf(e->wrong, sizeof e->wrong, "%s %s",
                 node->term == ISO_TERM_DIV   ? "a division by"
                 : node->term == ISO_TERM_LOG ? "log of"
                                              : "sqrt of",
                 ISO_ROUNDED(a, 3));
}

double iso_expression_margin(iso_expression *e, const iso_expression_state *s)
{
    double x[ISO_EXPRESSION_NODES], size[ISO_EXPRESSION_NODES], least = INFINITY;
    compute(e, s, x, size);
    for (int i = 0; i < e->nodes; i++) {
        const iso_expression_node *node = &e->node[i];
        if (!isfinite(x[i])) return note_undefined(e, node, x), 0;
        const int a = divisor_of(e, node, x);
        const double margin = a < 0 || e->node[a].degree == ISO_CONSTANT ? INFINITY : fabs(x[a]) / size[a];
        if (!(margin < least)) continue;
        least = margin;
        note_nearly_undefined(e, node, x[a], has_two(node->term) ? x[node->b] : 0);
    }
    return least;
}
