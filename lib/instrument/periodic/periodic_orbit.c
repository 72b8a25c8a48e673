/* periodic_orbit.c - the list of periodic orbits: which candidates are new, their symmetry, their copies.
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

#define SAME 1e-7 /* points of the section that are closer are the same */

struct iso_periodic_folded {
    int period;
    double z[2]; /* a point, folded */
};

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

/* --- duplicates ------------------------------------------------------------------------------------------------- */

/* Whether the point belongs to an orbit in the list whose period divides this one, or to a rotation. */
static bool is_known(const iso_periodic_work *w, int period, double l, double x)
{
    double z[2];
    iso_periodic_fold((const double[2]){l, x}, z);
    if (z[1] < SAME && fmin(z[0], ISO_PI / 2 - z[0]) < SAME) return true;
    for (size_t i = 0; i < w->folded_count; i++) {
        const struct iso_periodic_folded *f = &w->folded[i];
        if (period % f->period == 0 && fabs(f->z[0] - z[0]) < SAME && fabs(f->z[1] - z[1]) < SAME) return true;
    }
    return false;
}

static iso_status remember(iso_periodic_work *w, int period, const double (*path)[2])
{
    iso_status status = ISO_OK;
    for (int i = 0; i < 2 * period && status == ISO_OK; i++) {
        struct iso_periodic_folded f = {.period = period};
        iso_periodic_fold(path[i], f.z);
        status = iso_periodic_append(w->ctx, &w->folded, &w->folded_count, &f, sizeof f);
    }
    return status;
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

/* --- the list --------------------------------------------------------------------------------------------------- */

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
    iso_status status = remember(w, o.period, path);
    if (status == ISO_OK) status = iso_periodic_append(w->ctx, &w->out->orbit, &w->out->count, &o, sizeof o);
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
        iso_periodic_answer answer;
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
        a->of[i].answer = iso_periodic_solve(&map, iso_return_build_of(a->w->options.polish), a->candidate[i],
                                             &a->of[i].orbit, a->of[i].path);
    return true;
}

static iso_status finish_wave(iso_periodic_work *w, wave *a)
{
    iso_pool pool = {.what = "orbit", .count = a->count, .chunk = 1, .solve = solve_some, .data = a};
    iso_status status = iso_pool_run(w->ctx, &pool, iso_pool_threads(w->options.threads, a->count - 1, 1), NULL);
    for (size_t i = 0; i < a->count && status == ISO_OK; i++)
        if (a->of[i].answer == ISO_PERIODIC_FOUND)
            status = add_orbit(w, &a->of[i].orbit, (const double(*)[2])a->of[i].path);
        else
            w->out->lost += a->of[i].answer == ISO_PERIODIC_LOST && a->candidate[i]->line >= 0;
    a->count = 0;
    return status;
}

iso_status iso_periodic_add(iso_periodic_work *w, const iso_periodic_candidate c[], size_t count)
{
    wave *a = calloc(1, sizeof *a);
    iso_status status = a ? ISO_OK : iso_context_no_memory(w->ctx, "orbits");
    for (size_t i = 0; i < count && status == ISO_OK; i++) {
        a->w = w;
        if (!is_known(w, c[i].period, c[i].l, c[i].x)) a->candidate[a->count++] = &c[i];
        if (a->count == WAVE || (a->count > 0 && i + 1 == count)) status = finish_wave(w, a);
    }
    free(a);
    return status;
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
