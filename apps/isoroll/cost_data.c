/* cost_data.c - writes what `isoroll cost` measured for other programs: CSV and JSON. */
#include <math.h>

#include "cost_report.h"
#include "json.h"
#include "plot/plot.h"
#include "table.h"

iso_status cost_table(iso_context *ctx, const cost_report *r, const iso_cost_series *const line[], iso_record **table)
{
    const iso_cost *c = r->cost;
    char title[ISO_PLOT_TITLE];
    iso_plot_title(title, &r->scene->params, ", %s = %.6g, about %.3g turns",
                   r->scene->start.model == ISO_BALL ? "t" : "s", c->end, c->turns);
    const table_line lines[] = {{.key = "end", .number = c->end},
                                {.key = "reference", .text = c->reference},
                                {.key = "second reference", .text = c->second},
                                {.key = "uncertainty", .number = c->uncertainty},
                                {.key = "title", .text = title},
                                {.key = NULL}};
    iso_status status = table_create(ctx, "cost", r->scene, lines, iso_cost_cell_fields, table);
    for (int l = 0; l < c->lines; l++)
        for (int i = line[l]->first; status == ISO_OK && i < line[l]->first + line[l]->count; i++)
            status = iso_columns_append(ctx, iso_cost_cell_fields, &c->cell[i], *table);
    return status;
}

static void find_why(const void *row, int i, iso_value *v)
{
    const cost_growth *g = row;
    (void)i;
    v->text = *g->why ? g->why : g->growth.why;
}

static const iso_field growth_fields[] = {
    ISO_STRUCT(cost_growth, "cell", cell, iso_cost_cell_fields, "what grows", .pointer = true),
    ISO_STRUCT(cost_growth, "", growth, iso_cost_growth_fields, "how"),
    ISO_FOUND("failure", ISO_FIELD_NAME, find_why, "", "why it ends early"), ISO_FIELD_END};

bool cost_print_json(const cost_report *r)
{
    static const iso_field fields[] = {
        ISO_STRUCT(cost_report, "", cost, iso_cost_fields, "what was measured", .pointer = true),
        ISO_MEMBER(cost_report, "want", want, "", "the error that is wanted"),
        ISO_STRUCT(cost_report, "choice", choice, iso_cost_cell_fields, "the cheapest", .pointer = true),
        ISO_LIST(cost_report, "growth", growth, growths, growth_fields, "with the length"), ISO_FIELD_END};
    return json_print(json_of_scene(r->scene, fields, r));
}
