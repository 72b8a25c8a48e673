/* series_impl.h - even functions of an angle as cosine series. */
#ifndef ISO_EXACT_SERIES_IMPL_H
#define ISO_EXACT_SERIES_IMPL_H

#include <math.h>

#include "exact/elliptic_impl.h"

/* From f(pi j/N), j = 0 ... N, to the a_n of f(x) = sum_n a_n cos n x, n = 0 ... N, N a power of 2; f[j] at x[j stride].
 * `work` has room for 2 N numbers. */
void iso_cosine_series(double x[], int N, int stride, double work[]);

/* sum_n b_n sin n x, n = 1 ... modes, by Clenshaw's rule; at b[n]. */
static inline double sine_series(const double b[], int modes, double x)
{
    const double twice = 2 * cos(x);
    double p = 0, p1 = 0;
    for (int n = modes; n >= 1; n--) {
        const double r = b[n] + twice * p - p1;
        p1 = p, p = r;
    }
    return p * sin(x);
}

#endif
