/* low_discrepancy_impl.h - points that fill (0, 1) evenly, and numbers that look random. */
#ifndef ISO_BASE_LOW_DISCREPANCY_IMPL_H
#define ISO_BASE_LOW_DISCREPANCY_IMPL_H

#include <stdint.h>

/* Point i of an additive recurrence modulo 1. It is the middle of one of 2^52 equal parts of (0, 1), so it is never 0
 * or 1. `shift` and `step` are in units of 2^-64. */
static inline double iso_recurrence(uint64_t shift, uint64_t step, uint64_t i)
{
    return ((double)((shift + i * step) >> 12) + 0.5) * 0x1p-52;
}

/* splitmix64: neighbouring numbers give unrelated ones. */
static inline uint64_t iso_scatter(uint64_t z)
{
    z += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

#endif
