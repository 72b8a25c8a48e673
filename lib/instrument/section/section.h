/* section.h - the Poincare section of a scene: crossings of many orbits. Each crossing goes to a sink, as a row.
 *
 *     iso_status keep_row(void *data, int table, const double row[], size_t count);
 *     iso_sink sink = {.row = keep_row, .data = &rows};
 *     iso_section_options o = iso_section_defaults();
 *     o.starts = 100;
 *     status = iso_section_run(ctx, &scene, &o, &sink, NULL, &result);
 *
 * The section is n_a = 0, n_a increasing, the same for ball and point (map/section.h); or an event: a column of the
 * samples passes a value upwards. Orbit 0 is the scene's own. Then come `starts` orbits, spread evenly over the
 * section by the area dL dl. Then come those that begin at the given points (l, x). All have the scene's energy h,
 * eps and level H. Orbits 1, 2, ... begin on the section; this start is no crossing.
 *
 * Memory does not grow with the number of orbits. It grows with the number of crossings only up to a bound of about
 * 100 MB.
 */
#ifndef ISO_INSTRUMENT_SECTION_SECTION_H
#define ISO_INSTRUMENT_SECTION_SECTION_H

#include <math.h>
#include <stdint.h>

#include "base/record.h"
#include "base/sink.h"
#include "orbit/crossings.h"
#include "orbit/scene.h"

/* Whether a section is global, and why. */
typedef struct iso_section_nature {
    int axis;        /* the axis that is asked for, or the global one; -1: an event                              */
    bool global;     /* every orbit crosses for ever and none only touches, except the rotation in n_a = 0       */
    char words[256]; /* one line: why it is global, or why it is not known to be                                */
} iso_section_nature;

typedef struct iso_section_options {
    size_t crossings;      /* of each orbit, 1 or more                                                           */
    size_t starts;         /* orbits spread over the section                                                     */
    uint64_t seed;         /* of their spreading                                                                 */
    const double (*at)[2]; /* (l, x) of further starts                                                           */
    size_t at_count;
    int axis;   /* 0 to 2; ISO_AXIS_AUTO: the global one                                              */
    int column; /* -1, or the column (iso_column_find) whose passing of `value` is looked for instead  */
    double value;
    iso_models models;   /* those integrated, each by itself; ISO_SHOW_START: both if the ball has a twin       */
    iso_models shown;    /* the model whose states the rows have; ISO_SHOW_START: no states                      */
    double tolerance;    /* NAN: the scene's                                                                   */
    int threads;         /* 0: as many as there are processors to run on                                       */
    const char *vectors; /* see batch.h                                                                        */
} iso_section_options;

/* 500 crossings of the global section by the scene's own orbit, both models, no states. */
static inline iso_section_options iso_section_defaults(void)
{
    return (iso_section_options){.crossings = 500,
                                 .axis = ISO_AXIS_AUTO,
                                 .column = -1,
                                 .models = ISO_SHOW_START,
                                 .shown = ISO_SHOW_START,
                                 .tolerance = NAN};
}

/* Two models part on an orbit when their distance passes this. On chaotic orbits the rounding errors of the models
 * grow until they part. */
#define ISO_SECTION_PARTED 1e-3

typedef struct iso_section_result {
    iso_section_nature nature;
    iso_models models;   /* that were integrated: ball, point or both                                            */
    size_t orbits, rows; /* orbits asked for; rows that the sink has taken                                       */
    size_t crossings[2]; /* found by the ball, by the point                                                      */
    size_t failed;       /* orbits that have fewer crossings than asked for                                      */
    iso_status failure;  /* of the first of them, with its text                                                 */
    char words[512];
    /* With both models. The distance of two crossings is the larger one of |dl| and |dx|. On an event it is |dt|,
     * divided by the mean time between crossings. */
    size_t unequal;  /* orbits with different numbers of crossings by the two models                         */
    double distance; /* the largest one on orbits that do not part ...                                       */
    size_t distance_orbit, distance_crossing; /* ... and where it is; crossings count from 1                       */
    size_t parted; /* orbits that part: their distance passes ISO_SECTION_PARTED                           */
    size_t parted_orbit, parted_crossing; /* the orbit that parts at the lowest crossing number, and the crossing */
} iso_section_result;

/* Rows go to the sink, and to new records if `tables` is not NULL: of table 0 by orbit, then by crossing. If both
 * models are integrated, a crossing that both have is a row of table 1, too: as the point finds it, in the columns
 * orbit, crossing, t, tau, s, l, x, just behind the row of table 0. Notes: the section is not global, ...
 *
 * The rows of table 0 have the columns orbit (from 0), crossing (from 1), t; tau and s if the orbit has both models;
 * l and x unless the section is an event; then the states that are shown. The ball's states include the columns of
 * effects. With both models the rows are the ball's.
 * - If an orbit fails, its earlier rows stay, and the other orbits go on. If no orbit has a row, the call returns the
 *   failure of the first one. Else it returns ISO_OK, and result->failed is the number of orbits that failed.
 * - The context's monitor can stop the work: earlier rows stay.
 * - options NULL: iso_section_defaults(). result may be NULL; else it is always filled, also after an error.
 *
 * Errors before the header:
 * - ISO_BAD_ARGUMENT: those of iso_crossings_create; about "crossings" (0);
 * - ISO_BAD_INPUT about an effect that takes energy, since its orbits do not return for ever; about "M" or
 *   "angular_velocity" at rest; about "columns", for a column of an effect that the scene does not have;
 * - ISO_BAD_INPUT about `at` that is outside of the chart (|x| >= 1, or no finite number), or where the level closes
 *   the section, and about `starts` where it closes all of it. Or about the effect, where there is no chart:
 *   (l, x) does not determine an orbit with effects beyond a level, nor at an event;
 * - those of iso_orbit_create: ISO_NOT_MAPPED if the point is asked for and there is none.
 * Errors after the header: what the sink returns; ISO_STOPPED; ISO_NO_MEMORY. */
iso_status iso_section_run(iso_context *ctx, const iso_scene *scene, const iso_section_options *options,
                           const iso_sink *sink, iso_record *tables[2], iso_section_result *result);

#endif
