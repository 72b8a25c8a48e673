/* bench_batch - how many orbits a second can be computed: one by one, and many side by side (iso_batch_run).
 *
 *     bench_batch [K] [REPETITIONS] [all|lanes]
 *
 * The orbits are 1000 balls with J = (1.4, 2.1, 3.0) and random starts of the energy h = 0.81, to t = 100. K is the
 * geometry number (default -1). All ways take turns, and the fastest of REPETITIONS runs (3) of each counts.
 * `lanes`: only many side by side, on one thread.
 *
 * Rivals (rivals/): GSL's rk8pd, and Boost.odeint where it is found, each by the ball and by the point in the ball's
 * time, one orbit after the other. The law: their median error comes within 1e-8. Else the program fails and prints
 * no speed of theirs.
 *
 * How to read the output. There is a block for each rival, for taylor (one orbit after the other), for iso_batch_run
 * on one thread with each kind of vectors of this processor, and for iso_batch_run on all threads.
 * - Each row is one tolerance: 50th, 95th and 99th percentile of the errors of the final states, then orbits a
 *   second.
 * - The last line of a block is for equal errors: orbits a second where the 95th percentile is 1e-9, and the ratio to
 *   the fastest rival. Compare these lines.
 * - An error is relative to the length of the vector, against Taylor series in long double. Orbits next to a
 *   separatrix have errors a hundred times the median.
 * - Seconds are processor time; on all threads they are time on the wall.
 */
#include "orbit/batch.h"
#include "bench.h"
#include "laws.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "rivals/rivals.h"

enum { ORBITS = 1000, LOOSEST = 6, TIGHTEST = 14 };

static iso_params params;
static iso_start starts[ORBITS];
static iso_sample truth[ORBITS], found[ORBITS];

static void make_starts(iso_context *ctx, double k)
{
    params = bench_params(ctx, k, bench_J);
    iso_problem problem = {.p = params};
    iso_random *random = iso_random_create(1);
    for (int i = 0; i < ORBITS; i++) {
        starts[i].model = ISO_BALL;
        laws_sample(&iso_system_ball, &problem, random, starts[i].y);
        const double scale = sqrt(0.81 / iso_ball_energy(&params, starts[i].y));
        for (int j = 0; j < 3; j++) starts[i].y[j] *= scale;
    }
    iso_random_free(random);
}

static void one_by_one(iso_context *ctx, const char *method, double tolerance, iso_backend backend,
                       iso_sample samples[])
{
    for (int i = 0; i < ORBITS; i++) {
        iso_orbit *orbit;
        iso_orbit_options o = iso_orbit_defaults(&starts[i]);
        o.method = iso_method_find(method), o.tolerance = tolerance, o.backend = backend;
        bench_must(ctx, iso_orbit_create(ctx, &params, &starts[i], &o, &orbit));
        bench_must(ctx, iso_orbit_at(orbit, 100, &samples[i]));
        iso_orbit_free(orbit);
    }
}

static rival_problem problem_of(int orbit, bool point)
{
    const double *J = params.J, eps = iso_coupling(&params, iso_ball_energy(&params, starts[orbit].y));
    return (rival_problem){.point = point, .in_t = true, .k = params.k, .J = {J[0], J[1], J[2]}, .eps = eps};
}

static void by_rival(const rival *r, bool point, double tolerance, iso_sample samples[])
{
    for (int i = 0; i < ORBITS; i++) {
        double y[ISO_STATE];
        memcpy(y, starts[i].y, sizeof y);
        const rival_problem p = problem_of(i, point);
        if (point) iso_ball_to_point(&params, y, y);
        if (!r->solve(&p, tolerance, 100, y)) memset(y, 0, sizeof y); /* an error of 1 */
        if (point) iso_point_to_ball(&params, y, y);
        memcpy(samples[i].ball, y, sizeof y);
    }
}

static void together(iso_context *ctx, double tolerance, int threads, const char *vectors, iso_sample samples[])
{
    static iso_batch_orbit orbits[ORBITS];
    const double end = 100;
    iso_batch_options o = iso_batch_defaults();
    o.tolerance = tolerance, o.threads = threads, o.vectors = vectors;
    for (int i = 0; i < ORBITS; i++) orbits[i] = (iso_batch_orbit){&params, &starts[i], NULL};
    bench_must(ctx, iso_batch_run(ctx, orbits, ORBITS, &o, &end, 1, samples, NULL));
}

static void errors(double sorted[ORBITS])
{
    for (int i = 0; i < ORBITS; i++) sorted[i] = bench_error(found[i].ball, truth[i].ball);
    bench_sort(sorted, ORBITS);
}

/* A way to solve them all: by a rival (if there is one), by a method one by one (threads < 0), or in vectors of the
 * name. */
typedef struct way {
    const char *name, *method;
    iso_backend backend;
    int threads;
    const rival *rival;
} way;

static double time_of(iso_context *ctx, const way *w, double tolerance)
{
    double (*const now)(void) = w->threads == 0 ? bench_wall_milliseconds : bench_milliseconds;
    const double begin = now();
    if (w->rival)
        by_rival(w->rival, w->backend == ISO_BACKEND_POINT, tolerance, found);
    else if (w->threads < 0)
        one_by_one(ctx, w->method, tolerance, w->backend, found);
    else
        together(ctx, tolerance, w->threads, w->method, found);
    return now() - begin;
}

/* What a way gave at each tolerance. */
typedef struct result {
    double least, median, most95, most99; /* milliseconds, and percentiles of the errors */
} result;

static void measure(iso_context *ctx, const way *w, result of[TIGHTEST + 1])
{
    for (int digits = LOOSEST; digits <= TIGHTEST; digits++) {
        double sorted[ORBITS];
        result *r = &of[digits];
        const double took = time_of(ctx, w, pow(10, -digits));
        errors(sorted);
        r->least = r->least > 0 ? fmin(r->least, took) : took;
        r->median = sorted[ORBITS / 2], r->most95 = sorted[ORBITS * 95 / 100], r->most99 = sorted[ORBITS * 99 / 100];
    }
}

static void check_rival(const way *w, const result of[TIGHTEST + 1])
{
    double best = INFINITY;
    for (int digits = LOOSEST; digits <= TIGHTEST; digits++) best = fmin(best, of[digits].median);
    bench_check_rival(w->name, best, 1e-8);
}

/* Orbits per second at a 95th percentile of 1e-9, between the tolerances on logarithmic scales. */
static double rate_at_1e9(const result of[TIGHTEST + 1])
{
    if (of[LOOSEST].most95 <= 1e-9) return 1e3 * ORBITS / of[LOOSEST].least;
    for (int digits = LOOSEST + 1; digits <= TIGHTEST; digits++) {
        const result *a = &of[digits - 1], *b = &of[digits];
        if (!(a->most95 > 1e-9 && b->most95 <= 1e-9)) continue;
        const double share = log(a->most95 / 1e-9) / log(a->most95 / b->most95);
        return 1e3 * ORBITS / (a->least * pow(b->least / a->least, share));
    }
    return NAN;
}

static void print(const way *w, const result of[TIGHTEST + 1], double fastest_rival)
{
    for (int digits = LOOSEST; digits <= TIGHTEST; digits++) {
        const result *r = &of[digits];
        printf("%-28s 1e-%02d%9.1e%9.1e%9.1e%10.0f\n", w->name, digits, r->median, r->most95, r->most99,
               1e3 * ORBITS / r->least);
    }
    printf("%-28s at 1e-9: %.0f orbits per second", w->name, rate_at_1e9(of));
    if (fastest_rival > 0) printf(", %.2f times the fastest rival", rate_at_1e9(of) / fastest_rival);
    printf("\n\n");
}

enum { MOST = 32 };

/* Rivals and taylor one by one, vectors, all threads. */
static int list_ways(way ways[MOST], bool only_lanes)
{
    static char names[MOST][64];
    const int one = -1, all = 0;
    int count = 0;
    for (int i = 0; rivals[i].name && !only_lanes; i++)
        for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++) {
            snprintf(names[count], sizeof *names, "%s, %s", rivals[i].name, b == ISO_BACKEND_BALL ? "ball" : "point");
            ways[count] = (way){.name = names[count], .backend = b, .threads = one, .rival = &rivals[i]};
            count++;
        }
    if (!only_lanes) {
        ways[count++] = (way){"taylor, ball", "taylor", ISO_BACKEND_BALL, one, NULL};
        ways[count++] = (way){"taylor, point", "taylor", ISO_BACKEND_POINT, one, NULL};
    }
    for (int i = 0; iso_batch_vectors(i, NULL); i++)
        ways[count++] = (way){iso_batch_vectors(i, NULL), iso_batch_vectors(i, NULL), ISO_BACKEND_AUTO, 1, NULL};
    if (!only_lanes) ways[count++] = (way){"widest, all threads", NULL, ISO_BACKEND_AUTO, all, NULL};
    return count;
}

int main(int argc, char **argv)
{
    static result results[MOST][TIGHTEST + 1];
    way ways[MOST];
    iso_context *ctx = iso_context_create();
    const int repetitions = argc > 2 ? atoi(argv[2]) : 3;
    const char *which = argc > 3 ? argv[3] : "all";
    const int count = list_ways(ways, strcmp(which, "all") != 0);
    make_starts(ctx, argc > 1 ? atof(argv[1]) : -1);
    one_by_one(ctx, "taylor_extended", 1e-15, ISO_BACKEND_BALL, truth);
    for (int pass = 0; pass < repetitions; pass++)
        for (int i = 0; i < count; i++) measure(ctx, &ways[i], results[i]);

    double fastest = NAN;
    for (int i = 0; i < count; i++) {
        if (!ways[i].rival) continue;
        check_rival(&ways[i], results[i]);
        fastest = fmax(fastest, rate_at_1e9(results[i]));
    }
    printf("%-28s %5s%9s%9s%9s%10s\n", "way", "tol", "50 %", "95 %", "99 %", "orbits/s");
    for (int i = 0; i < count; i++) print(&ways[i], results[i], fastest);
    iso_context_free(ctx);
    return 0;
}
