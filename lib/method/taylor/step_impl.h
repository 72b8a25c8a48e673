/* step_impl.h - evaluates a series at a time, and chooses the length of a step. */
#include "method/taylor/form_impl.h"

/* The value of a vector's series at x (`value`), with its derivative (`value_and_rate`), and the value of a number's
 * series (`number`). */
static inline void value(const vector a[], int order, real x, real out[3])
{
    vector p = nought;
    for (int n = order; n >= 0; n--) p = plus(times(x, p), a[n]);
    for (int i = 0; i < 3; i++) out[i] = AT(p, i);
}

static inline void value_and_rate(const vector a[], const real count[], int order, real x, real out[3], real rate[3])
{
    vector p = nought, dp = nought;
#if LANES > 1 /* Horner's scheme for both: no factors n, other roundings */
    (void)count;
    for (int n = order; n >= 1; n--) {
        p = plus(times(x, p), a[n]);
        dp = plus(times(x, dp), p);
    }
#else
    for (int n = order; n >= 1; n--) {
        p = plus(times(x, p), a[n]);
        dp = plus(times(x, dp), times(count[n], a[n]));
    }
#endif
    p = plus(times(x, p), a[0]);
    for (int i = 0; i < 3; i++) out[i] = AT(p, i), rate[i] = AT(dp, i);
}

static inline real number(const real a[], int order, real x)
{
    real p = zero;
    for (int n = order; n >= 0; n--) p = p * x + a[n];
    return p;
}

/* *to = *from, without the states of effects that the model does not have. */
static inline void copy_state(const form *T, state *to, const state *from)
{
    memcpy(to, from, offsetof(state, own) + (size_t)(T->shape.moving - ISO_STATE) * sizeof(real));
}

/* The numbers of a lane as they are in the form: w, n, states of effects. */
static inline void store_moving(const form *T, int lane, const state *s, double y[])
{
    (void)lane;
    for (int i = 0; i < 3; i++) {
        y[i] = (double)LANE(s->w[i], lane);
        y[3 + i] = (double)LANE(s->n[i], lane);
    }
    for (int i = ISO_STATE; i < T->shape.moving; i++) y[i] = (double)LANE(s->own[i - ISO_STATE], lane);
}

/* In the variables of the model. */
static void store(const form *T, int lane, const state *s, double y[])
{
    const iso_model *m = &T->shape;
    store_moving(T, lane, s, y);
    if (T->is_point) {
        const real speed = pace(T, s->n);
        real M[3];
        cross_product(s->w, s->n, M);
        for (int i = 0; i < 3; i++) y[i] = (double)(LANE(M[i], lane) * LANE(speed, lane));
    }
    for (int i = 0; i < m->clocks; i++) y[m->moving + i] = (double)LANE(s->clock[m->clock_of[i]], lane);
}

/* How far each clock goes on while the own variable goes from 0 to x. Returns an estimate of the relative error. */
static inline real integrate_clocks(const form *T, real x, real gained[ISO_CLOCKS])
{
    real doubt = zero, base[NODES];
    gained[T->own] = x;
    if (T->clocks > 0) values_at_nodes(&T->rule, T->S.base, T->S.order - 1, x, base);
    for (int i = 0; i < T->clocks; i++) {
        const iso_clock c = T->clock_of[i];
        gained[c] = integral_of_power(&T->rule, base, T->power[c], x, &doubt) * T->rate[c];
    }
    return doubt;
}

/* Derived states follow from omega and n at any time. No equation of a series reads them, so doubles are enough. Each
 * orbit has its own numbers. */
static void find_derived(const form *T, state *s)
{
    for (int lane = 0; lane < LANES; lane++) {
        const iso_problem *f = &T->model[lane]->problem;
        double y[ISO_MAX_STATE] = {0};
        for (int i = 0; i < 3; i++) y[i] = (double)LANE(s->w[i], lane), y[3 + i] = (double)LANE(s->n[i], lane);
        for (int e = 0; e < ISO_EFFECTS; e++) {
            const iso_effect *effect = iso_effect_list[e];
            if (f->at[e] == 0 || effect->states->kind != ISO_STATE_DERIVED) continue;
            effect->begin(f, y);
            for (int i = 0; i < effect->states->count; i++)
                LANE(s->own[f->at[e] - ISO_STATE + i], lane) = y[f->at[e] + i];
        }
    }
}

/* The moving part of the state at x: of the orbit (c = 0), or of a deviation. */
static inline void channel_at(const form *T, int c, real x, state *s)
{
    const series *S = &T->S;
    const vector *n = S->n + place(c, 0);
    if (T->is_point) {
        value_and_rate(n, S->count, S->order + 1, x, s->n, s->w); /* one more coefficient, for gamma' */
    } else {
        value(n, S->order, x, s->n);
        value(S->w + place(c, 0), S->order, x, s->w);
    }
    for (int i = 0; i < T->motion.states; i++) {
        const int first = T->motion.state[i].node * ROOM + place(c, 0), at = T->motion.state[i].at - ISO_STATE;
        if (T->motion.state[i].is_vector)
            value(S->vector + first, S->order, x, s->own + at);
        else
            s->own[at] = number(S->scalar + first, S->order, x);
    }
}

/* The state at x. gained: the advance of the clocks from 0 to x; NULL: not known. */
static void state_at(const form *T, real x, const real gained[], state *s)
{
    const iso_model *m = &T->shape;
    channel_at(T, 0, x, s);
    if (T->has_derived) find_derived(T, s);
    if (m->clocks == 0) return;
    real found[ISO_CLOCKS];
    if (!gained) integrate_clocks(T, x, found), gained = found;
    for (int i = 0; i < m->clocks; i++) s->clock[m->clock_of[i]] = T->clock[m->clock_of[i]] + gained[m->clock_of[i]];
}

/* --- steps ------------------------------------------------------------------------------------------------------ */

static inline real largest(vector a)
{
    return larger(larger(magnitude(AT(a, 0)), magnitude(AT(a, 1))), magnitude(AT(a, 2)));
}

/* The largest coefficient n of the states, relative to their sizes. Deviations do not shorten the step: their series
 * converge where the series of the orbit converges. */
static real coefficient(const form *T, int n)
{
    const series *S = &T->S;
    real most = largest(S->n[n]);
    const vector rest = T->is_point ? times(S->count[n + 1], S->n[n + 1]) : S->w[n]; /* of gamma', or w */
    const real speed = largest(T->is_point ? S->n[1] : S->w[0]);
    most = larger(most, largest(rest) / (speed + broadcast((NUMBER)ISO_REST)));
    for (int i = 0; i < T->motion.states; i++) {
        const int node = T->motion.state[i].node * ROOM, kind = T->motion.state[i].kind;
        if (kind == ISO_STATE_INTEGRAL) continue;
        const bool is_vector = T->motion.state[i].is_vector;
        const real size = is_vector ? largest(S->vector[node + n]) : magnitude(S->scalar[node + n]);
        const real start = is_vector ? largest(S->vector[node]) : magnitude(S->scalar[node]);
        most = larger(most, kind == ISO_STATE_UNIT ? size : size / (broadcast(1) + start));
    }
    return most;
}

/* x^part for 0 < part <= 1, from 4 % too small to 3 % too large. The bits of a double, read as an integer, are about
 * its logarithm. A number below the range of doubles is brought into it by square roots first: terms of long double
 * and 128 bits go down to 1e-4932. */
static inline real rough_power(real x, double part)
{
    if (sizeof(NUMBER) > sizeof(double) && LANE(x, 0) > 0 && LANE(x, 0) < (NUMBER)DBL_MIN)
        return rough_power(root(x), 2 * part);
    const double one = 1;
    double y[LANES];
    int64_t bits[LANES], of_one;
    for (int i = 0; i < LANES; i++) y[i] = fabs((double)LANE(x, i)); /* of -0, too */
    memcpy(bits, y, sizeof bits);
    memcpy(&of_one, &one, sizeof of_one);
    for (int i = 0; i < LANES; i++) bits[i] = of_one + (int64_t)((double)(bits[i] - of_one) * part);
    memcpy(y, bits, sizeof bits);
    for (int i = 0; i < LANES; i++) LANE(x, i) = y[i];
    return 0.97 * x;
}

#include "method/taylor/inside_impl.h"

/* The step for which the last three terms are as small as the tolerance, and in which the unit vector moves by at most
 * about 1000: in units of s this can be very long, 1e15 for k = 1e6. It is shortened where the clocks need it. Two
 * terms would not do: coefficients next to a pair of conjugate poles go like a cosine of n, and two of them may be
 * small by chance.
 *
 * A ball that rolls in a principal plane turns evenly: its own series converges for steps of any length. But a small
 * distance from the plane follows an equation with the poles of 1/g, and beyond them its series is wrong by many
 * decades. So the terms of 1/g are kept small as well, to 3/4 of the digits (at_poles): this costs other orbits 2 %
 * more steps. All digits would cost a fifth more. */
static real choose_step(const form *T, real direction, real gained[ISO_CLOCKS])
{
    const series *S = &T->S;
    const real least = broadcast((NUMBER)1e-290), tolerance = broadcast(T->tolerance);
    const real pace = larger(largest(S->n[1]), root(largest(S->n[2])));
    real h = 1000 / choose(pace > broadcast((NUMBER)1e-100), pace, broadcast(1));
    for (int n = S->order - 2; n <= S->order; n++) {
        const real longest = rough_power(T->tolerance / larger(coefficient(T, n), least), 1.0 / n);
        h = choose(longest < h, longest, h);
        if (T->is_point || T->is_point_in_t) continue;
        const real ratio = T->at_poles * magnitude(S->pole[0]) / larger(magnitude(S->pole[n - 1]), least);
        const real near = rough_power(ratio, 1.0 / (n - 1));
        h = choose(near < h, near, h);
    }
    if (T->inside) h = look_inside(T, direction, h);
    for (int i = 0;; i++) {
        const real doubt =
            integrate_clocks(T, direction * h, gained); /* NaN where the polynomial is no rate any more */
        const mask good = doubt <= tolerance, close = doubt < broadcast((NUMBER)1e10);
        if (i == 40 || !any(other(good))) return direction * h;
        const real less = rough_power(tolerance / larger(doubt, least), 1.0 / (2 * NODES));
        h = choose(good, h, h * (NUMBER)0.9 * choose(close, less, broadcast((NUMBER)0.5)));
    }
}

/* The x at which the model's clock has gone on by dt. By Newton's method from a guess. */
static real solve_for_time(const form *T, real dt, real guess)
{
    const iso_clock c = T->shape.clock;
    if (c == T->own) return dt;
    real x = guess, gained[ISO_CLOCKS];
    mask far = everywhere();
    for (int i = 0; i < 20 && any(far); i++) {
        integrate_clocks(T, x, gained);
        const real q = number(T->S.base, T->S.order - 1, x);
        const real step = (gained[c] - dt) / (T->rate[c] * raised(q, T->power[c]));
        x = choose(far, x - step, x);
        far = both(far, magnitude(step) > 4 * (NUMBER)EPSILON * magnitude(x));
    }
    return x;
}
