/* periodic_search.c - symmetric periodic orbits: roots along the symmetry lines; orbits of any kind: from a grid.
 *
 * u runs along a line, and F_n(u) is how far the orbit is from the same line n half returns later. F_n is sampled
 * with its derivative, closer and closer until between two samples each F_n either has no zero or is monotone. A sign
 * change then holds one zero, a point of an orbit of period n or a divisor of it.
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "instrument/periodic/periodic_impl.h"
#include "map/section_impl.h"

enum { FIRST = 192 /* intervals of a line at first */, DEEPEST = 14 /* halvings */, MOST_SAMPLES = 60000 };
#define SKIPPED 1e-4 /* at the ends of the lines, where the rotations are */

/* --- samples ---------------------------------------------------------------------------------------------------- */

/* F_n at a place, and its slope by u. */
typedef struct miss {
    double off, slope;
} miss;

typedef struct sample {
    double u;                   /* of the line */
    double z[2], z_by_u[2];     /* its first point on the section, and the derivative */
    double end[2], end_by_u[2]; /* g^halves of it                                     */
    bool there;                 /* it is the orbit's own mirror image                 */
    miss F[ISO_PERIODIC_MOST];  /* F_1 to F_halves                                    */
} sample;

typedef struct interval {
    size_t left, right; /* samples */
    int depth;
} interval;

typedef struct bracket {
    int n;
    double low, high, off_low; /* F_n(low); F_n(high) has the other sign */
    double u, z[2];            /* the best guess, and its point of the section */
    double end[2];             /* g^n of this point */
    bool there;                /* it is the orbit's own mirror image           */
    bool done;
} bracket;

typedef struct search {
    iso_periodic_work *w;
    int line, periods;
    sample *sample;
    size_t samples;
    interval *open; /* intervals to look at */
    size_t opened;
    bracket *bracket;
    size_t brackets;
} search;

/* The samples at[i], at their u. */
static iso_status shoot(const search *s, size_t count, int halves, double tolerance, sample at[])
{
    if (count == 0) return ISO_OK;
    const size_t each = (size_t)halves;
    double *u = calloc(count, sizeof *u), (*z)[2] = malloc(2 * count * sizeof *z);
    iso_periodic_point *to = malloc(count * each * sizeof *to);
    iso_status status = u && z && to ? ISO_OK : iso_context_no_memory(s->w->ctx, "the search");
    for (size_t i = 0; i < count && status == ISO_OK; i++) u[i] = at[i].u;
    if (status == ISO_OK) status = iso_periodic_place(&s->w->map, s->line, count, u, z, z + count);
    if (status == ISO_OK)
        status = iso_periodic_walk(&s->w->map, count, (const double(*)[2])z, halves, false, tolerance, to);
    for (size_t i = 0; i < count && status == ISO_OK; i++) {
        const double *by_u = z[count + i];
        iso_periodic_point before = {z[i][0], z[i][1], {{1, 0}, {0, 1}}};
        for (size_t n = 0; n < each; n++) {
            const iso_periodic_point *next = &to[each * i + n];
            miss *F = &at[i].F[n];
            F->off = iso_periodic_miss(s->line, &before, next, by_u, &F->slope, &at[i].there);
            before = *next;
        }
        at[i].end[0] = before.l, at[i].end[1] = before.x;
        for (int j = 0; j < 2; j++) {
            at[i].z[j] = z[i][j], at[i].z_by_u[j] = by_u[j];
            at[i].end_by_u[j] = before.slope[j][0] * by_u[0] + before.slope[j][1] * by_u[1];
        }
    }
    free(u);
    free(z);
    free(to);
    return status;
}

/* Adds samples at u[0], u[1], ... */
static iso_status take_samples(search *s, size_t count, const double u[])
{
    sample *new = calloc(count, sizeof *new);
    iso_status status = new ? ISO_OK : iso_context_no_memory(s->w->ctx, "the search");
    for (size_t i = 0; i < count && status == ISO_OK; i++) new[i].u = u[i];
    if (status == ISO_OK) status = shoot(s, count, s->periods, 1e-10, new);
    for (size_t i = 0; i < count && status == ISO_OK; i++)
        status = iso_periodic_append(s->w->ctx, &s->sample, &s->samples, &new[i], sizeof *new);
    free(new);
    return status;
}

static bool alike(double a, double b)
{
    const double ratio = a / b;
    return ratio > 1.0 / 3 && ratio < 3;
}

/* Whether F_n has at most one zero in the interval, as far as its ends show. */
static bool is_clear(const sample *a, const sample *b, int n)
{
    const double h = b->u - a->u, F[2] = {a->F[n].off, b->F[n].off}, D[2] = {a->F[n].slope, b->F[n].slope};
    if (F[0] * F[1] > 0 && fmin(fabs(F[0]), fabs(F[1])) > 1.5 * h * fmax(fabs(D[0]), fabs(D[1]))) return true;
    return alike(D[0], D[1]) && alike((F[1] - F[0]) / h, D[0]) && alike((F[1] - F[0]) / h, D[1]);
}

/* Looks at an interval: *split, or its sign changes become brackets. */
static iso_status look_at(search *s, const interval *in, bool *split)
{
    const sample *a = &s->sample[in->left], *b = &s->sample[in->right];
    bool clear = true;
    for (int n = 0; n < s->periods; n++) clear = clear && is_clear(a, b, n);
    *split = !clear && in->depth < DEEPEST && s->samples < MOST_SAMPLES;
    if (*split) return ISO_OK;
    s->w->out->unresolved += !clear;
    for (int n = 0; n < s->periods; n++) {
        const double low = a->F[n].off, high = b->F[n].off;
        bracket new = {.n = n + 1, .low = a->u, .high = b->u, .off_low = low};
        new.u = a->u + low / (low - high) * (b->u - a->u);
        if (low * high < 0 || low == 0)
            ISO_TRY(iso_periodic_append(s->w->ctx, &s->bracket, &s->brackets, &new, sizeof new));
    }
    return ISO_OK;
}

/* One round: intervals that are not clear are halved. */
static iso_status refine_samples(search *s)
{
    const size_t first = s->samples;
    double *u = malloc(s->opened * sizeof *u);
    interval *next = NULL;
    size_t halved = 0, opened = 0;
    iso_status status = u ? ISO_OK : iso_context_no_memory(s->w->ctx, "the search");
    for (size_t i = 0; i < s->opened && status == ISO_OK; i++) {
        const interval in = s->open[i];
        bool split;
        status = look_at(s, &in, &split);
        if (split) u[halved] = (s->sample[in.left].u + s->sample[in.right].u) / 2, s->open[halved++] = in;
    }
    if (status == ISO_OK && halved > 0) status = take_samples(s, halved, u);
    for (size_t i = 0; i < 2 * halved && status == ISO_OK; i++) {
        interval half = s->open[i / 2];
        *(i % 2 == 0 ? &half.right : &half.left) = first + i / 2;
        half.depth++;
        status = iso_periodic_append(s->w->ctx, &next, &opened, &half, sizeof half);
    }
    free(s->open);
    free(u);
    s->open = next;
    s->opened = opened;
    return status;
}

static iso_status sample_line(search *s)
{
    double u[FIRST + 1], range[2];
    if (!iso_symmetry_line_range(&s->w->map, s->line, range)) return ISO_OK;
    const double end = range[1] - range[0] - 2 * SKIPPED;
    if (!(end > 0)) return ISO_OK;
    for (int i = 0; i <= FIRST; i++) u[i] = range[0] + SKIPPED + end * i / FIRST;
    ISO_TRY(take_samples(s, FIRST + 1, u));
    for (size_t i = 0; i < FIRST; i++) {
        const interval in = {i, i + 1, 0};
        ISO_TRY(iso_periodic_append(s->w->ctx, &s->open, &s->opened, &in, sizeof in));
    }
    while (s->opened > 0) ISO_TRY(refine_samples(s));
    return ISO_OK;
}

/* --- roots ------------------------------------------------------------------------------------------------------ */

/* One step of Newton's method for all brackets of F_n, kept inside them. Behind a step of 1e-9, and so near the line, a
 * step is one of rounding errors. *left: how many go on. */
static iso_status step_roots(search *s, int n, sample at[], bracket *of[], size_t *left)
{
    size_t count = 0;
    *left = 0;
    for (bracket *b = s->bracket; b < s->bracket + s->brackets; b++)
        if (b->n == n && !b->done) at[count].u = b->u, of[count++] = b;
    const iso_status status = shoot(s, count, n, 1e-13, at);
    for (size_t i = 0; i < count && status == ISO_OK; i++) {
        bracket *b = of[i];
        const miss *F = &at[i].F[n - 1];
        b->there = at[i].there;
        b->done = !isfinite(F->off);
        if (!b->done) {
            *((F->off < 0) == (b->off_low < 0) ? &b->low : &b->high) = at[i].u;
            b->u = at[i].u - F->off / F->slope;
            const bool inside = b->u > b->low && b->u < b->high;
            if (!inside) b->u = (b->low + b->high) / 2;
            b->done = fabs(b->u - at[i].u) < (inside && fabs(F->off) < 1e-6 ? 1e-9 : 1e-12) || F->off == 0;
        }
        for (int j = 0; j < 2; j++) {
            b->z[j] = at[i].z[j] + (b->u - at[i].u) * at[i].z_by_u[j];
            b->end[j] = at[i].end[j] + (b->u - at[i].u) * at[i].end_by_u[j];
        }
        *left += !b->done;
    }
    return status;
}

static iso_status find_roots(search *s)
{
    sample *at = malloc((s->brackets + 1) * sizeof *at);
    bracket **of = malloc((s->brackets + 1) * sizeof *of);
    iso_status status = at && of ? ISO_OK : iso_context_no_memory(s->w->ctx, "the search");
    for (int n = 1; n <= s->periods && status == ISO_OK; n++) {
        size_t left = 1;
        for (int steps = 0; steps < 40 && left > 0 && status == ISO_OK; steps++)
            status = step_roots(s, n, at, of, &left);
    }
    free(at);
    free(of);
    return status;
}

static int by_place(const void *a, const void *b)
{
    const bracket *one = a, *other = b;
    return (one->u > other->u) - (one->u < other->u);
}

/* Of an orbit's points on the line the one with the least u counts. Those that seem to be others come last: by then
 * their orbits are known, and most need not be solved. */
static iso_status add_roots(search *s)
{
    const iso_periodic_options *o = &s->w->options;
    iso_periodic_candidate *c = malloc((s->brackets + 1) * sizeof *c);
    iso_status status = c ? ISO_OK : iso_context_no_memory(s->w->ctx, "the search");
    if (s->brackets > 0) qsort(s->bracket, s->brackets, sizeof *s->bracket, by_place);
    for (int turn = 0; turn < 2 * s->periods && status == ISO_OK; turn++) {
        const int n = turn / 2 + 1;
        size_t count = 0;
        for (const bracket *b = s->bracket; b < s->bracket + s->brackets; b++) {
            if (b->n != n || !b->there) continue;
            bool again = false; /* copies of both points count */
            for (const bracket *a = s->bracket; a < b && !again; a++)
                again = a->n == n && a->there && iso_periodic_apart(a->end, b->z) < 1e-4;
            if (again == turn % 2) c[count++] = (iso_periodic_candidate){s->line, n, b->u, b->z[0], b->z[1]};
        }
        status = iso_periodic_add(s->w, c, count);
        if (o->progress) o->progress(o->data, (s->line + (turn + 1.0) / (2 * s->periods)) / LINES);
    }
    free(c);
    return status;
}

iso_status iso_periodic_search(iso_periodic_work *w)
{
    iso_status status = ISO_OK;
    for (int line = 0; line < LINES && status == ISO_OK; line++) {
        search s = {.w = w, .line = line, .periods = w->options.period};
        status = sample_line(&s);
        if (status == ISO_OK) status = find_roots(&s);
        if (status == ISO_OK) status = add_roots(&s);
        free(s.sample);
        free(s.open);
        free(s.bracket);
    }
    return status;
}

/* --- other orbits, from a grid ---------------------------------------------------------------------------------- */

enum { STEPS = 10 };
#define LONGEST 0.25 /* step of Newton's method */

/* One step of Newton's method for f^p z = z; false: give up. *found: it is small. */
static bool step(const iso_periodic_point *end, double z[2], bool *found)
{
    const double a = end->slope[0][0] - 1, b = end->slope[0][1], c = end->slope[1][0], d = end->slope[1][1] - 1;
    const double r0 = remainder(z[0] - end->l, 2 * ISO_PI), r1 = z[1] - end->x, det = a * d - b * c;
    double dl = (d * r0 - b * r1) / det, dx = (a * r1 - c * r0) / det;
    const double length = hypot(dl, dx);
    if (!isfinite(length) || length > 20) return false;
    if (length > LONGEST) dl *= LONGEST / length, dx *= LONGEST / length;
    z[0] = iso_periodic_angle(z[0] + dl);
    z[1] += dx;
    *found = length < 1e-10;
    return fabs(z[1]) < 1 - 1e-6;
}

/* Newton's method from all points of the grid at once. Those that go on move to the front; those that have arrived are
 * tried. */
iso_status iso_periodic_from_grid(iso_periodic_work *w)
{
    const iso_periodic_options *o = &w->options;
    const size_t all = (size_t)o->grid;
    iso_section_spread spread;
    double(*z)[2] = malloc(all * sizeof *z);
    iso_periodic_point *at = malloc(all * (size_t)o->period * sizeof *at);
    iso_periodic_candidate *arrived = malloc(all * sizeof *arrived);
    iso_status status = z && at && arrived ? ISO_OK : iso_context_no_memory(w->ctx, "the grid");
    iso_section_spread_prepare(&spread, iso_periodic_motion(&w->map), w->map.axis, 1);
    for (int n = 1; n <= o->period && status == ISO_OK; n++) {
        size_t count = all;
        for (size_t i = 0; i < count; i++) iso_section_spread_point(&spread, i, &z[i][0], &z[i][1]);
        for (int steps = 0; steps < STEPS && count > 0 && status == ISO_OK; steps++) {
            size_t left = 0, found = 0;
            status = iso_periodic_walk(&w->map, count, (const double(*)[2])z, n, true, 1e-12, at);
            for (size_t i = 0; i < count && status == ISO_OK; i++) {
                bool there = false;
                double to[2] = {z[i][0], z[i][1]};
                if (!step(&at[(size_t)n * (i + 1) - 1], to, &there)) continue;
                if (there)
                    arrived[found++] = (iso_periodic_candidate){-1, n, NAN, to[0], to[1]};
                else
                    z[left][0] = to[0], z[left++][1] = to[1];
            }
            count = left;
            if (status == ISO_OK) status = iso_periodic_add(w, arrived, found);
        }
        if (o->progress) o->progress(o->data, (double)n / o->period);
    }
    free(z);
    free(at);
    free(arrived);
    return status;
}
