/* cost_walk.c - orbits of one scene, within a time limit, and how far they are from each other. */
#include <math.h>
#include <stdlib.h>

#include "base/context_impl.h"
#include "base/vec3_impl.h"
#include "orbit/watch_impl.h"
#include "task/cost/cost_impl.h"

/* --- the scene, and its monitor --------------------------------------------------------------------------------- */

/* Of so many calls one looks at the clock. It is called at each step, and must not slow down what is measured. */
enum { CALLS = 64 };

static bool go_on(void *data)
{
    cost_monitor *w = data;
    if (w->stopped || w->late) return false;
    if (w->calls++ % CALLS != 0) return true;
    w->stopped = !iso_context_goes_on(w->user);
    w->late = isfinite(w->deadline) && processor_seconds() > w->deadline;
    return !w->stopped && !w->late;
}

/* From now on everything that uses p->ctx stops after so many seconds. */
static void allow(cost_problem *p, double seconds)
{
    p->monitor.deadline = processor_seconds() + seconds;
    p->monitor.late = false;
    p->monitor.calls = 0;
}

bool iso_cost_is_stopped(cost_problem *p)
{
    if (!p->monitor.stopped) p->monitor.stopped = !iso_context_goes_on(p->user);
    return p->monitor.stopped;
}

static iso_status check_scene(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                              const iso_cost_options *o)
{
    iso_orbit *orbit;
    iso_orbit_options options = iso_orbit_defaults(&scene->start);
    options.effects = effects;
    options.backend = o->backend;
    options.method = o->method;
    if (o->tolerance != 0) options.tolerance = o->tolerance;
    iso_status status = iso_orbit_create(ctx, &scene->params, &scene->start, &options, &orbit);
    if (status == ISO_OK) status = iso_orbit_check_time(orbit, scene->end);
    iso_orbit_free(orbit);
    if (status == ISO_OK && scene->end == 0)
        return ISO_FAIL_ARGUMENT(ctx, "end", "the scene ends where it begins: nothing is to be measured");
    return status;
}

iso_status iso_cost_problem_open(cost_problem *p, iso_context *user, const iso_scene *scene,
                                 const iso_cost_options *o)
{
    *p = (cost_problem){.user = user, .scene = scene, .effects = iso_scene_acting(scene)};
    p->monitor = (cost_monitor){.user = user, .deadline = INFINITY};
    p->clock = iso_orbit_defaults(&scene->start).clock;
    p->other = p->clock == ISO_CLOCK_T ? ISO_CLOCK_S : ISO_CLOCK_T;
    p->end = scene->end;
    ISO_TRY(check_scene(user, scene, &p->effects, o));
    p->ctx = iso_context_create();
    if (!p->ctx) return iso_context_no_memory(user, "a context");
    return ISO_OK;
}

void iso_cost_problem_close(cost_problem *p)
{
    iso_context_free(p->ctx);
}

iso_status iso_cost_orbit_open(cost_problem *p, iso_backend backend, const iso_method *method, double tolerance,
                               bool with_clock, iso_orbit **orbit)
{
    iso_orbit_options o = iso_orbit_defaults(&p->scene->start);
    o.effects = &p->effects;
    o.backend = backend;
    o.method = method;
    if (method) o.tolerance = tolerance;
    o.shown = ISO_SHOW_BALL;
    o.with_clock[p->other] = with_clock;
    iso_context_set_monitor(p->ctx, go_on, &p->monitor); /* by its address: here the problem no longer moves */
    return iso_orbit_create(p->ctx, &p->scene->params, &p->scene->start, &o, orbit);
}

/* --- tracks ----------------------------------------------------------------------------------------------------- */

iso_status iso_cost_track_make(cost_problem *p, int times, const double time[], cost_track *track)
{
    *track = (cost_track){.times = times, .time = time, .row = calloc((size_t)times, sizeof *track->row)};
    return track->row ? ISO_OK : iso_context_no_memory(p->user, "%d rows", times);
}

void iso_cost_track_free(cost_track *track)
{
    free(track->row);
    track->row = NULL;
}

static iso_status walk(cost_problem *p, iso_orbit *orbit, double seconds, cost_track *track)
{
    iso_sample sample;
    iso_drift integral[ISO_MAX_INTEGRALS];
    const double begin = processor_seconds();
    iso_status status = iso_orbit_at(orbit, 0, &sample);
    if (status != ISO_OK) return status;
    const int integrals = iso_watch_begin(orbit, &iso_system_ball, NAN, &sample, integral, ISO_MAX_INTEGRALS);
    for (int i = 0; status == ISO_OK && i < track->times; i++) {
        status = iso_orbit_at(orbit, track->time[i], &sample);
        track->seconds = processor_seconds() - begin;
        if (status != ISO_OK) break;
        copy(sample.ball, track->row[i].ball, ISO_STATE);
        track->row[i].clock = sample.clock[p->other];
        track->reached++;
        iso_watch_follow(orbit, &sample, integral, integrals);
        const double share = track->time[i] / track->time[track->times - 1]; /* of the whole, judged by which ... */
        const bool long_enough = i + 1 < track->times && share > 0 && track->seconds > seconds / 8;
        if (long_enough && track->seconds / share > 1.5 * seconds) status = ISO_STOPPED; /* ... it takes longer */
    }
    track->energy_drift = track->constraint_drift = NAN;
    for (int i = 0; i < integrals; i++) {
        const bool energy = integral[i].integral->value == iso_system_ball.energy;
        double *most = energy ? &track->energy_drift : &track->constraint_drift;
        if (energy || integral[i].integral->known != ISO_ANY_VALUE) *most = fmax(*most, integral[i].worst);
    }
    return status;
}

iso_status iso_cost_walk(cost_problem *p, iso_backend backend, const iso_method *method, double tolerance,
                         bool with_clock, double seconds, cost_track *track)
{
    iso_orbit *orbit;
    track->reached = 0;
    track->seconds = 0;
    allow(p, 1.5 * seconds);
    iso_status status = iso_cost_orbit_open(p, backend, method, tolerance, with_clock, &orbit);
    if (status == ISO_OK) {
        status = walk(p, orbit, seconds, track);
        track->statistics = iso_orbit_statistics(orbit);
        iso_orbit_free(orbit);
    }
    if (status == ISO_STOPPED) iso_context_fail(p->ctx, ISO_STOPPED, "", "it would take too long");
    allow(p, INFINITY);
    return status;
}

/* --- distances -------------------------------------------------------------------------------------------------- */

static int both_reached(const cost_track *a, const cost_track *b)
{
    return a->reached < b->reached ? a->reached : b->reached;
}

double iso_cost_distance(const cost_track *a, const cost_track *b)
{
    double most = 0;
    for (int i = 0; i < both_reached(a, b); i++) most = fmax(most, iso_distance(a->row[i].ball, b->row[i].ball));
    return most;
}

double iso_cost_clock_distance(const cost_track *a, const cost_track *b)
{
    double most = 0, size = 0;
    for (int i = 0; i < both_reached(a, b); i++) {
        const double off = fabs(a->row[i].clock - b->row[i].clock);
        if (isnan(off)) return NAN;
        most = fmax(most, off);
        size = fmax(size, fabs(a->row[i].clock));
    }
    return size > 0 ? most / size : NAN;
}
