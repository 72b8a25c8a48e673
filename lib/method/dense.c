/* dense.c - the state at a time within a step, for methods without `dense`: from the step's left end by GSL's rk8pd,
 * or by its bsimp where "auto" would take an implicit method. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/context_impl.h"
#include "base/vec3_impl.h"
#include "method/gsl_impl.h"
#include "method/methods_impl.h"

enum { MOST_STEPS = 100000 }; /* to one time; as a rule it needs one */

struct iso_dense {
    iso_gsl gsl;
};

iso_status iso_dense_create(iso_integrator *it)
{
    const iso_method *best = iso_method_auto(&it->model);
    const bool implicit = best && best->implicit;
    iso_dense *dense = calloc(1, sizeof *dense);
    if (!dense) return iso_context_no_memory(it->ctx, "an integrator");
    const iso_status status = iso_gsl_open(it, implicit ? gsl_odeiv2_step_bsimp : gsl_odeiv2_step_rk8pd, &dense->gsl);
    if (status != ISO_OK) return free(dense), status;
    it->dense = dense;
    return ISO_OK;
}

void iso_dense_free(iso_dense *dense)
{
    if (!dense) return;
    iso_gsl_close(&dense->gsl);
    free(dense);
}

iso_status iso_dense_at(iso_integrator *it, double dt, double y[])
{
    iso_gsl *g = &it->dense->gsl;
    double state[ISO_MAX_STATE], h;
    copy(it->at_left, state, it->model.dim);
    iso_gsl_start(g, state, dt);
    for (long steps = 0; g->t != dt; steps++) {
        if (!iso_context_goes_on(it->ctx)) return iso_context_stopped(it->ctx);
        ISO_TRY(iso_gsl_step(it, g, dt, state, &h));
        if (steps > MOST_STEPS) return iso_integrator_stopped(it, "too many steps between its own");
        if (g->t != dt && fabs(h) <= 64 * DBL_EPSILON * fabs(g->t))
            return iso_integrator_stopped(it, "steps between its own shrink to nothing");
    }
    if (it->method->projects) iso_integrator_project(it, state);
    copy(state, y, it->model.dim);
    return ISO_OK;
}
