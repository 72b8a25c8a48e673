/* separatrix_crossing.c - the unstable manifold beyond its polynomial, and where it crosses its lines of symmetry.
 *
 * The part 1/lambda < theta <= 1 is a fundamental domain: its images under g are the whole branch, piece by piece. A
 * piece is held as samples so close together that no turn is missed. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/math_impl.h"
#include "base/number_impl.h"
#include "instrument/separatrix/separatrix_impl.h"

enum { MOST_SAMPLES = 4096, MOST_HALVES = 2000 };
#define CLOSE 0.35       /* samples that are farther apart have another one between them ... */
#define CLOSE_DRAWN 0.06 /* ... of a line that is drawn */

typedef struct piece {
    const iso_manifold *m;
    int count, halves;
    double close;
    double base; /* u of the first sample, with whole turns */
    iso_manifold_point at[MOST_SAMPLES];
    double u[MOST_SAMPLES]; /* of each sample, with whole turns */
} piece;

/* Puts samples between those that are far apart, then sets u. */
static iso_status fill(piece *p)
{
    for (int i = 0; i + 1 < p->count;) {
        const iso_manifold_point *a = &p->at[i], *b = &p->at[i + 1];
        iso_manifold_point between;
        if (!(hypot((double)iso_wide_turned(b->z[0] - a->z[0]), (double)(b->z[1] - a->z[1])) > p->close)) {
            i++;
            continue;
        }
        if (p->count == MOST_SAMPLES)
            return iso_manifold_lost(p->m, "the manifold is too long before it meets the line");
        ISO_TRY(iso_manifold_at(p->m, WIDE_ROOT(a->theta * b->theta), p->halves, &between));
        for (int j = p->count++; j > i + 1; j--) p->at[j] = p->at[j - 1];
        p->at[i + 1] = between;
    }
    double last = p->base;
    for (int i = 0; i < p->count; i++)
        last = p->u[i] = last + (double)iso_wide_turned(p->at[i].z[0] - (iso_wide)last);
    return ISO_OK;
}

/* *opened is for the caller to free, after a failure, too. */
static iso_status open_piece(const iso_manifold *m, double close, piece **opened)
{
    enum { FIRST = 4 };
    const double step = log((double)m->lambda) / (FIRST - 1);
    piece *p = *opened = calloc(1, sizeof *p);
    if (!p) return iso_context_no_memory(m->ctx, "a manifold");
    p->m = m, p->count = FIRST, p->close = close;
    for (int i = 0; i < FIRST; i++) {
        const iso_wide theta = i == FIRST - 1 ? 1 : i == 0 ? 1 / m->lambda : (iso_wide)exp((i + 1 - FIRST) * step);
        iso_manifold_at(m, theta, 0, &p->at[i]);
    }
    return fill(p);
}

static iso_status advance(piece *p)
{
    p->base = p->u[p->count - 1];
    for (int i = 0; i < p->count; i++) ISO_TRY(iso_manifold_go_on(p->m, &p->at[i]));
    p->halves++;
    return fill(p);
}

/* --- the first crossing ----------------------------------------------------------------------------------------- */

/* The place between two samples where u is about pi/2: ln tan(u/2) is a line over ln theta at k = +-1. */
static iso_wide guess(const piece *p, int i)
{
    const double u0 = p->u[i - 1], u1 = p->u[i];
    const double part =
        u0 > 0 ? log(tan(u0 / 2)) / (log(tan(u0 / 2)) - log(tan(fmin(u1, 3) / 2))) : (ISO_PI / 2 - u0) / (u1 - u0);
    return p->at[i - 1].theta * (iso_wide)exp(part * log((double)(p->at[i].theta / p->at[i - 1].theta)));
}

/* The last step of Newton's method: u - pi/2, the slope of the manifold, d slope/du, and du/dtheta. */
typedef struct approach {
    int steps;
    bool bent; /* bend is known well */
    iso_wide over, slope, bend, speed;
} approach;

/* Rounding leaves u some units away from pi/2; x and the slope are carried to pi/2 in first order. */
static iso_status approach_at(const iso_manifold *m, iso_wide theta, approach *a, iso_manifold_crossing *c)
{
    iso_manifold_point p;
    ISO_TRY(iso_manifold_at(m, theta, c->halves, &p));
    const iso_wide over = iso_wide_turned(p.z[0] - WIDE_PI / 2), slope = p.t[1] / p.t[0], moved = over - a->over;
    if (a->steps++ > 0 && WIDE_ABS(moved) > 10 * WIDE_ABS(over)) {
        a->bend = (slope - a->slope) / moved;
        a->bent = a->bent || fabs((double)moved) > 1e5 * m->code->error;
    }
    a->over = over, a->slope = slope, a->speed = p.t[0];
    c->theta = theta;
    c->z[0] = p.z[0] - over;
    c->z[1] = p.z[1] - over * slope;
    c->slope = slope - over * a->bend;
    return ISO_OK;
}

/* A step no longer helps: this is all that rounding leaves. */
static bool is_there(const iso_manifold *m, iso_wide now, iso_wide last)
{
    const double error = m->code->error, off = fabs((double)now);
    return off < error * (2000 + 100 * (double)m->lambda) || (off < sqrt(error) && off > fabs((double)last) / 2);
}

/* How far rounding moves the crossing: seen by starting close by. A first guess may be so good that the steps did not
 * show how the manifold bends: then one farther off does. */
static iso_status measure_scatter(const iso_manifold *m, approach *a, iso_manifold_crossing *c)
{
    const iso_wide theta = c->theta, unit = (iso_wide)m->code->error;
    iso_manifold_crossing beside = *c;
    if (!a->bent) {
        ISO_TRY(approach_at(m, theta * (1 - 10000000 * unit), a, &beside));
        ISO_TRY(approach_at(m, theta, a, c));
    }
    ISO_TRY(approach_at(m, theta * (1 - 1000 * unit), a, &beside));
    c->scatter[0] = fabs((double)(beside.z[1] - c->z[1]));
    c->scatter[1] = fabs((double)(beside.slope - c->slope));
    return ISO_OK;
}

/* Newton's method. */
iso_status iso_manifold_refine(const iso_manifold *m, iso_manifold_crossing *c)
{
    approach a = {0};
    for (int i = 0; i < 30; i++) {
        const iso_wide last = a.over, theta = i == 0 ? c->theta : c->theta - a.over / a.speed;
        ISO_TRY(approach_at(m, theta, &a, c));
        if (i > 0 && is_there(m, a.over, last)) return measure_scatter(m, &a, c);
        if (!(WIDE_ABS(a.over / a.speed) < c->theta / 2)) break;
    }
    return iso_manifold_lost(m, "the crossing with the line of symmetry was not found");
}

iso_status iso_manifold_first(const iso_manifold *m, iso_manifold_crossing *c)
{
    piece *p;
    iso_status status = open_piece(m, CLOSE, &p);
    int found = 0;
    while (status == ISO_OK) {
        for (int i = 0; i < p->count && found == 0; i++)
            if (p->u[i] >= ISO_PI / 2) found = i > 0 ? i : 1;
        if (found > 0) break;
        status = p->halves < MOST_HALVES
                     ? advance(p)
                     : ISO_FAIL_NUMERICAL(m->ctx,
                                          "splitting at k = %s: the manifold does not meet the line "
                                          "of symmetry within %d half turns",
                                          ISO_SHORT(m->problem.p.k), MOST_HALVES);
    }
    if (status == ISO_OK) *c = (iso_manifold_crossing){.halves = p->halves, .theta = guess(p, found)};
    free(p);
    return status;
}

/* --- the next one ----------------------------------------------------------------------------------------------- */

/* What is left of S3: W^s(O') = S3 W^u(O), and g S3 is a reversor as well: it turns W^u(O) into W^s(O'). The manifolds
 * meet where W^u(O) meets the fixed points of g S3, g(S3 p) = p. The stable one has the direction D(g S3) t there. */
iso_status iso_manifold_next(const iso_manifold *m, const iso_manifold_crossing *from, iso_manifold_crossing *c)
{
    *c = *from;
    c->theta *= WIDE_ROOT(m->lambda);
    if (c->theta > 1) c->theta /= m->lambda, c->halves++;
    iso_wide last = 1;
    for (int i = 0; i < 30; i++) {
        iso_manifold_point p, image;
        ISO_TRY(iso_manifold_at(m, c->theta, c->halves, &p));
        image = p;
        image.z[0] = WIDE_PI - p.z[0];
        image.t[0] = -p.t[0];
        ISO_TRY(iso_manifold_go_on(m, &image));
        const iso_wide apart = iso_wide_turned(image.z[0] - p.z[0]), step = apart / (image.t[0] - p.t[0]);
        for (int j = 0; j < 2; j++) c->z[j] = p.z[j];
        c->slope = (p.t[1] / p.t[0] - image.t[1] / image.t[0]) / 2;
        if (is_there(m, apart, last)) return ISO_OK;
        if (!(WIDE_ABS(step) < c->theta / 2)) break;
        c->theta -= step;
        last = apart;
    }
    return iso_manifold_lost(m, "the next point of both manifolds was not found");
}

/* --- as a line -------------------------------------------------------------------------------------------------- */

static iso_status append(iso_context *ctx, const piece *p, int from, iso_record *curve)
{
    for (int i = from; i < p->count; i++) {
        double *row;
        ISO_TRY(iso_record_append(ctx, curve, &row));
        row[0] = p->u[i];
        row[1] = (double)p->at[i].z[1];
    }
    return ISO_OK;
}

/* Until the lobes are too long to be held: that is no failure. */
iso_status iso_separatrix_curve(iso_context *ctx, double k, const double J[3], double level, int halves,
                                iso_record **curve)
{
    static const char *const names[] = {"u", "x"};
    iso_manifold m;
    piece *p = NULL;
    double *origin;
    bool met = false, whole = false;
    ISO_DEFAULT_ARITHMETIC;
    *curve = NULL;
    iso_status status = iso_manifold_find(ctx, k, J, level, &m);
    if (status == ISO_OK) status = iso_record_create(ctx, 2, names, curve);
    if (status == ISO_OK) status = iso_record_append(ctx, *curve, &origin);
    if (status == ISO_OK) status = open_piece(&m, CLOSE_DRAWN, &p);
    if (status == ISO_OK) status = append(ctx, p, 0, *curve);
    for (int left = halves; status == ISO_OK && !whole && left > 0 && p->halves < MOST_HALVES; left -= met) {
        status = advance(p);
        whole = status == ISO_NUMERICAL && met;
        if (whole) status = ISO_OK;
        met = met || p->u[p->count - 1] >= ISO_PI / 2;
        if (status == ISO_OK && !whole) status = append(ctx, p, 1, *curve);
    }
    free(p);
    if (status != ISO_OK) iso_record_free(*curve), *curve = NULL;
    return status;
}
