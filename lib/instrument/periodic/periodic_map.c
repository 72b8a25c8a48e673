/* periodic_map.c - the return map f of the section and half of it, g: many points at once in the lanes of vectors,
 * one point in numbers of more digits; the six symmetry lines of the map, and shots from one of them to itself.
 *
 * g z: from the crossing z half a return, to the next crossing downwards, then T: gamma -> -gamma. A start at -gamma,
 * M is a crossing downwards; its next crossings upwards are g z, g^3 z, ...
 *
 * Between the crossings g^(p-1) z and g^p z an orbit passes a line half way if g^p z = S g^(p-1) z. So what stands
 * for the distance from the line is the middle of the two crossings, and its derivative (1 + D g)/2.
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/math_impl.h"
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
static void begin(void *user, size_t i, iso_start *start, iso_batch_orbit *orbit)
{
    const points *p = user;
    const iso_periodic_map *map = p->map;
    *start = (iso_start){.model = ISO_POINT, .eps = 1};
    *orbit = (iso_batch_orbit){&map->p, start, map->energy != 0 ? &map->effects : NULL};
    if (p->z) {
        iso_section_point(iso_periodic_motion(map), map->axis, p->z[i][0], p->z[i][1], start->y);
        for (int j = 3; j < ISO_STATE && p->over; j++) start->y[j] = -start->y[j];
        return;
    }
    const int a = map->axis, b = (a + 1) % 3, c = (a + 2) % 3;
    double *M = start->y, *gamma = M + 3, along[3] = {0};
    if (p->from == ISO_FROM_POLE) {
        gamma[a] = -1, along[b] = cos(p->u[i]), along[c] = sin(p->u[i]);
    } else {
        gamma[a] = -sin(p->u[i]), gamma[p->from == ISO_FROM_PLANE_B ? c : b] = cos(p->u[i]);
        along[p->from == ISO_FROM_PLANE_B ? b : c] = 1;
    }
    const double k = map->p.k, q = dot_diag(gamma, map->p.J, gamma);
    cross(along, gamma, M);
    scale(M, sqrt(2) * pow(q, -1 / (2 * k)) * sqrt(1 + map->energy * pow(q, 1 / k)));
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
            *at = part[i];
            for (int j = 0; j < 4 && n > 0; j++) /* the chain rule */
                at->slope[j / 2][j % 2] = part[i].slope[j / 2][0] * at[-1].slope[0][j % 2] +
                                          part[i].slope[j / 2][1] * at[-1].slope[1][j % 2];
            z[i][0] = at->l, z[i][1] = at->x;
        }
    }
    free(z);
    free(part);
    return status;
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

/* One return. Steps are as long as the orbit allows; deviations that grow fast can need shorter ones. The determinant
 * shows it: how far it is from the law, in units of the rounding errors that its terms explain. Then the tolerance is
 * made smaller. The area of (u, c) half way is G du dc. */
static bool go_once(const iso_periodic_map *map, const iso_return_build *code, iso_return *r)
{
    enum { TRIES = 4, ALLOWED = 200 };
    const iso_wide u = iso_wide_of(r->from[0]), C = WIDE_COS(u), S = WIDE_SIN(u), Ja = map->p.J[map->axis];
    const double Jb = map->p.J[(map->axis + (r->start == ISO_FROM_PLANE_B ? 2 : 1)) % 3];
    const iso_wide q = r->start <= ISO_FROM_BELOW  ? q_at(map, u)
                       : r->start == ISO_FROM_POLE ? Ja
                                                   : Jb * C * C + Ja * S * S;
    double tolerance = map->finer * (code->error < 1e-20 ? 1e-16 : 1e-15), least = INFINITY;
    iso_return best = *r;
    for (int i = 0; i < TRIES && !(least <= ALLOWED); i++, tolerance *= 1e-3) {
        iso_return next = *r;
        if (!iso_context_goes_on(map->ctx) || !code->go(&map->model, map->axis, map->zeros, tolerance, &next))
            return false;
        const iso_wide wanted = law(map, q, q_at(map, iso_wide_of(next.to[0])));
        const double terms = fabs(next.slope[0][0].head * next.slope[1][1].head) +
                             fabs(next.slope[0][1].head * next.slope[1][0].head) + (double)wanted;
        const double off = fabs((double)(WIDE_ABS(determinant_of(&next)) - wanted)) / (terms * code->error);
        if (off < least || i == 0) best = next, least = off;
    }
    *r = best;
    return true;
}

/* The piece `first`, and then `next`, which begins at its end. *both is neither of them. */
static void join(const iso_periodic_fine *first, const iso_periodic_fine *next, iso_periodic_fine *both)
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
    join(&before, &next, orbit);
    return true;
}

bool iso_periodic_far(const iso_periodic_map *map, const iso_return_build *code, const iso_wide from[2], int halves,
                      double (*path)[2], iso_periodic_fine *found)
{
    *found = (iso_periodic_fine){.to = {from[0], from[1]}, .slope = {{1, 0}, {0, 1}}, .determinant = 1};
    for (int n = 0; n < halves;) {
        const bool half = path || (halves - n) % 2 == 1;
        if (!go_on(map, code, half ? ISO_FROM_BELOW : ISO_FROM_CHART, found)) return false;
        if (path) path[n][0] = (double)found->to[0], path[n][1] = (double)found->to[1];
        n += half ? 1 : 2;
    }
    return true;
}

/* --- symmetry lines --------------------------------------------------------------------------------------------- */

/* At u = 0 and u = pi/2: the axis of the rotation there, and the axis on which the point is; 0, 1, 2: a, b, c. */
static const int turns_about[LINES][2] = {{2, 1}, {2, 0}, {1, 0}, {2, 1}, {0, 2}, {0, 1}};
static const int stands_on[LINES][2] = {{1, 2}, {1, 1}, {2, 2}, {0, 0}, {2, 0}, {1, 0}};

int iso_symmetry_line_axis_at(int axis, int line, bool end)
{
    return (axis + turns_about[line][end]) % 3;
}

/* q along a line goes one way, so that the point can move up to one place, or from one on. */
bool iso_symmetry_line_range(const iso_periodic_map *map, int line, double u[2])
{
    const double *J = map->p.J, k = map->p.k;
    const double q[2] = {J[(map->axis + stands_on[line][0]) % 3], J[(map->axis + stands_on[line][1]) % 3]};
    u[0] = 0, u[1] = ISO_PI / 2;
    const bool moves[2] = {1 + map->energy * pow(q[0], 1 / k) > 0, 1 + map->energy * pow(q[1], 1 / k) > 0};
    if (moves[0] == moves[1]) return moves[0];
    const double border = pow(-map->energy, -k), part = (border - q[0]) / (q[1] - q[0]); /* sin^2 u */
    u[moves[0]] = asin(sqrt(fmin(fmax(part, 0), 1)));
    return true;
}

void iso_periodic_reverse(int reversor, const double z[2], double to[2])
{
    to[0] = reversor == 0 ? z[0] : reversor == 1 ? -z[0] : ISO_PI - z[0];
    to[1] = reversor == 0 ? -z[1] : z[1];
}

static iso_return_start start_of(int line)
{
    return line == LINE_POLE ? ISO_FROM_POLE : line == LINE_PLANE_B ? ISO_FROM_PLANE_B : ISO_FROM_PLANE_C;
}

/* Half way the slopes are differences: they need few digits, for they only guide the search. */
iso_status iso_periodic_place(const iso_periodic_map *map, int line, size_t count, const double u[], double (*z)[2],
                              double (*by_u)[2])
{
    const double h = 1e-5;
    const bool half_way = iso_symmetry_line_is_half_way(line), flat = line == LINE_X;
    for (size_t i = 0; i < count && !half_way; i++) {
        z[i][0] = flat ? u[i] : line == LINE_0 ? 0 : ISO_PI / 2;
        z[i][1] = flat ? 0 : sin(u[i]);
        by_u[i][0] = flat ? 1 : 0;
        by_u[i][1] = flat ? 0 : cos(u[i]);
    }
    if (!half_way) return ISO_OK;
    double *near = calloc(3 * count, sizeof *near);
    iso_periodic_point *to = malloc(3 * count * sizeof *to);
    iso_status status = near && to ? ISO_OK : iso_context_no_memory(map->ctx, "the search");
    for (size_t i = 0; i < 3 * count && status == ISO_OK; i++) near[i] = u[i / 3] + h * ((double)(i % 3) - 1);
    points p = {.map = map, .from = start_of(line), .u = near, .each = 1, .to = to};
    if (status == ISO_OK) status = go(&p, 3 * count, 1e-13);
    for (size_t i = 0; i < count && status == ISO_OK; i++) {
        const iso_periodic_point *at = &to[3 * i];
        z[i][0] = at[1].l, z[i][1] = at[1].x;
        by_u[i][0] = remainder(at[2].l - at[0].l, 2 * ISO_PI) / (2 * h);
        by_u[i][1] = (at[2].x - at[0].x) / (2 * h);
    }
    free(near);
    free(to);
    return status;
}

double iso_periodic_miss(int line, const iso_periodic_point *before, const iso_periodic_point *at,
                         const double by_u[2], double *slope, bool *there)
{
    const double part = iso_symmetry_line_is_half_way(line) ? 1 : 0, l = at->l + part * before->l,
                 x = at->x + part * before->x;
    double image[2], change[2]; /* change: of l and x by u */
    for (int i = 0; i < 2; i++)
        change[i] = (at->slope[i][0] + part * before->slope[i][0]) * by_u[0] +
                    (at->slope[i][1] + part * before->slope[i][1]) * by_u[1];
    iso_periodic_reverse(iso_symmetry_line_reversor(line), (const double[2]){before->l, before->x}, image);
    *there = !iso_symmetry_line_is_half_way(line) ||
             (fabs(remainder(at->l - image[0], 2 * ISO_PI)) < 1e-3 && fabs(at->x - image[1]) < 1e-3);
    if (iso_symmetry_line_reversor(line) == 0) return *slope = change[1], x;
    if (line == LINE_QUARTER) return *slope = -sin(l) * change[0], cos(l);
    return *slope = cos(l) * change[0], sin(l);
}

/* --- shots ------------------------------------------------------------------------------------------------------ */

/* The crossings around the line: before and behind, with their derivatives by (u, c). On the section they are one. */
typedef struct arrival {
    const iso_wide *before, *behind;
    iso_wide (*A)[2], (*B)[2];
    iso_wide det; /* of A */
} arrival;

static void invert(const iso_wide A[2][2], iso_wide inverse[2][2])
{
    const iso_wide det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
    inverse[0][0] = A[1][1] / det, inverse[0][1] = -A[0][1] / det;
    inverse[1][0] = -A[1][0] / det, inverse[1][1] = A[0][0] / det;
}

/* s->back = R first^-1 E, E the derivative of the line's reversor S. From the section the way back is S g^-p S: R = E,
 * first = D g^p. Half way z = g S z, so that g^p at S g^(p-1) z is g S g^(1-p) S: R = D(g S), first = D g^(p-1). */
static void find_back(int line, const iso_wide R[2][2], const iso_wide first[2][2], iso_periodic_shot *s)
{
    const int over = iso_symmetry_line_reversor(line) == 0;
    iso_wide inverse[2][2];
    invert(first, inverse);
    iso_wide_multiply(R, (const iso_wide(*)[2])inverse, s->back);
    for (int i = 0; i < 2; i++) s->back[i][over] = -s->back[i][over];
}

/* S behind = before on the line, so that K = A^-1 S B = D^-1 E D. The trace is 2 K_00. Of K_00 - 1 and K_00 + 1 the
 * smaller one has more digits. */
static void arrive(int line, const arrival *a, iso_periodic_shot *s)
{
    const int reversor = iso_symmetry_line_reversor(line), odd = reversor == 0; /* odd: which of l, x it turns over */
    const double S[2] = {odd == 0 ? -1 : 1, odd == 1 ? -1 : 1};
    iso_wide part[2]; /* of (S B - A, S B + A) */
    double terms[2];
    for (int i = 0; i < 2; i++) {
        s->miss[i] = a->behind[i] - S[i] * a->before[i];
        s->miss_by_u[i] = a->B[i][0] - S[i] * a->A[i][0];
        s->D[0][i] = (a->A[1 - odd][i] + a->B[1 - odd][i]) / 2;
        s->D[1][i] = (a->A[odd][i] + a->B[odd][i]) / 2;
        const int sign = i == 0 ? -1 : 1;
        const iso_wide l = S[0] * a->B[0][0] + sign * a->A[0][0], x = S[1] * a->B[1][0] + sign * a->A[1][0];
        part[i] = 2 * (a->A[1][1] * l - a->A[0][1] * x) / a->det;
        terms[i] = 2 * (double)((WIDE_ABS(a->A[1][1] * l) + WIDE_ABS(a->A[0][1] * x)) / WIDE_ABS(a->det));
    }
    s->miss[0] = iso_wide_wrap(s->miss[0] - (reversor == 2 ? WIDE_PI : 0), 2 * WIDE_PI);
    const iso_wide middle = (a->before[odd] + a->behind[odd]) / 2;
    s->off = odd == 1 ? middle : iso_wide_wrap(middle - (reversor == 1 ? 0 : WIDE_PI / 2), WIDE_PI);
    const int smaller = WIDE_ABS(part[0]) < WIDE_ABS(part[1]) ? 0 : 1;
    s->trace = smaller == 0 ? 2 + part[0] : part[1] - 2;
    s->terms = 2 + terms[smaller];
}

static bool shoot_from_section(const iso_periodic_map *map, const iso_return_build *code, int line, int period,
                               iso_periodic_shot *s)
{
    const bool flat = line == LINE_X;
    s->z[0] = flat ? s->u : line == LINE_0 ? 0 : WIDE_PI / 2;
    s->z[1] = flat ? 0 : WIDE_SIN(s->u);
    if (!(WIDE_ABS(s->z[1]) < 1) || !iso_periodic_far(map, code, s->z, period, s->path, &s->half)) return false;
    const iso_wide stretch = flat ? 1 : WIDE_COS(s->u), law = iso_periodic_determinant(map, s->z[0], s->half.to[0]);
    iso_wide A[2][2];
    for (int i = 0; i < 2; i++) {
        A[i][0] = s->half.slope[i][flat ? 0 : 1] * stretch;
        A[i][1] = s->half.slope[i][flat ? 1 : 0];
    }
    arrive(line, &(arrival){s->half.to, s->half.to, A, A, flat ? law : -law * stretch}, s);
    const iso_wide E[2][2] = {{flat ? 1 : -1, 0}, {0, flat ? -1 : 1}};
    find_back(line, E, (const iso_wide(*)[2])s->half.slope, s);
    memcpy(s->clock, s->half.clock, sizeof s->clock);
    return true;
}

/* in: from the line to z; before: from z to the last crossing before the line at the end; last: from there on. */
static bool shoot_from_half_way(const iso_periodic_map *map, const iso_return_build *code, int line, int period,
                                iso_periodic_shot *s)
{
    iso_periodic_fine in = {.to = {s->u, 0}, .slope = {{1, 0}, {0, 1}}, .determinant = 1}, before, last;
    iso_wide A[2][2], B[2][2], from_u[2][2], R[2][2];
    if (!go_on(map, code, start_of(line), &in)) return false;
    memcpy(s->z, in.to, sizeof s->z);
    if (!iso_periodic_far(map, code, s->z, period - 1, s->path, &before)) return false;
    if (!iso_periodic_far(map, code, before.to, 1, s->path + period - 1, &last)) return false;
    iso_wide_multiply((const iso_wide(*)[2])before.slope, (const iso_wide(*)[2])in.slope, A);
    iso_wide_multiply((const iso_wide(*)[2])last.slope, (const iso_wide(*)[2])A, B);
    arrive(line, &(arrival){before.to, last.to, A, B, before.determinant * in.determinant}, s);
    join(&before, &last, &s->half);
    /* D(g S) at z turns over c, and leaves u as it is */
    const iso_wide turned[2][2] = {{in.slope[0][0], -in.slope[0][1]}, {in.slope[1][0], -in.slope[1][1]}};
    invert((const iso_wide(*)[2])in.slope, from_u);
    iso_wide_multiply(turned, (const iso_wide(*)[2])from_u, R);
    find_back(line, (const iso_wide(*)[2])R, (const iso_wide(*)[2])before.slope, s);
    for (int c = 0; c < ISO_CLOCKS; c++) s->clock[c] = in.clock[c] + before.clock[c] + last.clock[c] / 2;
    return true;
}

bool iso_periodic_shoot(const iso_periodic_map *map, const iso_return_build *code, int line, iso_wide u, int period,
                        iso_periodic_shot *shot)
{
    shot->u = u;
    if (iso_symmetry_line_is_half_way(line)) return shoot_from_half_way(map, code, line, period, shot);
    return shoot_from_section(map, code, line, period, shot);
}
