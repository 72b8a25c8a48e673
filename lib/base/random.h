/* random.h - reproducible random numbers (GSL's mt19937) for sampling states. */
#ifndef ISO_BASE_RANDOM_H
#define ISO_BASE_RANDOM_H

typedef struct iso_random iso_random;

/* A generator with its own state; the same seed gives the same numbers. NULL when there is no memory. */
iso_random *iso_random_create(unsigned long seed);
void iso_random_free(iso_random *r);

#endif
