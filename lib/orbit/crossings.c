/* crossings.c - many orbits from crossing to crossing: checks the options, follows the orbits in lanes or one by
 * one. */
#include "orbit/crossings.h"

#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "method/integrator_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/lane_groups_impl.h"

iso_status iso_crossings_check(iso_context *ctx, const iso_crossings_options *o)
{
    const bool axis = o->kind == ISO_SECTION_AXIS, column = o->kind == ISO_SECTION_COLUMN;
    if (o->backend == ISO_BACKEND_EXACT)
        return ISO_FAIL_ARGUMENT(ctx, "backend", "crossings are found by integration: take backend ball or point");
    if ((int)o->backend < 0 || o->backend > ISO_BACKEND_EXACT || (int)o->shown < 0 || o->shown > ISO_SHOW_BOTH)
        return ISO_FAIL_ARGUMENT(ctx, "backend",
                                 "crossings are found by backend ball or point, and shown as ball, point or both");
    ISO_TRY(iso_tolerance_check(ctx, o->tolerance));
    ISO_TRY(iso_lanes_check(ctx, o->threads, o->vectors, iso_lane_build_find(o->vectors, o->deviations) != NULL));
    if (axis) return iso_crossings_check_axis(ctx, o->axis);
    if (!column && o->kind != ISO_SECTION_CLOCK)
        return ISO_FAIL_ARGUMENT(ctx, "axis", "there is no such kind of section");
    if (column && o->column >= 0 && o->column < ISO_CLOCKS)
        return ISO_FAIL_ARGUMENT(ctx, "column", "a clock passes each value once: take equal steps of the clock");
    if (column && (o->column < 0 || o->column >= iso_columns_count()))
        return ISO_FAIL_ARGUMENT(ctx, "column", "there is no such column");
    if (column && !isfinite(o->value))
        return ISO_FAIL_ARGUMENT(ctx, "value", "a column cannot pass %s", ISO_SHORT(o->value));
    if (!column && !(o->value > 0 && isfinite(o->value)))
        return ISO_FAIL_ARGUMENT(ctx, "value", "a clock cannot go on in steps of %s", ISO_SHORT(o->value));
    if (!column && ((int)o->clock < 0 || o->clock >= ISO_CLOCKS))
        return ISO_FAIL_ARGUMENT(ctx, "value", "there is no such clock");
    if (column && o->deviations)
        return ISO_FAIL_ARGUMENT(ctx, "deviations",
                                 "deviations are computed only on sections n_a = 0 and at equal steps of a clock");
    return ISO_OK;
}

iso_status iso_crossings_create(iso_context *ctx, const iso_batch_orbit orbits[], size_t count,
                                const iso_crossings_options *options, iso_crossings **crossings)
{
    ISO_DEFAULT_ARITHMETIC;
    const iso_crossings_options own = options ? *options : iso_crossings_defaults();
    *crossings = NULL;
    ISO_TRY(iso_crossings_check(ctx, &own));
    iso_crossings *c = calloc(1, sizeof *c);
    iso_crossing_orbit *each = calloc(count + 1, sizeof *each);
    if (!c || !each) {
        free(c);
        free(each);
        return iso_context_no_memory(ctx, "the crossings of %zu orbits", count);
    }
    *c = (iso_crossings){.ctx = ctx, .orbits = orbits, .count = count, .options = own, .orbit = each};
    *crossings = c;
    return ISO_OK;
}

void iso_crossings_free(iso_crossings *c)
{
    if (!c) return;
    for (size_t i = 0; i < c->count; i++) {
        iso_orbit_free(c->orbit[i].alone);
        iso_context_free(c->orbit[i].ctx);
        free(c->orbit[i].lane);
        free(c->orbit[i].why);
    }
    free(c->orbit);
    free(c);
}

const char *iso_crossings_why(const iso_crossings *c, size_t i)
{
    const iso_crossing_orbit *o = &c->orbit[i];
    return o->why ? o->why : iso_status_text(o->status);
}

iso_status iso_crossings_go_apart(iso_crossings *c, const iso_crossings_task *t)
{
    for (size_t i = 0; i < c->count; i++) {
        t->done[i] = 0;
        t->status[i] = c->orbit[i].status;
        for (size_t j = 0; j < t->each; j++) {
            iso_crossing_blank(&t->crossing[t->stride * i + j]);
            if (t->sample) iso_sample_blank(&t->sample[t->stride * i + j]);
        }
    }
    iso_status answer = iso_crossings_in_lanes(c, t);
    if (answer == ISO_OK) answer = iso_crossings_alone(c, t);
    for (size_t i = 0; i < c->count; i++) {
        const iso_crossing_orbit *o = &c->orbit[i];
        if (answer == ISO_STOPPED && iso_crossings_wants(c, t, i) && t->done[i] < t->each)
            t->status[i] = ISO_STOPPED; /* also of those that nobody has taken up */
        if (answer == ISO_OK && o->status != ISO_OK && (!t->wanted || t->wanted[i]))
            return iso_context_fail(c->ctx, o->status, o->about, "orbit %zu: %s", i, iso_crossings_why(c, i));
    }
    return answer;
}

iso_status iso_crossings_go(iso_crossings *c, const bool wanted[], size_t each, iso_crossing crossing[],
                            iso_sample sample[], size_t done[], iso_status status[])
{
    ISO_DEFAULT_ARITHMETIC;
    return iso_crossings_go_apart(c, &(iso_crossings_task){wanted, each, each, crossing, sample, done, status});
}
