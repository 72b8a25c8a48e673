/* compare_print.c - what compare tells people (study/study.h). */
#include <float.h>
#include <math.h>

#include "base/number_impl.h"
#include "orbit/orbit_impl.h"
#include "task/task_impl.h"

static const char *backend_name(const iso_comparison *c, int run)
{
    return iso_backend_name((int)c->run[run].backend);
}

static void print_head(FILE *to, const iso_scene *scene, const iso_comparison *c)
{
    iso_params_print(to, &scene->params);
    fprintf(to, " (%s)\nh = %s, eps = %s, tolerance %s\n\n", iso_surface_name((int)scene->params.body.surface),
            ISO_ROUNDED(c->h, 10), ISO_ROUNDED(c->eps, 10), ISO_SHORT(scene->tolerance));
    iso_effects_print(to, &c->effects, false);
    for (int b = 0; b < ISO_INTEGRATED; b++) {
        const iso_backend_run *r = &c->run[b];
        fprintf(to, "backend %-5s  %s: %ld steps, %ld rejected, %ld right-hand sides, %.3g ms\n", backend_name(c, b),
                r->method->name, r->statistics.steps, r->statistics.rejected, r->statistics.rhs, 1e3 * r->seconds);
    }
    if (c->runs == ISO_BACKENDS)
        fprintf(to, "backend exact  the closed solution: %ld states, %.3g ms\n",
                c->run[ISO_BY_EXACT].statistics.states, 1e3 * c->run[ISO_BY_EXACT].seconds);
    else
        fprintf(to, "exact: %s\n", c->no_exact);
}

/* Which of the rows is the i-th that is shown: `shown` rows, evenly spaced, with the first and the last. */
static size_t shown_row(size_t i, size_t shown, size_t rows)
{
    return shown < 2 ? rows - 1 : i * (rows - 1) / (shown - 1);
}

/* Prints one model's six numbers by every backend, each with its difference from the backends above it. */
static void print_model(FILE *to, const iso_comparison *c, iso_model_kind model, size_t shown, size_t rows)
{
    static const char *const titles[] = {"the ball", "the point"};
    const int first = model == ISO_BALL ? ISO_COLUMN_BALL : ISO_COLUMN_POINT;
    const int clock = model == ISO_BALL ? 0 : 2;
    fprintf(to, "\n%s\n", titles[model]);
    iso_table_begin(to, 2);
    fprintf(to, "%s\tbackend", iso_clock_name((iso_clock)clock));
    for (int i = 0; i < ISO_STATE; i++) fprintf(to, "\t%s", iso_column_name(first + i));
    fputs("\tdifference\n", to);
    for (size_t i = 0; i < shown; i++) {
        const size_t row = shown_row(i, shown, rows);
        for (int b = 0; b < c->runs; b++) {
            const double *x = iso_record_const_row(c->run[b].trajectory, row);
            fprintf(to, "%.6g\t%s", x[clock], backend_name(c, b));
            for (int j = 0; j < ISO_STATE; j++) fprintf(to, "\t%.9g", x[first + j] + 0.0);
            double most = 0; /* the larger difference of the two vectors from ball or point, whichever is larger */
            for (int from = 0; b > 0 && from < ISO_INTEGRATED; from++) {
                const double *d = iso_record_const_row(b == ISO_BY_EXACT ? c->from_exact[from] : c->difference, row);
                most = fmax(most, model == ISO_BALL ? fmax(d[1], d[2]) : fmax(d[3], d[4]));
            }
            fprintf(to, b > 0 ? "\t%.1e\n" : "\t\n", most);
        }
    }
    iso_table_end(to);
}

static void print_clocks(FILE *to, const iso_comparison *c, size_t shown, size_t rows)
{
    fputs("\nclocks\n", to);
    iso_table_begin(to, 1);
    fputs("backend", to);
    for (int k = 0; k < ISO_CLOCKS; k++) fprintf(to, "\t%s", iso_clock_name((iso_clock)k));
    fputs("\n", to);
    for (size_t i = 0; i < shown; i++)
        for (int b = 0; b < c->runs; b++) {
            const double *x = iso_record_const_row(c->run[b].trajectory, shown_row(i, shown, rows));
            fprintf(to, "%s\t%.15g\t%.15g\t%.15g\n", backend_name(c, b), x[0], x[1], x[2]);
        }
    iso_table_end(to);
}

static void print_integrals(FILE *to, const iso_comparison *c)
{
    fputs("\nintegrals: value at the start, largest relative drift by each backend\n", to);
    iso_table_begin(to, 2);
    fputs("of\tname\tstart", to);
    for (int b = 0; b < c->runs; b++) fprintf(to, "\t%s", backend_name(c, b));
    fputs("\twhat it is\n", to);
    for (int i = 0; i < c->run[ISO_BALL].drifts; i++) {
        const iso_drift *d = &c->run[ISO_BALL].drift[i];
        fprintf(to, "%s\t%s\t%.9g", d->system->name, d->integral->name, d->start);
        for (int b = 0; b < c->runs; b++)
            fprintf(to, i < c->run[b].drifts ? "\t%.1e" : "\t-", c->run[b].drift[i].worst);
        fprintf(to, "\t%s\n", d->integral->doc);
    }
    iso_table_end(to);
}

static void print_worst(FILE *to, const char *who, const double worst[ISO_DIFFERENCES])
{
    fprintf(to, "%s", who);
    for (size_t i = 1; i < ISO_DIFFERENCES; i++) fprintf(to, "\t%.1e", worst[i]);
    fputs("\n", to);
}

static void print_differences(FILE *to, const iso_comparison *c, size_t rows)
{
    fprintf(to, "\nlargest relative differences over %zu rows\n", rows);
    iso_table_begin(to, 1);
    fputs("between", to);
    for (size_t i = 1; i < ISO_DIFFERENCES; i++) fprintf(to, "\t%s", iso_record_name(c->difference, i));
    fputs("\n", to);
    print_worst(to, "ball, point", c->worst);
    if (c->runs == ISO_BACKENDS) {
        print_worst(to, "ball, exact", c->worst_from_exact[ISO_BALL]);
        print_worst(to, "point, exact", c->worst_from_exact[ISO_POINT]);
    }
    iso_table_end(to);
}

/* --- the result in one sentence --------------------------------------------------------------------------------- */

/* The largest difference in row i: of states and clocks, between any two backends. */
static double row_worst(const iso_comparison *c, size_t i)
{
    double worst = 0;
    for (int j = 1; j < ISO_DIFFERENCES; j++) {
        worst = fmax(worst, iso_record_const_row(c->difference, i)[j]);
        for (int b = 0; c->runs == ISO_BACKENDS && b < ISO_INTEGRATED; b++)
            worst = fmax(worst, iso_record_const_row(c->from_exact[b], i)[j]);
    }
    return worst;
}

/* What the steps of the integrations may add up to, where errors do not grow by themselves. */
static double allowed(const iso_scene *scene, const iso_comparison *c)
{
    long steps = 1;
    for (int b = 0; b < ISO_INTEGRATED; b++)
        if (c->run[b].statistics.steps > steps) steps = c->run[b].statistics.steps;
    return (double)steps * fmax(scene->tolerance, 16 * DBL_EPSILON);
}

static double worst_of(const iso_comparison *c, size_t rows)
{
    double worst = 0;
    for (size_t i = 0; i < rows; i++) worst = fmax(worst, row_worst(c, i));
    for (int j = 1; j < ISO_DIFFERENCES; j++)
        if (rows == iso_record_rows(c->difference) && !isfinite(c->worst[j])) worst = INFINITY;
    return worst;
}

/* The time of the last row before which all differences are within `bound`. */
static double agree_until(const iso_comparison *c, double bound)
{
    size_t i = 0;
    while (i + 1 < iso_record_rows(c->difference) && row_worst(c, i + 1) <= bound) i++;
    return iso_record_const_row(c->difference, i)[0];
}

bool iso_comparison_text(const iso_scene *scene, const iso_comparison *c, double *most,
                         char words[ISO_COMPARISON_SIZE])
{
    enum { GROWTH = 30 }; /* errors that grow like the cube of the time are 8 times those of the first half */
    const size_t rows = iso_record_rows(c->difference), all = iso_scene_rows(scene);
    const char *who = c->runs == ISO_BACKENDS ? "both models and the closed solution" : "both models";
    const char *clock = iso_clock_name(c->clock);
    const double worst = worst_of(c, rows), half = worst_of(c, rows / 2), bound = allowed(scene, c);
    const double same = fmin(bound, 1e-3); /* what differs by more is not called the same, whatever the tolerance */
    char part[128] = "";
    *most = worst;
    if (rows < all) snprintf(part, sizeof part, " in the %zu of %zu rows that were compared", rows, all);
    if (worst <= same)
        snprintf(words, ISO_COMPARISON_SIZE, "the same orbit%s: %s agree to %.1e", part, who, worst);
    else if (!isfinite(worst))
        snprintf(words, ISO_COMPARISON_SIZE, "no result%s: a difference is not finite", part);
    else if (worst > bound && worst > GROWTH * half)
        snprintf(words, ISO_COMPARISON_SIZE,
                 "the orbits part%s: %s agree to %.1e until %s = %s, then the difference grows to %.1e, as on a "
                 "chaotic orbit, where it multiplies with every turn; this says nothing against the isomorphism "
                 "(see 'isoroll chaos')",
                 part, who, bound, clock, ISO_ROUNDED(agree_until(c, bound), 6), worst);
    else
        snprintf(
            words, ISO_COMPARISON_SIZE,
            "not shown to be the same orbit%s: %s differ by %.1e; steps of tolerance %s may add up to %.1e; if a "
            "smaller --tol makes the difference smaller, it is the error of the method",
            part, who, worst, ISO_SHORT(scene->tolerance), bound);
    return worst <= same;
}

void iso_compare_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_comparison *c = result->found;
    const size_t rows = iso_record_rows(c->difference),
                 wanted = (size_t)fmin(((const iso_compare_request *)options)->rows, 1e9);
    const size_t shown = wanted < rows ? wanted : rows;
    char words[ISO_COMPARISON_SIZE];
    if (rows == 0) return;
    print_head(to, scene, c);
    print_model(to, c, ISO_BALL, shown, rows);
    print_model(to, c, ISO_POINT, shown, rows);
    print_clocks(to, c, shown, rows);
    print_integrals(to, c);
    print_differences(to, c, rows);
    double worst;
    iso_comparison_text(scene, c, &worst, words);
    fprintf(to, "\n%s\n", words);
}
