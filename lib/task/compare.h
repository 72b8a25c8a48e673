/* compare.h - the same orbit by every backend, side by side.
 *
 *     iso_comparison *c;
 *     status = iso_compare(ctx, &scene, NULL, NULL, &c);
 *     ... c->run[ISO_BALL], c->run[ISO_POINT], c->difference ...
 *     if (c->runs == ISO_BACKENDS) ... c->run[ISO_BY_EXACT], c->from_exact[ISO_BALL] ...
 *     iso_comparison_free(c);
 */
#ifndef ISO_TASK_COMPARE_H
#define ISO_TASK_COMPARE_H

#include "base/field.h"
#include "base/record.h"
#include "orbit/orbit.h"

/* The index of each run: [ISO_BALL] and [ISO_POINT] are integrated, [ISO_BY_EXACT] is the closed solution. */
enum { ISO_INTEGRATED = 2, ISO_BY_EXACT = ISO_INTEGRATED, ISO_BACKENDS };

/* One backend's part. */
typedef struct iso_backend_run {
    iso_backend backend;
    const iso_method *method;
    iso_record *trajectory; /* the columns before those of effects, one row for each time of the scene   */
    iso_statistics statistics;
    double seconds; /* of processor time, for the integration                                            */
    int drifts;     /* integrals that hold for this k and J, of the ball, then of the point              */
    iso_drift drift[ISO_MAX_INTEGRALS];
} iso_backend_run;

/* The columns of the differences: a clock, then the distance of the two backends in omega, n, M, gamma and the two
 * other clocks, as lib/doc/methods.md, section 3, defines it. */
enum { ISO_DIFFERENCES = 7 };

typedef struct iso_comparison {
    iso_effects effects; /* that act, in the scene's units: the scene's, and `level` for a point with H not 0 */
    iso_clock clock;     /* in which the scene counts its times: t or s                                       */
    double h, eps;       /* energy and coupling in the caller's units                                         */
    int runs;            /* ISO_BACKENDS; ISO_INTEGRATED where there is no closed solution                    */
    iso_backend_run run[ISO_BACKENDS];
    char no_exact[512];                     /* why there is no closed solution                                */
    iso_record *difference;                 /* time, omega, n, M, gamma and the two other clocks              */
    double worst[ISO_DIFFERENCES];          /* largest of each column of `difference`; [0] is the last time   */
    iso_record *from_exact[ISO_INTEGRATED]; /* the same of [ISO_BALL] and [ISO_POINT] from the closed solution */
    double worst_from_exact[ISO_INTEGRATED][ISO_DIFFERENCES];
} iso_comparison;

/* Finds the scene's orbit by every backend, row by row; where there is no closed solution, by ball and point. The
 * scene's own choice of a backend is not read. `progress` (may be NULL) is called after each row with the part done,
 * in (0, 1]; the comparison ends when it answers false.
 * Errors: those of iso_scene_check_times, iso_orbit_create and iso_orbit_at; ISO_BAD_ARGUMENT for an unknown method.
 * After ISO_NUMERICAL or ISO_STOPPED *comparison holds the rows found before, if there are any; after other errors
 * it is NULL. */
iso_status iso_compare(iso_context *ctx, const iso_scene *scene, bool (*progress)(void *data, double part),
                       void *data, iso_comparison **comparison);
void iso_comparison_free(iso_comparison *comparison);

#endif
