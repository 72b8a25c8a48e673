/* certify_impl.h - certified orbits: rows that are enclosures, a midpoint and a radius for each number
 * (lib/doc/certify.md).
 *
 * Only the files arb_*.c use Arb; a build without Arb leaves them out. All other files include this header alone.
 */
#ifndef ISO_INSTRUMENT_CERTIFY_CERTIFY_IMPL_H
#define ISO_INSTRUMENT_CERTIFY_CERTIFY_IMPL_H

#include <stdio.h>

#include "base/context.h"
#include "base/rational_impl.h"
#include "orbit/scene.h"

#define ISO_CERTIFIED_KIND "certified"

enum { ISO_MOST_CERTIFIED_DIGITS = 1000, ISO_MOST_WORK_DIGITS = 10000 };

/* Of an attempt, as its steps times the cube of the digits that are computed with: the most, about ten hours of one
 * core. The pace of an orbit is known after some seconds of work and 20 steps, about a turn. */
#define ISO_MOST_CERTIFIED_WORK 1e12
#define ISO_PACE_WORK 3e7
#define ISO_PACE_STEPS 20

typedef struct iso_certify_options {
    int digits;      /* that each row is to hold                                 */
    int work_digits; /* of the numbers computed with; 0: as many as it takes     */
} iso_certify_options;

/* Who takes the lines of the file, each with its newline. Another answer than ISO_OK ends the work. */
typedef struct iso_certify_sink {
    iso_status (*line)(void *data, const char *text);
    void (*progress)(void *data, double part); /* NULL: no calls */
    void *data;
} iso_certify_sink;

typedef struct iso_certify_result {
    size_t asked, rows;
    long steps;      /* of the last attempt */
    int attempts;    /* each with more digits to compute with than the one before */
    int work_digits; /* of the last attempt */
    iso_backend backend;
} iso_certify_result;

/* Encloses the orbit of a scene at its times. The numbers of ball, start and effects, and the last time, are those of
 * `literals` (io/scene_file.h). Another last time, and the step, are decimal numbers of at most 15 digits.
 * After an error the rows before it have been given away. result is always filled.
 * Errors: ISO_BAD_INPUT, ISO_BAD_ARGUMENT: the scene has what is not enclosed, or this build has no Arb; ISO_NUMERICAL:
 * the enclosures do not hold their digits to the end; ISO_STOPPED; what the sink answers. */
iso_status iso_certify(iso_context *ctx, const iso_scene *scene, const iso_literals *literals,
                       const iso_certify_options *options, const iso_certify_sink *sink, iso_certify_result *result);

/* Reads such a file, called `name` in messages, and writes its rows as those of the other model. *rows: how many.
 * Errors: ISO_BAD_INPUT with the place; ISO_BAD_ARGUMENT: this build has no Arb; what the sink answers. */
iso_status iso_certify_convert(iso_context *ctx, FILE *file, const char *name, iso_model_kind to,
                               const iso_certify_sink *sink, size_t *rows);

/* --- certify.c asks arb_orbit.c ---------------------------------------------------------------------------------- */

/* Times: 0 is 0/1. */
typedef struct iso_certify_problem {
    const iso_scene *scene;
    const iso_literals *literals;
    iso_certify_options options;
    const char *end_text;   /* as the scene writes the last time; NULL: it is `end` */
    iso_rational end, step; /* step > 0 */
    iso_model_kind backend;
} iso_certify_problem;

iso_status iso_certify_orbit(iso_context *ctx, const iso_certify_problem *p, const iso_certify_sink *sink,
                             iso_certify_result *result);

/* Whether this build has Arb. Errors: ISO_BAD_ARGUMENT. */
iso_status iso_certify_is_possible(iso_context *ctx);

#endif
