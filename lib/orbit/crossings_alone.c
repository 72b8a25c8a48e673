/* crossings_alone.c - one orbit from crossing to crossing, by itself.
 *
 * A crossing of n_a = 0, or of a column's value, is an event (iso_orbit_event). Equal steps of a clock come from
 * iso_orbit_at. The orbit is kept between calls, and the search for a crossing depends only on the crossing before.
 * So the results do not depend on how many crossings are asked at a time.
 */
#include <math.h>
#include <stdio.h>

#include "base/context_impl.h"
#include "base/math_impl.h"
#include "base/number_impl.h"
#include "base/pool_impl.h"
#include "model/model_impl.h"
#include "orbit/crossings_impl.h"

static const double *state_of(const iso_orbit *orbit, const iso_sample *sample)
{
    return iso_crossings_model(orbit) == ISO_POINT ? sample->point : sample->ball;
}

/* Creates orbit i, at its start. Lanes have not taken it, so it has no deviations. */
static iso_status begin(iso_crossings *c, size_t i)
{
    const iso_batch_orbit *of = &c->orbits[i];
    iso_crossing_orbit *o = &c->orbit[i];
    iso_attempt attempt = iso_crossings_attempt(c, i);
    iso_status status;
    iso_sample start;
    if (c->options.deviations) {
        /* returns to a section need bounds for their times, which are powers of q */
        if (c->options.kind == ISO_SECTION_AXIS) ISO_TRY(iso_params_check_powers(o->ctx, of->params));
        return ISO_FAIL_INPUT(o->ctx, "deviations",
                              "deviations are computed for free orbits on a global section, and at equal steps of a "
                              "clock; not for stiff balls, balls at rest, or effects without a formula");
    }
    do {
        const iso_orbit_options how = iso_crossings_orbit_options(c, i, attempt);
        status = iso_orbit_create(o->ctx, of->params, of->start, &how, &o->alone);
    } while (iso_attempt_next(&attempt, status));
    if (status != ISO_OK) return status;
    ISO_TRY(iso_orbit_at(o->alone, 0, &start));
    if (o->alone->rests && c->options.kind != ISO_SECTION_CLOCK)
        return ISO_FAIL_NUMERICAL(o->ctx, "the ball rests: it crosses no section");
    return iso_crossings_begin(o->ctx, c, of->params, o->alone, state_of(o->alone, &start), o);
}

/* What an event looks at, and what it has seen since the last crossing: the least and the largest n_1, n_2, n_3 (of
 * the point: gamma), or those of the column */
typedef struct watch {
    const iso_crossings *c;
    const iso_crossing_orbit *o;
    double (*seen)[2];
} watch;

/* n_a, or the column less its value */
static double beyond(const iso_sample *sample, const void *data)
{
    const watch *w = data;
    const bool axis = w->c->options.kind == ISO_SECTION_AXIS;
    const double column = axis ? 0 : iso_sample_column(sample, w->c->options.column);
    const double *const value = axis ? state_of(w->o->alone, sample) + 3 : &column;
    for (int i = 0; i < (axis ? 3 : 1); i++) {
        w->seen[i][0] = fmin(w->seen[i][0], value[i]);
        w->seen[i][1] = fmax(w->seen[i][1], value[i]);
    }
    return axis ? value[w->o->axis] : column - w->c->options.value;
}

/* The longest time of a turn, in the orbit's clock and the caller's units. */
static double turn_of(const iso_orbit *orbit)
{
    return 2 * ISO_PI * iso_orbit_fastest(orbit) * orbit->unit_clock[orbit->model.clock];
}

/* The orbit does not come to the section: nothing has failed, another section is wanted. The message names one. */
static iso_status refuse_section(const iso_crossings *c, const iso_crossing_orbit *o, double (*seen)[2])
{
    const bool axis = c->options.kind == ISO_SECTION_AXIS;
    const int at = axis ? o->axis : 0;
    char since[64] = "the start", where[32], advice[128] = "give a value in between";
    if (o->count > 0)
        snprintf(since, sizeof since, "crossing %zu, at %s = %s", o->count, iso_clock_name(o->alone->options.clock),
                 ISO_SHORT(o->time));
    if (axis) {
        const char *unit_vector = iso_crossings_model(o->alone) == ISO_POINT ? "gamma" : "n";
        snprintf(where, sizeof where, "%s_%d", unit_vector, at + 1);
        snprintf(advice, sizeof advice,
                 "it crosses no other n_a = 0 either: use an event instead of an axis, for example %s%d=%.2g",
                 unit_vector, at + 1, (seen[at][0] + seen[at][1]) / 2);
        for (int i = 2; i >= 0; i--)
            if (i != at && seen[i][0] < 0 && seen[i][1] > 0)
                snprintf(advice, sizeof advice, "it crosses n_%d = 0: take axis %d", i + 1, i + 1);
    } else {
        snprintf(where, sizeof where, "%s", iso_column_name(c->options.column));
    }
    return ISO_FAIL_INPUT(
        o->ctx, axis ? "axis" : "value",
        "this orbit does not pass %s = %s upwards within %d turns after %s: there %s is between %.4g "
        "and %.4g; %s",
        where, ISO_SHORT(axis ? 0 : c->options.value), ISO_MOST_BETWEEN, since, where, seen[at][0], seen[at][1],
        advice);
}

/* The next event, or the next equal step. */
static iso_status find_next(const iso_crossings *c, const iso_crossing_orbit *o, iso_sample *sample)
{
    double seen[3][2] = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    const watch w = {c, o, seen};
    const double last = o->time + ISO_MOST_BETWEEN * turn_of(o->alone);
    bool found;
    if (c->options.kind == ISO_SECTION_CLOCK)
        return iso_orbit_at(o->alone, (double)(o->count + 1) * c->options.value, sample);
    ISO_TRY(iso_orbit_event(o->alone, beyond, &w, 1, o->time, last, &found, sample));
    return found ? ISO_OK : refuse_section(c, o, seen);
}

/* Orbit i goes on to its next crossings. The message of a failure is in its own context. */
static iso_status go_on(iso_crossings *c, const iso_crossings_task *t, size_t i)
{
    iso_crossing_orbit *o = &c->orbit[i];
    if (!o->alone) ISO_TRY(begin(c, i));
    for (size_t *done = &t->done[i]; *done < t->each;) {
        const size_t to = t->stride * i + *done;
        iso_sample here;
        if (!iso_context_goes_on(o->ctx)) return iso_context_stopped(o->ctx);
        ISO_TRY(find_next(c, o, &here));
        const double s = here.clock[ISO_CLOCK_S] / o->alone->unit_clock[ISO_CLOCK_S];
        o->time = here.clock[o->alone->options.clock];
        /* The first event may be the start itself, up to rounding: an orbit that starts on the section crosses it again
         * only after a full oscillation of n_a. */
        if (o->begins_on_it && o->count == 0 &&
            (isnan(o->bound[0]) || isnan(s) ? o->time < 1e-6 * turn_of(o->alone) : s < o->bound[0] / 4))
            continue;
        ISO_TRY(
            iso_crossings_add(o->ctx, c, o->alone, here.clock, s, state_of(o->alone, &here), o, &t->crossing[to]));
        iso_crossings_hide(c, &here);
        if (t->sample) t->sample[to] = here;
        ++*done;
    }
    return ISO_OK;
}

typedef struct follower {
    iso_crossings *c;
    const iso_crossings_task *task;
} follower;

static bool solve(iso_pool_worker *w, void *data, size_t i, size_t count)
{
    const follower *f = data;
    iso_crossing_orbit *o = &f->c->orbit[i];
    (void)count; /* 1: chunks of one orbit */
    if (!iso_crossings_wants(f->c, f->task, i) || o->lane) return true;
    f->task->status[i] = ISO_STOPPED;
    if (!iso_pool_goes_on(w)) return true;
    if (!o->ctx) o->ctx = iso_context_create();
    if (!o->ctx) return false;
    iso_context_set_monitor(o->ctx, iso_pool_goes_on, w);
    const iso_status status = go_on(f->c, f->task, i);
    iso_context_set_monitor(o->ctx, NULL, NULL);
    iso_crossings_keep(f->c, f->task, o->ctx, i, status);
    return true;
}

iso_status iso_crossings_alone(iso_crossings *c, const iso_crossings_task *t)
{
    follower f = {c, t};
    iso_pool pool = {.what = "orbit", .count = c->count, .chunk = 1, .solve = solve, .data = &f};
    size_t alone = 0;
    for (size_t i = 0; i < c->count; i++) alone += iso_crossings_wants(c, t, i) && !c->orbit[i].lane;
    return alone == 0 ? ISO_OK : iso_pool_run(c->ctx, &pool, iso_pool_threads(c->options.threads, alone, 1), NULL);
}
