/* chaos_walk.c - follows the orbits of chaos.h (orbit/walk_impl.h). In each round the orbits that have not ended go
 * on to the next look. The point goes first, then the ball. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "instrument/chaos/chaos_impl.h"
#include "orbit/crossings_impl.h"
#include "study/fields_impl.h"

/* GROUP: orbits that are followed by the point, then by the ball; as many as a walk has in memory. CHECKED: one of so
 * many starts is followed by the ball, too, if the walk is sampled, for at most CHECK_TURNS. */
enum { GROUP = 1024, TRACE_ROWS = 4000, CHECKED = 16, CHECK_TURNS = 750 };

typedef struct group {
    iso_chaos_walk *w;
    iso_chaos_walk *const *each; /* the scene of each orbit, which is its own orbit; NULL: all have one scene */
    size_t first, count;         /* orbits; orbit 0 is the scene's own, orbit i is start i - 1 */
    int model;                   /* that follows them now */
    iso_indicators shown[2][GROUP];
    bool still[GROUP]; /* an orbit stands still */
} group;

static iso_chaos_walk *walk_of(const group *g, size_t i)
{
    return g->each ? g->each[i] : g->w;
}

static iso_chaos_orbit *orbit_of(const group *g, size_t i)
{
    iso_chaos *c = walk_of(g, i)->out;
    return g->each || i == 0 ? &c->own : &c->start[i - 1];
}

static iso_indicators *shown_of(group *g, int model, size_t i)
{
    return &g->shown[model][i - g->first];
}

static void begin(void *user, size_t i, iso_start *start, iso_batch_orbit *orbit)
{
    group *g = user;
    const iso_chaos_walk *w = walk_of(g, i);
    iso_chaos_orbit *o = orbit_of(g, i);
    iso_starts_orbit(&w->starts, g->each ? 0 : i, &o->l, &o->x, start, orbit);
    g->still[i - g->first] = false;
}

/* --- turns ------------------------------------------------------------------------------------------------------ */

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

static void note_failure(void *user, size_t i, int first, iso_status status, const char *why)
{
    const group *g = user;
    iso_chaos *c = walk_of(g, i)->out;
    (void)first;
    orbit_of(g, i)->status[g->model] = status;
    iso_walk_keep(&c->failure, c->words, g->each ? 0 : i, status, why);
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
static long most_turns(group *g, size_t i)
{
    const iso_chaos_options *o = &g->w->options;
    const iso_verdict verdict = iso_indicators_verdict(shown_of(g, g->model, i));
    const long most = only_checks(g, g->model) && o->turns > CHECK_TURNS ? CHECK_TURNS : o->turns;
    return verdict == ISO_UNDECIDED ? most : verdict == ISO_CHAOTIC ? o->exponent_turns : 0;
}

/* The turns until the next look at orbit i. As a check the ball follows orbits of which the point has found the
 * verdict, by no more turns. */
static size_t wanted(void *user, size_t i)
{
    group *g = user;
    const iso_indicators *shown = shown_of(g, g->model, i), *point = shown_of(g, ISO_POINT, i);
    const long most = most_turns(g, i), next = iso_indicators_next(shown), to = next < most ? next : most;
    if (orbit_of(g, i)->status[g->model] != ISO_OK) return 0;
    if (only_checks(g, g->model) &&
        ((i - 1) % CHECKED != 0 || iso_indicators_verdict(point) == ISO_UNDECIDED || point->decided > CHECK_TURNS))
        return 0;
    return to > shown->turns ? (size_t)(to - shown->turns) : 0;
}

static iso_status take(void *user, size_t i, const iso_walk_stop *stop)
{
    group *g = user;
    const iso_chaos_walk *w = g->w;
    const iso_crossing *c = stop->crossing[0];
    iso_indicators *shown = shown_of(g, g->model, i);
    if (g->still[i - g->first]) return ISO_OK;
    if (isnan(c->growth[0] + c->growth[1])) {
        static const char why[] = "it stands still: its deviations have no length";
        g->still[i - g->first] = true;
        note_failure(g, i, 0, ISO_FAIL_NUMERICAL(w->ctx, "%s", why), why);
        return ISO_OK;
    }
    /* smooth functions of the place, without a symmetry: of M/|M| on the section, else of n */
    const double root = sqrt(fmax(0, 1 - c->x * c->x)), direction[3] = {root * sin(c->l), root * cos(c->l), c->x};
    const double *u = stop->sample ? stop->sample->ball + 3 : direction;
    iso_turn_sample turn = {.area = c->area,
                            .observable = {u[0] + u[0] * u[0], u[1] + u[1] * u[1], u[2] + u[0] * u[1] * u[2]}};
    memcpy(turn.clock, c->clock, sizeof turn.clock);
    memcpy(turn.growth, c->growth, sizeof turn.growth);
    iso_indicators_add(shown, &turn);
    return !g->each && i == 0 ? trace(w, g->model, shown) : ISO_OK;
}

/* --- groups ----------------------------------------------------------------------------------------------------- */

/* An orbit with a verdict counts as done. The point goes first. */
static void show_progress(void *user, double part)
{
    group *g = user;
    const iso_chaos_walk *w = g->w;
    const bool both = w->out->with[ISO_BALL] && w->out->with[ISO_POINT];
    double done = both && g->model == ISO_BALL ? (double)g->count : 0;
    (void)part;
    if (!w->options.progress) return;
    for (size_t i = g->first; i < g->first + g->count; i++)
        done += wanted(g, i) > 0 ? (double)shown_of(g, g->model, i)->turns / (double)most_turns(g, i) : 1;
    const double all = (double)(w->options.starts + w->options.at_count) + 1;
    w->options.progress(w->options.data, fmin(1, ((double)g->first + done / (both ? 2 : 1)) / all));
}

/* The verdict of both models. */
static void find_verdict(const iso_chaos *c, iso_chaos_orbit *orbit)
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
    const iso_chaos_walk *w = g->w;
    const iso_chaos_options *o = &w->options;
    const long most = o->turns > o->exponent_turns ? o->turns : o->exponent_turns;
    iso_walk walk = {.ctx = w->ctx, .first = g->first, .count = g->count, .most = (size_t)most, .models = 1};
    iso_crossings_options *c = &walk.options[0];
    *c = iso_crossings_defaults();
    c->backend = (iso_backend)model;
    c->kind = w->out->axis < 0 ? ISO_SECTION_CLOCK : ISO_SECTION_AXIS;
    c->axis = w->out->axis < 0 || g->each ? ISO_AXIS_AUTO : w->out->axis;
    c->value = w->out->turn;
    c->deviations = true;
    c->tolerance = are_spread(g) ? w->spread_tolerance : o->tolerance;
    c->shown = w->out->axis < 0 ? ISO_SHOW_BALL : (iso_models)model;
    c->threads = o->threads;
    c->vectors = o->vectors;
    walk.samples = w->out->axis < 0;
    walk.user = g, walk.begin = begin, walk.wanted = wanted, walk.visit = take;
    walk.failed_by = note_failure, walk.progress = show_progress;
    g->model = model;
    return iso_walk_go(&walk);
}

/* Each model follows an orbit until its own end, even if the other model has decided before. */
static iso_status follow_group(group *g)
{
    static const int order[] = {ISO_POINT, ISO_BALL};
    const iso_chaos *c = g->w->out;
    const size_t end = g->first + g->count;
    iso_status status = ISO_OK;
    for (size_t i = g->first; i < end; i++) {
        *orbit_of(g, i) = (iso_chaos_orbit){.l = NAN, .x = NAN, .verdict = ISO_UNDECIDED, .number = g->each ? 0 : i};
        for (int m = 0; m < 2; m++) {
            iso_indicators_begin(shown_of(g, m, i), g->w->options.turns);
            shown_of(g, m, i)->integrable = walk_of(g, i)->out->integral != NULL;
        }
    }
    for (int i = 0; i < 2 && status == ISO_OK; i++)
        if (c->with[order[i]]) status = follow_by(g, order[i]);
    for (size_t i = g->first; i < end; i++) {
        for (int m = 0; m < 2; m++)
            if (c->with[m]) iso_indicators_read(shown_of(g, m, i), &orbit_of(g, i)->result[m]);
        find_verdict(c, orbit_of(g, i));
    }
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

static iso_status create_traces(const iso_chaos_walk *w)
{
    for (int m = 0; m < 2; m++) {
        if (!w->out->with[m]) continue;
        ISO_TRY(iso_columns_create(w->ctx, iso_indicator_fields, &w->out->trace[m]));
        iso_record_set_kind(w->out->trace[m], "chaos indicators");
        ISO_TRY(iso_record_set(w->ctx, w->out->trace[m], "model", iso_model_kind_name(m)));
    }
    return ISO_OK;
}

iso_status iso_chaos_follow(iso_chaos_walk *w)
{
    iso_chaos *c = w->out;
    const size_t spread = w->options.starts, orbits = spread + w->options.at_count + 1;
    group *g = calloc(1, sizeof *g);
    iso_status status = g ? create_traces(w) : iso_context_no_memory(w->ctx, "the orbits");
    if (g) g->w = w;
    if (g && c->plane >= 0) { /* a rotation in a principal plane is periodic, so regular */
        c->own = (iso_chaos_orbit){.l = NAN, .x = NAN, .verdict = ISO_REGULAR};
        iso_indicators_begin(&g->shown[0][0], 1);
        for (int m = 0; m < 2; m++) {
            iso_indicators_read(&g->shown[0][0], &c->own.result[m]);
            if (c->with[m]) c->own.result[m].verdict = ISO_REGULAR;
        }
    }
    for (size_t first = c->plane >= 0; first < orbits && status == ISO_OK; first += g->count) {
        g->first = first;
        const size_t end = first == 0 ? 1 : first <= spread ? spread + 1 : orbits; /* of orbits of one kind */
        g->count = end - first < GROUP ? end - first : GROUP;
        status = follow_group(g);
        if (first == 0 && status == ISO_OK) status = iso_chaos_check_own(w);
        c->starts = first + g->count - 1;
    }
    free(g);
    return status;
}

iso_status iso_chaos_follow_each(size_t count, iso_chaos_walk *const walk[])
{
    group *g = calloc(1, sizeof *g);
    if (!g) return iso_context_no_memory(walk[0]->ctx, "the orbits");
    g->w = walk[0];
    g->each = walk;
    iso_status status = ISO_OK;
    for (; g->first < count && status == ISO_OK; g->first += g->count) {
        g->count = count - g->first < GROUP ? count - g->first : GROUP;
        status = follow_group(g);
    }
    free(g);
    return status;
}
