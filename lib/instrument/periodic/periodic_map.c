/* periodic_map.c - the return map f of the section and half of it, g: many points at once in the lanes of vectors,
 * one point in numbers of more digits.
 *
 * g z: from the crossing z half a return, to the next crossing downwards, then T: gamma -> -gamma. A start at -gamma,
 * M is a crossing downwards; its next crossings upwards are g z, g^3 z, ...
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/vec3_impl.h"
#include "instrument/periodic/periodic_impl.h"
#include "method/taylor/lanes_impl.h"
#include "model/model_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/walk_impl.h"

void iso_periodic_map_turn(int axis, iso_periodic_map *map)
{
    map->axis = axis;
    map->zeros = iso_crossings_zeros(iso_periodic_motion(map), axis, iso_lane_clock(&map->model));
}

void iso_periodic_map_prepare(iso_context *ctx, const iso_params *own, double energy, int threads,
                              iso_periodic_map *map)
{
    const iso_problem problem = {.p = *own, .eps = 1, .energy = energy};
    const bool with[ISO_CLOCKS] = {true, true, true};
    *map = (iso_periodic_map){.ctx = ctx, .p = *own, .energy = energy, .threads = threads, .finer = 1};
    map->model = iso_model_assemble(&iso_system_point, &problem, ISO_CLOCK_T, with);
    map->effects = iso_effects_default();
    iso_effects_set_level(&map->effects, energy != 0, iso_energy(own, energy));
    iso_periodic_map_turn(iso_section_axis(iso_periodic_motion(map)), map);
}

/* --- many points ------------------------------------------------------------------------------------------------ */

/* Starts: crossings z, turned over by T or not; or, where z is NULL, half way at u. */
typedef struct points {
    const iso_periodic_map *map;
    const double (*z)[2];
    bool over;
    iso_return_start from;
    const double *u;
    size_t each;
    iso_periodic_point *to;
} points;

/* The start half way at u (iso_return_start): M = G gamma'/|gamma'| x gamma. */
static void half_way(const iso_periodic_map *map, iso_return_start from, double u, double y[ISO_STATE])
{
    const int a = map->axis, b = (a + 1) % 3, c = (a + 2) % 3;
    double *M = y, *gamma = y + 3, along[3] = {0};
    if (from == ISO_FROM_POLE) {
        gamma[a] = -1, along[b] = cos(u), along[c] = sin(u);
    } else {
        gamma[a] = -sin(u), gamma[from == ISO_FROM_PLANE_B ? c : b] = cos(u);
        along[from == ISO_FROM_PLANE_B ? b : c] = 1;
    }
    const double k = map->p.k, q = dot_diag(gamma, map->p.J, gamma);
    cross(along, gamma, M);
    scale(M, sqrt(2) * pow(q, -1 / (2 * k)) * sqrt(1 + map->energy * pow(q, 1 / k)));
}

static void begin(void *user, size_t i, iso_start *start, iso_batch_orbit *orbit)
{
    const points *p = user;
    const iso_periodic_map *map = p->map;
    *start = (iso_start){.model = ISO_POINT, .eps = 1};
    *orbit = (iso_batch_orbit){&map->p, start, map->energy != 0 ? &map->effects : NULL};
    if (!p->z) half_way(map, p->from, p->u[i], start->y);
    if (p->z) iso_section_point(iso_periodic_motion(map), map->axis, p->z[i][0], p->z[i][1], start->y);
    for (int j = 3; j < ISO_STATE && p->over; j++) start->y[j] = -start->y[j];
}

static iso_status store(void *user, size_t i, const iso_walk_stop *stop)
{
    const points *p = user;
    const iso_crossing *c = stop->crossing[0];
    iso_periodic_point *to = &p->to[p->each * i + stop->number - 1];
    to->l = c->l;
    to->x = c->x;
    memcpy(to->slope, c->slope, sizeof to->slope);
    return ISO_OK;
}

/* p->to[each i + n]: crossing n + 1 of start i. */
static iso_status go(points *p, size_t count, double tolerance)
{
    const iso_periodic_map *map = p->map;
    iso_walk w = {.ctx = map->ctx, .count = count, .most = p->each, .models = 1};
    w.user = p, w.begin = begin, w.visit = store;
    w.options[0] = iso_crossings_defaults();
    w.options[0].axis = map->axis;
    w.options[0].deviations = p->z != NULL;
    w.options[0].tolerance = tolerance;
    w.options[0].threads = map->threads;
    for (size_t n = 0; n < count * p->each; n++) p->to[n] = (iso_periodic_point){NAN, NAN, {{NAN, NAN}, {NAN, NAN}}};
    return iso_walk_go(&w);
}

/* *to: the piece to *first, and then to *next, which begins there. */
static void join_points(const iso_periodic_point *first, const iso_periodic_point *next, iso_periodic_point *to)
{
    to->l = next->l, to->x = next->x;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            to->slope[i][j] = next->slope[i][0] * first->slope[0][j] + next->slope[i][1] * first->slope[1][j];
}

iso_status iso_periodic_walk(const iso_periodic_map *map, size_t count, const double (*from)[2], int halves,
                             bool whole, double tolerance, iso_periodic_point *to)
{
    const size_t each = (size_t)halves;
    if (whole) return go(&(points){.map = map, .z = from, .each = each, .to = to}, count, tolerance);
    double(*z)[2] = malloc(count * sizeof *z);
    iso_periodic_point *part = malloc(count * sizeof *part);
    iso_status status = z && part ? ISO_OK : iso_context_no_memory(map->ctx, "orbits");
    if (status == ISO_OK) memcpy(z, from, count * sizeof *z);
    points p = {.map = map, .z = (const double(*)[2])z, .over = true, .each = 1, .to = part};
    for (size_t n = 0; n < each && status == ISO_OK; n++) {
        status = go(&p, count, tolerance);
        for (size_t i = 0; i < count && status == ISO_OK; i++) {
            iso_periodic_point *at = &to[each * i + n];
            if (n == 0)
                *at = part[i];
            else
                join_points(at - 1, &part[i], at);
            z[i][0] = at->l, z[i][1] = at->x;
        }
    }
    free(z);
    free(part);
    return status;
}

iso_status iso_periodic_enter_many(const iso_periodic_map *map, iso_return_start start, size_t count,
                                   const double u[], iso_periodic_point *to)
{
    return go(&(points){.map = map, .from = start, .u = u, .each = 1, .to = to}, count, 1e-13);
}

/* --- one point in more digits ----------------------------------------------------------------------------------- */

static iso_wide determinant_of(const iso_return *r)
{
    return iso_wide_of(r->slope[0][0]) * iso_wide_of(r->slope[1][1]) -
           iso_wide_of(r->slope[0][1]) * iso_wide_of(r->slope[1][0]);
}

/* (gamma, J gamma) at a crossing. */
static iso_wide q_at(const iso_periodic_map *map, iso_wide l)
{
    const iso_wide C = WIDE_COS(l), S = WIDE_SIN(l);
    return map->p.J[(map->axis + 1) % 3] * C * C + map->p.J[(map->axis + 2) % 3] * S * S;
}

/* The same where a return begins (iso_return_start). */
static iso_wide q_of(const iso_periodic_map *map, const iso_return *r)
{
    const iso_wide u = iso_wide_of(r->from[0]), C = WIDE_COS(u), S = WIDE_SIN(u), Ja = map->p.J[map->axis];
    const int beside = r->start == ISO_FROM_PLANE_B ? 2 : 1;
    if (r->start <= ISO_FROM_BELOW) return q_at(map, u);
    return r->start == ISO_FROM_POLE ? Ja : map->p.J[(map->axis + beside) % 3] * C * C + Ja * S * S;
}

/* G(l)/G(l'), by q and q': G^2 = 2 q^(-1/k) (1 + H q^(1/k)). */
static iso_wide law(const iso_periodic_map *map, iso_wide q, iso_wide to)
{
    const iso_wide k = (iso_wide)map->p.k, H = map->energy, ratio = WIDE_POW(to / q, 1 / (2 * k));
    return H == 0 ? ratio : ratio * WIDE_ROOT((1 + H * WIDE_POW(q, 1 / k)) / (1 + H * WIDE_POW(to, 1 / k)));
}

iso_wide iso_periodic_determinant(const iso_periodic_map *map, iso_wide l, iso_wide to)
{
    return law(map, q_at(map, l), q_at(map, to));
}

/* How far the determinant is from the law, in units of the rounding errors that its terms explain. The area of (u, c)
 * half way is G du dc. */
static double doubt(const iso_periodic_map *map, const iso_return_build *code, const iso_return *r)
{
    const iso_wide wanted = law(map, q_of(map, r), q_at(map, iso_wide_of(r->to[0])));
    const double terms = fabs(r->slope[0][0].head * r->slope[1][1].head) +
                         fabs(r->slope[0][1].head * r->slope[1][0].head) + (double)wanted;
    return fabs((double)(WIDE_ABS(determinant_of(r)) - wanted)) / (terms * code->error);
}

/* One return. Steps are as long as the orbit allows; deviations that grow fast can need shorter ones. The determinant
 * shows it: then the tolerance is made smaller. */
static bool go_once(const iso_periodic_map *map, const iso_return_build *code, iso_return *r)
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

void iso_periodic_join(const iso_periodic_fine *first, const iso_periodic_fine *next, iso_periodic_fine *both)
{
    *both = *next;
    iso_wide_multiply(next->slope, first->slope, both->slope);
    both->determinant = first->determinant * next->determinant;
    for (int c = 0; c < ISO_CLOCKS; c++) both->clock[c] = first->clock[c] + next->clock[c];
}

/* Goes on by one return. */
static bool go_on(const iso_periodic_map *map, const iso_return_build *code, iso_return_start start,
                  iso_periodic_fine *orbit)
{
    iso_return r = {.start = start, .from = {iso_fine_of(orbit->to[0]), iso_fine_of(orbit->to[1])}};
    if (!go_once(map, code, &r)) return false;
    const iso_periodic_fine before = *orbit;
    iso_periodic_fine next = {.determinant = determinant_of(&r)};
    for (int i = 0; i < 2; i++) {
        next.to[i] = iso_wide_of(r.to[i]);
        for (int j = 0; j < 2; j++) next.slope[i][j] = iso_wide_of(r.slope[i][j]);
    }
    for (int c = 0; c < ISO_CLOCKS; c++) next.clock[c] = iso_wide_of(r.clock[c]);
    iso_periodic_join(&before, &next, orbit);
    return true;
}

static iso_periodic_fine standing_at(iso_wide first, iso_wide second)
{
    return (iso_periodic_fine){.to = {first, second}, .slope = {{1, 0}, {0, 1}}, .determinant = 1};
}

bool iso_periodic_far(const iso_periodic_map *map, const iso_return_build *code, const iso_wide from[2], int halves,
                      double (*path)[2], iso_periodic_fine *found)
{
    *found = standing_at(from[0], from[1]);
    for (int n = 0; n < halves;) {
        const bool half = path || (halves - n) % 2 == 1;
        if (!go_on(map, code, half ? ISO_FROM_BELOW : ISO_FROM_CHART, found)) return false;
        if (path) path[n][0] = (double)found->to[0], path[n][1] = (double)found->to[1];
        n += half ? 1 : 2;
    }
    return true;
}

bool iso_periodic_enter(const iso_periodic_map *map, const iso_return_build *code, iso_return_start start, iso_wide u,
                        iso_periodic_fine *found)
{
    *found = standing_at(u, 0);
    return go_on(map, code, start, found);
}
