/* sum_impl.h - a sum of doubles together with what its rounding lost. */
#ifndef ISO_BASE_SUM_IMPL_H
#define ISO_BASE_SUM_IMPL_H

/* The rounded sum of a and b. *lost is what the rounding took: a + b is exactly the sum plus *lost
 * (Knuth's two-sum). */
static inline double iso_two_sum(double a, double b, double *lost)
{
    const double sum = a + b, part = sum - a;
    *lost = (a - (sum - part)) + (b - part);
    return sum;
}

#endif
