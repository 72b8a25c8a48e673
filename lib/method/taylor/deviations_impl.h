/* deviations_impl.h - two first-order variations of an orbit, computed beside it in channels 1 and 2 of its series.
 *
 * A deviation d is tangent to the constraints and to the level of the energy. The equations keep it tangent, but
 * rounding does not, and off the level a point's equations are unstable. So each step ends by restoring d, as it
 * restores the state:
 *
 *     (n,dn) = 0
 *     ball     (dw,n) + (w,dn) = 0,      (w,J dw) = 0 if nothing acts, else dh = 0 at the start
 *     point    (dw,n) + (w,dn) = 0,      (w,dw) = f(q) (J n,dn) - (dV,dn),    w = gamma', |w|^2 = F(q) - 2 V, f = F'
 *
 * The square of its length is |dn|^2 + |dw|^2/|w|^2, plus the same of the unit vectors of effects that act. A ball on
 * which a potential acts can come to rest; for it |w|^2 is that of the start plus what the potential can give.
 * Before it is measured, the part along the flow is taken away: d - f (d,f)/(f,f), f the derivative of the state. A
 * deviation that has become long is divided by its length, and the logarithm of this length is kept.
 */
#include "method/taylor/restore_impl.h"

/* --- back to the constraints ------------------------------------------------------------------------------------ */

/* Changes dw along w, so that (w,dw) agrees with the energy. */
static void keep_level_of_point(const form *T, const state *s, state *d)
{
    const series *S = &T->S;
    const real q = q_of(S, s->n), rise = -S->coupling * raised(q, -1 - 1 / S->k);
    const real slope = T->in_t ? 2 * S->coupling * S->k * q : rise; /* of |w|^2/2, by (J n,dn) */
    real J_n[3], size;
    for (int i = 0; i < 3; i++) J_n[i] = AT(S->J, i) * s->n[i];
    real wanted = slope * inner3(J_n, d->n);
    if (T->in_field) {
        vector gradient;
        potential_at(T, s->n, q, s, &size, &gradient);
        for (int i = 0; i < 3; i++) wanted -= AT(gradient, i) * d->n[i];
    }
    const real square = inner3(s->w, s->w);
    add_times(d->w, choose(square > zero, (wanted - inner3(s->w, d->w)) / square, zero), s->w);
}

static inline real inner_of(const real a[], const real b[], int size)
{
    real sum = zero;
    for (int i = 0; i < size; i++) sum += a[i] * b[i];
    return sum;
}

static void restore_deviation(const form *T, const state *s, state *d)
{
    const series *S = &T->S;
    add_times(d->n, -inner3(s->n, d->n), s->n);
    for (int i = 0; i < T->units; i++) {
        const real *unit = s->own + T->unit[i].at;
        real *own = d->own + T->unit[i].at;
        const real along = inner_of(unit, own, T->unit[i].size);
        for (int j = 0; j < T->unit[i].size; j++) own[j] -= along * unit[j];
    }
    const real spin = inner3(d->w, s->n) + inner3(s->w, d->n);
    if (T->is_point || T->is_point_in_t) {
        add_times(d->w, -spin, s->n);
        if (T->is_point)
            keep_level_of_point(T, s, d);
        else
            add_times(d->w, -inner3(s->w, d->w) / inner3(s->w, s->w), s->w);
        return;
    }
    real u[3], K[3];
    for (int i = 0; i < 3; i++) u[i] = AT(S->inv_J, i) * s->n[i], K[i] = AT(S->J, i) * s->w[i];
    if (!T->twists) add_times(d->w, -spin / inner3(u, s->n), u);
    if (T->loaded) return;
    const real twice = inner3(K, s->w);
    add_times(d->w, choose(twice > zero, -inner3(K, d->w) / twice, zero), s->w);
}

/* --- along the flow --------------------------------------------------------------------------------------------- */

/* The first or second derivative of a vector's series at x. */
static inline void derivative(const vector a[], const real count[], int order, int which, real x, real out[3])
{
    vector p = nought;
    for (int n = order; n >= which; n--)
        p = plus(times(x, p), times(which == 1 ? count[n] : count[n] * count[n - 1], a[n]));
    for (int i = 0; i < 3; i++) out[i] = AT(p, i);
}

static inline real rate_of_number(const real a[], const real count[], int order, real x)
{
    real p = zero;
    for (int n = order; n >= 1; n--) p = p * x + count[n] * a[n];
    return p;
}

/* The derivative of the state at x. */
static void flow_at(const form *T, real x, state *f)
{
    const series *S = &T->S;
    memset(f, 0, sizeof *f);
    derivative(S->n, S->count, S->order + T->is_point, 1, x, f->n);
    if (T->is_point)
        derivative(S->n, S->count, S->order + 1, 2, x, f->w);
    else
        derivative(S->w, S->count, S->order, 1, x, f->w);
    for (int i = 0; i < T->motion.states; i++) {
        const int node = T->motion.state[i].node * ROOM, at = T->motion.state[i].at - ISO_STATE;
        if (T->motion.state[i].is_vector)
            derivative(S->vector + node, S->count, S->order, 1, x, f->own + at);
        else
            f->own[at] = rate_of_number(S->scalar + node, S->count, S->order, x);
    }
}

/* (a,b) of two deviations from s. */
static real inner(const form *T, const state *s, const state *a, const state *b)
{
    const real square = T->loaded ? T->speed_square : inner3(s->w, s->w);
    real sum = inner3(a->n, b->n) + inner3(a->w, b->w) / choose(square > zero, square, broadcast(1));
    for (int i = 0; i < T->units; i++) {
        const int at = T->unit[i].at;
        if (T->unit[i].acts) sum += inner_of(a->own + at, b->own + at, T->unit[i].size);
    }
    return sum;
}

static void add_state(const form *T, state *a, real factor, const state *b)
{
    add_times(a->n, factor, b->n);
    add_times(a->w, factor, b->w);
    for (int i = ISO_STATE; i < T->shape.moving; i++) a->own[i - ISO_STATE] += factor * b->own[i - ISO_STATE];
}

static void scale_state(const form *T, state *a, real factor)
{
    for (int i = 0; i < 3; i++) a->n[i] *= factor, a->w[i] *= factor;
    for (int i = ISO_STATE; i < T->shape.moving; i++) a->own[i - ISO_STATE] *= factor;
}

/* --- at the start ----------------------------------------------------------------------------------------------- */

/* Takes the change of a loaded ball's energy out of d, where the energy is kept: along w. Later on the equations keep
 * it out. The change along d is a central difference over six points: its error is about 1e-13, and 1e-12 where
 * |k| = 0.1 and powers are steep. */
static void start_on_level(const form *T, state *d)
{
    static const double step = 1e-3, weight[] = {3 / 4., -3 / 20., 1 / 60.};
    for (int lane = 0; lane < LANES; lane++) {
        const iso_problem *f = &T->model[lane]->problem;
        double along = 0, sum = 0, y[ISO_MAX_STATE], size;
        if (!(LANE(T->keeps_energy, lane) > 0)) continue;
        for (int i = 0; i < 3; i++) along += (double)(LANE(T->now.w[i], lane) * LANE(T->now.w[i], lane)) * f->p.J[i];
        for (int i = 0; i < 6 && along > 0; i++) {
            state moved = T->now;
            const double sign = i % 2 ? 1 : -1;
            add_state(T, &moved, broadcast((NUMBER)(sign * (i / 2 + 1) * step)), d);
            store(T, lane, &moved, y);
            sum += sign * weight[i / 2] * iso_system_ball.energy(f, y, &size);
        }
        const double part = along > 0 ? sum / step / along : 0;
        for (int i = 0; i < 3; i++) LANE(d->w[i], lane) -= part * LANE(T->now.w[i], lane);
    }
}

/* Two deviations from T->now, orthogonal and of length 1: towards a neighbour beside the orbit, and towards one that
 * starts in another direction. */
static void find_deviations(form *T, state d[SLOTS])
{
    const state *s = &T->now;
    const real square = inner3(s->w, s->w), speed = root(choose(square > zero, square, broadcast(1)));
    const int order = T->S.order;
    real across[3];
    state flow;
    T->S.order = 2; /* as many coefficients as the flow at T->now needs */
    begin(T);
    expand(&T->S);
    flow_at(T, zero, &flow);
    T->S.order = order;
    memset(d, 0, SLOTS * sizeof *d);
    cross_product(s->n, s->w, across);
    for (int i = 0; i < 3; i++) {
        d[1].n[i] = (T->is_point ? across[i] : s->w[i]) / speed;
        d[2].w[i] = across[i];
    }
    for (int c = 1; c < CHANNELS; c++) {
        restore_deviation(T, s, &d[c]);
        if (T->loaded) start_on_level(T, &d[c]);
        add_state(T, &d[c], -inner(T, s, &d[c], &flow) / inner(T, s, &flow, &flow), &flow);
        if (c == 2) add_state(T, &d[2], -inner(T, s, &d[1], &d[2]), &d[1]);
        scale_state(T, &d[c], 1 / root(inner(T, s, &d[c], &d[c])));
    }
}

/* The same in the lanes that are fresh. */
static void start_deviations(form *T, const bool fresh[LANES])
{
    state d[SLOTS];
    find_deviations(T, d);
    for (int c = 1; c < CHANNELS; c++)
        for (int lane = 0; lane < LANES; lane++) {
            if (!fresh[lane]) continue;
            real *to = (real *)&T->channel[c];
            const real *from = (const real *)&d[c];
            for (size_t i = 0; i < sizeof(state) / sizeof(real); i++) LANE(to[i], lane) = LANE(from[i], lane);
            LANE(T->scale[c], lane) = 0;
        }
}

/* --- on the way ------------------------------------------------------------------------------------------------- */

/* A deviation at x, where the state is s. */
static void deviation_at(const form *T, int c, real x, const state *s, state *d)
{
    memset(d, 0, sizeof *d);
    channel_at(T, c, x, d);
    restore_deviation(T, s, d);
}

/* Deviations at the end of a step, where the state is s. */
static void end_deviations(form *T, real length, const state *s)
{
    for (int c = 1; c < CHANNELS; c++) {
        state *d = &T->channel[c];
        deviation_at(T, c, length, s, d);
        const real square = inner(T, s, d, d);
        const mask is_long = both(square > broadcast((NUMBER)1e16), square < broadcast((NUMBER)1e290));
        if (!any(is_long)) continue;
        const real size = root(choose(is_long, square, broadcast(1)));
        scale_state(T, d, 1 / size);
        for (int i = 0; i < LANES; i++)
            if (LANE(is_long, i)) LANE(T->scale[c], i) += (NUMBER)log((double)LANE(size, i));
    }
}

/* The deviations at x, where the state is s: the squares of their lengths and the sine of the angle between them,
 * without their parts along the flow; and the deviations themselves, with these parts. */
typedef struct look {
    state deviation[SLOTS];
    real square[SLOTS], sine;
} look;

static void look_at(const form *T, real x, const state *s, look *l)
{
    state flow, d[SLOTS];
    flow_at(T, x, &flow);
    const real along = 1 / inner(T, s, &flow, &flow);
    for (int c = 1; c < CHANNELS; c++) {
        deviation_at(T, c, x, s, &l->deviation[c]);
        d[c] = l->deviation[c];
        add_state(T, &d[c], -along * inner(T, s, &d[c], &flow), &flow);
        l->square[c] = inner(T, s, &d[c], &d[c]);
    }
    const real cosine = inner(T, s, &d[1], &d[2]) / l->square[1]; /* the rest of d2 is normal to d1 */
    add_state(T, &d[2], -cosine, &d[1]);
    l->sine = root(inner(T, s, &d[2], &d[2]) / l->square[2]);
}

/* Stores d of a lane in the variables of the model, where the state is s. For a point M = gamma' x gamma pace(q). */
static void store_deviation(const form *T, int lane, const state *s, const state *d, double y[])
{
    const series *S = &T->S;
    store_moving(T, lane, d, y);
    if (!T->is_point) return;
    real M[3], before[3], after[3], J_n[3];
    const real speed = pace(T, s->n);
    cross_product(s->w, s->n, M);
    cross_product(d->w, s->n, before);
    cross_product(s->w, d->n, after);
    for (int i = 0; i < 3; i++) J_n[i] = AT(S->J, i) * s->n[i];
    const real faster = T->in_t ? (-1 - 1 / (2 * S->k)) * 2 * inner3(J_n, d->n) / q_of(S, s->n) : zero;
    for (int i = 0; i < 3; i++) {
        const real dM = speed * (before[i] + after[i] + faster * M[i]);
        y[i] = (double)LANE(dM, lane);
    }
}

/* Stores the deviations, their lengths and their angle. */
static inline void store_look(const form *T, int lane, const state *s, const look *l, iso_lane_event *e)
{
    for (int i = 0; i < ISO_LANE_DEVIATIONS; i++) {
        store_deviation(T, lane, s, &l->deviation[i + 1], e->deviation[i]);
        e->scale[i] = (double)LANE(T->scale[i + 1], lane);
        e->growth[i] = e->scale[i] + 0.5 * log((double)LANE(l->square[i + 1], lane));
    }
    e->sine = (double)LANE(l->sine, lane);
}
