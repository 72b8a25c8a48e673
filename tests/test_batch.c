/* Many orbits at once, lib/orbit/batch.h: each as if it were alone, on any thread, beside whatever fails. */
#include <float.h>
#include <malloc.h>
#include <string.h>

#include "effects.h"
#include "map/state.h"
#include "orbit/batch.h"

static iso_context *ctx;
static iso_random *dice;

/* --- orbits ----------------------------------------------------------------------------------------------------- */

enum { ORBITS = 66, MOST_ROWS = 8 };

typedef struct pool {
    int count;
    iso_params p[ORBITS];
    iso_start start[ORBITS];
    iso_effects effects[ORBITS];
    iso_batch_orbit orbit[ORBITS];
} pool;

static iso_start start_of(double w1, double w2, double w3, double n1, double n2, double n3)
{
    return (iso_start){.model = ISO_BALL, .y = {w1, w2, w3, n1, n2, n3}};
}

static void add(pool *all, iso_params p, iso_start start, const iso_effects *effects)
{
    const int i = all->count++;
    all->p[i] = p;
    all->start[i] = start;
    if (effects) all->effects[i] = *effects;
    all->orbit[i] = (iso_batch_orbit){&all->p[i], &all->start[i], effects ? &all->effects[i] : NULL};
}

/* A random orbit that turns by about a radian while `clock` goes on by 1/speed; moments of inertia of size J_unit. */
static void add_random(pool *all, double k, const double J[3], double J_unit, double speed, iso_clock clock,
                       int subset)
{
    const double scaled[3] = {J[0] * J_unit, J[1] * J_unit, J[2] * J_unit};
    const iso_params p = effects_params(k, scaled, dice);
    iso_field f = {.p = p};
    iso_start start = {.model = ISO_BALL};
    iso_system_ball.sample(&f, dice, start.y);
    const double q = iso_system_ball.q(&p, start.y, NULL);
    scale(start.y, speed * iso_clock_rate(&p, clock, q, NULL) / fmax(1, fabs(k)) / laws_norm(start.y));
    const iso_effects e = effects_random(dice, &p, subset, iso_ball_energy(&p, start.y), laws_norm(start.y), q);
    add(all, p, start, subset ? &e : NULL);
}

/* The same start, said of the point: where numbers allow it. */
static void say_of_the_point(pool *all, int i)
{
    double y[ISO_STATE];
    iso_start start;
    iso_ball_to_point(&all->p[i], all->start[i].y, y);
    if (isnormal(laws_norm(y)) && iso_start_point(ctx, y, y + 3, NULL, true, &start) == ISO_OK) all->start[i] = start;
}

/* For each k an orbit of each kind of body: alone, in effects that keep the isomorphism, and in any. */
static void fill(pool *all, iso_clock clock, double J_unit, double speed)
{
    static const double ks[] = {1, -1, 0.5, -0.4, 0.05, -0.05, 0.12, 0.75, -2, 4, 50};
    static const double Js[][3] = {{1.4, 2.1, 3.0}, {2, 3, 2}, {3.0, 2.1, 1.4}, {2.2, 1.5, 3.1}, {0.01, 1, 100}};
    all->count = 0;
    for (int i = 0; i < ORBITS; i++) {
        const int kind = i / 11;
        const double k = ks[i % 11], *J = Js[kind == 5 && clock == ISO_CLOCK_T ? 4 : kind % 4];
        const int any = (int)iso_random_uniform(dice, 1, 1 << ISO_CLOCK);
        add_random(all, k, J, J_unit, speed, clock, kind < 2 || kind == 5 ? 0 : kind == 2 ? 1 << ISO_FIELD : any);
        if (kind % 2 == 1) say_of_the_point(all, i);
    }
}

static iso_sample *run(const iso_batch_orbit orbits[], int count, const iso_batch_options *o, const double times[],
                       int rows, iso_status status[], iso_status *all)
{
    iso_sample *samples = malloc(((size_t)count * (size_t)rows + 1) * sizeof *samples);
    if (!samples) exit(1);
    *all = iso_batch_run(ctx, orbits, (size_t)count, o, times, (size_t)rows, samples, status);
    return samples;
}

/* --- as by iso_orbit -------------------------------------------------------------------------------------------- */

static laws_worst right, statuses;

static iso_status orbit_alone(const iso_batch_orbit *orbit, const iso_batch_options *b, iso_picture backend,
                              const double times[], int rows, iso_sample out[])
{
    iso_orbit *path;
    iso_orbit_options o = {.effects = orbit->effects,
                           .backend = backend,
                           .method = iso_method_find("taylor"),
                           .tolerance = b->tolerance,
                           .max_steps = b->max_steps,
                           .clock = b->clock,
                           .show = b->show,
                           .carry = {b->carry[0], b->carry[1], b->carry[2]}};
    iso_status status = iso_orbit_create(ctx, orbit->params, orbit->start, &o, &path);
    for (int i = 0; i < rows; i++) {
        for (int c = 0; c < ISO_TRAJECTORY_COLUMNS; c++) iso_sample_set_column(&out[i], c, NAN);
        if (status == ISO_OK) status = iso_orbit_at(path, times[i], &out[i]);
    }
    iso_orbit_free(path);
    return status;
}

/* Largest difference: of a vector relative to its length, or to 1. */
static double difference(const iso_sample *a, const iso_sample *b)
{
    static const struct {
        int at, count;
        bool relative;
    } parts[] = {{0, 1, true},
                 {1, 1, true},
                 {2, 1, true},
                 {3, 3, true},
                 {6, 3, true},
                 {9, 3, true},
                 {12, 3, true},
                 {ISO_COLUMN_GRAVITY, 3, true},
                 {ISO_COLUMN_ATTITUDE, 4, false},
                 {ISO_COLUMN_ATTITUDE + 4, 3, false},
                 {ISO_COLUMN_ATTITUDE + 7, 3, false},
                 {ISO_COLUMN_ATTITUDE + 10, 3, false},
                 {ISO_COLUMN_REACTIONS, 3, true}};
    double worst = 0;
    for (int c = 0; c < ISO_TRAJECTORY_COLUMNS; c++)
        if (isnan(iso_sample_column(a, c)) != isnan(iso_sample_column(b, c))) return INFINITY;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        double size = parts[i].relative ? 0 : 1, apart = 0;
        if (isnan(iso_sample_column(b, parts[i].at))) continue; /* not shown */
        for (int j = 0; j < parts[i].count; j++) {
            const double x = iso_sample_column(a, parts[i].at + j), y = iso_sample_column(b, parts[i].at + j);
            size = fmax(size, fabs(y));
            apart = fmax(apart, fabs(x - y));
        }
        if (apart > 0) worst = fmax(worst, apart / size);
    }
    return worst;
}

/* The two start from roundings apart, which long bodies and steep powers of q amplify. */
static double allowed(const iso_params *p)
{
    return 1e-13 * (1 + 1 / fabs(p->k) + fabs(p->k) / 5) * pow(laws_spread(p), 1.25);
}

/* The batch may choose the backend, what comes out is the same. */
static void compare(const pool *all, const iso_batch_options *o, const double times[], int rows)
{
    iso_status status[ORBITS], whole;
    iso_sample *samples = run(all->orbit, all->count, o, times, rows, status, &whole);
    iso_status first = ISO_OK;
    for (int i = all->count - 1; i >= 0; i--) {
        iso_sample truth[MOST_ROWS];
        char name[80];
        const iso_params *p = &all->p[i];
        const iso_status expected = orbit_alone(&all->orbit[i], o, o->backend, times, rows, truth);
        if (expected != ISO_OK) first = expected;
        snprintf(name, sizeof name, "orbit %d, backend %d, clock %d, show %d, J = %g", i, (int)o->backend,
                 (int)o->clock, (int)o->show, p->J[0]);
        laws_note(&statuses, abs((int)status[i] - (int)expected), 0.5, p, name);
        for (int j = 0; j < rows; j++)
            laws_note(&right, difference(&samples[i * rows + j], &truth[j]), allowed(p), p, name);
    }
    laws_note(&statuses, abs((int)whole - (int)first), 0.5, &all->p[0], "of all");
    free(samples);
}

static void check_right(void)
{
    static pool all;
    static const double units[] = {1, 1e-100, 1e100, 1e-30};
    int codes = 0;
    while (iso_batch_vectors(codes, NULL)) codes++;
    for (int variant = 0; variant < 36; variant++) {
        iso_batch_options o = iso_batch_defaults();
        o.tolerance = 1e-15;
        o.max_steps = 2000; /* small k in s and long bodies of the point need very many */
        o.backend = (const iso_picture[]){ISO_AUTO, ISO_BALL, ISO_POINT}[variant % 3];
        o.clock = (iso_clock)(variant / 3 % 3);
        o.vectors = iso_batch_vectors(variant % codes, NULL);
        o.show = (iso_picture)(variant / 9 % 4 % 3);
        for (int c = 0; c < ISO_CLOCKS; c++) o.carry[c] = variant % 2 == 0;
        const bool t_alone = o.clock == ISO_CLOCK_T;
        const double J_unit = t_alone ? units[variant / 9] : 1, speed = t_alone ? units[(variant / 9 + 2) % 4] : 1;
        const double sign = variant % 4 < 2 ? 1 : -1, unit = sign / speed;
        fill(&all, o.clock, J_unit, speed);
        compare(&all, &o, (double[]){0.3 * unit, 0.3 * unit, 1.7 * unit, 4 * unit}, 4);
    }
    laws_report(&right, "samples as by iso_orbit");
    laws_report(&statuses, "statuses as by iso_orbit");
}

/* --- not by a bit ----------------------------------------------------------------------------------------------- */

/* Neighbours of every kind: in principal planes with zeros of both signs, stiff, at rest, refused, and so fast that
 * the series has no numbers. */
static void add_odd(pool *all, int i, const iso_params *p)
{
    static iso_effects stiff = {.on[ISO_TWIST] = true, .twist = 1e6}, wrong = {.on[ISO_GRAVITY] = true, .mgb = NAN};
    iso_params loose = laws_params(0.5, p->J);
    iso_params_set_D(ctx, 0.5 * min3(p->J), &loose);
    switch (i % 8) {
    case 0: add(all, *p, start_of(0.0, -0.0, -0.7, 0.6, 0.8, -0.0), NULL); return;
    case 1: add(all, *p, start_of(-0.0, 0.0, 0.7, -0.6, 0.8, 0.0), NULL); return;
    case 2: add(all, *p, start_of(0.9, -0.0, 0.0, -0.0, 0.0, -1), NULL); return;
    case 3: add(all, loose, start_of(0.9, -0.3, -0.225, 0.36, 0.48, 0.8), &stiff); return;
    case 4: add(all, *p, start_of(0, 0, 0, 0.36, 0.48, 0.8), NULL); return;
    case 5: add(all, *p, start_of(0.9, -0.3, -0.225, 0.36, 0.48, 0.8), &wrong); return;
    case 6: add(all, laws_params(1e12, p->J), start_of(0.9, -0.3, -0.225, 0.36, 0.48, 0.8), NULL); return;
    default: add(all, *p, start_of(NAN, 0, 0, 0, 0, 1), NULL); return;
    }
}

static void fill_mixed(pool *all)
{
    static const double J[][3] = {{1.4, 2.1, 3.0}, {3.0, 1.4, 2.1}, {2, 2, 3}};
    static const double ks[] = {1, -1, 0.5, -0.4, 0.3};
    all->count = 0;
    for (int i = 0; i < ORBITS; i++) {
        const double k = ks[i % 5], *own = J[i / 5 % 3];
        if (i % 3 == 2) {
            const iso_params p = laws_params(k, own);
            add_odd(all, i / 3, &p);
        } else
            add_random(all, k, own, 1, 1, ISO_CLOCK_T,
                       i % 4 == 1 ? (int)iso_random_uniform(dice, 1, 1 << ISO_CLOCK) : 0);
    }
}

static laws_worst bits;

static void same(const pool *all, int i, const iso_sample *a, const iso_sample *b, int rows, const char *what)
{
    const bool equal = memcmp(a, b, (size_t)rows * sizeof *a) == 0;
    char name[64];
    snprintf(name, sizeof name, "orbit %d, %s", i, what);
    laws_note(&bits, equal ? 0 : 1, 0.5, &all->p[i], name);
}

/* Any order, any company, any number of threads, any other rows. */
static void check_bits(const iso_batch_options *options)
{
    static pool all;
    static const double times[] = {0.5, 3, 3, 20}, more[] = {0, 0.1, 0.5, 3, 3, 3.5, 19, 20};
    enum { ROWS = sizeof times / sizeof *times, MORE = sizeof more / sizeof *more };
    static const int place[ROWS] = {2, 3, 4, 7};
    iso_batch_options o = *options;
    iso_status status[ORBITS], again[ORBITS], whole, one;
    fill_mixed(&all);
    iso_sample *truth = run(all.orbit, all.count, &o, times, ROWS, status, &whole);
    static const int threads[] = {1, 2, 3, 7};
    for (int t = 0; t < 4; t++) {
        iso_batch_orbit mixed[ORBITS];
        int from[ORBITS], count = 0;
        for (int i = 0; i < all.count; i++)
            if (t == 0 || iso_random_uniform(dice, 0, 1) < 0.7) from[count++] = i;
        for (int i = count - 1; i > 0; i--) {
            const int j = (int)iso_random_uniform(dice, 0, i + 1), swapped = from[i];
            from[i] = from[j], from[j] = swapped;
        }
        for (int i = 0; i < count; i++) mixed[i] = all.orbit[from[i]];
        o.threads = threads[t];
        iso_sample *others = run(mixed, count, &o, times, ROWS, again, &one);
        for (int i = 0; i < count; i++) {
            same(&all, from[i], &truth[from[i] * ROWS], &others[i * ROWS], ROWS, "in other company");
            laws_note(&bits, abs((int)again[i] - (int)status[from[i]]), 0.5, &all.p[from[i]], "its status");
        }
        free(others);
    }
    iso_sample *finer = run(all.orbit, all.count, &o, more, MORE, again, &one);
    for (int i = 0; i < all.count; i++) {
        iso_sample *alone = run(&all.orbit[i], 1, &o, times, ROWS, again, &one);
        same(&all, i, &truth[i * ROWS], alone, ROWS, "alone");
        for (int j = 0; j < ROWS && status[i] == ISO_OK; j++)
            same(&all, i, &truth[i * ROWS + j], &finer[i * MORE + place[j]], 1, "more rows");
        free(alone);
    }
    free(finer);
    free(truth);
}

/* --- what cannot be --------------------------------------------------------------------------------------------- */

static const double J_three[3] = {1.4, 2.1, 3.0};

static iso_status refused(iso_batch_options o, const double times[], int rows)
{
    static pool one;
    iso_status status[1];
    iso_sample samples[MOST_ROWS];
    one.count = 0;
    add(&one, laws_params(-1, J_three), start_of(0.9, -0.3, -0.225, 0.36, 0.48, 0.8), NULL);
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
    static const double tolerances[] = {NAN, 0, 9e-16, 0.11, -1, INFINITY};
    static const int threads[] = {-1, -1000, 1025};
    const double time = 1;
    for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
        iso_batch_options o = iso_batch_defaults();
        o.tolerance = tolerances[i];
        const iso_status status = refused(o, &time, 1);
        gsl_test(status != ISO_BAD_ARGUMENT || strcmp(iso_context_field(ctx), "tolerance") != 0, "tolerance %g: %s",
                 o.tolerance, iso_context_message(ctx));
    }
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        iso_batch_options o = iso_batch_defaults();
        o.threads = threads[i];
        const iso_status status = refused(o, &time, 1);
        gsl_test(status != ISO_BAD_ARGUMENT || strcmp(iso_context_field(ctx), "threads") != 0, "%s",
                 iso_context_message(ctx));
    }
    iso_batch_options o = iso_batch_defaults();
    o.vectors = "sse9";
    gsl_test(refused(o, &time, 1) != ISO_BAD_ARGUMENT, "vectors 'sse9' are refused");
    o.vectors = NULL;
    gsl_test(iso_batch_run(ctx, NULL, 0, &o, &time, 1, NULL, NULL), "no orbits");
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
    static pool good;
    iso_batch_orbit orbits[COUNT];
    iso_status status[COUNT], calm[COUNT], whole, fine;
    const double times[ROWS] = {end / 1000, end / 100, end / 2, end};
    iso_batch_options one_thread = *options, *const o = &one_thread; /* so that lanes are refilled */
    one_thread.threads = 1;
    good.count = 0;
    for (int i = 0; i < COUNT - 1; i++) add_random(&good, 0.5, J_three, 1, 1, ISO_CLOCK_T, 0);
    for (int i = 0; i < COUNT; i++) orbits[i] = i == PLACE ? *bad : good.orbit[i - (i > PLACE)];
    iso_sample *truth = run(good.orbit, COUNT - 1, o, times, ROWS, calm, &fine);
    iso_sample *samples = run(orbits, COUNT, o, times, ROWS, status, &whole);
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
    iso_sample *unsaid = run(orbits, COUNT, o, times, ROWS, NULL, &fine);
    gsl_test(fine != whole || memcmp(unsaid, samples, COUNT * ROWS * sizeof *samples) != 0, "%s: statuses not asked",
             reason);
    free(truth), free(samples), free(unsaid);
}

static void check_failures(void)
{
    const iso_params p = laws_params(0.5, J_three), fast = laws_params(1e12, J_three);
    const iso_start start = start_of(0.9, -0.3, -0.225, 0.36, 0.48, 0.8), rest = start_of(0, 0, 0, 0.36, 0.48, 0.8);
    const iso_effects bad = {.on[ISO_GRAVITY] = true, .mgb = NAN, .up = {0, 0, 1}};
    const iso_effects brake = {.on[ISO_ROLLING_RESISTANCE] = true, .resistance = 10};
    iso_batch_options o = iso_batch_defaults();
    check_failure(&o, &(iso_batch_orbit){&p, &start, &bad}, 4, ISO_BAD_INPUT, "mgb", 0);
    o.show = ISO_POINT;
    check_failure(&o, &(iso_batch_orbit){&p, &rest, NULL}, 4, ISO_NOT_MAPPED, "at rest", 0);
    o.show = ISO_BALL;
    o.max_steps = 2000;
    check_failure(&o, &(iso_batch_orbit){&p, &start, &brake}, -40, ISO_NUMERICAL, "more steps than allowed", 2);
    o.max_steps = 0;
    o.backend = ISO_BALL;
    o.tolerance = 1e-15;
    check_failure(&o, &(iso_batch_orbit){&fast, &start, NULL}, 4, ISO_NUMERICAL, "diverges", 0);
}

/* M leaves the range of doubles on the way: no row from there on. */
static void check_range(void)
{
    static pool one;
    const double J[3] = {1e200, 4e200, 9e200}, times[] = {1e-7, 3e-7, 5e-7, 7e-7, 9e-7};
    iso_batch_options o = iso_batch_defaults();
    o.show = ISO_BOTH;
    int failed = 0, wrong = 0;
    for (int i = 0; i < 40; i++) {
        iso_status status, whole;
        one.count = 0;
        const double w = 1e7 * pow(10, i / 40.0);
        add(&one, laws_params(1, J), start_of(w, 0, 0, 0, 0.8, 0.6), NULL);
        add_random(&one, 1, J_three, 1e200, w, ISO_CLOCK_T, 0);
        iso_sample *samples = run(&one.orbit[1], 1, &o, times, 5, &status, &whole);
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
    static pool one;
    const double time = 100;
    iso_batch_options o = iso_batch_defaults();
    one.count = 0;
    add(&one, laws_params(0.5, J_three), start_of(0.9, -0.3, -0.225, 0.36, 0.48, 0.8), NULL);
    long least = 1;
    for (iso_status whole = ISO_NUMERICAL; whole != ISO_OK && least < 10000; least += whole != ISO_OK) {
        iso_status status;
        o.max_steps = least;
        free(run(one.orbit, 1, &o, &time, 1, &status, &whole));
    }
    iso_orbit *path;
    iso_sample sample;
    iso_orbit_options alone = iso_orbit_defaults(&one.start[0]);
    alone.method = iso_method_find("taylor"), alone.backend = ISO_POINT;
    gsl_test(iso_orbit_create(ctx, &one.p[0], &one.start[0], &alone, &path) || iso_orbit_at(path, time, &sample),
             "alone");
    const long steps = iso_orbit_statistics(path).steps;
    iso_orbit_free(path);
    gsl_test(labs(steps - least) > 1, "%ld steps, alone %ld", least, steps);
}

/* A stiff contact among others: nearly the rubber ball. */
static void check_stiff(void)
{
    static pool all;
    enum { COUNT = 20 };
    const double time = 10;
    const iso_effects firm = {.on[ISO_TWIST] = true, .twist = 1e6};
    const iso_start start = start_of(0.9, -0.3, -0.225, 0.36, 0.48, 0.8);
    iso_params p = laws_params(0.5, J_three);
    iso_batch_options o = iso_batch_defaults();
    iso_status status[COUNT], whole;
    iso_params_set_D(ctx, 0.7, &p);
    all.count = 0;
    for (int i = 0; i < COUNT; i++)
        if (i % 7 == 3)
            add(&all, p, start, &firm);
        else if (i % 7 == 4)
            add(&all, p, start, NULL);
        else
            add_random(&all, 0.5, J_three, 1, 1, ISO_CLOCK_T, 0);
    iso_sample *samples = run(all.orbit, COUNT, &o, &time, 1, status, &whole);
    for (int i = 3; i < COUNT; i += 7) {
        const double apart = laws_distance(samples[i].ball + 3, samples[i + 1].ball + 3);
        gsl_test(!(whole == ISO_OK && apart < 1e-4 && apart > 1e-8), "c = 1e6 is solved: %.1e from rubber", apart);
    }
    free(samples);
}

/* --- stopped ---------------------------------------------------------------------------------------------------- */

static bool some_times(void *data)
{
    return --*(long *)data >= 0;
}

/* Whatever is done by then is right, and said to be. */
static void check_stopped(int threads)
{
    enum { COUNT = 600, ROWS = 3 };
    static pool all;
    const double times[ROWS] = {1, 5, 10};
    iso_batch_options o = iso_batch_defaults();
    iso_batch_orbit orbits[COUNT];
    iso_status status[COUNT], whole;
    fill_mixed(&all);
    o.max_steps = 1000;
    for (int i = 0; i < COUNT; i++) orbits[i] = all.orbit[i % all.count];
    iso_sample *truth = run(all.orbit, all.count, &o, times, ROWS, status, &whole);
    iso_status expected[ORBITS];
    memcpy(expected, status, sizeof expected);
    o.threads = threads;
    int wrong = 0, stopped = 0, done = 0, early = 0;
    for (long asks = 0; asks < 30000; asks = asks + asks / 2 + 1) {
        long left = asks;
        iso_context_watch(ctx, some_times, &left);
        iso_sample *samples = run(orbits, COUNT, &o, times, ROWS, status, &whole);
        iso_context_watch(ctx, NULL, NULL);
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

/* --- what is conserved ------------------------------------------------------------------------------------------ */

static void check_conserved(iso_picture backend)
{
    static pool all;
    laws_worst worst = {0};
    const iso_system *system = backend == ISO_BALL ? &iso_system_ball : &iso_system_point;
    const double time = 1000;
    iso_batch_options o = iso_batch_defaults();
    iso_status status[ORBITS], whole;
    static const double ks[] = {1, -1, 0.5, -0.4, 0.75, 1.5};
    o.tolerance = 1e-15, o.backend = o.show = backend;
    all.count = 0;
    for (int i = 0; i < ORBITS; i++) add_random(&all, ks[i % 6], J_three, 1, 1, ISO_CLOCK_T, 0);
    iso_sample *samples = run(all.orbit, all.count, &o, &time, 1, status, &whole);
    for (int i = 0; i < all.count; i++) {
        const double *y = backend == ISO_BALL ? samples[i].ball : samples[i].point,
                     energy = iso_ball_energy(&all.p[i], all.start[i].y);
        iso_field f = {.p = all.p[i], .eps = iso_coupling(&all.p[i], energy)};
        double size;
        const double now = system->integrals[0].value(&f, y, &size), before = backend == ISO_BALL ? energy : 0;
        const long double n2 = (long double)y[3] * y[3] + (long double)y[4] * y[4] + (long double)y[5] * y[5];
        const long double wn = (long double)y[0] * y[3] + (long double)y[1] * y[4] + (long double)y[2] * y[5];
        laws_note(&worst, (double)fabsl(sqrtl(n2) - 1), 3e-16, &f.p, "|n|");
        laws_note(&worst, (double)fabsl(wn) / norm(y), 3e-16, &f.p, "(w,n)");
        laws_note(&worst, fabs(now - before) / size, 2e-15, &f.p, "energy");
    }
    laws_report(&worst,
                backend == ISO_BALL ? "ball: conserved over 1000 radians" : "point: conserved over 1000 radians");
    free(samples);
}

int main(void)
{
    gsl_test_verbose(1);
    ctx = iso_context_create();
    dice = iso_random_create(11);
    mallopt(M_PERTURB, 0x5a); /* what was never written is seen */
    for (int i = 0, lanes; iso_batch_vectors(i, &lanes); i++)
        printf("vectors here: %s, %d orbits in each\n", iso_batch_vectors(i, &lanes), lanes);
    check_right();
    iso_batch_options o = iso_batch_defaults();
    o.max_steps = 1000;
    for (int i = 0; (o.vectors = iso_batch_vectors(i, NULL)) != NULL; i++)
        for (o.backend = ISO_BALL; o.backend <= ISO_POINT; o.backend++) check_bits(&o);
    o.backend = ISO_AUTO, o.clock = ISO_CLOCK_S, o.tolerance = 1e-15;
    for (int c = 0; c < ISO_CLOCKS; c++) o.carry[c] = true;
    check_bits(&o);
    laws_report(&bits, "no orbit feels another, by a bit");
    check_refusals();
    check_failures();
    check_range();
    check_steps();
    check_stiff();
    check_stopped(1);
    check_stopped(3);
    check_conserved(ISO_BALL);
    check_conserved(ISO_POINT);
    iso_random_free(dice);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
