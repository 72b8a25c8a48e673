/* exact_method.c - the closed solution as a method: the state at any time, without steps.
 *
 * It stands here and not in the registry of methods for two reasons: methods stand below the closed solutions in the
 * library, and a user chooses it as a backend. Only a search for events follows the orbit step by step; in a step the
 * state changes by half its size.
 */
#include <stdlib.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "exact/exact_impl.h"
#include "method/integrator_impl.h"
#include "orbit/orbit_impl.h"

typedef struct closed {
    iso_exact *exact; /* made from the state at the start, see start() */
    bool even;        /* times follow each other in even steps         */
    iso_exact_walk walk;
} closed;

static iso_status create(iso_integrator *it)
{
    it->data = calloc(1, sizeof(closed));
    return it->data ? ISO_OK : iso_context_no_memory(it->ctx, "a closed solution");
}

static void release(iso_integrator *it)
{
    closed *c = it->data;
    if (c) iso_exact_free(c->exact);
    free(c);
}

static iso_status start(iso_integrator *it)
{
    const iso_model *m = &it->model;
    closed *c = it->data;
    bool clocks[ISO_CLOCKS] = {false};
    clocks[m->clock] = true;
    for (int i = 0; i < m->clocks; i++) clocks[m->clock_of[i]] = true;
    iso_exact_free(c->exact);
    *c = (closed){0};
    const iso_status status = iso_exact_create(it->ctx, &m->problem, it->y0, clocks, &c->exact);
    if (status != ISO_BAD_ARGUMENT) return status;
    return iso_context_fail(it->ctx, status, iso_context_about(it->ctx), "%s: take backend point",
                            iso_context_message(it->ctx));
}

static iso_status at(iso_integrator *it, double t, double y[])
{
    const iso_model *m = &it->model;
    closed *c = it->data;
    double state[ISO_MAX_STATE], clocks[ISO_CLOCKS];
    it->statistics.states++;
    ISO_TRY(c->even ? iso_exact_walk_to(it->ctx, c->exact, &c->walk, m->clock, t, state, clocks)
                    : iso_exact_at(it->ctx, c->exact, m->clock, t, state, clocks));
    for (int i = 0; i < m->clocks; i++) state[m->moving + i] = clocks[m->clock_of[i]];
    if (!all_finite(state, m->dim)) return iso_integrator_stopped(it, "the closed solution is not finite");
    copy(state, y, m->dim);
    return ISO_OK;
}

static iso_status dense(iso_integrator *it, double dt, double y[])
{
    return at(it, it->left.head + (it->left.tail + dt), y);
}

/* The state after the time in which, at this rate, it changes by half its size. */
static iso_status part_of_change(iso_integrator *it, double t, double rate, double y[], double *h)
{
    const double next = t + it->direction * (rate > 0 ? 0.5 / rate : 1);
    *h = next - t;
    return at(it, next, y);
}

/* The step is shortened where the state changes more than twice as fast at the step's end as at its beginning. */
static iso_status step(iso_integrator *it, double y[], double *h)
{
    const double t = iso_instant_later(it->left, it->h).head, here = iso_integrator_rate(it, y);
    const iso_status status = part_of_change(it, t, here, y, h);
    const double there = status == ISO_OK ? iso_integrator_rate(it, y) : 0;
    return there > 2 * here ? part_of_change(it, t, there, y, h) : status;
}

const iso_method iso_method_exact = {.name = "exact",
                                     .family = "isoroll",
                                     .doc = "the closed solution: no steps, any time at the same cost",
                                     .projects = true,
                                     .own_equations = true,
                                     .system = &iso_system_point,
                                     .create = create,
                                     .start = start,
                                     .step = step,
                                     .dense = dense,
                                     .at = at,
                                     .free = release};

static closed *closed_of(const iso_orbit *o)
{
    return o->options.backend == ISO_BACKEND_EXACT ? o->integrator->data : NULL;
}

const iso_exact *iso_orbit_exact(const iso_orbit *o)
{
    const closed *c = closed_of(o);
    return c ? c->exact : NULL;
}

void iso_orbit_expect_even_times(iso_orbit *o)
{
    closed *c = closed_of(o);
    if (c) c->even = true;
}
