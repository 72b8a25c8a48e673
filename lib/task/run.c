/* run.c - the trajectory of a scene, see run.h: the orbit behind the columns, the header, the order of the times, the
 * moment at which contact is lost, and the rows. */
#include "task/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/context_impl.h"
#include "base/number_impl.h"
#include "base/version.h"
#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"
#include "task/task_impl.h"

/* --- the orbit behind the columns ------------------------------------------------------------------------------- */

/* Options of the orbit that fills these columns (iso_scene_column_list) and computes nothing else. Writes *effects; the
 * options point to it. */
static iso_orbit_options orbit_options(const iso_scene *scene, const int columns[], int count, iso_effects *effects)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    bool ball = false, point = false, M = false;
    for (int i = 0; i < count; i++) {
        if (columns[i] < ISO_CLOCKS) o.with_clock[columns[i]] = true;
        ball = ball || (columns[i] >= ISO_COLUMN_BALL && columns[i] < ISO_COLUMN_POINT) ||
               columns[i] >= ISO_COLUMN_EFFECTS;
        point = point || (columns[i] >= ISO_COLUMN_POINT && columns[i] < ISO_COLUMN_EFFECTS);
        M = M || (columns[i] >= ISO_COLUMN_POINT && columns[i] < ISO_COLUMN_POINT + 3);
    }
    *effects = scene->effects;
    for (iso_effect_id e = 0; e < ISO_EFFECTS;
         e++) { /* an observer with states is left out if no column shows them */
        const iso_effect *effect = iso_effect_list[e];
        bool seen = !(effect->observes && effect->states && effect->columns);
        for (int i = 0; i < count; i++) seen = seen || iso_column_effect(columns[i]) == e;
        effects->on[e] = effects->on[e] && seen;
    }
    ball = ball || iso_effects_ball_only(effects); /* to see where contact is lost */
    o.effects = effects;
    o.shown = ball && point ? ISO_SHOW_BOTH
              : ball        ? ISO_SHOW_BALL
              : point       ? ISO_SHOW_POINT
                            : (iso_models)scene->start.model;
    o.gamma_alone = point && !M;
    o.backend = scene->backend;
    o.method = iso_method_find(scene->method);
    o.tolerance = scene->tolerance;
    return o;
}

iso_status iso_scene_orbit(iso_context *ctx, const iso_scene *scene, const int columns[], int count,
                           iso_orbit **orbit)
{
    iso_effects effects;
    const iso_orbit_options o = orbit_options(scene, columns, count, &effects);
    const iso_run_extent q = {.rows = iso_scene_rows(scene), .farthest = scene->end};
    return iso_backend_open(ctx, scene, &o, &q, orbit);
}

/* --- a run ------------------------------------------------------------------------------------------------------ */

typedef struct runner {
    iso_context *ctx;
    const iso_scene *scene;
    const iso_sink *sink;
    iso_record **rows; /* NULL: none are kept */
    iso_run_options options;
    iso_run_result *result;
    iso_monitor monitor; /* the caller's */
    int columns[ISO_MAX_COLUMNS], count;
    iso_effects effects;
    iso_orbit_options how; /* the orbit's */
    iso_orbit *orbit;
    iso_error_finder *errors; /* NULL: not asked for, or not known */
    iso_asked_time *order;    /* of the work; NULL: it is that of the times asked for */
    double farthest;          /* time */
    /* rows found in another order than asked for wait here until all are found */
    double *waiting;
    bool *found;
    /* contact */
    bool pressed;      /* the support presses the ball at the start: the ball can lose contact */
    double safe_to[2]; /* after the start and before it: contact is known to last to this time  */
} runner;

static void note(const runner *r, const char *text)
{
    if (r->sink->note) r->sink->note(r->sink->data, text);
}

/* --- the header ------------------------------------------------------------------------------------------------- */

static iso_status write_header(const runner *r)
{
    const char *names[ISO_MAX_COLUMNS];
    const iso_scene *scene = r->scene;
    const iso_models as = scene->as == ISO_SHOW_START ? (iso_models)scene->start.model : scene->as;
    iso_record *h = NULL;
    for (int i = 0; i < r->count; i++) names[i] = iso_column_name(r->columns[i]);
    iso_status status = iso_record_create(r->ctx, (size_t)r->count, names, &h);
    if (status == ISO_OK) status = iso_record_describe(r->ctx, h, iso_models_name((int)as), &scene->params, r->orbit);
    if (status == ISO_OK)
        status = iso_record_set(r->ctx, h, "backend", iso_backend_name((int)iso_orbit_backend(r->orbit)));
    if (status == ISO_OK) status = iso_record_set(r->ctx, h, "method", iso_orbit_method(r->orbit)->name);
    if (status == ISO_OK && !iso_orbit_exact(r->orbit))
        status = iso_record_set_numbers(r->ctx, h, "tolerance", 1, &scene->tolerance);
    if (status == ISO_OK) status = iso_record_set(r->ctx, h, "isoroll", ISO_VERSION);
    if (status == ISO_OK && r->sink->header) status = r->sink->header(r->sink->data, 0, h);
    if (status == ISO_OK && r->rows)
        *r->rows = h;
    else
        iso_record_free(h);
    return status;
}

/* --- times ------------------------------------------------------------------------------------------------------ */

/* The order of the work, and room for the rows that wait for others. */
static iso_status sort_times(runner *r)
{
    const size_t count = r->options.count;
    if (!r->options.times || iso_times_in_order(r->options.times, count)) return ISO_OK;
    r->order = iso_times_sorted(r->options.times, count);
    r->waiting = calloc(count, (size_t)r->count * sizeof *r->waiting);
    r->found = calloc(count, sizeof *r->found);
    if (!r->order || !r->waiting || !r->found) return iso_context_no_memory(r->ctx, "the rows of %zu times", count);
    return ISO_OK;
}

/* The times, the columns and the method. */
static iso_status check(runner *r)
{
    const iso_run_options *o = &r->options;
    r->farthest = o->times ? 0 : r->scene->end;
    if (!o->times) ISO_TRY(iso_scene_check_times(r->ctx, r->scene));
    if (o->times && o->count == 0) return ISO_FAIL_ARGUMENT(r->ctx, "times", "there are no times");
    for (size_t i = 0; o->times && i < o->count; i++) {
        if (!isfinite(o->times[i]))
            return ISO_FAIL_ARGUMENT(r->ctx, "times", "time %zu must be finite, not %s", i + 1,
                                     ISO_SHORT(o->times[i]));
        if (fabs(o->times[i]) > fabs(r->farthest)) r->farthest = o->times[i];
    }
    ISO_TRY(iso_scene_check_columns(r->ctx, r->scene));
    r->count = iso_scene_column_list(r->scene, r->columns);
    r->result->asked = o->times ? o->count : iso_scene_rows(r->scene);
    return iso_method_check(r->ctx, r->scene->method);
}

/* --- contact ---------------------------------------------------------------------------------------------------- */

/* Nothing presses the ball at the start: looks on which sides of it the support would have to pull a moment later. */
static iso_status look_both_ways(runner *r)
{
    const double end = r->scene->end;
    for (int side = 0; side < 2; side++) {
        iso_sample sample;
        const double moment = (side ? -1e-6 : 1e-6) * (end != 0 ? fabs(end) : 1);
        ISO_TRY(iso_orbit_at(r->orbit, moment, &sample));
        r->result->lost[side] = iso_sample_get(&sample, "pressure") < 0;
    }
    r->pressed = true;
    if (r->result->lost[end < 0]) note(r, "contact is lost at 0: there is a row there, and none beyond");
    return ISO_OK;
}

/* A ball that is pressed to its support at the start can lose contact later. */
static iso_status look_at_contact(runner *r)
{
    const iso_effects *e = &r->scene->effects;
    iso_sample sample;
    char words[160];
    if (!iso_effects_watch_contact(e)) return ISO_OK;
    ISO_TRY(iso_orbit_at(r->orbit, 0, &sample));
    const double pressure = iso_sample_get(&sample, "pressure");
    r->pressed = pressure > 0;
    if (pressure == 0 && iso_effects_change_pressure(&r->scene->params, e)) return look_both_ways(r);
    if (!(pressure < 0)) return ISO_OK;
    snprintf(words, sizeof words,
             "the support would have to pull the ball from the start (pressure %.3g): this is the motion of a "
             "two-sided contact",
             pressure);
    note(r, words);
    return ISO_OK;
}

/* The orbit at `time`. If `auto` has taken another model than the start's, the row of the start has the numbers
 * given, not those that went to the other model and back. */
static iso_status follow_to(runner *r, double time, iso_sample *sample)
{
    const iso_status status = iso_orbit_at(r->orbit, time, sample);
    const bool given = time == 0 && r->scene->backend == ISO_BACKEND_AUTO && r->scene->start.model == ISO_BALL;
    if (status == ISO_OK && given && r->result->backend != ISO_BACKEND_BALL && r->how.shown != ISO_SHOW_POINT)
        memcpy(sample->ball, r->scene->start.y, sizeof sample->ball);
    return status;
}

/* The sample at `time`. If contact is lost on the way there, it is the sample of that moment; for all later calls
 * beyond that moment *row is false: they have no sample. */
static iso_status find_sample(runner *r, double time, iso_sample *sample, bool *row)
{
    char text[128];
    const int side = time < 0;
    bool *lost = &r->result->lost[side];
    *row = true;
    if (!r->pressed || fabs(time) <= fabs(r->safe_to[side])) return follow_to(r, time, sample);
    *row = !*lost;
    if (*lost) return ISO_OK;
    ISO_TRY(iso_orbit_lost_contact(r->orbit, r->safe_to[side], time, lost, sample));
    r->safe_to[side] = *lost ? sample->clock[r->how.clock] : time;
    if (!*lost) return iso_orbit_at(r->orbit, time, sample);
    r->result->lost_at[side] = r->safe_to[side];
    snprintf(text, sizeof text, "contact is lost at %s = %s: there is a row there, and none beyond",
             iso_clock_name(r->how.clock), ISO_SHORT(r->safe_to[side]));
    note(r, text);
    return ISO_OK;
}

/* --- errors of the rows ----------------------------------------------------------------------------------------- */

/* Ends the search for errors; status and words say why they are not known. */
static void end_errors(runner *r, iso_status status, const char *words)
{
    iso_error_finder_free(r->errors);
    r->errors = NULL;
    r->result->error_status = status;
    snprintf(r->result->error_words, sizeof r->result->error_words, "%s", words);
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

static iso_status write_row(runner *r, const double row[])
{
    iso_status status = r->rows ? iso_record_add(r->ctx, *r->rows, 1, row) : ISO_OK;
    if (status == ISO_OK && r->sink->row) status = r->sink->row(r->sink->data, 0, row, (size_t)r->count);
    r->result->rows += status == ISO_OK;
    return status;
}

static iso_status work_on(runner *r, iso_asked_time asked)
{
    double numbers[ISO_MAX_COLUMNS], *row = r->order ? r->waiting + asked.row * (size_t)r->count : numbers;
    iso_sample sample;
    bool there = false;
    if (!iso_context_goes_on(r->ctx)) return iso_context_stopped(r->ctx);
    iso_status status = find_sample(r, asked.time, &sample, &there);
    if (status != ISO_OK || !there) return status;
    if (r->errors) status = iso_error_finder_add(r->errors, &sample); /* before the row is given away */
    if (status == ISO_STOPPED) return status;
    if (status != ISO_OK) end_errors(r, status, iso_context_message(r->ctx));
    for (int c = 0; c < r->count; c++) row[c] = iso_sample_column(&sample, r->columns[c]);
    if (!r->order) return write_row(r, row);
    r->found[asked.row] = true;
    return ISO_OK;
}

static iso_status work(runner *r)
{
    iso_status status = look_at_contact(r);
    for (size_t i = 0; status == ISO_OK && i < r->result->asked; i++)
        status = work_on(r, r->order           ? r->order[i]
                            : r->options.times ? (iso_asked_time){r->options.times[i], i}
                                               : (iso_asked_time){iso_scene_time(r->scene, i), i});
    for (size_t i = 0; r->found && i < r->options.count; i++) /* in the order asked for; after a failure, too */
        if (r->found[i]) ISO_TRY(write_row(r, r->waiting + i * (size_t)r->count));
    return status;
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

/* The context's monitor during the run: shows how far it is, then asks the caller's monitor. */
static bool monitor(void *data)
{
    const runner *r = data;
    const iso_sink *sink = r->sink;
    if (sink->progress && r->orbit && r->farthest != 0)
        sink->progress(sink->data, fmin(fabs(iso_orbit_reached(r->orbit) / r->farthest), 1));
    return iso_monitor_goes_on(&r->monitor);
}

static iso_status open_orbit(runner *r)
{
    r->how = orbit_options(r->scene, r->columns, r->count, &r->effects);
    r->how.memory = 0; /* times are put in order */
    r->result->clock = r->how.clock;
    const iso_run_extent q = {.rows = r->result->asked, .farthest = r->farthest};
    ISO_TRY(iso_backend_open(r->ctx, r->scene, &r->how, &q, &r->orbit));
    r->result->backend = r->how.backend = iso_orbit_backend(r->orbit);
    r->result->method = iso_orbit_method(r->orbit);
    if (!r->options.times) iso_orbit_expect_even_times(r->orbit);
    return iso_orbit_check_time(r->orbit, r->farthest);
}

static void close_run(runner *r)
{
    if (r->orbit) r->result->statistics = iso_orbit_statistics(r->orbit);
    if (r->errors) {
        r->result->error = iso_error_finder_read(r->errors);
        const bool any = r->result->error.rows > 0;
        end_errors(r, any ? ISO_OK : ISO_BAD_ARGUMENT, any ? "" : "there is no row");
    }
    iso_orbit_free(r->orbit);
    free(r->order);
    free(r->waiting);
    free(r->found);
}

iso_status iso_run(iso_context *ctx, const iso_scene *scene, const iso_run_options *options, const iso_sink *sink,
                   iso_record **rows, iso_run_result *result)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_run_result unused;
    runner r = {.ctx = ctx, .scene = scene, .sink = sink, .rows = rows, .result = result ? result : &unused};
    r.options = iso_run_defaults();
    r.monitor = iso_context_monitor(ctx);
    *r.result = (iso_run_result){.error_status = ISO_BAD_ARGUMENT, .error_words = "errors were not asked for"};
    if (options) r.options = *options;
    iso_status status = check(&r);
    if (status == ISO_OK) status = sort_times(&r);
    if (status == ISO_OK) status = open_orbit(&r);
    if (status == ISO_OK && r.options.errors) {
        const iso_status errors =
            iso_error_finder_create(ctx, &scene->params, &scene->start, &r.how, r.orbit, &r.errors);
        if (errors != ISO_OK) end_errors(&r, errors, iso_context_message(ctx));
    }
    if (status == ISO_OK) status = write_header(&r);
    iso_context_set_monitor(ctx, monitor, &r);
    if (status == ISO_OK) status = work(&r);
    iso_context_set_monitor(ctx, r.monitor.go_on, r.monitor.data);
    close_run(&r);
    return status;
}

/* --- times ------------------------------------------------------------------------------------------------------ */

static int by_work(const void *first, const void *second)
{
    const iso_asked_time *a = first, *b = second;
    if ((a->time < 0) != (b->time < 0)) return a->time < 0 ? 1 : -1;
    if (a->time != b->time) return fabs(a->time) > fabs(b->time) ? 1 : -1;
    return (a->row > b->row) - (a->row < b->row);
}

bool iso_times_in_order(const double times[], size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (by_work(&(iso_asked_time){times[i - 1], i - 1}, &(iso_asked_time){times[i], i}) > 0) return false;
    return true;
}

iso_asked_time *iso_times_sorted(const double times[], size_t count)
{
    iso_asked_time *order = malloc(count * sizeof *order);
    if (!order) return NULL;
    for (size_t i = 0; i < count; i++) order[i] = (iso_asked_time){times[i], i};
    qsort(order, count, sizeof *order, by_work);
    return order;
}
