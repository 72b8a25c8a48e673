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
#include "base/vec3_impl.h"
#include "map/section.h"
#include "model/model_impl.h"
#include "orbit/crossings_impl.h"

/* --- the orbit -------------------------------------------------------------------------------------------------- */

static iso_status create(const iso_crossings *c, size_t i, iso_orbit **orbit)
{
    const iso_batch_orbit *of = &c->orbits[i];
    iso_way way = iso_crossings_way(c, i);
    iso_status status;
    do {
        const iso_orbit_options how = iso_crossings_orbit_options(c, i, way);
        status = iso_orbit_create(c->orbit[i].ctx, of->params, of->start, &how, orbit);
    } while (iso_way_next(&way, status));
    return status;
}

/* --- the start -------------------------------------------------------------------------------------------------- */

static const double *state_of(const iso_orbit *orbit, const iso_sample *sample)
{
    return iso_crossings_model(orbit) == ISO_POINT ? sample->point : sample->ball;
}

/* Lanes cannot follow the orbit. Returns to a section need bounds for their times, which are powers of q. */
static iso_status refuse_deviations(const iso_crossings *c, size_t i)
{
    iso_context *ctx = c->orbit[i].ctx;
    const iso_params *p = c->orbits[i].params;
    if (c->options.kind == ISO_SECTION_AXIS && iso_params_check_powers(ctx, p) != ISO_OK) return ISO_BAD_INPUT;
    return ISO_FAIL_INPUT(ctx, "deviations",
                          "deviations are computed for free orbits on a global section, and at equal steps of a "
                          "clock; not for stiff balls, balls at rest, or effects without a formula");
}

static iso_status begin(iso_crossings *c, size_t i)
{
    iso_crossing_orbit *o = &c->orbit[i];
    iso_sample start;
    if (c->options.deviations) return refuse_deviations(c, i);
    ISO_TRY(create(c, i, &o->alone));
    ISO_TRY(iso_orbit_at(o->alone, 0, &start));
    if (o->alone->rests && c->options.kind != ISO_SECTION_CLOCK)
        return ISO_FAIL_NUMERICAL(o->ctx, "the ball rests: it crosses no section");
    iso_crossings_find_section(c, o->alone, o);
    if (o->axis < 0) return ISO_OK;
    const double *y = state_of(o->alone, &start);
    o->begins_on_it =
        iso_crossings_on_section(c->orbits[i].params, iso_crossings_model(o->alone), y, o->axis, &o->upwards);
    return iso_crossings_check_plane(o->ctx, o->alone, y, o->axis);
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

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
    const iso_params *own = &orbit->units.own;
    const iso_clock clock = orbit->options.clock;
    const double rate = clock == ISO_CLOCK_T ? 1
                                             : fmax(iso_clock_rate(own, clock, min3(own->J), NULL),
                                                    iso_clock_rate(own, clock, max3(own->J), NULL));
    return 2 * ISO_PI * rate * orbit->unit_clock[clock];
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

static iso_status next_event(iso_crossings *c, iso_crossing_orbit *o, iso_sample *sample)
{
    double seen[3][2] = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    const watch w = {c, o, seen};
    bool found;
    const iso_status status = iso_orbit_event(o->alone, beyond, &w, 1, o->time,
                                              o->time + ISO_MOST_BETWEEN * turn_of(o->alone), &found, sample);
    return status != ISO_OK || found ? status : refuse_section(c, o, seen);
}

static iso_status next_sample(iso_crossings *c, iso_crossing_orbit *o, iso_sample *sample)
{
    const long most = c->options.max_steps, so_far = iso_orbit_statistics(o->alone).steps;
    if (most > 0) iso_orbit_allow_steps(o->alone, so_far + most);
    if (c->options.kind == ISO_SECTION_CLOCK)
        return iso_orbit_at(o->alone, (double)(o->count + 1) * c->options.value, sample);
    return next_event(c, o, sample);
}

static void fill(const iso_crossing_orbit *o, const iso_sample *sample, iso_crossing *to)
{
    iso_crossing_blank(to);
    for (int k = 0; k < ISO_CLOCKS; k++) to->clock[k] = sample->clock[k];
    if (!iso_orbit_has_twin(o->alone)) to->clock[ISO_CLOCK_TAU] = to->clock[ISO_CLOCK_S] = NAN;
    if (o->axis < 0) return;
    double point[ISO_STATE];
    iso_crossings_point(&o->alone->units.own, iso_crossings_model(o->alone), state_of(o->alone, sample), point);
    iso_section_chart(o->axis, point, &to->l, &to->x);
}

/* Whether this first event is the start itself, up to rounding. An orbit that starts on the section crosses it again
 * only after a full oscillation of n_a. */
static bool is_start(const iso_crossing_orbit *o, double time, double s)
{
    if (!o->begins_on_it || o->count > 0) return false;
    return isnan(o->bound[0]) || isnan(s) ? time < 1e-6 * turn_of(o->alone) : s < o->bound[0] / 4;
}

/* One crossing. *counts false: it is the start. */
static iso_status step(iso_crossings *c, iso_crossing_orbit *o, iso_crossing *crossing, iso_sample *sample,
                       bool *counts)
{
    iso_sample here;
    ISO_TRY(next_sample(c, o, &here));
    const double s = here.clock[ISO_CLOCK_S] / o->alone->unit_clock[ISO_CLOCK_S];
    o->time = here.clock[o->alone->options.clock];
    *counts = !is_start(o, o->time, s);
    if (!*counts) return ISO_OK;
    ISO_TRY(iso_crossings_hold(o->ctx, c, o, o->alone, s));
    fill(o, &here, crossing);
    if (sample) iso_crossings_give(c, &here, sample);
    o->s = s;
    o->count++;
    return ISO_OK;
}

iso_status iso_crossings_go_alone(iso_crossings *c, size_t i, size_t each, iso_crossing crossing[],
                                  iso_sample sample[], size_t *done)
{
    iso_crossing_orbit *o = &c->orbit[i];
    iso_status status = o->alone ? ISO_OK : begin(c, i);
    while (status == ISO_OK && *done < each) {
        bool counts;
        status = iso_context_goes_on(o->ctx) ? step(c, o, &crossing[*done], sample ? &sample[*done] : NULL, &counts)
                                             : iso_context_stopped(o->ctx);
        *done += status == ISO_OK && counts;
    }
    return status;
}
