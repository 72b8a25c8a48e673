/* analogue_units.c - round mass, radius and time for the ball of a problem.
 *
 * A problem of a point fixes the ball's J up to a scale s (analogue.h). The angular velocity goes as
 * s^((1/k - 4)/2). With D = m B^2 in the middle of its range, s is 2 D/(J1 + J2 - J3). So there is one D for which
 * the angular velocity is 1. Mass and radius are round numbers with a product m B^2 near this D.
 */
#include <math.h>
#include <stdio.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "study/study_impl.h"

/* The n-th of the numbers ..., 0.5, 1, 2, 5, 10, ...: 1 is the 0th. */
static double round_number(int n)
{
    static const int digit[] = {1, 2, 5};
    char text[ISO_NUMBER_SIZE];
    const int place = ((n % 3) + 3) % 3;
    double x = NAN;
    const int length = snprintf(text, sizeof text, "%de%d", digit[place], (n - place) / 3);
    return iso_number_read(text, (size_t)length, &x) ? x : NAN;
}

/* Which of them is nearest to x > 0, by ratio. */
static int nearest_round(double x)
{
    x = fmin(fmax(x, 1e-100), 1e100);
    int n = 3 * (int)floor(log10(x));
    while (x * x > round_number(n) * round_number(n + 1)) n++;
    return n;
}

double iso_analogue_round_up(double x)
{
    ISO_DEFAULT_ARITHMETIC;
    if (!(x > 1e-300 && x < 1e300)) return x;
    int n = 3 * (int)floor(log10(x)) - 1;
    while (round_number(n) < x) n++;
    return round_number(n);
}

/* The ball's angular velocity at the point's start. */
static double angular_velocity(const iso_analogue *a, const double start[ISO_STATE])
{
    double ball[ISO_STATE];
    iso_point_to_ball(&a->reduced.params, start, ball);
    return norm(ball);
}

/* The D = m B^2 for which the angular velocity of the body is 1. For k near 1/4 it hardly depends on D: then, and
 * where the ball is at rest, D is 1. */
static double best_D(const iso_analogue *a, const double start[ISO_STATE])
{
    const double power = (1 / a->reduced.params.k - 4) / 2, w = angular_velocity(a, start);
    const double D = a->room / 2 * pow(w, -1 / power);
    if (!(w > 0) || !isfinite(w) || !(fabs(power) > 0.25)) return 1;
    return fmin(fmax(D, 1e-9), 1e9);
}

/* The round mass and radius whose m B^2 is nearest to D. The radius is one of three near the cube root of D. */
static void choose_both(double D, double *mass, double *radius)
{
    const int middle = nearest_round(cbrt(D));
    double best = INFINITY;
    for (int n = middle - 1; n <= middle + 1; n++) {
        const double B = round_number(n), m = round_number(nearest_round(D / (B * B)));
        const double off = fabs(log(m * B * B / D));
        if (off < best) best = off, *mass = m, *radius = B;
    }
}

void iso_analogue_choose_units(const iso_analogue *a, const double start[ISO_STATE], double *mass, double *radius)
{
    if (!isnan(*mass) && !isnan(*radius)) return;
    const double D = best_D(a, start);
    if (isnan(*mass) && isnan(*radius))
        choose_both(D, mass, radius);
    else if (isnan(*mass))
        *mass = round_number(nearest_round(D / *radius / *radius));
    else
        *radius = round_number(nearest_round(sqrt(D / *mass)));
}
