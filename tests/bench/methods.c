/* bench_methods - time and error of every method on free balls.
 *
 *     bench_methods [--long] [METHOD...]
 *
 * The ball has J = (1.4, 2.1, 3.0), n = (0.36, 0.48, 0.8), w = (0.9, -0.3, w3), and five values of k in turn.
 * - A ball, A point: the ball's state at t = 1000, by the equations of the ball, and by those of the point.
 * - B point: the point's state at the s of that moment.
 *
 * How to read the output. Each k has two tables.
 * - First: a row for each method and tolerance. Largest error of the final state (relative to the length of its
 *   vector), milliseconds of processor time, and their ratio to rk8pd on the ball at the same tolerance.
 * - Second: a row for each method. Milliseconds for an error of 1e-6, 1e-9 and 1e-12 (interpolated between the
 *   tolerances), the ratios of these to rk8pd on the ball at the same error, and the least error. Compare these
 *   ratios: they carry over to other machines, about; milliseconds do not. "-": not reached in 300000 steps.
 *
 * A time is the median of passes over all methods in turn. Errors are against Taylor series in long double.
 * --long: instead, the ball's state at t = 1e6, k = -1, against the time that rk8pd takes for t = 1e5.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "map/state.h"
#include "method/integrator_impl.h"
#include "model/model_impl.h"

enum { GEOMETRIES = 5, LOOSEST = 6, TIGHTEST = 15, PASSES = 5, MOST_METHODS = 64, FORMS = 3 };

static const double geometries[GEOMETRIES] = {-1, 1, 0.5, 0.75, -0.4};
static const double J[3] = {1.4, 2.1, 3.0}, start[ISO_STATE] = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8};

/* What is integrated, and to where. */
typedef struct problem {
    const char *name;
    iso_model model;
    double start[ISO_STATE], end;
} problem;

typedef struct cell {
    double pass[PASSES], milliseconds, error; /* NaN: did not get there */
} cell;

/* One method on one problem, by digits of the tolerance. */
typedef struct table {
    const iso_method *method;
    const problem *problem;
    cell of[TIGHTEST + 1];
} table;

static void stop(const iso_context *ctx)
{
    fprintf(stderr, "bench_methods: %s\n", iso_context_message(ctx));
    exit(1);
}

/* --- problems --------------------------------------------------------------------------------------------------- */

static problem make_problem(iso_context *ctx, const char *name, double k, const iso_system *system, iso_clock clock)
{
    problem p = {.name = name};
    iso_problem equations = {0};
    if (iso_params_reduced(ctx, k, J, &equations.p) != ISO_OK) stop(ctx);
    memcpy(p.start, start, sizeof p.start);
    equations.energy = iso_ball_energy(&equations.p, start);
    if (system == &iso_system_point) {
        equations.eps = iso_coupling(&equations.p, equations.energy);
        equations.energy = 0;
        iso_ball_to_point(&equations.p, start, p.start);
    }
    p.model = iso_model_assemble(system, &equations, clock, (const bool[ISO_CLOCKS]){false, false, false});
    return p;
}

/* The end of one run, from the creation of the integrator on; false when it does not get there. */
static bool run(iso_context *ctx, const iso_method *m, const problem *p, double tolerance, double end, double y[])
{
    iso_integrator *it;
    const iso_method_options options = {.tolerance = tolerance, .max_steps = end > 1e4 ? 0 : 300000};
    if (iso_integrator_create(ctx, m, &p->model, &options, &it) != ISO_OK) return false;
    const bool done = iso_integrator_start(it, p->start) == ISO_OK && iso_integrator_at(it, end, y) == ISO_OK;
    iso_integrator_free(it);
    return done;
}

/* The ball at time `end`, and the point's time then, by the most exact method there is. */
static void solve(iso_context *ctx, double k, double end, double ball[], double *s)
{
    problem p = make_problem(ctx, "", k, &iso_system_ball, ISO_CLOCK_T);
    double y[ISO_MAX_STATE];
    p.model = iso_model_assemble(&iso_system_ball, &p.model.problem, ISO_CLOCK_T,
                                 (const bool[ISO_CLOCKS]){false, false, true});
    double with_clock[ISO_MAX_STATE];
    iso_model_begin(&p.model, p.start, with_clock);
    iso_integrator *it;
    const iso_method_options options = {.tolerance = 1e-15};
    if (iso_integrator_create(ctx, iso_method_find("taylor_extended"), &p.model, &options, &it) != ISO_OK ||
        iso_integrator_start(it, with_clock) != ISO_OK || iso_integrator_at(it, end, y) != ISO_OK)
        stop(ctx);
    memcpy(ball, y, ISO_STATE * sizeof *ball);
    *s = y[ISO_STATE];
    iso_integrator_free(it);
}

/* Largest error of the ball's state that y means, in units of the sizes of its vectors. */
static double error_of(const problem *p, const double y[], const double reference[])
{
    double ball[ISO_STATE], worst = 0;
    memcpy(ball, y, sizeof ball);
    if (p->model.system == &iso_system_point) iso_point_to_ball(&p->model.problem.p, y, ball);
    const double speed =
        sqrt(reference[0] * reference[0] + reference[1] * reference[1] + reference[2] * reference[2]);
    for (int i = 0; i < ISO_STATE; i++) worst = fmax(worst, fabs(ball[i] - reference[i]) / (i < 3 ? speed : 1));
    return worst;
}

/* --- measuring -------------------------------------------------------------------------------------------------- */

static void measure(iso_context *ctx, table *t, int digits, int pass, const double reference[])
{
    cell *c = &t->of[digits];
    double y[ISO_MAX_STATE];
    if (pass == 0 && digits > LOOSEST)
        c->error = isnan(t->of[digits - 1].error) ? NAN : 0; /* tighter ones fail too */
    if (isnan(c->error)) return;
    const double begin = bench_milliseconds();
    const bool done = run(ctx, t->method, t->problem, pow(10, -digits), t->problem->end, y);
    c->pass[pass] = bench_milliseconds() - begin;
    c->error = done ? error_of(t->problem, y, reference) : NAN;
}

static void take_median(cell *c)
{
    bench_sort(c->pass, PASSES);
    c->milliseconds = isnan(c->error) ? NAN : c->pass[PASSES / 2];
}

/* Time for an error, between the two tolerances whose errors lie about it; NaN when there are none. */
static double time_for(const table *t, double error)
{
    for (int d = LOOSEST; d < TIGHTEST; d++) {
        const cell a = t->of[d], b = t->of[d + 1];
        if (d == LOOSEST && a.error < error) return a.milliseconds;
        if (!(a.error >= error && b.error <= error && b.error > 0)) continue;
        const double share = a.error > b.error ? log(a.error / error) / log(a.error / b.error) : 0;
        return a.milliseconds * pow(b.milliseconds / a.milliseconds, share);
    }
    return NAN;
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

static void print_number(const char *format, double x)
{
    char text[32];
    snprintf(text, sizeof text, format, x);
    printf("%9s", isnan(x) ? "-" : text);
}

static void print_first_table(const table *t, const table *rk8pd)
{
    for (int d = LOOSEST; d <= TIGHTEST; d++) {
        printf("%-22s %-8s 1e-%02d", t->method->name, t->problem->name, d);
        print_number("%.1e", t->of[d].error);
        print_number("%.3f", t->of[d].milliseconds);
        print_number("%.3f", t->of[d].milliseconds / rk8pd->of[d].milliseconds);
        putchar('\n');
    }
}

static void print_second_table(const table tables[], int count, const table *rk8pd)
{
    printf("\n%-22s %-8s%9s%9s%9s%9s%9s%9s%9s\n", "method", "problem", "1e-6", "1e-9", "1e-12", "/rk8pd", "/rk8pd",
           "/rk8pd", "best");
    for (int i = 0; i < count; i++) {
        double best = INFINITY;
        for (int d = LOOSEST; d <= TIGHTEST; d++) best = fmin(best, tables[i].of[d].error);
        printf("%-22s %-8s", tables[i].method->name, tables[i].problem->name);
        for (int d = 6; d <= 12; d += 3) print_number("%.3f", time_for(&tables[i], pow(10, -d)));
        for (int d = 6; d <= 12; d += 3)
            print_number("%.3f", time_for(&tables[i], pow(10, -d)) / time_for(rk8pd, pow(10, -d)));
        print_number("%.1e", best);
        putchar('\n');
    }
    putchar('\n');
    fflush(stdout);
}

static void bench(iso_context *ctx, double k, const iso_method *const methods[], int count)
{
    static table tables[1 + FORMS * MOST_METHODS];
    double reference[ISO_STATE], s;
    solve(ctx, k, 1000, reference, &s);
    problem problems[FORMS] = {make_problem(ctx, "A ball", k, &iso_system_ball, ISO_CLOCK_T),
                               make_problem(ctx, "A point", k, &iso_system_point, ISO_CLOCK_T),
                               make_problem(ctx, "B point", k, &iso_system_point, ISO_CLOCK_S)};
    problems[0].end = problems[1].end = 1000;
    problems[2].end = s;
    int made = 0;
    memset(tables, 0, sizeof tables);
    tables[made++] = (table){.method = iso_method_find("rk8pd"), .problem = &problems[0]};
    for (int i = 0; i < count; i++)
        for (int form = 0; form < FORMS; form++)
            if (!methods[i]->system || methods[i]->system == problems[form].model.system)
                tables[made++] = (table){.method = methods[i], .problem = &problems[form]};
    for (int pass = 0; pass < PASSES; pass++)
        for (int d = LOOSEST; d <= TIGHTEST; d++)
            for (int i = 0; i < made; i++) measure(ctx, &tables[i], d, pass, reference);
    for (int i = 0; i < made; i++)
        for (int d = LOOSEST; d <= TIGHTEST; d++) take_median(&tables[i].of[d]);

    printf("k = %g\n%-22s %-8s%5s%9s%9s%9s\n", k, "method", "problem", "tol", "error", "ms", "/rk8pd");
    for (int i = 0; i < made; i++) print_first_table(&tables[i], &tables[0]);
    print_second_table(tables, made, &tables[0]);
}

/* --- long runs -------------------------------------------------------------------------------------------------- */

static void bench_long(iso_context *ctx, const iso_method *const methods[], int count)
{
    double reference[ISO_STATE], y[ISO_MAX_STATE], s;
    const problem ball = make_problem(ctx, "ball", -1, &iso_system_ball, ISO_CLOCK_T);
    const problem point = make_problem(ctx, "point", -1, &iso_system_point, ISO_CLOCK_T);
    solve(ctx, -1, 1e6, reference, &s);
    double begin = bench_milliseconds();
    run(ctx, iso_method_find("rk8pd"), &ball, 1e-13, 1e5, y);
    const double unit = bench_milliseconds() - begin;
    printf("%-22s %-8s%5s%9s%9s%9s   (rk8pd, t = 1e5: %.0f ms)\n", "t = 1e6", "problem", "tol", "error", "ms",
           "/rk8pd", unit);
    for (int i = 0; i < count; i++)
        for (const problem *p = &ball; p; p = p == &ball ? &point : NULL) {
            if (methods[i]->system && methods[i]->system != p->model.system) continue;
            for (int d = 12; d <= 15; d++) {
                begin = bench_milliseconds();
                const bool done = run(ctx, methods[i], p, pow(10, -d), 1e6, y);
                const double took = bench_milliseconds() - begin;
                printf("%-22s %-8s 1e-%02d", methods[i]->name, p->name, d);
                print_number("%.1e", done ? error_of(p, y, reference) : NAN);
                print_number("%.0f", took);
                print_number("%.2f", took / unit);
                putchar('\n');
                fflush(stdout);
            }
        }
}

int main(int argc, char **argv)
{
    const iso_method *methods[MOST_METHODS];
    int count = 0;
    const bool is_long = argc > 1 && strcmp(argv[1], "--long") == 0;
    iso_context *ctx = iso_context_create();
    for (int i = 1 + is_long; i < argc && count < MOST_METHODS; i++) {
        methods[count] = iso_method_find(argv[i]);
        if (!methods[count++])
            return fprintf(stderr, "bench_methods: no method, or several, are called '%s'\n", argv[i]), 2;
    }
    for (int i = 0; argc == 1 + is_long && iso_methods[i] && count < MOST_METHODS; i++)
        methods[count++] = iso_methods[i];
    if (is_long) bench_long(ctx, methods, count);
    for (int i = 0; !is_long && i < GEOMETRIES; i++) bench(ctx, geometries[i], methods, count);
    iso_context_free(ctx);
    return 0;
}
