/* periodic_orbit.c - from a point near a periodic orbit to the orbit: Newton's method with more digits, trace,
 * multipliers, symmetry, copies.
 *
 * A symmetric orbit keeps its symmetry: z stays on its line, and only the line's parameter is sought. With A the
 * derivative of g^p at z and S the reversor, the derivative of f^p is S A^-1 S A. With the determinant
 * Delta = G(z)/G(g^p z) of A its trace is 2 + 4 A_01 A_10/Delta = 4 A_00 A_11/Delta - 2.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/pi_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "study/periodic_impl.h"

#define SAME 1e-7 /* points of the section that are closer are the same */

struct iso_periodic_folded {
    int period;
    double l, x;
};

double iso_periodic_angle(double l)
{
    l = remainder(l, 2 * ISO_PI);
    return l <= -ISO_PI ? l + 2 * ISO_PI : l;
}

/* --- duplicates ------------------------------------------------------------------------------------------------- */

/* All copies of a point, and those by the reversors, become one point of [0, pi/2] x [0, 1]. */
static void fold(double *l, double *x)
{
    *l = fabs(remainder(*l, ISO_PI));
    *x = fabs(*x);
}

/* Whether the point belongs to an orbit in the list whose period divides this one, or to a rotation. */
static bool is_known(const iso_periodic_work *w, int period, double l, double x)
{
    fold(&l, &x);
    if (x < SAME && fmin(l, ISO_PI / 2 - l) < SAME) return true;
    for (size_t i = 0; i < w->folded_count; i++) {
        const struct iso_periodic_folded *f = &w->folded[i];
        if (period % f->period == 0 && fabs(f->l - l) < SAME && fabs(f->x - x) < SAME) return true;
    }
    return false;
}

static iso_status remember(iso_periodic_work *w, int period, const iso_periodic_point point[], int count)
{
    if (w->folded_count + (size_t)count > w->folded_room) {
        const size_t room = 2 * (w->folded_room + (size_t)count);
        struct iso_periodic_folded *larger = realloc(w->folded, room * sizeof *larger);
        if (!larger) return iso_context_fail(w->ctx, ISO_NO_MEMORY, "", "no memory for the orbits");
        w->folded = larger;
        w->folded_room = room;
    }
    for (int i = 0; i < count; i++) {
        struct iso_periodic_folded *f = &w->folded[w->folded_count++];
        *f = (struct iso_periodic_folded){period, point[i].l, point[i].x};
        fold(&f->l, &f->x);
    }
    return ISO_OK;
}

/* --- digits ----------------------------------------------------------------------------------------------------- */

/* What is being computed of one orbit. */
typedef struct solver {
    iso_periodic_work *w;
    const iso_return_code *code;
    int line, period;
    iso_wide z[2];
    iso_periodic_fine half; /* symmetric: g^p of z; else f^p of z */
    iso_wide step;          /* the last one of Newton's method    */
    double slope_of_trace;  /* of the trace, by z: as found       */
} solver;

static iso_wide wrap(iso_wide l, iso_wide period)
{
    return l - WIDE_ROUND(l / period) * period;
}

static iso_wide off_line(int line, const iso_wide z[2])
{
    if (line == LINE_X) return z[1];
    return wrap(z[0] - (line == LINE_0 ? 0 : WIDE_PI / 2), WIDE_PI);
}

/* By the half; the product that is smaller loses less digits. */
static iso_wide trace_of_half(const solver *s)
{
    const iso_wide(*A)[2] = s->half.slope;
    const iso_wide Delta = iso_periodic_determinant(&s->w->map, s->z[0], s->half.to[0]);
    const iso_wide across = A[0][1] * A[1][0] / Delta, along = A[0][0] * A[1][1] / Delta;
    return WIDE_ABS(across) < WIDE_ABS(along) ? 2 + 4 * across : 4 * along - 2;
}

static void step_on_line(solver *s)
{
    const int row = s->line == LINE_X ? 1 : 0, along = s->line == LINE_X ? 0 : 1;
    s->step = -off_line(s->line, s->half.to) / s->half.slope[row][along];
    s->z[along] += s->step;
}

/* (D f^p - 1) step = z - f^p z */
static void step_in_plane(solver *s)
{
    const iso_wide a = s->half.slope[0][0] - 1, b = s->half.slope[0][1], c = s->half.slope[1][0],
                   d = s->half.slope[1][1] - 1, det = a * d - b * c;
    const iso_wide r0 = wrap(s->z[0] - s->half.to[0], 2 * WIDE_PI), r1 = s->z[1] - s->half.to[1];
    const iso_wide dl = (d * r0 - b * r1) / det, dx = (a * r1 - c * r0) / det;
    s->z[0] += dl;
    s->z[1] += dx;
    s->step = WIDE_ABS(dl) + WIDE_ABS(dx);
}

/* Until the steps are as small as rounding errors; the last of them is not taken. */
static bool solve(solver *s)
{
    enum { MOST_STEPS = 12 };
    const double small = s->code->error * 64;
    iso_wide old_trace = 0, moved = 0;
    for (int steps = 0; steps < MOST_STEPS; steps++) {
        const iso_wide before[2] = {s->z[0], s->z[1]};
        const int halves = s->line >= 0 ? s->period : 2 * s->period;
        if (!iso_periodic_far(&s->w->map, s->code, s->z, halves, &s->half)) return false;
        const iso_wide trace = s->line >= 0 ? trace_of_half(s) : s->half.slope[0][0] + s->half.slope[1][1];
        if (steps > 0 && moved != 0) s->slope_of_trace = fabs((double)((trace - old_trace) / moved));
        old_trace = trace;
        s->line >= 0 ? step_on_line(s) : step_in_plane(s);
        const double length = fabs((double)s->step), size = fabs((double)s->half.slope[0][0]) + 1;
        if (!(length < 1e-4)) return false;
        if (length <= small * size) return s->z[0] = before[0], s->z[1] = before[1], true;
        moved = s->step;
    }
    return fabs((double)s->step) < 1e-13;
}

/* --- what is told of it ----------------------------------------------------------------------------------------- */

static double largest4(const iso_wide A[2][2])
{
    return fmax(fmax(fabs((double)A[0][0]), fabs((double)A[0][1])),
                fmax(fabs((double)A[1][0]), fabs((double)A[1][1])));
}

iso_multipliers iso_multipliers_of(double trace, double error, double sense)
{
    iso_multipliers m = {.stability = trace > 2 ? ISO_UNSTABLE : trace < -2 ? ISO_INVERSE : ISO_STABLE};
    const double beyond = (fabs(trace) - 2) * (fabs(trace) + 2); /* trace^2 - 4 */
    if (fabs(fabs(trace) - 2) <= error) m.stability = ISO_DEGENERATE;
    if (m.stability == ISO_STABLE) {
        m.krein = sense > 0 ? 1 : -1;
        m.value[0][0] = m.value[1][0] = trace / 2;
        m.value[0][1] = sqrt(fmax(-beyond, 0)) / 2;
        m.value[1][1] = -m.value[0][1];
    } else {
        m.value[0][0] = copysign((fabs(trace) + sqrt(fmax(beyond, 0))) / 2, trace);
        m.value[1][0] = 1 / m.value[0][0];
    }
    return m;
}

/* What other steps and the last digit of k change: in the trace, and by the root that they have. Where an orbit
 * passes near a saddle, rounding errors grow more on the way than the derivative of the whole tells. */
static double by_other_steps(const solver *s)
{
    solver other = *s;
    iso_periodic_map map = s->w->map;
    iso_params p;
    if (s->code->error > 1e-25) { /* the constants of the equations are rounded like k */
        if (iso_params_reduced(map.ctx, nextafter(map.p.k, 0), map.p.J, &p) != ISO_OK) return NAN;
        iso_periodic_map_prepare(map.ctx, &p, 1, &map);
    }
    map.finer = 0.03;
    if (!iso_periodic_far(&map, s->code, s->z, s->line >= 0 ? s->period : 2 * s->period, &other.half)) return NAN;
    const iso_wide *const A[2] = {s->half.slope[0], s->half.slope[1]}, *const B[2] = {other.half.slope[0],
                                                                                      other.half.slope[1]};
    const iso_wide change =
        s->line >= 0 ? trace_of_half(&other) - trace_of_half(s) : B[0][0] + B[1][1] - A[0][0] - A[1][1];
    s->line >= 0 ? step_on_line(&other) : step_in_plane(&other);
    return fabs((double)change) + s->slope_of_trace * fabs((double)other.step);
}

/* The whole derivative of f^p by following the second half as well, the closure, and what rounding made of the
 * trace. */
static bool close_up(const solver *s, iso_periodic_orbit *o)
{
    const iso_wide(*A)[2] = s->half.slope;
    iso_wide M[2][2], end[2] = {s->half.to[0], s->half.to[1]}, trace = A[0][0] + A[1][1];
    memcpy(M, A, sizeof M);
    const double half = largest4(A), Delta = (double)iso_periodic_determinant(&s->w->map, s->z[0], s->half.to[0]);
    double error = 0, doubt = half;
    iso_wide det = s->half.determinant;
    if (s->line >= 0) {
        iso_periodic_fine rest;
        if (!iso_periodic_far(&s->w->map, s->code, s->half.to, s->period, &rest)) return false;
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) M[i][j] = rest.slope[i][0] * A[0][j] + rest.slope[i][1] * A[1][j];
        end[0] = rest.to[0], end[1] = rest.to[1];
        det *= rest.determinant;
        trace = trace_of_half(s);
        const double across = fabs((double)A[0][1]) + fabs((double)A[1][0]),
                     along = fabs((double)A[0][0]) + fabs((double)A[1][1]);
        doubt = fmin(across, along) * half / Delta;
        error = fabs((double)(M[0][0] + M[1][1] - trace)) / 16;
    }
    const iso_fine t = iso_fine_of(trace);
    o->trace = t.head;
    o->trace_tail = t.tail;
    const double digits = s->code->error;
    o->determinant = (double)(det - 1);
    o->closure = hypot((double)wrap(end[0] - s->z[0], 2 * WIDE_PI), (double)(end[1] - s->z[1])) /
                 fmax(1, largest4((const iso_wide(*)[2])M));
    const double moved = s->slope_of_trace * (fabs((double)s->step) + digits + 4 * o->closure);
    o->error = error + 256 * digits * s->period * doubt + 4 * moved + fabs(o->determinant) * (1 + fabs(o->trace));
    o->error += 100 * by_other_steps(s); /* it has been seen to be 70 times too small */
    if (digits > 1e-25) o->error += 0x1p-52 * fabs(o->trace);
    const double close_to_2 = fmin(fmax(4 * o->error, 1e-15), 0.5);
    o->torus = fabs(s->w->map.p.k) == 1 && fabs(o->trace - 2) <= fmax(1000 * o->error, 1e-9);
    o->multipliers = iso_multipliers_of(o->trace, o->torus ? 1e-6 : close_to_2, (double)M[1][0]);
    return true;
}

static void tell_states(const solver *s, iso_periodic_orbit *o)
{
    const iso_periodic_work *w = s->w;
    const iso_fine z[2] = {iso_fine_of(wrap(s->z[0], 2 * WIDE_PI)), iso_fine_of(s->z[1])};
    o->period = s->period;
    o->line = s->line;
    o->l = z[0].head;
    o->l_tail = z[0].tail;
    o->x = z[1].head;
    o->x_tail = z[1].tail;
    for (int c = 0; c < ISO_CLOCKS; c++)
        o->clock[c] = (double)s->half.clock[c] * (s->line >= 0 ? 2 : 1) * w->unit_clock[c];
    const iso_params *p = &w->scene->params;
    const double h = w->h * iso_unit(&w->units, iso_dimension_h);
    iso_section_point(p, iso_coupling(p, h), w->map.axis, o->l, o->x, o->point);
    iso_point_to_ball(p, o->point, o->ball);
}

/* --- symmetry and copies ---------------------------------------------------------------------------------------- */

static bool meet(const double a[2], const double b[2])
{
    return fabs(remainder(a[0] - b[0], 2 * ISO_PI)) < SAME && fabs(a[1] - b[1]) < SAME;
}

/* Whether z is f^j (or g f^j) of the orbit's point; points[n - 1] = g^n z. */
static bool lies_on(const iso_periodic_point points[], int period, bool odd, const double z[2])
{
    for (int n = odd ? 1 : 2; n <= 2 * period; n += 2)
        if (meet((double[2]){points[n - 1].l, points[n - 1].x}, z)) return true;
    return false;
}

static void reverse(int kind, const double z[2], double to[2])
{
    to[0] = kind == 0 ? z[0] : kind == 1 ? -z[0] : ISO_PI - z[0];
    to[1] = kind == 0 ? -z[1] : z[1];
}

static void find_symmetry(const iso_periodic_point points[], iso_periodic_orbit *o)
{
    const double z[2] = {o->l, o->x};
    o->symmetry = 0;
    for (int kind = 0; kind < 3; kind++) {
        double image[2];
        reverse(kind, z, image);
        if (lies_on(points, o->period, false, image)) o->symmetry |= ISO_S1 << kind;
        if (lies_on(points, o->period, true, image)) o->symmetry |= ISO_TS1 << kind;
    }
}

/* Number 0 to 15 of the symmetries: bit 0: S1 S2, bit 1: R, bit 2: g, which does T's work, bit 3: S1. All but g are
 * their own inverses, and they commute in what they do to orbits. */
static void map_by(int number, const double z[2], double to[2])
{
    const bool back = number & 1, over = number & 8;
    to[0] = iso_periodic_angle((back ? -z[0] : z[0]) + (number & 2 ? ISO_PI : 0));
    to[1] = (back != over) ? -z[1] : z[1];
}

static void find_copies(const iso_periodic_point points[], iso_periodic_orbit *o)
{
    int kept[16];
    o->copies = 0;
    for (int number = 0; number < 16; number++) {
        const iso_periodic_point *from = &points[number & 4 ? 0 : 2 * o->period - 1];
        double image[2];
        bool known = false;
        map_by(number, (double[2]){from->l, from->x}, image);
        for (int i = 0; i < o->copies && !known; i++) {
            double back[2];
            map_by(kept[i], image, back);
            known = lies_on(points, o->period, kept[i] & 4, back);
        }
        if (known) continue;
        kept[o->copies] = number;
        if (number == 0) image[0] = o->l, image[1] = o->x;
        memcpy(o->copy[o->copies++], image, sizeof image);
    }
}

/* --- the list --------------------------------------------------------------------------------------------------- */

static iso_status append(iso_periodic_work *w, const iso_periodic_orbit *o)
{
    iso_periodic *out = w->out;
    if (out->count == w->room) {
        const size_t room = 2 * w->room + 16;
        iso_periodic_orbit *larger = realloc(out->orbit, room * sizeof *larger);
        if (!larger) return iso_context_fail(w->ctx, ISO_NO_MEMORY, "", "no memory for the orbits");
        out->orbit = larger;
        w->room = room;
    }
    out->orbit[out->count++] = *o;
    return ISO_OK;
}

/* The period of f itself: the least n with f^n z = z. */
static int least_period(const solver *s, const iso_periodic_point points[])
{
    const double z[2] = {(double)s->z[0], (double)s->z[1]};
    for (int n = 1; n < s->period; n++)
        if (s->period % n == 0 && meet((double[2]){points[2 * n - 1].l, points[2 * n - 1].x}, z)) return n;
    return s->period;
}

static bool keep_points(const solver *s, const iso_periodic_point points[], iso_periodic_orbit *o)
{
    o->half = malloc(2 * (size_t)s->period * sizeof *o->half);
    for (int n = 0; n < 2 * s->period && o->half; n++) o->half[n][0] = points[n].l, o->half[n][1] = points[n].x;
    return o->half;
}

static iso_status finish(solver *s, const iso_periodic_point points[], bool *added)
{
    iso_periodic_orbit o = {.period = s->period};
    if (!close_up(s, &o)) return s->w->out->lost++, ISO_OK;
    tell_states(s, &o);
    find_symmetry(points, &o);
    find_copies(points, &o);
    if (!keep_points(s, points, &o)) return iso_context_fail(s->w->ctx, ISO_NO_MEMORY, "", "no memory for an orbit");
    iso_status status = remember(s->w, o.period, points, 2 * o.period);
    if (status == ISO_OK) status = append(s->w, &o);
    *added = status == ISO_OK;
    if (!*added) free(o.half);
    return status;
}

/* The other half of a symmetric orbit: g^(2p - n) z = S g^n z. */
static void mirror(const iso_periodic_candidate *c, iso_periodic_point points[])
{
    for (int n = 1; n <= c->period; n++) {
        const iso_periodic_point *from = &points[n - 1];
        double image[2] = {c->l, c->x};
        if (n < c->period) {
            reverse(c->line, (double[2]){from->l, from->x}, image);
            points[2 * c->period - n - 1] = (iso_periodic_point){.l = image[0], .x = image[1]};
        } else {
            points[2 * c->period - 1] = (iso_periodic_point){.l = c->l, .x = c->x};
        }
    }
}

iso_status iso_periodic_add(iso_periodic_work *w, const iso_periodic_candidate *c, bool *added)
{
    bool unused;
    if (!added) added = &unused;
    *added = false;
    if (is_known(w, c->period, c->l, c->x)) return ISO_OK;
    solver s = {.w = w, .code = iso_periodic_code(w->options.polish), .line = c->line, .period = c->period};
    s.z[0] = c->line == LINE_QUARTER ? WIDE_PI / 2 : (iso_wide)c->l;
    s.z[1] = c->x;
    iso_periodic_point points[2 * ISO_PERIODIC_MOST];
    const double from[1][2] = {{c->l, c->x}};
    const int halves = c->line >= 0 ? c->period : 2 * c->period;
    const iso_status status = iso_periodic_walk(&w->map, 1, from, halves, false, 1e-13, points);
    if (status != ISO_OK) return status;
    if (c->line >= 0) mirror(c, points);
    if (least_period(&s, points) < c->period) return ISO_OK; /* found with that period */
    const bool solved = solve(&s);
    if (!iso_context_goes_on(w->ctx)) return iso_context_fail(w->ctx, ISO_STOPPED, "", "stopped on request");
    if (!solved) return w->out->lost += c->line >= 0, ISO_OK;
    if (is_known(w, c->period, (double)s.z[0], (double)s.z[1]) || !(fabs((double)s.z[1]) < 1)) return ISO_OK;
    return finish(&s, points, added);
}

/* --- numbers as text -------------------------------------------------------------------------------------------- */

void iso_periodic_digits(double head, double tail, char text[ISO_DIGITS_SIZE])
{
#ifdef ISO_TAYLOR_HAS_QUAD
    strfromf128(text, ISO_DIGITS_SIZE, "%.31g", (iso_wide)head + (iso_wide)tail);
#else
    snprintf(text, ISO_DIGITS_SIZE, "%.19Lg", (iso_wide)head + (iso_wide)tail);
#endif
}

int iso_symmetry_words(int symmetry, char text[ISO_DIGITS_SIZE])
{
    static const char *const names[] = {"S1", "S2", "S3", "TS1", "TS2", "TS3"};
    int length = 0;
    text[0] = 0;
    for (int i = 0; i < 6; i++)
        if (symmetry & 1 << i)
            length +=
                snprintf(text + length, (size_t)(ISO_DIGITS_SIZE - length), "%s%s", length ? " " : "", names[i]);
    return length > 0 ? length : snprintf(text, ISO_DIGITS_SIZE, "none");
}
