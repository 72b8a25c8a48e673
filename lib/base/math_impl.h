/* math_impl.h - pi, sums and averages of doubles. */
#ifndef ISO_BASE_MATH_IMPL_H
#define ISO_BASE_MATH_IMPL_H

#include <math.h>
#include <stdbool.h>

#define ISO_PI_LONG 3.141592653589793238462643383279502884L
#define ISO_PI ((double)ISO_PI_LONG)

/* The rounded sum of a and b. *lost is what the rounding took: a + b is exactly the sum plus *lost
 * (Knuth's two-sum). */
static inline double iso_two_sum(double a, double b, double *lost)
{
    const double sum = a + b, part = sum - a;
    *lost = (a - (sum - part)) + (b - part);
    return sum;
}

/* Whether numbers are finite, without a branch for each. */
static inline bool all_finite(const double x[], int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) sum += x[i] * 0; /* 0, or NaN */
    return sum == 0;
}

/* The weight of averages along an orbit: exp(-1/(u (1 - u))), 1 at its top; 0 outside of (0, 1). On a quasi-periodic
 * orbit their error is smaller than any power of 1/n (S. Das, Y. Saiki, E. Sander, J. A. Yorke, Nonlinearity 30,
 * 2017). */
static inline double iso_smooth_weight(double u)
{
    return u > 0 && u < 1 ? exp(4 - 1 / (u * (1 - u))) : 0;
}

#endif
