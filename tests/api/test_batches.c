/* test_batches.c - iso_batch (api/interface.h): the numbers of the typed calls, stops, orbits that fail. */
#include "asked.h"
#include "orbit/batch.h"
#include "runs.h"
#include "study/study.h"

#define FREE REDUCED("0.5") TIME
enum { ORBITS = 700, WIDTH = 7 };

static iso_scene *made(const char *text)
{
    iso_scene *scene;
    laws_stop_if(ctx, iso_scene_parse(ctx, "scene", text, strlen(text), &scene) != ISO_OK, text);
    return scene;
}

static bool about(const char *words)
{
    return strcmp(iso_context_about(ctx), words) == 0;
}

static double k[ORBITS], starts[ORBITS][6], table[ORBITS * 2 * WIDTH];
static int32_t status[ORBITS];
static const double times[2] = {1, 3};

static void fill(void)
{
    for (int i = 0; i < ORBITS; i++) {
        k[i] = 0.5 + 0.001 * i;
        const double y[6] = {cos(i), sin(i), 0, 0, 0, 1};
        memcpy(starts[i], y, sizeof y);
    }
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
        memset(table, 0, sizeof table);
        wrong +=
            ISO_OK != iso_batch(ctx, scene, 1, ORBITS, k, NULL, starts[0], times, 2, threads, NULL, table, status);
        for (int i = 0; i < 2 * ORBITS; i++) {
            wrong += table[i * WIDTH] != sample[i].clock[0];
            wrong += memcmp(table + i * WIDTH + 1, sample[i].ball, 6 * sizeof *table) != 0;
        }
        gsl_test(wrong, "%d threads: the numbers of iso_batch_run", threads);
    }
}

static bool stop_later(void *data)
{
    return --*(int *)data > 0;
}

/* A stop leaves rows, or not-a-number and a status that says so. */
static void check_stop(const iso_scene *const *scene)
{
    const double far[2] = {1, 2000};
    iso_slow_monitor *monitor;
    int left = 3, wrong = 0, stopped = 0;
    gsl_test(iso_slow_monitor_create(ctx, 0, stop_later, &left, &monitor) != ISO_OK, "a monitor");
    gsl_test(iso_batch(ctx, scene, 1, ORBITS, NULL, NULL, starts[0], far, 2, 1, NULL, table, status) != ISO_STOPPED,
             "a batch stops");
    for (int i = 0; i < ORBITS; i++) {
        const bool whole = !isnan(table[(2 * i + 1) * WIDTH]);
        stopped += status[i] == ISO_STOPPED;
        wrong += whole ? status[i] != ISO_OK : status[i] != ISO_STOPPED;
    }
    gsl_test(wrong || stopped == 0, "%d of %d orbits are stopped, and say so", stopped, ORBITS);
    memset(status, 0, sizeof status);
    memset(table, 0, sizeof table);
    left = 1, wrong = 0;
    gsl_test(iso_batch(ctx, scene, 1, ORBITS, NULL, NULL, starts[0], far, 2, 1, NULL, table, status) != ISO_STOPPED,
             "it stops before the first orbit");
    for (int i = 0; i < ORBITS; i++) wrong += status[i] != ISO_STOPPED || !isnan(table[2 * i * WIDTH]);
    gsl_test(wrong, "and no orbit has a row");
    iso_context_set_monitor(ctx, NULL, NULL);
    iso_slow_monitor_free(monitor);
}

static void check_failures(const iso_scene *const *scene)
{
    int wrong = ISO_OK != iso_batch(ctx, scene, 1, ORBITS, k, NULL, starts[0], times, 2, 0, NULL, table, NULL);
    const double before = table[2 * 610 * WIDTH + 1];
    k[5] = NAN, k[611] = 0, starts[612][5] = 2;
    gsl_test(iso_batch(ctx, scene, 1, ORBITS, k, NULL, starts[0], times, 2, 0, NULL, table, status) !=
                     ISO_BAD_INPUT ||
                 strncmp(iso_context_message(ctx), "orbit 5: ", 9) != 0 || !about("k"),
             "no ball: %s", iso_context_message(ctx));
    for (int i = 0; i < ORBITS; i++) {
        const bool fails = i == 5 || i == 611 || i == 612;
        for (int j = 0; j < 2 * WIDTH; j++) wrong += fails != isnan(table[2 * i * WIDTH + j]);
        wrong += status[i] != (fails ? ISO_BAD_INPUT : ISO_OK);
    }
    gsl_test(wrong || table[2 * 610 * WIDTH + 1] != before, "and only such orbits fail");
    starts[612][5] = 1;
    starts[600][0] = 1e13, starts[600][1] = 0;
    starts[650][0] = 1e13, starts[650][1] = 0;
    const double late[2] = {1, 1e4};
    const iso_status found = iso_batch(ctx, scene, 1, ORBITS, NULL, NULL, starts[0], late, 2, 0, NULL, table, status);
    gsl_test((int32_t)found != status[600] || found == ISO_OK ||
                 strncmp(iso_context_message(ctx), "orbit 600: ", 11) != 0,
             "no orbit: %s", iso_context_message(ctx));
    wrong = 0;
    for (int i = 0; i < ORBITS; i++) wrong += (status[i] != ISO_OK) != (i == 600 || i == 650);
    gsl_test(wrong, "the others are there");
    status[3] = -7, table[0] = -7;
    gsl_test(iso_batch(ctx, scene, 2, ORBITS, NULL, NULL, NULL, times, 2, 0, NULL, table, status) !=
                     ISO_BAD_ARGUMENT ||
                 status[3] != -7 || table[0] != -7,
             "two scenes for %d orbits", ORBITS);
    gsl_test(iso_batch(ctx, scene, 1, 0, NULL, NULL, NULL, times, 2, 0, NULL, NULL, NULL) != ISO_OK, "none");
}

/* A point whose start is replaced keeps the eps of the scene, if that states one; else it has its own, with H = 0. */
static void check_coupling(const char *eps)
{
    char text[2][256];
    iso_scene *scene[2];
    const double y[6] = {0.5, 0, 0, 0, 0.6, 0.8};
    double rows[2][2 * WIDTH];
    static const char *const initial[] = {"gamma: [0.6, 0, 0.8], M: [0, 2.5, 0]",
                                          "gamma: [0, 0.6, 0.8], M: [0.5, 0, 0]"};
    for (int i = 0; i < 2; i++) {
        snprintf(text[i], sizeof text[i], "point: {k: -1, J: [1.4, 2.1, 3.0]%s}\ninitial: {%s}\n" TIME, eps,
                 initial[i]);
        scene[i] = made(text[i]);
        const iso_scene *one = scene[i];
        gsl_test(iso_batch(ctx, &one, 1, 1, NULL, NULL, i ? NULL : y, times, 2, 1, NULL, rows[i], NULL) != ISO_OK,
                 "a point");
        iso_scene_free(scene[i]);
    }
    gsl_test(memcmp(rows[0], rows[1], sizeof rows[0]) != 0 || !isfinite(rows[0][3]), "its eps is the scene's '%s'",
             eps);
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx) return 1;
    iso_scene *scene = made(FREE);
    const iso_scene *one = scene;
    fill();
    check_batch(&one);
    check_stop(&one);
    check_failures(&one);
    check_coupling("");
    check_coupling(", eps: 3");
    iso_scene_free(scene);
    iso_context_free(ctx);
    return gsl_test_summary();
}
