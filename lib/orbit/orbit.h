/* orbit.h - one orbit: where is the ball, and where is the point, at any time of any clock.
 *
 *     iso_orbit *orbit;
 *     iso_orbit_options o = iso_orbit_defaults(&start);
 *     iso_orbit_create(ctx, &params, &start, &o, &orbit);
 *     iso_orbit_at(orbit, 100, &sample);                     sample.ball = omega, n at t = 100
 *     iso_orbit_free(orbit);
 *
 * The backends ball and point integrate (9) or (24), the backend exact evaluates the point's closed solution where
 * there is one (exact/exact.h), at any time at the same cost. All answer the same questions with the same calls.
 * Inside, everything is in the ball's own units; all numbers in and out are in the caller's.
 */
#ifndef ISO_ORBIT_ORBIT_H
#define ISO_ORBIT_ORBIT_H

#include "exact/exact.h"
#include "map/section.h"
#include "method/method.h"
#include "orbit/scene.h"

typedef struct iso_orbit iso_orbit;

typedef struct iso_orbit_options {
    const iso_effects *effects; /* what acts on the ball, in the caller's units; NULL: nothing           */
    /* What finds the orbit; ISO_BACKEND_AUTO: steps of the model of the start, of the ball where effects need it, of
     * the model that the method is for. */
    iso_backend backend;
    const iso_method *method;    /* NULL: iso_method_auto(); with ISO_BACKEND_EXACT always                    */
    double tolerance;            /* of the method                                                             */
    long max_steps;              /* after which a call fails with ISO_NUMERICAL; 0: no bound                  */
    iso_clock clock;             /* the clock in which times are asked                                        */
    iso_models shown;            /* the models filled into samples, not ISO_SHOW_START                        */
    bool gamma_alone;            /* of the point gamma is filled in, which always fits a double, but not M    */
    bool with_clock[ISO_CLOCKS]; /* other clocks filled into samples                                       */
    /* Bytes for the ends of its steps, at most, for each direction of time; 0: keeps none, enough if times only move
     * away from 0 (iso_orbit_at). */
    size_t memory;
} iso_orbit_options;

#define ISO_ORBIT_MEMORY ((size_t)1 << 23) /* 8 MB: 28000 turns of a free ball by taylor at 1e-12 */

/* Backend and clock of the start's own model, which is also shown; method auto, tolerance 1e-12, no
 * bound on the steps; ends of steps in ISO_ORBIT_MEMORY bytes. */
static inline iso_orbit_options iso_orbit_defaults(const iso_start *start)
{
    iso_orbit_options o = {0};
    o.backend = ISO_BACKEND_AUTO;
    o.tolerance = 1e-12;
    o.memory = ISO_ORBIT_MEMORY;
    o.clock = start->model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    o.shown = start->model == ISO_BALL ? ISO_SHOW_BALL : ISO_SHOW_POINT;
    return o;
}

/* One moment of an orbit. The numbers stand in the order of the columns (iso_column_name); what was not asked for is
 * NaN. */
typedef struct iso_sample {
    double clock[ISO_CLOCKS];          /* t, tau, s: all 0 at the start                            */
    double ball[ISO_STATE];            /* omega, n                                                 */
    double point[ISO_STATE];           /* M, gamma                                                 */
    double effect[ISO_EFFECT_COLUMNS]; /* the columns of effects                          */
} iso_sample;

/* The number in the column called `name`, such as "pressure" or "e1"; NaN where there is no such column. */
double iso_sample_get(const iso_sample *sample, const char *name);

/* A point's orbit has a ball at every energy: off the level H = 0 in the potential of the effect `level`, which is
 * then added. Errors:
 * - ISO_NOT_MAPPED if the other model is needed and has no such orbit. A free ball at rest (h = 0) has no point, and
 *   neither has a ball with an effect that breaks the isomorphism (iso_context_about names it).
 * - ISO_BAD_INPUT if numbers of effects make no sense (iso_effects_check).
 * - ISO_NUMERICAL if M or a clock that is asked for does not fit a double in the caller's units. For an extreme k the
 *   powers q^(1/(2k)) in M and in the clocks do not fit. Nor does q^(1/k), which only points off H = 0 and methods
 *   for (24) alone need. A free ball, and gamma in t, can be had for every k by all other methods.
 * - Of ISO_BACKEND_EXACT: ISO_BAD_ARGUMENT about "method", and the errors of iso_exact_create.
 * - ISO_NO_MEMORY. */
iso_status iso_orbit_create(iso_context *ctx, const iso_params *params, const iso_start *start,
                            const iso_orbit_options *options, iso_orbit **orbit);
void iso_orbit_free(iso_orbit *orbit);

/* The orbit at `time` of the options' clock, before or after the start. The order of the calls does not change a
 * bit. Times that move away from the start are cheap. An earlier time is found in microseconds from a step's end
 * that was kept (options.memory):
 * - taylor and splittings keep every fourth end, and take up to 4 steps again. taylor needs 24 bytes for an end, and
 *   8 for each number of the state and of three clocks: a free ball at 1e-12 takes 300 bytes a turn. When memory is
 *   full, they keep every eighth, then every sixteenth, and so on.
 * - Other methods keep every end. When memory is full, they forget the older half.
 * - bdf keeps nothing, nor does any method with memory for fewer than 16 ends.
 * A time before the first end that is kept is found from the start again.
 * A ball that resistance brings to rest slows down to 1e-290 of its own unit of speed, then stands still. Backwards,
 * where resistance drives it, it is followed until it turns 1e4 times as fast as at the start.
 * Errors: ISO_BAD_ARGUMENT (a time that iso_orbit_check_time refuses), ISO_NUMERICAL (what stopped, and where; or
 * a result that does not fit a double, or lost its digits). */
iso_status iso_orbit_at(iso_orbit *orbit, double time, iso_sample *sample);

/* The first zero of g(sample) after `from`, not after `to`; see iso_integrator_event. direction as there. The sample
 * that g sees has no time (NaN) in the options' clock, only the clocks carried. Errors: as iso_orbit_at, and
 * ISO_NUMERICAL when g is not finite. */
iso_status iso_orbit_event(iso_orbit *orbit, double (*g)(const iso_sample *sample, const void *data),
                           const void *data, int direction, double from, double to, bool *found, iso_sample *sample);

/* The first time after `from`, not after `to`, at which the support would have to pull the ball: `pressure` falls
 * through 0. A touch is no loss. On a plane the pressure does not change. Needs the effect `reactions`. Errors: as
 * iso_orbit_event. */
iso_status iso_orbit_lost_contact(iso_orbit *orbit, double from, double to, bool *lost, iso_sample *sample);

iso_statistics iso_orbit_statistics(const iso_orbit *orbit);

/* What the orbit is made of: the backend (not ISO_BACKEND_AUTO), the model in own units, the units, the method. */
iso_backend iso_orbit_backend(const iso_orbit *orbit);
const iso_method *iso_orbit_method(const iso_orbit *orbit);

/* Whether the orbit has both models: no effect that breaks the isomorphism, and a ball that moves. */
bool iso_orbit_has_twin(const iso_orbit *orbit);

/* Energy h of the ball and coupling eps of the point in the caller's units (infinite or 0 where they do not fit). */
double iso_orbit_energy(const iso_orbit *orbit);
double iso_orbit_coupling(const iso_orbit *orbit);

/* An integral of either system at a sample that shows it: its value and the measure of its drift, in own units
 * (times iso_unit(units, integral->dimension) in the caller's). */
double iso_orbit_integral(const iso_orbit *orbit, const iso_system *system, const iso_integral *integral,
                          const iso_sample *sample, double *size);

/* One integral along an orbit, in the model of `system`. What it should be: a constraint its exact value; H of a point
 * on a known level the level's value; every other integral its value at the start. */
typedef struct iso_drift {
    const iso_system *system;
    const iso_integral *integral;
    double start;    /* its value at the start, in the caller's units: 0 within rounding, infinite if it overflows */
    double expected; /* what it should be, in own units                                                    */
    double now, worst; /* (I - expected) / size at the last sample, see iso_integral; largest size of that so far */
} iso_drift;

#endif
