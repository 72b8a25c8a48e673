/* test_batches.c - iso_batch (api/interface.h): the numbers of the typed calls, stops, orbits that fail. */
#include "ask.h"
#include "orbit/batch.h"

enum { ORBITS = 700 };

static double k[ORBITS], starts[ORBITS][6], rows[ORBITS * 2 * WIDTH];
static int32_t status[ORBITS];
static const double times[2] = {1, 3};

static iso_status batch(const iso_scene *const *scene, const double ks[], const double at[2], int threads)
{
    return iso_batch(ctx, scene, 1, ORBITS, ks, NULL, starts[0], at, 2, threads, NULL, rows, status);
}

static void check_batch(const iso_scene *const *scene)
{
    static iso_params params[ORBITS];
    static iso_start start[ORBITS];
    static iso_batch_orbit orbit[ORBITS];
    static iso_sample sample[ORBITS * 2];
    iso_batch_options o = iso_batch_defaults();
    for (int i = 0; i < ORBITS; i++) {
        iso_params_reduced(ctx, k[i], (double[]){1.4, 2.1, 3.0}, &params[i]);
        iso_start_ball(ctx, starts[i], starts[i] + 3, ISO_SPIN_REFUSE, &start[i]);
        orbit[i] = (iso_batch_orbit){&params[i], &start[i], NULL};
    }
    int wrong = iso_batch_run(ctx, orbit, ORBITS, &o, times, 2, sample, NULL) != ISO_OK;
    for (int threads = 1; threads <= 3; threads += 2) {
        memset(rows, 0, sizeof rows);
        wrong += batch(scene, k, times, threads) != ISO_OK;
        for (int i = 0; i < 2 * ORBITS; i++) {
            wrong += rows[i * WIDTH] != sample[i].clock[0];
            wrong += memcmp(rows + i * WIDTH + 1, sample[i].ball, 6 * sizeof *rows) != 0;
        }
        gsl_test(wrong, "%d threads: the numbers of iso_batch_run", threads);
    }
}

/* A batch of one is the orbit by itself. A point whose start is replaced keeps the eps of the scene, if that states
 * one; else it has its own, with H = 0. */
static void check_one(const char *text, const char *other, const double y[6])
{
    double got[2][2 * WIDTH], wanted[2 * WIDTH];
    iso_scene *scene[2] = {made(text), made(other)};
    iso_solution *orbit;
    gsl_test(iso_solution_create(ctx, scene[1], &orbit) || iso_solution_at(orbit, times, 2, wanted, NULL, 0), "one");
    for (int i = 0; i < 2; i++) {
        const iso_scene *one = scene[i];
        gsl_test(iso_batch(ctx, &one, 1, 1, NULL, NULL, i ? NULL : y, times, 2, 1, NULL, got[i], NULL) != ISO_OK,
                 "%s", iso_context_message(ctx));
        iso_scene_free(scene[i]);
    }
    gsl_test(memcmp(got[0], got[1], sizeof got[0]) != 0, "%s with another start is another scene", text);
    for (int i = 0; i < 2 * WIDTH; i++) gsl_test_abs(got[1][i], wanted[i], 1e-11, "%s: number %d", other, i);
    iso_solution_free(orbit);
}

static bool stop_later(void *data)
{
    return --*(int *)data > 0;
}

/* A stop leaves rows, or not-a-number and a status that says so: in the middle, and before the first orbit. */
static void check_stop(const iso_scene *const *scene)
{
    const double far[2] = {1, 2000};
    for (int before = 0; before < 2; before++) {
        iso_slow_monitor *monitor;
        int left = before ? 1 : 3, wrong = 0, stopped = 0;
        memset(status, 0, sizeof status);
        memset(rows, 0, sizeof rows);
        gsl_test(iso_slow_monitor_create(ctx, 0, stop_later, &left, &monitor) != ISO_OK, "a monitor");
        gsl_test(batch(scene, NULL, far, 1) != ISO_STOPPED, "a batch stops");
        for (int i = 0; i < ORBITS; i++) {
            const bool whole = !isnan(rows[(2 * i + 1) * WIDTH]);
            stopped += status[i] == ISO_STOPPED;
            wrong += whole ? status[i] != ISO_OK : status[i] != ISO_STOPPED;
        }
        gsl_test(wrong || stopped == 0 || (before && stopped < ORBITS), "%d of %d orbits are stopped, and say so",
                 stopped, ORBITS);
        iso_context_set_monitor(ctx, NULL, NULL);
        iso_slow_monitor_free(monitor);
    }
}

/* How many orbits do not have the status and rows of those that fail: the three given ones alone. */
static int wrong_ones(const int fails[3])
{
    int wrong = 0;
    for (int i = 0; i < ORBITS; i++) {
        const bool failed = i == fails[0] || i == fails[1] || i == fails[2];
        wrong += (status[i] != ISO_OK) != failed || isnan(rows[(2 * i + 1) * WIDTH]) != failed;
    }
    return wrong;
}

static void check_failures(const iso_scene *const *scene)
{
    gsl_test(batch(scene, k, times, 0) != ISO_OK, "a batch");
    const double before = rows[2 * 610 * WIDTH + 1];
    k[5] = NAN, k[611] = 0, starts[612][5] = 2;
    gsl_test(batch(scene, k, times, 0) != ISO_BAD_INPUT || !begins("orbit 5: ") || !about("k"), "no ball: %s",
             iso_context_message(ctx));
    gsl_test(wrong_ones((int[]){5, 611, 612}) || rows[2 * 610 * WIDTH + 1] != before, "and only such orbits fail");
    starts[612][5] = 1;
    starts[600][0] = starts[650][0] = 1e13, starts[600][1] = starts[650][1] = 0;
    const iso_status found = batch(scene, NULL, (double[]){1, 1e4}, 0);
    gsl_test((int32_t)found != status[600] || !begins("orbit 600: "), "no orbit: %s", iso_context_message(ctx));
    gsl_test(wrong_ones((int[]){600, 650, 650}), "the others are there");
    status[3] = -7, rows[0] = -7;
    gsl_test(iso_batch(ctx, scene, 2, ORBITS, NULL, NULL, NULL, times, 2, 0, NULL, rows, status) !=
                     ISO_BAD_ARGUMENT ||
                 status[3] != -7 || rows[0] != -7,
             "two scenes for %d orbits", ORBITS);
    gsl_test(iso_batch(ctx, scene, 1, 0, NULL, NULL, NULL, times, 2, 0, NULL, NULL, NULL) != ISO_OK, "none");
}

#define WITH(eps, initial) "point: {k: -1, J: [1.4, 2.1, 3.0]" eps "}\ninitial: {" initial "}\n" TIME
#define HERE "gamma: [0.6, 0, 0.8], M: [0, 2.5, 0]"
#define THERE "gamma: [0, 0.6, 0.8], M: [0.5, 0, 0]"

int main(void)
{
    const double y[6] = {0.5, 0, 0, 0, 0.6, 0.8};
    ctx = iso_context_create();
    if (!ctx) return 1;
    for (int i = 0; i < ORBITS; i++) {
        k[i] = 0.5 + 0.001 * i;
        starts[i][0] = cos(i), starts[i][1] = sin(i), starts[i][5] = 1;
    }
    iso_scene *scene = made(FREE);
    const iso_scene *one = scene;
    check_batch(&one);
    check_stop(&one);
    check_failures(&one);
    check_one(WITH("", HERE), WITH("", THERE), y);
    check_one(WITH(", eps: 3", HERE), WITH(", eps: 3", THERE), y);
    iso_scene_free(scene);
    iso_context_free(ctx);
    return gsl_test_summary();
}
