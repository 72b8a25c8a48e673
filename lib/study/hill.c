/* hill.c - the rotations about the principal axes: Hill's equation over half a turn, in 64 and in 113 bits. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdbool.h>

#include "base/pi_impl.h"
#include "study/hill_wide_impl.h"
#include "study/periodic.h"

#define PART 0.3

#define HILL(name) hill_##name
#define NUMBER long double
#define COS cosl
#define SIN sinl
#define PI ISO_PI_LONG
#define TERMS 40 /* 0.3^40 = 1e-21 */
#include "study/hill_impl.h"
#undef HILL
#undef NUMBER
#undef COS
#undef SIN
#undef PI
#undef TERMS

#define HILL(name) hill_wide_##name
#define NUMBER iso_wide
#define COS WIDE_COS
#define SIN WIDE_SIN
#define PI WIDE_PI
#define TERMS 70 /* 0.3^70 = 3e-37 */
#include "study/hill_impl.h"

void iso_hill_matrix_wide(double k, const double J[3], int axis, iso_wide y[2][2])
{
    hill_wide_turn(k, J[axis], J[(axis + 1) % 3], J[(axis + 2) % 3], y);
}

/* The determinant, which is 1, tells how many digits are lost. */
double iso_hill_trace(double k, const double J[3], int axis, double *error)
{
    long double y[2][2];
    if (error) *error = NAN;
    if (!(fabs(k) >= 1e-4) || !(fmin(fmin(J[0], J[1]), J[2]) > 0) || !isfinite(k * J[0] * J[1] * J[2])) return NAN;
    hill_turn(k, J[axis], J[(axis + 1) % 3], J[(axis + 2) % 3], y);
    const long double size = fabsl(y[0][0] * y[1][1]) + fabsl(y[0][1] * y[1][0]);
    const long double trace = y[0][0] + y[1][1];
    const double off = (double)fabsl(y[0][0] * y[1][1] - y[0][1] * y[1][0] - 1);
    if (error)
        *error = 1e-16 * fabs((double)trace) + 1e-17 * sqrt((double)size) + 4 * off * (1 + fabs((double)trace));
    return (double)trace;
}
