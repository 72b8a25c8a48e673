/* expression_range.c - how much an expression varies over a box of states.
 *
 * Three passes over its nodes:
 *
 *     forwards    range      an interval that holds all values of the node over the box
 *     backwards   weight     how much the expression can change, at most, if the node changes by 1 in the box
 *     forwards    variation  the radians and the factors of e through which the node can go
 *
 * A node whose range times weight is less than `least` counts as constant: what varies inside it does not matter. So
 * exp(-1000 x^2) varies much near x = 0, and not at all where it is nearly 0.
 *
 * The variation adds up: a product has that of both factors, exp(a) and sin(a) that of a and the range of a, a power
 * and a division |p| log(largest/least), which is infinite where the base may be 0. A function that is analytic and has
 * a variation of at most 1 has no narrow feature in the box: a few values tell how it goes on.
 */
#include <float.h>
#include <math.h>
#include <stddef.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "model/expression/expression_impl.h"

typedef struct range {
    double low, high;
} range;

static const range everything = {-INFINITY, INFINITY};

/* Outwards by more than a rounding error. NaN (infinity - infinity, 0 infinity) becomes all numbers. */
static range outwards(double low, double high)
{
    if (!(low <= high)) return everything;
    return (range){low - (4 * DBL_EPSILON * fabs(low) + DBL_MIN), high + (4 * DBL_EPSILON * fabs(high) + DBL_MIN)};
}

static range product(range a, range b)
{
    const double p[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    double low = p[0], high = p[0];
    for (int i = 0; i < 4; i++) {
        if (isnan(p[i])) return everything;
        low = fmin(low, p[i]), high = fmax(high, p[i]);
    }
    return outwards(low, high);
}

static range inverse(range a)
{
    return a.low > 0 || a.high < 0 ? outwards(1 / a.high, 1 / a.low) : everything;
}

static double largest_of(range a)
{
    return fmax(fabs(a.low), fabs(a.high));
}

/* 0 where 0 lies in it */
static double least_of(range a)
{
    return a.low > 0 ? a.low : a.high < 0 ? -a.high : 0;
}

static bool is_whole(range p)
{
    return p.low == p.high && p.low == floor(p.low);
}

/* a^p */
static range power(range a, range p)
{
    if (is_whole(p) && p.low >= 0) {
        const bool even = fmod(p.low, 2) == 0;
        if (even) return outwards(pow(least_of(a), p.low), pow(largest_of(a), p.low));
        return outwards(pow(a.low, p.low), pow(a.high, p.low));
    }
    if (is_whole(p)) return inverse(power(a, (range){-p.low, -p.low}));
    const double base[] = {fmax(a.low, 0), fmax(a.high, 0)};
    double low = INFINITY, high = 0; /* a corner of the rectangle has the least value, another the largest */
    for (int i = 0; i < 4; i++) {
        const double corner = pow(base[i % 2], i < 2 ? p.low : p.high);
        low = fmin(low, corner), high = fmax(high, corner);
    }
    return outwards(low, high);
}

/* sin of a + shift: 1 is among its values if a + shift passes pi/2 + 2 pi m, and -1 half a turn on. */
static range sine(range a, double shift)
{
    const double low = a.low + shift, high = a.high + shift, turn = 2 * ISO_PI, quarter = ISO_PI / 2;
    if (!(high - low < turn)) return (range){-1, 1};
    const bool top = floor((high - quarter) / turn) != floor((low - quarter) / turn),
               bottom = floor((high + quarter) / turn) != floor((low + quarter) / turn);
    const range r = outwards(fmin(sin(low), sin(high)), fmax(sin(low), sin(high)));
    const double rounding = 4 * DBL_EPSILON * (1 + largest_of(a));
    return (range){bottom ? -1 : r.low - rounding, top ? 1 : r.high + rounding};
}

static range about(double middle, double radius)
{
    return outwards(middle - radius, middle + radius);
}

static range range_of(const iso_expression_node *node, const range x[], const iso_expression_box *box)
{
    const iso_expression_state *s = &box->middle;
    const range a = is_operation(node->term) ? x[node->a] : everything, b = has_two(node->term) ? x[node->b] : a;
    switch (node->term) {
    case ISO_TERM_K: return (range){s->k, s->k};
    case ISO_TERM_J: return (range){s->J[node->a], s->J[node->a]};
    case ISO_TERM_PARAMETER: return (range){s->parameter[node->a], s->parameter[node->a]};
    case ISO_TERM_N: return about(s->n[node->a], box->n);
    case ISO_TERM_OMEGA: return about(s->omega[node->a], box->omega);
    case ISO_TERM_E: return about(s->e[node->a], box->e);
    case ISO_TERM_ADD: return outwards(a.low + b.low, a.high + b.high);
    case ISO_TERM_SUB: return outwards(a.low - b.high, a.high - b.low);
    case ISO_TERM_MUL: return node->a == node->b ? power(a, (range){2, 2}) : product(a, b);
    case ISO_TERM_DIV: return product(a, inverse(b));
    case ISO_TERM_POWER: return power(a, b);
    case ISO_TERM_NEGATIVE: return (range){-a.high, -a.low};
    case ISO_TERM_SQRT: return outwards(sqrt(fmax(a.low, 0)), sqrt(fmax(a.high, 0)));
    case ISO_TERM_EXP: return outwards(exp(a.low), exp(a.high));
    case ISO_TERM_LOG: return outwards(log(fmax(a.low, 0)), log(fmax(a.high, 0)));
    case ISO_TERM_SIN: return sine(a, 0);
    case ISO_TERM_COS: return sine(a, ISO_PI / 2);
    default: return (range){node->value, node->value}; /* ISO_TERM_NUMBER */
    }
}

/* |d value/d a| and |d value/d b| of an operation, at most. */
static void steepest(const iso_expression_node *node, const range x[], range value, double slope[2])
{
    const range a = x[node->a], b = has_two(node->term) ? x[node->b] : a;
    slope[0] = slope[1] = 1; /* of a sum, a difference, a sign, a sine */
    switch (node->term) {
    case ISO_TERM_MUL: slope[0] = largest_of(b), slope[1] = largest_of(a); break;
    case ISO_TERM_DIV: slope[0] = 1 / least_of(b), slope[1] = largest_of(value) / least_of(b); break;
    case ISO_TERM_POWER:
        slope[0] = largest_of(product(b, power(a, (range){b.low - 1, b.high - 1})));
        slope[1] = b.low == b.high ? 0 : largest_of(value) * fmax(fabs(log(largest_of(a))), fabs(log(least_of(a))));
        break;
    case ISO_TERM_SQRT: slope[0] = 0.5 / value.low; break;
    case ISO_TERM_EXP: slope[0] = value.high; break;
    case ISO_TERM_LOG: slope[0] = 1 / least_of(a); break;
    default: break;
    }
}

/* weight[i] of the header; that of the root is 1. */
static void find_weights(const iso_expression *e, const range x[], double weight[])
{
    for (int i = 0; i < e->nodes; i++) weight[i] = i == e->root;
    for (int i = e->root; i >= 0; i--) {
        const iso_expression_node *node = &e->node[i];
        double slope[2];
        if (weight[i] == 0 || !is_operation(node->term)) continue;
        steepest(node, x, x[i], slope);
        if (slope[0] > 0) weight[node->a] += weight[i] * slope[0];
        if (has_two(node->term) && slope[1] > 0) weight[node->b] += weight[i] * slope[1];
        if (isnan(slope[0]) || isnan(slope[1])) weight[node->a] = INFINITY;
    }
}

/* |p| log of the largest over the least value */
static double factors(range a, double p)
{
    const double least = least_of(a);
    return p == 0 ? 0 : least > 0 ? fabs(p) * log(largest_of(a) / least) : INFINITY;
}

/* A power of n1 or omega1 up to this one is as wide as n1 or omega1 itself, also next to its zero. */
enum { LOW_POWER = 4 };

static double variation_of(const iso_expression_node *node, const range x[], const double variation[],
                           const iso_expression_box *box)
{
    const double a = is_operation(node->term) ? variation[node->a] : 0,
                 b = has_two(node->term) ? variation[node->b] : 0;
    const range of_a = is_operation(node->term) ? x[node->a] : everything,
                of_b = has_two(node->term) ? x[node->b] : everything;
    switch (node->term) {
    case ISO_TERM_N: return 2 * box->n;
    case ISO_TERM_OMEGA: return box->omega > 0 ? box->omega / (norm(box->middle.omega) + box->omega) / LOW_POWER : 0;
    case ISO_TERM_E: return 2 * box->e;
    case ISO_TERM_ADD:
    case ISO_TERM_SUB: return fmax(a, b);
    case ISO_TERM_MUL: return a + b;
    case ISO_TERM_DIV: return a + b + factors(of_b, 1);
    case ISO_TERM_POWER:
        if (of_b.low != of_b.high) return a + b + largest_of(of_b) * factors(of_a, 1);
        if (is_whole(of_b) && of_b.low >= 0 && of_b.low <= LOW_POWER) return of_b.low * a;
        if (is_whole(of_b) && of_b.low >= 0) return of_b.low * fmax(a, least_of(of_a) > 0 ? factors(of_a, 1) : 0);
        return a + factors(of_a, of_b.low);
    case ISO_TERM_NEGATIVE: return a;
    case ISO_TERM_SQRT: return a + factors(of_a, 0.5);
    case ISO_TERM_LOG: return a + factors(of_a, 1);
    case ISO_TERM_EXP:
    case ISO_TERM_SIN:
    case ISO_TERM_COS: return a + (of_a.high - of_a.low);
    default: return 0;
    }
}

double iso_expression_variation(const iso_expression *e, const iso_expression_box *box, double least)
{
    range x[ISO_EXPRESSION_NODES];
    double weight[ISO_EXPRESSION_NODES], variation[ISO_EXPRESSION_NODES];
    for (int i = 0; i < e->nodes; i++) x[i] = range_of(&e->node[i], x, box);
    find_weights(e, x, weight);
    for (int i = 0; i < e->nodes; i++) {
        const bool matters = !((x[i].high - x[i].low) * weight[i] <= least);
        variation[i] =
            matters && e->node[i].degree != ISO_CONSTANT ? variation_of(&e->node[i], x, variation, box) : 0;
    }
    return isnan(variation[e->root]) ? INFINITY : variation[e->root];
}

int iso_expression_degree(const iso_expression *e)
{
    double degree[ISO_EXPRESSION_NODES];
    for (int i = 0; i < e->nodes; i++) {
        const iso_expression_node *node = &e->node[i];
        const double a = is_operation(node->term) ? degree[node->a] : 0,
                     b = has_two(node->term) ? degree[node->b] : 0;
        const iso_expression_node *exponent = has_two(node->term) ? &e->node[node->b] : NULL;
        const bool many = node->term == ISO_TERM_POWER && exponent->term == ISO_TERM_NUMBER && exponent->value > 1;
        degree[i] = many                                                       ? a * exponent->value
                    : node->term == ISO_TERM_MUL || node->term == ISO_TERM_DIV ? a + b
                    : is_operation(node->term)                                 ? fmax(a, b)
                                                                               : node->degree != ISO_CONSTANT;
    }
    return degree[e->root] < 1e6 ? (int)degree[e->root] : 1000000;
}
