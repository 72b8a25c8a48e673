/* periodic_follow.c - shows followed orbits: as events, rows, JSON and a picture (see periodic.h). */
#include "periodic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "plot/plot.h"
#include "progress.h"
#include "report.h"
#include "study/periodic/continuation.h"
#include "table.h"

static iso_status read_words(iso_context *ctx, const char *given, iso_continuation_options *o)
{
    double range[2];
    const char *equals = strchr(given, '=');
    *o = iso_continuation_defaults();
    int vary = 0;
    while (iso_vary_name(vary) && equals &&
           (strlen(iso_vary_name(vary)) != (size_t)(equals - given) ||
            strncmp(iso_vary_name(vary), given, (size_t)(equals - given)) != 0))
        vary++;
    if (!equals || !iso_vary_name(vary) || !read_range(equals + 1, range))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "--follow '%s': expected NAME=A:B, NAME one of k, J1, J2, J3, ratio, level", given);
    o->vary = (iso_vary)vary;
    o->from = range[0];
    o->to = range[1];
    return ISO_OK;
}

iso_status follow_check(iso_context *ctx, const iso_scene *scene, const char *range)
{
    iso_continuation_options o;
    const iso_status status = read_words(ctx, range, &o);
    return status == ISO_OK ? iso_continuation_check(ctx, scene, &o) : status;
}

/* --- what is shown ---------------------------------------------------------------------------------------------- */

static void print_branch(const iso_continuations *f, size_t i, const char *name)
{
    const iso_branch *b = &f->branch[i];
    double low = INFINITY, high = -INFINITY;
    for (size_t j = 0; j < b->points; j++) low = fmin(low, b->point[j].value), high = fmax(high, b->point[j].value);
    printf("branch %zu: period %d, on the line of %s, %s from %.12g to %.12g, %zu points", i + 1, b->period,
           iso_symmetry_line_name(b->line), name, low, high, b->points);
    if (b->parent >= 0) printf(", from branch %d", b->parent + 1);
    putchar('\n');
    for (size_t j = 0; j < b->events; j++)
        printf("  %-17s  %s = %-18.13g  l = %-14.9g  x = %-14.9g  trace %-12.8g  %s\n",
               iso_branch_kind_name(b->event[j].kind), name, b->event[j].at.value, b->event[j].at.l, b->event[j].at.x,
               b->event[j].at.trace, b->event[j].words);
}

static iso_status make_table(iso_context *ctx, const iso_scene *scene, const iso_continuations *f, const char *name,
                             iso_record **table)
{
    iso_field fields[ISO_MOST_FIELDS];
    char title[ISO_PLOT_TITLE];
    const table_line lines[] = {{.key = "title", .text = iso_plot_title(title, &scene->params, ", along %s", name)},
                                {.key = NULL}};
    table_rename(iso_branch_row_fields, "k", name, fields);
    iso_status status = table_create(ctx, "periodic follow", scene, lines, fields, table);
    for (size_t i = 0; i < f->count; i++) {
        const iso_branch *b = &f->branch[i];
        iso_branch_row row = {.number = i + 1, .line = b->line, .period = b->period};
        for (size_t j = 0; status == ISO_OK && j < b->points + b->events; j++) {
            row.event = j < b->points ? NULL : &b->event[j - b->points];
            row.at = row.event ? row.event->at : b->point[j];
            status = iso_columns_append(ctx, fields, &row, *table);
        }
    }
    return status;
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

static int show(iso_context *ctx, const iso_scene *scene, const iso_continuations *f, const periodic_options *o,
                const char *name, iso_table_writer *rows)
{
    iso_record *table = NULL;
    size_t failed = 0;
    for (size_t i = 0; i < f->count; i++)
        for (size_t j = 0; j < f->branch[i].events; j++) failed += f->branch[i].event[j].kind == ISO_BRANCH_FAILURE;
    bool printed = true;
    if (o->json) printed = json_print(json_of(iso_continuation_fields, f));
    if (!o->json && !(o->output && strcmp(o->output, "-") == 0))
        for (size_t i = 0; i < f->count; i++) print_branch(f, i, name);
    const iso_status made = make_table(ctx, scene, f, name, &table);
    int result = table_finish(ctx, rows, f->count > 0 ? o->plot : NULL, made, table);
    if (!printed) result = EXIT_NUMERICAL;
    if (failed > 0) complain("%zu branches could not be followed to their ends: see their failures", failed);
    return result == EXIT_DONE && failed > 0 ? EXIT_SOME_FAILED : result;
}

/* The orbits to follow: the one that is asked for, or all that have a symmetry line. */
static iso_status choose(iso_context *ctx, const iso_periodic *found, double orbit, iso_periodic_orbit **list,
                         size_t *count)
{
    *count = 0;
    if (orbit > (double)found->count)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "", "--orbit %g: the list ends at %zu", orbit, found->count);
    *list = malloc((found->count + 1) * sizeof **list);
    if (!*list) return iso_context_no_memory(ctx, "the orbits");
    for (size_t i = 0; i < found->count; i++)
        if (orbit > 0 ? (double)(i + 1) == orbit : found->orbit[i].line >= 0) (*list)[(*count)++] = found->orbit[i];
    return ISO_OK;
}

/* Where orbits were looked for, and how. */
static iso_status none_to_follow(iso_context *ctx, const iso_scene *scene, const iso_periodic *found, int period)
{
    const iso_params *p = &scene->params;
    return iso_context_fail(
        ctx, ISO_BAD_INPUT, "orbit",
        "no symmetric orbit to follow at k = %.12g, J = %.12g %.12g %.12g, level %.12g: the search "
        "along the six symmetry lines found none of at most %d returns; give a longer --period, or "
        "another k, J or level in the scene",
        p->k, p->J[0], p->J[1], p->J[2], found->level, period);
}

int follow_orbits(iso_context *ctx, const periodic_options *o, const iso_scene *scene, const iso_periodic *found,
                  iso_table_writer *rows)
{
    iso_continuation_options how;
    iso_continuations *f = NULL;
    iso_periodic_orbit *list = NULL;
    size_t count = 0;
    iso_status status = read_words(ctx, o->follow, &how);
    how.branches = o->branches;
    how.threads = o->study.threads;
    how.progress = progress_told;
    if (status == ISO_OK) status = choose(ctx, found, o->orbit, &list, &count);
    if (status == ISO_OK && o->orbit == 0 && count < found->count)
        complain("%zu orbits without a symmetry are not followed", found->count - count);
    if (status == ISO_OK && count == 0 && o->orbit == 0) status = none_to_follow(ctx, scene, found, o->study.period);
    progress_begin();
    if (status == ISO_OK) status = iso_continuation_run(ctx, scene, list, count, &how, &f);
    progress_end();
    if (status == ISO_STOPPED) complain("interrupted: branches are missing or cut");
    int result = finish(ctx, status);
    if (f)
        result = worse(result, show(ctx, scene, f, o, iso_vary_name((int)how.vary), rows));
    else
        iso_table_writer_close(ctx, rows, false);
    free(list);
    iso_continuation_free(f);
    return result;
}
