/* bench.h - what the benchmark programs share. */
#ifndef ISO_TESTS_BENCH_H
#define ISO_TESTS_BENCH_H

#include <time.h>

/* The processor time this process has taken so far. */
static inline double bench_milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

/* The time on the wall, from some beginning. */
static inline double bench_wall_milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

#endif
