/* crossings.c - many orbits from crossing to crossing: checks the options, follows the orbits in lanes or one by
 * one. */
#include "orbit/crossings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "method/integrator_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/lane_groups_impl.h"

/* --- making ----------------------------------------------------------------------------------------------------- */

static iso_status check_section(iso_context *ctx, const iso_crossings_options *o)
{
    if (o->kind != ISO_SECTION_AXIS && o->kind != ISO_SECTION_COLUMN && o->kind != ISO_SECTION_CLOCK)
        return ISO_FAIL_ARGUMENT(ctx, "axis", "there is no such kind of section");
    if (o->kind == ISO_SECTION_AXIS && iso_crossings_check_axis(ctx, o->axis) != ISO_OK) return ISO_BAD_ARGUMENT;
    if (o->kind == ISO_SECTION_COLUMN && (o->column < ISO_CLOCKS || o->column >= iso_columns_count()))
        return ISO_FAIL_ARGUMENT(ctx, "column",
                                 o->column >= 0 && o->column < ISO_CLOCKS
                                     ? "a clock passes each value once: take equal steps of the clock"
                                     : "there is no such column");
    if (o->kind == ISO_SECTION_COLUMN && !isfinite(o->value))
        return ISO_FAIL_ARGUMENT(ctx, "value", "a column cannot pass %s", ISO_SHORT(o->value));
    if (o->kind == ISO_SECTION_CLOCK && !(o->value > 0 && isfinite(o->value)))
        return ISO_FAIL_ARGUMENT(ctx, "value", "a clock cannot go on in steps of %s", ISO_SHORT(o->value));
    if (o->kind == ISO_SECTION_CLOCK && ((int)o->clock < 0 || o->clock >= ISO_CLOCKS))
        return ISO_FAIL_ARGUMENT(ctx, "value", "there is no such clock");
    if (o->kind == ISO_SECTION_COLUMN && o->deviations)
        return ISO_FAIL_ARGUMENT(ctx, "deviations",
                                 "deviations are computed only on sections n_a = 0 and at equal steps of a clock");
    return ISO_OK;
}

iso_status iso_crossings_check(iso_context *ctx, const iso_crossings_options *o)
{
    if (o->backend == ISO_BACKEND_EXACT)
        return ISO_FAIL_ARGUMENT(ctx, "backend", "crossings are found by integration: take backend ball or point");
    if ((int)o->backend < 0 || o->backend > ISO_BACKEND_EXACT || (int)o->shown < 0 || o->shown > ISO_SHOW_BOTH)
        return ISO_FAIL_ARGUMENT(ctx, "backend",
                                 "crossings are found by backend ball or point, and shown as ball, point or both");
    ISO_TRY(iso_tolerance_check(ctx, o->tolerance));
    ISO_TRY(iso_lanes_check(ctx, o->threads, o->vectors, iso_lane_build_find(o->vectors, o->deviations) != NULL));
    return check_section(ctx, o);
}

iso_status iso_crossings_create(iso_context *ctx, const iso_batch_orbit orbits[], size_t count,
                                const iso_crossings_options *options, iso_crossings **crossings)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_crossings_options own = iso_crossings_defaults();
    *crossings = NULL;
    if (options) own = *options;
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
        iso_crossings_free_lane(c->orbit[i].lane);
        free(c->orbit[i].why);
    }
    free(c->orbit);
    free(c);
}

/* --- going on --------------------------------------------------------------------------------------------------- */

static void blank(const iso_crossings *c, const iso_crossings_task *t)
{
    for (size_t i = 0; i < c->count; i++) {
        t->done[i] = 0;
        t->status[i] = c->orbit[i].status;
        for (size_t j = 0; j < t->each; j++) {
            iso_crossing_blank(&t->crossing[t->stride * i + j]);
            if (t->sample) iso_sample_blank(&t->sample[t->stride * i + j]);
        }
    }
}

typedef struct singles {
    iso_crossings *c;
    const iso_crossings_task *task;
    const bool *taken;
} singles;

static void follow_single(iso_pool_worker *w, const singles *l, size_t i)
{
    const iso_crossings_task *t = l->task;
    iso_crossings *c = l->c;
    iso_crossing_orbit *o = &c->orbit[i];
    iso_sample *sample = t->sample ? t->sample + t->stride * i : NULL;
    if (!o->ctx) o->ctx = iso_context_create();
    if (!o->ctx) {
        t->status[i] = iso_context_no_memory(w->ctx, "an orbit");
        iso_crossings_keep(c, w->ctx, i, t->status[i]);
        return;
    }
    iso_context_set_monitor(o->ctx, iso_pool_goes_on, w);
    t->status[i] = iso_crossings_go_alone(c, i, t->each, t->crossing + t->stride * i, sample, &t->done[i]);
    iso_context_set_monitor(o->ctx, NULL, NULL);
    iso_crossings_keep(c, o->ctx, i, t->status[i]);
}

static bool follow_chunk(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    const singles *l = data;
    const iso_crossings_task *t = l->task;
    for (size_t i = first; i < first + count; i++) {
        if (l->taken[i] || (t->wanted && !t->wanted[i]) || l->c->orbit[i].status != ISO_OK) continue;
        t->status[i] = ISO_STOPPED;
        if (iso_pool_goes_on(w)) follow_single(w, l, i);
    }
    return true;
}

/* The orbits that lanes have not taken, each by itself, on all threads. */
static iso_status one_by_one(iso_crossings *c, const iso_crossings_task *t, const bool taken[])
{
    singles l = {c, t, taken};
    iso_pool pool = {.what = "orbit", .count = c->count, .chunk = 1, .solve = follow_chunk, .data = &l};
    size_t alone = 0;
    for (size_t i = 0; i < c->count; i++) alone += !taken[i];
    if (alone == 0) return ISO_OK;
    return iso_pool_run(c->ctx, &pool, iso_pool_threads(c->options.threads, alone, 1), NULL);
}

const char *iso_crossings_why(const iso_crossings *c, size_t i)
{
    const iso_crossing_orbit *o = &c->orbit[i];
    return o->why ? o->why : iso_status_text(o->status);
}

/* Fails with the status and the message of the first wanted orbit that has failed. */
static iso_status tell_first(const iso_crossings *c, const iso_crossings_task *t)
{
    for (size_t i = 0; i < c->count; i++) {
        const iso_crossing_orbit *o = &c->orbit[i];
        if (o->status == ISO_OK || (t->wanted && !t->wanted[i])) continue;
        return iso_context_fail(c->ctx, o->status, o->about, "orbit %zu: %s", i, iso_crossings_why(c, i));
    }
    return ISO_OK;
}

iso_status iso_crossings_go_apart(iso_crossings *c, const iso_crossings_task *t)
{
    bool *taken = calloc(c->count + 1, sizeof *taken);
    blank(c, t);
    if (!taken) return iso_context_no_memory(c->ctx, "crossings");
    iso_status answer = iso_crossings_in_lanes(c, t, taken);
    if (answer == ISO_OK) answer = one_by_one(c, t, taken);
    free(taken);
    for (size_t i = 0; answer == ISO_STOPPED && i < c->count; i++) /* those that nobody has taken up */
        if (t->status[i] == ISO_OK && t->done[i] < t->each && (!t->wanted || t->wanted[i]))
            t->status[i] = ISO_STOPPED;
    return answer == ISO_OK ? tell_first(c, t) : answer;
}

iso_status iso_crossings_go(iso_crossings *c, const bool wanted[], size_t each, iso_crossing crossing[],
                            iso_sample sample[], size_t done[], iso_status status[])
{
    ISO_DEFAULT_ARITHMETIC;
    return iso_crossings_go_apart(c, &(iso_crossings_task){wanted, each, each, crossing, sample, done, status});
}
