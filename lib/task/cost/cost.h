/* cost.h - what accuracy costs in time: one scene by every backend, method and tolerance, on this machine.
 *
 *     iso_cost *cost;
 *     iso_cost_options o = iso_cost_defaults();
 *     iso_cost_measure(ctx, &scene, &o, &cost);
 *     const iso_cost_cell *best = iso_cost_choose(cost, 1e-9);      the cheapest that reaches it, or NULL
 *     iso_cost_free(cost);
 *
 * A cell is one backend with one method at one tolerance.
 * - Its error is the largest relative error of the ball's (omega, n), each vector relative to its length, at output
 *   times that are spread evenly over the scene. It is measured against a reference that is none of the cells: the
 *   closed solution where there is one, else a run in extended precision.
 * - The uncertainty of the reference is its distance from a second, independent reference: from the other formulation
 *   (ball or point) where there is one, else from another method.
 * - Only what acts on the motion is computed: no attitude, no reactions.
 * - Its time is processor time of runs straight to the end of the scene, without set-up (the creation of the orbit).
 *   Runs are repeated in rounds over all cells, so that a disturbance of the machine does not fall on one cell, until
 *   minimum and median are known to about 5 %.
 * - A cell that would take more than its share of the time is given up, and the tighter tolerances of its series are
 *   not tried.
 */
#ifndef ISO_TASK_COST_COST_H
#define ISO_TASK_COST_COST_H

#include "base/field.h"
#include "orbit/orbit.h"

typedef struct iso_cost_options {
    bool quick;          /* three tolerances and about 3 s; else every second power of ten and about 40 s       */
    double seconds;      /* of processor time, about how long it may take in all; 0: as above                   */
    int times;           /* output times at which errors are taken; 0: 20                                       */
    iso_backend backend; /* this backend alone; ISO_BACKEND_AUTO: all                                           */
    const iso_method *method; /* this method alone; NULL: all that serve the scene, but for slow reference ones */
    double tolerance; /* this tolerance alone; 0: all                                                        */
    void (*progress)(void *data, double share, const char *what); /* may be NULL; share in [0, 1], never falls  */
    void *data;
} iso_cost_options;

/* All backends, methods and tolerances, about 40 s. */
static inline iso_cost_options iso_cost_defaults(void)
{
    iso_cost_options o = {0};
    o.backend = ISO_BACKEND_AUTO;
    return o;
}

typedef struct iso_cost_cell {
    iso_backend backend;
    const iso_method *method; /* of the closed solution: NULL, and no tolerance (NaN)                           */
    double tolerance;
    iso_status status; /* ISO_OK, or why there is no result; ISO_STOPPED: it would take too long         */
    char why[160];     /* in words                                                                       */
    double setup, fastest, median, slowest; /* seconds; the last three of stepping, over the repeats            */
    double total; /* set-up and median: what one run takes, and what cells are compared by          */
    int repeats;
    iso_statistics statistics;
    double error;       /* largest over the output times ...                                              */
    double clock_error; /* ... of clock s (of a point's start: t), relative to its largest value; NaN     */
    double energy_drift, constraint_drift; /* ... the largest of the ball's (iso_drift); NaN: none holds         */
    bool below;  /* the reference is not exact enough to tell: error < 3 uncertainties             */
    bool pareto; /* no other cell is as exact and faster (1.05 times)                              */
} iso_cost_cell;

/* One method of one backend, over its tolerances, the loosest first. */
typedef struct iso_cost_series {
    iso_backend backend;
    const iso_method *method;
    int first, count; /* its cells                                                                    */
    double digit;     /* factor in time for one more digit, fitted where it still gains; NaN: too few */
    double order;     /* error ~ (steps)^-order, fitted likewise; NaN: too few, or the method's varies */
    double least;     /* smallest error reached; NaN: none ...                                        */
    double stops_at;  /* ... and at which tolerance it stops gaining; NaN: it gains to the last       */
} iso_cost_series;

typedef struct iso_cost {
    double end, turns; /* the scene's last time, and how often the normal goes round until then, about */
    char reference[120], second[120]; /* in words: what errors are measured against, and what that is        */
    double uncertainty; /* infinite: there is no second reference                                       */
    double seconds;     /* that it took                                                                 */
    bool complete;      /* false: stopped on request; cells not reached have repeats = 0                */
    int cells, series_count;
    iso_cost_cell *cell;
    iso_cost_series *series;
} iso_cost;

/* Failing cells are no failure. Errors: those of the scene itself, or of a backend and a method asked for (as
 * iso_orbit_create); ISO_BAD_ARGUMENT about "end" for a scene without length; ISO_NUMERICAL where no reference gets
 * there; ISO_NO_MEMORY. On ISO_STOPPED *cost holds what was measured so far, NULL if nothing; on other errors it is
 * NULL. */
iso_status iso_cost_measure(iso_context *ctx, const iso_scene *scene, const iso_cost_options *options,
                            iso_cost **cost);
void iso_cost_free(iso_cost *cost);

#endif
