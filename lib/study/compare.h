/* compare.h - the same orbit by every backend, side by side.
 *
 *     iso_comparison *c;
 *     status = iso_compare(ctx, &scene, NULL, NULL, &c);
 *     ... c->run[ISO_BALL], c->run[ISO_POINT], c->difference ...
 *     if (c->runs == ISO_BACKENDS) ... c->run[ISO_BY_EXACT], c->from_exact[ISO_BALL] ...
 *     iso_comparison_free(c);
 */
#ifndef ISO_STUDY_COMPARE_H
#define ISO_STUDY_COMPARE_H

#include "../base/record.h"
#include "../orbit/orbit.h"

/* Which run is which: those of ISO_BALL and ISO_POINT have these numbers, the one of ISO_EXACT is the last. */
enum { ISO_INTEGRATED = 2, ISO_BY_EXACT = ISO_INTEGRATED, ISO_BACKENDS };

/* One integral along one backend's orbit, in the model of `system`. */
typedef struct iso_drift {
    const iso_system *system;
    const iso_integral *integral;
    double start; /* its value at the start, in the caller's units (infinite if that overflows)          */
    double worst; /* largest |I - I(start)| / size over the rows, see iso_integral                       */
} iso_drift;

/* One backend's part. */
typedef struct iso_backend_run {
    iso_picture backend;
    const iso_method *method;
    iso_record *trajectory; /* the columns before those of effects, one row for each time of the scene   */
    iso_statistics statistics;
    double seconds; /* of processor time, for the integration                                            */
    int drifts;     /* integrals that hold for this k and J, of the ball, then of the point              */
    iso_drift drift[ISO_MAX_INTEGRALS];
} iso_backend_run;

/* The columns of the differences: a clock, then |difference| of the two backends relative to the size of
 * the vector (omega, M) or to the largest value of the clock in the record (tau, s, t); n and gamma are unit vectors. */
enum { ISO_DIFFERENCES = 7 };

typedef struct iso_comparison {
    iso_effects effects; /* that act, in the scene's units: those of the scene, and the level of a point off H = 0 */
    iso_clock clock;                   /* in which the scene counts its times: t or s                    */
    double h, eps;                     /* energy and coupling in the caller's units                      */
    int runs;                          /* ISO_BACKENDS, or ISO_INTEGRATED: there is no closed solution   */
    iso_backend_run run[ISO_BACKENDS];
    char no_exact[512];                /* why not                                                        */
    iso_record *difference;            /* time, omega, n, M, gamma and the two other clocks              */
    double worst[ISO_DIFFERENCES];     /* largest of each column of `difference`; [0] is the last time   */
    iso_record *from_exact[ISO_INTEGRATED]; /* the same of [ISO_BALL] and [ISO_POINT] from the closed solution */
    double worst_from_exact[ISO_INTEGRATED][ISO_DIFFERENCES];
} iso_comparison;

/* Finds the scene's orbit by every backend (its own choice of backend is not read), row by row; without a closed
 * solution by ball and point alone. `progress` (may be NULL) is called after each row with the part done in (0, 1]; when
 * it answers false the comparison ends there.
 * Errors: as iso_scene_check_times, iso_orbit_create and iso_orbit_at; ISO_BAD_ARGUMENT for a method there is not.
 * After ISO_NUMERICAL in the middle *comparison holds the rows before; otherwise it is NULL on failure. */
iso_status iso_compare(iso_context *ctx, const iso_scene *scene, bool (*progress)(double part, void *data), void *data,
                       iso_comparison **comparison);
void iso_comparison_free(iso_comparison *comparison);

#endif
