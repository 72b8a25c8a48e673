/* isoroll compare - the same orbit by both backends: table, picture, JSON. */
#include <jansson.h>
#include <math.h>

#include "command.h"

static const char *backend_name(int b)
{
    return iso_picture_name(b);
}

/* --- the table ----------------------------------------------------------------------------------------------------- */

static void print_head(const iso_scene *scene, const iso_comparison *c)
{
    const iso_params *p = &scene->params;
    printf("k = %.10g (%s), J = %.10g %.10g %.10g\nh = %.10g, eps = %.10g, tolerance %g\n\n", p->k,
           iso_surface_name((int)p->body.surface), p->J[0], p->J[1], p->J[2], c->h, c->eps, scene->tolerance);
    print_effects(&c->effects, false);
    for (int b = 0; b < ISO_BACKENDS; b++) {
        const iso_backend_run *r = &c->run[b];
        if (!r->method) continue;
        printf("backend %-5s  %s: %ld steps, %ld rejected, %ld right-hand sides, %.3g ms\n", backend_name(b),
               r->method->name, r->statistics.steps, r->statistics.rejected, r->statistics.rhs, 1e3 * r->seconds);
    }
}

/* The rows shown: `shown` of them, evenly spaced, first and last among them. */
static size_t shown_row(size_t i, size_t shown, size_t rows)
{
    return shown < 2 ? rows - 1 : i * (rows - 1) / (shown - 1);
}

/* One model's six numbers by both backends, with the larger of the differences of its two vectors. */
static void print_model(const iso_comparison *c, iso_picture model, size_t shown, size_t rows)
{
    static const char *const titles[] = {"the ball", "the point"};
    const int first = model == ISO_BALL ? ISO_COLUMN_BALL : ISO_COLUMN_POINT, difference = model == ISO_BALL ? 1 : 3;
    const int clock = model == ISO_BALL ? 0 : 2;
    printf("\n%s\n%12s  %-7s", titles[model], iso_clock_name((iso_clock)clock), "backend");
    for (int i = 0; i < ISO_STATE; i++) printf(" %13s", iso_trajectory_columns[first + i]);
    printf("  difference\n");
    for (size_t i = 0; i < shown; i++) {
        const size_t row = shown_row(i, shown, rows);
        const double *d = iso_record_const_row(c->difference, row);
        for (int b = 0; b < ISO_BACKENDS; b++) {
            const double *x = iso_record_const_row(c->run[b].trajectory, row);
            printf("%12.6g  %-7s", x[clock], backend_name(b));
            for (int j = 0; j < ISO_STATE; j++) printf(" %13.9g", x[first + j]);
            if (b == ISO_POINT) printf("  %8.1e", fmax(d[difference], d[difference + 1]));
            printf("\n");
        }
    }
}

static void print_clocks(const iso_comparison *c, size_t shown, size_t rows)
{
    printf("\nclocks\n%-7s", "backend");
    for (int k = 0; k < ISO_CLOCKS; k++) printf(" %22s", iso_clock_name((iso_clock)k));
    printf("\n");
    for (size_t i = 0; i < shown; i++)
        for (int b = 0; b < ISO_BACKENDS; b++) {
            const double *x = iso_record_const_row(c->run[b].trajectory, shown_row(i, shown, rows));
            printf("%-7s %22.16g %22.16g %22.16g\n", backend_name(b), x[0], x[1], x[2]);
        }
}

static void print_integrals(const iso_comparison *c)
{
    printf("\nintegrals: value at the start, largest relative drift by each backend\n");
    for (int i = 0; i < c->run[ISO_BALL].drifts; i++) {
        const iso_drift *d = &c->run[ISO_BALL].drift[i];
        printf("  %-5s %-10s %20.12g", d->system->name, d->integral->name, d->start);
        for (int b = 0; b < ISO_BACKENDS; b++)
            if (i < c->run[b].drifts) printf("  %s %8.1e", backend_name(b), c->run[b].drift[i].worst);
        printf("   %s\n", d->integral->doc);
    }
}

static void print_table(const iso_scene *scene, const options *o, const iso_comparison *c)
{
    const size_t rows = iso_record_rows(c->difference), wanted = (size_t)fmin(o->rows, 1e9);
    const size_t shown = wanted < rows ? wanted : rows;
    print_head(scene, c);
    print_model(c, ISO_BALL, shown, rows);
    print_model(c, ISO_POINT, shown, rows);
    print_clocks(c, shown, rows);
    print_integrals(c);
    printf("\nlargest relative difference of the backends over %zu rows\n ", rows);
    for (size_t i = 1; i < ISO_DIFFERENCES; i++)
        printf(" %s %.1e%s", iso_record_name(c->difference, i), c->worst[i], i + 1 < ISO_DIFFERENCES ? "," : "\n");
}

/* --- JSON ---------------------------------------------------------------------------------------------------------- */

/* JSON has no infinity: what overflows in the user's units is null. */
static json_t *number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

static json_t *columns_of(const iso_record *r)
{
    json_t *o = json_object();
    for (size_t c = 0; c < iso_record_columns(r); c++) {
        json_t *column = json_array();
        for (size_t i = 0; i < iso_record_rows(r); i++)
            json_array_append_new(column, number(iso_record_const_row(r, i)[c]));
        json_object_set_new(o, iso_record_name(r, c), column);
    }
    return o;
}

static json_t *backend_of(const iso_backend_run *r)
{
    json_t *integrals = json_array();
    for (int i = 0; i < r->drifts; i++) {
        const iso_drift *d = &r->drift[i];
        json_array_append_new(integrals, json_pack("{s:s, s:s, s:s, s:o, s:o}", "system", d->system->name, "name",
                                                   d->integral->name, "doc", d->integral->doc, "start",
                                                   number(d->start), "drift", number(d->worst)));
    }
    return json_pack("{s:s, s:I, s:I, s:I, s:o, s:o, s:o, s:o}", "method", r->method ? r->method->name : "", "steps",
                     (json_int_t)r->statistics.steps, "rejected", (json_int_t)r->statistics.rejected,
                     "right_hand_sides", (json_int_t)r->statistics.rhs, "correction",
                     number(r->statistics.correction), "seconds", number(r->seconds), "integrals", integrals,
                     "trajectory", columns_of(r->trajectory));
}

static json_t *effects_of(const iso_effects *effects)
{
    json_t *o = json_object();
    for (int e = 0; e < ISO_EFFECTS; e++) {
        if (!effects->on[e]) continue;
        json_t *numbers = json_object();
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; n && n->name; n++) {
            const double *x = iso_effect_values(effects, n);
            json_t *list = json_array();
            for (int i = 0; i < n->count; i++) json_array_append_new(list, number(x[i]));
            json_object_set_new(numbers, n->name, list);
        }
        json_object_set_new(o, iso_effect_list[e]->name, numbers);
    }
    return o;
}

/* False: no memory. A full disk is found when the output is flushed. */
static bool print_json(const iso_scene *scene, const iso_comparison *c)
{
    const iso_params *p = &scene->params;
    json_t *worst = json_object();
    for (size_t i = 1; i < ISO_DIFFERENCES; i++)
        json_object_set_new(worst, iso_record_name(c->difference, i), number(c->worst[i]));
    json_t *o =
        json_pack("{s:s, s:o, s:[o,o,o], s:o, s:o, s:o, s:o, s:s, s:o, s:o, s:{s:o, s:o}}", "isoroll", ISO_VERSION,
                  "k", number(p->k), "J", number(p->J[0]), number(p->J[1]), number(p->J[2]), "h", number(c->h), "eps",
                  number(c->eps), "effects", effects_of(&c->effects), "tolerance", number(scene->tolerance), "clock",
                  iso_clock_name(c->clock), "worst_difference", worst, "difference", columns_of(c->difference),
                  "backends", "ball", backend_of(&c->run[ISO_BALL]), "point", backend_of(&c->run[ISO_POINT]));
    if (!o) return complain("out of memory"), false;
    json_dumpf(o, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(17));
    printf("\n");
    json_decref(o);
    return true;
}

/* --- the command --------------------------------------------------------------------------------------------------- */

static bool show(double part, void *data)
{
    (void)data;
    progress_show(part);
    return true;
}

static bool go_on(void *data)
{
    (void)data;
    return !interrupted();
}

static iso_status draw(iso_context *ctx, const options *o, const iso_scene *scene, const iso_comparison *c)
{
    char title[128];
    snprintf(title, sizeof title, "k = %.6g, J = %.6g %.6g %.6g", scene->params.k, scene->params.J[0],
             scene->params.J[1], scene->params.J[2]);
    const iso_plot plot = {.title = title,
                           .tolerance = scene->tolerance,
                           .ball = c->run[ISO_BALL].trajectory,
                           .point = c->run[ISO_POINT].trajectory,
                           .difference = c->difference};
    return iso_plot_comparison(ctx, o->plot, &plot);
}

static int run(iso_context *ctx, const options *o)
{
    iso_scene scene = {.places = 0};
    iso_comparison *c = NULL;
    iso_status status = scene_with_options(ctx, o, &scene);
    if (status == ISO_OK && o->plot) status = iso_plot_check_format(ctx, o->plot);
    stop_gently();
    iso_context_watch(ctx, go_on, NULL);
    if (status == ISO_OK) status = iso_compare(ctx, &scene, show, NULL, &c);
    iso_context_watch(ctx, NULL, NULL);
    int result = finish_scene(ctx, o, &scene, status);
    progress_end();
    if (!c) return result;
    for (int e = ISO_ATTITUDE; e <= ISO_REACTIONS; e++)
        if (scene.effects.on[e]) complain("'%s' acts on nothing and is not compared", iso_effect_list[e]->name);
    if (status == ISO_STOPPED)
        complain("interrupted: %zu of %zu rows", iso_record_rows(c->difference), iso_scene_rows(&scene));
    if (o->json) {
        if (!print_json(&scene, c)) result = EXIT_NUMERICAL;
    } else if (iso_record_rows(c->difference) > 0) {
        print_table(&scene, o, c);
    }
    if (o->plot && iso_record_rows(c->difference) > 0) {
        const int drawn = finish(ctx, draw(ctx, o, &scene, c));
        if (result == EXIT_DONE) result = drawn;
    }
    iso_comparison_free(c);
    return result;
}

const command command_compare = {
    .name = "compare",
    .argument = "SCENE",
    .doc = "the same orbit by both backends, side by side: states, clocks, integrals",
    .options = " method tol t-end step rows plot json ",
    .more = "Differences are relative to the size of the vector (clocks: to the largest value).",
    .run = run,
};
