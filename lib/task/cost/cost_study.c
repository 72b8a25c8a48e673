/* cost_study.c - cost by its name: what is measured, in which order it is shown (study/study.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "task/cost/cost_impl.h"

/* --- numbers and their meaning ---------------------------------------------------------------------------------- */

static const iso_field method_fields[] = {
    ISO_MEMBER(iso_method, "method", name, "", "of integration; none: the closed solution"), ISO_FIELD_END};

#define FIELD(key, member, ...) ISO_MEMBER(iso_cost_cell, key, member, __VA_ARGS__)
#define MEASURED(key, member, ...)                                                                                   \
    FIELD(key, member, __VA_ARGS__, .there = iso_cost_is_measured, .how = ISO_EMPTY | ISO_OPTIONAL)

const iso_field iso_cost_cell_fields[] = {
    FIELD("backend", backend, "", "ball, point or exact", .word = iso_backend_name),
    ISO_STRUCT(iso_cost_cell, "", method, method_fields, "of integration", .pointer = true),
    FIELD("tolerance", tolerance, "", "relative error of a step", .how = ISO_EMPTY),
    ISO_IS("measured", iso_cost_is_measured, "whether there is a result", .how = ISO_IN_TREE),
    MEASURED("error", error, "", "the largest relative error of (omega, n)"),
    MEASURED("clock_error", clock_error, "", "the same of the other model's clock"),
    MEASURED("energy_drift", energy_drift, "", "relative drift of the energy"),
    MEASURED("constraint_drift", constraint_drift, "", "drift of the constraints"),
    MEASURED("setup", setup, "s", "processor time before the first step"),
    MEASURED("fastest", fastest, "s", "of the repeats: the least time for all steps"),
    MEASURED("median", median, "s", "the median"),
    MEASURED("slowest", slowest, "s", "the longest"),
    MEASURED("total", total, "s", "setup and median"),
    FIELD("repeats", repeats, "", "how often it was run"),
    FIELD("steps", statistics.steps, "", "steps"),
    FIELD("rejected", statistics.rejected, "", "steps that were rejected"),
    FIELD("right_hand_sides", statistics.rhs, "", "evaluations of the equations", .column = "rhs"),
    FIELD("jacobians", statistics.jacobians, "", "evaluations of their Jacobian"),
    FIELD("states", statistics.states, "", "states that were found without steps"),
    FIELD("below", below, "", "1: the reference is not exact enough to tell the error"),
    FIELD("pareto", pareto, "", "1: nothing else is as exact and faster"),
    FIELD("failure", why, "", "why there is no result", .how = ISO_QUOTED),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_cost_series, key, member, __VA_ARGS__)

static const iso_field series_fields[] = {
    FIELD("backend", backend, "", "ball, point or exact", .word = iso_backend_name),
    ISO_STRUCT(iso_cost_series, "", method, method_fields, "of integration", .pointer = true),
    FIELD("time_of_a_digit", digit, "", "factor in time for one more digit"),
    FIELD("order", order, "", "error ~ steps^-order"),
    FIELD("least_error", least, "", "the least error"),
    FIELD("stops_at", stops_at, "", "tolerance at which it stops gaining"),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_cost, key, member, __VA_ARGS__)

const iso_field iso_cost_fields[] = {
    FIELD("end", end, "time", "the last time"),
    FIELD("turns", turns, "", "turns until then, about"),
    FIELD("reference", reference, "", "against which errors are measured"),
    FIELD("second_reference", second, "", "against which the reference is"),
    FIELD("uncertainty", uncertainty, "", "of the reference"),
    FIELD("seconds", seconds, "s", "that all took"),
    FIELD("complete", complete, "", "whether all was measured"),
    ISO_LIST_AT(iso_cost, "cells", cell, cells, iso_cost_cell_fields, "the measurements"),
    ISO_LIST_AT(iso_cost, "lines", series, series_count, series_fields, "of a backend and a method"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- cells and series -------------------------------------------------------------------------------------------- */

bool iso_cost_has_failed(const void *row)
{
    const iso_cost_cell *cell = row;
    return cell->status != ISO_OK && cell->status != ISO_STOPPED;
}

int iso_cost_count(const iso_cost *cost, bool (*is)(const void *cell))
{
    int count = 0;
    for (int i = 0; i < cost->cells; i++) count += is(&cost->cell[i]);
    return count;
}

static bool is_faster(const iso_cost *cost, const iso_cost_series *a, const iso_cost_series *b)
{
    static const double wants[] = {1e-9, 1e-6, 1e-3};
    if (!a->method || !b->method) return !a->method && b->method;
    for (int i = 0; i < 3; i++) {
        const iso_cost_cell *x = iso_cost_choose(cost, true, a, wants[i]),
                            *y = iso_cost_choose(cost, true, b, wants[i]);
        if (x && y && x->total != y->total) return x->total < y->total;
        if (!x != !y) return x != NULL;
    }
    return false;
}

static const iso_cost_series **sort_series(const iso_cost *cost)
{
    const iso_cost_series **series = calloc((size_t)cost->series_count + 1, sizeof *series);
    for (int i = 0; series && i < cost->series_count; i++) {
        int at = i;
        for (; at > 0 && is_faster(cost, &cost->series[i], series[at - 1]); at--) series[at] = series[at - 1];
        series[at] = &cost->series[i];
    }
    return series;
}

/* --- what is found ---------------------------------------------------------------------------------------------- */

static const iso_field found_fields[] = {
    ISO_STRUCT(iso_cost_found, "", cost, iso_cost_fields, "what was measured", .pointer = true),
    ISO_MEMBER(iso_cost_found, "want", want, "", "the error that is wanted"),
    ISO_STRUCT(iso_cost_found, "choice", choice, iso_cost_cell_fields, "the cheapest", .pointer = true),
    ISO_FIELD_END,
};

static void free_found(void *found)
{
    iso_cost_found *f = found;
    iso_cost_free(f->cost);
    free(f->series);
    free(f);
}

/* The lines of the table have all but the cells, which are its rows. */
static iso_status put(iso_context *ctx, const iso_scene *scene, const iso_cost_found *f, iso_record **table)
{
    iso_field cost[ISO_MOST_FIELDS], fields[sizeof found_fields / sizeof *found_fields];
    const iso_cost *c = f->cost;
    iso_fields_copy(iso_cost_fields, "cells", cost);
    memcpy(fields, found_fields, sizeof fields);
    fields[0].fields = cost;
    iso_status status = iso_study_table(ctx, "cost", scene, fields, f, iso_cost_cell_fields, table);
    for (int l = 0; l < c->series_count; l++)
        for (int i = f->series[l]->first; status == ISO_OK && i < f->series[l]->first + f->series[l]->count; i++)
            status = iso_columns_append(ctx, iso_cost_cell_fields, &c->cell[i], *table);
    return status;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

ISO_STUDY_BEGIN(iso_cost_request, (iso_cost_request){.change = ISO_SCENE_AS_IT_IS, .want = NAN})

static void show(void *data, double share, const char *what)
{
    (void)what;
    iso_study_progress(data, share);
}

static iso_cost_options options_of(const iso_cost_request *r, iso_study_result *result)
{
    iso_cost_options c = iso_cost_defaults();
    c.quick = r->quick || !isnan(r->want);
    if ((int)r->change.backend >= 0) c.backend = r->change.backend;
    if (r->change.method) c.method = iso_method_find(r->change.method);
    if (!isnan(r->change.tolerance)) c.tolerance = r->change.tolerance;
    c.progress = show;
    c.data = result;
    return c;
}

/* Where nothing is measured there is no table. */
static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    const iso_cost_request *r = options;
    const iso_cost_options how = options_of(r, result);
    iso_scene scene = *subject->scene;
    iso_cost_found *f = iso_study_keep(result, calloc(1, sizeof *f), found_fields, free_found);
    if (!f) return iso_context_no_memory(ctx, "a cost");
    *f = (iso_cost_found){.want = r->want};
    ISO_TRY(iso_scene_apply(ctx, &r->change, &scene));
    iso_status status = iso_cost_measure(ctx, &scene, &how, &f->cost);
    if (!f->cost || (status != ISO_OK && iso_cost_count(f->cost, iso_cost_is_measured) == 0)) return status;
    f->series = sort_series(f->cost);
    if (!f->series) return iso_context_no_memory(ctx, "a cost");
    if (!isnan(r->want)) f->choice = iso_cost_choose(f->cost, false, NULL, r->want);
    const bool lost = !f->cost->complete || iso_cost_count(f->cost, iso_cost_has_failed) > 0;
    result->failed = isnan(r->want) ? lost : !f->choice;
    const iso_status made = put(ctx, &scene, f, &result->table[0]);
    return status == ISO_OK ? made : status;
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_cost_request, member)

const iso_option iso_cost_option[] = {
    ISO_OPTION_BACKEND(iso_cost_request, change),
    ISO_OPTION_METHOD(iso_cost_request, change),
    ISO_OPTION_TOLERANCE(ISO_TOLERANCE_OF_STEPS, iso_cost_request, change.tolerance),
    ISO_OPTION_T_END(iso_cost_request, change),
    ROW("quick", NULL, NULL, "measure three tolerances only: a few seconds", iso_set_flag, quick),
    ROW("want", "X", "a positive number", "print only the cheapest choice with an error of at most X",
        iso_set_positive, want),
    ISO_OPTION_END,
};

const iso_study iso_cost_study = {ISO_STUDY_AS("cost", iso_cost_request, iso_cost_option,
                                               "measure error against time for every backend, method and tolerance"),
                                  .run = run, .of = ISO_STUDY_OF_SCENE, .print = iso_cost_print,
                                  .describe = iso_cost_describe};
