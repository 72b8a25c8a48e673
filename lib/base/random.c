/* random.c - random numbers and directions, by GSL (random.h). */
#include "base/random_impl.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <stdlib.h>

struct iso_random {
    gsl_rng *rng;
};

iso_random *iso_random_create(unsigned long seed)
{
    iso_random *r = malloc(sizeof *r);
    if (!r) return NULL;
    r->rng = gsl_rng_alloc(gsl_rng_mt19937);
    if (!r->rng) return free(r), NULL;
    gsl_rng_set(r->rng, seed);
    return r;
}

void iso_random_free(iso_random *r)
{
    if (!r) return;
    gsl_rng_free(r->rng);
    free(r);
}

double iso_random_uniform(iso_random *r, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(r->rng);
}

double iso_random_normal(iso_random *r)
{
    return gsl_ran_ugaussian(r->rng);
}

void iso_random_direction(iso_random *r, double unit[3])
{
    gsl_ran_dir_3d(r->rng, &unit[0], &unit[1], &unit[2]);
}
