/* continuation_switch.c - the orbits that branch off where a followed orbit doubles its period or loses a symmetry.
 *
 * They begin next to the orbit. So beside each of its points on a symmetry line, F of the new period is sampled at a
 * value of the parameter a little to each side. There it has three zeros where branches are: the orbit itself, in the
 * middle, and two of the new orbit. The first one is taken. Orbits without a symmetry are not found.
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>

#include "base/pi_impl.h"
#include "study/periodic/continuation_impl.h"

enum { SAMPLES = 40 };
#define ASIDE 0.004 /* of the range */
#define WINDOW 0.12 /* of the line, to each side */

/* The zero of F between u and u + h, by halving; NaN: it is a jump. */
static double refine(const iso_continuation *f, double v, double u, double h, double off)
{
    iso_continuation_point at;
    for (int i = 0; i < 40 && fabs(h) > 1e-12; i++) {
        h /= 2;
        if (!iso_continuation_evaluate(f, u + h, v, false, &at)) return NAN;
        if ((at.off < 0) == (off < 0)) u += h;
    }
    return fabs(at.off) < 1e-3 * (1 + fabs(at.by_u)) ? u : NAN;
}

/* The first of three zeros or more around `middle`; NaN: there are less. */
static double first_of_three(const iso_continuation *f, double v, double middle)
{
    iso_continuation_point at;
    double before = NAN, first = NAN, off = NAN;
    int zeros = 0;
    for (int i = 0; i <= SAMPLES; i++) {
        const double u = middle + WINDOW * (2.0 * i / SAMPLES - 1);
        if (!(u > 0 && u < ISO_PI / 2) || !iso_continuation_evaluate(f, u, v, false, &at)) continue;
        if (at.off * before < 0 && fabs(at.off - before) < 1) {
            if (zeros++ == 0) first = u, off = before;
        }
        before = at.off;
    }
    const double h = 2 * WINDOW / SAMPLES;
    return zeros >= 3 ? refine(f, v, first - h, h, off) : NAN;
}

/* The u of a line half way whose orbit crosses at z, as near as samples tell; NaN: none. */
static double look_up(const iso_periodic_map *map, int line, const double z[2])
{
    enum { PLACES = 400 };
    double u[PLACES], place[PLACES][2], by_u[PLACES][2], best = NAN, least = 0.02;
    for (int i = 0; i < PLACES; i++) u[i] = ISO_PI / 2 * (i + 0.5) / PLACES;
    if (iso_periodic_place(map, line, PLACES, u, place, by_u) != ISO_OK) return NAN;
    for (int i = 0; i < PLACES; i++)
        if (iso_periodic_apart(place[i], z) < least) best = u[i], least = iso_periodic_apart(place[i], z);
    return best;
}

/* Where the orbit passes a line between its crossings `before` and z, or at z; NaN: nowhere. */
static double parameter_on(const iso_periodic_map *map, int line, const double before[2], const double z[2])
{
    const double near = 1e-4, l = fabs(remainder(z[0], ISO_PI)), x = fabs(z[1]);
    double image[2];
    if (line == LINE_X) return x < near ? l : NAN;
    if (!iso_symmetry_line_is_half_way(line))
        return fabs(l - (line == LINE_0 ? 0 : ISO_PI / 2)) < near ? asin(fmin(x, 1)) : NAN;
    iso_periodic_reverse(iso_symmetry_line_reversor(line), before, image);
    if (fabs(remainder(z[0] - image[0], 2 * ISO_PI)) > near || fabs(z[1] - image[1]) > near) return NAN;
    return look_up(map, line, z);
}

typedef struct finder {
    const iso_continuation *family; /* of the new period */
    const iso_periodic_map *map;
    double value;
    iso_status (*found)(void *data, const iso_continuation *f, double u, double value);
    void *data;
} finder;

/* Looks beside one point of the orbit, on all lines. */
static iso_status look_beside(const finder *s, const double before[2], const double z[2], bool *any)
{
    iso_status status = ISO_OK;
    for (int line = 0; line < LINES; line++) {
        const double u = parameter_on(s->map, line, before, z);
        iso_continuation beside = *s->family;
        beside.line = line;
        for (int side = -1; side <= 1 && !isnan(u) && !*any && status == ISO_OK; side += 2) {
            const double at = s->value + side * ASIDE * beside.width,
                         root = first_of_three(&beside, at / beside.width, u);
            *any = !isnan(root);
            if (*any) status = s->found(s->data, &beside, root, at);
        }
    }
    return status;
}

iso_status iso_continuation_switch(const iso_continuation *f, const iso_branch *b, const iso_branch_event *e,
                                   iso_status (*found)(void *data, const iso_continuation *f, double u, double value),
                                   void *data)
{
    iso_continuation other = *f;
    iso_params p;
    double energy;
    iso_periodic_map map;
    const double from[1][2] = {{e->at.l, e->at.x}};
    iso_periodic_point point[2 * ISO_PERIODIC_MOST];
    const int halves = 2 * b->period;
    bool any = false;
    other.period = iso_continuation_doubles(e->kind) ? 2 * b->period : b->period;
    if (other.period > ISO_PERIODIC_MOST || !iso_continuation_params(f, e->at.value, &p, &energy)) return ISO_OK;
    iso_periodic_map_prepare(f->ctx, &p, energy, 1, &map);
    const finder s = {&other, &map, e->at.value, found, data};
    iso_status status = iso_periodic_walk(&map, 1, from, halves, false, 1e-13, point);
    for (int n = 0; n < halves && !any && status == ISO_OK; n++) {
        const iso_periodic_point *last = &point[(n + halves - 1) % halves];
        status =
            look_beside(&s, (const double[2]){last->l, last->x}, (const double[2]){point[n].l, point[n].x}, &any);
    }
    return status;
}
