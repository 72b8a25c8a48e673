/* cost_data.c - writes what `isoroll cost` measured for other programs: CSV and JSON. */
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "cost_report.h"
#include "json.h"
#include "table.h"

/* --- CSV -------------------------------------------------------------------------------------------------------- */

/* A field with a number. It is empty where there is none. */
static void put(FILE *to, double x)
{
    char text[ISO_NUMBER_SIZE] = "";
    if (isfinite(x)) iso_number_print(text, x);
    fprintf(to, ",%s", text);
}

static void put_quoted(FILE *to, const char *text)
{
    fputs(",\"", to);
    for (; *text; text++) fprintf(to, *text == '"' ? "\"%c" : "%c", *text);
    fputs("\"\n", to);
}

static void put_cell(FILE *to, const iso_cost_cell *c)
{
    const bool measured = iso_cost_is_measured(c);
    const double result[] = {c->error,  c->clock_error, c->energy_drift, c->constraint_drift, c->setup, c->fastest,
                             c->median, c->slowest,     c->total};
    const long counts[] = {c->repeats,        c->statistics.steps,     c->statistics.rejected,
                           c->statistics.rhs, c->statistics.jacobians, c->statistics.states};
    fprintf(to, "%s,%s", iso_backend_name((int)c->backend), c->method ? c->method->name : "");
    put(to, c->tolerance);
    for (size_t i = 0; i < sizeof result / sizeof *result; i++) put(to, measured ? result[i] : (double)NAN);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) fprintf(to, ",%ld", counts[i]);
    fprintf(to, ",%d,%d", c->below, c->pareto);
    put_quoted(to, c->why);
}

iso_status cost_write_csv(iso_context *ctx, const cost_report *r, iso_output *to)
{
    const iso_cost *c = r->cost;
    const table_line lines[] = {{.key = "end", .number = c->end},
                                {.key = "reference", .text = c->reference},
                                {.key = "second reference", .text = c->second},
                                {.key = "uncertainty", .number = c->uncertainty},
                                {.key = NULL}};
    const iso_status status = table_begin(
        ctx, to, "cost", r->scene, lines,
        "backend,method,tolerance,error,clock_error,energy_drift,constraint_drift,setup,fastest,median,slowest,"
        "total,repeats,steps,rejected,rhs,jacobians,states,below,pareto,failure");
    for (int i = 0; status == ISO_OK && i < c->cells; i++) put_cell(iso_output_stream(to), &c->cell[i]);
    return table_end(ctx, to, status);
}

/* --- JSON ------------------------------------------------------------------------------------------------------- */

static json_t *method_of(const iso_method *method)
{
    return method ? json_string(method->name) : json_null();
}

static json_t *cell_of(const iso_cost_cell *c)
{
    const iso_statistics *s = &c->statistics;
    const bool measured = iso_cost_is_measured(c);
    json_t *o = json_pack("{s:s, s:o, s:o, s:b, s:o}", "backend", iso_backend_name((int)c->backend), "method",
                          method_of(c->method), "tolerance", json_number(c->tolerance), "measured", (int)measured,
                          "failure", measured ? json_null() : json_string(c->why));
    if (!o || !measured) return o;
    json_t *more = json_pack(
        "{s:o, s:b, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:i, s:I, s:I, s:I, s:I, s:I}", "error",
        json_number(c->error), "below", (int)c->below, "pareto", (int)c->pareto, "clock_error",
        json_number(c->clock_error), "energy_drift", json_number(c->energy_drift), "constraint_drift",
        json_number(c->constraint_drift), "setup", json_number(c->setup), "fastest", json_number(c->fastest),
        "median", json_number(c->median), "slowest", json_number(c->slowest), "total", json_number(c->total),
        "repeats", c->repeats, "steps", (json_int_t)s->steps, "rejected", (json_int_t)s->rejected, "right_hand_sides",
        (json_int_t)s->rhs, "jacobians", (json_int_t)s->jacobians, "states", (json_int_t)s->states);
    json_object_update(o, more);
    json_decref(more);
    return o;
}

static json_t *cells_of(const iso_cost *c)
{
    json_t *list = json_array();
    for (int i = 0; i < c->cells; i++) json_array_append_new(list, cell_of(&c->cell[i]));
    return list;
}

static json_t *lines_of(const iso_cost *c)
{
    json_t *list = json_array();
    for (int i = 0; i < c->lines; i++) {
        const iso_cost_series *l = &c->line[i];
        json_array_append_new(list,
                              json_pack("{s:s, s:o, s:o, s:o, s:o, s:o}", "backend",
                                        iso_backend_name((int)l->backend), "method", method_of(l->method),
                                        "time_of_a_digit", json_number(l->digit), "order", json_number(l->order),
                                        "least_error", json_number(l->least), "stops_at", json_number(l->stops_at)));
    }
    return list;
}

static json_t *why_of(const cost_growth *g)
{
    return *g->why ? json_string(g->why) : *g->growth.why ? json_string(g->growth.why) : json_null();
}

static json_t *growths_of(const cost_report *r)
{
    json_t *list = json_array();
    for (int g = 0; g < r->growths; g++) {
        const iso_cost_growth *x = &r->growth[g].growth;
        json_t *rows = json_array();
        for (int i = 0; i < x->count; i++)
            json_array_append_new(rows,
                                  json_pack("{s:o, s:o, s:o, s:o}", "end", json_number(x->end[i]), "error",
                                            json_number(x->error[i]), "uncertainty", json_number(x->uncertainty[i]),
                                            "seconds", json_number(x->seconds[i])));
        json_array_append_new(list,
                              json_pack("{s:o, s:o, s:b, s:o, s:o, s:o, s:o}", "cell", cell_of(r->growth[g].cell),
                                        "horizons", rows, "chaotic", (int)x->chaotic, "power", json_number(x->power),
                                        "time_power", json_number(x->time_power), "lyapunov_time",
                                        json_number(x->lyapunov_time), "failure", why_of(&r->growth[g])));
    }
    return list;
}

static json_t *choice_of(const cost_report *r)
{
    const iso_cost_cell *c = isnan(r->want) ? NULL : iso_cost_choose(r->cost, r->want);
    return c ? cell_of(c) : json_null();
}

bool cost_print_json(const cost_report *r)
{
    const iso_params *p = &r->scene->params;
    const iso_cost *c = r->cost;
    json_t *o =
        json_pack("{s:s, s:o, s:[o,o,o], s:o, s:o, s:s, s:s, s:o, s:o, s:b, s:o, s:o, s:o, s:o, s:o}", "isoroll",
                  iso_version(), "k", json_number(p->k), "J", json_number(p->J[0]), json_number(p->J[1]),
                  json_number(p->J[2]), "end", json_number(c->end), "turns", json_number(c->turns), "reference",
                  c->reference, "second_reference", c->second, "uncertainty", json_number(c->uncertainty), "seconds",
                  json_number(c->seconds), "complete", (int)c->complete, "cells", cells_of(c), "lines", lines_of(c),
                  "want", json_number(r->want), "choice", choice_of(r), "growth", growths_of(r));
    return json_print(o);
}
