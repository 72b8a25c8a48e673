/* Batches that cannot be, and orbits that fail, stop, stiffen or rest among others, lib/orbit/batch.h. */
#include <malloc.h>

#include "batches.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;
static iso_random *dice;

/* --- what cannot be --------------------------------------------------------------------------------------------- */

static iso_status refused(iso_batch_options o, const double times[], int rows)
{
    static batch_pool one;
    iso_status status[1];
    iso_sample samples[BATCH_ROWS];
    one.count = 0;
    batch_add(&one, laws_params(-1, orbit_J), batch_usual, NULL);
    return iso_batch_run(ctx, one.orbit, 1, &o, times, (size_t)rows, samples, status);
}

static void check_refusals(void)
{
    static const struct {
        double times[3];
        int rows;
        bool good;
    } cases[] = {{{1, 2, 1.5}, 3, false},      {{-1, -2, -1.5}, 3, false}, {{-1, 1, 2}, 3, false},
                 {{1, -1, -2}, 3, false},      {{1, NAN, 2}, 3, false},    {{1, 2, NAN}, 3, false},
                 {{1, 2, INFINITY}, 3, false}, {{-1, 0, -2}, 3, false},    {{1, 0, 2}, 3, false},
                 {{-1, 0, 0}, 3, false},       {{1, 2, 2}, 3, true},       {{0, -1, -2}, 3, true},
                 {{0, 0, 0}, 3, true},         {{-2, -2, -3}, 3, true},    {{NAN, 0, 0}, 0, true},
                 {{-INFINITY, 0, 0}, 1, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const iso_status status = refused(iso_batch_defaults(), cases[i].times, cases[i].rows);
        gsl_test(status != (cases[i].good ? ISO_OK : ISO_BAD_ARGUMENT), "times %g %g %g, %d: %s", cases[i].times[0],
                 cases[i].times[1], cases[i].times[2], cases[i].rows, iso_status_text(status));
    }
    enum { OPTIONS = 10 };
    static const double numbers[OPTIONS] = {NAN, 0, 9e-16, 0.11, -1, INFINITY, -1, -1000, 1025, 0};
    for (int i = 0; i < OPTIONS; i++) { /* tolerances, threads, and vectors that no processor has */
        const char *about = i < 6 ? "tolerance" : i < 9 ? "threads" : "vectors";
        iso_batch_options o = iso_batch_defaults();
        if (i < 6) o.tolerance = numbers[i];
        if (i >= 6 && i < 9) o.threads = (int)numbers[i];
        if (i == 9) o.vectors = "sse9";
        const iso_status status = refused(o, (double[]){1}, 1);
        gsl_test(status != ISO_BAD_ARGUMENT || strcmp(iso_context_about(ctx), about) != 0, "%s %g: %s", about,
                 numbers[i], iso_context_message(ctx));
    }
    gsl_test(iso_batch_run(ctx, NULL, 0, NULL, (double[]){1}, 1, NULL, NULL) != ISO_OK, "no orbits");
}

/* --- one that fails among others -------------------------------------------------------------------------------- */

static int blank_columns(const iso_sample *s)
{
    int blank = 0;
    for (int c = 0; c < ISO_TRAJECTORY_COLUMNS; c++) blank += isnan(iso_sample_column(s, c));
    return blank;
}

/* Two dozen good ones, and `bad` as number 5: its status and reason, its rows to `reached`, those of the others. */
static void check_failure(const iso_batch_options *options, const iso_batch_orbit *bad, double end,
                          iso_status expected, const char *reason, int reached)
{
    enum { COUNT = 25, ROWS = 4, PLACE = 5 };
    static batch_pool good;
    iso_batch_orbit orbits[COUNT];
    iso_status status[COUNT], calm[COUNT], whole, fine;
    const double times[ROWS] = {end / 1000, end / 100, end / 2, end};
    iso_batch_options one_thread = *options, *const o = &one_thread; /* so that lanes are refilled */
    one_thread.threads = 1;
    good.count = 0;
    for (int i = 0; i < COUNT - 1; i++) batch_add_random(&good, dice, 0.5, orbit_J, 1, 1, ISO_CLOCK_T, 0);
    for (int i = 0; i < COUNT; i++) orbits[i] = i == PLACE ? *bad : good.orbit[i - (i > PLACE)];
    iso_sample *truth = batch_run(ctx, good.orbit, COUNT - 1, o, times, ROWS, calm, &fine);
    iso_sample *samples = batch_run(ctx, orbits, COUNT, o, times, ROWS, status, &whole);
    char start[16];
    snprintf(start, sizeof start, "orbit %d: ", PLACE);
    const char *message = iso_context_message(ctx);
    gsl_test(fine != ISO_OK || whole != expected || status[PLACE] != expected ||
                 strncmp(message, start, strlen(start)) != 0 || !strstr(message, reason),
             "%s (%s)", message, reason);
    int rows = 0, wrong = 0;
    for (int j = 0; j < ROWS; j++) {
        const bool blank = blank_columns(&samples[PLACE * ROWS + j]) == ISO_TRAJECTORY_COLUMNS;
        rows += !blank && j == rows;
        wrong += !blank && j >= reached;
    }
    gsl_test(rows != reached || wrong > 0, "%s: %d rows reached, not %d", reason, rows, reached);
    for (int i = 0; i < COUNT; i++) {
        if (i == PLACE) continue;
        wrong += status[i] != ISO_OK;
        wrong += memcmp(&samples[i * ROWS], &truth[(i - (i > PLACE)) * ROWS], ROWS * sizeof *samples) != 0;
    }
    gsl_test(wrong, "%s: the others are as without it", reason);
    iso_sample *unsaid = batch_run(ctx, orbits, COUNT, o, times, ROWS, NULL, &fine);
    gsl_test(fine != whole || memcmp(unsaid, samples, COUNT * ROWS * sizeof *samples) != 0, "%s: statuses not asked",
             reason);
    free(truth), free(samples), free(unsaid);
}

static void check_failures(void)
{
    const iso_params p = laws_params(0.5, orbit_J), steep = laws_params(-2e-3, orbit_J);
    const iso_start start = batch_usual, rest = batch_start(0, 0, 0, 0.36, 0.48, 0.8);
    const iso_effects bad = {.on[ISO_GRAVITY] = true, .number[ISO_GRAVITY] = {NAN, 0, 0, 1}};
    const iso_effects level = {.on[ISO_LEVEL] = true, .number[ISO_LEVEL] = {0.3}};
    const iso_effects brake = {.on[ISO_ROLLING_RESISTANCE] = true, .number[ISO_ROLLING_RESISTANCE] = {10}};
    iso_batch_options o = iso_batch_defaults();
    check_failure(&o, &(iso_batch_orbit){&p, &start, &bad}, 4, ISO_BAD_INPUT, "mgb", 0);
    o.shown = ISO_SHOW_POINT;
    check_failure(&o, &(iso_batch_orbit){&p, &rest, NULL}, 4, ISO_NOT_MAPPED, "at rest", 0);
    o.shown = ISO_SHOW_BALL;
    check_failure(&o, &(iso_batch_orbit){&p, &start, &brake}, -40, ISO_NUMERICAL, "resistance drives the ball", 2);
    o.max_steps = 1000;
    check_failure(&o, &(iso_batch_orbit){&p, &start, &brake}, -40, ISO_NUMERICAL, "more steps than allowed", 2);
    o.max_steps = 0;
    o.backend = ISO_BACKEND_POINT;
    check_failure(&o, &(iso_batch_orbit){&steep, &start, &level}, 4, ISO_NUMERICAL, "diverges", 0);
}

/* M leaves the range of doubles on the way: no row from there on. */
static void check_range(void)
{
    static batch_pool one;
    const double J[3] = {1e200, 4e200, 9e200}, times[] = {1e-7, 3e-7, 5e-7, 7e-7, 9e-7};
    iso_batch_options o = iso_batch_defaults();
    o.shown = ISO_SHOW_BOTH;
    int failed = 0, wrong = 0;
    for (int i = 0; i < 40; i++) {
        iso_status status, whole;
        one.count = 0;
        const double w = 1e7 * pow(10, i / 40.0);
        batch_add(&one, laws_params(1, J), batch_start(w, 0, 0, 0, 0.8, 0.6), NULL);
        batch_add_random(&one, dice, 1, orbit_J, 1e200, w, ISO_CLOCK_T, 0);
        iso_sample *samples = batch_run(ctx, &one.orbit[1], 1, &o, times, 5, &status, &whole);
        bool before = false;
        for (int j = 0; j < 5; j++) {
            const int blank = blank_columns(&samples[j]);
            wrong += blank != ISO_TRAJECTORY_COLUMNS && (before || !isfinite(laws_max(12, samples[j].ball)));
            before = before || blank == ISO_TRAJECTORY_COLUMNS;
        }
        failed += status == ISO_NUMERICAL && blank_columns(&samples[0]) != ISO_TRAJECTORY_COLUMNS;
        free(samples);
    }
    gsl_test(failed == 0 || wrong > 0, "%d left the range on the way, %d rows behind that", failed, wrong);
}

/* Steps: as many as are allowed. */
static void check_steps(void)
{
    static batch_pool one;
    const double time = 100;
    iso_batch_options o = iso_batch_defaults();
    one.count = 0;
    batch_add(&one, laws_params(0.5, orbit_J), batch_usual, NULL);
    long least = 1;
    for (iso_status whole = ISO_NUMERICAL; whole != ISO_OK && least < 10000; least += whole != ISO_OK) {
        iso_status status;
        o.max_steps = least;
        free(batch_run(ctx, one.orbit, 1, &o, &time, 1, &status, &whole));
    }
    iso_orbit *path;
    iso_sample sample;
    iso_orbit_options alone = iso_orbit_defaults(&one.start[0]);
    alone.method = iso_method_find("taylor"), alone.backend = ISO_BACKEND_POINT;
    gsl_test(iso_orbit_create(ctx, &one.p[0], &one.start[0], &alone, &path) || iso_orbit_at(path, time, &sample),
             "alone");
    const long steps = iso_orbit_statistics(path).steps;
    iso_orbit_free(path);
    gsl_test(labs(steps - least) > 1, "%ld steps, alone %ld", least, steps);
}

/* A stiff contact among others: nearly the rubber ball. */
static void check_stiff(void)
{
    static batch_pool all;
    enum { COUNT = 20 };
    const double time = 10;
    const iso_effects firm = {.on[ISO_TWIST] = true, .number[ISO_TWIST] = {1e6}};
    const iso_start start = batch_usual;
    iso_params p = laws_params(0.5, orbit_J);
    iso_batch_options o = iso_batch_defaults();
    iso_status status[COUNT], whole;
    iso_params_set_D(ctx, 0.7, &p);
    all.count = 0;
    for (int i = 0; i < COUNT; i++)
        if (i % 7 == 3)
            batch_add(&all, p, start, &firm);
        else if (i % 7 == 4)
            batch_add(&all, p, start, NULL);
        else
            batch_add_random(&all, dice, 0.5, orbit_J, 1, 1, ISO_CLOCK_T, 0);
    iso_sample *samples = batch_run(ctx, all.orbit, COUNT, &o, &time, 1, status, &whole);
    for (int i = 3; i < COUNT; i += 7) {
        const double apart = laws_distance(samples[i].ball + 3, samples[i + 1].ball + 3);
        gsl_test(!(whole == ISO_OK && apart < 1e-4 && apart > 1e-8), "c = 1e6 is solved: %.1e from rubber", apart);
    }
    free(samples);
}

/* One at rest among moving ones stays where it is: its energy and second integral are 0, and nothing can be measured
 * by them. A point rests where eps = 0. */
static void check_rest(double k, iso_backend backend)
{
    static batch_pool all;
    enum { COUNT = 20, ROWS = 2, PLACE = 5 };
    const double times[ROWS] = {1, 10};
    iso_batch_options o = iso_batch_defaults();
    iso_start rest = batch_start(0, 0, 0, 0.36, 0.48, 0.8);
    iso_status status[COUNT], whole;
    o.backend = backend, o.shown = (iso_models)backend, o.threads = 1;
    rest.model = (iso_model_kind)backend, rest.eps = NAN;
    all.count = 0;
    for (int i = 0; i < COUNT; i++)
        if (i == PLACE)
            batch_add(&all, laws_params(k, orbit_J), rest, NULL);
        else
            batch_add_random(&all, dice, k, orbit_J, 1, 1, ISO_CLOCK_T, 0);
    iso_sample *samples = batch_run(ctx, all.orbit, COUNT, &o, times, ROWS, status, &whole);
    double moved = 0;
    for (int j = 0; j < ROWS; j++) {
        const iso_sample *s = &samples[PLACE * ROWS + j];
        const double *y = backend == ISO_BACKEND_BALL ? s->ball : s->point;
        const double part[3] = {moved, laws_norm(y), laws_distance(y + 3, rest.y + 3)};
        moved = laws_max(3, part);
    }
    gsl_test(!(whole == ISO_OK && moved < 4e-16), "k = %g, backend %d: at rest among others, moved %.1e: %s", k,
             (int)backend, moved, whole == ISO_OK ? "all well" : iso_context_message(ctx));
    free(samples);
}

/* --- stopped ---------------------------------------------------------------------------------------------------- */

/* Whatever is done by then is right, and said to be. */
static void check_stopped(int threads)
{
    enum { COUNT = 600, ROWS = 3 };
    static batch_pool all;
    const double times[ROWS] = {1, 5, 10};
    iso_batch_options o = iso_batch_defaults();
    iso_batch_orbit orbits[COUNT];
    iso_status status[COUNT], whole;
    batch_fill(&all, ctx, dice);
    o.max_steps = 1000;
    for (int i = 0; i < COUNT; i++) orbits[i] = all.orbit[i % all.count];
    iso_sample *truth = batch_run(ctx, all.orbit, all.count, &o, times, ROWS, status, &whole);
    iso_status expected[BATCH_ORBITS];
    memcpy(expected, status, sizeof expected);
    o.threads = threads;
    int wrong = 0, stopped = 0, done = 0, early = 0;
    for (int asks = 0; asks < 30000; asks = asks + asks / 2 + 1) {
        int left = asks;
        iso_context_set_monitor(ctx, some_times, &left);
        iso_sample *samples = batch_run(ctx, orbits, COUNT, &o, times, ROWS, status, &whole);
        iso_context_set_monitor(ctx, NULL, NULL);
        bool all_done = true;
        for (int i = 0; i < COUNT; i++) {
            const iso_sample *a = &samples[i * ROWS], *b = &truth[i % all.count * ROWS];
            stopped += status[i] == ISO_STOPPED;
            done += status[i] == ISO_OK;
            all_done = all_done && status[i] != ISO_STOPPED;
            wrong += status[i] != ISO_STOPPED && status[i] != expected[i % all.count];
            for (int j = 0; j < ROWS; j++)
                wrong += memcmp(&a[j], &b[j], sizeof *a) != 0 &&
                         (status[i] != ISO_STOPPED || blank_columns(&a[j]) != ISO_TRAJECTORY_COLUMNS);
        }
        early += whole == ISO_STOPPED;
        wrong += whole != ISO_STOPPED && !all_done;
        free(samples);
    }
    gsl_test(wrong > 0 || stopped == 0 || done == 0 || early == 0, "stopped on %d threads: %d, done %d, wrong %d",
             threads, stopped, done, wrong);
    free(truth);
}

int main(void)
{
    ctx = iso_context_create();
    dice = iso_random_create(2);
    mallopt(M_PERTURB, 0x5a); /* what was never written is seen */
    check_refusals();
    check_failures();
    check_range();
    check_steps();
    check_stiff();
    for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
        check_rest(1, backend);
        check_rest(-1, backend);
    }
    check_stopped(1);
    check_stopped(3);
    iso_random_free(dice);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
