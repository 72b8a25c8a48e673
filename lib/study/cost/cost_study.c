/* cost_study.c - cost by its name: what is measured, in which order it is shown, what grows with the length of the
 * orbit (study/study.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"
#include "study/cost/cost_impl.h"
#include "study/fields_impl.h"

/* --- cells and lines -------------------------------------------------------------------------------------------- */

bool iso_cost_has_failed(const iso_cost_cell *cell)
{
    return cell->status != ISO_OK && cell->status != ISO_STOPPED;
}

int iso_cost_count(const iso_cost *cost, bool (*is)(const iso_cost_cell *cell))
{
    int count = 0;
    for (int i = 0; i < cost->cells; i++) count += is(&cost->cell[i]);
    return count;
}

const iso_cost_cell *iso_cost_choose_steps(const iso_cost *cost, const iso_cost_series *line, double want)
{
    const iso_cost_cell *best = NULL;
    const int first = line ? line->first : 0, end = line ? first + line->count : cost->cells;
    for (int i = first; i < end; i++) {
        const iso_cost_cell *c = &cost->cell[i];
        if (c->method && iso_cost_reaches(cost, c, want) && (!best || c->total < best->total)) best = c;
    }
    return best;
}

static bool is_faster(const iso_cost *cost, const iso_cost_series *a, const iso_cost_series *b)
{
    static const double wants[] = {1e-9, 1e-6, 1e-3};
    if (!a->method || !b->method) return !a->method && b->method;
    for (int i = 0; i < 3; i++) {
        const iso_cost_cell *x = iso_cost_choose_steps(cost, a, wants[i]),
                            *y = iso_cost_choose_steps(cost, b, wants[i]);
        if (x && y && x->total != y->total) return x->total < y->total;
        if (!x != !y) return x != NULL;
    }
    return false;
}

static const iso_cost_series **sort_lines(const iso_cost *cost)
{
    const iso_cost_series **line = calloc((size_t)cost->lines + 1, sizeof *line);
    for (int i = 0; line && i < cost->lines; i++) {
        int at = i;
        for (; at > 0 && is_faster(cost, &cost->line[i], line[at - 1]); at--) line[at] = line[at - 1];
        line[at] = &cost->line[i];
    }
    return line;
}

/* --- growth ----------------------------------------------------------------------------------------------------- */

/* The cell of a line with the smallest error; NULL: none is measured. */
static const iso_cost_cell *most_exact(const iso_cost *cost, const iso_cost_series *line)
{
    const iso_cost_cell *best = NULL;
    for (int i = line->first; i < line->first + line->count; i++) {
        const iso_cost_cell *c = &cost->cell[i];
        if (iso_cost_is_measured(c) && (!best || c->error < best->error)) best = c;
    }
    return best;
}

/* For each backend the fastest method, at the tolerance where its error is smallest. */
static int best_cells(const iso_cost_found *f, const iso_cost_cell *best[ISO_COST_GROWTHS])
{
    int count = 0;
    for (int l = 0; l < f->cost->lines && count < ISO_COST_GROWTHS; l++) {
        const iso_cost_cell *cell = most_exact(f->cost, f->line[l]);
        bool known = !cell;
        for (int i = 0; i < count; i++) known = known || best[i]->backend == f->line[l]->backend;
        if (!known) best[count++] = cell;
    }
    return count;
}

/* What fails is told in its place. */
static iso_status grow(iso_context *ctx, const iso_scene *scene, int horizons, iso_cost_found *f)
{
    const iso_cost_cell *best[ISO_COST_GROWTHS];
    const int count = best_cells(f, best);
    for (int i = 0; i < count && iso_context_goes_on(ctx); i++) {
        iso_cost_growing *g = &f->growth[f->growths++];
        *g = (iso_cost_growing){.cell = best[i]};
        if (iso_cost_grow(ctx, scene, best[i], horizons, &g->growth) != ISO_OK)
            snprintf(g->why, sizeof g->why, "%s", iso_context_message(ctx));
    }
    return iso_context_goes_on(ctx) ? ISO_OK : iso_context_stopped(ctx);
}

/* --- what is found ---------------------------------------------------------------------------------------------- */

static void find_why(const void *row, int i, iso_value *v)
{
    const iso_cost_growing *g = row;
    (void)i;
    v->text = *g->why ? g->why : g->growth.why;
}

static const iso_field growth_fields[] = {
    ISO_STRUCT(iso_cost_growing, "cell", cell, iso_cost_cell_fields, "what grows", .pointer = true),
    ISO_STRUCT(iso_cost_growing, "", growth, iso_cost_growth_fields, "how"),
    ISO_FOUND("failure", ISO_FIELD_NAME, find_why, "", "why it ends early"),
    ISO_FIELD_END,
};

static const iso_field found_fields[] = {
    ISO_STRUCT(iso_cost_found, "", cost, iso_cost_fields, "what was measured", .pointer = true),
    ISO_MEMBER(iso_cost_found, "want", want, "", "the error that is wanted"),
    ISO_STRUCT(iso_cost_found, "choice", choice, iso_cost_cell_fields, "the cheapest", .pointer = true),
    ISO_LIST(iso_cost_found, "growth", growth, growths, growth_fields, "with the length"),
    ISO_FIELD_END,
};

static void free_found(void *found)
{
    iso_cost_found *f = found;
    iso_cost_free(f->cost);
    free(f->line);
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
    for (int l = 0; l < c->lines; l++)
        for (int i = f->line[l]->first; status == ISO_OK && i < f->line[l]->first + f->line[l]->count; i++)
            status = iso_columns_append(ctx, iso_cost_cell_fields, &c->cell[i], *table);
    return status;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

ISO_STUDY_BEGIN(iso_cost_request, (iso_cost_request){.change = ISO_SCENE_AS_IT_IS, .want = NAN})

static void show(double share, const char *what, void *data)
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
    f->line = sort_lines(f->cost);
    if (!f->line) return iso_context_no_memory(ctx, "a cost");
    if (!isnan(r->want)) f->choice = iso_cost_choose(f->cost, r->want);
    if (status == ISO_OK && r->horizons > 0) status = grow(ctx, &scene, (int)r->horizons, f);
    const bool lost = !f->cost->complete || iso_cost_count(f->cost, iso_cost_has_failed) > 0;
    result->failed = isnan(r->want) ? lost : !f->choice;
    const iso_status made = put(ctx, &scene, f, &result->table[0]);
    return status == ISO_OK ? made : status;
}

/* The number of orbits may be left out. */
static bool set_horizons(void *at, const char *text)
{
    const bool set = iso_set_count(at, text ? text : "6");
    return set && *(double *)at <= ISO_COST_HORIZONS;
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
    ROW("horizons", "[=N]", "a whole number from 1 to 24",
        "growth over N orbits (default 6), each twice as long as the one before", set_horizons, horizons),
    ISO_OPTION_END,
};

const iso_study iso_cost_study = {"cost",
                                  "measure error against time for every backend, method and tolerance",
                                  iso_cost_option,
                                  sizeof(iso_cost_request),
                                  begin,
                                  .run = run,
                                  .of = ISO_STUDY_OF_SCENE};
