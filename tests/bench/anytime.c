/* bench_anytime - what a question costs: times that run forwards, backwards, and at random.
 *
 *     cmake -S . -B .build/release && cmake --build .build/release -j 2 && .build/release/tests/bench_anytime
 *
 * The ball is the shell k = -1, J = (1.4, 2.1, 3.0), tolerance 1e-12, and is asked for 2000 times up to t = 1000.
 * Each pass does this with the ends of steps kept (iso_orbit_options.memory) and without, one after the other. Passes
 * alternate; the table has the medians of their processor times.
 *
 * How to read the output. One row for each way to find the orbit: microseconds for a question without memory and with
 * it, and the ratio. Compare ratios: times depend on the machine. `forwards` has a ratio of 1 where keeping costs
 * nothing. Without memory only 20 of the questions backwards and at random are asked.
 */
#include <stdio.h>

#include "bench.h"
#include "isoroll.h"

enum { QUESTIONS = 2000, FEW = 20, PASSES = 15, ORDERS = 3 };

static const char *const order_name[ORDERS] = {"forwards", "backwards", "at random"};

static void must(iso_context *ctx, iso_status status)
{
    if (status == ISO_OK) return;
    fprintf(stderr, "bench_anytime: %s\n", iso_context_message(ctx));
    exit(1);
}

typedef struct way {
    const char *method;
    iso_backend backend;
} way;

static iso_orbit *create(iso_context *ctx, const way *w, bool keeps)
{
    iso_params p;
    iso_start start;
    iso_orbit *orbit;
    must(ctx, iso_params_reduced(ctx, -1, (double[]){1.4, 2.1, 3.0}, &p));
    must(ctx,
         iso_start_ball(ctx, (double[]){0.9, -0.3, -0.225}, (double[]){0.36, 0.48, 0.8}, ISO_SPIN_REFUSE, &start));
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.method = iso_method_find(w->method);
    o.backend = w->backend;
    if (!keeps) o.memory = 0;
    must(ctx, iso_orbit_create(ctx, &p, &start, &o, &orbit));
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
    if (order > 0) must(ctx, iso_orbit_at(orbit, 1000, &sample));
    const double begin = bench_milliseconds();
    for (int i = 0; i < count; i++) must(ctx, iso_orbit_at(orbit, time_of(order, i), &sample));
    const double end = bench_milliseconds();
    iso_orbit_free(orbit);
    return 1e3 * (end - begin) / count;
}

int main(void)
{
    static const way ways[] = {{"taylor", ISO_BACKEND_BALL},
                               {"taylor", ISO_BACKEND_POINT},
                               {"blanes_moan6", ISO_BACKEND_POINT},
                               {"rk8pd", ISO_BACKEND_BALL},
                               {"adams", ISO_BACKEND_BALL}};
    iso_context *ctx = iso_context_create();
    printf("%-14s%-7s%-11s%12s%12s%10s\n", "method", "model", "order", "without us", "with us", "ratio");
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++)
        for (int order = 0; order < ORDERS; order++) {
            double time[2][PASSES], ratio[PASSES];
            const int passes = w < 2 || order == 0 ? PASSES : 3;
            for (int pass = 0; pass < passes; pass++) {
                for (int i = 0; i < 2; i++) {
                    const int keeps = (i + pass) % 2; /* each comes first in half of the passes */
                    time[keeps][pass] = measure(ctx, &ways[w], order, keeps);
                }
                ratio[pass] = time[0][pass] / time[1][pass];
            }
            for (int keeps = 0; keeps < 2; keeps++) bench_sort(time[keeps], (size_t)passes);
            bench_sort(ratio, (size_t)passes);
            printf("%-14s%-7s%-11s%12.2f%12.2f%10.3g\n", ways[w].method,
                   ways[w].backend == ISO_BACKEND_BALL ? "ball" : "point", order_name[order], time[0][passes / 2],
                   time[1][passes / 2], ratio[passes / 2]);
            fflush(stdout);
        }
    iso_context_free(ctx);
    return 0;
}
