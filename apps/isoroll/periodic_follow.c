/* periodic_follow.c - shows followed orbits: as events, rows, JSON and a picture (see periodic_follow.h). */
#include "periodic_follow.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/output.h"
#include "json.h"
#include "periodic_chart.h"
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
        return iso_context_fail(ctx, ISO_BAD_INPUT, "",
                                "--follow '%s': expected NAME=A:B, NAME one of k, J1, J2, J3, ratio, level", given);
    o->vary = (iso_vary)vary;
    o->from = range[0];
    o->to = range[1];
    return ISO_OK;
}

iso_status follow_check(iso_context *ctx, const iso_scene *scene, const char *range)
{
    iso_continuation_options o;
    iso_status status = read_words(ctx, range, &o);
    if (status == ISO_OK) status = iso_continuation_check(ctx, scene, &o);
    return status == ISO_BAD_ARGUMENT ? ISO_BAD_INPUT : status;
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

static iso_status write_rows(iso_context *ctx, const iso_scene *scene, const iso_continuations *f, const char *name,
                             iso_output *to)
{
    iso_field fields[ISO_MOST_FIELDS];
    table_rename(iso_branch_row_fields, "k", name, fields);
    const iso_status status = table_begin(ctx, to, "periodic follow", scene, NULL, fields);
    for (size_t i = 0; status == ISO_OK && i < f->count; i++) {
        const iso_branch *b = &f->branch[i];
        iso_branch_row row = {.number = i + 1, .line = b->line, .period = b->period};
        for (size_t j = 0; j < b->points; j++) {
            row.at = b->point[j];
            iso_row_write(iso_output_stream(to), fields, &row);
        }
        for (size_t j = 0; j < b->events; j++) {
            row.at = b->event[j].at, row.event = &b->event[j];
            iso_row_write(iso_output_stream(to), fields, &row);
        }
    }
    return table_end(ctx, to, status);
}

static iso_status draw(iso_context *ctx, const iso_scene *scene, const iso_continuations *f, const char *name,
                       const char *path)
{
    static const char *const names[] = {"branch", "value", "x", "trace"};
    iso_record *r;
    char title[160];
    const double *J = scene->params.J;
    iso_status status = iso_record_create(ctx, 4, names, &r);
    for (size_t i = 0; i < f->count; i++)
        for (size_t j = 0; j < f->branch[i].points && status == ISO_OK; j++) {
            const iso_branch_point *p = &f->branch[i].point[j];
            double *row;
            status = iso_record_append(ctx, r, &row);
            if (status != ISO_OK) break;
            row[0] = (double)i, row[1] = p->value, row[3] = p->trace;
            row[2] = 2 * p->u / acos(-1);
        }
    snprintf(title, sizeof title, "k = %.6g, J = %.6g %.6g %.6g, along %s", scene->params.k, J[0], J[1], J[2], name);
    if (status == ISO_OK) status = iso_plot_branches(ctx, path, title, name, r);
    iso_record_free(r);
    return status;
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

static int show(iso_context *ctx, const iso_scene *scene, const iso_continuations *f,
                const iso_continuation_options *o, const periodic_follow *how)
{
    const char *name = iso_vary_name((int)o->vary);
    iso_status status = ISO_OK;
    size_t failed = 0;
    for (size_t i = 0; i < f->count; i++)
        for (size_t j = 0; j < f->branch[i].events; j++) failed += f->branch[i].event[j].kind == ISO_BRANCH_FAILURE;
    bool printed = true;
    if (how->json) printed = json_print(json_of(iso_continuation_fields, f));
    if (!how->json && !how->alone)
        for (size_t i = 0; i < f->count; i++) print_branch(f, i, name);
    if (how->rows) status = write_rows(ctx, scene, f, name, how->rows);
    if (status == ISO_OK && how->plot && f->count > 0) status = draw(ctx, scene, f, name, how->plot);
    const int result = printed ? finish(ctx, status) : EXIT_NUMERICAL;
    if (failed > 0) complain("%zu branches could not be followed to their ends: see their failures", failed);
    return result == EXIT_DONE && failed > 0 ? EXIT_SOME_FAILED : result;
}

/* The orbits to follow: the one that is asked for, or all that have a symmetry line. */
static iso_status choose(iso_context *ctx, const iso_periodic *found, const periodic_follow *how,
                         iso_periodic_orbit **list, size_t *count)
{
    *count = 0;
    if (how->orbit > (double)found->count)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "", "--orbit %g: the list ends at %zu", how->orbit, found->count);
    *list = malloc((found->count + 1) * sizeof **list);
    if (!*list) return iso_context_no_memory(ctx, "the orbits");
    for (size_t i = 0; i < found->count; i++)
        if (how->orbit > 0 ? (double)(i + 1) == how->orbit : found->orbit[i].line >= 0)
            (*list)[(*count)++] = found->orbit[i];
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

int follow_orbits(iso_context *ctx, const iso_scene *scene, const iso_periodic *found, const periodic_follow *how)
{
    iso_continuation_options o;
    iso_continuations *f = NULL;
    iso_periodic_orbit *list = NULL;
    size_t count = 0;
    iso_status status = read_words(ctx, how->range, &o);
    o.branches = how->branches;
    o.threads = how->threads;
    o.progress = progress_told;
    if (status == ISO_OK) status = choose(ctx, found, how, &list, &count);
    if (status == ISO_OK && how->orbit == 0 && count < found->count)
        complain("%zu orbits without a symmetry are not followed", found->count - count);
    if (status == ISO_OK && count == 0 && how->orbit == 0) status = none_to_follow(ctx, scene, found, how->period);
    progress_begin();
    if (status == ISO_OK) status = iso_continuation_run(ctx, scene, list, count, &o, &f);
    progress_end();
    if (status == ISO_STOPPED) complain("interrupted: branches are missing or cut");
    if (status == ISO_BAD_ARGUMENT) status = ISO_BAD_INPUT;
    int result = finish(ctx, status);
    if (f) {
        const int shown = show(ctx, scene, f, &o, how);
        if (shown > result) result = shown;
    } else if (how->rows) {
        iso_output_close(ctx, how->rows, false);
    }
    free(list);
    iso_continuation_free(f);
    return result;
}
