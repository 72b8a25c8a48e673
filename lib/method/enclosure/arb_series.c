/* arb_series.c - Taylor series of the solutions of a tape, and a bound for what is left out (arb_tape_impl.h).
 *
 * The coefficients up to the order K are balls, which hold those of each solution that begins in the given set. The
 * rest is bounded thus. Let S_N be, for each node, the sum of |coefficient n| h^n over K < n <= N. The recurrences give
 * S_(N+1) <= Phi(S_N), where Phi is made of sums and products of numbers >= 0 and so is increasing. If Phi(T) <= T for
 * some T, then S_K = 0 <= T, and by induction S_N <= T for all N. So the series converge for |t| <= h, where they are
 * the solutions, and the rest is at most T. Nothing need be known of the solutions before.
 *
 * With A, A_1 the sums of the known |a_n| h^n from n = 0 and from n = 1 on, and a sum over K + 1 <= n of products of
 * known terms alone in [A B]:
 *
 *     c = a b                T_c >= [A B] + T_a (B + T_b) + A T_b
 *     c = a/b                b_0 c_n = a_n - sum_(i>0) b_i c_(n-i)
 *                            (|b_0| - B_1 - T_b) T_c >= T_a + [B_1 C] + T_b C
 *     c = a^p                n a_0 c_n = sum_(i>0) (p i - (n - i)) a_i c_(n-i),    |p i - (n - i)| <= n max(1, |p|)
 *                            (|a_0| - m (A_1 + T_a)) T_c >= m ([A_1 C] + T_a C),   m = max(1, |p|)
 *     state x' = r           x_(n+1) = r_n/(n + 1):    T_x >= h/(K + 1) (|r_K| h^K + T_r)
 */
#include <math.h>

#include "method/enclosure/arb_tape_impl.h"

/* --- memory ------------------------------------------------------------------------------------------------------ */

void iso_series_init(iso_series *s, const iso_tape *f, slong bits, int order)
{
    const size_t nodes = (size_t)f->nodes;
    *s = (iso_series){.f = f, .bits = bits, .order = order};
    s->series = flint_malloc(nodes * sizeof *s->series);
    s->term = flint_malloc(nodes * sizeof *s->term);
    s->sum = flint_malloc(nodes * sizeof *s->sum);
    for (int i = 0; i < f->nodes; i++) {
        s->series[i] = _arb_vec_init(order + 1);
        s->term[i] = _mag_vec_init(order + 1);
        s->sum[i] = _mag_vec_init(order + 2);
    }
    s->known_part = _mag_vec_init(f->nodes);
    s->tail = _mag_vec_init(f->nodes);
    s->next = _mag_vec_init(f->nodes);
    s->power = _arb_vec_init(order + 1);
    s->weight = _arb_vec_init(order + 1);
    s->inverse = _arb_vec_init(order + 1);
    for (int n = 1; n <= order; n++) {
        arb_set_si(s->inverse + n, n);
        arb_inv(s->inverse + n, s->inverse + n, bits + 10);
    }
    mag_init(s->step);
}

void iso_series_clear(iso_series *s)
{
    for (int i = 0; i < s->f->nodes; i++) {
        _arb_vec_clear(s->series[i], s->order + 1);
        _mag_vec_clear(s->term[i], s->order + 1);
        _mag_vec_clear(s->sum[i], s->order + 2);
    }
    flint_free(s->series), flint_free(s->term), flint_free(s->sum);
    _mag_vec_clear(s->known_part, s->f->nodes);
    _mag_vec_clear(s->tail, s->f->nodes);
    _mag_vec_clear(s->next, s->f->nodes);
    _arb_vec_clear(s->power, s->order + 1);
    _arb_vec_clear(s->weight, s->order + 1);
    _arb_vec_clear(s->inverse, s->order + 1);
    mag_clear(s->step);
}

/* --- coefficients ------------------------------------------------------------------------------------------------ */

/* The bits of coefficient n: at the end of a step it counts about 2^-(bits n/order) of the first. */
static slong bits_of(const iso_series *s, int n)
{
    enum { SPARE = 24 };
    const slong fewer = s->bits * n / s->order - SPARE;
    return s->bits - (fewer > 0 ? fewer : 0);
}

/* Coefficient n of c = a^p: sum_(i > 0) ((p + 1) i - n) a_i c_(n - i)/(n a_0). weight: i a_i. */
static void expand_power(iso_series *s, const iso_tape_node *node, int n, slong bits, arb_ptr c)
{
    arb_srcptr a = s->series[node->a];
    arb_t first, second;
    if (n == 0) {
        arb_pow(c, a, node->number, bits);
        return;
    }
    arb_init(first), arb_init(second);
    for (int i = 1; i <= n; i++) arb_mul_ui(s->weight + i, a + i, (ulong)i, bits);
    arb_dot(first, NULL, 0, s->weight + 1, 1, c + n - 1, -1, n, bits);
    arb_dot(second, NULL, 0, a + 1, 1, c + n - 1, -1, n, bits);
    arb_div_ui(first, first, (ulong)n, bits);
    arb_sub(second, first, second, bits);
    arb_addmul(second, first, node->number, bits);
    arb_div(c + n, second, a, bits);
    arb_clear(first), arb_clear(second);
}

static void expand_node(iso_series *s, int i, int n, slong bits)
{
    const iso_tape_node *node = &s->f->node[i];
    arb_srcptr a = node->a < 0 ? NULL : s->series[node->a], b = node->b < 0 ? NULL : s->series[node->b];
    arb_ptr c = s->series[i];
    switch (node->kind) {
    case ISO_TAPE_STATE: break;
    case ISO_TAPE_CONSTANT:
        if (n == 0) arb_set(c, node->number);
        if (n > 0) arb_zero(c + n);
        break;
    case ISO_TAPE_SUM: arb_add(c + n, a + n, b + n, bits); break;
    case ISO_TAPE_LESS: arb_sub(c + n, a + n, b + n, bits); break;
    case ISO_TAPE_SCALED: arb_mul(c + n, a + n, node->number, bits); break;
    case ISO_TAPE_PRODUCT: arb_dot(c + n, NULL, 0, a, 1, b + n, -1, n + 1, bits); break;
    case ISO_TAPE_QUOTIENT: /* (a_n - sum_(i > 0) b_i c_(n - i))/b_0 */
        if (n == 0) arb_set(c, a);
        if (n > 0) arb_dot(c + n, a + n, 1, b + 1, 1, c + n - 1, -1, n, bits);
        arb_div(c + n, c + n, b, bits);
        break;
    case ISO_TAPE_POWER: expand_power(s, node, n, bits, c); break;
    }
}

bool iso_series_expand(iso_series *s, arb_srcptr at)
{
    const iso_tape *f = s->f;
    s->known = 0;
    for (int i = 0; i < f->states; i++) arb_set(s->series[f->state[i]], at + i);
    for (int n = 0; n <= s->order; n++) {
        const slong bits = bits_of(s, n);
        for (int i = 0; i < f->nodes; i++) {
            if (!iso_monitor_goes_on(&s->monitor)) return false;
            expand_node(s, i, n, bits);
        }
        for (int i = 0; i < f->states && n < s->order; i++) {
            const int x = f->state[i];
            arb_mul(s->series[x] + n + 1, s->series[f->node[x].rate] + n, s->inverse + n + 1, bits);
        }
        s->known = n + 1;
    }
    return true;
}

/* --- the rest ---------------------------------------------------------------------------------------------------- */

/* [A B]; without a_0 b_n: no such n is known. */
static void sum_product(const iso_series *s, int a, int b, mag_t x)
{
    mag_zero(x);
    for (int i = 1; i <= s->order; i++) mag_addmul(x, s->term[a] + i, s->sum[b] + s->order + 1 - i);
}

/* term[n] and sum[n] of factors; of other nodes the last term alone, which is wanted of rates. */
static void sum_up(iso_series *s)
{
    mag_ptr power = _mag_vec_init(s->order + 1);
    for (int n = 0; n <= s->order; n++) mag_pow_ui(power + n, s->step, (ulong)n);
    for (int i = 0; i < s->f->nodes; i++) {
        mag_zero(s->sum[i] + s->order + 1);
        for (int n = s->order; n >= (s->f->node[i].factor ? 0 : s->order); n--) {
            arb_get_mag(s->term[i] + n, s->series[i] + n);
            mag_mul(s->term[i] + n, s->term[i] + n, power + n);
            mag_add(s->sum[i] + n, s->sum[i] + n + 1, s->term[i] + n);
        }
    }
    for (int i = 0; i < s->f->nodes; i++) {
        const iso_tape_node *node = &s->f->node[i];
        if (node->kind == ISO_TAPE_PRODUCT) sum_product(s, node->a, node->b, s->known_part + i);
        if (node->kind == ISO_TAPE_QUOTIENT) sum_product(s, node->b, i, s->known_part + i);
        if (node->kind == ISO_TAPE_POWER) sum_product(s, node->a, i, s->known_part + i);
    }
    _mag_vec_clear(power, s->order + 1);
}

static void bound_product(const iso_series *s, int a, int b, int c)
{
    mag_ptr x = s->tail + c;
    mag_t whole;
    mag_init(whole);
    mag_add(whole, s->sum[b], s->tail + b);
    mag_mul(x, s->tail + a, whole);
    mag_addmul(x, s->sum[a], s->tail + b);
    mag_add(x, x, s->known_part + c);
    mag_clear(whole);
}

/* The tail of c from (|b_0| - factor (B_1 + T_b)) T_c = factor ([B_1 C] + T_b C) + T_a; a < 0: T_a is 0. False: b may
 * be 0. */
static bool bound_divided(const iso_series *s, int a, int b, const mag_t factor, int c)
{
    mag_t top, below, moving;
    mag_init(top), mag_init(below), mag_init(moving);
    mag_mul(top, s->tail + b, s->sum[c]);
    mag_add(top, top, s->known_part + c);
    mag_mul(top, top, factor);
    if (a >= 0) mag_add(top, top, s->tail + a);
    mag_add(moving, s->sum[b] + 1, s->tail + b);
    mag_mul(moving, moving, factor);
    arb_get_mag_lower(below, s->series[b]);
    mag_sub_lower(below, below, moving);
    const bool apart = !mag_is_zero(below);
    if (apart) mag_div(s->tail + c, top, below);
    mag_clear(top), mag_clear(below), mag_clear(moving);
    return apart;
}

static bool bound_node(const iso_series *s, int i)
{
    const iso_tape_node *node = &s->f->node[i];
    mag_t size, one;
    bool apart = true;
    mag_init(size), mag_init(one);
    switch (node->kind) {
    case ISO_TAPE_STATE: break;
    case ISO_TAPE_CONSTANT: mag_zero(s->tail + i); break;
    case ISO_TAPE_SUM:
    case ISO_TAPE_LESS: mag_add(s->tail + i, s->tail + node->a, s->tail + node->b); break;
    case ISO_TAPE_SCALED:
        arb_get_mag(size, node->number);
        mag_mul(s->tail + i, s->tail + node->a, size);
        break;
    case ISO_TAPE_PRODUCT: bound_product(s, node->a, node->b, i); break;
    case ISO_TAPE_QUOTIENT:
        mag_one(size);
        apart = bound_divided(s, node->a, node->b, size, i);
        break;
    case ISO_TAPE_POWER:
        mag_one(one);
        arb_get_mag(size, node->number);
        mag_max(size, size, one);
        apart = arb_is_positive(s->series[node->a]) && bound_divided(s, -1, node->a, size, i);
        break;
    }
    mag_clear(size), mag_clear(one);
    return apart;
}

bool iso_series_bound(iso_series *s, const arb_t h)
{
    enum { TRIES = 6 };
    const iso_tape *f = s->f;
    bool closed = false;
    arb_get_mag(s->step, h);
    sum_up(s);
    for (int i = 0; i < f->nodes; i++) mag_zero(s->tail + i);
    for (int i = 0; i < TRIES && !closed; i++) {
        /* next = Phi(tail) of the states; the tails of other nodes are made of those of the states on the way */
        for (int j = 0; j < f->nodes; j++)
            if (!bound_node(s, j)) return false;
        for (int j = 0; j < f->states; j++) {
            const int rate = f->node[f->state[j]].rate;
            mag_add(s->next + j, s->term[rate] + s->order, s->tail + rate);
            mag_mul(s->next + j, s->next + j, s->step);
            mag_div_ui(s->next + j, s->next + j, (ulong)s->order + 1);
        }
        closed = i > 0;
        for (int j = 0; j < f->states; j++) closed = closed && mag_cmp(s->next + j, s->tail + f->state[j]) <= 0;
        for (int j = 0; j < f->states; j++) mag_mul_2exp_si(s->tail + f->state[j], s->next + j, closed ? 0 : 1);
    }
    for (int i = 0; i < f->states && closed; i++) closed = mag_is_finite(s->tail + f->state[i]);
    return closed;
}

/* --- values ------------------------------------------------------------------------------------------------------ */

void iso_series_at(iso_series *s, const arb_t t, int first, int count, arb_ptr to)
{
    mag_t part, rest;
    mag_init(part), mag_init(rest);
    arb_get_mag(part, t); /* (|t|/h)^(K + 1): what is left out is at most so much of what is left out at h */
    mag_div(part, part, s->step);
    mag_pow_ui(part, part, (ulong)s->order + 1);
    if (mag_cmp_2exp_si(part, 0) > 0) mag_one(part); /* rounding, at |t| = h */
    arb_one(s->power);
    for (int n = 1; n <= s->order && iso_monitor_goes_on(&s->monitor); n++)
        arb_mul(s->power + n, s->power + n - 1, t, s->bits + 10);
    for (int i = 0; i < count && iso_monitor_goes_on(&s->monitor); i++) {
        const int x = s->f->state[first + i];
        arb_dot(to + i, NULL, 0, s->series[x], 1, s->power, 1, s->order + 1, s->bits);
        mag_mul(rest, s->tail + x, part);
        arb_add_error_mag(to + i, rest);
    }
    mag_clear(part), mag_clear(rest);
}

double iso_series_size(const iso_series *s, int state, int n)
{
    mag_t size;
    mag_init(size);
    arf_get_mag(size, arb_midref(s->series[s->f->state[state]] + n));
    const double log2_size = mag_is_zero(size) ? -INFINITY : mag_get_d_log2_approx(size);
    mag_clear(size);
    return log2_size;
}
