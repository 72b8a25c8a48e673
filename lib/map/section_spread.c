/* section_spread.c - the section's area, and points spread evenly over it. Both need the integral of G(l). */
#include <math.h>

#include "base/low_discrepancy_impl.h"
#include "base/pi_impl.h"
#include "map/quarter_impl.h"
#include "map/section_impl.h"

_Static_assert((int)ISO_SPREAD_STEPS == (int)ISO_QUARTER_STEPS, "iso_section_spread holds a table of a quarter");

/* Where only arcs of the circle are open, the angle is not l, but a with sin l = sqrt(reach) sin a, l counted from
 * the middle of an arc. At its border, a = pi/2, G goes to 0 like cos a, and the integral of G stays smooth. */
static double cos2_of_l(const iso_section_spread *s, double sin2, double cos2)
{
    return s->reach == 1 ? cos2 : 1 - s->reach * sin2;
}

/* G dl/du, where dl/da = sqrt(reach) cos a/cos l and da/du = sin a cos a */
static void density(const void *data, double sin2, double cos2, double value[2])
{
    const iso_section_spread *s = data;
    const double C2 = cos2_of_l(s, sin2, cos2), q = (s->J[0] * C2 + s->J[1] * (s->reach * sin2)) / s->largest;
    value[0] = iso_section_momentum_at(s->k, s->eps, s->energy, q) * sqrt(cos2 * sin2);
    if (s->reach < 1) value[0] *= sqrt(s->reach * cos2 / C2);
    value[1] = 0;
}

/* Where arcs begin: in the middle, l = 0 or pi/2, is the side that is open; up to sin^2 = reach from there. */
static void find_arcs(iso_section_spread *s, iso_point_motion m, int axis)
{
    const double Jb = m.p->J[(axis + 1) % 3], Jc = m.p->J[(axis + 2) % 3];
    const bool at_0 = iso_section_is_open(m, axis, 0), at_quarter = iso_section_is_open(m, axis, ISO_PI / 2);
    const bool turned = at_quarter && !at_0;
    s->J[0] = turned ? Jc : Jb;
    s->J[1] = turned ? Jb : Jc;
    s->middle = turned ? ISO_PI / 2 : 0;
    s->reach = 1;
    if (at_0 == at_quarter) return;
    const double border = pow(-m.energy / m.eps, -m.p->k);
    s->reach = fmin(fmax((border - s->J[0]) / (s->J[1] - s->J[0]), 0), 1);
}

void iso_section_spread_prepare(iso_section_spread *s, iso_point_motion m, int axis, uint64_t seed)
{
    double nothing[ISO_QUARTER_STEPS + 1], *part[2] = {s->part, nothing};
    find_arcs(s, m, axis);
    s->k = m.p->k;
    s->largest = s->k > 0 ? fmin(s->J[0], s->J[1]) : fmax(s->J[0], s->J[1]);
    s->energy = m.energy;
    s->eps = m.energy == 0 ? 0.5 : m.eps * pow(s->largest, -1 / s->k); /* on H = 0 for every eps */
    iso_quarter_tabulate(density, s, part);
    s->shift[0] = iso_scatter(seed);
    s->shift[1] = iso_scatter(s->shift[0]);
}

/* 2^64/r and 2^64/r^2, r^3 = r + 1, to the nearest integer */
static const uint64_t r2[2] = {0xc13fa9a902a6328f, 0x91e10da5c79e7b1d};

void iso_section_spread_point(const iso_section_spread *s, uint64_t i, double *l, double *x)
{
    const iso_quarter quarter = {density, s, {s->part, s->part}, 0};
    *l = iso_quarter_angle(&quarter, iso_recurrence(s->shift[0], r2[0], i));
    if (s->reach < 1) {
        const double sine = sqrt(s->reach) * sin(*l);
        *l = atan2(sine, copysign(sqrt((1 - sine) * (1 + sine)), cos(*l)));
    }
    if (s->middle != 0) *l = remainder(*l + s->middle, 2 * ISO_PI);
    *x = 2 * iso_recurrence(s->shift[1], r2[1], i) - 1;
}
