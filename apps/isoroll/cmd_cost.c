/* isoroll cost - measures what accuracy costs: error and processor time for every backend, method and tolerance. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cost_report.h"
#include "plot/plot.h"
#include "scene_options.h"
#include "study/cost/cost_impl.h"
#include "table.h"

/* What cost can be told. */
typedef struct options {
    scene_options scene;
    const char *plot, *csv; /* NULL: not given */
    double want;            /* NAN: not given  */
    double horizons;        /* 0: not given    */
    bool json, quick;
} options;

static void show(double share, const char *what, void *data)
{
    (void)what;
    (void)data;
    progress_show(share);
}

static iso_cost_options options_of(const options *o)
{
    iso_cost_options c = iso_cost_defaults();
    c.quick = o->quick || !isnan(o->want);
    if ((int)o->scene.backend >= 0) c.backend = o->scene.backend;
    if (o->scene.method) c.method = iso_method_find(o->scene.method);
    if (!isnan(o->scene.tolerance)) c.tolerance = o->scene.tolerance;
    c.progress = show;
    return c;
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
static int best_cells(const iso_cost *cost, const iso_cost_series *const line[],
                      const iso_cost_cell *best[COST_GROWTHS])
{
    int count = 0;
    for (int l = 0; l < cost->lines && count < COST_GROWTHS; l++) {
        const iso_cost_cell *cell = most_exact(cost, line[l]);
        bool known = !cell;
        for (int i = 0; i < count; i++) known = known || best[i]->backend == line[l]->backend;
        if (!known) best[count++] = cell;
    }
    return count;
}

static void grow(iso_context *ctx, const options *o, const iso_cost_series *const line[], cost_report *r)
{
    const iso_cost_cell *best[COST_GROWTHS];
    const int count = best_cells(r->cost, line, best);
    for (int i = 0; i < count && !interrupted(); i++) {
        cost_growth *g = &r->growth[r->growths++];
        *g = (cost_growth){.cell = best[i]};
        if (iso_cost_grow(ctx, r->scene, best[i], (int)o->horizons, &g->growth) != ISO_OK)
            snprintf(g->why, sizeof g->why, "%s", iso_context_message(ctx));
    }
}

/* --- the command ------------------------------------------------------------------------------------------------ */

/* Prints the choice for --want as options of `run`. The error and time to expect go to stderr. */
static int tell_choice(const cost_report *r)
{
    char words[COST_OPTIONS], seconds[COST_SECONDS];
    const iso_cost_cell *c = r->choice;
    if (!c)
        return complain("nothing measured reaches an error of %g: try a larger --want", r->want), EXIT_SOME_FAILED;
    printf("%s\n", cost_options_of(c, words));
    complain("expected: error %.1e%s, time %s", c->error, c->below ? ", or less: the reference is no better" : "",
             cost_seconds(c->total, seconds));
    return EXIT_DONE;
}

static int print_report(const options *o, const iso_cost_series *const line[], const cost_report *r)
{
    const bool lost = !r->cost->complete || cost_count(r->cost, cost_is_failed) > 0;
    const bool failed = isnan(r->want) ? lost : !r->choice;
    if (o->json) return !cost_print_json(r) ? EXIT_NUMERICAL : failed ? EXIT_SOME_FAILED : EXIT_DONE;
    if (!isnan(r->want)) return tell_choice(r);
    if (!o->csv || strcmp(o->csv, "-") != 0) cost_print(r, line);
    return failed ? EXIT_SOME_FAILED : EXIT_DONE;
}

/* Prints and draws what was asked for. */
static int report(iso_context *ctx, const options *o, cost_report *r, iso_table_writer *csv)
{
    const iso_cost_series **line = cost_sort_lines(r->cost);
    if (!line) return complain("out of memory"), iso_table_writer_close(ctx, csv, false), EXIT_NUMERICAL;
    if (o->horizons > 0 && r->cost->complete) grow(ctx, o, line, r);
    progress_end();
    int result = print_report(o, line, r);
    iso_record *table = NULL;
    const bool measured = cost_count(r->cost, iso_cost_is_measured) > 0;
    const iso_status made = cost_table(ctx, r, line, &table);
    result = worse(result, table_finish(ctx, csv, measured ? o->plot : NULL, made, table));
    if (o->plot && !measured) complain("no picture: nothing has been measured");
    free(line);
    return result;
}

/* Reads the scene and opens the files. Refuses wrong options before the work begins. */
static iso_status prepare(iso_context *ctx, const options *o, iso_scene *scene, iso_table_writer **csv)
{
    if (o->csv && strcmp(o->csv, "-") == 0 && (o->json || !isnan(o->want)))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "csv",
                                "cost: standard output has room for one: choose --csv -, --json or --want");
    if (o->horizons > 0 && !o->json && (!isnan(o->want) || (o->csv && strcmp(o->csv, "-") == 0)))
        return iso_context_fail(
            ctx, ISO_BAD_ARGUMENT, "horizons",
            "cost: --want and --csv - leave no room for what --horizons tells: leave one of them out");
    iso_status status = scene_with_options(ctx, &o->scene, scene);
    if (status == ISO_OK && o->plot) status = iso_plot_check_format(ctx, o->plot);
    if (status == ISO_OK && o->csv) status = iso_table_writer_open(ctx, o->csv, "cost", csv);
    return status;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_table_writer *csv = NULL;
    iso_cost *cost = NULL;
    iso_status status = prepare(ctx, o, &scene, &csv);
    const iso_cost_options how = options_of(o);
    begin_work(ctx, NULL);
    if (status == ISO_OK) status = iso_cost_measure(ctx, &scene, &how, &cost);
    int result = finish_scene(ctx, &o->scene, &scene, status);
    const int measured = cost ? cost_count(cost, iso_cost_is_measured) : 0;
    if (status == ISO_STOPPED && cost)
        complain("interrupted: %d of %d cells were measured", measured, cost->cells);
    else if (status == ISO_STOPPED)
        complain("interrupted: nothing has been measured");
    if (measured > 0 || status == ISO_OK) {
        cost_report r = {.scene = &scene, .cost = cost, .want = o->want};
        if (!isnan(o->want)) r.choice = iso_cost_choose(cost, o->want);
        result = worse(result, report(ctx, o, &r, csv));
        if (status == ISO_OK && interrupted()) {
            complain("interrupted: longer orbits are missing");
            result = worse(result, EXIT_SOME_FAILED);
        }
    } else {
        iso_table_writer_close(ctx, csv, false);
    }
    iso_cost_free(cost);
    return result;
}

/* The number of orbits may be left out. */
static bool set_horizons(void *at, const char *text)
{
    const bool set = iso_set_count(at, text ? text : "6");
    return set && *(double *)at <= ISO_COST_HORIZONS;
}

static const options defaults = {.scene = SCENE_OPTIONS_UNSET, .want = NAN};

static const option_row rows[] = {
    ROW_BACKEND(options, scene),
    ROW_METHOD(options, scene),
    ROW_TOLERANCE(options, scene),
    ROW_T_END(options, scene),
    ROW("quick", NULL, NULL, "measure three tolerances only: a few seconds", iso_set_flag, options, quick),
    ROW("want", "X", "a positive number", "print only the cheapest choice with an error of at most X",
        iso_set_positive, options, want),
    ROW("horizons", "[=N]", "a whole number from 1 to 24",
        "growth over N orbits (default 6), each twice as long as the one before", set_horizons, options, horizons),
    ROW_PLOT(options, plot),
    ROW_OF_FILE("csv", "FILE", "a file", "write the table as CSV to FILE; - is standard output", iso_set_text,
                options, csv, 0, OPTION_WRITES),
    ROW_JSON(options, json),
    ROW_END,
};

const command command_cost = {
    COMMAND("cost", "SCENE", "measure error against time for every backend, method and tolerance", scene.file),
    .takes = FILE_SCENE,
    .description =
        "All backends, methods and tolerances are measured. --backend, --method or --tol restrict the measurement to "
        "one; the scene's own backend, method and tolerance are not read.\n\n"
        "An error is the largest relative error of (omega, n) at 20 times from the start to the end. The reference "
        "is "
        "none of the measured runs. A time is processor time, the median of several runs; set-up is shown apart.\n\n"
        "--want X prints the cheapest choice as options of 'isoroll run'. --horizons repeats the best choice of each "
        "backend over orbits 2, 4, ... times as long, and tells how error and time grow. After Ctrl-C, what has been "
        "measured is printed.",
    .example = "isoroll cost scene.yaml --quick --plot cost.svg\n"
               "isoroll run scene.yaml $(isoroll cost scene.yaml --want 1e-9)",
    .exits = "1: a run failed, or nothing reaches the error that --want asks for",
};
