/* share.c - which share of the section's area do orbits of some kind have? An estimate from starts, with its
 * confidence interval of 95 %.
 *
 * The starts are ISO_SHIFTS copies of the sequence of map/section.h, each with a random shift of its own. Start i is
 * the next point of copy i modulo ISO_SHIFTS. So start i does not depend on the number of starts, and the first N
 * starts are spread evenly for every N. The points of one copy depend on each other, but the copies are independent:
 * the scatter of their counts shows the error, whatever the shape of the set is.
 *
 * The interval. Let copy r have n_r points, f_r of them in the set; n and f are the sums, p = f/n. Then
 * v = R/(R - 1) sum (f_r - p n_r)^2/n^2 estimates the variance of p, and D = v n/(p (1 - p)) compares it with that of
 * n independent points. The interval is Wilson's with this D: all x with (p - x)^2 <= t^2 D x (1 - x)/n, where t is
 * Student's quantile for R - 1 degrees of freedom. In the middle it is p +- t sqrt(v). Near 0 and 1 it is lopsided as
 * it must be: a plain p +- t sqrt(v) misses small shares too often.
 *
 * If all copies agree with p, v = 0 says nothing. Suppose that a copy deviates with probability d. All R agree with
 * probability (1 - d)^R. So d may be as large as 1 - 0.025^(1/R), or agreement would have a probability below 2.5 %.
 * Each deviation is one point or so, thus p +- R d/n is stated. If all or none are in the set this is almost the
 * bound of Clopper and Pearson for independent points, 3.7/n; d R is 3.3 for R = 16.
 */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "instrument/chaos/chaos_impl.h"

void iso_share_interval(const size_t count[ISO_SHIFTS], const size_t found[ISO_SHIFTS], double *low, double *high)
{
    static const double OUTSIDE = 0.025, AGREE = 1e-9; /* AGREE: less than any scatter of whole numbers is */
    double n = 0, f = 0, square = 0;                   /* square: v n^2, 0 if all copies agree */
    int copies = 0;                                    /* those with a start */
    for (int r = 0; r < ISO_SHIFTS; r++) n += (double)count[r], f += (double)found[r], copies += count[r] > 0;
    const double p = f / n;
    for (int r = 0; r < ISO_SHIFTS && copies > 1; r++) {
        const double rest = (double)found[r] - p * (double)count[r];
        square += rest * rest;
    }
    if (copies > 1) square = square * copies / (copies - 1);
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
