/* follow_curve.c - the curve F(u, value) = 0 of a symmetric periodic orbit: evaluation, corrector, one step. */
#include <math.h>

#include "base/pi_impl.h"
#include "study/follow_impl.h"

bool iso_follow_params(const iso_follow_family *f, double value, iso_params *p)
{
    double J[3] = {f->base.J[0], f->base.J[1], f->base.J[2]}, k = f->base.k;
    iso_params own;
    iso_units units;
    switch (f->options.vary) {
    case ISO_VARY_K: k = value; break;
    case ISO_VARY_J1: J[0] = value; break;
    case ISO_VARY_J2: J[1] = value; break;
    case ISO_VARY_J3: J[2] = value; break;
    case ISO_VARY_RATIO: J[1] = J[0] + value * (J[2] - J[0]); break;
    }
    if (iso_params_reduced(f->ctx, k, J, &own) != ISO_OK) return false;
    iso_units_choose(&own, 1, &units);
    *p = units.own;
    return iso_section_axis(p) == f->axis;
}

/* g^p of the point at (u, value). */
static bool far_from(const iso_follow_family *f, double u, double value, iso_periodic_fine *found)
{
    iso_params p;
    iso_periodic_map map;
    double z[2];
    if (!iso_follow_params(f, value, &p)) return false;
    iso_periodic_map_prepare(f->ctx, &p, 1, &map);
    iso_periodic_point_on(f->line, u, z);
    const iso_wide from[2] = {f->line == LINE_QUARTER ? WIDE_PI / 2 : (iso_wide)z[0], z[1]};
    return fabs(z[1]) < 1 && iso_periodic_far(&map, &iso_return_extended, from, f->period, found);
}

static double off_of(const iso_follow_family *f, const iso_periodic_fine *at)
{
    if (f->line == LINE_X) return (double)at->to[1];
    const iso_wide l = at->to[0] - (f->line == LINE_0 ? 0 : WIDE_PI / 2);
    return (double)(l - WIDE_ROUND(l / WIDE_PI) * WIDE_PI);
}

/* The slope by v, by differences: its error is of the order of h^2. */
static bool find_by_v(const iso_follow_family *f, iso_follow_point *at)
{
    const double h = 2e-5;
    double ends[2];
    for (int i = 0; i < 2; i++) {
        iso_periodic_fine side;
        if (!far_from(f, at->u, (at->v + (2 * i - 1) * h) * f->width, &side)) return false;
        ends[i] = off_of(f, &side);
    }
    at->by_v = (ends[1] - ends[0]) / (2 * h);
    return true;
}

bool iso_follow_evaluate(const iso_follow_family *f, double u, double v, bool slopes, iso_follow_point *at)
{
    iso_periodic_fine found;
    if (!far_from(f, u, v * f->width, &found)) return false;
    const double stretch = f->line == LINE_X ? 1 : cos(u); /* of the line's coordinate by u */
    const int row = f->line == LINE_X ? 1 : 0;
    double A[2][2];
    for (int i = 0; i < 4; i++) A[i / 2][i % 2] = (double)found.slope[i / 2][i % 2];
    at->u = u, at->v = v, at->value = v * f->width;
    at->off = off_of(f, &found);
    at->by_u = A[row][1 - row] * stretch;
    at->across = A[1 - row][row];
    at->diagonal[0] = A[0][0], at->diagonal[1] = A[1][1];
    const double det = (double)found.determinant;
    at->trace = fabs(A[0][1] * A[1][0]) < fabs(A[0][0] * A[1][1]) ? 2 + 4 * A[0][1] * A[1][0] / det
                                                                  : 4 * A[0][0] * A[1][1] / det - 2;
    return !slopes || find_by_v(f, at);
}

void iso_follow_turn(iso_follow_point *at, const double like[2])
{
    const double length = hypot(at->by_u, at->by_v);
    at->tangent[0] = -at->by_v / length;
    at->tangent[1] = at->by_u / length;
    const double along = like ? at->tangent[0] * like[0] + at->tangent[1] * like[1] : at->tangent[1];
    if (along < 0) at->tangent[0] = -at->tangent[0], at->tangent[1] = -at->tangent[1];
}

/* Newton's method across the tangent of `a`; by_v is kept from the predicted point, and found again at the end. */
bool iso_follow_step(const iso_follow_family *f, const iso_follow_point *a, double ds, iso_follow_point *to,
                     int *steps)
{
    enum { MOST = 8 };
    const double *t = a->tangent;
    double u = a->u + ds * t[0], v = a->v + ds * t[1];
    bool there = false;
    for (*steps = 0; *steps < MOST && !there; ++*steps) {
        if (!iso_follow_evaluate(f, u, v, *steps == 0, to)) return false;
        const double det = to->by_u * t[1] - to->by_v * t[0];
        const double du = -to->off * t[1] / det, dv = to->off * t[0] / det, length = hypot(du, dv);
        if (!(length < 2 * fabs(ds) + 1e-9)) return false;
        there = length < 1e-12;
        u += du, v += dv;
    }
    if (!there || !find_by_v(f, to)) return false;
    iso_follow_turn(to, t);
    return to->tangent[0] * t[0] + to->tangent[1] * t[1] > 0.9;
}

iso_branch_point iso_follow_tell(const iso_follow_family *f, const iso_follow_point *at, double arc)
{
    double z[2];
    iso_periodic_point_on(f->line, at->u, z);
    return (iso_branch_point){at->value, z[0], z[1], at->trace, arc};
}
