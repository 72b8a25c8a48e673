/* run.h - the trajectory of a scene: its rows, one after the other, to a sink.
 *
 *     iso_status keep_row(void *data, const double row[], size_t count);
 *     iso_run_sink sink = {.row = keep_row, .data = &rows};
 *     iso_run_result result;
 *     status = iso_run(ctx, &scene, NULL, &sink, &result);              the times of the scene's own grid
 *
 * The columns are those that the scene asks for (iso_scene_columns). Memory grows with the rows only where the times
 * asked for are in another order than that of the work.
 */
#ifndef ISO_STUDY_RUN_H
#define ISO_STUDY_RUN_H

#include "../base/record.h"
#include "error.h"

/* --- the orbit behind the columns --------------------------------------------------------------------------------- */

/* Options of the orbit that fills these columns (iso_scene_columns) and computes nothing else. They point to *effects,
 * which is written. */
iso_orbit_options iso_scene_orbit_options(const iso_scene *scene, const int columns[], int count,
                                          iso_effects *effects);

/* That orbit. Errors: those of iso_orbit_create. */
iso_status iso_scene_orbit(iso_context *ctx, const iso_scene *scene, const int columns[], int count,
                           iso_orbit **orbit);

/* --- a run -------------------------------------------------------------------------------------------------------- */

typedef struct iso_run_options {
    const double *times; /* asked for, in any order, before and after the start, in t of a ball's scene, in s of a
                            point's; NULL: the scene's own grid                                                  */
    size_t count;        /* how many                                                                             */
    bool errors;         /* whether to find the largest error of the rows, too (study/error.h): some ten times
                            the work                                                                             */
} iso_run_options;

/* The scene's own grid, no errors. */
iso_run_options iso_run_defaults(void);

/* What a run can have to say about the contact of ball and support (effect `reactions`). */
typedef enum iso_run_note {
    ISO_NOTE_LOST,          /* contact is lost: at that moment there is a row, and none farther from the start  */
    ISO_NOTE_LOST_AT_START, /* likewise at time 0: the support only would have to pull from there on            */
    ISO_NOTE_PULLED         /* the support would have to pull at time 0: the rows are those of a two-sided contact */
} iso_run_note;

/* Who takes the rows. A function that is NULL is not called. `header` and `row` answer ISO_OK to go on; with anything
 * else the run ends, and answers the same. */
typedef struct iso_run_sink {
    iso_status (*header)(void *data, const iso_record *header); /* columns and lines, once, before all rows       */
    iso_status (*row)(void *data, const double row[], size_t count); /* in the order of the times asked for       */
    void (*note)(void *data, iso_run_note note, const char *words);  /* when it is found, before that row         */
    void (*progress)(void *data, double part); /* at each step: how far on the way to the farthest time, in [0, 1] */
    void *data;
} iso_run_sink;

typedef struct iso_run_result {
    size_t asked, rows; /* times asked for, and rows that the sink has taken                                       */
    /* of the orbit; method is NULL where none could be made */
    iso_picture backend; /* ISO_BALL, ISO_POINT, ISO_EXACT                                                         */
    const iso_method *method;
    iso_clock clock; /* that of the times                                                                          */
    iso_statistics statistics;
    bool lost[2]; /* whether contact is lost after the start, and before it,                                       */
    double lost_at[2]; /* and the time                                                                             */
    /* with options.errors */
    iso_status error_status; /* ISO_OK: `error` holds for every row that the sink has taken                        */
    char error_words[256];   /* else why the error is not known                                                    */
    iso_error error;
} iso_run_result;

/* Finds the scene's orbit at the times asked for, and gives a row for each to the sink. Times after the start are worked
 * on first, then those before it, each side away from the start; the sink gets its rows in the order asked for. A time
 * beyond the moment at which contact is lost has no row; the first such time has the row of that moment.
 *
 * After a failure or a stop the sink has been given every row that was found before. *result (may be NULL) is filled in
 * any case. The context's watch is asked at each step, and before each row; it can stop the run.
 *
 * options NULL: iso_run_defaults().
 * Errors, before the header: as iso_scene_check_times, iso_scene_check_columns, iso_orbit_create, iso_orbit_check_time;
 * ISO_BAD_ARGUMENT about "times" (none, or one that is not finite) or "method" (there is none of that name). Then: what
 * the sink answers; as iso_orbit_at; ISO_STOPPED; ISO_NO_MEMORY. That the error of the rows is not known is no failure. */
iso_status iso_run(iso_context *ctx, const iso_scene *scene, const iso_run_options *options, const iso_run_sink *sink,
                   iso_run_result *result);

#endif
