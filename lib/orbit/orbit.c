/* orbit.c - one orbit from its start to the samples at any time.
 *
 * The files of an orbit stand in layers. Each calls only those below it:
 *
 *     orbit.c                          prepares an orbit and follows it
 *     orbit_start.c, orbit_sample.c    the start in own units; samples in the caller's
 *     orbit_common.c                   what an orbit is made of, and how it is prepared
 */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

/* --- making an orbit -------------------------------------------------------------------------------------------- */

/* Effects that only the ball shows need the ball, and some methods are for one system. */
static iso_backend choose_backend(const iso_orbit_options *opt, const iso_effects *e, const iso_start *start)
{
    if (opt->backend != ISO_BACKEND_AUTO) return opt->backend;
    if (opt->method && opt->method->system)
        return opt->method->system == &iso_system_ball ? ISO_BACKEND_BALL : ISO_BACKEND_POINT;
    return iso_effects_breaking(e) || iso_effects_ball_only(e) ? ISO_BACKEND_BALL : (iso_backend)start->model;
}

/* Makes an orbit empty, to be prepared: but not the texts of effects, and of formulas only what says how long they are.
 * Clearing all 16 kB would cost time in batches. */
static void clear(iso_orbit *o)
{
    iso_problem *f = &o->model.problem;
    char *const behind_effects = (char *)(&o->effects + 1), *const behind = (char *)(f + 1);
    memset(o, 0, offsetof(iso_orbit, effects) + offsetof(iso_effects, written));
    memset(behind_effects, 0, (size_t)((char *)&f->effects - behind_effects));
    memset(f->at, 0, sizeof f->at);
    memset(&f->motion, 0, offsetof(iso_formula, late_line));
    memset(&f->energy_formula, 0, offsetof(iso_formula, late_line));
    memset(behind, 0, (size_t)((char *)(o + 1) - behind));
}

iso_status iso_orbit_prepare(iso_orbit *o, iso_context *ctx, const iso_orbit_options *options, const iso_params *p,
                             const iso_start *start, double y[ISO_MAX_STATE])
{
    iso_orbit_options *opt = &o->options;
    iso_model *model = &o->model;
    iso_problem *problem = &model->problem;
    double six[ISO_STATE], size;
    clear(o);
    o->ctx = ctx;
    *opt = *options;
    if (opt->effects) o->effects = *opt->effects;
    iso_start_settle(p, start, &o->effects);
    opt->backend = choose_backend(opt, &o->effects, start);
    const bool ball = opt->backend == ISO_BACKEND_BALL, exact = opt->backend == ISO_BACKEND_EXACT;
    if ((!ball && !exact && opt->backend != ISO_BACKEND_POINT) || (int)opt->shown < 0 || opt->shown > ISO_SHOW_BOTH)
        return ISO_FAIL_ARGUMENT(
            ctx, "backend", "an orbit is found by backend ball, point or exact, and shown as ball, point or both");
    if (exact && opt->method && opt->method != &iso_method_exact)
        return ISO_FAIL_ARGUMENT(ctx, "method",
                                 "backend exact does not integrate: leave the method out, or take backend point");
    const iso_status status = iso_orbit_find_start(o, p, start, six);
    if (status == ISO_NUMERICAL && options->backend == ISO_BACKEND_AUTO && !opt->method && !ball) {
        iso_orbit_options by_ball = *options;
        by_ball.backend = ISO_BACKEND_BALL;
        return iso_orbit_prepare(o, ctx, &by_ball, p, start, y);
    }
    if (status != ISO_OK) return status;
    problem->p = o->units.own, problem->eps = o->eps, problem->energy = o->level;
    iso_effects_copy(&o->effects, &problem->effects);
    iso_model_complete(model, o->system, opt->clock, opt->with_clock);
    iso_model_begin(model, six, y);
    if (ball) problem->energy = iso_system_ball.energy(problem, y, &size);
    if (!opt->method) opt->method = exact ? &iso_method_exact : iso_method_auto(model);
    model->rhs(model, y, o->rate);
    copy(y, o->still, model->dim);
    o->rests = true;
    for (int i = 0; i < model->moving; i++) o->rests = o->rests && o->rate[i] == 0;
    return ISO_OK;
}

iso_status iso_orbit_create(iso_context *ctx, const iso_params *p, const iso_start *start,
                            const iso_orbit_options *options, iso_orbit **orbit)
{
    ISO_DEFAULT_ARITHMETIC;
    const iso_orbit_options opt = options ? *options : iso_orbit_defaults(start);
    double y[ISO_MAX_STATE];
    *orbit = NULL;
    iso_orbit *o = calloc(1, sizeof *o);
    if (!o) return iso_context_no_memory(ctx, "an orbit");
    iso_status status = iso_orbit_prepare(o, ctx, &opt, p, start, y);
    const iso_method_options m = {.tolerance = opt.tolerance,
                                  .time_unit = o->unit_clock[opt.clock],
                                  .max_steps = opt.max_steps,
                                  .memory = opt.memory};
    if (status == ISO_OK) status = iso_integrator_create(ctx, o->options.method, &o->model, &m, &o->integrator);
    if (status == ISO_OK) status = iso_integrator_start(o->integrator, y);
    if (status != ISO_OK) return iso_orbit_free(o), status;
    *orbit = o;
    return ISO_OK;
}

void iso_orbit_free(iso_orbit *o)
{
    if (!o) return;
    iso_integrator_free(o->integrator);
    free(o);
}

/* --- following it ----------------------------------------------------------------------------------------------- */

double iso_orbit_fastest(const iso_orbit *o)
{
    const iso_params *own = &o->units.own;
    const iso_clock clock = o->model.clock;
    return clock == ISO_CLOCK_T
               ? 1
               : fmax(iso_clock_rate(own, clock, min3(own->J), NULL), iso_clock_rate(own, clock, max3(own->J), NULL));
}

/* Where a model is stiff, steps of an explicit method are about as short as the time in which the fastest motion dies
 * away, however smooth the rest is. So many take seconds. */
#define MOST_STIFF_STEPS 1e6

/* Beyond 1e15 turns a double does not tell one part of a turn from another (and no one would live to see it). */
static iso_status to_own_time(const iso_orbit *o, double time, double *own_time)
{
    const iso_problem *f = &o->model.problem;
    const iso_clock clock = o->model.clock;
    *own_time = time / o->unit_clock[clock];
    const double turns = *own_time / iso_orbit_fastest(o), stiffness = iso_effects_stiffness(f);
    if (o->rests && isfinite(*own_time)) return ISO_OK; /* what rests has no turns */
    if (!(fabs(turns) <= 1e15))
        return ISO_FAIL_ARGUMENT(o->ctx, "end",
                                 "%s = %g is out of range: it is %g turns of this ball, and 1e15 can be told apart",
                                 iso_clock_name(clock), time, turns);
    const double steps = stiffness * fmin(turns, iso_effects_moving(f));
    if (o->options.method->implicit || !(stiffness > ISO_STIFF && steps > MOST_STIFF_STEPS)) return ISO_OK;
    return ISO_FAIL_ARGUMENT(o->ctx, "method",
                             "this model is stiff: what resists acts %.1g times as fast as the ball turns, and %s, "
                             "which is explicit, would take about %.1g steps: take bdf or bsimp",
                             stiffness, o->options.method->name, steps);
}

iso_status iso_orbit_check_time(const iso_orbit *o, double time)
{
    ISO_DEFAULT_ARITHMETIC;
    double own_time;
    return to_own_time(o, time, &own_time);
}

/* A method that cannot be projected keeps the energy as well as its tolerance lets it: where it has lost it by more
 * than a thousandth, and by more than 1e4 tolerances, the state is no answer any more. */
static iso_status check_drift(const iso_orbit *o, const double y[])
{
    double size;
    if (o->options.method->projects || !iso_effects_keep_energy(&o->model.problem)) return ISO_OK;
    const double energy = o->model.system->energy(&o->model.problem, y, &size);
    const double drift = size > 0 ? fabs(energy - o->model.problem.energy) / size : 0;
    if (drift <= fmax(1e-3, 1e4 * o->options.tolerance)) return ISO_OK;
    return ISO_FAIL_NUMERICAL(
        o->ctx, "%s has lost the energy (by %.1g of it): take the other backend, or a method with projection",
        o->options.method->name, drift);
}

iso_status iso_orbit_at(iso_orbit *o, double time, iso_sample *sample)
{
    ISO_DEFAULT_ARITHMETIC;
    double own_time, y[ISO_MAX_STATE];
    ISO_TRY(to_own_time(o, time, &own_time));
    for (int i = 0; o->rests && i < o->model.dim; i++) y[i] = o->still[i] + o->rate[i] * own_time;
    if (!o->rests) ISO_TRY(iso_integrator_at(o->integrator, own_time, y));
    ISO_TRY(check_drift(o, y));
    return iso_orbit_make_sample(o, time, y, sample);
}

typedef struct sampled_event {
    const iso_orbit *orbit;
    double (*g)(const iso_sample *sample, const void *data);
    const void *data;
    iso_status *status; /* the first failure of a sample */
} sampled_event;

/* The search wants numbers: after a failure, which ends it, it gets zeros. */
static double event_function(const iso_model *model, const double y[], const void *data)
{
    const sampled_event *e = data;
    iso_sample sample;
    (void)model;
    if (*e->status == ISO_OK) *e->status = iso_orbit_make_sample(e->orbit, NAN, y, &sample);
    return *e->status == ISO_OK ? e->g(&sample, e->data) : 0;
}

iso_status iso_orbit_event(iso_orbit *o, double (*g)(const iso_sample *sample, const void *data), const void *data,
                           int direction, double from, double to, bool *found, iso_sample *sample)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_status sampled = ISO_OK;
    const sampled_event wrapped = {o, g, data, &sampled};
    const iso_event event = {event_function, &wrapped, direction};
    double begin, end, own_time, y[ISO_MAX_STATE];
    *found = false;
    ISO_TRY(to_own_time(o, from, &begin));
    ISO_TRY(to_own_time(o, to, &end));
    if (o->rests && o->model.clocks == 0) return ISO_OK; /* nothing passes anything */
    iso_status status = iso_integrator_event(o->integrator, &event, begin, end, found, &own_time, y);
    if (status == ISO_OK) status = sampled;
    if (status != ISO_OK) *found = false;
    return *found ? iso_orbit_make_sample(o, own_time * o->unit_clock[o->model.clock], y, sample) : status;
}

static double pressure(const iso_sample *sample, const void *data)
{
    (void)data;
    return iso_sample_get(sample, "pressure");
}

iso_status iso_orbit_lost_contact(iso_orbit *o, double from, double to, bool *lost, iso_sample *sample)
{
    *lost = false;
    if (o->model.problem.p.k == 1)
        return ISO_OK; /* on a plane the pressure is mgb (e,n), an integral: what it changes by is error */
    return iso_orbit_event(o, pressure, NULL, to < 0 ? 1 : -1, from, to, lost, sample);
}

double iso_orbit_reached(const iso_orbit *o)
{
    double own_time, y[ISO_MAX_STATE];
    iso_integrator_last(o->integrator, &own_time, y);
    return own_time * o->unit_clock[o->model.clock];
}

void iso_orbit_allow_steps(iso_orbit *o, long max_steps)
{
    o->options.max_steps = o->integrator->options.max_steps = max_steps;
}

iso_statistics iso_orbit_statistics(const iso_orbit *o)
{
    return iso_integrator_statistics(o->integrator);
}

const iso_integral *iso_orbit_additional_integral(const iso_orbit *o)
{
    for (const iso_integral *i = iso_system_ball.integrals + 1; i->name; i++)
        if (i->known == ISO_ANY_VALUE && (!i->holds || i->holds(&o->model.problem))) return i;
    return NULL;
}
