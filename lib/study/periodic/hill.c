/* hill.c - the rotations about the principal axes: Hill's equation over half a turn, in 64 and in 113 bits. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <complex.h>
#include <math.h>
#include <stdbool.h>

#include "base/pi_impl.h"
#include "study/periodic/hill_trace_impl.h"
#include "study/periodic/periodic_impl.h"

/* --- the length of a step --------------------------------------------------------------------------------------- */

#define PART 0.3
enum { MOST_POINTS = 256 };

/* Singular points phi = at +- i height, and how fast y changes at most. */
typedef struct hill_pace {
    int points;
    double at[MOST_POINTS], height[MOST_POINTS], pace;
} hill_pace;

static void add_point(hill_pace *s, double at, double height)
{
    if (s->points == MOST_POINTS) return;
    s->at[s->points] = at;
    s->height[s->points++] = height;
}

/* Where 1 + E q^(1/k) = 0: ln q = -k ln |E| + i k pi n, n odd for E > 0 and even for E < 0. Where q goes round its
 * zero farther than arg = 3 pi/2 no disc of convergence comes. */
static void add_level(double k, double energy, double m, double d, hill_pace *s)
{
    for (int n = energy > 0 ? 1 : 0; fabs(k) * n <= 1.5 && energy != 0; n += 2) {
        const double complex q = cexp(-k * log(fabs(energy)) + I * k * ISO_PI * n), phi = cacos((q - m) / d) / 2;
        add_point(s, creal(phi), fabs(cimag(phi)));
        if (n > 0 || fabs(creal(phi)) > 0) add_point(s, ISO_PI - creal(phi), fabs(cimag(phi)));
    }
}

static double level_at(double k, double energy, double q)
{
    return 1 + energy * pow(q, 1 / k);
}

/* q = m + d cos 2 phi. ratio: m/|d|; swing: J_i/(k min q). */
static hill_pace pace_of(double k, double m, double d, double energy, double ratio, double swing)
{
    hill_pace s = {.points = 0};
    add_point(&s, d > 0 ? ISO_PI / 2 : 0, d == 0 ? 1e3 : acosh(ratio) / 2);
    if (d != 0) add_level(k, energy, m, d, &s);
    const double least = fmin(level_at(k, energy, m + d), level_at(k, energy, m - d));
    s.pace = sqrt(fabs(swing) / fmin(least, 1) + 1);
    return s;
}

static double step_from(const hill_pace *s, double phi)
{
    double h = 1 / (1 + s->pace);
    for (int i = 0; i < s->points; i++) {
        const double apart = fmin(fabs(phi - s->at[i]), fabs(phi - ISO_PI - s->at[i]));
        h = fmin(h, PART * hypot(apart, s->height[i]));
    }
    return h;
}

/* --- the matrix ------------------------------------------------------------------------------------------------- */

#define HILL(name) hill_##name
#define NUMBER long double
#define COS cosl
#define SIN sinl
#define POW powl
#define PI ISO_PI_LONG
#define TERMS 40 /* 0.3^40 = 1e-21 */
#include "study/periodic/hill_impl.h"
#undef HILL
#undef NUMBER
#undef COS
#undef SIN
#undef POW
#undef PI
#undef TERMS

#define HILL(name) hill_wide_##name
#define NUMBER iso_wide
#define COS WIDE_COS
#define SIN WIDE_SIN
#define POW WIDE_POW
#define PI WIDE_PI
#define TERMS 70 /* 0.3^70 = 3e-37 */
#include "study/periodic/hill_impl.h"

void iso_hill_matrix_wide(double k, const double J[3], double energy, int axis, iso_wide y[2][2])
{
    hill_wide_turn(k, J[axis], J[(axis + 1) % 3], J[(axis + 2) % 3], energy, y);
}

bool iso_hill_has_rotation(double k, const double J[3], double energy, int axis)
{
    return level_at(k, energy, J[(axis + 1) % 3]) > 0 && level_at(k, energy, J[(axis + 2) % 3]) > 0;
}

/* The determinant, which is 1, tells how many digits are lost. */
double iso_hill_trace(double k, const double J[3], double energy, int axis, double *error)
{
    long double y[2][2];
    if (error) *error = NAN;
    if (!(fabs(k) >= 1e-4) || !(fmin(fmin(J[0], J[1]), J[2]) > 0) || !isfinite(k * J[0] * J[1] * J[2])) return NAN;
    if (!isfinite(energy) || !iso_hill_has_rotation(k, J, energy, axis)) return NAN;
    hill_turn(k, J[axis], J[(axis + 1) % 3], J[(axis + 2) % 3], energy, y);
    const long double size = fabsl(y[0][0] * y[1][1]) + fabsl(y[0][1] * y[1][0]);
    const long double trace = y[0][0] + y[1][1];
    const double off = (double)fabsl(y[0][0] * y[1][1] - y[0][1] * y[1][0] - 1);
    if (error)
        *error = 1e-16 * fabs((double)trace) + 1e-17 * sqrt((double)size) + 4 * off * (1 + fabs((double)trace));
    return (double)trace;
}
