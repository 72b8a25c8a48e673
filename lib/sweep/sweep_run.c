/* sweep_run.c - quantities of one run, as studies: the state at its end or at a turn, its errors, and when contact is
 * lost. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instrument/section/section.h"
#include "orbit/orbit_impl.h"
#include "study/options_impl.h"
#include "sweep/sweep_impl.h"
#include "task/run.h"

typedef iso_state_request run_request;

ISO_STUDY_BEGIN(run_request, (run_request){(iso_models)-1, (iso_models)-1, NAN, NAN, NAN, NULL})

#define ROW_END_OF_RUN                                                                                               \
    ISO_OPTION("t-end", "T", "a number", "the end, in place of the scene's", iso_set_number, run_request, end)

/* The scene with the changes that the sweep asks for. */
static iso_scene scene_of(const run_request *r, const iso_scene *scene)
{
    iso_scene s = *scene;
    if (!isnan(r->end)) s.end = r->end;
    if (!isnan(r->tolerance)) s.tolerance = r->tolerance;
    if ((int)r->as >= 0) s.as = r->as, s.columns = 0;
    return s;
}

static iso_models shown_of(const iso_scene *s)
{
    return s->as == ISO_SHOW_START ? (iso_models)s->start.model : s->as;
}

/* --- state ------------------------------------------------------------------------------------------------------ */

/* At a turn: clocks, chart, and the states of the models shown. */
void iso_sweep_add_state(iso_sweep_job *job)
{
    const run_request *r = job->options;
    const iso_scene s = scene_of(r, job->base);
    const iso_models as = shown_of(&s);
    int columns[ISO_MAX_COLUMNS], count = 0;
    if (isnan(r->turns)) {
        count = iso_scene_column_list(&s, columns);
    } else {
        iso_sweep_add(job, "t tau s l x");
        for (int i = 0; i < ISO_STATE && as != ISO_SHOW_POINT; i++) columns[count++] = ISO_COLUMN_BALL + i;
        for (int i = 0; i < ISO_STATE && as != ISO_SHOW_BALL; i++) columns[count++] = ISO_COLUMN_POINT + i;
    }
    for (int i = 0; i < count; i++) iso_sweep_add(job, iso_column_name(columns[i]));
}

/* A crossing takes about 0.2 ms by both models, and a ball about 2 microseconds to turn by 1 radian. */
size_t iso_sweep_state_chunk(const iso_sweep_job *job)
{
    enum { MOST = 64 };
    static const iso_scene none;
    const run_request *r = job->options;
    const iso_scene s = scene_of(r, job->base ? job->base : &none);
    const double *y = s.start.y, speed = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    const double point = isnan(r->turns) ? 2e-6 * fabs(s.end) * speed : 2e-4 * r->turns;
    return point < 1.0 / MOST ? MOST : point < 1 ? (size_t)(1 / point) : 1;
}

/* The last row that there is, in a table of one row. */
typedef struct last_row {
    iso_context *ctx;
    iso_record **table;
} last_row;

static iso_status begin_table(void *data, int table, const iso_record *header)
{
    const last_row *last = data;
    double *row;
    if (table > 0) return ISO_OK;
    ISO_TRY(iso_record_create_like(last->ctx, header, 0, NULL, last->table));
    ISO_TRY(iso_record_append(last->ctx, *last->table, &row));
    for (size_t i = 0; i < iso_record_columns(header); i++) row[i] = NAN;
    return ISO_OK;
}

static iso_status keep_row(void *data, int table, const double row[], size_t count)
{
    const last_row *last = data;
    if (table == 0) memcpy(iso_record_row(*last->table, 0), row, count * sizeof *row);
    return ISO_OK;
}

static iso_status state(iso_context *ctx, const iso_study_subject *subject, const void *options,
                        iso_study_result *result)
{
    const run_request *r = options;
    const iso_scene s = scene_of(r, subject->scene);
    last_row last = {ctx, &result->table[0]};
    const iso_sink sink = {.header = begin_table, .row = keep_row, .data = &last};
    ISO_TRY(iso_scene_check_columns(ctx, &s));
    if (isnan(r->turns)) {
        const iso_run_options at_end = {.times = &s.end, .count = 1};
        return iso_run(ctx, &s, &at_end, &sink, NULL, NULL);
    }
    iso_section_options o = iso_section_defaults();
    iso_section_result found;
    o.crossings = (size_t)r->turns;
    o.shown = shown_of(&s);
    if ((int)r->models >= 0) o.models = r->models;
    o.threads = 1;
    o.vectors = r->vectors;
    ISO_TRY(iso_section_run(ctx, &s, &o, &sink, NULL, &found));
    return found.failed == 0 ? ISO_OK : iso_context_fail(ctx, found.failure, "", "%s", found.words);
}

static iso_status prepare(iso_context *ctx, void *options)
{
    const run_request *r = options;
    if ((int)r->models < 0 || !isnan(r->turns)) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "model", "'model' is for 'until: {turns: ...}'");
}

static const iso_option state_options[] = {
    ISO_OPTION_MODELS("as", "WHAT", "which model is written: ball, point, both", run_request, as),
    ISO_OPTION_MODELS("model", "M", ISO_MODELS_INTEGRATED, run_request, models),
    ISO_OPTION("turns", "N", "a whole number from 1 on", "the state at this crossing of the section", iso_set_count,
               run_request, turns),
    ROW_END_OF_RUN,
    ISO_OPTION_END,
};

/* Beside the columns of trajectories. */
static const iso_field state_fields[] = {
    {.name = "l", .unit = "rad", .doc = "angle of the crossing on the section, in (-pi, pi]"},
    {.name = "x", .unit = "", .doc = "the other coordinate, M_a/|M| on the section n_a = 0"},
    ISO_FIELD_END,
};

const iso_study iso_state_study = {
    ISO_STUDY_AS("state", run_request, state_options, "the state at the end (the time of `until`, or the turn)"),
    .prepare = prepare, .run = state, .of = ISO_STUDY_OF_SCENE, .fields = state_fields};

/* --- a whole run -------------------------------------------------------------------------------------------------- */

/* All rows of the scene, of which none is kept. errors: they are asked for. */
static iso_status run_all(iso_context *ctx, const iso_scene *scene, const run_request *r, bool errors,
                          const iso_field *fields, iso_study_result *result)
{
    const iso_scene s = scene_of(r, scene);
    const iso_sink nobody = {.data = NULL};
    const iso_run_options o = {.errors = errors};
    iso_run_result *found = iso_study_keep(result, malloc(sizeof *found), fields, free);
    return found ? iso_run(ctx, &s, &o, &nobody, NULL, found) : iso_context_no_memory(ctx, "a run");
}

#define FIELD(key, member, unit, doc) ISO_MEMBER(iso_run_result, key, member, unit, doc)

static const iso_field error_fields[] = {
    FIELD("ball", error.state[ISO_BALL].worst, "", "the largest error of omega and n, each by its length"),
    FIELD("ball_last", error.state[ISO_BALL].last, "", "that of the last row"),
    FIELD("point", error.state[ISO_POINT].worst, "", "the largest error of M and gamma, each by its length"),
    FIELD("point_last", error.state[ISO_POINT].last, "", "that of the last row"),
    FIELD("start", error.start, "", "the part of the largest error that the start's rounding makes"),
    ISO_FIELD_END,
};

static iso_status error(iso_context *ctx, const iso_study_subject *subject, const void *options,
                        iso_study_result *result)
{
    ISO_TRY(run_all(ctx, subject->scene, options, true, error_fields, result));
    const iso_run_result *r = result->found;
    if (r->error_status == ISO_OK) return ISO_OK;
    return iso_context_fail(ctx, r->error_status, "", "the error is not known: %s", r->error_words);
}

static const iso_option error_options[] = {
    ISO_OPTION("tolerance", "X", "a number in " ISO_TOLERANCE_RANGE, "in place of the scene's", iso_set_tolerance,
               run_request, tolerance),
    ROW_END_OF_RUN,
    ISO_OPTION_END,
};

const iso_study iso_error_study = {
    ISO_STUDY_AS("error", run_request, error_options, "the largest errors over the rows of `run`, at a tolerance"),
    .run = error, .of = ISO_STUDY_OF_SCENE, .fields = error_fields};

/* A run goes on one side of the start. */
static bool is_lost(const void *run)
{
    const iso_run_result *r = run;
    return r->lost[0] || r->lost[1];
}

static double lost_at(const void *run)
{
    const iso_run_result *r = run;
    return r->lost_at[r->lost[1]];
}

static const iso_field contact_fields[] = {
    ISO_IS("lost", is_lost, "1: contact is lost before the end"),
    ISO_NUMBER("time", lost_at, "time", "when it is lost first", .there = is_lost),
    ISO_FIELD_END,
};

static iso_status contact(iso_context *ctx, const iso_study_subject *subject, const void *options,
                          iso_study_result *result)
{
    if (!iso_effects_watch_contact(&subject->scene->effects))
        return ISO_FAIL_INPUT(ctx, "effects", "the scene needs the effect 'reactions'");
    return run_all(ctx, subject->scene, options, false, contact_fields, result);
}

static const iso_option contact_options[] = {ROW_END_OF_RUN, ISO_OPTION_END};

const iso_study iso_contact_study = {
    ISO_STUDY_AS("contact", run_request, contact_options, "whether contact is lost before the end, and when first"),
    .run = contact, .of = ISO_STUDY_OF_SCENE, .fields = contact_fields};
