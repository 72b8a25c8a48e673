/* The recurrences of exp, log, sin and cos (series/evaluate_impl.h) against slow sums of powers of series, with
 * deviations: f(a + i x da) for a tiny x has the deviation of f(a) as its imaginary part. Two lanes, each its own. */
#include <complex.h>
#undef I
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>

#include "base/random_impl.h"

#include "model/series/double_impl.h"

#define LANES 2
#define CHANNELS 2
enum { KEPT = 24 };

#include "model/formula/formula_lines_impl.h"
#include "model/series/evaluate_impl.h"

enum { NUMBERS = CHANNELS * KEPT };

static real scalar[ISO_FORMULA_SCALARS * NUMBERS], no_constants[ISO_FORMULA_CONSTANTS];
static vector no_vectors[ISO_FORMULA_VECTORS * NUMBERS];
/* n b_n of the base b, which only its powers read. The formula below has none, but gcc 14 cannot know that: where this
 * was NULL, it warned of reading it. */
static real no_slopes[NUMBERS];

static const double tiny = 1e-30;

/* f = sum_m slope[m]/m! (a - a0)^m, to order KEPT - 1 */
static void compose(const double complex slope[KEPT], const double complex a[KEPT], double complex f[KEPT])
{
    double complex power[KEPT] = {1}, next[KEPT];
    double factorial = 1;
    for (int i = 0; i < KEPT; i++) f[i] = 0;
    for (int m = 0; m < KEPT; m++) {
        factorial *= m > 0 ? m : 1;
        for (int i = 0; i < KEPT; i++) f[i] += slope[m] / factorial * power[i];
        for (int i = 0; i < KEPT; i++) {
            next[i] = 0;
            for (int j = 1; j <= i; j++) next[i] += a[j] * power[i - j];
        }
        for (int i = 0; i < KEPT; i++) power[i] = next[i];
    }
}

/* The derivatives of the function at a0. */
static void slopes_of(iso_operation operation, double complex a0, double complex slope[KEPT])
{
    const double complex circle[] = {csin(a0), ccos(a0), -csin(a0), -ccos(a0)};
    double complex power = 1 / a0; /* of log: (-1)^(m-1) (m-1)!/a0^m */
    for (int m = 0; m < KEPT; m++) {
        slope[m] = operation == ISO_S_EXP   ? cexp(a0)
                   : operation == ISO_S_SIN ? circle[m % 4]
                   : operation == ISO_S_COS ? circle[(m + 1) % 4]
                   : m == 0                 ? clog(a0)
                                            : power;
        if (m > 0) power *= -m / a0;
    }
}

/* The formula: scalar 2 is exp a, 3 log a, 4 sin a, 5 cos a, of the given scalar BASE. */
static const iso_operation operations[] = {ISO_S_EXP, ISO_S_LOG, ISO_S_SIN, ISO_S_COS};

static iso_formula write_formula(void)
{
    iso_formula F;
    iso_formula_begin(&F, ISO_FORMULA_MOTION, true);
    iso_formula_scalar(&F, ISO_S_EXP, ISO_GIVEN_BASE, 0);
    iso_formula_scalar(&F, ISO_S_LOG, ISO_GIVEN_BASE, 0);
    iso_formula_sine(&F, ISO_GIVEN_BASE);
    return F;
}

static double compare(const real *found, const double complex f[KEPT], int lane)
{
    double worst = 0;
    for (int i = 0; i < KEPT; i++) {
        const double size = 1 + cabs(f[i]);
        worst = fmax(worst, fabs(LANE(found[i], lane) - creal(f[i])) / size);
        worst = fmax(worst, fabs(LANE(found[KEPT + i], lane) - cimag(f[i]) / tiny) / size);
    }
    return worst;
}

int main(void)
{
    iso_random *r = iso_random_create(34);
    const iso_formula F = write_formula();
    real count[KEPT], inverse[KEPT];
    double worst[4] = {0};
    for (int i = 0; i < KEPT; i++) count[i] = broadcast(i), inverse[i] = broadcast(i > 0 ? 1.0 / i : 0);
    const nodes t = {.kept = NUMBERS,
                     .c = no_constants,
                     .scalar = scalar,
                     .vector = no_vectors,
                     .slope = no_slopes,
                     .count = count,
                     .inverse = inverse};
    for (int turn = 0; turn < 50; turn++) {
        double complex a[LANES][KEPT], slope[KEPT], f[KEPT];
        for (int lane = 0; lane < LANES; lane++)
            for (int i = 0; i < KEPT; i++) {
                const double value = i == 0 ? iso_random_uniform(r, 0.8, 2) : iso_random_uniform(r, -0.5, 0.5) / i;
                const double deviation = iso_random_uniform(r, -1, 1) / (1 + i);
                a[lane][i] = value + deviation * tiny * _Complex_I;
                LANE(scalar[i], lane) = value, LANE(scalar[KEPT + i], lane) = deviation;
            }
        for (int i = 0; i < KEPT; i++)
            for (int c = 0; c < CHANNELS; c++) evaluate(&F, &t, false, c, i);
        for (int lane = 0; lane < LANES; lane++)
            for (int o = 0; o < 4; o++) {
                slopes_of(operations[o], a[lane][0], slope);
                compose(slope, a[lane], f);
                worst[o] = fmax(worst[o], compare(scalar + (2 + o) * NUMBERS, f, lane));
            }
    }
    static const char *const names[] = {"exp", "log", "sin", "cos"};
    for (int o = 0; o < 4; o++)
        gsl_test(!(worst[o] <= 1e-12), "%s: series and deviations, worst %.2g", names[o], worst[o]);
    iso_random_free(r);
    exit(gsl_test_summary());
}
