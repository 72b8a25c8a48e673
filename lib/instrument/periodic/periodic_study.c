/* periodic_study.c - periodic orbits by their name: the list, branches that are followed, and the chart of stable
 * rotations (study/study.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/rational_impl.h"
#include "instrument/periodic/periodic_study_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "study/level.h"

enum { STEPS = 120 };

/* --- what is typed ---------------------------------------------------------------------------------------------- */

ISO_STUDY_BEGIN(iso_periodic_request, (iso_periodic_request){.how = iso_periodic_defaults(), .steps = STEPS})

/* Options that do not go with each other. */
static iso_status prepare(iso_context *ctx, void *options)
{
    const iso_periodic_request *r = options;
    const iso_periodic_options *how = &r->how, usual = iso_periodic_defaults();
    const struct {
        bool is;
        const char *about, *text;
    } wrong[] = {
        {r->chart && r->follow, "chart", "--chart or --follow, not both"},
        {(r->orbit > 0 || r->branches) && !r->follow, "follow", "--orbit and --branches go with --follow"},
        {r->follow && how->polish, "polish", "--follow computes with 64 bits, not --polish"},
        {r->chart && (how->all || how->polish || how->period != usual.period), "chart",
         "--all, --polish and --period do not go with --chart"},
        {how->grid != usual.grid && !how->all, "grid", "--grid goes with --all"},
        {r->steps != STEPS && !r->chart, "steps", "--steps goes with --chart"},
        {r->k && !r->chart, "k", "--k is the range of --chart"},
        {r->level && !r->chart, "level",
         "--level is for --chart; elsewhere the level is the scene's, and --follow level=A:B changes it"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        if (wrong[i].is)
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, wrong[i].about, "periodic: %s", wrong[i].text);
    return ISO_OK;
}

/* Where the text of an option is "A:B". */
static bool read_range(const char *text, double range[2])
{
    const char *colon = strchr(text, ':');
    return colon && iso_rational_read_double(text, (size_t)(colon - text), &range[0]) &&
           iso_rational_read_double(colon + 1, strlen(colon + 1), &range[1]);
}

/* Which of the names stands before "=", or is all of the text; -1: none. */
static int named(const char *text, const char *(*name)(int))
{
    const size_t length = strcspn(text, "=");
    for (int i = 0; name(i); i++)
        if (strlen(name(i)) == length && strncmp(text, name(i), length) == 0) return i;
    return -1;
}

/* --- the list --------------------------------------------------------------------------------------------------- */

static iso_status list(iso_context *ctx, const iso_scene *scene, const iso_periodic *f, iso_study_result *result)
{
    iso_field fields[ISO_MOST_FIELDS];
    iso_record **table = &result->table[0];
    iso_fields_copy(iso_periodic_fields, "orbits", fields);
    iso_status status = iso_study_table(ctx, "periodic", scene, fields, f, iso_periodic_orbit_fields, table);
    for (size_t i = 0; status == ISO_OK && i < f->count; i++)
        status = iso_columns_append(ctx, iso_periodic_orbit_fields, &f->orbit[i], *table);
    if (f->unresolved > 0)
        iso_study_note(result,
                       "on %zu intervals of the symmetry lines the samples are too far apart: orbits may be missing",
                       f->unresolved);
    if (f->lost > 0)
        iso_study_note(result, "%zu zeros were seen where no orbit was found: orbits may be missing", f->lost);
    if (f->closed)
        iso_study_note(
            result, "on this level the point can come to rest: orbits that do so and go back the same way are listed "
                    "only if they have another symmetry, or with --all");
    return status;
}

/* --- branches --------------------------------------------------------------------------------------------------- */

static iso_status read_follow(iso_context *ctx, const iso_periodic_request *r, const iso_scene *scene,
                              iso_continuation_options *o)
{
    double range[2];
    const char *equals = strchr(r->follow, '=');
    const int vary = named(r->follow, iso_vary_name);
    if (!equals || vary < 0 || !read_range(equals + 1, range))
        return ISO_FAIL_ARGUMENT(ctx, "", "--follow '%s': expected NAME=A:B, NAME one of k, J1, J2, J3, ratio, level",
                                 r->follow);
    *o = iso_continuation_defaults();
    o->vary = (iso_vary)vary;
    o->from = range[0], o->to = range[1];
    o->branches = r->branches;
    o->threads = r->how.threads;
    return iso_continuation_check(ctx, scene, o);
}

/* The orbits to follow: the one that is asked for, or all that have a symmetry line. */
static iso_status choose(iso_context *ctx, const iso_scene *scene, const iso_periodic_request *r,
                         const iso_periodic *found, const iso_study_result *result, iso_periodic_orbit **list_,
                         size_t *count)
{
    const iso_params *p = &scene->params;
    if (r->orbit > (double)found->count)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "", "--orbit %s: the list ends at %zu", ISO_SHORT(r->orbit),
                                found->count);
    *list_ = malloc((found->count + 1) * sizeof **list_);
    if (!*list_) return iso_context_no_memory(ctx, "the orbits");
    for (size_t i = 0; i < found->count; i++)
        if (r->orbit > 0 ? (double)(i + 1) == r->orbit : found->orbit[i].line >= 0)
            (*list_)[(*count)++] = found->orbit[i];
    if (r->orbit == 0 && *count < found->count)
        iso_study_note(result, "%zu orbits without a symmetry are not followed", found->count - *count);
    if (r->orbit > 0 || *count > 0) return ISO_OK;
    return iso_context_fail(
        ctx, ISO_BAD_INPUT, "orbit",
        "no symmetric orbit to follow at k = %.12g, J = %.12g %.12g %.12g, level %.12g: the search "
        "along the six symmetry lines found none of at most %d returns; give a longer --period, or "
        "another k, J or level in the scene",
        p->k, p->J[0], p->J[1], p->J[2], found->level, r->how.period);
}

static iso_status follow(iso_context *ctx, const iso_scene *scene, const iso_periodic_request *r,
                         iso_continuation_options *how, const iso_periodic *found, iso_study_result *result)
{
    iso_field columns[ISO_MOST_FIELDS], fields[ISO_MOST_FIELDS];
    iso_continuations *f = NULL;
    iso_periodic_orbit *orbits = NULL;
    size_t count = 0, failed = 0;
    how->progress = result->sink.progress;
    how->data = result->sink.data;
    iso_status status = choose(ctx, scene, r, found, result, &orbits, &count);
    if (status == ISO_OK) status = iso_continuation_run(ctx, scene, orbits, count, how, &f);
    free(orbits);
    if (!f) return status;
    iso_study_keep(result, f, iso_continuation_fields, iso_continuation_free);
    iso_fields_rename(iso_branch_row_fields, "k", iso_vary_name((int)f->vary), columns);
    iso_fields_copy(iso_continuation_fields, "branches", fields);
    iso_status made = iso_study_table(ctx, "periodic follow", scene, fields, f, columns, &result->table[0]);
    for (const iso_branch *b = f->branch; b < f->branch + f->count; b++) {
        iso_branch_row row = {.number = (size_t)(b - f->branch) + 1, .line = b->line, .period = b->period};
        for (size_t j = 0; j < b->points + b->events; j++) {
            row.event = j < b->points ? NULL : &b->event[j - b->points];
            row.at = row.event ? row.event->at : b->point[j];
            failed += row.event && row.event->kind == ISO_BRANCH_FAILURE;
            if (made == ISO_OK) made = iso_columns_append(ctx, columns, &row, result->table[0]);
        }
    }
    result->failed = failed > 0;
    if (failed > 0)
        iso_study_note(result, "%zu branches could not be followed to their ends: see their failures", failed);
    return status == ISO_OK ? made : status;
}

/* The list, and what follows from it. */
static iso_status search(iso_context *ctx, const iso_scene *scene, const iso_periodic_request *r,
                         iso_study_result *result)
{
    iso_continuation_options how;
    iso_periodic_options options = r->how;
    iso_periodic *found = NULL;
    options.progress = result->sink.progress;
    options.data = result->sink.data;
    if (r->follow) ISO_TRY(read_follow(ctx, r, scene, &how));
    const iso_status status = iso_periodic_run(ctx, scene, &options, &found);
    if (!found) return status;
    iso_status after = ISO_OK;
    if (!r->follow) {
        iso_study_keep(result, found, iso_periodic_fields, iso_periodic_free);
        after = list(ctx, scene, found, result);
    } else {
        if (status == ISO_OK) after = follow(ctx, scene, r, &how, found, result);
        iso_periodic_free(found);
    }
    return status == ISO_OK ? after : status;
}

/* --- the chart -------------------------------------------------------------------------------------------------- */

static iso_status read_chart(iso_context *ctx, const iso_scene *scene, const iso_periodic_request *r,
                             iso_stability_options *o)
{
    const char *equals = strchr(r->chart, '=');
    *o = iso_stability_defaults();
    o->moment = named(r->chart, iso_chart_name);
    if (o->moment < 0 || (o->moment == ISO_CHART_LEVEL && !equals))
        return ISO_FAIL_ARGUMENT(ctx, "", "--chart '%s': expected J1, J2 or J3, or J2=A:B, or level=A:B", r->chart);
    memcpy(o->J, scene->params.J, sizeof o->J);
    if (!r->level)
        ISO_TRY(iso_level_of_scene(ctx, scene, "the chart is drawn", &o->level));
    else if (o->moment == ISO_CHART_LEVEL)
        return ISO_FAIL_ARGUMENT(ctx, "", "--level does not go with --chart level=A:B");
    else if (!iso_rational_read_double(r->level, strlen(r->level), &o->level))
        return ISO_FAIL_ARGUMENT(ctx, "", "--level '%s': expected a number", r->level);
    const double one = o->J[(o->moment + 1) % 3], other = o->J[(o->moment + 2) % 3];
    double k[2] = {o->from[0], o->to[0]}, moment[2] = {fmin(one, other), one + other};
    if (equals && !read_range(equals + 1, moment))
        return ISO_FAIL_ARGUMENT(ctx, "", "--chart '%s': expected %s=A:B, A < B", r->chart,
                                 iso_chart_name(o->moment));
    if (r->k && !read_range(r->k, k)) return ISO_FAIL_ARGUMENT(ctx, "", "--k '%s': expected A:B, A < B", r->k);
    o->from[0] = k[0], o->to[0] = k[1];
    o->from[1] = moment[0], o->to[1] = moment[1];
    o->steps = r->steps;
    o->threads = r->how.threads;
    return ISO_OK;
}

static void free_chart(void *found)
{
    iso_chart_found *f = found;
    iso_record_free(f->grid);
    iso_record_free(f->borders);
    free(f);
}

static iso_status chart(iso_context *ctx, const iso_scene *scene, const iso_periodic_request *r,
                        iso_study_result *result)
{
    iso_field columns[ISO_MOST_FIELDS];
    iso_record **table = &result->table[0];
    iso_chart_found *f = iso_study_keep(result, calloc(1, sizeof *f), iso_chart_fields, free_chart);
    if (!f) return iso_context_no_memory(ctx, "a chart");
    ISO_TRY(read_chart(ctx, scene, r, &f->how));
    f->level = f->how.moment == ISO_CHART_LEVEL ? (double)NAN : f->how.level;
    f->how.progress = result->sink.progress;
    f->how.data = result->sink.data;
    iso_status status = iso_stability_chart(ctx, &f->how, &f->grid, &f->borders);
    if (status == ISO_BAD_ARGUMENT) /* the ranges are the option's, not the scene's */
        return iso_context_fail(ctx, status, "chart", "%s", iso_context_message(ctx));
    ISO_TRY(status);
    iso_fields_rename(iso_chart_row_fields, "J2", iso_chart_name(f->how.moment), columns);
    status = iso_study_table(ctx, "periodic chart", scene, iso_chart_fields, f, columns, table);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(f->grid); i++) {
        const double *at = iso_record_const_row(f->grid, i);
        status = iso_columns_append(ctx, columns, &(iso_chart_row){"grid", at[0], at[1], at[2], at[3]}, *table);
    }
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(f->borders); i++) {
        const double *at = iso_record_const_row(f->borders, i);
        const bool least = at[0] == 0;
        const iso_chart_row row = {"border", at[2], at[3], least ? at[1] : (double)NAN, least ? (double)NAN : at[1]};
        status = iso_columns_append(ctx, columns, &row, *table);
    }
    return status;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    const iso_periodic_request *r = options;
    return r->chart ? chart(ctx, subject->scene, r, result) : search(ctx, subject->scene, r, result);
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_periodic_request, member)

const iso_option iso_periodic_option[] = {
    ROW("period", "P", "a whole number from 1 on", "orbits of at most P returns to the section (default 6)",
        iso_set_count_int, how.period),
    ROW("all", NULL, NULL, "orbits without a symmetry as well, by Newton's method from a grid", iso_set_flag,
        how.all),
    ROW("grid", "N", "a whole number from 1 on", "points of that grid (default 2000)", iso_set_count_long, how.grid),
    ROW("polish", NULL, NULL, "compute with 128 bits and print 30 digits", iso_set_flag, how.polish),
    ROW("follow", "NAME=A:B", "k, J1, J2, J3, ratio or level, =, two numbers and a colon",
        "follow orbits while k, a moment, the ratio (J2 - J1)/(J3 - J1) or the level goes from A to B", iso_set_text,
        follow),
    ROW("orbit", "N", "a whole number from 1 on", "follow orbit N of the list alone", iso_set_count, orbit),
    ROW("branches", NULL, NULL, "follow what branches off, too", iso_set_flag, branches),
    ROW("chart", "MOMENT", "J1, J2 or J3, or J2=A:B, or level=A:B",
        "in place of all that: where rotations are stable, in the plane of k and this moment or the level, from A "
        "to B",
        iso_set_text, chart),
    ROW("k", "A:B", "two numbers and a colon", "k of --chart (default -3:3)", iso_set_text, k),
    ROW("level", "X", "a number", "the level of --chart, everywhere (default: the scene's)", iso_set_text, level),
    ROW("steps", "N", "a whole number from 1 on", "steps of --chart in both directions (default 120)",
        iso_set_count_int, steps),
    ISO_OPTION_THREADS(iso_periodic_request, how.threads),
    ISO_OPTION_END,
};

const iso_study iso_periodic_study = {"periodic",
                                      "find periodic orbits, and whether they are stable",
                                      iso_periodic_option,
                                      sizeof(iso_periodic_request),
                                      begin,
                                      .prepare = prepare,
                                      .run = run,
                                      .of = ISO_STUDY_OF_SCENE,
                                      .fields = iso_periodic_fields,
                                      .print = iso_periodic_print,
                                      .describe = iso_periodic_describe};
