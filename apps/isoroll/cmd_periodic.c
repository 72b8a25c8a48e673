/* isoroll periodic - finds periodic orbits and tells whether they are stable. */
#include <math.h>
#include <string.h>

#include "json.h"
#include "periodic.h"
#include "plot/plot.h"
#include "progress.h"
#include "scene_options.h"

typedef periodic_options options;

/* --- the list --------------------------------------------------------------------------------------------------- */

static void tell_gaps(const iso_periodic *f)
{
    if (f->unresolved > 0)
        complain("on %zu intervals of the symmetry lines the samples are too far apart: orbits may be missing",
                 f->unresolved);
    if (f->lost > 0) complain("%zu zeros were seen where no orbit was found: orbits may be missing", f->lost);
    if (f->closed)
        complain(
            "on this level the point can come to rest: orbits that do so and go back the same way are listed only "
            "if they have another symmetry, or with --all");
}

static int report(iso_context *ctx, const options *o, const iso_scene *scene, const iso_periodic *found,
                  iso_table_writer *csv)
{
    int result = EXIT_DONE;
    if (o->json)
        result = json_print(json_of_scene(scene, iso_periodic_fields, found)) ? result : EXIT_NUMERICAL;
    else if (!o->output || strcmp(o->output, "-") != 0)
        periodic_print(o, scene, found);
    iso_record *table = NULL;
    iso_status made = csv ? periodic_table(ctx, scene, found, false, &table) : ISO_OK;
    result = worse(result, table_finish(ctx, csv, NULL, made, table));
    if (o->plot && found->count == 0) {
        complain("no picture: there is no orbit");
        result = worse(result, EXIT_SOME_FAILED);
    } else if (o->plot) {
        made = periodic_table(ctx, scene, found, true, &table);
        result = worse(result, table_finish(ctx, NULL, o->plot, made, table));
    }
    tell_gaps(found);
    return result;
}

static int list(iso_context *ctx, const options *o, const iso_scene *scene, iso_table_writer *csv)
{
    iso_periodic_options how = o->study;
    iso_periodic *found = NULL;
    how.progress = progress_told;
    begin_work(ctx, NULL);
    const iso_status status = iso_periodic_run(ctx, scene, &how, &found);
    progress_end();
    int result = finish_scene(ctx, &o->scene, scene, status);
    if (status == ISO_STOPPED) complain("interrupted: orbits are missing");
    if (!found || (o->follow && found->count == 0 && status == ISO_STOPPED))
        iso_table_writer_close(ctx, csv, false);
    else if (o->follow)
        result = worse(result, follow_orbits(ctx, o, scene, found, csv));
    else
        result = worse(result, report(ctx, o, scene, found, csv));
    iso_periodic_free(found);
    return result;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static const options defaults = {.scene = SCENE_OPTIONS_UNSET, .steps = 120};

/* Refuses wrong options before the work begins. */
static iso_status prepare(iso_context *ctx, const options *o, iso_scene *scene, iso_table_writer **csv)
{
    const iso_periodic_options *how = &o->study, usual = iso_periodic_defaults();
    iso_status status = check_json_alone(ctx, "periodic", o->output, o->json);
    if (status != ISO_OK) return status;
    if (o->chart && o->follow)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "chart", "periodic: --chart or --follow, not both");
    if ((o->orbit > 0 || o->branches) && !o->follow)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "follow", "periodic: --orbit and --branches go with --follow");
    if (o->follow && how->polish)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "polish",
                                "periodic: --follow computes with 64 bits, not --polish");
    if (o->chart && (how->all || how->polish || how->period != usual.period))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "chart",
                                "periodic: --all, --polish and --period do not go with --chart");
    if (how->grid != usual.grid && !how->all)
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
    const char *kind = o->chart ? "periodic chart" : o->follow ? "periodic follow" : "periodic";
    return status == ISO_OK && o->output ? iso_table_writer_open(ctx, o->output, kind, csv) : status;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_table_writer *csv = NULL;
    const iso_status status = prepare(ctx, o, &scene, &csv);
    if (status != ISO_OK) return finish(ctx, status);
    if (o->chart) return draw_chart(ctx, o, &scene, csv);
    return list(ctx, o, &scene, csv);
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_periodic_option, 0, 4),
    ROW("follow", "NAME=A:B", "k, J1, J2, J3, ratio or level, =, two numbers and a colon",
        "follow orbits while k, a moment, the ratio (J2 - J1)/(J3 - J1) or the level goes from A to B", iso_set_text,
        options, follow),
    ROW("orbit", "N", "a whole number from 1 on", "follow orbit N of the list alone", iso_set_count, options, orbit),
    ROW("branches", NULL, NULL, "follow what branches off, too", iso_set_flag, options, branches),
    ROW("chart", "MOMENT", "J1, J2 or J3, or J2=A:B, or level=A:B",
        "in place of all that: where rotations are stable, in the plane of k and this moment or the level, from A "
        "to B",
        iso_set_text, options, chart),
    ROW("k", "A:B", "two numbers and a colon", "k of --chart (default -3:3)", iso_set_text, options, k),
    ROW("level", "X", "a number", "the level of --chart, everywhere (default: the scene's)", iso_set_text, options,
        level),
    ROW("steps", "N", "a whole number from 1 on", "steps of --chart in both directions (default 120)",
        iso_set_count_int, options, steps),
    ROWS_OF_STUDY(iso_periodic_option, 4, 1),
    ROW_OUTPUT(options, output),
    ROW_PLOT(options, plot),
    ROW_JSON(options, json),
    ROW_END,
};

const command command_periodic = {
    COMMAND("periodic", "SCENE", "find periodic orbits, and whether they are stable", scene.file),
    .takes = FILE_SCENE,
    .study = &iso_periodic_study,
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
};
