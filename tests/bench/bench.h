/* bench.h - what the benchmark programs share. */
#ifndef ISO_TESTS_BENCH_H
#define ISO_TESTS_BENCH_H

#include <stdlib.h>
#include <time.h>

#include "base/seconds_impl.h"

/* The processor time this process has taken so far. */
static inline double bench_milliseconds(void)
{
    return 1e3 * processor_seconds();
}

/* The time on the wall, from some beginning. */
static inline double bench_wall_milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static inline int bench_ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Smallest first. */
static inline void bench_sort(double x[], size_t count)
{
    qsort(x, count, sizeof *x, bench_ascending);
}

#endif
