/* taylor_form_impl.h - what a model is expanded as: its terms and numbers, states in and out, the length of a
 * step. */
#include "method/taylor_kernel_impl.h"
#include "method/taylor_quadrature_impl.h"
#include "model/model.h"

/* A state, in the own variable of a form: of a point n = gamma, w = gamma'. */
typedef struct state {
    real n[3], w[3], e[3], Q[4], way[3], clock[ISO_CLOCKS]; /* Q: q1 q2 q3 q0 */
} state;

/* One orbit in each lane, all of the same shape: the same system, effects and clocks, and k = -1 or not. `own` is the
 * variable of the series; the model's clock is a series of it, if another. */
typedef struct form {
    series S;
    iso_model shape;
    iso_clock own;
    bool is_point, is_point_t, in_t, is_neumann, rolls, unprojected;
    bool loaded;                              /* a ball with torques, or free to twist         */
    enum second_integral_of { NONE, SHELL, PLANE } second_of; /* whose second integral it keeps */
    double tolerance;                /* of the last terms, in units of the state                             */
    double at_poles;                 /* the same of 1/g of a ball, see for_poles                             */
    real second;                     /* the second integral at the start                                     */
    real twice_energy, keeps_energy; /* of a loaded ball at the start; 1 where it is conserved, else 0       */
    quadrature rule;
    int clocks; /* those that are not the own */
    iso_clock clock_of[ISO_CLOCKS];
    real rate[ISO_CLOCKS], power[ISO_CLOCKS]; /* clock' = rate base^power, base = q of a point, g of a ball */
    state now;                                /* at the end of the last step */
    real clock[ISO_CLOCKS];                   /* at its beginning */
} form;

/* --- which terms a model calls for ------------------------------------------------------------------------------ */

static void call(series *S, recurrence *term)
{
    S->term[S->terms++] = term;
}

static void call_ball(form *T)
{
    series *S = &T->S;
    const bool *on = T->shape.field.effects.on, twists = on[ISO_TWIST];
    call(S, twists ? twisting_ball : ball);
    if (on[ISO_GRAVITY]) call(S, gravity);
    if (on[ISO_FIELD]) call(S, field);
    if (on[ISO_LEVEL]) call(S, level);
    if (on[ISO_ROLLING_RESISTANCE]) call(S, resistance);
    call(S, twists ? loose : T->shape.forces > 0 ? forced : rigid);
    call(S, twists ? poles_of_loose : poles_of_rigid);
    if (on[ISO_ATTITUDE]) call(S, attitude);
    if (T->rolls) call(S, roll);
}

/* In the ball's time the powers cancel, for free points on H = 0; k = -1 is polynomial in s. */
static void call_point(form *T)
{
    series *S = &T->S;
    const iso_field *f = &T->shape.field;
    S->in_field = f->effects.on[ISO_FIELD];
    T->is_neumann = f->p.k == -1 && !S->in_field;
    T->in_t = !S->in_field && f->energy == 0 && T->shape.clock == ISO_CLOCK_T && f->p.k != -1;
    call(S, T->in_t ? point_t : T->is_neumann ? neumann : point_s);
    if (S->in_field) call(S, point_field);
}

static void call_clock(form *T, iso_clock clock)
{
    if (clock != T->own) T->clock_of[T->clocks++] = clock;
}

/* The order of least work for the tolerance (measured: 10 % more at 4 above or below); 6 to 28 in doubles. */
static int order_for(double tolerance)
{
    const int order = (int)lrint(4 - 1.6 * log10(tolerance));
    return order < 6 ? 6 : order > MOST ? MOST : order;
}

static void set_shape(form *T, const iso_model *m, double tolerance)
{
    series *S = &T->S;
    memset(T, 0, sizeof *T);
    T->shape = *m;
    T->tolerance = tolerance * FINER;
    T->is_point_t = m->system == &iso_system_point_t;
    T->at_poles = pow(T->tolerance, 0.75);
    T->is_point = m->system == &iso_system_point;
    T->rolls = m->field.at[ISO_ATTITUDE] && m->field.p.k == 1;
    T->loaded = !T->is_point && !T->is_point_t && (m->forces > 0 || m->field.effects.on[ISO_TWIST]);
    if (T->is_point ? !m->field.effects.on[ISO_FIELD] : !T->is_point_t && !T->loaded)
        T->second_of = m->field.p.k == -1 ? SHELL : m->field.p.k == 1 ? PLANE : NONE;
    S->order = order_for(T->tolerance);
    for (int i = 1; i < MOST + 3; i++) S->count[i] = spread((NUMBER)i), S->inverse[i] = 1 / S->count[i];
    if (T->is_point_t)
        call(S, point_p);
    else
        T->is_point ? call_point(T) : call_ball(T);
    T->own = T->is_point && !T->in_t ? ISO_CLOCK_S : ISO_CLOCK_T;
    call_clock(T, m->clock);
    for (int i = 0; i < m->carried; i++) call_clock(T, m->carry[i]);
    if (T->clocks > 0) make_rule(&T->rule);
}

/* --- the numbers of one orbit ----------------------------------------------------------------------------------- */

/* clock' = rate base^power, by iso_clock_rate: q = base for a point, 1/base for a ball */
static void set_clock(form *T, int lane, const iso_params *p, iso_clock clock, NUMBER factor)
{
    double e, e_own;
    (void)lane; /* where there is only one */
    iso_clock_rate(p, clock, 1, &e);
    iso_clock_rate(p, T->own, 1, &e_own);
    LANE(T->rate[clock], lane) = (clock == ISO_CLOCK_S ? 1 / factor : 1) * (T->own == ISO_CLOCK_S ? factor : 1);
    LANE(T->power[clock], lane) = T->is_point || T->is_point_t ? e - e_own : e_own - e;
}

static void set_numbers(form *T, int lane, const iso_model *m)
{
    const iso_field *f = &m->field;
    const iso_effects *e = &f->effects;
    series *S = &T->S;
    (void)lane;
    const NUMBER k = f->p.k, eps = f->eps, J[3] = {f->p.J[0], f->p.J[1], f->p.J[2]};
    const NUMBER least = J[0] < J[1] ? J[0] < J[2] ? J[0] : J[2] : J[1] < J[2] ? J[1] : J[2];
    const NUMBER factor = J[0] * J[1] * J[2] / (k * k);
    LANE(S->k, lane) = k;
    LANE(S->D, lane) = f->p.D;
    LANE(S->factor, lane) = factor;
    LANE(S->over_det, lane) = 1 / (J[0] * J[1] * J[2]);
    LANE(S->energy, lane) = f->energy;
    LANE(S->mgb, lane) = e->mgb;
    LANE(S->level, lane) = e->level;
    LANE(S->twist, lane) = e->twist;
    LANE(S->resistance, lane) = e->resistance;
    /* in t, with eps = h det J/k^2: B = 2 h k/det J */
    LANE(S->alpha, lane) = T->in_t ? 1 + 1 / (2 * k) : -1 - 1 / k;
    LANE(S->coupling, lane) = T->in_t ? 2 * eps / (k * factor * factor) : 2 * eps / k;
    if (T->is_point_t)
        LANE(S->alpha, lane) = 1 / ROOT(J[0] * J[1] * J[2]), LANE(S->coupling, lane) = 2 * eps / factor;
    for (int i = 0; i < 3; i++) { /* of the point: B = J^(1/2) C J^(1/2), m = J^(1/2) l */
        const NUMBER root_J = T->is_point ? ROOT(J[i]) : 1;
        LANE(AT(S->J, i), lane) = J[i];
        LANE(AT(S->inv_J, i), lane) = 1 / J[i];
        LANE(AT(S->past, i), lane) = J[i] - least;
        LANE(AT(S->l, i), lane) = root_J * e->linear[i];
        for (int j = 0; j < 3; j++)
            LANE(AT(S->C[j], i), lane) = root_J * e->quadratic[3 * i + j] * (T->is_point ? ROOT(J[j]) : 1);
        if (T->is_neumann) LANE(AT(S->c[0], i), lane) = 2 * eps / k * J[i] + 2 * f->energy;
    }
    for (int i = 0; i < T->clocks; i++) set_clock(T, lane, &f->p, T->clock_of[i], factor);
}

/* --- states: in, along the series, out -------------------------------------------------------------------------- */

static void cross_product(const real a[], const real b[], real c[])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static real q_of(const series *S, const real gamma[])
{
    real q = zero;
    for (int i = 0; i < 3; i++) q += gamma[i] * AT(S->J, i) * gamma[i];
    return q;
}

/* d(own variable)/ds of a point at gamma */
static real pace(const form *T, const real gamma[])
{
    if (!T->in_t) return spread(1);
    return T->S.factor * raised(q_of(&T->S, gamma), -1 - 1 / (2 * T->S.k));
}

/* gamma' = gamma x M in s */
static void load(form *T, int lane, const double y[])
{
    const int *at = T->shape.field.at;
    const iso_model *m = &T->shape;
    state *s = &T->now;
    (void)lane;
    for (int i = 0; i < 3; i++) {
        LANE(s->w[i], lane) = y[i];
        LANE(s->n[i], lane) = y[3 + i];
        if (at[ISO_GRAVITY]) LANE(s->e[i], lane) = y[at[ISO_GRAVITY] + i];
        if (T->rolls) LANE(s->way[i], lane) = y[at[ISO_ATTITUDE] + 4 + i];
    }
    if (T->is_point) {
        const real speed = pace(T, s->n);
        real turned[3];
        cross_product(s->n, s->w, turned);
        for (int i = 0; i < 3; i++) LANE(s->w[i], lane) = LANE(turned[i], lane) / LANE(speed, lane);
    }
    for (int i = 0; at[ISO_ATTITUDE] && i < 4; i++) LANE(s->Q[(i + 3) % 4], lane) = y[at[ISO_ATTITUDE] + i];
    for (int i = 0; i < m->carried; i++) LANE(s->clock[m->carry[i]], lane) = y[m->moving + i];
}

static void store(const form *T, int lane, const state *s, double y[])
{
    const iso_model *m = &T->shape;
    const int *at = m->field.at;
    (void)lane;
    for (int i = 0; i < 3; i++) {
        y[i] = (double)LANE(s->w[i], lane);
        y[3 + i] = (double)LANE(s->n[i], lane);
        if (at[ISO_GRAVITY]) y[at[ISO_GRAVITY] + i] = (double)LANE(s->e[i], lane);
        if (T->rolls) y[at[ISO_ATTITUDE] + 4 + i] = (double)LANE(s->way[i], lane);
    }
    if (T->is_point) {
        const real speed = pace(T, s->n);
        real M[3];
        cross_product(s->w, s->n, M);
        for (int i = 0; i < 3; i++) y[i] = (double)(LANE(M[i], lane) * LANE(speed, lane));
    }
    if (at[ISO_TWIST]) y[at[ISO_TWIST]] = -(double)LANE(T->S.twist, lane) * (y[0] * y[3] + y[1] * y[4] + y[2] * y[5]);
    for (int i = 0; at[ISO_ATTITUDE] && i < 4; i++) y[at[ISO_ATTITUDE] + i] = (double)LANE(s->Q[(i + 3) % 4], lane);
    for (int i = 0; i < m->carried; i++) y[m->moving + i] = (double)LANE(s->clock[m->carry[i]], lane);
}

static vector packed(const real a[3])
{
    vector v = nought;
    for (int i = 0; i < 3; i++) AT(v, i) = a[i];
    return v;
}

/* T->now into the coefficients 0 (of gamma' into 1 of gamma) */
static void begin(form *T)
{
    series *S = &T->S;
    const state *s = &T->now;
    S->n[0] = packed(s->n);
    *(T->is_point ? &S->n[1] : &S->w[0]) = packed(s->w);
    if (T->shape.field.at[ISO_GRAVITY]) S->e[0] = packed(s->e);
    if (T->shape.field.at[ISO_ATTITUDE]) {
        S->Q[0] = packed(s->Q);
        S->Q0[0] = s->Q[3];
        S->way[0] = packed(s->way);
    }
    memcpy(T->clock, s->clock, sizeof T->clock);
}

/* p(x), or p'(x), of a vector's series, or of a number's */
static inline void value(const vector a[], int order, real x, real out[3])
{
    vector p = nought;
    for (int n = order; n >= 0; n--) p = plus(times(x, p), a[n]);
    for (int i = 0; i < 3; i++) out[i] = AT(p, i);
}

static inline void rate(const vector a[], const real count[], int order, real x, real out[3])
{
    vector p = nought;
    for (int n = order; n >= 1; n--) p = plus(times(x, p), times(count[n], a[n]));
    for (int i = 0; i < 3; i++) out[i] = AT(p, i);
}

static inline real number(const real a[], int order, real x)
{
    real p = zero;
    for (int n = order; n >= 0; n--) p = p * x + a[n];
    return p;
}

/* How far the clocks go on from 0 to x; gives the relative error of that, estimated. */
static inline real pass_time(const form *T, real x, real gained[ISO_CLOCKS])
{
    real doubt = zero;
    gained[T->own] = x;
    for (int i = 0; i < T->clocks; i++) {
        const iso_clock c = T->clock_of[i];
        gained[c] = integral_of_power(&T->rule, T->S.base, T->S.order - 1, T->power[c], x, &doubt) * T->rate[c];
    }
    return doubt;
}

static void state_at(const form *T, real x, state *s)
{
    const series *S = &T->S;
    const iso_model *m = &T->shape;
    value(S->n, S->order + T->is_point, x, s->n); /* of gamma one more is known, which gamma' needs */
    if (T->is_point)
        rate(S->n, S->count, S->order + 1, x, s->w);
    else
        value(S->w, S->order, x, s->w);
    if (m->field.at[ISO_GRAVITY]) value(S->e, S->order, x, s->e);
    if (m->field.at[ISO_ATTITUDE]) {
        s->Q[3] = number(S->Q0, S->order, x);
        value(S->Q, S->order, x, s->Q);
        if (T->rolls) value(S->way, S->order, x, s->way);
    }
    if (m->carried == 0) return;
    real gained[ISO_CLOCKS];
    pass_time(T, x, gained);
    for (int i = 0; i < m->carried; i++) s->clock[m->carry[i]] = T->clock[m->carry[i]] + gained[m->carry[i]];
}

/* --- steps ------------------------------------------------------------------------------------------------------ */

static inline real largest(vector a)
{
    return larger(larger(magnitude(AT(a, 0)), magnitude(AT(a, 1))), magnitude(AT(a, 2)));
}

/* The largest coefficient n of the states, in units of their sizes. */
static real coefficient(const form *T, int n)
{
    const series *S = &T->S;
    real most = largest(S->n[n]);
    const vector rest = T->is_point ? times(S->count[n + 1], S->n[n + 1]) : S->w[n]; /* of gamma', or w */
    const real speed = largest(T->is_point ? S->n[1] : S->w[0]);
    most = larger(most, largest(rest) / (speed + spread((NUMBER)ISO_REST)));
    if (T->shape.field.at[ISO_GRAVITY]) most = larger(most, largest(S->e[n]));
    if (T->shape.field.at[ISO_ATTITUDE]) most = larger(most, largest(S->Q[n]));
    return most;
}

/* x^(1/n), 4 % too small to 3 % too large: the bits of a double are about its logarithm. */
static inline real rough_root(real x, int n)
{
    const double one = 1, part = one / n;
    double y[LANES];
    int64_t bits[LANES], of_one;
    for (int i = 0; i < LANES; i++) y[i] = (double)LANE(x, i);
    memcpy(bits, y, sizeof bits);
    memcpy(&of_one, &one, sizeof of_one);
    for (int i = 0; i < LANES; i++) bits[i] = of_one + (int64_t)((double)(bits[i] - of_one) * part);
    memcpy(y, bits, sizeof bits);
    for (int i = 0; i < LANES; i++) LANE(x, i) = y[i];
    return 0.97 * x;
}

/* The time in which the unit vector moves by about 1000, which may be anything in own units of s: for k = 1e6, 1e15. */
static real longest_step(const series *S)
{
    const real pace = larger(largest(S->n[1]), root(largest(S->n[2])));
    return 1000 / choose(pace > spread((NUMBER)1e-100), pace, spread(1));
}

/* A ball that rolls in a principal plane turns evenly, an entire function of t, in steps of any length; but how it
 * leaves the plane, by however little, follows an equation with the poles of 1/g, and a series beyond them is wrong
 * by many decades. So the terms of 1/g are kept small as well: as small as the state's would cost other orbits a
 * fifth more steps, 3/4 of the digits 2 %. */
static real for_poles(const form *T, int n)
{
    return rough_root(T->at_poles * magnitude(T->S.pole[0]) / larger(magnitude(T->S.pole[n]), spread((NUMBER)1e-290)),
                      n);
}

/* The step whose last three terms are as small as the tolerance, or the longest; shorter where the clocks need it. Two
 * may be small by chance: coefficients next to a pair of conjugate poles go like a cosine of n. */
static real choose_step(const form *T, real direction, real gained[ISO_CLOCKS])
{
    const real least = spread((NUMBER)1e-290), tolerance = spread(T->tolerance);
    real h = longest_step(&T->S);
    for (int n = T->S.order - 2; n <= T->S.order; n++) {
        const real longest = rough_root(T->tolerance / larger(coefficient(T, n), least), n);
        h = choose(longest < h, longest, h);
        if (T->is_point || T->is_point_t) continue;
        const real near = for_poles(T, n - 1);
        h = choose(near < h, near, h);
    }
    for (int i = 0;; i++) {
        const real doubt = pass_time(T, direction * h, gained); /* NaN where the polynomial is no rate any more */
        const mask good = doubt <= tolerance, close = doubt < spread((NUMBER)1e10);
        if (i == 40 || !any(other(good))) return direction * h;
        const real less = rough_root(tolerance / larger(doubt, least), 2 * NODES);
        h = choose(good, h, h * (NUMBER)0.9 * choose(close, less, spread((NUMBER)0.5)));
    }
}

/* The x at which the model's clock has gone on by dt: Newton's method. */
static real find(const form *T, real dt, real guess)
{
    const iso_clock c = T->shape.clock;
    if (c == T->own) return dt;
    real x = guess, gained[ISO_CLOCKS];
    mask far = everywhere();
    for (int i = 0; i < 20 && any(far); i++) {
        pass_time(T, x, gained);
        const real q = number(T->S.base, T->S.order - 1, x);
        const real step = (gained[c] - dt) / (T->rate[c] * raised(q, T->power[c]));
        x = choose(far, x - step, x);
        far = both(far, magnitude(step) > 4 * (NUMBER)EPSILON * magnitude(x));
    }
    return x;
}
