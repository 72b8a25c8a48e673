/* bench_foreign - what the calls for other languages cost: a batch by iso_batch_run and by iso_batch.
 *
 *     bench_foreign [SCENE]
 *
 * The orbits are those of the scene (default: k = 1/2, J = 1, 2, 5) with n = (0, 0, 1) and omega = (cos a, sin a, 0).
 * A line has the orbits, the end, the rows of each, the fastest of nine runs in seconds of processor time (all
 * threads), and orbits a second. tests/python/rate.py prints the same lines for isoroll.batch: compare these. Samples
 * and tables are allocated in each run, as Python does.
 */
#include "api/interface.h"
#include "bench.h"
#include "io/scene_file.h"
#include "orbit/batch.h"

enum { RUNS = 9, WIDTH = 7 };

static const char usual[] = "reduced: {k: 0.5, J: [1, 2, 5]}\ntime: {end: 1}\n"
                            "initial: {normal: [0, 0, 1], angular_velocity: [1, 0, 0]}\n";
static const double turn = 6.283185307179586;

/* Orbits, their end, rows of each. */
static const struct {
    size_t orbits, rows;
    double end;
} sizes[] = {{4096, 1, 100}, {20000, 10, 20}, {2000, 500, 50}};

static iso_context *ctx;

static double seconds(void)
{
    return 1e-3 * bench_busy_milliseconds();
}

static double by_structs(const iso_scene *scene, const double *y, size_t count, const double *times, size_t rows)
{
    const double before = seconds();
    iso_start *start = calloc(count, sizeof *start);
    iso_batch_orbit *orbit = calloc(count, sizeof *orbit);
    iso_sample *sample = malloc(count * rows * sizeof *sample);
    iso_batch_options o = iso_batch_defaults();
    if (!start || !orbit || !sample) exit(1);
    for (size_t i = 0; i < count; i++) {
        bench_must(ctx, iso_start_ball(ctx, y + 6 * i, y + 6 * i + 3, ISO_SPIN_REFUSE, &start[i]));
        orbit[i] = (iso_batch_orbit){&scene->params, &start[i], &scene->effects};
    }
    bench_must(ctx, iso_batch_run(ctx, orbit, count, &o, times, rows, sample, NULL));
    free(start);
    free(orbit);
    free(sample);
    return seconds() - before;
}

static double by_arrays(const iso_scene *scene, const double *y, size_t count, const double *times, size_t rows)
{
    const double before = seconds();
    double *table = malloc(count * rows * WIDTH * sizeof *table);
    if (!table) exit(1);
    bench_must(ctx, iso_batch(ctx, &scene, 1, count, NULL, NULL, y, times, rows, 0, NULL, table, NULL));
    free(table);
    return seconds() - before;
}

static void tell(const char *name, size_t count, double end, size_t rows, double best)
{
    printf("%-18s %6zu orbits to %3g, %3zu rows: %.4f s, %8.0f orbits a second\n", name, count, end, rows, best,
           (double)count / best);
}

static void measure(const iso_scene *scene, const iso_scene *foreign, size_t count, double end, size_t rows)
{
    double *y = calloc(6 * count, sizeof *y), *times = calloc(rows, sizeof *times), best[2] = {INFINITY, INFINITY};
    if (!y || !times) exit(1);
    for (size_t i = 0; i < count; i++) {
        const double a = turn * (double)i / (double)count;
        y[6 * i] = cos(a), y[6 * i + 1] = sin(a), y[6 * i + 5] = 1;
    }
    for (size_t j = 0; j < rows; j++) times[j] = end * (double)(j + 1) / (double)rows;
    for (int run = 0; run < RUNS; run++) {
        best[0] = fmin(best[0], by_structs(scene, y, count, times, rows));
        best[1] = fmin(best[1], by_arrays(foreign, y, count, times, rows));
    }
    tell("iso_batch_run", count, end, rows, best[0]);
    tell("iso_batch", count, end, rows, best[1]);
    free(y);
    free(times);
}

int main(int argc, char **argv)
{
    iso_scene scene;
    iso_scene *foreign;
    ctx = iso_context_create();
    if (!ctx) return 1;
    bench_must(ctx, argc > 1 ? iso_scene_load(ctx, argv[1], &scene)
                             : iso_scene_load_text(ctx, "usual", usual, sizeof usual - 1, &scene));
    bench_must(ctx, argc > 1 ? iso_scene_read(ctx, argv[1], &foreign)
                             : iso_scene_parse(ctx, "usual", usual, sizeof usual - 1, &foreign));
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        measure(&scene, foreign, sizes[i].orbits, sizes[i].end, sizes[i].rows);
    iso_scene_free(foreign);
    iso_context_free(ctx);
    return 0;
}
