/* series.c - cosine series by a fast Fourier transform. */
#include "exact/series_impl.h"

#include <gsl/gsl_fft_real.h>

void iso_cosine_series(double x[], int N, int stride, double work[])
{
    for (int j = 0; j <= N; j++) work[j] = work[(2 * N - j) % (2 * N)] = x[j * stride];
    gsl_fft_real_radix2_transform(work, 1, 2 * (size_t)N);
    for (int n = 0; n <= N; n++) x[n * stride] = work[n] / (n % N == 0 ? 2 * N : N);
}
