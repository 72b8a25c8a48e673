/* compare.c - the same orbit by every backend, see compare.h: the rows, the drift of the integrals, and the differences;
 * its numbers with their meaning, and compare by its name (study/study.h). */
#include "task/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/resources_impl.h"
#include "base/vec3_impl.h"
#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"
#include "orbit/watch_impl.h"
#include "study/fields_impl.h"
#include "study/options_impl.h"
#include "task/task_impl.h"

typedef struct comparer {
    iso_context *ctx;
    const iso_scene *scene;
    iso_effects effects; /* those that act */
    iso_comparison *out;
    iso_orbit *orbit[ISO_BACKENDS];
} comparer;

/* --- one backend ------------------------------------------------------------------------------------------------ */

static iso_status open_backend(comparer *r, iso_backend backend)
{
    const int which = r->out->runs;
    iso_backend_run *run = &r->out->run[which];
    iso_orbit_options o = iso_orbit_defaults(&r->scene->start);
    const iso_method *method = iso_method_find(r->scene->method);
    const iso_system *system = backend == ISO_BACKEND_BALL ? &iso_system_ball : &iso_system_point;
    const bool serves = method && (!method->system || method->system == system);
    const char *names[ISO_TRAJECTORY_COLUMNS];
    iso_column_names(names);
    ISO_TRY(iso_record_create(r->ctx, ISO_COLUMN_EFFECTS, names, &run->trajectory));
    ISO_TRY(iso_method_check(r->ctx, r->scene->method));
    o.effects = &r->effects;
    o.backend = run->backend = backend;
    o.method = serves && backend != ISO_BACKEND_EXACT ? method : NULL; /* NULL: auto */
    o.tolerance = r->scene->tolerance;
    o.shown = ISO_SHOW_BOTH;
    for (int clock = 0; clock < ISO_CLOCKS; clock++) o.with_clock[clock] = true;
    const double begin = processor_seconds();
    ISO_TRY(iso_orbit_create(r->ctx, &r->scene->params, &r->scene->start, &o, &r->orbit[which]));
    run->seconds = processor_seconds() - begin;
    run->method = iso_orbit_method(r->orbit[which]);
    r->out->clock = o.clock;
    r->out->effects = iso_orbit_effects(r->orbit[which]);
    r->out->h = iso_orbit_energy(r->orbit[which]);
    r->out->eps = iso_orbit_coupling(r->orbit[which]);
    r->out->runs++;
    return ISO_OK;
}

static iso_status keep(comparer *r, int which, size_t i, const iso_sample *sample)
{
    double *row;
    iso_backend_run *run = &r->out->run[which];
    const iso_orbit *orbit = r->orbit[which];
    ISO_TRY(iso_record_append(r->ctx, run->trajectory, &row));
    for (int c = 0; c < ISO_COLUMN_EFFECTS; c++) row[c] = iso_sample_column(sample, c);
    for (int s = 0; i == 0 && iso_systems[s]; s++)
        run->drifts += iso_watch_begin(orbit, iso_systems[s], s == ISO_POINT ? orbit->level : (double)NAN, sample,
                                       run->drift + run->drifts, ISO_MAX_INTEGRALS - run->drifts);
    iso_watch_follow(orbit, sample, run->drift, run->drifts);
    return ISO_OK;
}

/* A row is kept only when every backend has found it: so all have the same rows when one of them fails. */
static iso_status add_rows(comparer *r, bool (*progress)(void *data, double part), void *data)
{
    const size_t rows = iso_scene_rows(r->scene);
    iso_sample sample[ISO_BACKENDS];
    for (size_t i = 0; i < rows; i++) {
        for (int which = 0; which < r->out->runs; which++) {
            iso_backend_run *run = &r->out->run[which];
            const double begin = processor_seconds();
            const iso_status status = iso_orbit_at(r->orbit[which], iso_scene_time(r->scene, i), &sample[which]);
            run->seconds += processor_seconds() - begin;
            run->statistics = iso_orbit_statistics(r->orbit[which]);
            ISO_TRY(status);
        }
        for (int which = 0; which < r->out->runs; which++) ISO_TRY(keep(r, which, i, &sample[which]));
        if (progress && !progress(data, (double)(i + 1) / (double)rows)) break;
    }
    return ISO_OK;
}

/* --- differences ------------------------------------------------------------------------------------------------ */

static double largest_in_column(const iso_record *r, int column)
{
    double most = 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) most = fmax(most, fabs(iso_record_const_row(r, i)[column]));
    return most;
}

/* The differences between runs a and b, row by row, and the largest of each column. */
static iso_status compare_rows(iso_context *ctx, const iso_comparison *c, int run_a, int run_b,
                               iso_record **difference, double worst[ISO_DIFFERENCES])
{
    const iso_record *a = c->run[run_a].trajectory, *b = c->run[run_b].trajectory;
    const iso_clock first = c->clock == ISO_CLOCK_T ? ISO_CLOCK_TAU : ISO_CLOCK_T;
    const iso_clock second = c->clock == ISO_CLOCK_S ? ISO_CLOCK_TAU : ISO_CLOCK_S;
    const char *const names[ISO_DIFFERENCES] = {
        iso_clock_name(c->clock), "omega", "n", "M", "gamma", iso_clock_name(first), iso_clock_name(second)};
    const double scale[2] = {largest_in_column(a, (int)first), largest_in_column(a, (int)second)};
    iso_status status = iso_record_create(ctx, ISO_DIFFERENCES, names, difference);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(a) && i < iso_record_rows(b); i++) {
        const double *x = iso_record_const_row(a, i), *y = iso_record_const_row(b, i);
        double *d;
        status = iso_record_append(ctx, *difference, &d);
        if (status != ISO_OK) break;
        d[0] = x[c->clock];
        for (int v = 0; v < 4; v++)
            d[1 + v] = relative_difference(x + ISO_COLUMN_BALL + 3 * v, y + ISO_COLUMN_BALL + 3 * v);
        d[5] = scale[0] > 0 ? fabs(x[first] - y[first]) / scale[0] : 0;
        d[6] = scale[1] > 0 ? fabs(x[second] - y[second]) / scale[1] : 0;
        worst[0] = d[0];
        for (int j = 1; j < ISO_DIFFERENCES; j++) worst[j] = iso_larger(worst[j], d[j]);
    }
    return status;
}

iso_status iso_compare(iso_context *ctx, const iso_scene *scene, bool (*progress)(void *data, double part),
                       void *data, iso_comparison **comparison)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_comparison *c = *comparison = calloc(1, sizeof *c);
    if (!c) return iso_context_no_memory(ctx, "a comparison");
    comparer r = {.ctx = ctx, .scene = scene, .effects = iso_scene_acting(scene), .out = c};
    iso_status status = iso_scene_check_times(ctx, scene);
    if (status == ISO_OK) status = open_backend(&r, ISO_BACKEND_BALL);
    if (status == ISO_OK) status = iso_orbit_check_time(r.orbit[ISO_BALL], scene->end);
    if (status == ISO_OK) status = open_backend(&r, ISO_BACKEND_POINT);
    if (status == ISO_OK) status = open_backend(&r, ISO_BACKEND_EXACT);
    if (c->runs == ISO_INTEGRATED && (status == ISO_BAD_ARGUMENT || status == ISO_NUMERICAL)) {
        snprintf(c->no_exact, sizeof c->no_exact, "%s", iso_context_message(ctx)); /* it is no failure */
        status = ISO_OK;
    }
    if (status == ISO_OK) status = add_rows(&r, progress, data);
    for (int b = 0; b < ISO_BACKENDS; b++) iso_orbit_free(r.orbit[b]);
    const iso_record *rows = c->runs > 0 ? c->run[c->runs - 1].trajectory : NULL;
    if (rows && iso_record_rows(rows) > 0 && (status == ISO_OK || status == ISO_NUMERICAL || status == ISO_STOPPED)) {
        iso_status rows_status = compare_rows(ctx, c, ISO_BALL, ISO_POINT, &c->difference, c->worst);
        for (int b = 0; rows_status == ISO_OK && c->runs == ISO_BACKENDS && b < ISO_INTEGRATED; b++)
            rows_status = compare_rows(ctx, c, ISO_BY_EXACT, b, &c->from_exact[b], c->worst_from_exact[b]);
        if (rows_status == ISO_OK) return status;
        status = rows_status;
    }
    iso_comparison_free(c);
    *comparison = NULL;
    return status;
}

void iso_comparison_free(iso_comparison *c)
{
    if (!c) return;
    for (int b = 0; b < ISO_BACKENDS; b++) iso_record_free(c->run[b].trajectory);
    iso_record_free(c->difference);
    for (int b = 0; b < ISO_INTEGRATED; b++) iso_record_free(c->from_exact[b]);
    free(c);
}

/* --- what it holds: the numbers of one backend ------------------------------------------------------------------------------------------------ */

static const iso_field system_fields[] = {ISO_MEMBER(iso_system, "system", name, "", "ball or point"), ISO_FIELD_END};
static const iso_field method_fields[] = {ISO_MEMBER(iso_method, "method", name, "", "of integration"),
                                          ISO_FIELD_END};
static const iso_field integral_fields[] = {
    ISO_MEMBER(iso_integral, "name", name, "", "of the integral"),
    ISO_MEMBER(iso_integral, "doc", doc, "", "what it is"),
    ISO_FIELD_END,
};

static const iso_field drift_fields[] = {
    ISO_STRUCT(iso_drift, "", system, system_fields, "of which model", .pointer = true),
    ISO_STRUCT(iso_drift, "", integral, integral_fields, "which integral", .pointer = true),
    ISO_MEMBER(iso_drift, "start", start, "", "its value at the start"),
    ISO_MEMBER(iso_drift, "drift", worst, "", "its largest relative drift"),
    ISO_FIELD_END,
};

#define FIELD(key, member, ...) ISO_MEMBER(iso_backend_run, key, member, __VA_ARGS__)

static const iso_field run_fields[] = {
    ISO_STRUCT(iso_backend_run, "", method, method_fields, "by which", .pointer = true),
    FIELD("steps", statistics.steps, "", "steps"),
    FIELD("rejected", statistics.rejected, "", "steps that were rejected"),
    FIELD("right_hand_sides", statistics.rhs, "", "evaluations of the equations"),
    FIELD("states", statistics.states, "", "states that were found without steps"),
    FIELD("correction", statistics.correction, "", "largest relative correction by projection"),
    FIELD("seconds", seconds, "s", "processor time"),
    ISO_LIST(iso_backend_run, "integrals", drift, drifts, drift_fields, "that hold"),
    FIELD("trajectory", trajectory, "", "its columns"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- the differences, row by row -------------------------------------------------------------------------------- */

/* Of t and s one is the scene's clock. */
const iso_field iso_difference_fields[] = {
    {.name = "t", .unit = "", .doc = "of a ball the time; of a point the difference of t by its largest value"},
    {.name = "omega", .unit = "", .doc = "the difference of omega, by its length"},
    {.name = "n", .unit = "", .doc = "the difference of n"},
    {.name = "M", .unit = "", .doc = "the difference of M, by its length"},
    {.name = "gamma", .unit = "", .doc = "the difference of gamma"},
    {.name = "tau", .unit = "", .doc = "the difference of tau, by its largest value"},
    {.name = "s", .unit = "", .doc = "of a point the time; of a ball the difference of s by its largest value"},
    ISO_FIELD_END,
};

/* --- all -------------------------------------------------------------------------------------------------------- */

static bool has_exact(const void *row)
{
    return ((const iso_comparison *)row)->runs == ISO_BACKENDS;
}

static bool has_no_exact(const void *row)
{
    return !has_exact(row);
}

static bool is_of_ball(const void *row)
{
    return ((const iso_comparison *)row)->clock == ISO_CLOCK_T;
}

static bool is_of_point(const void *row)
{
    return !is_of_ball(row);
}

static bool is_exact_of_ball(const void *row)
{
    return has_exact(row) && is_of_ball(row);
}

static bool is_exact_of_point(const void *row)
{
    return has_exact(row) && is_of_point(row);
}

static double largest_of(const void *row)
{
    const double *w = ((const iso_comparison *)row)->worst;
    return fmax(fmax(w[1], w[2]), fmax(w[3], w[4]));
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_comparison, key, member, __VA_ARGS__)
#define EXACT .there = has_exact, .how = ISO_OPTIONAL
#define WORST(key, member, doc, is) FIELD(key, member, "", doc, .there = is, .how = ISO_OPTIONAL)

/* Where `from` has the columns of a difference: omega, n, M, gamma and the two other clocks. */
#define ALL_WORST(where, from, any, of_ball, of_point)                                                               \
    WORST(where "worst_difference.omega", from[1], "the largest difference of omega, by its length", any),           \
        WORST(where "worst_difference.n", from[2], "of n", any),                                                     \
        WORST(where "worst_difference.M", from[3], "of M, by its length", any),                                      \
        WORST(where "worst_difference.gamma", from[4], "of gamma", any),                                             \
        WORST(where "worst_difference.t", from[5], "of t, by its largest value", of_point),                          \
        WORST(where "worst_difference.tau", from[5], "of tau, by its largest value", of_ball),                       \
        WORST(where "worst_difference.tau", from[6], "of tau, by its largest value", of_point),                      \
        WORST(where "worst_difference.s", from[6], "of s, by its largest value", of_ball)

const iso_field iso_comparison_fields[] = {
    FIELD("h", h, "energy", "of the ball"),
    FIELD("eps", eps, "", "coupling of the point"),
    FIELD("clock", clock, "", "in which the scene counts its times", .word = iso_clock_word),
    FIELD("difference", difference, "", "of ball and point, row by row"),
    ISO_STRUCT(iso_comparison, "backends.ball", run[ISO_BALL], run_fields, "the ball"),
    ISO_STRUCT(iso_comparison, "backends.point", run[ISO_POINT], run_fields, "the point"),
    ISO_STRUCT(iso_comparison, "backends.exact", run[ISO_BY_EXACT], run_fields, "the closed solution", EXACT),
    FIELD("no_exact", no_exact, "", "why there is no closed solution", .there = has_no_exact, .how = ISO_OPTIONAL),
    FIELD("from_exact.ball.difference", from_exact[ISO_BALL], "", "of ball and closed solution", EXACT),
    FIELD("from_exact.point.difference", from_exact[ISO_POINT], "", "of point and closed solution", EXACT),
    ALL_WORST("", worst, NULL, is_of_ball, is_of_point),
    ALL_WORST("from_exact.ball.", worst_from_exact[ISO_BALL], has_exact, is_exact_of_ball, is_exact_of_point),
    ALL_WORST("from_exact.point.", worst_from_exact[ISO_POINT], has_exact, is_exact_of_ball, is_exact_of_point),
    ISO_NUMBER("largest", largest_of, "", "the largest of omega, n, M and gamma", .how = ISO_IN_TABLE),
    ISO_FIELD_END,
};

/* --- the study -------------------------------------------------------------------------------------------------- */

ISO_STUDY_BEGIN(iso_compare_request, (iso_compare_request){.change = ISO_SCENE_AS_IT_IS, .rows = 6})

/* The records that are tables of the result. */
static void free_comparison(void *found)
{
    iso_comparison *c = found;
    c->difference = NULL;
    for (int b = 0; b < c->runs; b++) c->run[b].trajectory = NULL;
    for (int b = 0; b < ISO_INTEGRATED && c->runs == ISO_BACKENDS; b++) c->from_exact[b] = NULL;
    iso_comparison_free(c);
}

static bool show(void *data, double part)
{
    iso_study_progress(data, part);
    return true;
}

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    iso_scene scene = *subject->scene;
    iso_comparison *c = NULL;
    ISO_TRY(iso_scene_apply(ctx, &((const iso_compare_request *)options)->change, &scene));
    const iso_status status = iso_compare(ctx, &scene, show, result, &c);
    if (!c) return status;
    iso_record *const tables[ISO_STUDY_TABLES] = {c->difference,
                                                  c->run[ISO_BALL].trajectory,
                                                  c->run[ISO_POINT].trajectory,
                                                  c->run[ISO_BY_EXACT].trajectory,
                                                  c->from_exact[ISO_BALL],
                                                  c->from_exact[ISO_POINT]};
    iso_study_keep(result, c, iso_comparison_fields, free_comparison);
    for (int i = 0; i <= (c->runs == ISO_BACKENDS ? 5 : 2); i++) {
        result->table[i] = tables[i];
        if (tables[i]) iso_record_set_kind(tables[i], i > 0 && i < 4 ? "trajectory" : "compare");
    }
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (scene.effects.on[e] && iso_effect_list[e]->ball_only)
            iso_study_note(result, "'%s' acts on nothing and is not compared", iso_effect_list[e]->name);
    ISO_TRY(iso_record_describe_scene(ctx, c->difference, &scene));
    ISO_TRY(iso_record_set_fields(ctx, c->difference, iso_comparison_fields, c));
    ISO_TRY(iso_record_set_numbers(ctx, c->difference, "tolerance", 1, &scene.tolerance));
    return status;
}

const iso_option iso_compare_option[] = {
    ISO_OPTION_METHOD(iso_compare_request, change),
    ISO_OPTION_TOLERANCE(ISO_TOLERANCE_OF_STEPS, iso_compare_request, change.tolerance),
    ISO_OPTION_T_END(iso_compare_request, change),
    ISO_OPTION_STEP(iso_compare_request, change),
    {.name = "rows",
     .argument = "N",
     .expected = "a whole number from 1 on",
     .doc = "rows of the table to print (default 6)",
     .set = iso_set_count,
     .offset = offsetof(iso_compare_request, rows),
     .aside = true},
    ISO_OPTION_END,
};

const iso_study iso_compare_study = {ISO_STUDY_AS("compare", iso_compare_request, iso_compare_option,
                                                  "compute an orbit by every backend and show the differences"),
                                     .run = run, .of = ISO_STUDY_OF_SCENE, .fields = iso_comparison_fields,
                                     .print = iso_compare_print};
