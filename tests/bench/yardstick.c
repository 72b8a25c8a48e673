/* bench_yardstick - isoroll's lanes beside code that can do one problem only (yardstick/lanes.c).
 *
 *     bench_yardstick [PASSES] [K...]
 *
 * The orbits are 1000 balls with J = (1.4, 2.1, 3.0) and random starts of the energy h = 0.81, from t = 0 to t = 100,
 * on one thread, for five k. Each side takes the loosest tolerance at which 95 % of the errors are below 1e-9, and the
 * yardstick the best of its orders at that. Then both run in turns, PASSES times (15).
 *
 * A row has: k, vectors, tolerance and order, steps and orbits a second of the yardstick; tolerance and orbits a
 * second of iso_batch_run; the median of the ratios ours/yardstick of all passes, with quartiles. Seconds are
 * processor time. Errors are against Taylor series in long double, relative to the length of the vector.
 *
 * First the yardstick must agree with tests/reference/free_ball.csv, given as ISO_REFERENCE or compiled in; else no
 * ratio is printed.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/batch.h"
#include "yardstick/yardstick.h"

enum { ORBITS = 1000, MOST_PASSES = 1000 };

static const double J[3] = {1.4, 2.1, 3.0}, end_time = 100, wanted = 1e-9;

static iso_context *ctx;
static iso_params params;
static iso_start starts[ORBITS];
static iso_batch_orbit orbits[ORBITS];
static iso_sample truth[ORBITS], samples[ORBITS];
static double given[ORBITS][6], found[ORBITS][6];

static void stop(const char *why)
{
    fprintf(stderr, "bench_yardstick: %s\n", why);
    exit(1);
}

/* --- the orbits ------------------------------------------------------------------------------------------------- */

static void make_starts(double k)
{
    if (iso_params_reduced(ctx, k, J, &params) != ISO_OK) stop(iso_context_message(ctx));
    iso_problem problem = {.p = params};
    iso_random *random = iso_random_create(1);
    for (int i = 0; i < ORBITS; i++) {
        starts[i].model = ISO_BALL;
        iso_system_ball.sample(&problem, random, starts[i].y);
        const double scale = sqrt(0.81 / iso_ball_energy(&params, starts[i].y));
        for (int j = 0; j < 3; j++) starts[i].y[j] *= scale;
        memcpy(given[i], starts[i].y, sizeof given[i]);
        orbits[i] = (iso_batch_orbit){&params, &starts[i], NULL};
    }
    iso_random_free(random);
}

static void find_truth(void)
{
    for (int i = 0; i < ORBITS; i++) {
        iso_orbit *orbit;
        iso_orbit_options o = iso_orbit_defaults(&starts[i]);
        o.method = iso_method_find("taylor_extended"), o.tolerance = 1e-15, o.backend = ISO_BACKEND_BALL;
        if (iso_orbit_create(ctx, &params, &starts[i], &o, &orbit) != ISO_OK ||
            iso_orbit_at(orbit, end_time, &truth[i]) != ISO_OK)
            stop(iso_context_message(ctx));
        iso_orbit_free(orbit);
    }
}

static double error_of(const double y[6], const double right[6])
{
    const double speed = sqrt(right[0] * right[0] + right[1] * right[1] + right[2] * right[2]);
    double worst = 0;
    for (int i = 0; i < 6; i++) worst = fmax(worst, fabs(y[i] - right[i]) / (i < 3 ? speed : 1));
    return isfinite(worst) ? worst : INFINITY;
}

/* --- the two sides ---------------------------------------------------------------------------------------------- */

/* One side: the yardstick in an order, or isoroll (order < 0). */
typedef struct side {
    const yardstick_code *code;
    int order;
    double tolerance, rate[MOST_PASSES];
    long steps;
} side;

/* Solves all. Gives milliseconds. */
static double solve(side *s, double tolerance)
{
    if (s->order < 0) {
        iso_batch_options o = iso_batch_defaults();
        o.tolerance = tolerance, o.threads = 1, o.vectors = s->code->name;
        const double begin = bench_milliseconds();
        if (iso_batch_run(ctx, orbits, ORBITS, &o, &end_time, 1, samples, NULL) != ISO_OK)
            stop(iso_context_message(ctx));
        return bench_milliseconds() - begin;
    }
    yardstick_job job = {.k = params.k, .J = {J[0], J[1], J[2]}, .start = (const double(*)[6])given, .end = found};
    job.count = ORBITS, job.time = end_time, job.tolerance = tolerance;
    const double begin = bench_milliseconds();
    s->code->solve[s->order](&job);
    s->steps = job.steps;
    return bench_milliseconds() - begin;
}

static double percentile(const side *s)
{
    double error[ORBITS];
    for (int i = 0; i < ORBITS; i++) error[i] = error_of(s->order < 0 ? samples[i].ball : found[i], truth[i].ball);
    bench_sort(error, ORBITS);
    return error[ORBITS * 95 / 100];
}

/* The loosest tolerance at which 95 % of the errors are below the wanted one; NaN: there is none. */
static double find_tolerance(side *s)
{
    double tight = log(1e-15), loose = log(1e-5);
    for (int i = 0; i < 12; i++) {
        const double middle = (tight + loose) / 2;
        solve(s, exp(middle));
        *(percentile(s) <= wanted ? &tight : &loose) = middle;
    }
    s->tolerance = exp(tight);
    return s->tolerance > 1.1e-15 ? s->tolerance : NAN;
}

static double median_of(const double x[], int count, double part)
{
    double sorted[MOST_PASSES];
    memcpy(sorted, x, (size_t)count * sizeof *x);
    bench_sort(sorted, (size_t)count);
    return sorted[(int)(part * (count - 1) + 0.5)];
}

static void take_passes(side *s[], int count, int passes)
{
    for (int i = 0; i < passes; i++)
        for (int j = 0; j < count; j++) s[j]->rate[i] = 1e3 * ORBITS / solve(s[j], s[j]->tolerance);
}

static void race(const yardstick_code *code, int passes)
{
    static side rival[YARDSTICK_ORDERS], ours;
    side *all[YARDSTICK_ORDERS], *best = NULL;
    int count = 0;
    for (int i = 0; i < YARDSTICK_ORDERS; i++) {
        rival[i] = (side){.code = code, .order = i};
        if (!isnan(find_tolerance(&rival[i]))) all[count++] = &rival[i];
    }
    take_passes(all, count, 5);
    for (int i = 0; i < count; i++)
        if (!best || median_of(all[i]->rate, 5, 0.5) > median_of(best->rate, 5, 0.5)) best = all[i];
    ours = (side){.code = code, .order = -1};
    if (isnan(find_tolerance(&ours)) || !best) stop("a side does not reach the error");
    take_passes((side *[]){best, &ours}, 2, passes);
    double ratio[MOST_PASSES];
    for (int i = 0; i < passes; i++) ratio[i] = ours.rate[i] / best->rate[i];
    printf("%6g %-8s %8.1e %4d %6.1f %8.0f   %8.1e %8.0f   %5.2f  (%.2f to %.2f)\n", params.k, code->name,
           best->tolerance, code->order[best->order], (double)best->steps / ORBITS,
           median_of(best->rate, passes, 0.5), ours.tolerance, median_of(ours.rate, passes, 0.5),
           median_of(ratio, passes, 0.5), median_of(ratio, passes, 0.25), median_of(ratio, passes, 0.75));
    fflush(stdout);
}

/* --- the yardstick is right ------------------------------------------------------------------------------------- */

/* A row: id, k, J, n, w, t, then w, n at t. */
static bool read_row(const char *line, yardstick_job *job, double start[6], double right[6])
{
    double x[18];
    const char *at = strchr(line, ',');
    for (int i = 0; i < 18 && at; i++) {
        x[i] = strtod(at + 1, NULL);
        at = strchr(at + 1, ',');
    }
    if (!at || line[0] == '#') return false;
    job->k = x[0], job->time = x[10];
    memcpy(job->J, x + 1, sizeof job->J);
    memcpy(start, x + 7, 3 * sizeof *start);
    memcpy(start + 3, x + 4, 3 * sizeof *start);
    memcpy(right, x + 11, 6 * sizeof *right);
    return job->k != 0;
}

static void check_yardstick(const yardstick_code *code, const char *path)
{
    char line[4096];
    FILE *file = fopen(path, "r");
    int rows = 0;
    double worst = 0;
    if (!file) stop("no reference states: set ISO_REFERENCE to tests/reference/free_ball.csv");
    while (fgets(line, sizeof line, file)) {
        double start[1][6], y[1][6], right[6];
        yardstick_job job = {.start = (const double(*)[6])start, .end = y, .count = 1, .tolerance = 1e-13};
        if (!read_row(line, &job, start[0], right)) continue;
        code->solve[YARDSTICK_ORDERS - 1](&job);
        const double error = error_of(y[0], right) / (1 + job.time);
        worst = fmax(worst, error), rows++;
        if (error > 1e-11) fprintf(stderr, "%s: %.1e from the reference: %.40s\n", code->name, error, line);
    }
    fclose(file);
    printf("yardstick %s: %d rows of reference, error/(1 + t) at most %.1e\n", code->name, rows, worst);
    if (rows == 0 || !(worst <= 1e-11)) stop("the yardstick is wrong");
}

int main(int argc, char **argv)
{
    static const double all[] = {-1, 1, 0.5, 0.75, -0.4};
    static const yardstick_code *const codes[] = {&yardstick_avx512, &yardstick_avx2};
    const int passes = argc > 1 ? atoi(argv[1]) : 15, count = argc > 2 ? argc - 2 : 5;
    const char *path = getenv("ISO_REFERENCE");
    ctx = iso_context_create();
    for (int i = 0; i < 2; i++)
        if (codes[i]->runs_here()) check_yardstick(codes[i], path ? path : ISO_TEST_REFERENCE);
    printf("%6s %-8s %8s %4s %6s %8s   %8s %8s   %5s\n", "k", "vectors", "tol", "order", "steps", "orbits/s", "tol",
           "orbits/s", "ratio");
    for (int i = 0; i < count; i++) {
        make_starts(argc > 2 ? atof(argv[2 + i]) : all[i]);
        find_truth();
        for (int j = 0; j < 2; j++)
            if (codes[j]->runs_here()) race(codes[j], passes < MOST_PASSES ? passes : MOST_PASSES);
    }
    iso_context_free(ctx);
    return 0;
}
