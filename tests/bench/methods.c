/* Time and error of every library method: the ball's state at t = 1000, J = (1.4, 2.1, 3.0), five k.
 *
 *     bench_methods [METHOD...]
 *
 * First table, one row for each tolerance: largest error of the final state in units of the vector it belongs to,
 * CPU milliseconds, and their ratio to rk8pd at the same tolerance. Second table: the same ratio at the same error,
 * between the tolerances on logarithmic scales. Times of one machine do not carry to another; ratios do. Errors are
 * against rk8pd at 1e-15, itself good to about 1e-12. A run that needs more than 300000 steps is left out ("-").
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "method/method.h"

enum { GEOMETRIES = 5, LOOSEST = 6, TIGHTEST = 13, PASSES = 3, MOST_METHODS = 64 };

static const double geometries[GEOMETRIES] = {-1, 1, 0.5, 0.75, -0.4};

typedef struct cell {
    double milliseconds, error; /* NaN: did not get there */
} cell;

typedef struct table {
    cell of[TIGHTEST + 1]; /* by digits of the tolerance */
} table;

static double cpu_milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static iso_model free_ball(iso_context *ctx, double k)
{
    static const double J[3] = {1.4, 2.1, 3.0}, w[3] = {0.9, -0.3, -0.225};
    iso_field field = {0};
    if (iso_params_reduced(ctx, k, J, &field.p) != ISO_OK) exit(1);
    for (int i = 0; i < 3; i++) field.energy += J[i] * w[i] * w[i] / 2;
    return iso_model_assemble(&iso_system_ball, &field, ISO_CLOCK_T, (const bool[ISO_CLOCKS]){false, false, false});
}

/* One run from the creation of the integrator to the last state; false when it does not get there. */
static bool run(iso_context *ctx, const iso_method *m, const iso_model *model, double tolerance, double y[])
{
    static const double y0[ISO_STATE] = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8};
    iso_integrator *it;
    const iso_method_options options = {.tolerance = tolerance, .max_steps = 300000};
    if (iso_integrator_create(ctx, m, model, &options, &it) != ISO_OK) return false;
    const bool done = iso_integrator_start(it, y0) == ISO_OK && iso_integrator_at(it, 1000, y) == ISO_OK;
    iso_integrator_free(it);
    return done;
}

static cell measure(iso_context *ctx, const iso_method *m, const iso_model *model, double tolerance,
                    const double reference[])
{
    cell c = {INFINITY, 0};
    double y[ISO_MAX_STATE], size[ISO_MAX_STATE];
    for (int pass = 0; pass < PASSES; pass++) {
        const double begin = cpu_milliseconds();
        if (!run(ctx, m, model, tolerance, y)) return (cell){NAN, NAN};
        c.milliseconds = fmin(c.milliseconds, cpu_milliseconds() - begin);
    }
    iso_model_size(model, reference, size);
    for (int i = 0; i < ISO_STATE; i++) c.error = fmax(c.error, fabs(y[i] - reference[i]) / size[i]);
    return c;
}

/* Time for an error, between the two tolerances whose errors lie about it; NaN when there are none. */
static double time_for(const table *t, double error)
{
    for (int d = LOOSEST; d < TIGHTEST; d++) {
        const cell a = t->of[d], b = t->of[d + 1];
        if (!(a.error >= error && b.error <= error && b.error > 0)) continue;
        const double share = a.error > b.error ? log(a.error / error) / log(a.error / b.error) : 0;
        return a.milliseconds * pow(b.milliseconds / a.milliseconds, share);
    }
    return NAN;
}

static void print_number(const char *format, double x)
{
    char text[32];
    snprintf(text, sizeof text, format, x);
    printf("%9s", isnan(x) ? "-" : text);
}

static void print_first_table(const iso_method *m, const table *t, const table *rk8pd)
{
    for (int d = LOOSEST; d <= TIGHTEST; d++) {
        printf("%-22s  1e-%02d", m->name, d);
        print_number("%.1e", t->of[d].error);
        print_number("%.2f", t->of[d].milliseconds);
        print_number("%.2f", t->of[d].milliseconds / rk8pd->of[d].milliseconds);
        putchar('\n');
    }
    fflush(stdout);
}

static void print_second_table(const iso_method *const methods[], int count, const table tables[], const table *rk8pd)
{
    printf("\n%-22s%9s%9s%9s   time/rk8pd for an error of\n", "method", "1e-6", "1e-8", "1e-10");
    for (int i = 0; i < count; i++) {
        printf("%-22s", methods[i]->name);
        for (int d = 6; d <= 10; d += 2)
            print_number("%.2f", time_for(&tables[i], pow(10, -d)) / time_for(rk8pd, pow(10, -d)));
        putchar('\n');
    }
    putchar('\n');
}

static void bench(iso_context *ctx, double k, const iso_method *const methods[], int count)
{
    static table tables[MOST_METHODS], rk8pd;
    const iso_method *const yardstick = iso_method_find("rk8pd");
    const iso_model model = free_ball(ctx, k);
    double reference[ISO_MAX_STATE];
    run(ctx, yardstick, &model, 1e-15, reference);
    for (int d = LOOSEST; d <= TIGHTEST; d++) rk8pd.of[d] = measure(ctx, yardstick, &model, pow(10, -d), reference);
    printf("k = %g\n%-22s%7s%9s%9s%9s\n", k, "method", "tol", "error", "ms", "/rk8pd");
    for (int i = 0; i < count; i++) {
        cell *const t = tables[i].of;
        for (int d = LOOSEST; d <= TIGHTEST; d++) /* after a failure tighter tolerances fail too */
            t[d] = d > LOOSEST && isnan(t[d - 1].error) ? t[d - 1]
                                                        : measure(ctx, methods[i], &model, pow(10, -d), reference);
        print_first_table(methods[i], &tables[i], &rk8pd);
    }
    print_second_table(methods, count, tables, &rk8pd);
}

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
