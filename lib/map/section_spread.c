/* section_spread.c - the section's area, and points spread evenly over it.
 *
 * Both need the integral of G(l) over a quarter of the turn, 0 < l < pi/2; the others are its mirror images. With
 * tan l = e^u it is
 *
 *     integral of G sin l cos l du,    sin^2 l = 1/(1 + e^(-2u)),  cos^2 l = 1/(1 + e^(2u)).
 *
 * All singularities in the complex plane of u are at a distance of pi/2 from the real line, for every ratio of the
 * moments: steps of 1/2 with Gauss's rule of 8 points are exact to rounding. The range |u| <= 46 leaves out 1e-20.
 */
#include <math.h>

#include "base/pi_impl.h"
#include "map/section.h"

#define STEP 0.5
#define FIRST (-ISO_SPREAD_STEPS * STEP / 2)

/* G dl/du in the unit sqrt(2 eps) largest^exponent */
static double density(const iso_section_spread *s, double u)
{
    const double cos2 = 1 / (1 + exp(2 * u)), sin2 = 1 / (1 + exp(-2 * u));
    return pow((s->Jb * cos2 + s->Jc * sin2) / s->largest, s->exponent) * sqrt(cos2 * sin2);
}

static double integral(const iso_section_spread *s, double from, double to)
{
    static const double node[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static const double weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const double middle = (from + to) / 2, half = (to - from) / 2;
    double sum = 0;
    for (int i = 0; i < 4; i++)
        sum += weight[i] * (density(s, middle - half * node[i]) + density(s, middle + half * node[i]));
    return half * sum;
}

/* splitmix64: neighbouring seeds give unrelated shifts */
static uint64_t scatter(uint64_t z)
{
    z += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

void iso_section_spread_prepare(iso_section_spread *s, const iso_params *p, int axis, uint64_t seed)
{
    s->exponent = -1 / (2 * p->k);
    s->Jb = p->J[(axis + 1) % 3];
    s->Jc = p->J[(axis + 2) % 3];
    s->largest = p->k > 0 ? fmin(s->Jb, s->Jc) : fmax(s->Jb, s->Jc);
    s->part[0] = 0;
    for (int i = 0; i < ISO_SPREAD_STEPS; i++)
        s->part[i + 1] = s->part[i] + integral(s, FIRST + STEP * i, FIRST + STEP * (i + 1));
    s->shift[0] = scatter(seed);
    s->shift[1] = scatter(s->shift[0]);
}

double iso_section_area(const iso_params *p, double eps, int axis)
{
    iso_section_spread s;
    iso_section_spread_prepare(&s, p, axis, 0);
    return 8 * sqrt(2 * eps) * pow(s.largest, s.exponent) * s.part[ISO_SPREAD_STEPS];
}

/* u up to which the integral is `part`: Newton's steps, inside a bracket that only shrinks */
static double invert(const iso_section_spread *s, double part)
{
    int low = 0, high = ISO_SPREAD_STEPS;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (s->part[middle] <= part)
            low = middle;
        else
            high = middle;
    }
    const double start = FIRST + STEP * low, wanted = part - s->part[low];
    double left = start, right = start + STEP, u = start + STEP / 2;
    for (int i = 0; i < 60; i++) {
        const double error = integral(s, start, u) - wanted;
        if (error > 0)
            right = u;
        else
            left = u;
        const double next = u - error / density(s, u), moved = next - u;
        u = next > left && next < right ? next : (left + right) / 2;
        if (fabs(moved) < 1e-15 * (1 + fabs(u))) break;
    }
    return u;
}

/* l in (0, pi/2) with the part f in (0, 1) of the quarter's integral below it */
static double quarter(const iso_section_spread *s, double f)
{
    return atan(exp(invert(s, f * s->part[ISO_SPREAD_STEPS])));
}

/* 2^64/r and 2^64/r^2, r^3 = r + 1, to the nearest integer */
#define R2_FIRST 0xc13fa9a902a6328f
#define R2_SECOND 0x91e10da5c79e7b1d

/* The middle of one of 2^52 equal parts of (0, 1): neither end is ever met, nor x = +-1. */
static double fraction(uint64_t number)
{
    return ((double)(number >> 12) + 0.5) * 0x1p-52;
}

void iso_section_spread_point(const iso_section_spread *s, uint64_t i, double *l, double *x)
{
    const double around = 4 * fraction(s->shift[0] + i * R2_FIRST), f = around - floor(around);
    switch ((int)around) {
    case 0: *l = quarter(s, f); break;
    case 1: *l = ISO_PI - quarter(s, 1 - f); break;
    case 2: *l = quarter(s, f) - ISO_PI; break;
    default: *l = -quarter(s, 1 - f); break;
    }
    *x = 2 * fraction(s->shift[1] + i * R2_SECOND) - 1;
}
