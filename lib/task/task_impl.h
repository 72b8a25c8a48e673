/* task_impl.h - what the files of this folder offer to each other. */
#ifndef ISO_TASK_TASK_IMPL_H
#define ISO_TASK_TASK_IMPL_H

#include "study/options_impl.h"
#include "study/study_impl.h"
#include "task/analogue.h"
#include "task/compare.h"

/* --- which backend `auto` means for the extent of a run (backend.c) -------------------------------------------- */

/* What an orbit is asked for. */
typedef struct iso_run_extent {
    size_t rows;     /* this many times, ...                      */
    double farthest; /* ... this one the farthest, caller's units */
} iso_run_extent;

/* The orbit, as `how` says. ISO_BACKEND_AUTO there is the cheapest backend for the extent. If there is no orbit by that
 * backend, it is what iso_orbit_create takes for ISO_BACKEND_AUTO. Errors: those of iso_orbit_create. */
iso_status iso_backend_open(iso_context *ctx, const iso_scene *scene, const iso_orbit_options *how,
                            const iso_run_extent *extent, iso_orbit **orbit);

/* --- the order in which an orbit is followed to times that come in any order (run.c) ---------------------------- */

/* The orbit is followed away from its start, and keeps no ends of steps. For a time that lies behind, it begins at
 * the start again. So the order of the work is: times after the start, then those before it; on each side the nearer
 * times come first, and equal times as they are asked for. */

/* A time asked for, and the row of the result that it belongs to. */
typedef struct iso_asked_time {
    double time;
    size_t row;
} iso_asked_time;

/* Whether the times already stand in the order of the work. */
bool iso_times_in_order(const double times[], size_t count);

/* The times in the order of the work, for the caller to free; count is above 0. NULL: no memory. */
iso_asked_time *iso_times_sorted(const double times[], size_t count);

/* Options of the study run: the times of the rows are the scene's own, or those of a record of one column. */
typedef struct iso_run_request {
    iso_scene_changes change;
    bool verbose; /* find the errors of the rows, too, and print them */
} iso_run_request;

/* What the options of compare hold. */
typedef struct iso_compare_request {
    iso_scene_changes change;
    double rows; /* of states that are printed */
} iso_compare_request;

/* --- comparisons, as text (compare_print.c) --------------------------------------------------------------------- */

enum { ISO_COMPARISON_SIZE = 512 };

/* The result of a comparison in one sentence, for people. True: it is the same orbit by all backends, since the largest
 * difference, *most, is within what the errors of the steps may add up to. False: the sentence says why not. */
bool iso_comparison_text(const iso_scene *scene, const iso_comparison *c, double *most,
                         char words[ISO_COMPARISON_SIZE]);

/* --- the study analogue (analogue_study.c) ---------------------------------------------------------------------- */

typedef struct iso_analogue_request {
    iso_analogue_problem problem; /* numbers that are not given are NAN; its `neumann` is not read */
    double mass, radius;          /* NAN: analogue chooses                                         */
} iso_analogue_request;

/* Whether the options state a problem. If not, a scene must. */
bool iso_analogue_is_stated(const iso_analogue_request *request);

typedef struct iso_analogue_found {
    iso_analogue analogue;
    iso_analogue_ball ball;
    const char *text; /* the scene of the ball, with a report in # lines: the text of the result */
} iso_analogue_found;

/* What it tells people, and the lines of its table (compare_print.c). */
void iso_compare_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);

#endif
