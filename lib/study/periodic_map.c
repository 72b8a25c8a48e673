/* periodic_map.c - the return map f of the section and half of it, g: many points at once in the lanes of vectors, one
 * point in numbers of more digits.
 *
 * g z: from the crossing z half a return, to the next crossing downwards, then T: gamma -> -gamma. A start at -gamma,
 * M is a crossing downwards; its next crossings upwards are g z, g^3 z, ...
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "orbit/crossings_impl.h"
#include "study/periodic_impl.h"

void iso_periodic_map_prepare(iso_context *ctx, const iso_params *own, int threads, iso_periodic_map *map)
{
    const iso_problem problem = {.p = *own, .eps = 1, .energy = 0};
    const bool with[ISO_CLOCKS] = {true, true, true};
    *map = (iso_periodic_map){.ctx = ctx, .p = *own, .axis = iso_section_axis(own), .threads = threads, .finer = 1};
    map->model = iso_model_assemble(&iso_system_point, &problem, ISO_CLOCK_T, with);
    map->zeros = iso_crossings_zeros(own, 1, map->axis, ISO_CLOCK_T);
}

/* --- many points ------------------------------------------------------------------------------------------------ */

typedef struct walk {
    size_t orbits, each;
    iso_start *start;
    iso_batch_orbit *orbit;
    iso_crossing *crossing;
    size_t *done;
    iso_status *status;
} walk;

static void free_walk(walk *w)
{
    free(w->start);
    free(w->orbit);
    free(w->crossing);
    free(w->done);
    free(w->status);
}

static bool make_walk(size_t orbits, size_t each, walk *w)
{
    w->orbits = orbits;
    w->each = each;
    w->start = calloc(orbits, sizeof *w->start);
    w->orbit = calloc(orbits, sizeof *w->orbit);
    w->crossing = malloc(orbits * each * sizeof *w->crossing);
    w->done = calloc(orbits, sizeof *w->done);
    w->status = calloc(orbits, sizeof *w->status);
    return w->start && w->orbit && w->crossing && w->done && w->status;
}

/* The crossing at z, of a half turned over by T. */
static void set_start(const iso_periodic_map *map, walk *w, size_t i, const double z[2], bool over)
{
    double y[ISO_STATE];
    iso_section_point(&map->p, 1, map->axis, z[0], z[1], y);
    for (int j = 3; j < ISO_STATE && over; j++) y[j] = -y[j];
    w->start[i] = (iso_start){.model = ISO_POINT, .eps = 1};
    memcpy(w->start[i].y, y, sizeof y);
    w->orbit[i] = (iso_batch_orbit){&map->p, &w->start[i], NULL};
}

static void set_point(const walk *w, size_t orbit, size_t crossing, iso_periodic_point *to)
{
    const iso_crossing *c = &w->crossing[w->each * orbit + crossing];
    if (crossing >= w->done[orbit]) {
        *to = (iso_periodic_point){NAN, NAN, {{NAN, NAN}, {NAN, NAN}}};
        return;
    }
    to->l = c->l;
    to->x = c->x;
    memcpy(to->slope, c->slope, sizeof to->slope);
}

static iso_status go(const iso_periodic_map *map, const walk *w, double tolerance)
{
    iso_crossings_options o = iso_crossings_defaults();
    iso_crossings *c;
    o.axis = map->axis;
    o.deviations = true;
    o.tolerance = tolerance;
    o.threads = map->threads;
    iso_status status = iso_crossings_create(map->ctx, w->orbit, w->orbits, &o, &c);
    if (status != ISO_OK) return status;
    status = iso_crossings_go(c, NULL, w->each, w->crossing, NULL, w->done, w->status);
    iso_crossings_free(c);
    return status == ISO_NO_MEMORY || status == ISO_STOPPED ? status : ISO_OK; /* some starts may fail */
}

iso_status iso_periodic_walk(const iso_periodic_map *map, size_t count, const double (*from)[2], int halves,
                             bool whole, double tolerance, iso_periodic_point *to)
{
    walk w = {0};
    const size_t kinds = whole ? 1 : 2, each = whole ? (size_t)halves : (size_t)(halves + 1) / 2;
    if (count == 0) return ISO_OK;
    const bool memory = make_walk(kinds * count, each, &w);
    iso_status status = memory ? ISO_OK : iso_context_fail(map->ctx, ISO_NO_MEMORY, "", "no memory for orbits");
    for (size_t i = 0; i < w.orbits && status == ISO_OK; i++)
        set_start(map, &w, i, from[i % count], !whole && i < count);
    if (status == ISO_OK) status = go(map, &w, tolerance);
    for (size_t i = 0; i < count && status == ISO_OK; i++)
        for (int n = 0; n < halves; n++) {
            iso_periodic_point *at = &to[(size_t)halves * i + (size_t)n];
            if (whole)
                set_point(&w, i, (size_t)n, at);
            else
                set_point(&w, n % 2 == 0 ? i : count + i, (size_t)n / 2, at);
        }
    free_walk(&w);
    return status;
}

/* --- one point in more digits ----------------------------------------------------------------------------------- */

const iso_return_code *iso_periodic_code(bool polish)
{
    if (!polish) return &iso_return_extended;
#ifdef ISO_TAYLOR_HAS_QUAD
    return &iso_return_quad;
#else
    return NULL;
#endif
}

/* slope = next slope */
static void chain(const iso_return *r, iso_wide slope[2][2])
{
    iso_wide product[2][2];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            product[i][j] = iso_wide_of(r->slope[i][0]) * slope[0][j] + iso_wide_of(r->slope[i][1]) * slope[1][j];
    memcpy(slope, product, sizeof product);
}

static iso_wide determinant_of(const iso_return *r)
{
    return iso_wide_of(r->slope[0][0]) * iso_wide_of(r->slope[1][1]) -
           iso_wide_of(r->slope[0][1]) * iso_wide_of(r->slope[1][0]);
}

/* G(l)/G(l') */
iso_wide iso_periodic_determinant(const iso_periodic_map *map, iso_wide l, iso_wide to)
{
    const iso_wide Jb = map->p.J[(map->axis + 1) % 3], Jc = map->p.J[(map->axis + 2) % 3];
    const iso_wide C[2] = {WIDE_COS(l), WIDE_COS(to)}, S[2] = {WIDE_SIN(l), WIDE_SIN(to)};
    const iso_wide q = Jb * C[0] * C[0] + Jc * S[0] * S[0], q_to = Jb * C[1] * C[1] + Jc * S[1] * S[1];
    return WIDE_POW(q_to / q, 1 / (2 * (iso_wide)map->p.k));
}

/* How far the determinant is from the law, in units of the rounding errors that its terms explain. */
static double doubt(const iso_periodic_map *map, const iso_return_code *code, const iso_return *r)
{
    const iso_wide law = iso_periodic_determinant(map, iso_wide_of(r->from[0]), iso_wide_of(r->to[0]));
    const double terms = fabs(r->slope[0][0].head * r->slope[1][1].head) +
                         fabs(r->slope[0][1].head * r->slope[1][0].head) + (double)law;
    return fabs((double)(determinant_of(r) - law)) / (terms * code->error);
}

/* One return. Steps are as long as the orbit allows; deviations that grow fast can need shorter ones. The determinant
 * shows it: then the tolerance is made smaller. */
static bool go_once(const iso_periodic_map *map, const iso_return_code *code, iso_return *r)
{
    enum { TRIES = 4, ALLOWED = 200 };
    double tolerance = map->finer * (code->error < 1e-20 ? 1e-16 : 1e-15), least = INFINITY;
    iso_return best = *r;
    for (int i = 0; i < TRIES && !(least <= ALLOWED); i++, tolerance *= 1e-3) {
        iso_return next = *r;
        if (!iso_context_goes_on(map->ctx) || !code->go(&map->model, map->axis, map->zeros, tolerance, &next))
            return false;
        const double off = doubt(map, code, &next);
        if (off < least || i == 0) best = next, least = off;
    }
    *r = best;
    return true;
}

bool iso_periodic_far(const iso_periodic_map *map, const iso_return_code *code, const iso_wide from[2], int halves,
                      iso_periodic_fine *found)
{
    memset(found, 0, sizeof *found);
    found->slope[0][0] = found->slope[1][1] = found->determinant = 1;
    for (int i = 0; i < 2; i++) found->to[i] = from[i];
    while (halves > 0) {
        iso_return r = {.half = halves % 2 == 1};
        for (int i = 0; i < 2; i++) r.from[i] = iso_fine_of(found->to[i]);
        if (!go_once(map, code, &r)) return false;
        for (int i = 0; i < 2; i++) found->to[i] = iso_wide_of(r.to[i]);
        for (int c = 0; c < ISO_CLOCKS; c++) found->clock[c] += iso_wide_of(r.clock[c]);
        chain(&r, found->slope);
        found->determinant *= determinant_of(&r);
        halves -= r.half ? 1 : 2;
    }
    return true;
}
