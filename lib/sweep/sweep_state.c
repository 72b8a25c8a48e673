/* sweep_state.c - quantities of one trajectory: its state at the end, what the backends differ by, its error, and
 * when contact is lost. */
#include <math.h>
#include <string.h>

#include "orbit/orbit_impl.h"
#include "study/compare.h"
#include "study/run.h"
#include "study/section/section.h"
#include "sweep/sweep_impl.h"

static const char *shown_word(int i)
{
    static const char *const words[] = {"ball", "point", "both"};
    return i < 3 ? words[i] : NULL;
}

/* The scene with the end that the sweep asks for. */
static iso_scene until(const iso_sweep_job *ask, const iso_scene *scene)
{
    iso_scene s = *scene;
    if (!isnan(ask->time)) s.end = ask->time;
    return s;
}

/* --- state ------------------------------------------------------------------------------------------------------ */

static iso_scene shown_scene(const iso_sweep_job *ask, const iso_scene *scene)
{
    iso_scene s = until(ask, scene);
    if (!isnan(ask->setting[0])) {
        s.as = (iso_models)ask->setting[0];
        s.columns = 0;
    }
    return s;
}

/* At a turn: clocks, chart, and the states of the models shown. */
static int columns_at_turn(const iso_scene *s, const char *name[])
{
    static const char *const chart[] = {"t", "tau", "s", "l", "x"};
    const iso_models as = s->as == ISO_SHOW_START ? (iso_models)s->start.model : s->as;
    int count = iso_sweep_names(name, 5, chart);
    for (int i = 0; i < ISO_STATE && as != ISO_SHOW_POINT; i++) name[count++] = iso_column_name(ISO_COLUMN_BALL + i);
    for (int i = 0; i < ISO_STATE && as != ISO_SHOW_BALL; i++) name[count++] = iso_column_name(ISO_COLUMN_POINT + i);
    return count;
}

static int state_columns(const iso_sweep_job *ask, const char *name[])
{
    const iso_scene s = shown_scene(ask, ask->base);
    int columns[ISO_MAX_COLUMNS];
    if (!isnan(ask->turns)) return columns_at_turn(&s, name);
    int count = iso_scene_columns(&s, columns);
    if (count > ISO_SWEEP_NUMBERS) count = ISO_SWEEP_NUMBERS;
    for (int i = 0; i < count; i++) name[i] = iso_column_name(columns[i]);
    return count;
}

static iso_status state_refuse(iso_context *ctx, const iso_sweep_job *ask)
{
    const iso_scene s = shown_scene(ask, ask->base);
    if (!isnan(ask->setting[1]) && isnan(ask->turns))
        return iso_context_fail(ctx, ISO_BAD_INPUT, "model", "'model' is for 'until: {turns: ...}'");
    return iso_scene_check_columns(ctx, &s);
}

/* The last row there is. */
typedef struct last_row {
    const iso_sweep_job *ask;
    double *number;
    const char *name[ISO_SWEEP_NUMBERS];
    int at[ISO_SWEEP_NUMBERS]; /* where the column stands in a row; -1: it is not there */
} last_row;

static iso_status find_columns(void *data, const iso_record *header)
{
    last_row *last = data;
    for (int i = 0; i < last->ask->count; i++) last->at[i] = iso_record_find(header, last->name[i]);
    return ISO_OK;
}

static iso_status keep_row(void *data, const double row[], size_t count)
{
    last_row *last = data;
    (void)count;
    for (int i = 0; i < last->ask->count; i++)
        if (last->at[i] >= 0) last->number[i] = row[last->at[i]];
    return ISO_OK;
}

static iso_status at_turn(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *s, last_row *last)
{
    const iso_section_sink sink = {.header = find_columns, .row = keep_row, .data = last};
    iso_section_options o = iso_section_defaults();
    iso_section_result result;
    o.crossings = (size_t)ask->turns;
    o.shown = s->as == ISO_SHOW_START ? (iso_models)s->start.model : s->as;
    if (!isnan(ask->setting[1])) o.models = (iso_models)ask->setting[1];
    o.threads = 1;
    o.vectors = ask->vectors;
    const iso_status status = iso_section_run(ctx, s, &o, &sink, &result);
    if (status != ISO_OK || result.failed == 0) return status;
    for (int i = 0; i < ask->count; i++) last->number[i] = NAN; /* of an earlier turn */
    return iso_context_fail(ctx, result.failure, "", "%s", result.words);
}

static iso_status state_find(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene, double number[])
{
    const iso_scene s = shown_scene(ask, scene);
    last_row last = {.ask = ask, .number = number};
    const iso_run_sink sink = {.header = find_columns, .row = keep_row, .data = &last};
    iso_run_options o = iso_run_defaults();
    state_columns(ask, last.name);
    if (!isnan(ask->turns)) return at_turn(ctx, ask, &s, &last);
    o.times = &s.end;
    o.count = 1;
    return iso_run(ctx, &s, &o, &sink, NULL);
}

/* A crossing takes about 0.2 ms by both models, and a ball about 2 microseconds to turn by 1 radian. */
static size_t state_chunk(const iso_sweep_job *ask)
{
    enum { MOST = 64 };
    static const iso_scene none;
    const iso_scene *base = ask->base ? ask->base : &none;
    const double *y = base->start.y, end = isnan(ask->time) ? base->end : ask->time;
    const double point =
        isnan(ask->turns) ? 2e-6 * fabs(end) * sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]) : 2e-4 * ask->turns;
    return point < 1.0 / MOST ? MOST : point < 1 ? (size_t)(1 / point) : 1;
}

static const iso_sweep_setting state_settings[] = {
    {.name = "as", .word = shown_word, .usual = NAN},
    {.name = "model", .word = shown_word, .usual = NAN},
    {.name = NULL},
};

const iso_sweep_computation iso_sweep_state = {
    .topic = {.name = "state",
              .doc = "the state at the end (the time of `until`, or the turn)",
              .settings = state_settings,
              .turns = true,
              .time = true},
    .columns = state_columns,
    .chunk = state_chunk,
    .refuse = state_refuse,
    .find = state_find,
};

/* --- backends --------------------------------------------------------------------------------------------------- */

/* The names of iso_comparison.difference: those of the clocks depend on the scene's own. */
static int backends_columns(const iso_sweep_job *ask, const char *name[])
{
    static const char *const of_ball[] = {"omega", "n", "M", "gamma", "tau", "s", "largest"}, *const of_point[] = {
                                                                                                  "omega",  "n",
                                                                                                  "M",      "gamma",
                                                                                                  "t",      "tau",
                                                                                                  "largest"};
    return iso_sweep_names(name, 7, ask->base->start.model == ISO_BALL ? of_ball : of_point);
}

static iso_status backends_refuse(iso_context *ctx, const iso_sweep_job *ask)
{
    const iso_effects acting = iso_scene_acting(ask->base);
    const iso_effect *breaking = iso_effects_breaking(&acting);
    if (!breaking) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, breaking->name, "'%s' breaks the isomorphism: %s", breaking->name,
                            iso_effect_why_broken(breaking));
}

/* `largest` is that of the states. */
static iso_status backends_find(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene, double number[])
{
    const iso_scene s = until(ask, scene);
    const char *name[ISO_SWEEP_NUMBERS];
    iso_comparison *c = NULL;
    const iso_status status = iso_compare(ctx, &s, NULL, NULL, &c);
    for (int i = 0; i < backends_columns(ask, name) - 1 && status == ISO_OK; i++) {
        const int column = iso_record_find(c->difference, name[i]);
        if (column > 0) number[i] = c->worst[column];
        if (i < 4) number[6] = i == 0 ? number[0] : fmax(number[6], number[i]);
    }
    iso_comparison_free(c);
    return status;
}

static size_t few(const iso_sweep_job *ask)
{
    (void)ask;
    return 8;
}

const iso_sweep_computation iso_sweep_backends = {
    .topic = {.name = "backends",
              .doc = "the largest differences of the backends over the rows of `compare`",
              .time = true},
    .columns = backends_columns,
    .chunk = few,
    .refuse = backends_refuse,
    .find = backends_find,
};

/* --- error ------------------------------------------------------------------------------------------------------ */

static int error_columns(const iso_sweep_job *ask, const char *name[])
{
    static const char *const names[] = {"ball", "ball_last", "point", "point_last", "start"};
    (void)ask;
    return iso_sweep_names(name, 5, names);
}

static iso_status error_find(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene, double number[])
{
    iso_scene s = until(ask, scene);
    const iso_run_sink sink = {.data = NULL};
    iso_run_options o = iso_run_defaults();
    iso_run_result r;
    o.errors = true;
    if (!isnan(ask->setting[0])) s.tolerance = ask->setting[0];
    const iso_status status = iso_run(ctx, &s, &o, &sink, &r);
    if (status != ISO_OK) return status;
    if (r.error_status != ISO_OK)
        return iso_context_fail(ctx, r.error_status, "", "the error is not known: %s", r.error_words);
    for (int m = 0; m < 2; m++) {
        number[2 * m] = r.error.state[m].worst;
        number[2 * m + 1] = r.error.state[m].last;
    }
    number[4] = r.error.start;
    return ISO_OK;
}

static const iso_sweep_setting error_settings[] = {
    {.name = "tolerance", .usual = NAN, .least = 1e-15, .most = 0.1},
    {.name = NULL},
};

const iso_sweep_computation iso_sweep_error = {
    .topic = {.name = "error",
              .doc = "the largest errors over the rows of `run`, at a tolerance",
              .settings = error_settings,
              .time = true},
    .columns = error_columns,
    .chunk = few,
    .find = error_find,
};

/* --- contact ---------------------------------------------------------------------------------------------------- */

static int contact_columns(const iso_sweep_job *ask, const char *name[])
{
    static const char *const names[] = {"lost", "time"};
    (void)ask;
    return iso_sweep_names(name, 2, names);
}

static iso_status contact_refuse(iso_context *ctx, const iso_sweep_job *ask)
{
    if (iso_effects_watch_contact(&ask->base->effects)) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, "effects", "the scene needs the effect 'reactions'");
}

/* The side of the start on which the end lies. */
static iso_status contact_find(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene, double number[])
{
    const iso_scene s = until(ask, scene);
    const iso_run_sink sink = {.data = NULL};
    iso_run_result r;
    const iso_status status = iso_run(ctx, &s, NULL, &sink, &r); /* row by row, as the command `run` */
    const int side = s.end < 0;
    if (status != ISO_OK) return status;
    number[0] = r.lost[side];
    if (r.lost[side]) number[1] = r.lost_at[side];
    return ISO_OK;
}

const iso_sweep_computation iso_sweep_contact = {
    .topic = {.name = "contact", .doc = "whether contact is lost before the end, and when first", .time = true},
    .columns = contact_columns,
    .chunk = state_chunk,
    .refuse = contact_refuse,
    .find = contact_find,
};
