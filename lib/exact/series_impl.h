/* series_impl.h - even functions of an angle as cosine series, and sums of series. */
#ifndef ISO_EXACT_SERIES_IMPL_H
#define ISO_EXACT_SERIES_IMPL_H

#include <gsl/gsl_fft_real.h>
#include <math.h>

/* From f(pi j/N), j = 0 ... N, to the a_n of f(x) = sum_n a_n cos n x, n = 0 ... N, N a power of 2; both at
 * x[j stride]. `work` has room for 2 N numbers. */
static inline void cosine_series(double x[], int N, int stride, double work[])
{
    for (int j = 0; j <= N; j++) work[j] = work[(2 * N - j) % (2 * N)] = x[j * stride];
    gsl_fft_real_radix2_transform(work, 1, 2 * (size_t)N);
    for (int n = 0; n <= N; n++) x[n * stride] = work[n] / (n % N == 0 ? 2 * N : N);
}

/* The largest size of a[from] ... a[to]; NaN if one of them is NaN */
static inline double largest_of(const double a[], int from, int to)
{
    double most = 0;
    for (int n = from; n <= to; n++)
        if (!(fabs(a[n]) <= most)) most = fabs(a[n]);
    return most;
}

enum { ABREAST = 4 }; /* so many steps of a recurrence are taken side by side: they do not wait for each other */

/* cos (first + n step) and sin (first + n step) for n < last, and up to ABREAST more. */
static inline void set_multiples(double first, double step, int last, double cosine[], double sine[])
{
    const double c = cos(step), s = sin(step);
    cosine[0] = cos(first), sine[0] = sin(first);
    for (int n = 1; n < ABREAST; n++) {
        cosine[n] = cosine[n - 1] * c - sine[n - 1] * s;
        sine[n] = sine[n - 1] * c + cosine[n - 1] * s;
    }
    const double c2 = c * c - s * s, s2 = 2 * s * c, cs = c2 * c2 - s2 * s2, ss = 2 * s2 * c2;
    for (int n = ABREAST; n < last; n += ABREAST)
        for (int i = 0; i < ABREAST; i++) {
            cosine[n + i] = cosine[n + i - ABREAST] * cs - sine[n + i - ABREAST] * ss;
            sine[n + i] = sine[n + i - ABREAST] * cs + cosine[n + i - ABREAST] * ss;
        }
}

/* sum_n b_n sin n x, n = 1 ... modes, and its slope (may be NULL), by Clenshaw's rule for both parts of exp(i n x);
 * at b[n]. */
static inline double sine_series(const double b[], int modes, double x, double *slope)
{
    const double c = cos(x), twice = 2 * c;
    double p = 0, p1 = 0, q = 0, q1 = 0;
    for (int n = modes; n >= 1; n--) {
        const double v = b[n] + twice * p - p1;
        p1 = p, p = v;
        if (!slope) continue;
        const double w = n * b[n] + twice * q - q1;
        q1 = q, q = w;
    }
    if (slope) *slope = q * c - q1;
    return p * sin(x);
}

#endif
