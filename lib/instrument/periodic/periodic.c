/* periodic.c - the periodic orbits of a scene's ball, see periodic.h: what is refused, the order of work, the list.
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include "instrument/periodic/periodic.h"

#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "instrument/periodic/periodic_impl.h"
#include "instrument/periodic/stability_chart.h"
#include "map/section_impl.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

ISO_NAMES(iso_stability_name, int, "stable", "unstable", "inverse", "degenerate", "undecided")

/* --- what is refused -------------------------------------------------------------------------------------------- */

static iso_status check_scene(iso_periodic_work *w)
{
    static const char what[] = "periodic orbits are sought";
    const iso_periodic_options *o = &w->options;
    const double k = w->scene->params.k, *J = w->scene->params.J, ratio = max3(J) / min3(J) / fabs(k);
    const iso_effects effects = iso_scene_acting(w->scene);
    if (o->period < 1 || o->period > ISO_PERIODIC_MOST)
        return ISO_FAIL_ARGUMENT(w->ctx, "period", "a period of %d: give 1 to %d", o->period, ISO_PERIODIC_MOST);
    if (o->grid < 1 || o->grid > 10000000)
        return ISO_FAIL_ARGUMENT(w->ctx, "grid", "a grid of %ld points: give 1 to 1e7", o->grid);
    if (!iso_return_build_of(o->polish))
        return ISO_FAIL_ARGUMENT(w->ctx, "polish", "this build has no numbers of 128 bits");
    ISO_TRY(iso_refuse_beyond_level(w->ctx, &effects, what));
    if (fabs(k) < ISO_LEAST_K)
        return ISO_FAIL_INPUT(w->ctx, "k", "k = %s: periodic orbits are sought only for |k| >= %s", ISO_SHORT(k),
                              ISO_SHORT(ISO_LEAST_K));
    if (!(ratio <= 1e5)) /* beyond, orbits pass so near to unstable rotations that no digits are left */
        return ISO_FAIL_INPUT(
            w->ctx, "J", "max J/(min J |k|) is %.3g: periodic orbits are sought only where it is 1e5 at most", ratio);
    ISO_TRY(iso_refuse_equal_moments(w->ctx, J, "no periodic orbit is isolated"));
    ISO_TRY(iso_refuse_rest(w->ctx, &w->scene->start, &effects, "has no periodic orbits of its energy"));
    ISO_TRY(iso_level_find(w->ctx, w->scene, what, &w->on));
    w->out->level = iso_level_of(&w->on.units.own, w->on.energy);
    const double slow = 1 / sqrt(iso_coupling(&w->on.units.own, w->on.h));
    for (iso_clock c = 0; c < ISO_CLOCKS; c++)
        w->unit_clock[c] = slow * iso_unit(&w->on.units, iso_clock_dimension(c));
    if (isfinite(w->unit_clock[ISO_CLOCK_T])) return ISO_OK;
    return ISO_FAIL_INPUT(w->ctx, "angular_velocity",
                          "the energy of this start is too large or too small for doubles");
}

/* --- the work --------------------------------------------------------------------------------------------------- */

static int by_period(const void *a, const void *b)
{
    const iso_periodic_orbit *one = a, *other = b;
    if (one->period != other->period) return one->period < other->period ? -1 : 1;
    return (one->trace > other->trace) - (one->trace < other->trace);
}

static iso_status work(iso_periodic_work *w)
{
    ISO_TRY(check_scene(w));
    iso_periodic_map_prepare(w->ctx, &w->on.units.own, w->on.energy, w->options.threads, &w->map);
    w->out->axis = w->map.axis;
    for (int a = 0; a < 3; a++) /* an end of an axis is the last place that can be reached */
        w->out->closed = w->out->closed || !iso_hill_has_rotation(w->map.p.k, w->map.p.J, w->on.energy, a);
    w->out->longest = w->options.period;
    iso_status status = iso_periodic_rotations(w);
    if (w->options.rotations_alone) return status;
    if (status == ISO_OK && !(w->options.all && w->options.no_lines)) status = iso_periodic_search(w);
    if (status == ISO_OK && w->options.all) status = iso_periodic_from_grid(w);
    iso_periodic *out = w->out;
    if (out->count > 0) qsort(out->orbit, out->count, sizeof *out->orbit, by_period);
    for (size_t i = 0; i < out->count; i++) out->orbit[i].number = i + 1, out->orbit[i].polished = w->options.polish;
    for (int a = 0; a < 3; a++) out->rotation[a].polished = w->options.polish && !out->rotation[a].oscillates;
    return status;
}

iso_status iso_periodic_run(iso_context *ctx, const iso_scene *scene, const iso_periodic_options *options,
                            iso_periodic **found)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_periodic_work w = {.ctx = ctx, .scene = scene, .options = iso_periodic_defaults()};
    *found = NULL;
    if (options) w.options = *options;
    w.out = calloc(1, sizeof *w.out);
    if (!w.out) return iso_context_no_memory(ctx, "periodic orbits");
    iso_status status = work(&w);
    if (status != ISO_OK && status != ISO_STOPPED) iso_periodic_free(w.out), w.out = NULL;
    *found = w.out;
    return status;
}

void iso_periodic_free(void *found)
{
    iso_periodic *f = found;
    if (!f) return;
    for (size_t i = 0; i < f->count; i++) free(f->orbit[i].half);
    free(f->orbit);
    free(found);
}
