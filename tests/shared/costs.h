/* costs.h - scenes whose cost is measured. */
#ifndef ISO_TESTS_COSTS_H
#define ISO_TESTS_COSTS_H

#include "scenes.h"
#include "task/cost/cost.h"

static inline iso_scene cost_scene(iso_context *ctx, double k, const double J[3], double end)
{
    static const double omega[3] = {0.8, -0.6, 0}, normal[3] = {0.36, 0.48, 0.8};
    iso_scene s = iso_scene_default();
    s.params = laws_params(k, J);
    s.end = end;
    laws_stop_if(ctx, iso_start_ball(ctx, omega, normal, ISO_SPIN_REFUSE, &s.start) != ISO_OK, "a start");
    return s;
}

static inline iso_scene cost_plane(iso_context *ctx)
{
    return cost_scene(ctx, 1, (const double[]){1, 2, 4}, 40);
}

/* The measured cost. A machine that is too slow for a reference in this time gets more of it. Ends the test when there
 * is none. */
static inline iso_cost *cost_of(iso_context *ctx, const iso_scene *scene, const iso_cost_options *o)
{
    iso_cost_options longer = *o;
    iso_cost *c;
    while (iso_cost_measure(ctx, scene, &longer, &c) != ISO_OK) {
        laws_stop_if(ctx, !strstr(iso_context_message(ctx), "too long") || longer.seconds > 100, "a measurement");
        longer.seconds *= 4;
    }
    return c;
}

static inline bool cost_is_measured(const iso_cost_cell *cell)
{
    return cell->status == ISO_OK && cell->repeats > 0;
}

#endif
