/* periodic_chart.c - the chart of stable rotations, as rows, as JSON and as a picture (see periodic.h). */
#include "periodic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number_impl.h"
#include "json.h"
#include "plot/plot.h"
#include "progress.h"
#include "report.h"
#include "scene_options.h"
#include "study/level.h"
#include "study/periodic/stability_chart.h"
#include "table.h"

bool read_range(const char *text, double range[2])
{
    const char *colon = strchr(text, ':');
    return colon && iso_number_read(text, (size_t)(colon - text), &range[0]) &&
           iso_number_read(colon + 1, strlen(colon + 1), &range[1]);
}

static iso_status read_level(iso_context *ctx, const iso_scene *scene, const periodic_options *c,
                             iso_stability_options *o)
{
    if (!c->level) return iso_level_of_scene(ctx, scene, "the chart is drawn", &o->level);
    if (o->moment == ISO_CHART_LEVEL)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "--level does not go with --chart level=A:B");
    if (iso_number_read(c->level, strlen(c->level), &o->level)) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "--level '%s': expected a number", c->level);
}

static iso_status read_words(iso_context *ctx, const iso_scene *scene, const periodic_options *c,
                             iso_stability_options *o)
{
    double k[2] = {-3, 3}, moment[2];
    *o = iso_stability_defaults();
    const char *name = c->chart, *equals = strchr(name, '=');
    const size_t length = strcspn(name, "=");
    o->moment = -1;
    for (int i = 0; i <= ISO_CHART_LEVEL; i++)
        if (strlen(iso_chart_name(i)) == length && strncmp(name, iso_chart_name(i), length) == 0) o->moment = i;
    if (o->moment < 0 || (o->moment == ISO_CHART_LEVEL && !equals))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "--chart '%s': expected J1, J2 or J3, or J2=A:B, or level=A:B", name);
    memcpy(o->J, scene->params.J, sizeof o->J);
    const iso_status status = read_level(ctx, scene, c, o);
    if (status != ISO_OK) return status;
    const double one = o->J[(o->moment + 1) % 3], other = o->J[(o->moment + 2) % 3];
    moment[0] = fmin(one, other);
    moment[1] = one + other;
    if (equals && !read_range(equals + 1, moment))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "--chart '%s': expected %s=A:B, A < B", name,
                                iso_chart_name(o->moment));
    if (c->k && !read_range(c->k, k))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "--k '%s': expected A:B, A < B", c->k);
    o->from[0] = k[0], o->to[0] = k[1];
    o->from[1] = moment[0], o->to[1] = moment[1];
    o->steps = c->steps;
    o->threads = c->study.threads;
    o->progress = progress_told;
    return ISO_OK;
}

static iso_status make_table(iso_context *ctx, const iso_scene *scene, const iso_stability_options *o,
                             const iso_record *grid, const iso_record *borders, iso_record **table)
{
    char title[ISO_PLOT_TITLE];
    const double *J = o->J;
    const bool by_level = o->moment == ISO_CHART_LEVEL;
    const int a = (o->moment + 1) % 3, b = (o->moment + 2) % 3;
    const table_line lines[] = {
        {.key = "title", .text = title}, {.key = by_level ? NULL : "level", .number = o->level}, {.key = NULL}};
    iso_field fields[ISO_MOST_FIELDS];
    if (by_level)
        snprintf(title, sizeof title, "J = %.6g %.6g %.6g", J[0], J[1], J[2]);
    else if (o->level == 0)
        snprintf(title, sizeof title, "J%d = %.6g, J%d = %.6g", a + 1, J[a], b + 1, J[b]);
    else
        snprintf(title, sizeof title, "J%d = %.6g, J%d = %.6g, level %.6g", a + 1, J[a], b + 1, J[b], o->level);
    table_rename(iso_chart_row_fields, "J2", iso_chart_name(o->moment), fields);
    iso_status status = table_create(ctx, "periodic chart", scene, lines, fields, table);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(grid); i++) {
        const double *at = iso_record_const_row(grid, i);
        status = iso_columns_append(ctx, fields, &(iso_chart_row){"grid", at[0], at[1], at[2], at[3]}, *table);
    }
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(borders); i++) {
        const double *at = iso_record_const_row(borders, i), trace[] = {at[1], NAN};
        const int greatest = at[0] > 0;
        status = iso_columns_append(
            ctx, fields, &(iso_chart_row){"border", at[2], at[3], trace[greatest], trace[!greatest]}, *table);
    }
    return status;
}

static bool print_json(const iso_stability_options *o, const iso_record *grid, const iso_record *borders)
{
    static const iso_field fields[] = {
        ISO_MEMBER(iso_stability_options, "moment", moment, "", "what varies", .word = iso_chart_name),
        ISO_MEMBER(iso_stability_options, "level", level, "", "on which it is drawn"), ISO_FIELD_END};
    iso_stability_options said = *o;
    if (o->moment == ISO_CHART_LEVEL) said.level = NAN;
    json_t *all = json_of(fields, &said);
    json_put(all, "grid", json_columns(grid));
    json_put(all, "borders", json_columns(borders));
    return json_print(all);
}

#define EDGE 1e-9 /* with equal moments a trace is 2 or -2 up to rounding */

static void print_table(const iso_stability_options *o, const iso_record *grid, const iso_record *borders)
{
    size_t count[2][3] = {{0}}, none[2] = {0};
    static const char *const axes[] = {"least", "greatest"};
    for (size_t i = 0; i < iso_record_rows(grid); i++)
        for (int which = 0; which < 2; which++) {
            const double T = iso_record_const_row(grid, i)[2 + which];
            if (!isnan(T))
                count[which][T < -2 - EDGE ? 0 : T > 2 + EDGE ? 2 : 1]++;
            else
                none[which] += fabs(iso_record_const_row(grid, i)[0]) >= ISO_LEAST_K;
        }
    printf("k from %g to %g, %s from %g to %g; share of the grid points\n%20s  T < -2    stable    T > 2\n",
           o->from[0], o->to[0], iso_chart_name(o->moment), o->from[1], o->to[1], "");
    for (int which = 0; which < 2; which++) {
        const double all = (double)(count[which][0] + count[which][1] + count[which][2]);
        printf("  %-8s moment    %6.4f    %6.4f    %6.4f\n", axes[which], (double)count[which][0] / all,
               (double)count[which][1] / all, (double)count[which][2] / all);
    }
    if (o->level != 0) printf("level of the point, (H/eps) J2^(1/k): %.15g\n", o->level);
    for (int which = 0; which < 2; which++)
        if (none[which] > 0)
            printf("left out: %zu grid points, where there is no rotation about the axis of the %s moment, but an "
                   "oscillation between two places of rest\n",
                   none[which], axes[which]);
    printf("%zu points of the borders T = 2 and T = -2: see -o, --json and --plot\n", iso_record_rows(borders));
}

int draw_chart(iso_context *ctx, const periodic_options *c, const iso_scene *scene, iso_table_writer *rows)
{
    iso_stability_options o;
    iso_record *grid = NULL, *borders = NULL, *table = NULL;
    iso_status status = read_words(ctx, scene, c, &o);
    begin_work(ctx, NULL);
    if (status == ISO_OK) status = iso_stability_chart(ctx, &o, &grid, &borders);
    progress_end();
    if (status == ISO_STOPPED) complain("interrupted: no chart");
    if (status == ISO_OK && c->json && !print_json(&o, grid, borders)) status = ISO_NO_MEMORY;
    if (status == ISO_OK && !c->json && !(c->output && strcmp(c->output, "-") == 0)) print_table(&o, grid, borders);
    if (status == ISO_OK) status = make_table(ctx, scene, &o, grid, borders, &table);
    iso_record_free(grid);
    iso_record_free(borders);
    return table_finish(ctx, rows, c->plot, status, table);
}
