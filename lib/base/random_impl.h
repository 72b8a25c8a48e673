/* random_impl.h - random numbers, points that fill (0, 1) evenly, and numbers that look random. */
#ifndef ISO_BASE_RANDOM_IMPL_H
#define ISO_BASE_RANDOM_IMPL_H

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <stdint.h>

/* A generator with its own state (GSL's mt19937); the same seed gives the same numbers. */
typedef gsl_rng iso_random;

/* NULL when there is no memory. */
static inline iso_random *iso_random_create(unsigned long seed)
{
    iso_random *r = gsl_rng_alloc(gsl_rng_mt19937);
    if (r) gsl_rng_set(r, seed);
    return r;
}

static inline void iso_random_free(iso_random *r)
{
    gsl_rng_free(r);
}

/* Uniform in [low, high). */
static inline double iso_random_uniform(iso_random *r, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(r);
}

/* Standard normal. */
static inline double iso_random_normal(iso_random *r)
{
    return gsl_ran_ugaussian(r);
}

/* Uniform on the unit sphere. */
static inline void iso_random_direction(iso_random *r, double unit[3])
{
    gsl_ran_dir_3d(r, &unit[0], &unit[1], &unit[2]);
}

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
