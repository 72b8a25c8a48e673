/* cost_impl.h - orbits of one scene walked along, within a time limit, and how far they are from each other. */
#ifndef ISO_TASK_COST_COST_IMPL_H
#define ISO_TASK_COST_COST_IMPL_H

#include "base/resources_impl.h"
#include "study/options_impl.h"
#include "task/cost/cost.h"

/* What may end a run: the caller's own monitor, or a limit of processor time. */
typedef struct cost_monitor {
    iso_context *user;
    double deadline; /* in processor_seconds(); infinite: no limit */
    unsigned calls;
    bool stopped, late; /* by the caller; by the time */
} cost_monitor;

/* A scene, with a context of its own: a cell that fails leaves no failure in the caller's context. */
typedef struct cost_problem {
    iso_context *user, *ctx;
    const iso_scene *scene;
    iso_effects effects;    /* that act on the motion                                */
    iso_clock clock, other; /* the clock of the scene's times, and the clock whose error is measured */
    double end;
    cost_monitor monitor;
} cost_problem;

/* The caller's refusals, in the caller's context. Errors: those of iso_cost_measure about the scene. */
iso_status iso_cost_problem_open(cost_problem *p, iso_context *user, const iso_scene *scene,
                                 const iso_cost_options *o);
void iso_cost_problem_close(cost_problem *p);

iso_status iso_cost_orbit_open(cost_problem *p, iso_backend backend, const iso_method *method, double tolerance,
                               bool with_clock, iso_orbit **orbit);

/* Whether the caller has asked to stop. */
bool iso_cost_is_stopped(cost_problem *p);

/* An orbit at some times. */
typedef struct cost_row {
    double ball[ISO_STATE], clock;
} cost_row;

typedef struct cost_track {
    int times, reached;
    const double *time;
    cost_row *row; /* `times` of them, `reached` of which are filled */
    double energy_drift, constraint_drift, seconds;
    iso_statistics statistics;
} cost_track;

/* Errors: ISO_NO_MEMORY, in the caller's context. */
iso_status iso_cost_track_make(cost_problem *p, int times, const double time[], cost_track *track);
void iso_cost_track_free(cost_track *track);

/* Fills the track. Gives up (ISO_STOPPED) as soon as it looks as if it took longer than so many seconds. */
iso_status iso_cost_walk(cost_problem *p, iso_backend backend, const iso_method *method, double tolerance,
                         bool with_clock, double seconds, cost_track *track);

/* Distances of two tracks: the largest iso_distance over the rows that both reached; that of the clock, relative to its
 * largest value. */
double iso_cost_distance(const cost_track *a, const cost_track *b);
double iso_cost_clock_distance(const cost_track *a, const cost_track *b);

/* What errors are measured against. The cell of the closed solution is measured against `second`. */
typedef struct cost_reference {
    cost_track first, second;
    bool exact, doubted; /* the first is the closed solution; there is a second */
    char what[120], second_what[120];
    double uncertainty;
} cost_reference;

/* A reference at the given times, in about so many seconds.
 * Errors: ISO_NUMERICAL, ISO_STOPPED, ISO_NO_MEMORY, in the caller's context. */
iso_status iso_cost_reference_find(cost_problem *p, int times, const double time[], double seconds,
                                   cost_reference *reference);
void iso_cost_reference_free(cost_reference *reference);

/* The seconds in which one orbit is set up, and steps straight to `end`; the mean of several when they are short.
 * `about` is the time that one is expected to take. */
iso_status iso_cost_time(cost_problem *p, const iso_cost_cell *cell, double end, double about, double *setup,
                         double *stepping, iso_statistics *statistics);

/* Times of one thing, repeated. */
enum { COST_REPEATS = 40 };
typedef struct cost_times {
    int count;
    double setup[COST_REPEATS], stepping[COST_REPEATS];
} cost_times;

/* Whether the least and the median of the times are known to about 5 %. */
bool iso_cost_times_settled(const cost_times *times);
void iso_cost_times_read(const cost_times *times, iso_cost_cell *cell);

/* The median of all slopes of y over x between points that are at least `apart` from each other in x; NaN: none. */
double iso_cost_slope(int count, const double x[], const double y[], double apart);

/* Fits the series, and finds the cells that are pareto. */
void iso_cost_evaluate(iso_cost *cost);

/* Whether a cell has a result. */
bool iso_cost_is_measured(const void *cell);

/* The cell with the least `total` of those that reach `want`; NULL: none does. steps: only methods that take steps;
 * series: only its cells (NULL: all). */
const iso_cost_cell *iso_cost_choose(const iso_cost *cost, bool steps, const iso_cost_series *series, double want);

/* --- the study (cost_study.c) ----------------------------------------------------------------------------------- */

typedef struct iso_cost_request {
    iso_scene_changes change;
    double want; /* NAN: not given */
    bool quick;
} iso_cost_request;

/* What the study finds. */
typedef struct iso_cost_found {
    iso_cost *cost;
    /* All series: the closed solution first, then the methods, the fastest to an error of 1e-9 first. Methods that do
     * not reach it are sorted by 1e-6, then by 1e-3. */
    const iso_cost_series **series;
    double want;                 /* NAN: nothing is wanted          */
    const iso_cost_cell *choice; /* for `want`; NULL: there is none */
} iso_cost_found;

/* Whether a cell failed. Cells that were left out for lack of time did not. */
bool iso_cost_has_failed(const void *cell);

/* How many cells there are for which `is` is true. */
int iso_cost_count(const iso_cost *cost, bool (*is)(const void *cell));

/* What it tells people, and the lines of its table (cost_print.c). */
void iso_cost_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);
iso_status iso_cost_describe(iso_context *ctx, const iso_scene *scene, const void *options, iso_study_result *result);

/* What to expect of the choice for --want: its error and its time. */
enum { ISO_COST_EXPECTED = 160 };
void iso_cost_expected(const iso_cost_found *found, char text[static ISO_COST_EXPECTED]);

#endif
