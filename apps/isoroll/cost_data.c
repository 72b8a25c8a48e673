/* cost_data.c - writes what `isoroll cost` measured for other programs: CSV and JSON. */
#include <math.h>

#include "cost_report.h"
#include "json.h"
#include "table.h"

iso_status cost_write_csv(iso_context *ctx, const cost_report *r, iso_output *to)
{
    const iso_cost *c = r->cost;
    const table_line lines[] = {{.key = "end", .number = c->end},
                                {.key = "reference", .text = c->reference},
                                {.key = "second reference", .text = c->second},
                                {.key = "uncertainty", .number = c->uncertainty},
                                {.key = NULL}};
    const iso_status status = table_begin(ctx, to, "cost", r->scene, lines, iso_cost_cell_fields);
    for (int i = 0; status == ISO_OK && i < c->cells; i++)
        iso_row_write(iso_output_stream(to), iso_cost_cell_fields, &c->cell[i]);
    return table_end(ctx, to, status);
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
