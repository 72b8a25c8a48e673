/* isoroll periodic - finds periodic orbits and tells whether they are stable. */
#include <math.h>
#include <string.h>

#include "io/output.h"
#include "json.h"
#include "periodic_chart.h"
#include "periodic_follow.h"
#include "periodic_report.h"
#include "plot/plot.h"
#include "progress.h"
#include "scene_options.h"

/* What periodic can be told. */
typedef struct options {
    scene_options scene; /* only its file is used */
    const char *output, *plot;
    const char *chart, *k, *level, *follow;
    double period, grid, steps, threads, orbit; /* orbit 0: all */
    bool all, polish, json, branches;
} options;

/* --- the list --------------------------------------------------------------------------------------------------- */

static int tell_gaps(const iso_periodic *f)
{
    if (f->unresolved > 0)
        complain("on %zu intervals of the symmetry lines the samples are too far apart: orbits may be missing",
                 f->unresolved);
    if (f->lost > 0) complain("%zu zeros were seen where no orbit was found: orbits may be missing", f->lost);
    if (f->closed)
        complain(
            "on this level the point can come to rest: orbits that do so and go back the same way are listed only "
            "if they have another symmetry, or with --all");
    return EXIT_DONE;
}

static int follow(iso_context *ctx, const options *o, const iso_scene *scene, const iso_periodic *found,
                  iso_output *csv)
{
    const periodic_follow how = {.range = o->follow,
                                 .orbit = o->orbit,
                                 .period = as_int(o->period),
                                 .branches = o->branches,
                                 .threads = as_int(o->threads),
                                 .rows = csv,
                                 .alone = o->output && strcmp(o->output, "-") == 0,
                                 .plot = o->plot,
                                 .json = o->json};
    return follow_orbits(ctx, scene, found, &how);
}

static int report(iso_context *ctx, const options *o, const periodic_report *r, iso_output *csv)
{
    int result = EXIT_DONE;
    if (o->json)
        result = json_print(json_of_scene(r->scene, iso_periodic_fields, r->found)) ? result : EXIT_NUMERICAL;
    else if (!o->output || strcmp(o->output, "-") != 0)
        periodic_print(r);
    if (csv) result = worse(result, finish(ctx, periodic_write_csv(ctx, r, csv)));
    if (o->plot && r->found->count == 0)
        complain("no picture: there is no orbit"), result = worse(result, EXIT_SOME_FAILED);
    else if (o->plot)
        result = worse(result, finish(ctx, periodic_draw(ctx, r, o->plot)));
    return worse(result, tell_gaps(r->found));
}

static int list(iso_context *ctx, const options *o, const iso_scene *scene, iso_output *csv)
{
    iso_periodic_options how = iso_periodic_defaults();
    iso_periodic *found = NULL;
    how.period = as_int(o->period);
    how.grid = o->grid < 1e18 ? (long)o->grid : 1000000000000000000;
    how.all = o->all;
    how.polish = o->polish;
    how.threads = as_int(o->threads);
    how.progress = progress_told;
    stop_gently();
    progress_begin();
    iso_context_set_monitor(ctx, not_interrupted, NULL);
    const iso_status status = iso_periodic_run(ctx, scene, &how, &found);
    progress_end();
    int result = finish_scene(ctx, &o->scene, scene, status);
    if (status == ISO_STOPPED) complain("interrupted: orbits are missing");
    if (!found || (o->follow && found->count == 0 && status == ISO_STOPPED))
        iso_output_close(ctx, csv, false);
    else if (o->follow)
        result = worse(result, follow(ctx, o, scene, found, csv));
    else
        result = worse(result, report(ctx, o, &(periodic_report){scene, found, o->polish, o->all}, csv));
    iso_context_set_monitor(ctx, NULL, NULL);
    iso_periodic_free(found);
    return result;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static const options defaults = {.scene = SCENE_OPTIONS_UNSET, .period = 6, .grid = 2000, .steps = 120};

/* Refuses wrong options before the work begins. */
static iso_status prepare(iso_context *ctx, const options *o, iso_scene *scene, iso_output **csv)
{
    iso_status status = check_json_alone(ctx, "periodic", o->output, o->json);
    if (status != ISO_OK) return status;
    if (o->chart && o->follow)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "chart", "periodic: --chart or --follow, not both");
    if ((o->orbit > 0 || o->branches) && !o->follow)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "follow", "periodic: --orbit and --branches go with --follow");
    if (o->follow && o->polish)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "polish",
                                "periodic: --follow computes with 64 bits, not --polish");
    if (o->chart && (o->all || o->polish || o->period != defaults.period))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "chart",
                                "periodic: --all, --polish and --period do not go with --chart");
    if (o->grid != defaults.grid && !o->all)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "grid", "periodic: --grid goes with --all");
    if (o->steps != defaults.steps && !o->chart)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "steps", "periodic: --steps goes with --chart");
    if (o->k && !o->chart)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "k", "periodic: --k is the range of --chart");
    if (o->level && !o->chart)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "level",
                                "periodic: --level is for --chart; elsewhere the level is the scene's, and --follow "
                                "level=A:B changes it");
    if (o->plot) status = iso_plot_check_format(ctx, o->plot);
    if (status == ISO_OK) status = iso_scene_read(ctx, o->scene.file, scene);
    if (status == ISO_OK && o->follow) status = follow_check(ctx, scene, o->follow);
    return status == ISO_OK && o->output ? iso_output_open(ctx, o->output, csv) : status;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_output *csv = NULL;
    const iso_status status = prepare(ctx, o, &scene, &csv);
    if (status != ISO_OK) return finish(ctx, status);
    if (o->chart)
        return draw_chart(ctx, &scene,
                          &(periodic_chart){.moment = o->chart,
                                            .k = o->k,
                                            .level = o->level,
                                            .steps = o->steps,
                                            .threads = as_int(o->threads),
                                            .rows = csv,
                                            .alone = o->output && strcmp(o->output, "-") == 0,
                                            .plot = o->plot,
                                            .json = o->json});
    return list(ctx, o, &scene, csv);
}

static const option_row rows[] = {
    ROW("period", "P", "a whole number from 1 on", "orbits of at most P returns to the section (default 6)",
        set_count, options, period),
    ROW("all", NULL, NULL, "orbits without a symmetry as well, by Newton's method from a grid", set_flag, options,
        all),
    ROW("grid", "N", "a whole number from 1 on", "points of that grid (default 2000)", set_count, options, grid),
    ROW("polish", NULL, NULL, "compute with 128 bits and print 30 digits", set_flag, options, polish),
    ROW("follow", "NAME=A:B", "k, J1, J2, J3, ratio or level, =, two numbers and a colon",
        "follow orbits while k, a moment, the ratio (J2 - J1)/(J3 - J1) or the level goes from A to B", set_text,
        options, follow),
    ROW("orbit", "N", "a whole number from 1 on", "follow orbit N of the list alone", set_count, options, orbit),
    ROW("branches", NULL, NULL, "follow what branches off, too", set_flag, options, branches),
    ROW("chart", "MOMENT", "J1, J2 or J3, or J2=A:B, or level=A:B",
        "in place of all that: where rotations are stable, in the plane of k and this moment or the level, from A "
        "to B",
        set_text, options, chart),
    ROW("k", "A:B", "two numbers and a colon", "k of --chart (default -3:3)", set_text, options, k),
    ROW("level", "X", "a number", "the level of --chart, everywhere (default: the scene's)", set_text, options,
        level),
    ROW("steps", "N", "a whole number from 1 on", "steps of --chart in both directions (default 120)", set_count,
        options, steps),
    ROW_THREADS(options, threads),
    ROW_OUTPUT(options, output),
    ROW_PLOT(options, plot),
    ROW_JSON(options, json),
    ROW_END,
};

const command command_periodic = {
    .name = "periodic",
    .argument = "SCENE",
    .doc = "find periodic orbits, and whether they are stable",
    .rows = rows,
    .defaults = &defaults,
    .size = sizeof defaults,
    .file = offsetof(options, scene.file),
    .takes = FILE_SCENE,
    .description =
        "Shows the rotations about the principal axes first: the trace of Hill's equation over half a turn, found "
        "in two ways, stable between -2 and 2. Then it searches for all symmetric periodic orbits of at most P "
        "returns to the section n_a = 0, as roots along the six symmetry lines: x = 0, l = 0 and l = pi/2 of the "
        "section, for the reversors S1, S2, S3; and three lines half way between two crossings, for T S1, T S2, T "
        "S3. A message says where some may be missing. Orbits without a symmetry need --all.\n\n"
        "For each orbit: a point (l, x) of the section, the trace of the return map's derivative over the period "
        "with its error, stability, which reversors map the orbit to itself, how many copies R, S1 S2 and T make "
        "of it (itself among them), and its period in t. JSON and -o add the start in both models, the periods in "
        "tau and s, and how well the orbit closes. lib/doc/theory.md explains R, S1, S2, S3 and T.\n\n"
        "Only k, J and the energy of the scene are read. Orbits of the free ball do not depend on the energy, only "
        "their clocks do. A point off H = 0, or a ball with the effect 'level', has a level (H/eps) J2^(1/k), J2 "
        "the middle moment: a number without a unit. Orbits depend on it. On a low level the point cannot reach "
        "the whole sphere. Then a rotation may be missing, and the point oscillates between two places of rest "
        "instead.\n\n"
        "For k = 1 and k = -1 most periodic orbits fill tori, on every level. Those on the symmetry lines are "
        "listed as degenerate (trace 2).\n\n"
        "--follow k=A:B follows symmetric orbits from the scene's k to A and to B, or until they end: folds, "
        "period doublings, touches of the trace -2, symmetry breaking and collisions with rotations are located. "
        "Where a branch cannot be followed, a line says where and why, and the part so far is kept. --branches "
        "follows what branches off as well, but not what branches off from that. While k or a moment changes, the "
        "level stays that of the scene; --follow level=A:B changes it.\n\n"
        "--chart J2 shows in which part of the plane of k and J2 the rotations about the axes of the least and of "
        "the greatest moment are stable, and the borders on which a trace is 2 or -2. (The axis of the middle "
        "moment is never stable.) The level is that of the scene, or --level; --chart level=A:B has the level in "
        "place of J2.\n\n"
        "-o FILE writes one row for each orbit, in doubles. --plot draws all orbits and their copies on the "
        "section, unstable ones in grey.",
    .example = "isoroll periodic scene.yaml --period 8 --plot orbits.svg",
    .exits = "1: interrupted, or a branch could not be followed to its end\n"
             "3: bad input: an effect that acts, other than 'level', two equal moments, a ball at rest, a range "
             "without the "
             "scene's value",
    .run = run,
};
