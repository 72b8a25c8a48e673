/* isoroll plot - draws a trajectory: paths on the spheres, drift of integrals, clocks. */
#include <stdio.h>
#include <string.h>

#include "io/plot.h"
#include "parameters.h"
#include "study/check.h"
#include "sweep_plot.h"

/* What plot can be told. */
typedef struct options {
    file_options from;
    const char *output, *value; /* value NULL: not given */
} options;

/* What is drawn: the file, its conversion, and numbers from both. */
typedef struct parts {
    iso_record *file, *twin, *drifts, *clocks;
} parts;

/* The model of the file; the ball if it has both. */
static iso_model_kind model_of(const iso_record *record)
{
    return iso_record_find(record, "n1") >= 0 && iso_record_find(record, "omega1") >= 0 ? ISO_BALL : ISO_POINT;
}

/* Puts the file's clock and the other model's clock side by side. The other one comes from the file or from its
 * twin. */
static iso_status pair_clocks(iso_context *ctx, parts *p)
{
    const iso_model_kind model = model_of(p->file);
    const char *names[] = {model == ISO_BALL ? "t" : "s", model == ISO_BALL ? "s" : "t"};
    const int own = iso_record_find(p->file, names[0]), here = iso_record_find(p->file, names[1]);
    const int there = p->twin ? iso_record_find(p->twin, names[1]) : -1;
    if (own < 0 || (here < 0 && there < 0)) return ISO_OK;
    iso_status status = iso_record_create(ctx, 2, names, &p->clocks);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(p->file); i++) {
        double *row;
        status = iso_record_append(ctx, p->clocks, &row);
        if (status != ISO_OK) break;
        row[0] = iso_record_const_row(p->file, i)[own];
        row[1] = here >= 0 ? iso_record_const_row(p->file, i)[here] : iso_record_const_row(p->twin, i)[there];
    }
    return status;
}

/* Converts the file. A ball at rest, or with effects that break the isomorphism, has no twin and is drawn alone. */
static iso_status find_twin(iso_context *ctx, const iso_params *params, parts *p)
{
    if (iso_record_find(p->file, "n1") >= 0 && iso_record_find(p->file, "gamma1") >= 0) return ISO_OK;
    const iso_model_kind to = model_of(p->file) == ISO_BALL ? ISO_POINT : ISO_BALL;
    const iso_status status = iso_convert(ctx, params, p->file, to, 1e-12, &p->twin);
    if (status != ISO_NOT_MAPPED) return status;
    complain("%s is drawn alone: %s", to == ISO_POINT ? "the ball" : "the point", iso_context_message(ctx));
    return ISO_OK;
}

static iso_status draw(iso_context *ctx, const options *o, const iso_params *params, parts *p)
{
    char title[160];
    iso_status status = find_twin(ctx, params, p);
    if (status == ISO_OK) status = pair_clocks(ctx, p);
    if (status == ISO_OK) status = iso_check_drifts(ctx, params, p->file, &p->drifts);
    if (status != ISO_OK) return status;
    const bool ball = iso_record_find(p->file, "n1") >= 0, point = iso_record_find(p->file, "gamma1") >= 0;
    const char *name = strrchr(o->from.file, '/') ? strrchr(o->from.file, '/') + 1 : o->from.file;
    snprintf(title, sizeof title, "%.60s: k = %.6g, J = %.6g, %.6g, %.6g, %zu rows",
             strcmp(o->from.file, "-") == 0 ? "<stdin>" : name, params->k, params->J[0], params->J[1], params->J[2],
             iso_record_rows(p->file));
    const iso_plot_orbit plot = {.title = title,
                                 .ball = ball ? p->file : p->twin,
                                 .point = point ? p->file : p->twin,
                                 .drift = p->drifts,
                                 .clocks = p->clocks};
    return iso_plot_trajectory(ctx, o->output, &plot);
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    parts p = {NULL, NULL, NULL, NULL};
    iso_params params;
    if (strcmp(o->output, "-") == 0)
        return complain("plot: -o FILE is missing: name a file that ends in .svg, .png or .pdf"), EXIT_USAGE;
    iso_status status = iso_plot_check_format(ctx, o->output);
    if (status == ISO_OK && is_sweep_result(o->from.file))
        return finish(ctx, plot_sweep(ctx, o->from.file, o->value, o->output));
    if (status == ISO_OK && o->value)
        status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, "value", "plot: --value is for results of sweeps");
    if (status == ISO_OK) status = iso_trajectory_read(ctx, o->from.file, o->from.columns, &p.file);
    if (status == ISO_OK) status = parameters_of_file(ctx, &o->from, p.file, &params);
    if (status == ISO_OK) status = draw(ctx, o, &params, &p);
    if (status != ISO_OK && status != ISO_BAD_ARGUMENT && status != ISO_FILE_TROUBLE)
        status = name_the_file(ctx, o->from.file, status);
    iso_record_free(p.file);
    iso_record_free(p.twin);
    iso_record_free(p.drifts);
    iso_record_free(p.clocks);
    return finish(ctx, status);
}

static const options defaults = {.from = FILE_OPTIONS_UNSET, .output = "-"};

static const option_row rows[] = {
    ROW_OF_FILE("output", "FILE", "a file", "the picture: .svg, .png or .pdf", set_text, options, output, 'o',
                OPTION_WRITES),
    ROW("value", "NAME", "a name", "of a sweep: which column is drawn, such as splitting_m", set_text, options,
        value),
    ROWS_OF_FILE(options, from),
    ROW_END,
};

const command command_plot = {
    .name = "plot",
    .argument = "[FILE]",
    .doc = "draw a trajectory, or the result of a sweep",
    .rows = rows,
    .defaults = &defaults,
    .size = sizeof defaults,
    .file = offsetof(options, from.file),
    .description = "-o FILE is needed; its ending chooses the format. The path and the clock of the other model are "
                   "computed, where the orbit has a twin. gnuplot draws the picture.\n\n"
                   "Of a sweep: a value over the number that varies, as a curve with its error; over two numbers, as "
                   "a map; over J, as a map of J1/J3 and J2/J3 where J1 < J2 < J3. Further numbers that vary make "
                   "several maps. k = 1 and k = -1 are marked.",
    .example = "isoroll plot trajectory.csv -o trajectory.svg",
    .run = run,
};
