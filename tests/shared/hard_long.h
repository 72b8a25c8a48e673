/* hard_long.h - long runs by one way: how far integrals drift, whether the drift has a trend, how the error grows. */
#ifndef ISO_TESTS_HARD_LONG_H
#define ISO_TESTS_HARD_LONG_H

#include <gsl/gsl_fit.h>

#include "hard.h"
#include "orbit/orbit_impl.h"
#include "scenes.h"

/* h or H; |n|, |gamma|, |e| and |Q|; (omega,n) or (M,gamma); F */
enum { LONG_ENERGY, LONG_UNITS, LONG_SPIN, LONG_SECOND, LONG_QUANTITIES };

enum { LONG_LOOKS = 1000 };

/* Rounding. A restored quantity has the rounding errors of three products, and reading it adds ten more. The terms
 * are at most a few times as large as their sum. */
#define LONG_ROUNDED (64 * DBL_EPSILON)

typedef struct long_scene {
    iso_params p;
    iso_start start;
    iso_effects effects;
    double spin; /* 1/|omega| at the start: the unit of all lengths */
} long_scene;

typedef struct long_run {
    bool refused;
    char words[256];
    double spins;                  /* the length                                             */
    double drift[LONG_QUANTITIES]; /* the largest, in units of the integral's terms          */
    double trend;                  /* slope of the energy's error, in standard errors of it  */
    double error, growth;          /* at the end; p of the envelope error ~ t^p, last two decades */
    long steps;
} long_run;

static inline int long_quantity(const iso_integral *integral)
{
    if (strcmp(integral->name, "h") == 0 || strcmp(integral->name, "H") == 0) return LONG_ENERGY;
    if (integral->known == ISO_ONE) return LONG_UNITS;
    if (integral->known == ISO_ZERO) return LONG_SPIN;
    return strncmp(integral->name, "F_", 2) == 0 ? LONG_SECOND : LONG_QUANTITIES;
}

static inline iso_status long_create(iso_context *ctx, const long_scene *scene, const hard_road *way,
                                     iso_orbit **orbit)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    o.effects = &scene->effects;
    o.backend = way->backend;
    o.method = way->method;
    o.tolerance = way->tolerance;
    o.clock = ISO_CLOCK_T;
    o.shown = way->backend == ISO_BACKEND_BALL ? ISO_SHOW_BALL : ISO_SHOW_BOTH;
    return iso_orbit_create(ctx, &scene->p, &scene->start, &o, orbit);
}

/* Energies and errors at the looks, and the first values of the integrals. */
typedef struct long_looks {
    double time[LONG_LOOKS], energy[LONG_LOOKS], log_time[LONG_LOOKS], log_error[LONG_LOOKS];
    double first[ISO_MAX_INTEGRALS];
    int count, errors;
} long_looks;

static inline double long_slope(const double x[], const double y[], int count, double *standard_error)
{
    double constant, slope, cov[3], chi2;
    gsl_fit_linear(x, 1, y, 1, (size_t)count, &constant, &slope, &cov[0], &cov[1], &cov[2], &chi2);
    *standard_error = sqrt(cov[2]);
    return slope;
}

static inline void long_look(const iso_orbit *orbit, const iso_sample *s, bool first, long_looks *looks,
                             long_run *run)
{
    const iso_system *system = iso_orbit_backend(orbit) == ISO_BACKEND_BALL ? &iso_system_ball : &iso_system_point;
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const int count = iso_integrals_holding(system, &iso_orbit_model(orbit)->problem, list, ISO_MAX_INTEGRALS);
    for (int i = 0; i < count; i++) {
        const int quantity = long_quantity(list[i]);
        double size;
        const double value = iso_orbit_integral(orbit, system, list[i], s, &size);
        if (first) looks->first[i] = list[i]->known == ISO_ONE ? 1 : list[i]->known == ISO_ZERO ? 0 : value;
        const double drift = (value - looks->first[i]) / size;
        if (quantity == LONG_ENERGY && !first) looks->energy[looks->count] = drift;
        if (quantity < LONG_QUANTITIES && !(fabs(drift) <= run->drift[quantity])) run->drift[quantity] = fabs(drift);
    }
}

static inline void long_fits(const long_looks *looks, long_run *run)
{
    double standard_error;
    const double slope = long_slope(looks->time, looks->energy, looks->count, &standard_error);
    run->trend = slope == 0 ? 0 : fabs(slope) / standard_error;
    run->growth =
        looks->errors > 10 ? long_slope(looks->log_time, looks->log_error, looks->errors, &standard_error) : NAN;
}

/* Runs the scene by one way for so many spins. Errors are measured against another way (NULL: no errors). */
static inline long_run long_follow(iso_context *ctx, const long_scene *scene, const hard_road *way, double spins,
                                   const hard_road *against)
{
    static long_looks looks;
    long_run run = {.spins = spins};
    iso_orbit *orbit, *truth = NULL;
    iso_sample s, right;
    looks = (long_looks){.count = 0};
    run.refused = long_create(ctx, scene, way, &orbit) != ISO_OK;
    snprintf(run.words, sizeof run.words, "%s", run.refused ? iso_context_message(ctx) : "");
    if (run.refused) return run;
    laws_stop_if(ctx, against && long_create(ctx, scene, against, &truth) != ISO_OK, "no reference");
    long_look(orbit, (iso_orbit_at(orbit, 0, &s), &s), true, &looks, &run);
    for (int i = 0; i < LONG_LOOKS; i++) {
        const double time = (i + 1) * spins / LONG_LOOKS * scene->spin;
        if (iso_orbit_at(orbit, time, &s) != ISO_OK) {
            snprintf(run.words, sizeof run.words, "%s", iso_context_message(ctx));
            run.error = run.drift[LONG_ENERGY] = NAN;
            break;
        }
        looks.time[i] = (double)(i + 1) / LONG_LOOKS;
        long_look(orbit, &s, false, &looks, &run);
        looks.count = i + 1;
        if (!truth) continue;
        laws_stop_if(ctx, iso_orbit_at(truth, time, &right) != ISO_OK, "the reference stops");
        const double error = hard_error(s.ball, right.ball);
        if (!(error <= run.error)) run.error = error;
        if (i < LONG_LOOKS / 100 || run.error == 0) continue;
        looks.log_time[looks.errors] = log(time);
        looks.log_error[looks.errors++] = log(run.error);
    }
    run.steps = iso_orbit_statistics(orbit).steps;
    long_fits(&looks, &run);
    iso_orbit_free(orbit), iso_orbit_free(truth);
    return run;
}

static inline bool long_is(const hard_road *way, const char *family)
{
    return way->method && strcmp(way->method->family, family) == 0;
}

/* The bound on the drift of a quantity:
 * - Splittings: symplectic.c chooses a step whose error is half a tolerance in each of the first 12 radians, 6
 *   tolerances in all. The energy's error is twice that. Later turns are at most twice as bad: 24 tolerances.
 * - taylor restores F, except for a tenth of the error of a step, where F hardly depends on omega.
 * - A quantity that is not restored drifts by the errors of all steps, F by that times the ratio of the moments. */
static inline double long_bound(const hard_road *way, const long_run *run, int quantity)
{
    const double added = (double)run->steps * way->tolerance;
    const bool splits = long_is(way, "splitting");
    if (!way->method) return LONG_ROUNDED;
    if (quantity == LONG_SECOND && long_is(way, "isoroll")) return fmax(LONG_ROUNDED, way->tolerance / 10);
    if (quantity == LONG_SECOND) return splits ? 24 * way->tolerance : 4 * added;
    if (way->method->projects || (splits && quantity != LONG_ENERGY)) return LONG_ROUNDED;
    return splits ? 24 * way->tolerance : added;
}

#endif
