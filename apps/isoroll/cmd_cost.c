/* isoroll cost - what accuracy costs in time: error and processor time by every backend, method and tolerance. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cost_report.h"

static void show(double share, const char *what, void *data)
{
    (void)what;
    (void)data;
    progress_show(share);
}

static bool go_on(void *data)
{
    (void)data;
    return !interrupted();
}

static iso_cost_options options_of(const options *o)
{
    iso_cost_options c = iso_cost_defaults();
    c.quick = o->quick || !isnan(o->want);
    if ((int)o->backend >= 0) c.backend = o->backend;
    if (o->method) c.method = iso_method_find(o->method);
    if (!isnan(o->tolerance)) c.tolerance = o->tolerance;
    c.progress = show;
    return c;
}

/* --- growth ----------------------------------------------------------------------------------------------------- */

/* The most exact cell of a line; NULL: none is measured. */
static const iso_cost_cell *most_exact(const iso_cost *cost, const iso_cost_line *line)
{
    const iso_cost_cell *best = NULL;
    for (int i = line->first; i < line->first + line->count; i++) {
        const iso_cost_cell *c = &cost->cell[i];
        if (iso_cost_is_measured(c) && (!best || c->error < best->error)) best = c;
    }
    return best;
}

/* Of each backend the fastest method, where it is most exact. */
static int best_cells(const iso_cost *cost, const iso_cost_line *const line[],
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

static void grow(iso_context *ctx, const options *o, const iso_cost_line *const line[], cost_report *r)
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

/* --- the picture ------------------------------------------------------------------------------------------------ */

enum { NAMED = 6 }; /* methods of each backend that have a name in the picture */

/* Whether a line is one of the first of its backend, or its method has its name from another one. */
static bool has_name(const iso_plot_work *work, int in_panel, int *names, const char *name)
{
    for (int s = 0; s < work->count; s++)
        if (work->series[s].name && strcmp(work->series[s].name, name) == 0) return true;
    return in_panel < NAMED && (*names)++ < ISO_PLOT_NAMES;
}

/* The lines of one backend, the fastest first; error and seconds are those of all cells. */
static void add_panel(const iso_cost *cost, const iso_cost_line *const line[], iso_picture backend,
                      const double *error, const double *seconds, iso_plot_work *work, iso_plot_series *series,
                      int *names)
{
    int in_panel = 0;
    for (int l = 0; l < cost->lines && work->count < ISO_PLOT_SERIES; l++) {
        const iso_cost_line *one = line[l];
        if (!one->method || one->backend != backend) continue;
        const bool named = has_name(work, in_panel++, names, one->method->name);
        series[work->count++] = (iso_plot_series){.panel = iso_picture_name((int)backend),
                                                  .name = named ? one->method->name : NULL,
                                                  .count = one->count,
                                                  .error = error + one->first,
                                                  .seconds = seconds + one->first};
    }
}

static iso_status draw(iso_context *ctx, const options *o, const iso_cost_line *const line[], const cost_report *r)
{
    const iso_params *p = &r->scene->params;
    const iso_cost *cost = r->cost;
    char title[128];
    snprintf(title, sizeof title, "k = %.6g, J = %.6g %.6g %.6g, %s = %.6g, about %.3g turns", p->k, p->J[0], p->J[1],
             p->J[2], r->scene->start.model == ISO_BALL ? "t" : "s", cost->end, cost->turns);
    iso_plot_series series[ISO_PLOT_SERIES];
    iso_plot_work work = {.title = title, .series = series, .closed = {NAN, NAN}, .uncertainty = cost->uncertainty};
    double *error = calloc(2 * (size_t)cost->cells + 1, sizeof *error), *seconds = error + cost->cells;
    int names = 0;
    if (!error) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to draw");
    for (int i = 0; i < cost->cells; i++) {
        const iso_cost_cell *c = &cost->cell[i];
        error[i] = iso_cost_is_measured(c) ? c->error : (double)NAN;
        seconds[i] = c->total;
        if (!c->method) work.closed[0] = error[i], work.closed[1] = seconds[i];
    }
    add_panel(cost, line, ISO_BALL, error, seconds, &work, series, &names);
    add_panel(cost, line, ISO_POINT, error, seconds, &work, series, &names);
    const iso_status status = iso_plot_cost(ctx, o->plot, &work);
    free(error);
    return status;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

/* What suits --want, as options to be pasted; what is expected of it goes to stderr. */
static int tell_choice(const cost_report *r)
{
    char words[COST_OPTIONS], seconds[COST_SECONDS];
    const iso_cost_cell *c = iso_cost_choose(r->cost, r->want);
    if (!c) return complain("nothing measured reaches an error of %g", r->want), EXIT_SOME_FAILED;
    printf("%s\n", cost_options_of(c, words));
    complain("expected: error %.1e%s, time %s", c->error, c->below ? ", or less: the reference is no better" : "",
             cost_seconds(c->total, seconds));
    return EXIT_DONE;
}

static int tell(const options *o, const iso_cost_line *const line[], const cost_report *r)
{
    const bool lost = !r->cost->complete || cost_count(r->cost, cost_is_failed) > 0;
    const bool failed = isnan(r->want) ? lost : !iso_cost_choose(r->cost, r->want);
    if (o->json) return !cost_print_json(r) ? EXIT_NUMERICAL : failed ? EXIT_SOME_FAILED : EXIT_DONE;
    if (!isnan(r->want)) return tell_choice(r);
    if (!o->csv || strcmp(o->csv, "-") != 0) cost_print(r, line);
    return failed ? EXIT_SOME_FAILED : EXIT_DONE;
}

static int worse(int a, int b)
{
    return a > b ? a : b;
}

/* Everything that was asked for, of what was measured. */
static int report(iso_context *ctx, const options *o, cost_report *r, iso_output *csv)
{
    const iso_cost_line **line = cost_sort_lines(r->cost);
    if (!line) return complain("out of memory"), iso_output_close(ctx, csv, false), EXIT_NUMERICAL;
    if (o->horizons > 0 && r->cost->complete) grow(ctx, o, line, r);
    progress_end();
    int result = tell(o, line, r);
    if (csv) {
        cost_write_csv(r, iso_output_stream(csv));
        result = worse(result, finish(ctx, iso_output_close(ctx, csv, true)));
    }
    if (o->plot && cost_count(r->cost, iso_cost_is_measured) > 0)
        result = worse(result, finish(ctx, draw(ctx, o, line, r)));
    else if (o->plot)
        complain("no picture: nothing has been measured");
    free(line);
    return result;
}

/* What is wrong with the options is said before the work. */
static iso_status prepare(iso_context *ctx, const options *o, iso_scene *scene, iso_output **csv)
{
    if (o->csv && strcmp(o->csv, "-") == 0 && (o->json || !isnan(o->want)))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "csv",
                                "cost: standard output has room for one: --csv -, --json or --want");
    if (o->horizons > 0 && !o->json && (!isnan(o->want) || (o->csv && strcmp(o->csv, "-") == 0)))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "horizons",
                                "cost: --want and --csv - leave no room for what --horizons tells");
    iso_status status = scene_with_options(ctx, o, scene);
    if (status == ISO_OK && o->plot) status = iso_plot_check_format(ctx, o->plot);
    if (status == ISO_OK && o->csv) status = iso_output_open(ctx, o->csv, csv);
    return status;
}

static int run(iso_context *ctx, const options *o)
{
    iso_scene scene = {.places = 0};
    iso_output *csv = NULL;
    iso_cost *cost = NULL;
    iso_status status = prepare(ctx, o, &scene, &csv);
    const iso_cost_options how = options_of(o);
    stop_gently();
    iso_context_watch(ctx, go_on, NULL);
    if (status == ISO_OK) status = iso_cost_measure(ctx, &scene, &how, &cost);
    int result = finish_scene(ctx, o, &scene, status);
    const int measured = cost ? cost_count(cost, iso_cost_is_measured) : 0;
    if (status == ISO_STOPPED && cost)
        complain("interrupted: %d of %d cells", measured, cost->cells);
    else if (status == ISO_STOPPED)
        complain("interrupted: nothing has been measured");
    if (measured > 0 || status == ISO_OK) {
        cost_report r = {.scene = &scene, .cost = cost, .want = o->want};
        result = worse(result, report(ctx, o, &r, csv));
        if (status == ISO_OK && interrupted()) {
            complain("interrupted: longer orbits are missing");
            result = worse(result, EXIT_SOME_FAILED);
        }
    } else {
        iso_output_close(ctx, csv, false);
    }
    iso_context_watch(ctx, NULL, NULL);
    iso_cost_free(cost);
    return result;
}

const command command_cost = {
    .name = "cost",
    .argument = "SCENE",
    .doc = "what accuracy costs in time: error against time by every backend, method and tolerance",
    .options = " backend method tol t-end quick want horizons plot csv json ",
    .more =
        "All backends, methods and tolerances are measured, whatever the scene names; --backend, --method and --tol\n"
        "restrict them. A cell is one of each. Its error is the largest relative error of (omega, n) at 20 times "
        "from the\n"
        "start to the end, against a reference that is none of the cells. Its time is processor time, the median of\n"
        "repeats, without set-up. --want X prints the cheapest choice as options of 'run':\n"
        "  isoroll run SCENE $(isoroll cost SCENE --want 1e-9)\n"
        "--horizons runs the best cell of each backend on orbits that are 2, 4, ... times as long, and says how "
        "error and\n"
        "time grow. After Ctrl-C, what has been measured is printed.",
    .run = run,
};
