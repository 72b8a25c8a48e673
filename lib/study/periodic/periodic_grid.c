/* periodic_grid.c - periodic orbits of any kind: Newton's method on f^p from points spread over the section. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdlib.h>

#include "base/pi_impl.h"
#include "map/section_impl.h"
#include "study/periodic/periodic_impl.h"

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

/* The points that go on move to the front; those that have arrived are tried. */
static iso_status sweep(iso_periodic_work *w, int period, double (*z)[2], iso_periodic_point *at,
                        iso_periodic_candidate *arrived, size_t *count)
{
    iso_status status = iso_periodic_walk(&w->map, *count, (const double(*)[2])z, period, true, 1e-12, at);
    size_t left = 0, found = 0;
    for (size_t i = 0; i < *count && status == ISO_OK; i++) {
        bool there = false;
        double to[2] = {z[i][0], z[i][1]};
        if (!step(&at[(size_t)period * i + (size_t)period - 1], to, &there)) continue;
        if (there)
            arrived[found++] = (iso_periodic_candidate){-1, period, NAN, to[0], to[1]};
        else
            z[left][0] = to[0], z[left++][1] = to[1];
    }
    *count = left;
    return status == ISO_OK ? iso_periodic_add(w, arrived, found) : status;
}

static iso_status try_period(iso_periodic_work *w, const iso_section_spread *spread, int period, double (*z)[2],
                             iso_periodic_point *at, iso_periodic_candidate *arrived)
{
    size_t count = (size_t)w->options.grid;
    iso_status status = ISO_OK;
    for (size_t i = 0; i < count; i++) iso_section_spread_point(spread, i, &z[i][0], &z[i][1]);
    for (int steps = 0; steps < STEPS && count > 0 && status == ISO_OK; steps++)
        status = sweep(w, period, z, at, arrived, &count);
    return status;
}

iso_status iso_periodic_from_grid(iso_periodic_work *w)
{
    const size_t count = (size_t)w->options.grid;
    iso_section_spread spread;
    double(*z)[2] = malloc(count * sizeof *z);
    iso_periodic_point *at = malloc(count * (size_t)w->options.period * sizeof *at);
    iso_periodic_candidate *arrived = malloc(count * sizeof *arrived);
    iso_status status = z && at && arrived ? ISO_OK : iso_context_no_memory(w->ctx, "the grid");
    iso_section_spread_prepare(&spread, iso_periodic_motion(&w->map), w->map.axis, 1);
    for (int n = 1; n <= w->options.period && status == ISO_OK; n++) {
        status = try_period(w, &spread, n, z, at, arrived);
        if (w->options.progress) w->options.progress((double)n / w->options.period, w->options.data);
    }
    free(z);
    free(at);
    free(arrived);
    return status;
}
