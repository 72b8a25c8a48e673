/* chaos_walk.c - groups of orbits of chaos.h, followed round by round: in each round those that are not decided go on
 * up to the next look at their verdict, first by the one model, then by the other. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "map/state.h"
#include "study/chaos_impl.h"

/* Orbits that are followed together, and most turns of a round: some 25 MB of crossings. */
enum { GROUP = 1024, ROUND = 240, TRACE_ROWS = 4000 };

/* One model's part of a group. */
typedef struct runner {
    iso_crossings *crossings;
    size_t each; /* turns of the last round; they are the same for all that go on */
    bool wanted[GROUP];
    iso_indicators shown[GROUP];
    size_t done[GROUP];
    iso_status status[GROUP];
} runner;

typedef struct group {
    iso_chaos_walk *w;
    size_t first, count; /* orbits; 0 is the scene's own, i the start i - 1 */
    iso_start start[GROUP];
    iso_batch_orbit orbit[GROUP];
    runner model[2];
    iso_crossing *crossing;
    iso_sample *sample; /* NULL: not needed */
} group;

/* --- starts ----------------------------------------------------------------------------------------------------- */

/* A start on the section, of the scene's energy and in its model. It is made in own units, where powers of q fit. */
static iso_start start_at(const iso_chaos_walk *w, double l, double x)
{
    const iso_units *units = iso_orbit_units(w->orbit);
    const double eps = iso_orbit_coupling(w->orbit);
    double point[ISO_STATE];
    iso_start start = {.model = w->scene->start.model, .eps = isnormal(eps) ? eps : (double)NAN};
    const bool ball = start.model == ISO_BALL;
    iso_section_point(&units->own, iso_orbit_model(w->orbit)->problem.eps, w->out->axis, l, x, point);
    if (ball)
        iso_point_to_ball(&units->own, point, start.y);
    else
        copy(point, start.y, ISO_STATE);
    scale(start.y, ball ? units->w : iso_unit(units, iso_system_point.fast_dimension));
    return start;
}

static iso_chaos_orbit *orbit_of(const group *g, size_t i)
{
    iso_chaos *c = g->w->out;
    return g->first + i == 0 ? &c->own : &c->start[g->first + i - 1];
}

/* Spread, or given. */
static void chart_of(const iso_chaos_walk *w, size_t i, double *l, double *x)
{
    const iso_chaos_options *o = &w->options;
    if (i < o->starts) {
        iso_section_spread_point(&w->spread, i, l, x);
        return;
    }
    *l = o->at[i - o->starts][0];
    *x = o->at[i - o->starts][1];
}

static void make_starts(group *g)
{
    const iso_chaos_walk *w = g->w;
    for (size_t i = 0; i < g->count; i++) {
        iso_chaos_orbit *o = orbit_of(g, i);
        *o = (iso_chaos_orbit){.l = NAN, .x = NAN, .verdict = ISO_UNDECIDED};
        g->start[i] = w->scene->start;
        if (g->first + i > 0) {
            chart_of(w, g->first + i - 1, &o->l, &o->x);
            g->start[i] = start_at(w, o->l, o->x);
        }
        g->orbit[i] = (iso_batch_orbit){&w->scene->params, &g->start[i], &w->effects};
    }
}

/* --- beats ------------------------------------------------------------------------------------------------------ */

/* Smooth functions of the place without a symmetry: u is M/|M| on the section, else n. */
static void see(const double u[3], double seen[ISO_SEEN])
{
    seen[0] = u[0] + u[0] * u[0];
    seen[1] = u[1] + u[1] * u[1];
    seen[2] = u[2] + u[0] * u[1] * u[2];
}

static void make_beat(const iso_crossing *c, const iso_sample *sample, iso_beat *beat)
{
    const double root = sqrt(fmax(0, 1 - c->x * c->x)), direction[3] = {root * sin(c->l), root * cos(c->l), c->x};
    memcpy(beat->clock, c->clock, sizeof beat->clock);
    memcpy(beat->growth, c->growth, sizeof beat->growth);
    beat->area = c->area;
    see(sample ? sample->ball + 3 : direction, beat->seen);
}

static iso_status trace(const iso_chaos_walk *w, int model, const iso_indicators *shown)
{
    const long every = (w->options.turns + TRACE_ROWS - 1) / TRACE_ROWS;
    iso_indication told;
    double *row;
    if (shown->turns % every != 0) return ISO_OK;
    const iso_status status = iso_record_append(w->ctx, w->out->trace[model], &row);
    if (status != ISO_OK) return status;
    iso_indicators_tell(shown, &told);
    const bool t = !isnan(shown->now[1]);
    const double values[] = {(double)shown->turns, shown->now[1 + (t ? ISO_CLOCK_T : ISO_CLOCK_S)],
                             shown->before,        told.megno_now,
                             told.megno_mean,      told.gali2};
    memcpy(row, values, sizeof values);
    return ISO_OK;
}

/* Adds the new crossings of an orbit, as long as it is not decided. */
static iso_status take(group *g, int model, size_t i)
{
    const iso_chaos_walk *w = g->w;
    runner *r = &g->model[model];
    iso_indicators *shown = &r->shown[i];
    iso_status status = ISO_OK;
    for (size_t j = 0; j < r->done[i] && status == ISO_OK; j++) {
        if (iso_indicators_verdict(shown) != ISO_UNDECIDED || shown->turns >= w->options.turns) break;
        const size_t at = r->each * i + j;
        iso_beat beat;
        make_beat(&g->crossing[at], g->sample ? &g->sample[at] : NULL, &beat);
        iso_indicators_add(shown, &beat);
        if (g->first + i == 0) status = trace(w, model, shown);
    }
    r->wanted[i] =
        r->status[i] == ISO_OK && iso_indicators_verdict(shown) == ISO_UNDECIDED && shown->turns < w->options.turns;
    return status;
}

/* --- rounds ----------------------------------------------------------------------------------------------------- */

static iso_status create_trace(iso_chaos_walk *w, int model)
{
    static const char *const names[] = {"turn", "t", "growth", "megno", "mean", "gali2"};
    return iso_record_create(w->ctx, sizeof names / sizeof *names, names, &w->out->trace[model]);
}

static iso_status open_model(group *g, int model)
{
    const iso_chaos_walk *w = g->w;
    const iso_chaos_options *o = &w->options;
    iso_crossings_options c = iso_crossings_defaults();
    c.backend = (iso_backend)model;
    c.kind = w->out->axis < 0 ? ISO_SECTION_CLOCK : ISO_SECTION_AXIS;
    c.axis = w->out->axis < 0 ? ISO_AXIS_AUTO : w->out->axis;
    c.value = w->out->turn;
    c.deviations = true;
    c.tolerance = o->tolerance;
    c.shown = w->out->axis < 0 ? ISO_SHOW_BALL : (iso_shown)model;
    c.threads = o->threads;
    c.vectors = o->vectors;
    runner *r = &g->model[model];
    for (size_t i = 0; i < g->count; i++) {
        iso_indicators_begin(&r->shown[i], o->turns);
        r->wanted[i] = true;
        r->status[i] = ISO_OK;
    }
    return iso_crossings_create(w->ctx, g->orbit, g->count, &c, &r->crossings);
}

/* The message of iso_crossings_go is about the first failure. */
static void note_failures(group *g, int model)
{
    iso_chaos *c = g->w->out;
    for (size_t i = 0; i < g->count; i++) {
        const iso_status status = g->model[model].status[i];
        if (status == ISO_OK || status == ISO_STOPPED) continue;
        orbit_of(g, i)->status[model] = status;
        if (c->failure != ISO_OK) continue;
        c->failure = status;
        snprintf(c->words, sizeof c->words, "%s", iso_context_message(g->w->ctx));
    }
}

/* Sets what one model has told, for progress as well. */
static void tell(group *g, int model)
{
    for (size_t i = 0; i < g->count; i++)
        iso_indicators_tell(&g->model[model].shown[i], &orbit_of(g, i)->told[model]);
}

/* Up to the next look of those that go on; 0: none does. */
static size_t turns_of_round(const group *g, const runner *r)
{
    for (size_t i = 0; i < g->count; i++) {
        if (!r->wanted[i]) continue;
        const long turns = r->shown[i].turns, next = iso_indicators_next(&r->shown[i]), most = g->w->options.turns;
        const long left = (next < most ? next : most) - turns;
        return left < ROUND ? (size_t)left : ROUND;
    }
    return 0;
}

/* One round of one model. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
static iso_status go_on(group *g, int model, bool *any)
{
    runner *r = &g->model[model];
    r->each = turns_of_round(g, r);
    if (r->each == 0) return ISO_OK;
    const iso_status went =
        iso_crossings_go(r->crossings, r->wanted, r->each, g->crossing, g->sample, r->done, r->status);
    iso_status status = went == ISO_STOPPED || went == ISO_NO_MEMORY ? went : ISO_OK;
    if (went != ISO_OK && status == ISO_OK) note_failures(g, model);
    for (size_t i = 0; i < g->count; i++) {
        if (!r->wanted[i]) continue;
        const iso_status taken = take(g, model, i);
        if (taken != ISO_OK) status = taken;
        *any = *any || r->wanted[i];
    }
    return status;
}

/* An orbit that is decided by one model is followed by the other until that decides as well. */
static void show_progress(const group *g)
{
    const iso_chaos_walk *w = g->w;
    double done = 0;
    int models = 0;
    if (!w->options.progress) return;
    for (int m = 0; m < 2; m++)
        for (size_t i = 0; w->out->with[m] && i < g->count; i++) {
            const runner *r = &g->model[m];
            done += r->wanted[i] ? (double)r->shown[i].turns / (double)w->options.turns : 1;
            models += i == 0;
        }
    const double all = (double)(w->options.starts + w->options.at_count) + 1;
    w->options.progress(fmin(1, ((double)g->first + done / models) / all), w->options.data);
}

static iso_status follow_group(group *g)
{
    iso_chaos *c = g->w->out;
    iso_status status = ISO_OK;
    make_starts(g);
    for (int m = 0; m < 2 && status == ISO_OK; m++)
        if (c->with[m]) status = open_model(g, m);
    for (bool any = true; any && status == ISO_OK;) {
        any = false;
        for (int m = 0; m < 2 && status == ISO_OK; m++)
            if (c->with[m]) status = go_on(g, m, &any);
        show_progress(g);
    }
    for (int m = 0; m < 2; m++)
        if (c->with[m]) tell(g, m);
    for (size_t i = 0; i < g->count; i++) iso_chaos_judge(c, orbit_of(g, i));
    for (int m = 0; m < 2; m++) {
        iso_crossings_free(g->model[m].crossings);
        g->model[m].crossings = NULL;
    }
    return status;
}

/* The scene's own orbit must be followed by one model at least. */
static iso_status check_own(const iso_chaos_walk *w)
{
    const iso_chaos *c = w->out;
    for (int m = 0; m < 2; m++)
        if (c->with[m] && c->own.status[m] == ISO_OK) return ISO_OK;
    return iso_context_fail(w->ctx, c->failure, iso_context_about(w->ctx), "%s", c->words);
}

/* A rotation in a principal plane is periodic. */
static void tell_plane(iso_chaos *c)
{
    iso_indicators none;
    c->own = (iso_chaos_orbit){.l = NAN, .x = NAN, .verdict = ISO_REGULAR};
    iso_indicators_begin(&none, 1);
    for (int m = 0; m < 2; m++) {
        iso_indicators_tell(&none, &c->own.told[m]);
        if (c->with[m]) c->own.told[m].verdict = ISO_REGULAR;
    }
}

static iso_status follow_all(group *g)
{
    iso_chaos_walk *w = g->w;
    const size_t orbits = w->options.starts + w->options.at_count + 1;
    iso_status status = ISO_OK;
    for (int m = 0; m < 2 && status == ISO_OK; m++)
        if (w->out->with[m]) status = create_trace(w, m);
    if (w->out->plane >= 0) tell_plane(w->out);
    for (size_t first = w->out->plane >= 0; first < orbits && status == ISO_OK; first += g->count) {
        g->first = first;
        g->count = first == 0 ? 1 : orbits - first < GROUP ? orbits - first : GROUP;
        status = follow_group(g);
        if (first == 0 && status == ISO_OK) status = check_own(w);
        w->out->starts = first + g->count - 1;
    }
    return status;
}

iso_status iso_chaos_follow(iso_chaos_walk *w)
{
    group *g = calloc(1, sizeof *g);
    const size_t cells = ROUND * (w->options.starts + w->options.at_count > 0 ? GROUP : 1);
    iso_status status = ISO_OK;
    if (g) {
        g->w = w;
        g->crossing = malloc(cells * sizeof *g->crossing);
        g->sample = w->out->axis < 0 ? malloc(cells * sizeof *g->sample) : NULL;
    }
    if (!g || !g->crossing || (w->out->axis < 0 && !g->sample))
        status = iso_context_fail(w->ctx, ISO_NO_MEMORY, "", "no memory for the orbits");
    if (status == ISO_OK) status = follow_all(g);
    if (g) {
        free(g->crossing);
        free(g->sample);
    }
    free(g);
    return status;
}
