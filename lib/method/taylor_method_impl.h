/* taylor_method_impl.h - the method around the recurrences of taylor_kernel_impl.h, in the same kind of number. */

/* A state, in the own variable of a form: of a point n = gamma, w = gamma'. */
typedef struct NAME(state) {
    REAL n[3], w[3], e[3], Q[4], way[3], clock[ISO_CLOCKS]; /* Q: q1 q2 q3 q0 */
} NAME(state);

/* What a model is integrated as. `own` is the variable of the series; the model's clock is a series of it, if another. */
typedef struct NAME(taylor) {
    const iso_taylor_code *code; /* set by taylor.c */
    NAME(series) S;
    iso_clock own;
    bool is_point, in_t;
    NAME(state) now; /* at the end of the last step, with more digits than it->at_right where REAL has more */
    REAL second;     /* k = -1: the second integral, at the start */
    REAL length;     /* of the last step, in the own variable */
} NAME(taylor);

/* --- which terms a model calls for ---------------------------------------------------------------------------------- */

static void NAME(call)(NAME(series) *S, NAME(recurrence) *term)
{
    S->term[S->terms++] = term;
}

static void NAME(call_ball)(const iso_model *m, NAME(series) *S)
{
    const bool *on = m->field.effects.on, twists = on[ISO_TWIST];
    NAME(call)(S, twists ? NAME(twisting_ball) : NAME(ball));
    if (on[ISO_GRAVITY]) NAME(call)(S, NAME(gravity));
    if (on[ISO_FIELD]) NAME(call)(S, NAME(field));
    if (on[ISO_LEVEL]) NAME(call)(S, NAME(level));
    if (on[ISO_ROLLING_RESISTANCE]) NAME(call)(S, NAME(resistance));
    NAME(call)(S, twists ? NAME(loose) : NAME(rigid));
    if (on[ISO_ATTITUDE]) NAME(call)(S, NAME(attitude));
    if (on[ISO_ATTITUDE] && m->field.p.k == 1) NAME(call)(S, NAME(roll));
}

/* In the ball's time the powers cancel, for free points on H = 0; k = -1 is polynomial in s. */
static void NAME(call_point)(const iso_model *m, NAME(taylor) *T)
{
    NAME(series) *S = &T->S;
    const double k = m->field.p.k;
    S->in_field = m->field.effects.on[ISO_FIELD];
    T->in_t = !S->in_field && m->field.energy == 0 && m->clock == ISO_CLOCK_T && k != -1;
    NAME(call)(S, T->in_t ? NAME(point_t) : k == -1 && !S->in_field ? NAME(neumann) : NAME(point_s));
    if (S->in_field) NAME(call)(S, NAME(point_field));
}

/* clock' = rate base^power, by iso_clock_rate: q = base for a point, 1/base for a ball */
static void NAME(call_clock)(NAME(taylor) *T, const iso_params *p, iso_clock clock)
{
    NAME(series) *S = &T->S;
    double e, e_own;
    const REAL G = 1 / S->factor;
    if (clock == T->own) return;
    iso_clock_rate(p, clock, 1, &e);
    iso_clock_rate(p, T->own, 1, &e_own);
    S->rate[clock] = (clock == ISO_CLOCK_S ? G : 1) / (T->own == ISO_CLOCK_S ? G : 1);
    S->power[clock] = T->is_point ? e - e_own : e_own - e;
    S->clock_of[S->clocks++] = clock;
}

static void NAME(set_numbers)(const iso_model *m, NAME(taylor) *T)
{
    const iso_field *f = &m->field;
    const iso_effects *e = &f->effects;
    NAME(series) *S = &T->S;
    for (int i = 0; i < 3; i++) {
        S->J[i] = f->p.J[i];
        S->inv_J[i] = 1 / S->J[i];
    }
    S->k = f->p.k;
    S->D = f->p.D;
    S->factor = S->J[0] * S->J[1] * S->J[2] / (S->k * S->k);
    S->energy = f->energy;
    S->mgb = e->mgb;
    S->level = e->level;
    S->twist = e->twist;
    S->resistance = e->resistance;
    S->alpha = -1 - 1 / S->k;
    S->coupling = 2 * (REAL)f->eps / S->k;
    for (int i = 0; i < 3; i++) { /* of the point: B = J^(1/2) C J^(1/2), m = J^(1/2) l */
        const REAL scale_i = T->is_point ? ROOT(S->J[i]) : 1;
        S->l[i] = scale_i * e->linear[i];
        for (int j = 0; j < 3; j++) S->C[i][j] = scale_i * e->quadratic[3 * i + j] * (T->is_point ? ROOT(S->J[j]) : 1);
    }
    for (int i = 1; i < TAYLOR_MOST + 3; i++) S->count[i] = i, S->inverse[i] = 1 / S->count[i];
}

/* The order of least work for the tolerance (measured: 10 % more at 4 above or below). */
static int NAME(order_for)(double tolerance)
{
    const int order = (int)lrint(4 - 1.6 * log10(tolerance));
    return order < 6 ? 6 : order > TAYLOR_MOST ? TAYLOR_MOST : order;
}


static iso_status NAME(create)(iso_integrator *it)
{
    const iso_model *m = &it->model;
    NAME(taylor) *T = it->data = aligned_alloc(64, (sizeof *T + 63) / 64 * 64);
    if (!T) return iso_context_fail(it->ctx, ISO_NO_MEMORY, "", "no memory for %s", it->method->name);
    memset(T, 0, sizeof *T);
    T->is_point = m->system == &iso_system_point;
    T->S.order = NAME(order_for)(it->options.tolerance * TAYLOR_FINER);
    NAME(set_numbers)(m, T);
    if (T->is_point)
        NAME(call_point)(m, T);
    else
        NAME(call_ball)(m, &T->S);
    T->own = T->is_point && !T->in_t ? ISO_CLOCK_S : ISO_CLOCK_T;
    if (T->in_t) { /* eps = h det J/k^2: B = 2 h k/det J */
        T->S.alpha = 1 + 1 / (2 * T->S.k);
        T->S.coupling = 2 * (REAL)m->field.eps / (T->S.k * T->S.factor * T->S.factor);
    }
    NAME(call_clock)(T, &m->field.p, m->clock);
    for (int i = 0; i < m->carried; i++) NAME(call_clock)(T, &m->field.p, m->carry[i]);
    if (T->S.clocks > 0) NAME(call)(&T->S, NAME(clocks));
    return ISO_OK;
}

/* --- the state: coefficients 0 --------------------------------------------------------------------------------------- */

static void NAME(cross_product)(const REAL a[], const REAL b[], REAL c[])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* ds/dt at gamma */
static REAL NAME(haste)(NAME(series) *S, const REAL gamma[])
{
    REAL q = 0;
    for (int i = 0; i < 3; i++) q += gamma[i] * S->J[i] * gamma[i];
    return EXP((1 + 1 / (2 * S->k)) * LOG(q)) / S->factor;
}

/* gamma' = gamma x M in s, times ds/dt in t */
static void NAME(load)(const iso_model *m, NAME(taylor) *T, const double y[], NAME(state) *s)
{
    const int *at = m->field.at;
    *s = (NAME(state)){.n = {0}};
    for (int i = 0; i < 3; i++) s->n[i] = y[3 + i];
    for (int i = 0; i < 3; i++) s->w[i] = y[i];
    if (T->is_point) {
        const REAL M[3] = {y[0], y[1], y[2]}, speed = T->in_t ? NAME(haste)(&T->S, s->n) : 1;
        NAME(cross_product)(s->n, M, s->w);
        for (int i = 0; i < 3; i++) s->w[i] *= speed;
    }
    for (int i = 0; at[ISO_GRAVITY] && i < 3; i++) s->e[i] = y[at[ISO_GRAVITY] + i];
    for (int i = 0; at[ISO_ATTITUDE] && i < 4; i++) s->Q[(i + 3) % 4] = y[at[ISO_ATTITUDE] + i];
    for (int i = 0; at[ISO_ATTITUDE] && m->field.p.k == 1 && i < 3; i++) s->way[i] = y[at[ISO_ATTITUDE] + 4 + i];
    for (int i = 0; i < m->carried; i++) s->clock[m->carry[i]] = y[m->moving + i];
}

/* The state into the coefficients 0 (of gamma' into 1 of gamma). */
static void NAME(begin_at)(const iso_model *m, NAME(taylor) *T, const NAME(state) *s)
{
    NAME(series) *S = &T->S;
    for (int i = 0; i < 3; i++) {
        S->n[0][i] = s->n[i];
        (T->is_point ? &S->n[1] : &S->w[0])[0][i] = s->w[i];
        S->e[0][i] = s->e[i];
        S->Q[0][i] = s->Q[i];
        S->way[0][i] = s->way[i];
    }
    S->Q0[0] = s->Q[3];
    for (int i = 0; i < m->carried; i++) S->clock[m->carry[i]][0] = s->clock[m->carry[i]];
}

/* p(x), or p'(x) of a vector's series */
static void NAME(value)(NAME(vector) a[], int order, REAL x, REAL out[3])
{
    NAME(vector) p = ZERO;
    for (int n = order; n >= 0; n--) p = p * x + a[n];
    for (int i = 0; i < 3; i++) out[i] = p[i];
}

static void NAME(rate)(NAME(vector) a[], const REAL count[], int order, REAL x, REAL out[3])
{
    NAME(vector) p = ZERO;
    for (int n = order; n >= 1; n--) p = p * x + count[n] * a[n];
    for (int i = 0; i < 3; i++) out[i] = p[i];
}

static REAL NAME(number)(const REAL a[], int order, REAL x)
{
    REAL p = 0;
    for (int n = order; n >= 0; n--) p = p * x + a[n];
    return p;
}

static void NAME(state_at)(const iso_model *m, NAME(taylor) *T, REAL x, NAME(state) *s)
{
    NAME(series) *S = &T->S;
    NAME(value)(S->n, S->order + T->is_point, x, s->n); /* of gamma one more is known, which gamma' needs */
    if (T->is_point)
        NAME(rate)(S->n, S->count, S->order + 1, x, s->w);
    else
        NAME(value)(S->w, S->order, x, s->w);
    if (m->field.at[ISO_GRAVITY]) NAME(value)(S->e, S->order, x, s->e);
    if (m->field.at[ISO_ATTITUDE]) {
        s->Q[3] = NAME(number)(S->Q0, S->order, x);
        NAME(value)(S->Q, S->order, x, s->Q);
        if (m->field.p.k == 1) NAME(value)(S->way, S->order, x, s->way);
    }
    for (int i = 0; i < m->carried; i++)
        s->clock[m->carry[i]] = m->carry[i] == T->own ? S->clock[T->own][0] + x
                                                      : NAME(number)(S->clock[m->carry[i]], S->order, x);
}

#include "method/taylor_restore_impl.h"

/* --- out ------------------------------------------------------------------------------------------------------------- */

static void NAME(store)(const iso_model *m, NAME(taylor) *T, const NAME(state) *s, double y[])
{
    const int *at = m->field.at;
    REAL M[3];
    for (int i = 0; i < 3; i++) y[3 + i] = (double)s->n[i];
    for (int i = 0; i < 3; i++) y[i] = (double)s->w[i];
    if (T->is_point) {
        const REAL speed = T->in_t ? NAME(haste)(&T->S, s->n) : 1;
        NAME(cross_product)(s->w, s->n, M);
        for (int i = 0; i < 3; i++) y[i] = (double)(M[i] / speed);
    }
    for (int i = 0; at[ISO_GRAVITY] && i < 3; i++) y[at[ISO_GRAVITY] + i] = (double)s->e[i];
    if (at[ISO_TWIST]) y[at[ISO_TWIST]] = -m->field.effects.twist * (y[0] * y[3] + y[1] * y[4] + y[2] * y[5]);
    if (at[ISO_ATTITUDE]) {
        double *Q = y + at[ISO_ATTITUDE];
        for (int i = 0; i < 4; i++) Q[i] = (double)s->Q[(i + 3) % 4];
        for (int i = 0; m->field.p.k == 1 && i < 3; i++) Q[4 + i] = (double)s->way[i];
    }
    for (int i = 0; i < m->carried; i++) y[m->moving + i] = (double)s->clock[m->carry[i]];
}

/* --- steps ----------------------------------------------------------------------------------------------------------- */

static REAL NAME(largest_of)(NAME(vector) a)
{
    REAL most = 0;
    for (int i = 0; i < 3; i++) most = a[i] > most ? a[i] : -a[i] > most ? -a[i] : most;
    return most;
}

/* The largest coefficient n of the states, in units of their sizes. */
static double NAME(coefficient)(const iso_model *m, NAME(taylor) *T, int n)
{
    NAME(series) *S = &T->S;
    REAL most = NAME(largest_of)(S->n[n]);
    if (!T->is_point) {
        const REAL w = NAME(largest_of)(S->w[n]) / (NAME(largest_of)(S->w[0]) + (REAL)1e-100);
        most = w > most ? w : most;
    }
    for (int i = 0; i < S->clocks; i++) { /* in units of their rates, over the way on which n turns by a radian */
        const REAL *clock = S->clock[S->clock_of[i]];
        const REAL c = NAME(largest_of)(S->n[1]) * FABS(clock[n] / clock[1]);
        most = c > most ? c : most;
    }
    if (m->field.at[ISO_GRAVITY] && NAME(largest_of)(S->e[n]) > most) most = NAME(largest_of)(S->e[n]);
    if (m->field.at[ISO_ATTITUDE] && NAME(largest_of)(S->Q[n]) > most) most = NAME(largest_of)(S->Q[n]);
    return (double)most;
}

/* The step whose last two terms are as small as the tolerance. */
static double NAME(choose_step)(const iso_integrator *it, NAME(taylor) *T)
{
    const int p = T->S.order;
    double h = 1e3;
    for (int n = p - 1; n <= p; n++) {
        const double c = NAME(coefficient)(&it->model, T, n);
        if (c > 0) h = fmin(h, pow(it->options.tolerance * TAYLOR_FINER / c, 1.0 / n));
    }
    return it->direction * h;
}

/* The x at which the model's clock has gone on by dt. */
static REAL NAME(find)(const iso_model *m, NAME(taylor) *T, double dt, double guess)
{
    if (m->clock == T->own) return dt;
    NAME(series) *S = &T->S;
    const REAL *clock = S->clock[m->clock];
    REAL x = guess;
    for (int i = 0; i < 20; i++) {
        REAL p = 0, dp = 0;
        for (int n = S->order; n >= 1; n--) {
            dp = dp * x + n * clock[n];
            p = p * x + clock[n];
        }
        const REAL step = (p * x - dt) / dp;
        x -= step;
        if (FABS(step) <= 4 * EPSILON * FABS(x)) break;
    }
    return x;
}

static iso_status NAME(start)(iso_integrator *it)
{
    NAME(taylor) *T = it->data;
    REAL M[3];
    NAME(load)(&it->model, T, it->at_right, &T->now);
    T->second = 0;
    if (T->is_point) T->second = NAME(shell_defect)(T, &T->now, M);
    return ISO_OK;
}

/* The state at x of the series, in the numbers of the model. */
static bool NAME(arrive)(iso_integrator *it, NAME(taylor) *T, REAL x, NAME(state) *s, double y[])
{
    double sum = 0;
    *s = (NAME(state)){.n = {0}};
    NAME(state_at)(&it->model, T, x, s);
    NAME(restore)(it, T, s);
    NAME(store)(&it->model, T, s, y);
    for (int i = 0; i < it->model.dim; i++) sum += y[i] * 0; /* NaN if any is not finite */
    return sum == 0;
}

static iso_status NAME(step)(iso_integrator *it, double y[], double *h)
{
    const iso_model *m = &it->model;
    NAME(taylor) *T = it->data;
    NAME(begin_at)(m, T, &T->now);
    NAME(expand)(&T->S);
    it->statistics.rhs += T->S.order;
    const REAL *clock = T->S.clock[m->clock];
    if (it->options.fixed_step > 0) {
        *h = it->direction * it->options.fixed_step;
        T->length = NAME(find)(m, T, *h, m->clock == T->own ? *h : *h / (double)clock[1]);
    } else {
        T->length = NAME(choose_step)(it, T);
        *h = (double)T->length;
        if (m->clock != T->own) *h = (double)(NAME(number)(clock + 1, T->S.order - 1, T->length) * T->length);
    }
    return NAME(arrive)(it, T, T->length, &T->now, y) ? ISO_OK : iso_integrator_stopped(it, "the series diverges");
}

static iso_status NAME(within)(iso_integrator *it, double dt, double y[])
{
    NAME(taylor) *T = it->data;
    NAME(state) s;
    const REAL x = NAME(find)(&it->model, T, dt, (double)T->length * (dt / it->h));
    return NAME(arrive)(it, T, x, &s, y) ? ISO_OK : iso_integrator_stopped(it, "the series diverges");
}
