/* share.c - starts for a share of the section's area, and its confidence interval, see share_impl.h. */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "base/low_discrepancy_impl.h"
#include "study/chaos/share_impl.h"

void iso_share_start(iso_section_spread *spread, uint64_t seed, size_t i, double *l, double *x)
{
    spread->shift[0] = iso_scatter(iso_scatter(seed) + i % ISO_SHIFTS);
    spread->shift[1] = iso_scatter(spread->shift[0]);
    iso_section_spread_point(spread, i / ISO_SHIFTS, l, x);
}

/* v n^2 of share_impl.h; 0 if all copies agree. *copies: those with a start. */
static double scatter(const size_t count[], const size_t found[], double share, int *copies)
{
    double square = 0;
    *copies = 0;
    for (int r = 0; r < ISO_SHIFTS; r++) {
        const double rest = (double)found[r] - share * (double)count[r];
        *copies += count[r] > 0;
        square += rest * rest;
    }
    return *copies > 1 ? square * *copies / (*copies - 1) : 0;
}

void iso_share_interval(const size_t count[ISO_SHIFTS], const size_t found[ISO_SHIFTS], double *low, double *high)
{
    static const double OUTSIDE = 0.025, AGREE = 1e-9; /* AGREE: less than any scatter of whole numbers is */
    double n = 0, f = 0;
    int copies;
    for (int r = 0; r < ISO_SHIFTS; r++) n += (double)count[r], f += (double)found[r];
    const double p = f / n, square = scatter(count, found, p, &copies);
    double middle = p, half;
    if (square > AGREE) {
        const double t = gsl_cdf_tdist_Qinv(OUTSIDE, copies - 1), q = t * t * square / (n * n * p * (1 - p));
        middle = (p + q / 2) / (1 + q);
        half = sqrt(q * p * (1 - p) + q * q / 4) / (1 + q);
    } else {
        half = copies * (1 - pow(OUTSIDE, 1. / copies)) / n;
    }
    *low = n > 0 ? fmax(0, middle - half) : (double)NAN;
    *high = n > 0 ? fmin(1, middle + half) : (double)NAN;
}
