/* chaos_walk.c - follows the orbits of chaos.h in groups, round by round. In each round the orbits that have not
 * ended go on to the next look. The point goes first, then the ball. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "orbit/crossings_impl.h"
#include "study/chaos/chaos_impl.h"
#include "study/fields_impl.h"

/* GROUP: orbits that are followed together. ROUND: the most turns of a round. Together some 25 MB of crossings.
 * CHECKED: one of so many starts is followed by the ball, too, if the walk is sampled, for at most CHECK_TURNS. */
enum { GROUP = 1024, ROUND = 240, TRACE_ROWS = 4000, CHECKED = 16, CHECK_TURNS = 750 };

/* One model's part of a group. */
typedef struct model_walk {
    iso_crossings *crossings;
    size_t each;        /* turns of the last round, the same for all orbits that go on */
    bool wanted[GROUP]; /* whether an orbit goes on */
    iso_indicators shown[GROUP];
    size_t done[GROUP];
    iso_status status[GROUP];
} model_walk;

typedef struct group {
    iso_chaos_walk *w;
    iso_chaos_walk *const *each; /* the scene of each orbit, which is its own orbit; NULL: all have one scene */
    size_t first, count;         /* orbits; orbit 0 is the scene's own, orbit i is start i - 1 */
    iso_start start[GROUP];
    iso_batch_orbit orbit[GROUP];
    model_walk model[2];
    iso_crossing *crossing;
    iso_sample *sample; /* NULL: not needed */
} group;

/* --- starts ----------------------------------------------------------------------------------------------------- */

static iso_chaos_orbit *orbit_of(const group *g, size_t i)
{
    iso_chaos *c = g->w->out;
    if (g->each) return &g->each[i]->out->own;
    return g->first + i == 0 ? &c->own : &c->start[g->first + i - 1];
}

/* The first starts are spread, then come the given ones. */
static void chart_of_start(iso_chaos_walk *w, size_t i, double *l, double *x)
{
    const iso_chaos_options *how = &w->options;
    if (i < how->starts)
        iso_share_start(&w->spread, how->seed, i, l, x);
    else
        *l = how->at[i - how->starts][0], *x = how->at[i - how->starts][1];
}

static void make_starts(group *g)
{
    for (size_t i = 0; i < g->count; i++) {
        const iso_chaos_walk *w = g->each ? g->each[i] : g->w;
        iso_chaos_orbit *o = orbit_of(g, i);
        *o = (iso_chaos_orbit){.l = NAN, .x = NAN, .verdict = ISO_UNDECIDED, .number = g->each ? 0 : g->first + i};
        g->start[i] = w->scene->start;
        if (!g->each && g->first + i > 0) {
            chart_of_start(g->w, g->first + i - 1, &o->l, &o->x);
            g->start[i] = iso_section_start(w->orbit, w->scene->start.model, w->out->chart, o->l, o->x);
        }
        g->orbit[i] = (iso_batch_orbit){&w->scene->params, &g->start[i], &w->effects};
    }
}

/* --- turns ------------------------------------------------------------------------------------------------------ */

static void make_turn(const iso_crossing *c, const iso_sample *sample, iso_turn_sample *turn)
{
    const double root = sqrt(fmax(0, 1 - c->x * c->x)), direction[3] = {root * sin(c->l), root * cos(c->l), c->x};
    memcpy(turn->clock, c->clock, sizeof turn->clock);
    memcpy(turn->growth, c->growth, sizeof turn->growth);
    turn->area = c->area;
    /* smooth functions of the place, without a symmetry: of M/|M| on the section, else of n */
    const double *u = sample ? sample->ball + 3 : direction;
    turn->observable[0] = u[0] + u[0] * u[0];
    turn->observable[1] = u[1] + u[1] * u[1];
    turn->observable[2] = u[2] + u[0] * u[1] * u[2];
}

static iso_status trace(const iso_chaos_walk *w, int model, const iso_indicators *shown)
{
    const iso_chaos_options *o = &w->options;
    const long most = o->turns > o->exponent_turns ? o->turns : o->exponent_turns,
               every = (most + TRACE_ROWS - 1) / TRACE_ROWS;
    iso_indication result;
    double *row;
    if (shown->turns % every != 0) return ISO_OK;
    ISO_TRY(iso_record_append(w->ctx, w->out->trace[model], &row));
    iso_indicators_read(shown, &result);
    const bool t = !isnan(shown->now[1]);
    const double values[] = {(double)shown->turns, shown->now[1 + (t ? ISO_CLOCK_T : ISO_CLOCK_S)],
                             shown->before,        result.megno_now,
                             result.megno_mean,    result.gali2};
    memcpy(row, values, sizeof values);
    return ISO_OK;
}

/* Keeps the words of the first failure. */
static void note_failure(const group *g, int model, size_t i, const char *words)
{
    iso_chaos *c = g->each ? g->each[i]->out : g->w->out;
    const iso_status status = g->model[model].status[i];
    orbit_of(g, i)->status[model] = status;
    if (c->failure != ISO_OK) return;
    c->failure = status;
    snprintf(c->words, sizeof c->words, "orbit %zu: %s", g->each ? 0 : g->first + i, words);
}

static void note_failures(const group *g, int model)
{
    const model_walk *r = &g->model[model];
    for (size_t i = 0; i < g->count; i++)
        if (r->status[i] != ISO_OK && r->status[i] != ISO_STOPPED)
            note_failure(g, model, i, iso_crossings_why(r->crossings, i));
}

/* Whether all orbits of the group are spread starts. Otherwise none is. */
static bool are_spread(const group *g)
{
    return !g->each && g->first > 0 && g->first <= g->w->options.starts;
}

/* Whether the ball follows orbits of this group only as a check. */
static bool only_checks(const group *g, int model)
{
    return model == ISO_BALL && g->w->sampled && are_spread(g);
}

/* The number of turns after which an orbit ends: the verdict regular ends it at once. */
static long most_turns(const group *g, int model, size_t i)
{
    const iso_chaos_options *o = &g->w->options;
    const iso_verdict verdict = iso_indicators_verdict(&g->model[model].shown[i]);
    const long most = only_checks(g, model) && o->turns > CHECK_TURNS ? CHECK_TURNS : o->turns;
    return verdict == ISO_UNDECIDED ? most : verdict == ISO_CHAOTIC ? o->exponent_turns : 0;
}

/* Adds the new crossings of an orbit until it ends. */
static iso_status take(group *g, int model, size_t i)
{
    const iso_chaos_walk *w = g->w;
    model_walk *r = &g->model[model];
    iso_indicators *shown = &r->shown[i];
    iso_status status = ISO_OK;
    for (size_t j = 0; j < r->done[i] && status == ISO_OK; j++) {
        if (shown->turns >= most_turns(g, model, i)) break;
        const size_t at = r->each * i + j;
        iso_turn_sample turn;
        make_turn(&g->crossing[at], g->sample ? &g->sample[at] : NULL, &turn);
        if (isnan(turn.growth[0] + turn.growth[1])) {
            static const char *const words = "it stands still: its deviations have no length";
            r->status[i] = ISO_FAIL_NUMERICAL(w->ctx, "%s", words);
            note_failure(g, model, i, words);
            break;
        }
        iso_indicators_add(shown, &turn);
        if (!g->each && g->first + i == 0) status = trace(w, model, shown);
    }
    r->wanted[i] = r->status[i] == ISO_OK && shown->turns < most_turns(g, model, i);
    return status;
}

/* --- rounds ----------------------------------------------------------------------------------------------------- */

static iso_status create_trace(iso_chaos_walk *w, int model)
{
    ISO_TRY(iso_columns_create(w->ctx, iso_indicator_fields, &w->out->trace[model]));
    iso_record_set_kind(w->out->trace[model], "chaos indicators");
    return ISO_OK;
}

/* Whether this model follows orbit i. The ball checks verdicts of the point, of those that need no more turns. */
static bool follows(const group *g, int model, size_t i)
{
    const iso_indicators *point = &g->model[ISO_POINT].shown[i];
    if (!only_checks(g, model)) return true;
    return (g->first + i - 1) % CHECKED == 0 && iso_indicators_verdict(point) != ISO_UNDECIDED &&
           point->decided <= CHECK_TURNS;
}

static void begin_model(group *g, int model)
{
    const iso_chaos_walk *w = g->w;
    model_walk *r = &g->model[model];
    for (size_t i = 0; i < g->count; i++) {
        iso_indicators_begin(&r->shown[i], w->options.turns);
        r->shown[i].integrable = (g->each ? g->each[i]->out : w->out)->integral != NULL;
        r->wanted[i] = false;
        r->status[i] = ISO_OK;
    }
}

static iso_status open_model(group *g, int model)
{
    const iso_chaos_walk *w = g->w;
    const iso_chaos_options *o = &w->options;
    iso_crossings_options c = iso_crossings_defaults();
    c.backend = (iso_backend)model;
    c.kind = w->out->axis < 0 ? ISO_SECTION_CLOCK : ISO_SECTION_AXIS;
    c.axis = w->out->axis < 0 || g->each ? ISO_AXIS_AUTO : w->out->axis;
    c.value = w->out->turn;
    c.deviations = true;
    c.tolerance = are_spread(g) ? w->spread_tolerance : o->tolerance;
    c.shown = w->out->axis < 0 ? ISO_SHOW_BALL : (iso_models)model;
    c.threads = o->threads;
    c.vectors = o->vectors;
    model_walk *r = &g->model[model];
    for (size_t i = 0; i < g->count; i++) r->wanted[i] = follows(g, model, i);
    return iso_crossings_create(w->ctx, g->orbit, g->count, &c, &r->crossings);
}

/* Sets the indications by one model. */
static void tell(group *g, int model)
{
    for (size_t i = 0; i < g->count; i++)
        iso_indicators_read(&g->model[model].shown[i], &orbit_of(g, i)->result[model]);
}

/* The turns until the next look at the orbits that go on, at most ROUND; 0: none goes on. */
static size_t turns_of_round(const group *g, int model)
{
    const model_walk *r = &g->model[model];
    for (size_t i = 0; i < g->count; i++) {
        if (!r->wanted[i]) continue;
        const long turns = r->shown[i].turns, next = iso_indicators_next(&r->shown[i]),
                   most = most_turns(g, model, i);
        const long left = (next < most ? next : most) - turns;
        return left < ROUND ? (size_t)left : ROUND;
    }
    return 0;
}

/* One round of one model. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
static iso_status go_on(group *g, int model, bool *any)
{
    model_walk *r = &g->model[model];
    r->each = turns_of_round(g, model);
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

/* An orbit with a verdict counts as done. The point goes first. */
static void show_progress(const group *g, int model)
{
    const iso_chaos_walk *w = g->w;
    const model_walk *r = &g->model[model];
    const bool both = w->out->with[ISO_BALL] && w->out->with[ISO_POINT];
    double done = both && model == ISO_BALL ? (double)g->count : 0;
    if (!w->options.progress) return;
    for (size_t i = 0; i < g->count; i++)
        done += r->wanted[i] ? (double)r->shown[i].turns / (double)most_turns(g, model, i) : 1;
    const double all = (double)(w->options.starts + w->options.at_count) + 1;
    w->options.progress(fmin(1, ((double)g->first + done / (both ? 2 : 1)) / all), w->options.data);
}

/* The verdict of both models. */
static void judge(const iso_chaos *c, iso_chaos_orbit *orbit)
{
    bool found[3] = {false, false, false};
    for (int m = 0; m < 2; m++)
        if (c->with[m]) found[orbit->result[m].verdict] = true;
    orbit->disagree = found[ISO_REGULAR] && found[ISO_CHAOTIC];
    orbit->verdict = orbit->disagree      ? ISO_UNDECIDED
                     : found[ISO_CHAOTIC] ? ISO_CHAOTIC
                     : found[ISO_REGULAR] ? ISO_REGULAR
                                          : ISO_UNDECIDED;
}

static iso_status follow_by(group *g, int model)
{
    iso_status status = open_model(g, model);
    for (bool any = true; any && status == ISO_OK;) {
        any = false;
        status = go_on(g, model, &any);
        show_progress(g, model);
    }
    iso_crossings_free(g->model[model].crossings);
    g->model[model].crossings = NULL;
    return status;
}

/* Each model follows an orbit until its own end, even if the other model has decided before. */
static iso_status follow_group(group *g)
{
    static const int order[] = {ISO_POINT, ISO_BALL};
    iso_chaos *c = g->w->out;
    iso_status status = ISO_OK;
    make_starts(g);
    for (int m = 0; m < 2; m++) begin_model(g, m);
    for (int i = 0; i < 2 && status == ISO_OK; i++)
        if (c->with[order[i]]) status = follow_by(g, order[i]);
    for (int m = 0; m < 2; m++)
        if (c->with[m]) tell(g, m);
    for (size_t i = 0; i < g->count; i++) judge(c, orbit_of(g, i));
    return status;
}

/* The scene's own orbit must be followed by one model at least. */
iso_status iso_chaos_check_own(const iso_chaos_walk *w)
{
    const iso_chaos *c = w->out;
    for (int m = 0; m < 2; m++)
        if (c->with[m] && c->own.status[m] == ISO_OK) return ISO_OK;
    return iso_context_fail(w->ctx, c->failure, iso_context_about(w->ctx), "%s", c->words);
}

/* A rotation in a principal plane is periodic, so regular. */
static void tell_plane(iso_chaos *c)
{
    iso_indicators none;
    c->own = (iso_chaos_orbit){.l = NAN, .x = NAN, .verdict = ISO_REGULAR};
    iso_indicators_begin(&none, 1);
    for (int m = 0; m < 2; m++) {
        iso_indicators_read(&none, &c->own.result[m]);
        if (c->with[m]) c->own.result[m].verdict = ISO_REGULAR;
    }
}

static iso_status follow_all(group *g)
{
    iso_chaos_walk *w = g->w;
    const size_t spread = w->options.starts, orbits = spread + w->options.at_count + 1;
    iso_status status = ISO_OK;
    for (int m = 0; m < 2 && status == ISO_OK; m++)
        if (w->out->with[m]) status = create_trace(w, m);
    if (w->out->plane >= 0) tell_plane(w->out);
    for (size_t first = w->out->plane >= 0; first < orbits && status == ISO_OK; first += g->count) {
        g->first = first;
        const size_t end = first == 0 ? 1 : first <= spread ? spread + 1 : orbits; /* of orbits of one kind */
        g->count = end - first < GROUP ? end - first : GROUP;
        status = follow_group(g);
        if (first == 0 && status == ISO_OK) status = iso_chaos_check_own(w);
        w->out->starts = first + g->count - 1;
    }
    return status;
}

/* The own orbits of many scenes. */
static iso_status follow_each(group *g, size_t count, iso_chaos_walk *const each[])
{
    iso_status status = ISO_OK;
    for (size_t first = 0; first < count && status == ISO_OK; first += g->count) {
        g->each = each + first;
        g->count = count - first < GROUP ? count - first : GROUP;
        status = follow_group(g);
    }
    return status;
}

/* Makes room for a group of orbits of the scene w, and follows all orbits. */
static iso_status with_group(iso_chaos_walk *w, size_t most, size_t count, iso_chaos_walk *const each[])
{
    group *g = calloc(1, sizeof *g);
    const size_t cells = ROUND * most;
    iso_status status = ISO_OK;
    if (g) {
        g->w = w;
        g->crossing = malloc(cells * sizeof *g->crossing);
        g->sample = w->out->axis < 0 ? malloc(cells * sizeof *g->sample) : NULL;
    }
    if (!g || !g->crossing || (w->out->axis < 0 && !g->sample)) status = iso_context_no_memory(w->ctx, "the orbits");
    if (status == ISO_OK) status = each ? follow_each(g, count, each) : follow_all(g);
    if (g) {
        free(g->crossing);
        free(g->sample);
    }
    free(g);
    return status;
}

iso_status iso_chaos_follow(iso_chaos_walk *w)
{
    return with_group(w, w->options.starts + w->options.at_count > 0 ? GROUP : 1, 0, NULL);
}

iso_status iso_chaos_follow_each(size_t count, iso_chaos_walk *const walk[])
{
    return with_group(walk[0], count < GROUP ? count : GROUP, count, walk);
}
