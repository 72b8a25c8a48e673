/* periodic_orbit.c - from a place near a periodic orbit to the orbit: Newton's method in numbers of 64 or 113 bits, its
 * trace with an error, closure, determinant, multipliers; and the list: which candidates are new, their symmetry, their
 * copies.
 *
 * A symmetric orbit keeps its symmetry: only the coordinate u of its line is sought.
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/names_impl.h"
#include "base/pool_impl.h"
#include "instrument/periodic/periodic_impl.h"
#include "map/state.h"
#include "model/model_impl.h"

void iso_periodic_digits(double head, double tail, char text[ISO_DIGITS_SIZE])
{
#ifdef ISO_TAYLOR_HAS_QUAD
    strfromf128(text, ISO_DIGITS_SIZE, "%.31g", (iso_wide)head + (iso_wide)tail);
#else
    snprintf(text, ISO_DIGITS_SIZE, "%.19Lg", (iso_wide)head + (iso_wide)tail);
#endif
}

ISO_NAMES(iso_symmetry_line_name, int, "S1", "S2", "S3", "TS1", "TS2", "TS3")

int iso_symmetry_text(int symmetry, char text[ISO_DIGITS_SIZE])
{
    int length = 0;
    text[0] = 0;
    for (int i = 0; i < 6; i++)
        if (symmetry & 1 << i)
            length += snprintf(text + length, (size_t)(ISO_DIGITS_SIZE - length), "%s%s", length ? " " : "",
                               iso_symmetry_line_name(i));
    return length > 0 ? length : snprintf(text, ISO_DIGITS_SIZE, "none");
}

/* --- one orbit -------------------------------------------------------------------------------------------------- */

typedef enum answer {
    FOUND,
    LOST, /* Newton's method did not end, or the orbit could not be followed */
    NONE  /* a zero of F that is no orbit                                    */
} answer;

/* What is being computed of one orbit. */
typedef struct solver {
    iso_periodic_map map;
    const iso_return_build *code;
    int line, period;
    iso_wide u, z[2];
    iso_periodic_shot shot;  /* of a symmetric orbit         */
    iso_periodic_fine whole; /* of another one: f^p of z     */
    iso_wide trace;
    iso_wide step;         /* the last one of Newton's method    */
    iso_wide move[2];      /* the same of z, without a symmetry; else 0 */
    double slope_of_trace; /* by u or z: as found                */
    double (*path)[2];
} solver;

static double largest4(const iso_wide A[2][2])
{
    return fmax(fmax(fabs((double)A[0][0]), fabs((double)A[0][1])),
                fmax(fabs((double)A[1][0]), fabs((double)A[1][1])));
}

/* Follows the orbit at u or z: its trace, and the next step. */
static bool evaluate(solver *s)
{
    if (s->line >= 0) {
        if (!iso_periodic_shoot(&s->map, s->code, s->line, s->u, s->period, &s->shot)) return false;
        memcpy(s->z, s->shot.z, sizeof s->z);
        s->trace = s->shot.trace;
        const iso_wide *m = s->shot.miss, *d = s->shot.miss_by_u;
        s->step = -(m[0] * d[0] + m[1] * d[1]) / (d[0] * d[0] + d[1] * d[1]);
        return true;
    }
    if (!iso_periodic_far(&s->map, s->code, s->z, 2 * s->period, s->path, &s->whole)) return false;
    const iso_wide(*A)[2] = (const iso_wide(*)[2])s->whole.slope; /* (A - 1) move = z - f^p z */
    const iso_wide a = A[0][0] - 1, b = A[0][1], c = A[1][0], d = A[1][1] - 1, det = a * d - b * c;
    const iso_wide r0 = iso_wide_wrap(s->z[0] - s->whole.to[0], 2 * WIDE_PI), r1 = s->z[1] - s->whole.to[1];
    s->trace = A[0][0] + A[1][1];
    s->move[0] = (d * r0 - b * r1) / det;
    s->move[1] = (a * r1 - c * r0) / det;
    s->step = WIDE_ABS(s->move[0]) + WIDE_ABS(s->move[1]);
    return true;
}

/* Until the steps are as small as rounding errors; the last of them is not taken. */
static bool solve(solver *s)
{
    enum { MOST_STEPS = 12 };
    const double small = s->code->error * 64;
    iso_wide old_trace = 0, moved = 0;
    for (int steps = 0; steps < MOST_STEPS; steps++) {
        if (!evaluate(s)) return false;
        if (steps > 0 && moved != 0) s->slope_of_trace = fabs((double)((s->trace - old_trace) / moved));
        old_trace = s->trace;
        const double length = fabs((double)s->step);
        /* how many times larger than its own rounding errors a step comes out */
        const double growth = s->line < 0 ? 1 + fabs((double)s->whole.slope[0][0])
                                          : 1 + largest4((const iso_wide(*)[2])s->shot.half.slope) /
                                                    hypot((double)s->shot.miss_by_u[0], (double)s->shot.miss_by_u[1]);
        if (!(length < 1e-4)) return false;
        if (length <= small * growth) return true;
        if (steps == MOST_STEPS - 1) return length < 1e-13;
        moved = s->step;
        if (s->line >= 0) s->u += s->step;
        for (int i = 0; i < 2 && s->line < 0; i++) s->z[i] += s->move[i];
    }
    return false;
}

iso_multipliers iso_multipliers_of(double trace, double error, double sense)
{
    iso_multipliers m = {.stability = trace > 2 ? ISO_UNSTABLE : trace < -2 ? ISO_INVERSE_HYPERBOLIC : ISO_STABLE};
    const double beyond = fabs(trace) - 2,
                 size = sqrt(fabs(beyond)) * sqrt(fabs(trace) + 2); /* |trace^2 - 4|^(1/2) */
    if (!(fabs(beyond) > error)) m.stability = error < 1e-3 ? ISO_DEGENERATE : ISO_STABILITY_UNDECIDED;
    if (m.stability == ISO_STABLE) {
        m.krein = sense > 0 ? 1 : -1;
        m.value[0][0] = m.value[1][0] = trace / 2;
        m.value[0][1] = size / 2;
        m.value[1][1] = -m.value[0][1];
    } else {
        m.value[0][0] = copysign((fabs(trace) + (beyond > 0 ? size : 0)) / 2, trace);
        m.value[1][0] = 1 / m.value[0][0];
    }
    return m;
}

/* What other steps, the last digit of k, and the step of Newton's method that was not taken change in the trace.
 * Where an orbit passes near a saddle, rounding errors grow more on the way than the derivative of the whole
  * shows. */
static double by_other_steps(const solver *s)
{
    solver other = *s;
    double path[2 * ISO_PERIODIC_MOST][2];
    iso_params p;
    other.path = path;
    if (s->code->error > 1e-25) { /* the constants of the equations are rounded like k */
        if (iso_params_reduced(s->map.ctx, nextafter(s->map.p.k, 0), s->map.p.J, &p) != ISO_OK) return NAN;
        iso_periodic_map_prepare(s->map.ctx, &p, s->map.energy, 1, &other.map);
    }
    other.map.finer = 0.03;
    for (int i = 0; i < 2; i++) other.z[i] += s->move[i];
    other.u += s->step;
    if (!evaluate(&other)) return NAN;
    return fabs((double)(other.trace - s->trace)) + s->slope_of_trace * fabs((double)other.step);
}

/* The whole orbit. doubt: how much rounding errors grow on the way. The second half of a symmetric one is the mirror
 * image of the first. Where it ends follows from how far the middle is from the line. */
static void measure(const solver *s, iso_periodic_orbit *o)
{
    const iso_periodic_shot *shot = &s->shot;
    const iso_wide(*slope)[2] = s->whole.slope, (*back)[2] = shot->back, *miss = shot->miss;
    const double digits = s->code->error;
    iso_wide product[2][2], determinant = s->whole.determinant;
    iso_wide gap[2] = {iso_wide_wrap(s->whole.to[0] - s->z[0], 2 * WIDE_PI), s->whole.to[1] - s->z[1]};
    if (s->line >= 0) {
        const iso_wide half = shot->half.determinant / iso_periodic_determinant(&s->map, s->z[0], shot->half.to[0]);
        iso_wide_multiply(back, shot->half.slope, product);
        slope = (const iso_wide(*)[2])product;
        for (int i = 0; i < 2; i++) gap[i] = back[i][0] * miss[0] + back[i][1] * miss[1];
        determinant = half * half;
    }
    const double size = largest4(slope), doubt = s->line >= 0 ? shot->terms : size;
    const iso_fine t = iso_fine_of(s->trace);
    o->determinant = (double)(determinant - 1);
    o->closure = hypot((double)gap[0], (double)gap[1]) / fmax(1, size);
    o->trace = t.head;
    o->trace_tail = t.tail;
    const double moved = s->slope_of_trace * (fabs((double)s->step) + digits + 4 * o->closure);
    o->error = 256 * digits * s->period * doubt + 4 * moved + fabs(o->determinant) * (1 + fabs(o->trace));
    o->error += 100 * by_other_steps(s); /* it has been seen to be 70 times too small */
    if (digits > 1e-25) o->error += 0x1p-52 * fabs(o->trace);
    o->torus = fabs(s->map.p.k) == 1 && fabs(o->trace - 2) <= fmax(1000 * o->error, 1e-9);
    o->multipliers = iso_multipliers_of(o->trace, fmax(4 * o->error, o->torus ? 1e-9 : 1e-15), (double)slope[1][0]);
}

/* Finds the orbit at a candidate: all but its start, symmetry and copies, its clocks in own units; and
 * path[n - 1] = g^n z, n = 1 to 2 period. */
static answer find_orbit(const iso_periodic_map *map, const iso_return_build *code, const iso_periodic_candidate *c,
                         iso_periodic_orbit *o, double (*path)[2])
{
    solver s = {.map = *map, .code = code, .line = c->line, .period = c->period, .u = c->u, .path = path};
    s.z[0] = c->l, s.z[1] = c->x;
    memset(o, 0, sizeof *o);
    if (!solve(&s) || !(WIDE_ABS(s.z[1]) < 1)) return LOST;
    /* of a zero of F that is no orbit the two crossings around the line are no mirror images */
    if (s.line >= 0 && !(hypot((double)s.shot.miss[0], (double)s.shot.miss[1]) < 1e-8)) return NONE;
    measure(&s, o);
    const iso_fine z[2] = {iso_fine_of(iso_wide_wrap(s.z[0], 2 * WIDE_PI)), iso_fine_of(s.z[1])};
    const double unwrapped[2] = {(double)s.z[0], (double)s.z[1]};
    o->line = s.line;
    o->period = s.period;
    o->u = (double)s.u;
    o->l = z[0].head, o->l_tail = z[0].tail;
    o->x = z[1].head, o->x_tail = z[1].tail;
    for (int k = 0; k < ISO_CLOCKS; k++)
        o->clock[k] = s.line >= 0 ? 2 * (double)s.shot.clock[k] : (double)s.whole.clock[k];
    /* The points of a symmetric orbit's second half are mirror images: S g^n z = g^(2p - n) z, or g^(2p - 1 - n) z if z
     * is the first crossing behind a line half way. */
    const int p = s.period, shift = iso_symmetry_line_is_half_way(s.line) ? 1 : 0;
    if (s.line >= 0) memcpy(path, s.shot.path, (size_t)p * sizeof *path);
    for (int n = p + 1; n < 2 * p && s.line >= 0; n++) {
        const int of = 2 * p - shift - n;
        iso_periodic_reverse(iso_symmetry_line_reversor(s.line), of == 0 ? unwrapped : path[of - 1], path[n - 1]);
    }
    path[2 * p - 1][0] = o->l;
    path[2 * p - 1][1] = o->x;
    return FOUND;
}

/* --- the list --------------------------------------------------------------------------------------------------- */

#define SAME 1e-7 /* points of the section that are closer are the same */

double iso_periodic_angle(double l)
{
    l = remainder(l, 2 * ISO_PI);
    return l <= -ISO_PI ? l + 2 * ISO_PI : l;
}

/* Whether two points of the section are the same, up to what distinguishes orbits. */
static bool meet(const double a[2], const double b[2])
{
    return fabs(remainder(a[0] - b[0], 2 * ISO_PI)) < SAME && fabs(a[1] - b[1]) < SAME;
}

/* Whether the point belongs to an orbit in the list whose period divides this one, or to a rotation. */
static bool is_known(const iso_periodic_work *w, int period, double l, double x)
{
    const double z[2] = {l, x}, place = fabs(remainder(l, ISO_PI));
    if (fabs(x) < SAME && fmin(place, ISO_PI / 2 - place) < SAME) return true;
    for (size_t i = 0; i < w->out->count; i++) {
        const iso_periodic_orbit *o = &w->out->orbit[i];
        for (int n = 0; period % o->period == 0 && n < 2 * o->period; n++)
            if (iso_periodic_apart(o->half[n], z) < SAME) return true;
    }
    return false;
}

/* --- symmetry and copies ---------------------------------------------------------------------------------------- */

/* Whether z is f^j (or g f^j) of the orbit's point; path[n - 1] = g^n z. */
static bool lies_on(const double (*path)[2], int period, bool odd, const double z[2])
{
    for (int n = odd ? 1 : 2; n <= 2 * period; n += 2)
        if (meet(path[n - 1], z)) return true;
    return false;
}

static void find_symmetry(const double (*path)[2], iso_periodic_orbit *o)
{
    const double z[2] = {o->l, o->x};
    o->symmetry = 0;
    for (int kind = 0; kind < 3; kind++) {
        double image[2];
        iso_periodic_reverse(kind, z, image);
        if (lies_on(path, o->period, false, image)) o->symmetry |= ISO_S1 << kind;
        if (lies_on(path, o->period, true, image)) o->symmetry |= ISO_TS1 << kind;
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

static void find_copies(const double (*path)[2], iso_periodic_orbit *o)
{
    int kept[16];
    o->copies = 0;
    for (int number = 0; number < 16; number++) {
        const double *from = path[number & 4 ? 0 : 2 * o->period - 1];
        double image[2];
        bool known = false;
        map_by(number, from, image);
        for (int i = 0; i < o->copies && !known; i++) {
            double back[2];
            map_by(kept[i], image, back);
            known = lies_on(path, o->period, kept[i] & 4, back);
        }
        if (known) continue;
        kept[o->copies] = number;
        if (number == 0) image[0] = o->l, image[1] = o->x;
        memcpy(o->copy[o->copies++], image, sizeof image);
    }
}

iso_status iso_periodic_append(iso_context *ctx, void *list, size_t *count, const void *item, size_t size)
{
    char *items; /* pointers to data all look alike */
    memcpy(&items, list, sizeof items);
    if ((*count & (*count - 1)) == 0) {
        char *larger = realloc(items, 2 * (*count + 1) * size);
        if (!larger) return iso_context_no_memory(ctx, "orbits");
        items = larger;
        memcpy(list, &items, sizeof items);
    }
    memcpy(items + (*count)++ * size, item, size);
    return ISO_OK;
}

static iso_status add_orbit(iso_periodic_work *w, const iso_periodic_orbit *solved, const double (*path)[2])
{
    iso_periodic_orbit o = *solved;
    const iso_params *p = &w->scene->params;
    const size_t size = 2 * (size_t)o.period * sizeof *path;
    if (is_known(w, o.period, o.l, o.x)) return ISO_OK;
    for (int n = 1; n < o.period; n++) /* its period is less if f^n z = z */
        if (o.period % n == 0 && meet(path[2 * n - 1], (const double[2]){o.l, o.x})) return ISO_OK;
    for (int c = 0; c < ISO_CLOCKS; c++) o.clock[c] *= w->unit_clock[c];
    const double eps = iso_coupling(p, w->on.h * iso_unit(&w->on.units, iso_dimension_h));
    iso_section_point((iso_point_motion){p, eps, w->on.H}, w->map.axis, o.l, o.x, o.point);
    iso_point_to_ball(p, o.point, o.ball);
    find_symmetry(path, &o);
    find_copies(path, &o);
    o.half = malloc(size);
    if (!o.half) return iso_context_no_memory(w->ctx, "an orbit");
    memcpy(o.half, path, size);
    const iso_status status = iso_periodic_append(w->ctx, &w->out->orbit, &w->out->count, &o, sizeof o);
    if (status != ISO_OK) free(o.half);
    return status;
}

/* --- candidates, some at a time --------------------------------------------------------------------------------- */

enum { WAVE = 16 /* whatever the threads, so that the list does not depend on them */ };

typedef struct wave {
    const iso_periodic_work *w;
    const iso_periodic_candidate *candidate[WAVE];
    size_t count;
    struct {
        answer answer;
        iso_periodic_orbit orbit;
        double path[2 * ISO_PERIODIC_MOST][2];
    } of[WAVE];
} wave;

static bool solve_some(iso_pool_worker *worker, void *data, size_t first, size_t count)
{
    wave *a = data;
    iso_periodic_map map = a->w->map;
    map.ctx = worker->ctx;
    for (size_t i = first; i < first + count; i++)
        a->of[i].answer = find_orbit(&map, iso_return_build_of(a->w->options.polish), a->candidate[i],
                                     &a->of[i].orbit, a->of[i].path);
    return true;
}

iso_status iso_periodic_add(iso_periodic_work *w, const iso_periodic_candidate c[], size_t count)
{
    wave *a = calloc(1, sizeof *a);
    iso_status status = a ? ISO_OK : iso_context_no_memory(w->ctx, "orbits");
    for (size_t next = 0; next < count && status == ISO_OK;) {
        a->w = w;
        for (a->count = 0; next < count && a->count < WAVE; next++)
            if (!is_known(w, c[next].period, c[next].l, c[next].x)) a->candidate[a->count++] = &c[next];
        if (a->count == 0) break;
        iso_pool pool = {.what = "orbit", .count = a->count, .chunk = 1, .solve = solve_some, .data = a};
        status = iso_pool_run(w->ctx, &pool, iso_pool_threads(w->options.threads, a->count - 1, 1), NULL);
        for (size_t i = 0; i < a->count && status == ISO_OK; i++)
            if (a->of[i].answer == FOUND)
                status = add_orbit(w, &a->of[i].orbit, (const double(*)[2])a->of[i].path);
            else
                w->out->lost += a->of[i].answer == LOST && a->candidate[i]->line >= 0;
    }
    free(a);
    return status;
}
