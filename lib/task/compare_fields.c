/* compare_fields.c - what a comparison holds: its numbers with their meaning (compare.h). */
#include <math.h>
#include <stdlib.h>

#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "study/options_impl.h"
#include "task/task_impl.h"

/* --- one backend ------------------------------------------------------------------------------------------------ */

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

static iso_status describe(iso_context *ctx, const iso_scene *scene, const iso_comparison *c)
{
    iso_record *r = c->difference;
    iso_status status = iso_record_describe_scene(ctx, r, scene);
    if (status == ISO_OK) status = iso_record_set_fields(ctx, r, iso_comparison_fields, c);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, r, "tolerance", 1, &scene->tolerance);
    return status;
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
    const iso_status made = describe(ctx, &scene, c);
    return status == ISO_OK ? made : status;
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
