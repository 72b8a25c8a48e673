/* crossed.h - the first crossings of orbits, where none may fail. */
#ifndef ISO_TESTS_CROSSED_H
#define ISO_TESTS_CROSSED_H

#include "laws.h"
#include "orbit/crossings.h"

/* `each` crossings of every orbit, and samples (NULL: none). False, which fails the test: not all were found. */
static inline bool crossed_all(iso_context *ctx, const iso_batch_orbit orbits[], size_t count,
                               const iso_crossings_options *o, size_t each, iso_crossing at[], iso_sample samples[])
{
    iso_crossings *c;
    size_t *done = calloc(count, sizeof *done);
    iso_status *status = calloc(count, sizeof *status);
    const bool good = done && status && iso_crossings_create(ctx, orbits, count, o, &c) == ISO_OK;
    const bool all = good && iso_crossings_go(c, NULL, each, at, samples, done, status) == ISO_OK;
    gsl_test(!all, "%zu crossings of %zu orbits: %s", each, count, all ? "found" : iso_context_message(ctx));
    if (good) iso_crossings_free(c);
    free(done);
    free(status);
    return all;
}

static inline bool crossed(iso_context *ctx, const iso_batch_orbit *orbit, const iso_crossings_options *o,
                           size_t each, iso_crossing at[], iso_sample samples[])
{
    return crossed_all(ctx, orbit, 1, o, each, at, samples);
}

#endif
