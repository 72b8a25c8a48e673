/* separatrix_scan.c - the splitting at many k or levels on all threads, and the zeros of m between them. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/math_impl.h"
#include "base/pool_impl.h"
#include "instrument/separatrix/separatrix_impl.h"

/* m has the zeros k = 1 and k = -1 anyway. Others are those of r = m exp(2 pi^2/ln lambda)/(k^2 - 1), which is of the
 * same size everywhere. Two neighbours with one between, along k or along the level. */
typedef struct bracket {
    bool by_level;
    double other; /* the number in which they agree */
    double at[2], r[2];
    double width; /* of at */
    bool fine;    /* 64 bits do not distinguish these m from 0 */
} bracket;

typedef struct scan {
    const iso_separatrix_options *o;
    iso_separatrix_table *s;
    const bracket *bracket;
    atomic_size_t done;
} scan;

/* r from m, or its error from that of m. */
static double reduced(const iso_separatrix_splitting *s, double m)
{
    return m * exp(fmin(2 * ISO_PI * ISO_PI / log(s->lambda), 600)) / ((s->k - 1) * (s->k + 1));
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

static bool solve_rows(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    scan *c = data;
    for (size_t i = first; i < first + count; i++) {
        iso_separatrix_splitting *s = &c->s->row[i];
        if (iso_separatrix_at(w->ctx, s->k, c->o->J, s->level, c->o->digits, s) == ISO_NO_MEMORY) return false;
        const size_t now = atomic_fetch_add(&c->done, 1) + 1;
        if (w->asks && c->o->progress) c->o->progress(c->o->data, (double)now / (double)c->o->count);
    }
    return true;
}

/* --- zeros ------------------------------------------------------------------------------------------------------ */

/* The splitting in a bracket, and r with its error. next: see iso_separatrix_next_at. */
static iso_status value_at(iso_pool_worker *w, const scan *c, const bracket *b, double at, bool next,
                           iso_separatrix_splitting *s, double *r, double *error)
{
    const iso_separatrix_digits digits = next || b->fine ? c->o->digits : ISO_SEPARATRIX_DOUBLE;
    const double k = b->by_level ? b->other : at, level = b->by_level ? at : b->other;
    const iso_status status = iso_separatrix_next_at(w->ctx, k, c->o->J, level, digits, next, s);
    *r = reduced(s, s->m), *error = fabs(reduced(s, s->error));
    return status;
}

/* How far the number must go to change by much: k itself; a level can be 0, so it is measured by its bracket. */
static double size_of(const bracket *b, double at)
{
    return b->by_level ? b->width : fabs(at);
}

/* Regula falsi in Illinois' form, until r is not distinguished from 0, or the number stands still. slope: dr by it
 * there. */
static iso_status search(iso_pool_worker *w, const scan *c, bracket *b, double *at, double *slope)
{
    enum { MOST = 40 };
    iso_separatrix_splitting s;
    int kept = -1;
    double r = NAN, error = NAN, aside = NAN, end[2] = {b->r[0], b->r[1]};
    for (int i = 0; i < MOST; i++) {
        const double last = *at;
        *at = (b->at[0] * end[1] - b->at[1] * end[0]) / (end[1] - end[0]);
        ISO_TRY(value_at(w, c, b, *at, false, &s, &r, &error));
        /* next to +-1 r is not known: m is not distinguished from 0 there, zero of r or not */
        if (!(error < fmax(fabs(b->r[0]), fabs(b->r[1])) / 100)) return ISO_NUMERICAL;
        if (fabs(r) < 10 * error || fabs(*at - last) < 1e-12 * size_of(b, *at)) break;
        const int side = r * end[0] > 0 ? 0 : 1;
        b->at[side] = *at, end[side] = r;
        if (kept == 1 - side) end[1 - side] /= 2;
        kept = 1 - side;
    }
    const double step = copysign(1e-4 * size_of(b, *at), *at);
    ISO_TRY(value_at(w, c, b, *at + step, false, &s, &aside, &error));
    *slope = (aside - r) / step;
    return ISO_OK;
}

/* Goes on from the zero of the search by the secant method, with the digits that were asked for. It ends where m is
 * not distinguished from 0, or is as small as doubles of k or the level allow: the slope of the next crossing, which
 * is shown beside m, must be larger. */
static iso_status find_zero(iso_pool_worker *w, const scan *c, bracket b, iso_separatrix_splitting *zero)
{
    enum { MOST = 8 };
    double at = NAN, slope = NAN, last = NAN, last_r = NAN, least = 0, r = NAN, error = NAN;
    ISO_TRY(search(w, c, &b, &at, &slope));
    for (int i = 0; i < MOST; i++) {
        ISO_TRY(value_at(w, c, &b, at, true, zero, &r, &error));
        if (i > 0 && fabs(at - last) > 1e-12 * size_of(&b, at)) slope = (r - last_r) / (at - last);
        least = 4e-16 * fabs(slope) * size_of(&b, at);
        if (fabs(r) < fmax(10 * error, least)) break;
        last = at, last_r = r;
        at -= r / slope;
    }
    *(b.by_level ? &zero->level_error : &zero->k_error) = fmax(fabs(r) + error, least) / fabs(slope);
    zero->is_zero = true;
    return ISO_OK;
}

static bool solve_zeros(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    scan *c = data;
    for (size_t i = first; i < first + count; i++)
        if (find_zero(w, c, c->bracket[i], &c->s->zero[i]) == ISO_NO_MEMORY) return false;
    return true;
}

static int by_k(const void *a, const void *b)
{
    const iso_separatrix_splitting *const *one = a, *const *other = b;
    if ((*one)->k != (*other)->k) return (*one)->k < (*other)->k ? -1 : 1;
    return ((*one)->level > (*other)->level) - ((*one)->level < (*other)->level);
}

/* Between neighbours, by growing k, of the rows that are distinguished from 0. list: room for the rows. */
static size_t find_brackets(const iso_separatrix_table *s, const iso_separatrix_splitting *list[], bracket brackets[])
{
    size_t rows = 0, count = 0;
    for (size_t i = 0; i < s->rows; i++)
        if (s->row[i].status == ISO_OK && s->row[i].from_zero) list[rows++] = &s->row[i];
    qsort(list, rows, sizeof *list, by_k);
    for (size_t i = 0; i + 1 < rows; i++) {
        const iso_separatrix_splitting *a = list[i], *b = list[i + 1];
        const bool by_level = a->k == b->k, fine = a->digits > 19 || b->digits > 19;
        const double from = by_level ? a->level : a->k, to = by_level ? b->level : b->k;
        const bracket found = {by_level,        by_level ? a->k : a->level,
                               {from, to},      {reduced(a, a->m), reduced(b, b->m)},
                               fabs(to - from), fine};
        if (a->k * b->k > 0 && (by_level || a->level == b->level) && found.r[0] * found.r[1] < 0)
            brackets[count++] = found;
    }
    return count;
}

/* --- the call --------------------------------------------------------------------------------------------------- */

static iso_status run_pool(iso_context *ctx, scan *c, size_t count,
                           bool (*solve)(iso_pool_worker *, void *, size_t, size_t))
{
    iso_pool pool = {.what = "orbit", .count = count, .chunk = 1, .solve = solve, .data = c};
    return count == 0 ? ISO_OK : iso_pool_run(ctx, &pool, iso_pool_threads(c->o->threads, count - 1, 1), NULL);
}

static iso_status run_zeros(iso_context *ctx, scan *c)
{
    iso_separatrix_table *s = c->s;
    const iso_separatrix_splitting **list = calloc(s->rows, sizeof *list);
    bracket *brackets = calloc(s->rows, sizeof *brackets);
    s->zero = calloc(s->rows, sizeof *s->zero);
    iso_status status = list && brackets && s->zero ? ISO_OK : iso_context_no_memory(ctx, "%zu rows", s->rows);
    if (status == ISO_OK) {
        s->zeros = find_brackets(s, list, brackets);
        c->bracket = brackets;
        status = run_pool(ctx, c, s->zeros, solve_zeros);
    }
    size_t kept = 0;
    for (size_t i = 0; i < s->zeros; i++)
        if (s->zero[i].is_zero) s->zero[kept++] = s->zero[i];
    if (status == ISO_OK) s->lost = s->zeros - kept;
    s->zeros = kept;
    free(list);
    free(brackets);
    return status;
}

iso_status iso_separatrix_run(iso_context *ctx, const iso_separatrix_options *o, iso_separatrix_table **s)
{
    ISO_DEFAULT_ARITHMETIC;
    *s = NULL;
    if (o->count == 0) return ISO_FAIL_ARGUMENT(ctx, "k", "splitting: there is no k");
    iso_separatrix_table *found = calloc(1, sizeof *found);
    scan c = {.o = o, .s = found};
    if (found) found->row = calloc(o->count, sizeof *found->row);
    iso_status status = found && found->row ? ISO_OK : iso_context_no_memory(ctx, "%zu rows", o->count);
    if (status == ISO_OK) {
        found->rows = o->count;
        found->axis = found->middle = -1;
        for (size_t i = 0; i < o->count; i++)
            found->row[i] = (iso_separatrix_splitting){.k = o->k[i],
                                                       .level = o->level ? o->level[i] : 0,
                                                       .status = ISO_STOPPED,
                                                       .text = "not computed",
                                                       .m = NAN,
                                                       .x = NAN};
        status = run_pool(ctx, &c, o->count, solve_rows);
        for (const iso_separatrix_splitting *row = found->row; row < found->row + o->count; row++) {
            if (row->status == ISO_OK) found->axis = row->axis, found->middle = row->middle;
            found->by_level = found->by_level || row->level != found->row->level;
        }
    }
    if (status == ISO_OK) status = run_zeros(ctx, &c);
    if (status != ISO_OK && status != ISO_STOPPED) iso_separatrix_free(found), found = NULL;
    *s = found;
    return status;
}

void iso_separatrix_free(void *table)
{
    iso_separatrix_table *s = table;
    if (!s) return;
    free(s->row);
    free(s->zero);
    free(s);
}
