/* random_impl.h - random numbers, for samples of states. */
#ifndef ISO_BASE_RANDOM_IMPL_H
#define ISO_BASE_RANDOM_IMPL_H

#include "base/random.h"

/* Uniform in [low, high). */
double iso_random_uniform(iso_random *r, double low, double high);

/* Standard normal. */
double iso_random_normal(iso_random *r);

/* Uniform on the unit sphere. */
void iso_random_direction(iso_random *r, double unit[3]);

#endif
