/* return_impl.h - the return map of the global section, with its derivative, in the numbers of this compilation.
 *
 * A point starts at (l, x) of the chart (map/section.h) and is followed until gamma_a passes 0 upwards again. Two
 * deviations begin as its derivatives by l and by x. Numbers come and go as sums of two doubles, which hold about 106
 * bits. Included behind crossing_impl.h.
 */
#include "method/taylor/return_map_impl.h"
#include "method/taylor/tail_rows_impl.h"

static inline NUMBER number_of(iso_fine x)
{
    return (NUMBER)x.head + (NUMBER)x.tail;
}

static inline iso_fine fine_of(NUMBER x)
{
    const double head = (double)x;
    return (iso_fine){head, (double)(x - (NUMBER)head)};
}

/* The state and its derivatives by l and x at a point of the chart, in the form's variables. Components stand in the
 * order (b, c, a): gamma = (cos l, -sin l, 0), and gamma' = v (-x sin l, -x cos l, (1-x^2)^(1/2)), v^2 = F(q). */
static void start_on_section(form *T, int axis, NUMBER l, NUMBER x)
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const NUMBER cosine = COS(l), sine = SIN(l), flat = ROOT(1 - x * x);
    state *s = &T->now, *by_l = &T->channel[1], *by_x = &T->channel[2];
    real terms;
    memset(T->channel, 0, sizeof T->channel);
    s->n[b] = cosine, s->n[c] = -sine;
    const NUMBER v = ROOT(square_of_speed(T, s, &terms));
    s->w[b] = -v * x * sine, s->w[c] = -v * x * cosine, s->w[axis] = v * flat;
    by_l->n[b] = -sine, by_l->n[c] = -cosine;
    by_l->w[b] = -v * x * cosine, by_l->w[c] = v * x * sine;
    by_x->w[b] = -v * sine, by_x->w[c] = -v * cosine, by_x->w[axis] = -v * x / flat;
    for (int d = 1; d < CHANNELS; d++) restore_deviation(T, s, &T->channel[d]);
}

/* The state and its derivatives by u and c half way between two crossings (iso_return_start). */
static void start_half_way(form *T, int axis, iso_return_start start, NUMBER u)
{
    const bool pole = start == ISO_FROM_POLE;
    const int b = (axis + 1) % 3, c = (axis + 2) % 3, across = start == ISO_FROM_PLANE_C ? c : b;
    const int first = pole ? b : across == b ? c : b, second = pole ? c : axis; /* the plane in which u turns */
    const NUMBER cosine = COS(u), sine = SIN(u), sign = pole ? 1 : -1;
    state *s = &T->now, *by_u = &T->channel[1], *by_c = &T->channel[2];
    real terms;
    memset(T->channel, 0, sizeof T->channel);
    if (pole)
        s->n[axis] = -1;
    else
        s->n[first] = cosine, s->n[second] = sign * sine;
    const NUMBER v = ROOT(square_of_speed(T, s, &terms));
    if (pole) {
        s->w[first] = v * cosine, s->w[second] = v * sine;
        by_u->w[first] = -v * sine, by_u->w[second] = v * cosine;
        by_c->n[first] = -sine, by_c->n[second] = cosine;
    } else {
        s->w[across] = v;
        by_u->n[first] = -sine, by_u->n[second] = sign * cosine;
        by_c->w[first] = -v * sine, by_c->w[second] = sign * v * cosine;
    }
    for (int d = 1; d < CHANNELS; d++) restore_deviation(T, s, &T->channel[d]);
}

/* The crossing at x of the series, in the chart: l = atan2(-gamma_c, gamma_b), x = (gamma' x gamma)_a/|gamma'|; and its
 * change with each deviation, whose part along the flow f is taken away so that gamma_a stays 0. */
static void arrive(const form *T, int axis, NUMBER x, NUMBER passed, iso_return *r)
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const iso_clock own = T->shape.clock;
    state s, f, d;
    NUMBER gained[ISO_CLOCKS];
    integrate_clocks(T, x, gained);
    find_state(T, x, gained, &s);
    flow_at(T, x, &f);
    const NUMBER turn = s.w[b] * s.n[c] - s.w[c] * s.n[b], square = inner3(s.w, s.w);
    r->to[0] = fine_of(ATAN2(-s.n[c], s.n[b]));
    r->to[1] = fine_of(turn / ROOT(square));
    for (int i = 0; i < 2; i++) {
        deviation_at(T, i + 1, x, &s, &d);
        const NUMBER along = -d.n[axis] / f.n[axis];
        add_times(d.n, along, f.n);
        add_times(d.w, along, f.w);
        const NUMBER change = d.w[b] * s.n[c] + s.w[b] * d.n[c] - d.w[c] * s.n[b] - s.w[c] * d.n[b];
        r->slope[0][i] = fine_of((s.n[c] * d.n[b] - s.n[b] * d.n[c]) / (s.n[b] * s.n[b] + s.n[c] * s.n[c]));
        r->slope[1][i] = fine_of((change - turn * inner3(s.w, d.w) / square) / ROOT(square));
    }
    for (int i = 0; i < ISO_CLOCKS; i++) r->clock[i] = fine_of(s.clock[i]);
    r->clock[own] = fine_of(passed + gained[own]);
}

/* Whether the step crosses: at which x. */
static bool cross_step(const form *T, int axis, NUMBER length, NUMBER zeros, NUMBER start, NUMBER end, NUMBER *x)
{
    const int parts = 1 + (int)(length * zeros);
    NUMBER a = 0, at_a = start;
    for (int part = 1; part <= parts; part++) {
        const NUMBER b = part == parts ? length : length * part / parts;
        const NUMBER at_b = part == parts ? end : component(T, axis, b, NULL);
        if (at_a < 0 && at_b >= 0) return *x = find_crossing(T, axis, a, at_a, b, at_b, true), true;
        a = b, at_a = at_b;
    }
    return false;
}

/* The higher coefficients of a series, in doubles. */
typedef struct tail {
    const iso_tail_build *code;
    void *data;
    int from; /* even: the first coefficient of q that they give */
    iso_tail_rows rows;
} tail;

/* Coefficient n of a term that is tolerance^(n/order) of the state needs 16 digits, and three to spare, where that is
 * 1e-19 of what the tolerance allows. */
static int tail_from(const form *T)
{
    const double digits = -log10(T->tolerance);
    const int from = (int)(T->S.order * fmax(digits - 13, 0) / digits) / 2 * 2 + 2;
    return from < T->S.order ? from : T->S.order;
}

/* Whether coefficients n and n + 1 fit doubles, with digits to spare. One of them may be 0 by symmetry. */
static bool in_range(const series *S, int n)
{
    for (int c = 0; c < CHANNELS; c++) {
        const real size = larger(largest(S->n[place(c, n)]), largest(S->n[place(c, n + 1)]));
        if (!(size > (NUMBER)1e-250 && size < (NUMBER)1e250)) return false;
    }
    return true;
}

/* As expand, but the higher coefficients come from doubles. False: these cannot hold them. */
static bool expand_with_tail(series *S, tail *t)
{
    const int order = S->order;
    S->order = t->from;
    expand(S);
    S->order = order;
    if (!in_range(S, t->from)) return false;
    carry_rows(S, &t->rows, true, 3, 5, 0, t->from - 1);
    carry_rows(S, &t->rows, true, 1, 0, t->from, t->from + 1);
    t->code->expand(t->data, t->from, &t->rows);
    carry_rows(S, &t->rows, false, 1, 0, t->from + 2, order + 1);
    carry_rows(S, &t->rows, false, 0, 1, t->from, order);
    return in_range(S, order);
}

/* Whether the terms of doubles are so small in a step that their rounding errors are below the tolerance. Around a
 * rotation in a principal plane the orbit's own terms fall fast, but those of deviations may not. One term or two may
 * be 0 by chance or by symmetry. */
static bool tail_is_small(const form *T, const tail *t, NUMBER length)
{
    const series *S = &T->S;
    const NUMBER h = magnitude(length);
    NUMBER most = (NUMBER)(3e-2 * 1e16 * T->tolerance);
    for (int n = 0; n < t->from; n++) most /= h;
    for (int n = t->from; n < t->from + 4 && n <= S->order; n++, most /= h)
        for (int c = 0; c < CHANNELS; c++) {
            const NUMBER size = largest(S->n[place(c, 0)]) + h * largest(S->n[place(c, 1)]);
            if (!(largest(S->n[place(c, n)]) <= most * size)) return false;
        }
    return true;
}

static bool go_round(form *T, tail *t, int axis, NUMBER zeros, bool on_section, iso_return *r)
{
    enum { MOST_STEPS = 100000 };
    NUMBER passed = 0;
    for (int steps = 0; steps < MOST_STEPS; steps++) {
        state after;
        NUMBER gained[ISO_CLOCKS], x;
        begin(T);
        if (!expand_with_tail(&T->S, t)) expand(&T->S);
        const NUMBER length = choose_step(T, 1, gained);
        if (!tail_is_small(T, t, length)) expand(&T->S);
        find_state(T, length, gained, &after);
        if (!(after.n[0] - after.n[0] == 0)) return false;
        if (cross_step(T, axis, length, zeros, steps == 0 && on_section ? 0 : T->now.n[axis], after.n[axis], &x))
            return arrive(T, axis, x, passed, r), true;
        for (int c = 1; c < CHANNELS; c++) {
            state d;
            deviation_at(T, c, length, &after, &d);
            T->channel[c] = d;
        }
        T->now = after;
        passed += gained[T->shape.clock];
    }
    return false;
}

static bool go(const iso_model *model, int axis, double zeros, double tolerance, iso_return *r)
{
    form *T = aligned_alloc(64, (sizeof *T + 63) / 64 * 64);
    tail *t = malloc(sizeof *t);
    double y[ISO_MAX_STATE] = {0};
    if (!T || !t) return free(T), free(t), false;
    y[3 + (axis + 1) % 3] = y[axis] = 1;
    set_shape(T, model, NULL, tolerance);
    start_orbit(T, 0, model, y);
    const bool on_section = r->start <= ISO_FROM_BELOW;
    if (on_section)
        start_on_section(T, axis, number_of(r->from[0]), number_of(r->from[1]));
    else
        start_half_way(T, axis, r->start, number_of(r->from[0]));
    for (int c = 0; r->start == ISO_FROM_BELOW && c < CHANNELS; c++) /* half a return, from -gamma and -gamma' */
        for (int i = 0; i < 3; i++)
            T->channel[c].n[i] = -T->channel[c].n[i], T->channel[c].w[i] = -T->channel[c].w[i];
    T->scale[1] = T->scale[2] = 0;
    T->second_of = NONE; /* the start is exact: nothing to restore it to */
    t->from = tail_from(T);
    t->code = iso_tail_build_find();
    t->data = t->code->create(model, T->S.order);
    const bool there = t->data && go_round(T, t, axis, zeros, on_section, r);
    free(t->data);
    free(t);
    free(T);
    return there;
}
