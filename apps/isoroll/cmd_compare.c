/* isoroll compare - computes one orbit by every backend and shows the differences: table, picture, JSON. */
#include <math.h>

#include "base/number_impl.h"
#include "model/effects/effects_impl.h"
#include "picture/stretch_impl.h"
#include "plot/draw.h"
#include "terminal.h"
#include "shell.h"
#include "task/task_impl.h"

/* What compare can be told. */
typedef struct options {
    iso_scene_request study;
    shell_options shell;
    double rows;
} options;

static const char *backend_name(const iso_comparison *c, int run)
{
    return iso_backend_name((int)c->run[run].backend);
}

/* --- the table -------------------------------------------------------------------------------------------------- */

static void print_head(const iso_scene *scene, const iso_comparison *c)
{
    iso_params_print(say_to(), &scene->params);
    say(" (%s)\nh = %s, eps = %s, tolerance %s\n\n", iso_surface_name((int)scene->params.body.surface),
        ISO_ROUNDED(c->h, 10), ISO_ROUNDED(c->eps, 10), ISO_SHORT(scene->tolerance));
    iso_effects_print(say_to(), &c->effects, false);
    for (int b = 0; b < ISO_INTEGRATED; b++) {
        const iso_backend_run *r = &c->run[b];
        say("backend %-5s  %s: %ld steps, %ld rejected, %ld right-hand sides, %.3g ms\n", backend_name(c, b),
            r->method->name, r->statistics.steps, r->statistics.rejected, r->statistics.rhs, 1e3 * r->seconds);
    }
    if (c->runs == ISO_BACKENDS)
        say("backend exact  the closed solution: %ld states, %.3g ms\n", c->run[ISO_BY_EXACT].statistics.states,
            1e3 * c->run[ISO_BY_EXACT].seconds);
    else
        say("exact: %s\n", c->no_exact);
}

/* Which of the rows is the i-th that is shown: `shown` rows, evenly spaced, with the first and the last. */
static size_t shown_row(size_t i, size_t shown, size_t rows)
{
    return shown < 2 ? rows - 1 : i * (rows - 1) / (shown - 1);
}

/* The larger difference of a model's two vectors in a row. Run `point`: from the ball. Run `exact`: from the ball
 * or the point, whichever is larger. */
static double row_difference(const iso_comparison *c, int run, iso_model_kind model, size_t row)
{
    const int first = model == ISO_BALL ? 1 : 3;
    double most = 0;
    for (int b = 0; b < ISO_INTEGRATED; b++) {
        const double *d = iso_record_const_row(run == ISO_BY_EXACT ? c->from_exact[b] : c->difference, row);
        most = fmax(most, fmax(d[first], d[first + 1]));
    }
    return most;
}

/* Prints one model's six numbers by every backend, each with its difference from the backends above it. */
static void print_model(const iso_comparison *c, iso_model_kind model, size_t shown, size_t rows)
{
    static const char *const titles[] = {"the ball", "the point"};
    const int first = model == ISO_BALL ? ISO_COLUMN_BALL : ISO_COLUMN_POINT;
    const int clock = model == ISO_BALL ? 0 : 2;
    say("\n%s\n", titles[model]);
    say_table(2);
    say("%s\tbackend", iso_clock_name((iso_clock)clock));
    for (int i = 0; i < ISO_STATE; i++) say("\t%s", iso_column_name(first + i));
    say("\tdifference\n");
    for (size_t i = 0; i < shown; i++) {
        const size_t row = shown_row(i, shown, rows);
        for (int b = 0; b < c->runs; b++) {
            const double *x = iso_record_const_row(c->run[b].trajectory, row);
            say("%.6g\t%s", x[clock], backend_name(c, b));
            for (int j = 0; j < ISO_STATE; j++) say("\t%.9g", x[first + j] + 0.0);
            if (b > 0) say("\t%.1e", row_difference(c, b, model, row));
            say(b > 0 ? "\n" : "\t\n");
        }
    }
    say_table_end();
}

static void print_clocks(const iso_comparison *c, size_t shown, size_t rows)
{
    say("\nclocks\n");
    say_table(1);
    say("backend");
    for (int k = 0; k < ISO_CLOCKS; k++) say("\t%s", iso_clock_name((iso_clock)k));
    say("\n");
    for (size_t i = 0; i < shown; i++)
        for (int b = 0; b < c->runs; b++) {
            const double *x = iso_record_const_row(c->run[b].trajectory, shown_row(i, shown, rows));
            say("%s\t%.15g\t%.15g\t%.15g\n", backend_name(c, b), x[0], x[1], x[2]);
        }
    say_table_end();
}

static void print_integrals(const iso_comparison *c)
{
    say("\nintegrals: value at the start, largest relative drift by each backend\n");
    say_table(2);
    say("of\tname\tstart");
    for (int b = 0; b < c->runs; b++) say("\t%s", backend_name(c, b));
    say("\twhat it is\n");
    for (int i = 0; i < c->run[ISO_BALL].drifts; i++) {
        const iso_drift *d = &c->run[ISO_BALL].drift[i];
        say("%s\t%s\t%.9g", d->system->name, d->integral->name, d->start);
        for (int b = 0; b < c->runs; b++)
            if (i < c->run[b].drifts)
                say("\t%.1e", c->run[b].drift[i].worst);
            else
                say("\t-");
        say("\t%s\n", d->integral->doc);
    }
    say_table_end();
}

static void print_worst(const char *who, const double worst[ISO_DIFFERENCES])
{
    say("%s", who);
    for (size_t i = 1; i < ISO_DIFFERENCES; i++) say("\t%.1e", worst[i]);
    say("\n");
}

static void print_differences(const iso_comparison *c, size_t rows)
{
    say("\nlargest relative differences over %zu rows\n", rows);
    say_table(1);
    say("between");
    for (size_t i = 1; i < ISO_DIFFERENCES; i++) say("\t%s", iso_record_name(c->difference, i));
    say("\n");
    print_worst("ball, point", c->worst);
    if (c->runs == ISO_BACKENDS) {
        print_worst("ball, exact", c->worst_from_exact[ISO_BALL]);
        print_worst("point, exact", c->worst_from_exact[ISO_POINT]);
    }
    say_table_end();
}

static void print_table(const shell *s)
{
    const iso_comparison *c = s->result.found;
    const size_t rows = iso_record_rows(c->difference),
                 wanted = (size_t)fmin(((const options *)s->options)->rows, 1e9);
    const size_t shown = wanted < rows ? wanted : rows;
    char words[ISO_COMPARISON_WORDS];
    if (rows == 0) return;
    print_head(&s->scene, c);
    print_model(c, ISO_BALL, shown, rows);
    print_model(c, ISO_POINT, shown, rows);
    print_clocks(c, shown, rows);
    print_integrals(c);
    print_differences(c, rows);
    double worst;
    iso_comparison_words(&s->scene, c, &worst, words);
    say("\n%s\n", words);
}

/* --- JSON ------------------------------------------------------------------------------------------------------- */

static json_t *json(const shell *s)
{
    const iso_comparison *c = s->result.found;
    json_t *o = json_of_scene(&s->scene, s->result.fields, c);
    json_put(o, "tolerance", json_number(s->scene.tolerance));
    json_put(o, "effects", json_effects(&c->effects, false));
    return o;
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

static void tell_result(const iso_scene *scene, const iso_comparison *c, char text[], size_t size)
{
    char words[ISO_COMPARISON_WORDS];
    double worst;
    const bool same = iso_comparison_words(scene, c, &worst, words);
    snprintf(text, size, "%s %s %.1e",
             c->runs == ISO_BACKENDS
                 ? "three computations, by the ball's equations, the point's, and the closed solution,"
                 : "two computations, by the ball's equations and by the point's,",
             same ? "agree to" : "differ by", worst);
}

static int draw(const shell *s)
{
    char result[200];
    const iso_comparison *c = s->result.found;
    const size_t rows = iso_record_rows(c->difference);
    iso_record *curve, *states;
    if (rows == 0) return EXIT_DONE;
    const double end = iso_record_const_row(c->run[ISO_BALL].trajectory, rows - 1)[ISO_CLOCK_T];
    iso_status status = iso_picture_stretch(s->ctx, &s->scene, end, &states, &curve);
    tell_result(&s->scene, c, result, sizeof result);
    if (status == ISO_OK) status = iso_record_set(s->ctx, states, "result", result);
    if (status == ISO_OK)
        status = plot_tables(s->ctx, &s->told->plot, (const iso_record *[]){states, curve, NULL}, NULL);
    iso_record_free(curve);
    iso_record_free(states);
    return finish(s->ctx, status);
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static void complain_interrupted(const shell *s)
{
    const iso_comparison *c = s->result.found;
    if (c)
        complain("interrupted: %zu of %zu rows were compared", iso_record_rows(c->difference),
                 iso_scene_rows(&s->scene));
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts parts = {.study = &iso_compare_study,
                                      .change = shell_change,
                                      .interrupted = complain_interrupted,
                                      .json = json,
                                      .print = print_table,
                                      .draw = draw};
    return shell_run(ctx, &parts, options_given, &((const options *)options_given)->shell);
}

static const options defaults = {.shell = {.file = "-"}, .rows = 6};

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_compare_option),
    ROW("rows", "N", "a whole number from 1 on", "rows of the table to print (default 6)", iso_set_count, options,
        rows),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_compare = {
    COMMAND_OF_STUDY(compare, "SCENE", shell.file),
    .takes = FILE_SCENE,
    .description =
        "The backends are ball, point and, where there is a closed solution, exact. The table shows states, "
        "clocks and integrals by each of them. Differences of states are relative to the size of the "
        "vector, those of clocks to the largest value of the clock.",
    .example = "isoroll compare scene.yaml --plot orbit.svg",
};
