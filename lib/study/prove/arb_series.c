/* arb_series.c - Taylor series of the orbit and of its neighbours, and a bound for what is left out (arb_flow_impl.h).
 *
 * The coefficients up to the order K are balls, which hold those of each orbit that begins in the given set. The rest
 * is bounded thus. Let S_N be, for each number, the sum of |coefficient n| h^n over K < n <= N. The equations give
 * coefficient n + 1 from coefficients up to n, so S_(N+1) <= Phi(S_N), where Phi is made of sums and products of
 * non-negative numbers and so is increasing. If Phi(t) <= t, then S_K = 0 <= t, and by induction S_N <= t for all N.
 * So the series converge for |s| <= h, which are the orbit there, and the rest is at most t. Nothing is known or
 * needed of the orbit before. An integral divides coefficient n by n + 1 > K, so t is found at once, for a large h.
 */
#include <math.h>

#include "study/prove/arb_flow_impl.h"

/* --- memory ----------------------------------------------------------------------------------------------------- */

void prove_flow_init(prove_flow *f, iso_context *ctx, slong bits, iso_proof_work *work)
{
    f->ctx = ctx;
    f->bits = bits;
    f->order = (int)(0.33 * (double)bits) + 4;
    f->parts = 1;
    f->certificate = NULL;
    f->steps = 0;
    f->work = work;
    arb_init(f->k), arb_init(f->inverse_k), arb_init(f->trace);
    for (int i = 0; i < 3; i++) arb_init(f->J[i]);
    for (int i = 0; i < PROVE_SERIES; i++) {
        f->series[i] = _arb_vec_init(f->order + 1);
        f->term[i] = _mag_vec_init(f->order + 1);
        f->sum[i] = _mag_vec_init(f->order + 2);
        mag_init(f->tail[i]);
    }
    f->power = _arb_vec_init(f->order + 1);
    mag_init(f->step);
}

void prove_flow_clear(prove_flow *f)
{
    arb_clear(f->k), arb_clear(f->inverse_k), arb_clear(f->trace);
    for (int i = 0; i < 3; i++) arb_clear(f->J[i]);
    for (int i = 0; i < PROVE_SERIES; i++) {
        _arb_vec_clear(f->series[i], f->order + 1);
        _mag_vec_clear(f->term[i], f->order + 1);
        _mag_vec_clear(f->sum[i], f->order + 2);
        mag_clear(f->tail[i]);
    }
    _arb_vec_clear(f->power, f->order + 1);
    mag_clear(f->step);
}

void prove_flow_like(prove_flow *f, const prove_flow *like, slong bits)
{
    prove_flow_init(f, like->ctx, bits, like->work);
    arb_set(f->k, like->k), arb_set(f->inverse_k, like->inverse_k), arb_set(f->trace, like->trace);
    for (int i = 0; i < 3; i++) arb_set(f->J[i], like->J[i]);
}

/* --- coefficients ----------------------------------------------------------------------------------------------- */

/* The bits of coefficient n: at the end of a step it counts about 2^-(bits n/order) of the first. */
static slong bits_of(const prove_flow *f, int n)
{
    enum { SPARE = 24 };
    const slong fewer = f->bits * n / f->order - SPARE;
    return f->bits - (fewer > 0 ? fewer : 0);
}

/* x = coefficient n of the product of series a and b. */
static void multiply(const prove_flow *f, int a, int b, int n, arb_t x)
{
    arb_dot(x, NULL, 0, f->series[a], 1, f->series[b] + n, -1, n + 1, bits_of(f, n));
}

/* Coefficient n of c, where k q c = +-a: (+-a_n/k - sum_(i > 0) q_i c_(n - i))/q_0. */
static void divide(prove_flow *f, int a, bool negative, int n, int c)
{
    const slong bits = bits_of(f, n);
    arb_ptr x = f->series[c] + n;
    arb_t top;
    arb_init(top);
    arb_mul(top, f->series[a] + n, f->inverse_k, bits);
    if (negative) arb_neg(top, top);
    if (n > 0) arb_dot(top, top, 1, f->series[PROVE_Q] + 1, 1, f->series[c] + n - 1, -1, n, bits);
    arb_div(x, top, f->series[PROVE_Q], bits);
    arb_clear(top);
}

/* The series that are no state of their own, coefficient n. */
static void expand_rest(prove_flow *f, int n, int numbers)
{
    const slong bits = bits_of(f, n);
    arb_ptr e = f->series[PROVE_E] + n, twist = f->series[PROVE_TWIST] + n, H = f->series[PROVE_H] + n;
    arb_add(e, f->series[PROVE_Q] + n, f->series[PROVE_F] + n, bits);
    arb_neg(e, e);
    if (n == 0) arb_add(e, e, f->trace, bits);
    arb_sub(twist, e, f->series[PROVE_F] + n, bits);
    divide(f, PROVE_P, true, n, PROVE_KAPPA);
    if (numbers == PROVE_POINT) return;
    divide(f, PROVE_R, false, n, PROVE_RHO);
    arb_sub(f->series[PROVE_EXCESS] + n, e, f->series[PROVE_Q] + n, bits);
    divide(f, PROVE_EXCESS, false, n, PROVE_ETA);
    multiply(f, PROVE_KAPPA, PROVE_KAPPA, n, f->series[PROVE_SQUARE] + n);
    arb_mul(H, f->series[PROVE_SQUARE] + n, f->k, bits);
    arb_mul_2exp_si(H, H, 1);
    arb_sub(H, f->series[PROVE_SQUARE] + n, H, bits);
    arb_add(H, H, f->series[PROVE_ETA] + n, bits);
    if (n == 0) arb_add_ui(H, H, 1, bits);
}

/* rate[i]: coefficient n of the derivative of number i. */
static void expand_rates(const prove_flow *f, int n, int numbers, arb_ptr rate)
{
    const slong bits = bits_of(f, n);
    const arb_srcptr q = f->series[PROVE_Q] + n, r = f->series[PROVE_R] + n, p = f->series[PROVE_P] + n,
                     ff = f->series[PROVE_F] + n, d = f->series[PROVE_D] + n;
    arb_mul_2exp_si(rate + PROVE_Q, r, 1);
    multiply(f, PROVE_KAPPA, PROVE_P, n, rate + PROVE_R);
    arb_add(rate + PROVE_R, rate + PROVE_R, ff, bits);
    arb_sub(rate + PROVE_R, rate + PROVE_R, q, bits);
    multiply(f, PROVE_KAPPA, PROVE_R, n, rate + PROVE_P);
    arb_sub(rate + PROVE_P, d, rate + PROVE_P, bits);
    multiply(f, PROVE_KAPPA, PROVE_D, n, rate + PROVE_F);
    arb_sub(rate + PROVE_F, rate + PROVE_F, r, bits);
    arb_mul_2exp_si(rate + PROVE_F, rate + PROVE_F, 1);
    multiply(f, PROVE_KAPPA, PROVE_TWIST, n, rate + PROVE_D);
    arb_sub(rate + PROVE_D, rate + PROVE_D, p, bits);
    arb_set(rate + PROVE_G, f->series[PROVE_W] + n);
    multiply(f, PROVE_KAPPA, PROVE_Z, n, rate + PROVE_W);
    arb_sub(rate + PROVE_W, rate + PROVE_W, f->series[PROVE_G] + n, bits);
    multiply(f, PROVE_KAPPA, PROVE_W, n, rate + PROVE_Z);
    arb_neg(rate + PROVE_Z, rate + PROVE_Z);
    for (int y = PROVE_Y1; y < numbers; y += 2) {
        arb_set(rate + y, f->series[y + 1] + n);
        multiply(f, PROVE_H, y, n, rate + y + 1);
        arb_neg(rate + y + 1, rate + y + 1);
        arb_dot(rate + y + 1, rate + y + 1, 0, f->series[PROVE_RHO], 1, f->series[y + 1] + n, -1, n + 1, bits);
        if (y == PROVE_Y3) arb_submul(rate + y + 1, f->series[PROVE_KAPPA] + n, f->inverse_k, bits);
    }
}

void prove_series_expand(prove_flow *f, arb_srcptr y, int numbers)
{
    arb_ptr rate = _arb_vec_init(PROVE_STATE);
    for (int i = 0; i < numbers; i++) arb_set(f->series[i], y + i);
    for (int n = 0; n < f->order; n++) {
        expand_rest(f, n, numbers);
        expand_rates(f, n, numbers, rate);
        for (int i = 0; i < numbers; i++) arb_div_ui(f->series[i] + n + 1, rate + i, (ulong)n + 1, bits_of(f, n));
    }
    expand_rest(f, f->order, numbers);
    _arb_vec_clear(rate, PROVE_STATE);
}

/* --- the rest --------------------------------------------------------------------------------------------------- */

/* Which series there are. */
static bool is_used(int i, int numbers)
{
    if (i < PROVE_STATE) return i < numbers;
    return numbers > PROVE_POINT || i == PROVE_KAPPA || i == PROVE_TWIST || i == PROVE_E;
}

/* term[n] and sum[n] of all series. */
static void sum_up(prove_flow *f, int numbers)
{
    mag_ptr power = _mag_vec_init(f->order + 1);
    for (int n = 0; n <= f->order; n++) mag_pow_ui(power + n, f->step, (ulong)n);
    for (int i = 0; i < PROVE_SERIES; i++) {
        if (!is_used(i, numbers)) continue;
        mag_zero(f->sum[i] + f->order + 1);
        for (int n = f->order; n >= 0; n--) {
            arb_get_mag(f->term[i] + n, f->series[i] + n);
            mag_mul(f->term[i] + n, f->term[i] + n, power + n);
            mag_add(f->sum[i] + n, f->sum[i] + n + 1, f->term[i] + n);
        }
    }
    _mag_vec_clear(power, f->order + 1);
}

/* x >= the sum of |coefficient n| h^n, n >= from, of the product of a and b, whose tails are t[a] and t[b]. */
static void bound_product(const prove_flow *f, mag_t t[], int a, int b, int from, mag_t x)
{
    mag_t whole;
    mag_init(whole);
    mag_add(whole, f->sum[b], t[b]);
    mag_mul(x, t[a], whole);
    mag_addmul(x, f->sum[a], t[b]);
    for (int n = 0; n <= f->order; n++) mag_addmul(x, f->term[a] + n, f->sum[b] + (n < from ? from - n : 0));
    mag_clear(whole);
}

/* t[c] of a quotient, k q c = +-a. With Q, C the known parts of q and c: q (c - C) = +-a's tail/k - (Q C from order + 1
 * on) - q's tail C. False: q may be 0. */
static bool bound_quotient(const prove_flow *f, mag_t t[], int a, int c)
{
    mag_t top, below, inverse_k;
    mag_init(top), mag_init(below), mag_init(inverse_k);
    mag_zero(t[c]);
    bound_product(f, t, PROVE_Q, c, f->order + 1, top);
    arb_get_mag(inverse_k, f->inverse_k);
    mag_addmul(top, t[a], inverse_k);
    arb_get_mag_lower(below, f->series[PROVE_Q]);
    mag_sub_lower(below, below, f->sum[PROVE_Q] + 1);
    mag_sub_lower(below, below, t[PROVE_Q]);
    const bool apart = !mag_is_zero(below);
    if (apart) mag_div(t[c], top, below);
    mag_clear(top), mag_clear(below), mag_clear(inverse_k);
    return apart;
}

/* x += |factor| times what series i has from coefficient `order` on. */
static void add_rest(const prove_flow *f, mag_t t[], int i, ulong factor, mag_t x)
{
    mag_t rest;
    mag_init(rest);
    mag_add(rest, f->sum[i] + f->order, t[i]);
    mag_mul_ui(rest, rest, factor);
    mag_add(x, x, rest);
    mag_clear(rest);
}

/* The series that are no state of their own. */
static bool bound_rest(const prove_flow *f, mag_t t[], int numbers)
{
    mag_add(t[PROVE_E], t[PROVE_Q], t[PROVE_F]);
    mag_add(t[PROVE_TWIST], t[PROVE_E], t[PROVE_F]);
    if (!bound_quotient(f, t, PROVE_P, PROVE_KAPPA)) return false;
    if (numbers == PROVE_POINT) return true;
    mag_add(t[PROVE_EXCESS], t[PROVE_E], t[PROVE_Q]);
    if (!bound_quotient(f, t, PROVE_R, PROVE_RHO) || !bound_quotient(f, t, PROVE_EXCESS, PROVE_ETA)) return false;
    mag_t factor;
    arb_t one_minus_2k;
    mag_init(factor), arb_init(one_minus_2k);
    bound_product(f, t, PROVE_KAPPA, PROVE_KAPPA, f->order + 1, t[PROVE_SQUARE]);
    arb_mul_2exp_si(one_minus_2k, f->k, 1);
    arb_sub_ui(one_minus_2k, one_minus_2k, 1, f->bits);
    arb_get_mag(factor, one_minus_2k);
    mag_mul(t[PROVE_H], t[PROVE_SQUARE], factor);
    mag_add(t[PROVE_H], t[PROVE_H], t[PROVE_ETA]);
    mag_clear(factor), arb_clear(one_minus_2k);
    return true;
}

/* next = Phi(t): from the rates, from coefficient `order` on, times h/(order + 1). */
static bool bound_again(const prove_flow *f, mag_t t[], int numbers, mag_t next[])
{
    static const struct {
        int product, linear[2];
        ulong factor;
    } rates[PROVE_POINT] = {{-1, {PROVE_R, -1}, 2},          {PROVE_P, {PROVE_F, PROVE_Q}, 1},
                            {PROVE_R, {PROVE_D, -1}, 1},     {PROVE_D, {PROVE_R, -1}, 2},
                            {PROVE_TWIST, {PROVE_P, -1}, 1}, {-1, {PROVE_W, -1}, 1},
                            {PROVE_Z, {PROVE_G, -1}, 1},     {PROVE_W, {-1, -1}, 1}};
    if (!bound_rest(f, t, numbers)) return false;
    for (int i = 0; i < PROVE_POINT; i++) {
        mag_zero(next[i]);
        if (rates[i].product >= 0) bound_product(f, t, PROVE_KAPPA, rates[i].product, f->order, next[i]);
        mag_mul_ui(next[i], next[i], rates[i].factor);
        for (int j = 0; j < 2; j++)
            if (rates[i].linear[j] >= 0) add_rest(f, t, rates[i].linear[j], rates[i].factor, next[i]);
    }
    for (int y = PROVE_Y1; y < numbers; y += 2) {
        mag_t other, inverse_k;
        mag_init(other), mag_init(inverse_k);
        mag_zero(next[y]);
        add_rest(f, t, y + 1, 1, next[y]);
        bound_product(f, t, PROVE_RHO, y + 1, f->order, next[y + 1]);
        bound_product(f, t, PROVE_H, y, f->order, other);
        mag_add(next[y + 1], next[y + 1], other);
        mag_zero(other);
        if (y == PROVE_Y3) add_rest(f, t, PROVE_KAPPA, 1, other);
        arb_get_mag(inverse_k, f->inverse_k);
        mag_addmul(next[y + 1], other, inverse_k);
        mag_clear(other), mag_clear(inverse_k);
    }
    for (int i = 0; i < numbers; i++) {
        mag_mul(next[i], next[i], f->step);
        mag_div_ui(next[i], next[i], (ulong)f->order + 1);
    }
    return true;
}

bool prove_series_bound(prove_flow *f, const arb_t h, int numbers)
{
    enum { TRIES = 6 };
    mag_t next[PROVE_STATE];
    bool closed = false;
    arb_get_mag(f->step, h);
    sum_up(f, numbers);
    for (int i = 0; i < PROVE_STATE; i++) mag_init(next[i]);
    for (int i = 0; i < PROVE_SERIES; i++) mag_zero(f->tail[i]);
    for (int i = 0; i < TRIES && !closed; i++) {
        if (!bound_again(f, f->tail, numbers, next)) break;
        closed = i > 0;
        for (int j = 0; j < numbers; j++) closed = closed && mag_cmp(next[j], f->tail[j]) <= 0;
        for (int j = 0; j < numbers; j++) mag_mul_2exp_si(f->tail[j], next[j], closed ? 0 : 1);
    }
    for (int i = 0; i < PROVE_STATE; i++) mag_clear(next[i]);
    return closed;
}

/* --- values ----------------------------------------------------------------------------------------------------- */

/* The logarithm of |coefficient n|, base 2. */
static double size_of(const prove_flow *f, int i, int n)
{
    mag_t size;
    mag_init(size);
    arf_get_mag(size, arb_midref(f->series[i] + n));
    const double log2_size = mag_is_zero(size) ? -INFINITY : mag_get_d_log2_approx(size);
    mag_clear(size);
    return log2_size;
}

/* p, d and z are small near O, and are known there to as many digits as the others. */
double prove_series_guess_step(const prove_flow *f, int numbers)
{
    const double small = fmax(size_of(f, PROVE_P, 0), fmax(size_of(f, PROVE_D, 0), size_of(f, PROVE_Z, 0)));
    double steepest = 0;
    for (int i = 0; i < numbers; i++) {
        const bool is_small = i == PROVE_P || i == PROVE_D || i == PROVE_Z;
        const double unit = is_small && isfinite(small) ? small : 0;
        for (int n = f->order - 1; n <= f->order; n++)
            steepest = fmax(steepest, (size_of(f, i, n) - unit + (double)f->bits) / n);
    }
    return exp2(-steepest);
}

void prove_series_powers(prove_flow *f, const arb_t s)
{
    arb_one(f->power);
    for (int n = 1; n <= f->order; n++) arb_mul(f->power + n, f->power + n - 1, s, f->bits + 10);
}

void prove_series_value(prove_flow *f, int number, arb_t x)
{
    arb_dot(x, NULL, 0, f->series[number], 1, f->power, 1, f->order + 1, f->bits);
    arb_add_error_mag(x, f->tail[number]);
}

void prove_series_at(prove_flow *f, const arb_t s, int numbers, arb_ptr y)
{
    prove_series_powers(f, s);
    for (int i = 0; i < numbers; i++) prove_series_value(f, i, y + i);
}
