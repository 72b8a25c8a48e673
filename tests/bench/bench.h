/* bench.h - what the benchmark programs share. */
#ifndef ISO_TESTS_BENCH_H
#define ISO_TESTS_BENCH_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "base/resources_impl.h"
#include "map/section.h"
#include "orbit/orbit.h"

/* Ends the program where a call fails. */
static inline void bench_must(const iso_context *ctx, iso_status status)
{
    if (status == ISO_OK) return;
    fprintf(stderr, "a benchmark stops: %s\n", iso_context_message(ctx));
    exit(1);
}

/* A rival that is wrong must not be raced. NaN is wrong. */
static inline void bench_check_rival(const char *name, double error, double bound)
{
    if (error <= bound) return;
    fprintf(stderr, "%s is wrong: error %.1e\n", name, error);
    exit(1);
}

/* --- times ------------------------------------------------------------------------------------------------------ */

/* The processor time this thread has taken so far. */
static inline double bench_milliseconds(void)
{
    return 1e3 * processor_seconds();
}

static inline double bench_clock(clockid_t which)
{
    struct timespec now;
    clock_gettime(which, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

/* That of all threads. */
static inline double bench_busy_milliseconds(void)
{
    return bench_clock(CLOCK_PROCESS_CPUTIME_ID);
}

/* The time on the wall, from some beginning. */
static inline double bench_wall_milliseconds(void)
{
    return bench_clock(CLOCK_MONOTONIC);
}

/* --- many numbers ----------------------------------------------------------------------------------------------- */

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

/* Sorts them, too. */
static inline double bench_median(double x[], size_t count)
{
    bench_sort(x, count);
    return x[count / 2];
}

/* --- balls ------------------------------------------------------------------------------------------------------ */

static const double bench_J[3] = {1.4, 2.1, 3.0}, bench_state[ISO_STATE] = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8};

static inline iso_params bench_params(iso_context *ctx, double k, const double J[3])
{
    iso_params p;
    bench_must(ctx, iso_params_reduced(ctx, k, J, &p));
    return p;
}

static inline iso_start bench_start(iso_context *ctx)
{
    iso_start start;
    bench_must(ctx, iso_start_ball(ctx, bench_state, bench_state + 3, ISO_SPIN_REMOVE, &start));
    return start;
}

/* The free point of eps = 1 at (l, x) of its section. */
static inline iso_start bench_section_start(const iso_params *p, double l, double x)
{
    iso_start start = {.model = ISO_POINT, .eps = 1};
    iso_section_point(iso_free_point(p, 1), iso_section_axis(iso_free_point(p, 1)), l, x, start.y);
    return start;
}

/* Largest error of (omega, n), in units of the length of its vector. NaN is an infinite one. */
static inline double bench_error(const double ball[], const double truth[])
{
    const double w = sqrt(truth[0] * truth[0] + truth[1] * truth[1] + truth[2] * truth[2]);
    double worst = 0;
    for (int i = 0; i < ISO_STATE; i++) {
        const double error = fabs(ball[i] - truth[i]) / (i < 3 ? w : 1);
        if (!(error <= worst)) worst = isnan(error) ? INFINITY : error;
    }
    return worst;
}

#endif
