/* finite_impl.h - whether numbers are finite, without a branch for each. */
#ifndef ISO_BASE_FINITE_IMPL_H
#define ISO_BASE_FINITE_IMPL_H

#include <stdbool.h>

static inline bool all_finite(const double x[], int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) sum += x[i] * 0; /* 0, or NaN */
    return sum == 0;
}

#endif
