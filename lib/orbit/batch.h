/* batch.h - many orbits at once: as fast as this processor can, on as many threads as it has.
 *
 *     iso_batch_orbit orbits[1000];                           {&params, &start, NULL} each
 *     iso_batch_options o = iso_batch_defaults();
 *     iso_batch_run(ctx, orbits, 1000, &o, (double[]){50, 100}, 2, samples, statuses);
 *
 * samples[2 i + 1] is then orbit i at t = 100. The method is `taylor`, with an orbit in each lane of the processor's
 * vectors (8 with AVX-512, 4 with AVX2, else 2) and its own steps; stiff models, for which it is not made, are
 * integrated one by one with the method auto, and balls at rest are where they were. An orbit's samples depend on the
 * kind of vectors, but not by a bit on the orbits beside it, their order, or the number of threads.
 */
#ifndef ISO_ORBIT_BATCH_H
#define ISO_ORBIT_BATCH_H

#include "orbit/orbit.h"

typedef struct iso_batch_orbit {
    const iso_params *params;
    const iso_start *start;
    const iso_effects *effects; /* in the caller's units; NULL: nothing acts */
} iso_batch_orbit;

/* As in iso_orbit_options, for all orbits. */
typedef struct iso_batch_options {
    /* ISO_BACKEND_AUTO: the cheaper point, where the orbit has one and |k| >= 1/8; else the start's own model; not
     * ISO_BACKEND_EXACT: its orbits share no work, so iso_orbit is as fast. */
    iso_backend backend;
    double tolerance;
    long max_steps; /* of each orbit; 0: no bound                                                         */
    iso_clock clock;
    iso_models shown;
    bool with_clock[ISO_CLOCKS];
    int threads;         /* 0: as many as there are processors to run on                                       */
    const char *vectors; /* "avx512", "avx2", "plain"; NULL: the widest of this processor                      */
} iso_batch_options;

/* Balls in their time t; backend ISO_BACKEND_AUTO, tolerance 1e-12, no bound on the steps, all processors. */
static inline iso_batch_options iso_batch_defaults(void)
{
    iso_batch_options o = {0};
    o.backend = ISO_BACKEND_AUTO;
    o.tolerance = 1e-12;
    o.clock = ISO_CLOCK_T;
    o.shown = ISO_SHOW_BALL;
    return o;
}

/* Fills samples[i rows + j] with orbit i at times[j], in the options' clock. Times run away from 0: all >= 0 and
 * growing, or all <= 0 and falling. status[i] (may be NULL) says how orbit i went; the rows that it has not reached
 * are NaN in every column. Returns ISO_OK, or the status of the first orbit that failed, with its number and reason in
 * the message (numbers from 0); the others go on. Errors of one orbit: those of iso_orbit_create and iso_orbit_at.
 * Errors of all: ISO_BAD_ARGUMENT (backend, tolerance, times, threads, vectors): status[] and samples[] are as they
 * were; ISO_NO_MEMORY, ISO_STOPPED by the context's monitor (asked by the calling thread alone): status and rows of
 * what is done by then are valid. */
iso_status iso_batch_run(iso_context *ctx, const iso_batch_orbit orbits[], size_t count,
                         const iso_batch_options *options, const double times[], size_t rows, iso_sample samples[],
                         iso_status status[]);

/* The same for `count` orbits of scenes, in the scenes' own columns: row j of orbit i is number i rows + j of
 * table[], which has room for count x rows x columns.
 * scene[]: `scenes` of them, 1 for all orbits or `count`. They agree in columns, backend, tolerance and the model of
 *   the start. The method is `taylor`, in lanes: scenes with another one are refused.
 * k, J, start: NULL, or numbers in place of the scenes': 1, 3 and 6 for each orbit (see iso_scene_replaced). If they
 *   make no sense, that orbit alone fails.
 * times: t for a ball's scene, s for a point's.
 * Units, in any consistent system: k, n and gamma have none; J mass length^2; omega 1/time; t time;
 *   s (unit of J)^(1/(2k) - 2) time; M 1/(unit of s); eps (unit of J)^4/time^2.
 * threads, vectors: as in the options.
 * After ISO_STOPPED or ISO_NO_MEMORY each orbit that was not followed has this status, too. Other errors of the call
 * leave table[] and status[] as they were. Those about "scenes": they do not agree; or a ball could lose contact,
 * which only a run watches (reactions without two_sided). */
iso_status iso_batch_table(iso_context *ctx, const iso_scene *const scene[], size_t scenes, size_t count,
                           const double k[], const double J[], const double start[], const double times[],
                           size_t rows, int threads, const char *vectors, double table[], iso_status status[]);

/* The vectors of this processor, widest first: "avx512", "avx2", "plain", and how many orbits stand in one (lanes may
 * be NULL); NULL past the end. */
const char *iso_batch_vectors(int i, int *lanes);

#endif
