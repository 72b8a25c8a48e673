/* share_impl.h - which share of the section's area do orbits of some kind have? An estimate from starts, with its
 * confidence interval of 95 %.
 *
 * The starts are ISO_SHIFTS copies of the sequence of map/section.h, each with a random shift of its own. Start i is
 * the next point of copy i modulo ISO_SHIFTS. So start i does not depend on the number of starts, and the first N
 * starts are spread evenly for every N. The points of one copy depend on each other, but the copies are independent:
 * the scatter of their counts tells the error, whatever the shape of the set is.
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
#ifndef ISO_STUDY_SHARE_IMPL_H
#define ISO_STUDY_SHARE_IMPL_H

#include <stddef.h>
#include <stdint.h>

#include "map/section.h"

enum { ISO_SHIFTS = 16 };

/* Start i. Of `spread`, which iso_section_spread_prepare has made, only the shift is changed. */
void iso_share_start(iso_section_spread *spread, uint64_t seed, size_t i, double *l, double *x);

/* found[r] of count[r] starts of copy r are in the set. Without a start: NaN. */
void iso_share_interval(const size_t count[ISO_SHIFTS], const size_t found[ISO_SHIFTS], double *low, double *high);

#endif
