/* cost_impl.h - orbits of one scene walked along, within a time limit, and how far they are from each other. */
#ifndef ISO_STUDY_COST_IMPL_H
#define ISO_STUDY_COST_IMPL_H

#include "study/cost.h"
#include "study/seconds_impl.h"

/* Who may end a run: the caller's own watch, and the processor time. */
typedef struct cost_watch {
    iso_context *user;
    double deadline; /* in processor_seconds(); infinite: none */
    unsigned calls;
    bool stopped, late; /* by the caller; by the time */
} cost_watch;

/* A scene, and a context whose failures are not the caller's. */
typedef struct cost_problem {
    iso_context *user, *ctx;
    const iso_scene *scene;
    iso_effects effects;    /* that act on the motion                                */
    iso_clock clock, other; /* of the scene's times, and the one whose error is told */
    double end;
    cost_watch watch;
} cost_problem;

/* The caller's refusals, in the caller's context. Errors: those of iso_cost_measure about the scene. */
iso_status iso_cost_problem_open(cost_problem *p, iso_context *user, const iso_scene *scene,
                                 const iso_cost_options *o);
void iso_cost_problem_close(cost_problem *p);

iso_status iso_cost_orbit_open(cost_problem *p, iso_picture backend, const iso_method *method, double tolerance,
                               bool carry, iso_orbit **orbit);

/* Nothing asked of p->ctx from now on goes on for more than so many seconds. */
void iso_cost_allow(cost_problem *p, double seconds);

/* Whether the caller wants no more. */
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
iso_status iso_cost_walk(cost_problem *p, iso_picture backend, const iso_method *method, double tolerance, bool carry,
                         double seconds, cost_track *track);

/* The distance of row i of two tracks; the largest over what both reached; of the clock, relative to its largest. */
double iso_cost_distance_at(const cost_track *a, const cost_track *b, int i);
double iso_cost_distance(const cost_track *a, const cost_track *b);
double iso_cost_clock_distance(const cost_track *a, const cost_track *b);

/* What errors are measured against. `second` of the closed solution is what its own cell is measured against. */
typedef struct cost_reference {
    cost_track first, second;
    bool exact, doubted; /* the first is the closed solution; there is a second */
    char what[120], second_what[120];
    double uncertainty;
} cost_reference;

/* At the given times, in about so many seconds; as far as the best of them gets (`may_fall_short`), or all the way.
 * Errors: ISO_NUMERICAL, ISO_STOPPED, ISO_NO_MEMORY, in the caller's context. */
iso_status iso_cost_reference_find(cost_problem *p, int times, const double time[], double seconds,
                                   bool may_fall_short, cost_reference *reference);
void iso_cost_reference_free(cost_reference *reference);

/* The seconds for which one orbit is set up and steps straight to `end`, the mean over some of them when they are
 * short. `about`: what one is expected to take. */
iso_status iso_cost_time(cost_problem *p, const iso_cost_cell *cell, double end, double about, double *setup,
                         double *stepping, iso_statistics *statistics);

/* Times of one thing, repeated. */
enum { COST_REPEATS = 40 };
typedef struct cost_times {
    int count;
    double setup[COST_REPEATS], stepping[COST_REPEATS];
} cost_times;

/* Whether least and median of what was measured are known to about 5 %. */
bool iso_cost_times_settled(const cost_times *times);
void iso_cost_times_tell(const cost_times *times, iso_cost_cell *cell);

/* The median of all slopes of y over x between points that are at least `apart` from each other in x; NaN: none. */
double iso_cost_slope(int count, const double x[], const double y[], double apart);

/* Fits of the lines, and which cells are pareto. */
void iso_cost_judge(iso_cost *cost);

#endif
