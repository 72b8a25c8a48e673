/* cost_growth.c - how error and time grow with the length of an orbit. */
#include "study/cost.h"

iso_status iso_cost_grow(iso_context *ctx, const iso_scene *scene, const iso_cost_cell *cell, int horizons,
                         iso_cost_growth *growth)
{
    (void)scene, (void)cell, (void)horizons;
    *growth = (iso_cost_growth){0};
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "horizons", "not made yet");
}
