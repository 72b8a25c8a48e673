/* sweep_state.c - quantities of one trajectory: its state at the end, what the backends differ by, its error, and
 * when contact is lost. */
#include <math.h>
#include <string.h>

#include "instrument/section/section.h"
#include "orbit/orbit_impl.h"
#include "sweep/sweep_impl.h"
#include "task/compare.h"
#include "task/run.h"

/* The scene with the end that the sweep asks for. */
static iso_scene until(const iso_sweep_job *job, const iso_scene *scene)
{
    iso_scene s = *scene;
    if (!isnan(job->time)) s.end = job->time;
    return s;
}

/* --- state ------------------------------------------------------------------------------------------------------ */

static iso_scene shown_scene(const iso_sweep_job *job, const iso_scene *scene)
{
    iso_scene s = until(job, scene);
    if (!isnan(job->setting[0])) {
        s.as = (iso_models)job->setting[0];
        s.columns = 0;
    }
    return s;
}

/* At a turn: clocks, chart, and the states of the models shown. */
static void state_columns(iso_sweep_job *job)
{
    const iso_scene s = shown_scene(job, job->base);
    const iso_models as = s.as == ISO_SHOW_START ? (iso_models)s.start.model : s.as;
    int columns[ISO_MAX_COLUMNS], count = 0;
    if (isnan(job->turns)) {
        count = iso_scene_columns(&s, columns);
    } else {
        iso_sweep_add(job, "t tau s l x");
        for (int i = 0; i < ISO_STATE && as != ISO_SHOW_POINT; i++) columns[count++] = ISO_COLUMN_BALL + i;
        for (int i = 0; i < ISO_STATE && as != ISO_SHOW_BALL; i++) columns[count++] = ISO_COLUMN_POINT + i;
    }
    for (int i = 0; i < count; i++) iso_sweep_add(job, iso_column_name(columns[i]));
}

static iso_status state_refuse(iso_context *ctx, const iso_sweep_job *job)
{
    const iso_scene s = shown_scene(job, job->base);
    if (!isnan(job->setting[1]) && isnan(job->turns))
        return ISO_FAIL_INPUT(ctx, "model", "'model' is for 'until: {turns: ...}'");
    return iso_scene_check_columns(ctx, &s);
}

/* The last row there is. */
typedef struct last_row {
    const iso_sweep_job *job;
    double *number;
    int at[ISO_SWEEP_NUMBERS]; /* where the column stands in a row; -1: it is not there */
} last_row;

static iso_status find_columns(void *data, const iso_record *header)
{
    last_row *last = data;
    for (int i = 0; i < last->job->count; i++) last->at[i] = iso_record_find(header, last->job->column[i].name);
    return ISO_OK;
}

static iso_status keep_row(void *data, const double row[], size_t count)
{
    last_row *last = data;
    (void)count;
    for (int i = 0; i < last->job->count; i++)
        if (last->at[i] >= 0) last->number[i] = row[last->at[i]];
    return ISO_OK;
}

static iso_status at_turn(iso_context *ctx, const iso_sweep_job *job, const iso_scene *s, last_row *last)
{
    const iso_section_sink sink = {.header = find_columns, .row = keep_row, .data = last};
    iso_section_options o = iso_section_defaults();
    iso_section_result result;
    o.crossings = (size_t)job->turns;
    o.shown = s->as == ISO_SHOW_START ? (iso_models)s->start.model : s->as;
    if (!isnan(job->setting[1])) o.models = (iso_models)job->setting[1];
    o.threads = 1;
    o.vectors = job->vectors;
    const iso_status status = iso_section_run(ctx, s, &o, &sink, &result);
    if (status != ISO_OK || result.failed == 0) return status;
    for (int i = 0; i < job->count; i++) last->number[i] = NAN; /* of an earlier turn */
    return iso_context_fail(ctx, result.failure, "", "%s", result.words);
}

static iso_status state_find(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene, double number[])
{
    const iso_scene s = shown_scene(job, scene);
    last_row last = {.job = job, .number = number};
    const iso_run_sink sink = {.header = find_columns, .row = keep_row, .data = &last};
    iso_run_options o = iso_run_defaults();
    if (!isnan(job->turns)) return at_turn(ctx, job, &s, &last);
    o.times = &s.end;
    o.count = 1;
    return iso_run(ctx, &s, &o, &sink, NULL);
}

/* A crossing takes about 0.2 ms by both models, and a ball about 2 microseconds to turn by 1 radian. */
static size_t state_chunk(const iso_sweep_job *job)
{
    enum { MOST = 64 };
    static const iso_scene none;
    const iso_scene *base = job->base ? job->base : &none;
    const double *y = base->start.y, end = isnan(job->time) ? base->end : job->time;
    const double point =
        isnan(job->turns) ? 2e-6 * fabs(end) * sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]) : 2e-4 * job->turns;
    return point < 1.0 / MOST ? MOST : point < 1 ? (size_t)(1 / point) : 1;
}

static const iso_sweep_setting state_settings[] = {
    {.name = "as", .word = iso_sweep_models, .usual = NAN},
    {.name = "model", .word = iso_sweep_models, .usual = NAN},
    {.name = NULL},
};

/* The others are columns of trajectories. */
static const iso_field state_fields[] = {
    {.name = "l", .unit = "rad", .doc = "angle of the crossing on the section, in (-pi, pi]"},
    {.name = "x", .unit = "", .doc = "the other coordinate, M_a/|M| on the section n_a = 0"},
    ISO_FIELD_END,
};

const iso_sweep_computation iso_sweep_state = {
    .quantity = {.name = "state",
                 .doc = "the state at the end (the time of `until`, or the turn)",
                 .settings = state_settings,
                 .turns = true,
                 .time = true},
    .fields = {state_fields},
    .columns = state_columns,
    .chunk = state_chunk,
    .refuse = state_refuse,
    .find = state_find,
};

/* --- backends --------------------------------------------------------------------------------------------------- */

/* The names of iso_comparison.difference: those of the clocks depend on the scene's own. */
static void backends_columns(iso_sweep_job *job)
{
    iso_sweep_add(job, "omega n M gamma");
    iso_sweep_add(job, job->base->start.model == ISO_BALL ? "tau s largest" : "t tau largest");
}

static iso_status backends_refuse(iso_context *ctx, const iso_sweep_job *job)
{
    const iso_effects acting = iso_scene_acting(job->base);
    const iso_effect *breaking = iso_effects_breaking(&acting);
    return breaking ? iso_orbit_no_point(ctx, breaking) : ISO_OK;
}

/* `largest` is that of the states. */
static iso_status backends_find(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene, double number[])
{
    const iso_scene s = until(job, scene);
    iso_comparison *c = NULL;
    const iso_status status = iso_compare(ctx, &s, NULL, NULL, &c);
    for (int i = 0; i < job->count - 1 && status == ISO_OK; i++) {
        const int column = iso_record_find(c->difference, job->column[i].name);
        if (column > 0) number[i] = c->worst[column];
        if (i < 4) number[6] = i == 0 ? number[0] : fmax(number[6], number[i]);
    }
    iso_comparison_free(c);
    return status;
}

static const iso_field backends_fields[] = {
    {.name = "omega", .unit = "", .doc = "the largest difference of omega, by its length"},
    {.name = "n", .unit = "", .doc = "of n"},
    {.name = "M", .unit = "", .doc = "of M, by its length"},
    {.name = "gamma", .unit = "", .doc = "of gamma"},
    {.name = "t", .unit = "", .doc = "of t, by its largest value"},
    {.name = "tau", .unit = "", .doc = "of tau, by its largest value"},
    {.name = "s", .unit = "", .doc = "of s, by its largest value"},
    {.name = "largest", .unit = "", .doc = "the largest of omega, n, M and gamma"},
    ISO_FIELD_END,
};

const iso_sweep_computation iso_sweep_backends = {
    .quantity = {.name = "backends",
                 .doc = "the largest differences of the backends over the rows of `compare`",
                 .time = true},
    .fields = {backends_fields},
    .columns = backends_columns,
    .points = 8,
    .refuse = backends_refuse,
    .find = backends_find,
};

/* --- error ------------------------------------------------------------------------------------------------------ */

static iso_status error_find(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene, double number[])
{
    iso_scene s = until(job, scene);
    const iso_run_sink sink = {.data = NULL};
    iso_run_options o = iso_run_defaults();
    iso_run_result r;
    o.errors = true;
    if (!isnan(job->setting[0])) s.tolerance = job->setting[0];
    ISO_TRY(iso_run(ctx, &s, &o, &sink, &r));
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

static const iso_field error_fields[] = {
    {.name = "ball", .unit = "", .doc = "the largest error of omega and n, each by its length"},
    {.name = "ball_last", .unit = "", .doc = "that of the last row"},
    {.name = "point", .unit = "", .doc = "the largest error of M and gamma, each by its length"},
    {.name = "point_last", .unit = "", .doc = "that of the last row"},
    {.name = "start", .unit = "", .doc = "the part of the largest error that the start's rounding makes"},
    ISO_FIELD_END,
};

const iso_sweep_computation iso_sweep_error = {
    .quantity = {.name = "error",
                 .doc = "the largest errors over the rows of `run`, at a tolerance",
                 .settings = error_settings,
                 .time = true},
    .fields = {error_fields},
    .points = 8,
    .find = error_find,
};

/* --- contact ---------------------------------------------------------------------------------------------------- */

static iso_status contact_refuse(iso_context *ctx, const iso_sweep_job *job)
{
    if (iso_effects_watch_contact(&job->base->effects)) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "effects", "the scene needs the effect 'reactions'");
}

/* The side of the start on which the end lies. */
static iso_status contact_find(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene, double number[])
{
    const iso_scene s = until(job, scene);
    const iso_run_sink sink = {.data = NULL};
    iso_run_result r;
    const iso_status status = iso_run(ctx, &s, NULL, &sink, &r); /* row by row, as the command `run` */
    const int side = s.end < 0;
    if (status != ISO_OK) return status;
    number[0] = r.lost[side];
    if (r.lost[side]) number[1] = r.lost_at[side];
    return ISO_OK;
}

static const iso_field contact_fields[] = {
    {.name = "lost", .unit = "", .doc = "1: contact is lost before the end"},
    {.name = "time", .unit = "time", .doc = "when it is lost first"},
    ISO_FIELD_END,
};

const iso_sweep_computation iso_sweep_contact = {
    .quantity = {.name = "contact", .doc = "whether contact is lost before the end, and when first", .time = true},
    .fields = {contact_fields},
    .chunk = state_chunk,
    .refuse = contact_refuse,
    .find = contact_find,
};
