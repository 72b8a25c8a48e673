/* spread.c - points spread evenly over the section (section_impl.h): angles with the density G, by inversion of its
 * integral.
 *
 * The density is symmetric about 0 and pi/2. The table holds its integral over a quarter of the circle. The variable
 * is u, tan(angle) = e^u, in steps of 1/2, |u| <= 46; the rest of the integral is 1e-20. The density is made of powers
 * of A cos^2 + B sin^2 with A, B >= 0: its singularities in the complex plane of u are pi/2 or more away from the real
 * line, for every A/B. So Gauss's rule of 8 points in each step is exact to rounding.
 */
#include <math.h>

#include "base/math_impl.h"
#include "base/random_impl.h"
#include "map/section_impl.h"

#define STEP 0.5
#define FIRST (-ISO_SPREAD_STEPS * STEP / 2)

/* G dl/du at u. Where only arcs of the circle are open, the angle is not l, but a with sin l = sqrt(reach) sin a, l
 * counted from the middle of an arc: at its border, a = pi/2, G goes to 0 like cos a, and the integral of G stays
 * smooth. Then dl/da = sqrt(reach) cos a/cos l and da/du = sin a cos a. */
static double density(const iso_section_spread *s, double u)
{
    const double e = exp(2 * u), sin2 = e / (1 + e), cos2 = 1 / (1 + e);
    const double cos2_of_l = s->reach == 1 ? cos2 : 1 - s->reach * sin2;
    const double q = (s->J[0] * cos2_of_l + s->J[1] * (s->reach * sin2)) / s->largest;
    const double G = iso_section_momentum_at(s->k, s->eps, s->energy, q) * sqrt(cos2 * sin2);
    return s->reach < 1 ? G * sqrt(s->reach * cos2 / cos2_of_l) : G;
}

/* The integral from u to u + length, added to `sum`. */
static double integrate(const iso_section_spread *s, double u, double length, double sum)
{
    static const double node[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static const double weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    for (int i = 0; i < 8; i++) {
        const double at = u + length / 2 * (1 + (i < 4 ? node[i] : -node[i - 4]));
        sum += length / 2 * weight[i % 4] * density(s, at);
    }
    return sum;
}

/* The angle in (-pi, pi) below which this part of the integral over the circle lies; part is in (0, 1). By Newton's
 * method for u in a quarter, inside a bracket. Each step integrates only over its own length. */
static double angle_at(const iso_section_spread *s, double part)
{
    const int quarter = (int)(4 * part);
    const double rest = 4 * part - quarter, wanted = (quarter % 2 ? 1 - rest : rest) * s->part[ISO_SPREAD_STEPS];
    int low = 0, high = ISO_SPREAD_STEPS;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        *(s->part[middle] <= wanted ? &low : &high) = middle;
    }
    double left = FIRST + STEP * low, right = left + STEP, u = left, sum = s->part[low];
    double next = left + STEP * (wanted - s->part[low]) / (s->part[high] - s->part[low]);
    for (int i = 0; i < 60 && fabs(next - u) > 1e-14; i++) {
        sum = integrate(s, u, next - u, sum);
        u = next;
        const double error = sum - wanted;
        *(error > 0 ? &right : &left) = u;
        next = u - error / density(s, u);
        if (!(next >= left && next <= right)) next = (left + right) / 2;
    }
    const double angle = atan(exp(next)), turned[] = {angle, ISO_PI - angle, angle - ISO_PI, -angle};
    return turned[quarter];
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
    find_arcs(s, m, axis);
    s->k = m.p->k;
    s->largest = s->k > 0 ? fmin(s->J[0], s->J[1]) : fmax(s->J[0], s->J[1]);
    s->energy = m.energy;
    s->eps = m.energy == 0 ? 0.5 : m.eps * pow(s->largest, -1 / s->k); /* on H = 0 for every eps */
    s->part[0] = 0;
    for (int i = 0; i < ISO_SPREAD_STEPS; i++) s->part[i + 1] = integrate(s, FIRST + STEP * i, STEP, s->part[i]);
    s->shift[0] = iso_scatter(seed);
    s->shift[1] = iso_scatter(s->shift[0]);
    s->copies = 0;
}

/* 2^64/r and 2^64/r^2, r^3 = r + 1, to the nearest integer */
static const uint64_t r2[2] = {0xc13fa9a902a6328f, 0x91e10da5c79e7b1d};

void iso_section_spread_point(const iso_section_spread *s, uint64_t i, double *l, double *x)
{
    uint64_t shift[2] = {s->shift[0], s->shift[1]};
    if (s->copies > 0) {
        shift[0] = iso_scatter(s->shift[0] + i % s->copies);
        shift[1] = iso_scatter(shift[0]);
        i /= s->copies;
    }
    *l = angle_at(s, iso_recurrence(shift[0], r2[0], i));
    if (s->reach < 1) {
        const double sine = sqrt(s->reach) * sin(*l);
        *l = atan2(sine, copysign(sqrt((1 - sine) * (1 + sine)), cos(*l)));
    }
    if (s->middle != 0) *l = remainder(*l + s->middle, 2 * ISO_PI);
    *x = 2 * iso_recurrence(shift[1], r2[1], i) - 1;
}
