/* arb_search.c - looks for the orbit of the unstable manifold that meets l = pi/2. Nothing here is part of a proof: a
 * wrong answer makes the proof fail (arb_follow.c), it does not make it wrong. */
#include <math.h>

#include "base/math_impl.h"
#include "instrument/prove/arb_manifold_impl.h"

enum { POINTS = 8, LOW_BITS = 80, FAR = -14, TRIES = 60 };

/* --- orbits of points ------------------------------------------------------------------------------------------- */

static iso_status advance(prove_flow *f, arb_struct z[2])
{
    prove_half half;
    ISO_BALLS_OF(half);
    ISO_TRY(prove_half_return(f, (prove_part){0, 1}, z, z + 1, PROVE_POINT, &half));
    for (int i = 0; i < 2; i++) arb_get_mid_arb(z + i, half.z + i);
    return ISO_OK;
}

/* l - pi/2, of a curve that comes from l = 0: below 0 until the line, also where l was taken modulo pi. */
static void find_gap(const prove_flow *f, const arb_t l, arb_t gap)
{
    arb_const_pi(gap, f->bits);
    if (arf_sgn(arb_midref(l)) > 0) arb_neg(gap, gap);
    arb_mul_2exp_si(gap, gap, -1);
    arb_add(gap, gap, l, f->bits);
}

/* The gap after `halves` half returns from xi, in numbers of `bits` bits. */
static iso_status land(const prove_flow *like, slong bits, const prove_local *o, const arb_t xi, long halves,
                       arb_t gap)
{
    prove_flow f;
    ISO_BALL_ROW(z, 2);
    iso_status status = ISO_OK;
    prove_flow_like(&f, like, bits);
    arb_set_round(z, xi, bits);
    arb_mul(z + 1, z, o->s, bits);
    for (long i = 0; i < halves && status == ISO_OK; i++) status = advance(&f, z);
    find_gap(&f, z, gap);
    arb_get_mid_arb(gap, gap);
    prove_flow_clear(&f);
    return status;
}

/* --- the first crossing, roughly -------------------------------------------------------------------------------- */

/* xi = 2^FAR lambda^(i/POINTS) */
static void place(const prove_local *o, double i, arb_t xi)
{
    ISO_BALLS(power);
    arb_set_d(power, i / POINTS);
    arb_pow(xi, o->lambda, power, LOW_BITS);
    arb_mul_2exp_si(xi, xi, FAR);
    arb_get_mid_arb(xi, xi);
}

/* The manifold in pieces, from O on: after *halves half returns the line lies between the places *i - 1 and *i. */
static iso_status find_piece(prove_flow *f, const prove_local *o, int *i, long *halves)
{
    ISO_BALLS(gap);
    ISO_BALL_ROW(z, 2 * POINTS);
    for (int j = 0; j < POINTS; j++) {
        place(o, j, z + 2 * j);
        arb_mul(z + 2 * j + 1, z + 2 * j, o->s, f->bits);
    }
    for (*halves = 1;; ++*halves)
        for (*i = 0; *i < POINTS; ++*i) {
            ISO_TRY(advance(f, z + 2 * *i));
            find_gap(f, z + 2 * *i, gap);
            if (arf_sgn(arb_midref(gap)) > 0) return ISO_OK;
        }
}

/* Regula falsi (Illinois) for the place; *slope: of the gap by ln xi. */
static iso_status refine_piece(const prove_flow *f, const prove_local *o, int i, long halves, arb_t xi, double *slope)
{
    double at[2] = {i - 1, i}, value[2] = {0, 0}, weight[2] = {1, 1}, middle = i;
    ISO_BALLS(gap);
    arb_log(gap, o->lambda, f->bits);
    const double growth = arf_get_d(arb_midref(gap), ARF_RND_NEAR);
    for (int n = 0; n < TRIES && at[1] - at[0] > 1e-5; n++) {
        const double a = weight[0] * value[0], b = weight[1] * value[1];
        middle = n < 2 ? at[n] : at[0] + (at[1] - at[0]) * a / (a - b);
        place(o, middle, xi);
        ISO_TRY(land(f, f->bits, o, xi, halves, gap));
        const double found = arf_get_d(arb_midref(gap), ARF_RND_NEAR);
        const int side = n < 2 ? n : found > 0;
        at[side] = middle, value[side] = found, weight[side] = 1;
        if (n >= 2) weight[!side] /= 2;
        if (fabs(found) < 1e-7) break;
    }
    *slope = (value[1] - value[0]) / (at[1] - at[0]) * POINTS / growth;
    return ISO_OK;
}

/* --- to all digits ---------------------------------------------------------------------------------------------- */

/* The secant method for ln xi, until what is left is about a rounding error: an error e becomes e^1.6. Numbers have as
 * many bits as will be known, and the orbit begins so near to O as these ask for: where the manifold, which is odd,
 * is the line eta = 0 to a part 2^-close of xi. */
static iso_status refine(const prove_flow *f, const prove_local *o, double slope, prove_start *start)
{
    enum { KNOWN = 44, SPARE = 36 };
    ISO_BALLS(gap, last, change, steep);
    arb_set_d(steep, slope);
    double known = KNOWN;
    for (int i = 0; i < TRIES; i++) {
        const slong bits = (slong)fmin((double)f->bits, known + SPARE);
        const slong close = bits == f->bits ? 4 * bits : (slong)known;
        arb_one(gap);
        arb_mul_2exp_si(gap, gap, -close / 2 - 4);
        if (arb_lt(gap, o->size)) arb_set(gap, o->size);
        for (; !arb_lt(start->xi, gap); start->halves++) arb_div(start->xi, start->xi, o->lambda, f->bits);
        arb_get_mid_arb(start->xi, start->xi);
        ISO_TRY(land(f, bits, o, start->xi, start->halves, gap));
        if (i > 0) arb_sub(last, last, gap, f->bits), arb_div(steep, last, change, f->bits);
        arb_set(last, gap);
        arb_div(change, gap, steep, f->bits);
        arb_neg(gap, change);
        arb_exp(gap, gap, f->bits);
        arb_mul(start->xi, start->xi, gap, f->bits);
        arb_get_mid_arb(start->xi, start->xi);
        arb_get_mid_arb(change, change);
        if (bits == f->bits && arf_cmpabs_2exp_si(arb_midref(change), -bits * 62 / 100) < 0) break;
        known *= 1.6;
    }
    return ISO_OK;
}

/* What xi changes by with k, so that the line is met: with T the tangent and C what the orbit changes by with k, both
 * of the start, C_l + T_l drift = 0 at the end. */
static iso_status find_drift(prove_flow *f, const prove_local *o, prove_start *start)
{
    prove_half half;
    ISO_BALLS_OF(half);
    ISO_BALL_ROW(z, 2);
    ISO_BALL_ROW(T, 2);
    ISO_BALL_ROW(C, 2);
    arb_set(z, start->xi), arb_mul(z + 1, z, o->s, f->bits);
    arb_one(T), arb_set(T + 1, o->s);
    for (long i = 0; i < start->halves; i++) {
        ISO_TRY(prove_half_return(f, (prove_part){0, 1}, z, z + 1, PROVE_STATE, &half));
        prove_apply(half.D, T, NULL, f->bits, T);
        prove_apply(half.D, C, half.D + 4, f->bits, C);
        for (int j = 0; j < 2; j++) {
            arb_get_mid_arb(z + j, half.z + j);
            arb_get_mid_arb(T + j, T + j), arb_get_mid_arb(C + j, C + j);
        }
    }
    arb_div(start->drift, C, T, f->bits);
    arb_neg(start->drift, start->drift);
    arb_get_mid_arb(start->drift, start->drift);
    return ISO_OK;
}

iso_status prove_search(const prove_flow *f, const prove_local *o, bool with_drift, prove_start *start)
{
    prove_flow low;
    int i = 0;
    double slope = 0;
    prove_flow_like(&low, f, LOW_BITS);
    iso_status status = find_piece(&low, o, &i, &start->halves);
    if (status == ISO_OK) status = refine_piece(&low, o, i, start->halves, start->xi, &slope);
    if (status == ISO_OK) status = refine(f, o, slope, start);
    if (status == ISO_OK && with_drift) status = find_drift(&low, o, start);
    prove_flow_clear(&low);
    return status;
}
