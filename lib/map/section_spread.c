/* section_spread.c - the section's area, and points spread evenly over it. Both need the integral of G(l). */
#include <math.h>

#include "map/quarter_impl.h"
#include "map/section.h"

_Static_assert((int)ISO_SPREAD_STEPS == (int)ISO_QUARTER_STEPS, "iso_section_spread holds a table of a quarter");

/* G sin l cos l = G dl/du, as a multiple of sqrt(2 eps) largest^exponent */
static void density(const void *data, double sin2, double cos2, double value[2])
{
    const iso_section_spread *s = data;
    value[0] = pow((s->Jb * cos2 + s->Jc * sin2) / s->largest, s->exponent) * sqrt(cos2 * sin2);
    value[1] = 0;
}

void iso_section_spread_prepare(iso_section_spread *s, const iso_params *p, int axis, uint64_t seed)
{
    double nothing[ISO_QUARTER_STEPS + 1], *part[2] = {s->part, nothing};
    s->exponent = -1 / (2 * p->k);
    s->Jb = p->J[(axis + 1) % 3];
    s->Jc = p->J[(axis + 2) % 3];
    s->largest = p->k > 0 ? fmin(s->Jb, s->Jc) : fmax(s->Jb, s->Jc);
    iso_quarter_tabulate(density, s, part);
    s->shift[0] = iso_scatter(seed);
    s->shift[1] = iso_scatter(s->shift[0]);
}

double iso_section_area(const iso_params *p, double eps, int axis)
{
    iso_section_spread s;
    iso_section_spread_prepare(&s, p, axis, 0);
    return 8 * sqrt(2 * eps) * pow(s.largest, s.exponent) * s.part[ISO_SPREAD_STEPS];
}

/* 2^64/r and 2^64/r^2, r^3 = r + 1, to the nearest integer */
static const uint64_t r2[2] = {0xc13fa9a902a6328f, 0x91e10da5c79e7b1d};

void iso_section_spread_point(const iso_section_spread *s, uint64_t i, double *l, double *x)
{
    const iso_quarter quarter = {density, s, {s->part, s->part}, 0};
    *l = iso_quarter_angle(&quarter, iso_recurrence(s->shift[0], r2[0], i));
    *x = 2 * iso_recurrence(s->shift[1], r2[1], i) - 1;
}
