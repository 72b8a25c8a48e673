/* periodic_solve.c - from a place near a periodic orbit to the orbit: Newton's method in numbers of 64 or 113 bits,
 * its trace with an error, closure, determinant, multipliers.
 *
 * A symmetric orbit keeps its symmetry: only the coordinate u of its line is sought.
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <string.h>

#include "instrument/periodic/periodic_impl.h"

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
    double slope_of_trace; /* by u or z: as found                */
    double (*path)[2];
} solver;

static double largest4(const iso_wide A[2][2])
{
    return fmax(fmax(fabs((double)A[0][0]), fabs((double)A[0][1])),
                fmax(fabs((double)A[1][0]), fabs((double)A[1][1])));
}

/* --- Newton's method -------------------------------------------------------------------------------------------- */

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
    s->trace = s->whole.slope[0][0] + s->whole.slope[1][1];
    return true;
}

/* (D f^p - 1) step = z - f^p z */
static void find_step_in_plane(solver *s, iso_wide step[2])
{
    const iso_wide(*A)[2] = (const iso_wide(*)[2])s->whole.slope;
    const iso_wide a = A[0][0] - 1, b = A[0][1], c = A[1][0], d = A[1][1] - 1, det = a * d - b * c;
    const iso_wide r0 = iso_wide_wrap(s->z[0] - s->whole.to[0], 2 * WIDE_PI), r1 = s->z[1] - s->whole.to[1];
    step[0] = (d * r0 - b * r1) / det;
    step[1] = (a * r1 - c * r0) / det;
    s->step = WIDE_ABS(step[0]) + WIDE_ABS(step[1]);
}

/* How many times larger than its own rounding errors a step comes out. */
static double growth(const solver *s)
{
    const iso_periodic_shot *shot = &s->shot;
    if (s->line < 0) return 1 + fabs((double)s->whole.slope[0][0]);
    return 1 + largest4((const iso_wide(*)[2])shot->half.slope) /
                   hypot((double)shot->miss_by_u[0], (double)shot->miss_by_u[1]);
}

/* Until the steps are as small as rounding errors; the last of them is not taken. */
static bool solve(solver *s)
{
    enum { MOST_STEPS = 12 };
    const double small = s->code->error * 64;
    iso_wide old_trace = 0, moved = 0;
    for (int steps = 0; steps < MOST_STEPS; steps++) {
        iso_wide step[2] = {0, 0};
        if (!evaluate(s)) return false;
        if (s->line < 0) find_step_in_plane(s, step);
        if (steps > 0 && moved != 0) s->slope_of_trace = fabs((double)((s->trace - old_trace) / moved));
        old_trace = s->trace;
        const double length = fabs((double)s->step);
        if (!(length < 1e-4)) return false;
        if (length <= small * growth(s)) return true;
        if (steps == MOST_STEPS - 1) return length < 1e-13;
        moved = s->step;
        if (s->line >= 0) s->u += s->step;
        for (int i = 0; i < 2 && s->line < 0; i++) s->z[i] += step[i];
    }
    return false;
}

/* --- what is known of it ---------------------------------------------------------------------------------------- */

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
    iso_wide step[2] = {0, 0};
    iso_params p;
    other.path = path;
    if (s->code->error > 1e-25) { /* the constants of the equations are rounded like k */
        if (iso_params_reduced(s->map.ctx, nextafter(s->map.p.k, 0), s->map.p.J, &p) != ISO_OK) return NAN;
        iso_periodic_map_prepare(s->map.ctx, &p, s->map.energy, 1, &other.map);
    }
    other.map.finer = 0.03;
    if (s->line < 0) find_step_in_plane(&other, step);
    for (int i = 0; i < 2; i++) other.z[i] += step[i];
    other.u += s->step;
    if (!evaluate(&other)) return NAN;
    if (s->line < 0) find_step_in_plane(&other, step);
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

iso_periodic_answer iso_periodic_solve(const iso_periodic_map *map, const iso_return_build *code,
                                       const iso_periodic_candidate *c, iso_periodic_orbit *o, double (*path)[2])
{
    solver s = {.map = *map, .code = code, .line = c->line, .period = c->period, .u = c->u, .path = path};
    s.z[0] = c->l, s.z[1] = c->x;
    memset(o, 0, sizeof *o);
    if (!solve(&s) || !(WIDE_ABS(s.z[1]) < 1)) return ISO_PERIODIC_LOST;
    /* of a zero of F that is no orbit the two crossings around the line are no mirror images */
    if (s.line >= 0 && !(hypot((double)s.shot.miss[0], (double)s.shot.miss[1]) < 1e-8)) return ISO_PERIODIC_NONE;
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
    return ISO_PERIODIC_FOUND;
}
