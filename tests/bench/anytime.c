/* bench_anytime - what a question costs: times that run forwards, backwards, and at random.
 *
 *     cmake -S . -B .build/release && cmake --build .build/release -j 2 && .build/release/tests/bench_anytime
 *
 * The ball is the shell k = -1, J = (1.4, 2.1, 3.0), tolerance 1e-12, and is asked for 2000 times up to t = 1000.
 * Each pass does this with the ends of steps kept (iso_orbit_options.memory) and without, one after the other. Passes
 * alternate; the table has the medians of their processor times.
 *
 * Rival: GSL's rk8pd on the ball, at the tolerance 1e-12. It keeps the ends of all its steps, and takes a shorter step
 * from there (rivals/gsl.c). The law: its answers are ours up to 1e-8. Else the program fails.
 *
 * How to read the output. One row for each way to find the orbit: microseconds for a question without memory and with
 * it, and the ratio; behind it the rival's microseconds, and its time over ours with memory. Compare ratios: times
 * depend on the machine. `forwards` has a ratio of 1 where keeping costs nothing. Without memory only 20 of the
 * questions backwards and at random are asked.
 */
#include "api/typed_impl.h"
#include "bench.h"
#include "rivals/rivals.h"

enum { QUESTIONS = 2000, FEW = 20, PASSES = 15, ORDERS = 3 };

static const char *const order_name[ORDERS] = {"forwards", "backwards", "at random"};

typedef struct way {
    const char *method;
    iso_backend backend;
} way;

static iso_orbit *create(iso_context *ctx, const way *w, bool keeps)
{
    const iso_params p = bench_params(ctx, -1, bench_J);
    const iso_start start = bench_start(ctx);
    iso_orbit *orbit;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.method = iso_method_find(w->method);
    o.backend = w->backend;
    if (!keeps) o.memory = 0;
    bench_must(ctx, iso_orbit_create(ctx, &p, &start, &o, &orbit));
    return orbit;
}

/* The i-th time, in one of the orders. */
static double time_of(int order, int i)
{
    const int at_random = (int)(i * 1237L % QUESTIONS), backwards = QUESTIONS - 1 - i;
    return 1000.0 * (1 + (order == 0 ? i : order == 1 ? backwards : at_random)) / QUESTIONS;
}

/* Microseconds for a question, after one for the farthest time, which is not counted but forwards. */
static double measure(iso_context *ctx, const way *w, int order, bool keeps)
{
    const int count = keeps || order == 0 ? QUESTIONS : FEW;
    iso_orbit *orbit = create(ctx, w, keeps);
    iso_sample sample;
    if (order > 0) bench_must(ctx, iso_orbit_at(orbit, 1000, &sample));
    const double begin = bench_milliseconds();
    for (int i = 0; i < count; i++) bench_must(ctx, iso_orbit_at(orbit, time_of(order, i), &sample));
    const double end = bench_milliseconds();
    iso_orbit_free(orbit);
    return 1e3 * (end - begin) / count;
}

/* The same by the rival. */
static double measure_rival(iso_context *ctx, int order)
{
    static double found[QUESTIONS][6];
    const rival_problem p = {.k = -1, .J = {1.4, 2.1, 3.0}};
    const way ours = {"taylor", ISO_BACKEND_BALL};
    rival_path *path = rival_path_create(&p, 1e-12, bench_state);
    iso_orbit *orbit = create(ctx, &ours, true);
    double y[6], worst = 0;
    bool done = path && (order == 0 || rival_path_at(path, 1000, y));
    const double begin = bench_milliseconds();
    for (int i = 0; i < QUESTIONS && done; i++) done = rival_path_at(path, time_of(order, i), found[i]);
    const double end = bench_milliseconds();
    for (int i = 0; i < QUESTIONS && done; i += 10) {
        iso_sample sample;
        bench_must(ctx, iso_orbit_at(orbit, time_of(order, i), &sample));
        worst = fmax(worst, bench_error(found[i], sample.ball));
    }
    rival_path_free(path);
    iso_orbit_free(orbit);
    bench_check_rival("GSL", done ? worst : NAN, 1e-8);
    return 1e3 * (end - begin) / QUESTIONS;
}

int main(void)
{
    static const way ways[] = {{"taylor", ISO_BACKEND_BALL},
                               {"taylor", ISO_BACKEND_POINT},
                               {"blanes_moan6", ISO_BACKEND_POINT},
                               {"rk8pd", ISO_BACKEND_BALL},
                               {"adams", ISO_BACKEND_BALL}};
    iso_context *ctx = iso_context_create();
    printf("%-14s%-7s%-11s%12s%12s%10s%12s%10s\n", "method", "model", "order", "without us", "with us", "ratio",
           "rival us", "ratio");
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++)
        for (int order = 0; order < ORDERS; order++) {
            double time[2][PASSES], ratio[PASSES], rivals_time[PASSES], to_rival[PASSES];
            const int passes = w < 2 || order == 0 ? PASSES : 3;
            for (int pass = 0; pass < passes; pass++) {
                for (int i = 0; i < 2; i++) {
                    const int keeps = (i + pass) % 2; /* each comes first in half of the passes */
                    time[keeps][pass] = measure(ctx, &ways[w], order, keeps);
                }
                ratio[pass] = time[0][pass] / time[1][pass];
                rivals_time[pass] = measure_rival(ctx, order);
                to_rival[pass] = rivals_time[pass] / time[1][pass];
            }
            const size_t n = (size_t)passes;
            printf("%-14s%-7s%-11s%12.2f%12.2f%10.3g%12.2f%10.2f\n", ways[w].method,
                   ways[w].backend == ISO_BACKEND_BALL ? "ball" : "point", order_name[order],
                   bench_median(time[0], n), bench_median(time[1], n), bench_median(ratio, n),
                   bench_median(rivals_time, n), bench_median(to_rival, n));
            fflush(stdout);
        }
    iso_context_free(ctx);
    return 0;
}
