/* run.h - the trajectory of a scene: every row goes to a sink as soon as it is found.
 *
 *     iso_status keep_row(void *data, int table, const double row[], size_t count);
 *     iso_sink sink = {.row = keep_row, .data = &rows};
 *     iso_run_result result;
 *     status = iso_run(ctx, &scene, NULL, &sink, NULL, &result);              the times of the scene's own grid
 *
 * The columns are those that the scene asks for (iso_scene_column_list). The rows are kept in memory only if the times
 * come in another order than they are worked on.
 */
#ifndef ISO_TASK_RUN_H
#define ISO_TASK_RUN_H

#include "base/record.h"
#include "base/sink.h"
#include "study/error.h"

/* --- the orbit behind the columns ------------------------------------------------------------------------------- */

/* The orbit that fills these columns (iso_scene_column_list) and computes nothing else. The backend `auto` is the
 * cheapest for the rows and the tolerance of the scene. Errors: those of iso_orbit_create. */
iso_status iso_scene_orbit(iso_context *ctx, const iso_scene *scene, const int columns[], int count,
                           iso_orbit **orbit);

/* Why an orbit of iso_scene_orbit has the backend that it has, in words. */
const char *iso_scene_why_backend(const iso_scene *scene, const iso_orbit *orbit);

/* --- a run ------------------------------------------------------------------------------------------------------ */

typedef struct iso_run_options {
    /* In any order, before and after the start; in t for a ball's scene, in s for a point's. NULL: the scene's own
     * grid. */
    const double *times;
    size_t count; /* of times */
    /* Also find the largest error of the rows (study/error.h); this takes many times as long as the rows alone. */
    bool errors;
} iso_run_options;

/* The scene's own grid, no errors. */
static inline iso_run_options iso_run_defaults(void)
{
    iso_run_options o = {0};
    return o;
}

typedef struct iso_run_result {
    size_t asked, rows; /* times asked for, and rows that the sink has taken                                       */
    /* of the orbit; method is NULL if there is no orbit */
    iso_backend backend; /* that has found the orbit, not ISO_BACKEND_AUTO                                         */
    const iso_method *method;
    iso_clock clock; /* that of the times                                                                          */
    iso_statistics statistics;
    bool lost[2];      /* whether the ball loses contact: [0] after the start, [1] before it                       */
    double lost_at[2]; /* the times of that                                                                        */
    /* with options.errors */
    iso_status error_status; /* ISO_OK: `error` holds for every row that the sink has taken                        */
    char error_words[256];   /* otherwise: why the error is not known                                              */
    iso_error error;
} iso_run_result;

/* Finds the scene's orbit at the given times, and gives the sink a row for each, in the order of the times.
 * - Work begins with the times after the start, then come those before it; on each side the nearer times come first.
 * - Where the ball loses contact, the sink gets the row of this moment in the place of the first time beyond it.
 *   Times still farther from the start have no row.
 * - After a failure or a stop the sink has every row that was found before.
 * - The context's monitor is asked at each step and before each row; it can stop the run.
 * - rows: where a new record with header and rows goes; NULL: none is made.
 * - Notes are about the contact of ball and support (effect `reactions`): it is lost, or the support pulls.
 * - options NULL: iso_run_defaults(). result may be NULL; else it is always filled, after an error, too.
 *
 * Errors before the header:
 * - those of iso_scene_check_times, iso_scene_check_columns, iso_orbit_create and iso_orbit_check_time;
 * - ISO_BAD_ARGUMENT about "times" (there are none, or one is not finite) or "method" (no method has this name).
 * Errors after it: what the sink answers; those of iso_orbit_at; ISO_STOPPED; ISO_NO_MEMORY.
 * It is no failure if the error of the rows is not known: see result->error_status. */
iso_status iso_run(iso_context *ctx, const iso_scene *scene, const iso_run_options *options, const iso_sink *sink,
                   iso_record **rows, iso_run_result *result);

#endif
