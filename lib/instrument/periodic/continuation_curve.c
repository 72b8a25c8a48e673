/* continuation_curve.c - the curve F(u, value) = 0 of a symmetric periodic orbit: evaluation, corrector, one step. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>

#include "base/names_impl.h"
#include "instrument/periodic/continuation_impl.h"
#include "map/section_impl.h"
#include "model/model_impl.h"

ISO_NAMES(iso_vary_name, int, "k", "J1", "J2", "J3", "ratio", "level")

bool iso_continuation_params(const iso_continuation *f, double value, iso_params *p, double *energy)
{
    double J[3] = {f->base.J[0], f->base.J[1], f->base.J[2]}, k = f->base.k, level = f->level;
    iso_params own;
    iso_units units;
    switch (f->options.vary) {
    case ISO_VARY_K: k = value; break;
    case ISO_VARY_J1: J[0] = value; break;
    case ISO_VARY_J2: J[1] = value; break;
    case ISO_VARY_J3: J[2] = value; break;
    case ISO_VARY_RATIO: J[1] = J[0] + value * (J[2] - J[0]); break;
    case ISO_VARY_LEVEL: level = value; break;
    }
    if (iso_params_reduced(f->ctx, k, J, &own) != ISO_OK) return false;
    iso_units_choose(&own, 1, &units);
    *p = units.own;
    *energy = iso_level_energy(p, level);
    return iso_section_axis(iso_free_point(p, 1)) == f->axis;
}

/* Half the orbit, from (u, value) to the line again. */
static bool shoot(const iso_continuation *f, double u, double value, iso_periodic_shot *shot)
{
    iso_params p;
    double energy;
    iso_periodic_map map;
    if (!iso_continuation_params(f, value, &p, &energy)) return false;
    iso_periodic_map_prepare(f->ctx, &p, energy, 1, &map);
    return iso_periodic_shoot(&map, &iso_return_extended, f->line, u, f->period, shot);
}

/* The slope by v, by differences: its error is of the order of h^2. */
static bool find_by_v(const iso_continuation *f, iso_continuation_point *at)
{
    const double h = 2e-5;
    double ends[2];
    for (int i = 0; i < 2; i++) {
        iso_periodic_shot side;
        if (!shoot(f, at->u, (at->v + (2 * i - 1) * h) * f->width, &side)) return false;
        ends[i] = (double)side.off;
    }
    at->by_v = (ends[1] - ends[0]) / (2 * h);
    return true;
}

bool iso_continuation_evaluate(const iso_continuation *f, double u, double v, bool slopes, iso_continuation_point *at)
{
    iso_periodic_shot shot;
    if (!shoot(f, u, v * f->width, &shot)) return false;
    at->u = u, at->v = v, at->value = v * f->width;
    for (int i = 0; i < 2; i++) at->z[i] = (double)shot.z[i];
    at->off = (double)shot.off;
    for (int i = 0; i < 4; i++) at->D[i / 2][i % 2] = (double)shot.D[i / 2][i % 2];
    at->trace = (double)shot.trace;
    return !slopes || find_by_v(f, at);
}

void iso_continuation_turn(iso_continuation_point *at, const double like[2])
{
    const double length = hypot(at->D[1][0], at->by_v);
    at->tangent[0] = -at->by_v / length;
    at->tangent[1] = at->D[1][0] / length;
    const double along = like ? at->tangent[0] * like[0] + at->tangent[1] * like[1] : at->tangent[1];
    if (along < 0) at->tangent[0] = -at->tangent[0], at->tangent[1] = -at->tangent[1];
}

/* Newton's method across the tangent of `a`; by_v is kept from the predicted point, and found again at the end. */
bool iso_continuation_step(const iso_continuation *f, const iso_continuation_point *a, double ds,
                           iso_continuation_point *to, int *steps)
{
    enum { MOST = 8 };
    const double *t = a->tangent;
    double u = a->u + ds * t[0], v = a->v + ds * t[1];
    bool there = false;
    for (*steps = 0; *steps < MOST && !there; ++*steps) {
        if (!iso_continuation_evaluate(f, u, v, *steps == 0, to)) return false;
        const double det = to->D[1][0] * t[1] - to->by_v * t[0];
        const double du = -to->off * t[1] / det, dv = to->off * t[0] / det, length = hypot(du, dv);
        if (!(length < 2 * fabs(ds) + 1e-9)) return false;
        there = length < 1e-12;
        u += du, v += dv;
    }
    if (!there || !find_by_v(f, to)) return false;
    iso_continuation_turn(to, t);
    return to->tangent[0] * t[0] + to->tangent[1] * t[1] > 0.9;
}

iso_branch_point iso_continuation_read(const iso_continuation_point *at, double arc)
{
    return (iso_branch_point){at->value, at->u, at->z[0], at->z[1], at->trace, arc};
}
