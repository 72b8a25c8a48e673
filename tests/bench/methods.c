/* bench_methods - time and error of every method on free balls, against those of other libraries.
 *
 *     bench_methods [METHOD...]
 *
 * The ball has J = (1.4, 2.1, 3.0), n = (0.36, 0.48, 0.8), w = (0.9, -0.3, w3), and five values of k in turn.
 * - A ball, A point: the ball's state at t = 1000, by the equations of the ball, and by those of the point in t.
 * - B point: the point's state at the s of that moment.
 *
 * Rivals (rivals/): GSL's rk8pd, CVODE's Adams, ARKODE's table of order 8, and Boost.odeint where it is found. Each
 * has a loop and equations of its own. All other rows are methods of isoroll; gsl, arkode and cvode among them are
 * the same libraries with our equations, units and projections.
 * The law: each rival comes within 1e-8 of the reference. Else the program fails and prints no speed. Speeds are
 * compared at equal errors, not at equal tolerances.
 *
 * How to read the output. Each k has two tables.
 * - First: a row for each method and tolerance. Largest error of the final state (relative to the length of its
 *   vector), and milliseconds of processor time.
 * - Second: a row for each method. Milliseconds for an error of 1e-6, 1e-9 and 1e-12 (interpolated between the
 *   tolerances); how many times faster than the fastest rival this is, at the same error of the same problem (A or
 *   B); and the least error. Compare these ratios: they carry over to other machines, about; milliseconds do not.
 *   "-": not reached in 300000 steps.
 *
 * A time is the median of passes over all methods in turn. Errors are against Taylor series in long double.
 */
#include "bench.h"
#include "map/state.h"
#include "method/integrator_impl.h"
#include "model/model_impl.h"
#include "rivals/rivals.h"

enum {
    GEOMETRIES = 5,
    LOOSEST = 6,
    TIGHTEST = 15,
    PASSES = 5,
    MOST_METHODS = 64,
    FORMS = 3,
    MOST_RIVALS = 8,
    T_END = 1000
};

static const double geometries[GEOMETRIES] = {-1, 1, 0.5, 0.75, -0.4};

/* What is integrated, and to where. */
typedef struct problem {
    const char *name;
    iso_model model;
    double start[ISO_STATE], end;
    rival_problem rivals; /* the same */
} problem;

typedef struct cell {
    double pass[PASSES], milliseconds, error; /* NaN: did not get there */
} cell;

/* One method or rival on one problem, by digits of the tolerance. */
typedef struct table {
    const iso_method *method;
    const rival *rival; /* or NULL */
    const problem *problem;
    cell of[TIGHTEST + 1];
} table;

/* --- problems --------------------------------------------------------------------------------------------------- */

static const char *name_of(const table *t)
{
    return t->rival ? t->rival->name : t->method->name;
}

static problem make_problem(iso_context *ctx, const char *name, double k, const iso_system *system, iso_clock clock)
{
    problem p = {.name = name};
    iso_problem equations = {.p = bench_params(ctx, k, bench_J)};
    memcpy(p.start, bench_state, sizeof p.start);
    equations.energy = iso_ball_energy(&equations.p, bench_state);
    if (system == &iso_system_point) {
        equations.eps = iso_coupling(&equations.p, equations.energy);
        equations.energy = 0;
        iso_ball_to_point(&equations.p, bench_state, p.start);
    }
    p.model = iso_model_assemble(system, &equations, clock, (const bool[ISO_CLOCKS]){false, false, false});
    p.rivals = (rival_problem){.point = system == &iso_system_point,
                               .in_t = clock == ISO_CLOCK_T,
                               .k = k,
                               .J = {bench_J[0], bench_J[1], bench_J[2]},
                               .eps = equations.eps};
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
    bench_must(ctx, iso_integrator_create(ctx, iso_method_find("taylor_extended"), &p.model, &options, &it));
    bench_must(ctx, iso_integrator_start(it, with_clock));
    bench_must(ctx, iso_integrator_at(it, end, y));
    memcpy(ball, y, ISO_STATE * sizeof *ball);
    *s = y[ISO_STATE];
    iso_integrator_free(it);
}

/* Largest error of the ball's state that y means, in units of the sizes of its vectors. */
static double error_of(const problem *p, const double y[], const double reference[])
{
    double ball[ISO_STATE];
    memcpy(ball, y, sizeof ball);
    if (p->model.system == &iso_system_point) iso_point_to_ball(&p->model.problem.p, y, ball);
    return bench_error(ball, reference);
}

/* --- measuring -------------------------------------------------------------------------------------------------- */

static void measure(iso_context *ctx, table *t, int digits, int pass, const double reference[])
{
    cell *c = &t->of[digits];
    double y[ISO_MAX_STATE];
    if (pass == 0 && digits > LOOSEST)
        c->error = isnan(t->of[digits - 1].error) ? NAN : 0; /* tighter ones fail too */
    if (isnan(c->error)) return;
    const double tolerance = pow(10, -digits), end = t->problem->end, begin = bench_milliseconds();
    memcpy(y, t->problem->start, sizeof t->problem->start);
    const bool done = t->rival ? t->rival->solve(&t->problem->rivals, tolerance, end, y)
                               : run(ctx, t->method, t->problem, tolerance, end, y);
    c->pass[pass] = bench_milliseconds() - begin;
    c->error = done ? error_of(t->problem, y, reference) : NAN;
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

static double best_error(const table *t)
{
    double best = INFINITY;
    for (int d = LOOSEST; d <= TIGHTEST; d++) best = fmin(best, t->of[d].error);
    return best;
}

/* The fastest rival's time for an error on the same problem, A or B. */
static double rival_time_for(const table tables[], int count, const problem *p, double error)
{
    double least = NAN;
    for (int i = 0; i < count; i++)
        if (tables[i].rival && tables[i].problem->name[0] == p->name[0])
            least = fmin(least, time_for(&tables[i], error));
    return least;
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

static void print_number(const char *format, double x)
{
    char text[32];
    snprintf(text, sizeof text, format, x);
    printf("%9s", isnan(x) ? "-" : text);
}

static void print_first_table(const table *t)
{
    for (int d = LOOSEST; d <= TIGHTEST; d++) {
        printf("%-22s %-8s 1e-%02d", name_of(t), t->problem->name, d);
        print_number("%.1e", t->of[d].error);
        print_number("%.3f", t->of[d].milliseconds);
        putchar('\n');
    }
}

static void print_second_table(const table tables[], int count)
{
    printf("\n%-22s %-8s%9s%9s%9s%9s%9s%9s%9s\n", "method", "problem", "1e-6", "1e-9", "1e-12", "ratio", "ratio",
           "ratio", "best");
    for (int i = 0; i < count; i++) {
        const table *t = &tables[i];
        printf("%-22s %-8s", name_of(t), t->problem->name);
        for (int d = 6; d <= 12; d += 3) print_number("%.3f", time_for(t, pow(10, -d)));
        for (int d = 6; d <= 12; d += 3)
            print_number("%.2f", rival_time_for(tables, count, t->problem, pow(10, -d)) / time_for(t, pow(10, -d)));
        print_number("%.1e", best_error(t));
        putchar('\n');
    }
    putchar('\n');
    fflush(stdout);
}

static int list_tables(table tables[], const problem problems[FORMS], const iso_method *const methods[], int count)
{
    int made = 0;
    for (int i = 0; rivals[i].name && i < MOST_RIVALS; i++)
        for (int form = 0; form < FORMS; form++)
            tables[made++] = (table){.rival = &rivals[i], .problem = &problems[form]};
    for (int i = 0; i < count; i++)
        for (int form = 0; form < FORMS; form++)
            if (!methods[i]->system || methods[i]->system == problems[form].model.system)
                tables[made++] = (table){.method = methods[i], .problem = &problems[form]};
    return made;
}

static void bench(iso_context *ctx, double k, const iso_method *const methods[], int count)
{
    static table tables[FORMS * (MOST_RIVALS + MOST_METHODS)];
    double reference[ISO_STATE], s;
    solve(ctx, k, T_END, reference, &s);
    problem problems[FORMS] = {make_problem(ctx, "A ball", k, &iso_system_ball, ISO_CLOCK_T),
                               make_problem(ctx, "A point", k, &iso_system_point, ISO_CLOCK_T),
                               make_problem(ctx, "B point", k, &iso_system_point, ISO_CLOCK_S)};
    problems[0].end = problems[1].end = T_END;
    problems[2].end = s;
    const int made = list_tables(tables, problems, methods, count);
    for (int pass = 0; pass < PASSES; pass++)
        for (int d = LOOSEST; d <= TIGHTEST; d++)
            for (int i = 0; i < made; i++) measure(ctx, &tables[i], d, pass, reference);
    for (int i = 0; i < made; i++)
        for (cell *c = tables[i].of + LOOSEST; c <= tables[i].of + TIGHTEST; c++)
            c->milliseconds = isnan(c->error) ? NAN : bench_median(c->pass, PASSES);

    for (int i = 0; i < made; i++)
        if (tables[i].rival) bench_check_rival(tables[i].rival->name, best_error(&tables[i]), 1e-8);
    printf("k = %g\n%-22s %-8s%5s%9s%9s\n", k, "method", "problem", "tol", "error", "ms");
    for (int i = 0; i < made; i++) print_first_table(&tables[i]);
    print_second_table(tables, made);
}

/* --- long runs -------------------------------------------------------------------------------------------------- */

int main(int argc, char **argv)
{
    const iso_method *methods[MOST_METHODS];
    int count = 0;
    iso_context *ctx = iso_context_create();
    for (int i = 1; i < argc && count < MOST_METHODS; i++) {
        methods[count] = iso_method_find(argv[i]);
        if (!methods[count++])
            return fprintf(stderr, "bench_methods: no method, or several, are called '%s'\n", argv[i]), 2;
    }
    for (int i = 0; argc == 1 && iso_methods[i] && count < MOST_METHODS; i++) methods[count++] = iso_methods[i];
    for (int i = 0; i < GEOMETRIES; i++) bench(ctx, geometries[i], methods, count);
    iso_context_free(ctx);
    return 0;
}
