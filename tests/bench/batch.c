/* bench_batch - how many orbits a second can be computed: one by one, and many side by side (iso_batch_run).
 *
 *     bench_batch [K] [REPETITIONS] [lanes]
 *
 * The orbits are 1000 balls with J = (1.4, 2.1, 3.0) and random starts of the energy h = 0.81, to t = 100. K is the
 * geometry number (default -1). The fastest of REPETITIONS runs counts. `lanes`: only many side by side, on one
 * thread. tests/bench/lanes.sh compares two builds by it.
 *
 * How to read the output. There is a block for rk8pd, for taylor (both one orbit after the other), for iso_batch_run
 * on one thread with each kind of vectors of this processor, and for iso_batch_run on all threads.
 * - Each row is one tolerance: 50th, 95th and 99th percentile of the errors of the final states, then orbits a
 *   second.
 * - The last line of a block is for equal errors: orbits a second where the 95th percentile is 1e-9, and the ratio to
 *   rk8pd. Compare these lines.
 * - An error is relative to the length of the vector, against Taylor series in long double. Orbits next to a
 *   separatrix have errors a hundred times the median.
 * - Seconds are processor time; on all threads they are time on the wall.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/batch.h"

enum { ORBITS = 1000, LOOSEST = 6, TIGHTEST = 13 };

static iso_params params;
static iso_start starts[ORBITS];
static iso_sample truth[ORBITS], found[ORBITS];

static void stop(const iso_context *ctx)
{
    fprintf(stderr, "bench_batch: %s\n", iso_context_message(ctx));
    exit(1);
}

static void make_starts(iso_context *ctx, double k)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    if (iso_params_reduced(ctx, k, J, &params) != ISO_OK) stop(ctx);
    iso_problem problem = {.p = params};
    iso_random *random = iso_random_create(1);
    for (int i = 0; i < ORBITS; i++) {
        starts[i].model = ISO_BALL;
        iso_system_ball.sample(&problem, random, starts[i].y);
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
        if (iso_orbit_create(ctx, &params, &starts[i], &o, &orbit) != ISO_OK) stop(ctx);
        if (iso_orbit_at(orbit, 100, &samples[i]) != ISO_OK) stop(ctx);
        iso_orbit_free(orbit);
    }
}

static void together(iso_context *ctx, double tolerance, int threads, const char *vectors, iso_sample samples[])
{
    static iso_batch_orbit orbits[ORBITS];
    const double end = 100;
    iso_batch_options o = iso_batch_defaults();
    o.tolerance = tolerance, o.threads = threads, o.vectors = vectors;
    for (int i = 0; i < ORBITS; i++) orbits[i] = (iso_batch_orbit){&params, &starts[i], NULL};
    if (iso_batch_run(ctx, orbits, ORBITS, &o, &end, 1, samples, NULL) != ISO_OK) stop(ctx);
}

static void errors(double sorted[ORBITS])
{
    for (int i = 0; i < ORBITS; i++) {
        const double *w = truth[i].ball;
        const double speed = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        sorted[i] = 0;
        for (int j = 0; j < ISO_STATE; j++)
            sorted[i] = fmax(sorted[i], fabs(found[i].ball[j] - w[j]) / (j < 3 ? speed : 1));
    }
    bench_sort(sorted, ORBITS);
}

/* A way to solve them all. One by one (threads < 0): by a method; else in vectors of the name. */
typedef struct way {
    const char *name, *method;
    iso_backend backend;
    int threads;
} way;

/* Orbits per second at a 95th percentile of 1e-9, between the tolerances on logarithmic scales. */
static double measure(iso_context *ctx, const way *w, int repetitions, double unit)
{
    double before = NAN, rate_before = NAN, at_1e9 = NAN, sorted[ORBITS];
    for (int digits = LOOSEST; digits <= TIGHTEST; digits++) {
        double least = INFINITY;
        for (int i = 0; i < repetitions; i++) {
            const double begin = w->threads == 0 ? bench_wall_milliseconds() : bench_milliseconds();
            if (w->threads < 0)
                one_by_one(ctx, w->method, pow(10, -digits), w->backend, found);
            else
                together(ctx, pow(10, -digits), w->threads, w->method, found);
            const double end = w->threads == 0 ? bench_wall_milliseconds() : bench_milliseconds();
            least = fmin(least, end - begin);
        }
        errors(sorted);
        const double rate = 1e3 * ORBITS / least, error = sorted[ORBITS * 95 / 100];
        printf("%-24s 1e-%02d%9.1e%9.1e%9.1e%10.0f\n", w->name, digits, sorted[ORBITS / 2], error,
               sorted[ORBITS * 99 / 100], rate);
        if (before > 1e-9 && error <= 1e-9)
            at_1e9 = rate_before * pow(rate / rate_before, log(before / 1e-9) / log(before / error));
        if (digits == LOOSEST && error <= 1e-9) at_1e9 = rate;
        before = error, rate_before = rate;
    }
    printf("%-24s at 1e-9: %.0f orbits per second, %.2f times rk8pd\n\n", w->name, at_1e9,
           at_1e9 / (unit > 0 ? unit : at_1e9));
    fflush(stdout);
    return at_1e9;
}

int main(int argc, char **argv)
{
    enum { MOST = 8 };
    iso_context *ctx = iso_context_create();
    const int repetitions = argc > 2 ? atoi(argv[2]) : 3;
    way ways[MOST] = {{"rk8pd", "rk8pd", ISO_BACKEND_BALL, -1},
                      {"taylor, ball", "taylor", ISO_BACKEND_BALL, -1},
                      {"taylor, point", "taylor", ISO_BACKEND_POINT, -1}};
    const bool only_lanes = argc > 3 && strcmp(argv[3], "lanes") == 0;
    int count = only_lanes ? 0 : 3;
    for (int i = 0; iso_batch_vectors(i, NULL) && count < MOST - 1; i++)
        ways[count++] = (way){iso_batch_vectors(i, NULL), iso_batch_vectors(i, NULL), ISO_BACKEND_AUTO, 1};
    if (!only_lanes) ways[count++] = (way){"widest, all threads", NULL, ISO_BACKEND_AUTO, 0};
    make_starts(ctx, argc > 1 ? atof(argv[1]) : -1);
    one_by_one(ctx, "taylor_extended", 1e-15, ISO_BACKEND_BALL, truth);
    printf("%-24s %5s%9s%9s%9s%10s\n", "way", "tol", "50 %", "95 %", "99 %", "orbits/s");
    double unit = 0;
    for (int i = 0; i < count; i++) {
        const double rate = measure(ctx, &ways[i], repetitions, unit);
        if (i == 0) unit = rate;
    }
    iso_context_free(ctx);
    return 0;
}
