/* Many orbits at once, lib/orbit/batch.h: each as if it were alone, on any thread, for as long as one likes. */
#include <malloc.h>

#include "batches.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;
static iso_random *dice;

/* The same start, said of the point: where numbers allow it. */
static void say_of_the_point(batch_pool *all, int i)
{
    double y[ISO_STATE];
    iso_start start;
    iso_ball_to_point(&all->p[i], all->start[i].y, y);
    if (isnormal(laws_norm(y)) && iso_start_point(ctx, y, y + 3, NULL, true, &start) == ISO_OK) all->start[i] = start;
}

/* For each k an orbit of each kind of body: alone, in effects that keep the isomorphism, and in any. */
static void fill(batch_pool *all, iso_clock clock, double J_unit, double speed)
{
    static const double ks[] = {1, -1, 0.5, -0.4, 0.05, -0.05, 0.12, 0.75, -2, 4, 50};
    static const double Js[][3] = {{1.4, 2.1, 3.0}, {2, 3, 2}, {3.0, 2.1, 1.4}, {2.2, 1.5, 3.1}, {0.01, 1, 100}};
    all->count = 0;
    for (int i = 0; i < BATCH_ORBITS; i++) {
        const int kind = i / 11;
        const double k = ks[i % 11], *J = Js[kind == 5 && clock == ISO_CLOCK_T ? 4 : kind % 4];
        const int any = (int)iso_random_uniform(dice, 1, 1 << ISO_CLOCK);
        const int subset = kind < 2 || kind == 5 ? 0 : kind == 2 ? 1 << ISO_FIELD : any;
        batch_add_random(all, dice, k, J, J_unit, speed, clock, subset);
        if (kind % 2 == 1) say_of_the_point(all, i);
    }
}

/* --- as by iso_orbit -------------------------------------------------------------------------------------------- */

static laws_worst right, statuses;

static iso_status orbit_alone(const iso_batch_orbit *one, const iso_batch_options *b, iso_backend backend,
                              const double times[], int rows, iso_sample out[])
{
    iso_orbit *path;
    iso_orbit_options o = {.effects = one->effects,
                           .backend = backend,
                           .method = iso_method_find("taylor"),
                           .tolerance = b->tolerance,
                           .max_steps = b->max_steps,
                           .clock = b->clock,
                           .shown = b->shown,
                           .with_clock = {b->with_clock[0], b->with_clock[1], b->with_clock[2]}};
    iso_status status = iso_orbit_create(ctx, one->params, one->start, &o, &path);
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
    const struct {
        int at, count;
        bool relative;
    } parts[] = {{0, 1, true},
                 {1, 1, true},
                 {2, 1, true},
                 {3, 3, true},
                 {6, 3, true},
                 {9, 3, true},
                 {12, 3, true},
                 {column_of("e"), 3, true},
                 {column_of("q"), 4, false},
                 {column_of("contact"), 3, false},
                 {column_of("trace"), 3, false},
                 {column_of("centre"), 3, false},
                 {column_of("N"), 3, true}};
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

/* The two start from roundings apart. Long bodies and steep powers of q amplify these, and so does resistance
 * backwards in time: as much as it does omega. */
static double allowed(const iso_params *p, const iso_start *start, const iso_sample *sample)
{
    const double before = laws_norm(start->y), now = laws_norm(sample->ball), driven = before > 0 ? now / before : 1;
    return 1e-13 * (1 + 1 / fabs(p->k) + fabs(p->k) / 5) * pow(laws_spread(p), 1.25) * (driven > 1 ? driven : 1);
}

/* The batch may choose the backend, what comes out is the same. */
static void compare(const batch_pool *all, const iso_batch_options *o, const double times[], int rows)
{
    iso_status status[BATCH_ORBITS], whole;
    iso_sample *samples = batch_run(ctx, all->orbit, all->count, o, times, rows, status, &whole);
    iso_status first = ISO_OK;
    for (int i = all->count - 1; i >= 0; i--) {
        iso_sample truth[BATCH_ROWS];
        char name[80];
        const iso_params *p = &all->p[i];
        const iso_status expected = orbit_alone(&all->orbit[i], o, o->backend, times, rows, truth);
        if (expected != ISO_OK) first = expected;
        snprintf(name, sizeof name, "orbit %d, backend %d, clock %d, show %d, J = %g", i, (int)o->backend,
                 (int)o->clock, (int)o->shown, p->J[0]);
        laws_note(&statuses, abs((int)status[i] - (int)expected), 0.5, p, name);
        for (int j = 0; j < rows; j++)
            laws_note(&right, difference(&samples[i * rows + j], &truth[j]), allowed(p, &all->start[i], &truth[j]), p,
                      name);
    }
    laws_note(&statuses, abs((int)whole - (int)first), 0.5, &all->p[0], "of all");
    free(samples);
}

static void check_right(void)
{
    static batch_pool all;
    static const double units[] = {1, 1e-100, 1e100, 1e-30};
    int codes = 0;
    while (iso_batch_vectors(codes, NULL)) codes++;
    for (int variant = 0; variant < 36; variant++) {
        iso_batch_options o = iso_batch_defaults();
        o.tolerance = 1e-15;
        o.max_steps = 2000; /* small k in s and long bodies of the point need very many */
        o.backend = (const iso_backend[]){ISO_BACKEND_AUTO, ISO_BACKEND_BALL, ISO_BACKEND_POINT}[variant % 3];
        o.clock = (iso_clock)(variant / 3 % 3);
        o.vectors = iso_batch_vectors(variant % codes, NULL);
        o.shown = (iso_models)(variant / 9 % 4 % 3);
        for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = variant % 2 == 0;
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

static laws_worst bits;

static void same(const batch_pool *all, int i, const iso_sample *a, const iso_sample *b, int rows, const char *what)
{
    const bool equal = memcmp(a, b, (size_t)rows * sizeof *a) == 0;
    char name[64];
    snprintf(name, sizeof name, "orbit %d, %s", i, what);
    laws_note(&bits, equal ? 0 : 1, 0.5, &all->p[i], name);
}

/* Any order, any company, any number of threads, any other rows. */
static void check_bits(const iso_batch_options *options)
{
    static batch_pool all;
    static const double times[] = {0.5, 3, 3, 20}, more[] = {0, 0.1, 0.5, 3, 3, 3.5, 19, 20};
    enum { ROWS = sizeof times / sizeof *times, MORE = sizeof more / sizeof *more };
    static const int place[ROWS] = {2, 3, 4, 7};
    iso_batch_options o = *options;
    iso_status status[BATCH_ORBITS], again[BATCH_ORBITS], whole, one;
    batch_fill(&all, ctx, dice);
    iso_sample *truth = batch_run(ctx, all.orbit, all.count, &o, times, ROWS, status, &whole);
    static const int threads[] = {1, 2, 3, 7};
    for (int t = 0; t < 4; t++) {
        iso_batch_orbit mixed[BATCH_ORBITS];
        int from[BATCH_ORBITS], count = 0;
        for (int i = 0; i < all.count; i++)
            if (t == 0 || iso_random_uniform(dice, 0, 1) < 0.7) from[count++] = i;
        for (int i = count - 1; i > 0; i--) {
            const int j = (int)iso_random_uniform(dice, 0, i + 1), swapped = from[i];
            from[i] = from[j], from[j] = swapped;
        }
        for (int i = 0; i < count; i++) mixed[i] = all.orbit[from[i]];
        o.threads = threads[t];
        iso_sample *others = batch_run(ctx, mixed, count, &o, times, ROWS, again, &one);
        for (int i = 0; i < count; i++) {
            same(&all, from[i], &truth[from[i] * ROWS], &others[i * ROWS], ROWS, "in other company");
            laws_note(&bits, abs((int)again[i] - (int)status[from[i]]), 0.5, &all.p[from[i]], "its status");
        }
        free(others);
    }
    iso_sample *finer = batch_run(ctx, all.orbit, all.count, &o, more, MORE, again, &one);
    for (int i = 0; i < all.count; i++) {
        iso_sample *alone = batch_run(ctx, &all.orbit[i], 1, &o, times, ROWS, again, &one);
        same(&all, i, &truth[i * ROWS], alone, ROWS, "alone");
        for (int j = 0; j < ROWS && status[i] == ISO_OK; j++)
            same(&all, i, &truth[i * ROWS + j], &finer[i * MORE + place[j]], 1, "more rows");
        free(alone);
    }
    free(finer);
    free(truth);
}

static void check_conserved(iso_backend backend)
{
    static batch_pool all;
    laws_worst worst = {0};
    const iso_system *system = backend == ISO_BACKEND_BALL ? &iso_system_ball : &iso_system_point;
    const double time = 1000;
    iso_batch_options o = iso_batch_defaults();
    iso_status status[BATCH_ORBITS], whole;
    static const double ks[] = {1, -1, 0.5, -0.4, 0.75, 1.5};
    o.tolerance = 1e-15, o.backend = backend, o.shown = (iso_models)backend;
    all.count = 0;
    for (int i = 0; i < BATCH_ORBITS; i++) batch_add_random(&all, dice, ks[i % 6], orbit_J, 1, 1, ISO_CLOCK_T, 0);
    iso_sample *samples = batch_run(ctx, all.orbit, all.count, &o, &time, 1, status, &whole);
    for (int i = 0; i < all.count; i++) {
        const double *y = backend == ISO_BACKEND_BALL ? samples[i].ball : samples[i].point,
                     energy = iso_ball_energy(&all.p[i], all.start[i].y);
        iso_problem f = {.p = all.p[i], .eps = iso_coupling(&all.p[i], energy)};
        double size;
        const double now = system->energy(&f, y, &size), before = backend == ISO_BACKEND_BALL ? energy : 0;
        const long double n2 = (long double)y[3] * y[3] + (long double)y[4] * y[4] + (long double)y[5] * y[5];
        const long double wn = (long double)y[0] * y[3] + (long double)y[1] * y[4] + (long double)y[2] * y[5];
        laws_note(&worst, (double)fabsl(sqrtl(n2) - 1), 3e-16, &f.p, "|n|");
        laws_note(&worst, (double)fabsl(wn) / norm(y), 3e-16, &f.p, "(w,n)");
        laws_note(&worst, fabs(now - before) / size, 2e-15, &f.p, "energy");
    }
    laws_report(&worst, backend == ISO_BACKEND_BALL ? "ball: conserved over 1000 radians"
                                                    : "point: conserved over 1000 radians");
    free(samples);
}

int main(void)
{
    ctx = iso_context_create();
    dice = iso_random_create(11);
    mallopt(M_PERTURB, 0x5a); /* what was never written is seen */
    for (int i = 0, lanes; iso_batch_vectors(i, &lanes); i++)
        printf("vectors here: %s, %d orbits in each\n", iso_batch_vectors(i, &lanes), lanes);
    check_right();
    iso_batch_options o = iso_batch_defaults();
    o.max_steps = 1000;
    for (int i = 0; (o.vectors = iso_batch_vectors(i, NULL)) != NULL; i++)
        for (o.backend = ISO_BACKEND_BALL; o.backend <= ISO_BACKEND_POINT; o.backend++) check_bits(&o);
    o.backend = ISO_BACKEND_AUTO, o.clock = ISO_CLOCK_S, o.tolerance = 1e-15;
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = true;
    check_bits(&o);
    laws_report(&bits, "no orbit feels another, by a bit");
    check_conserved(ISO_BACKEND_BALL);
    check_conserved(ISO_BACKEND_POINT);
    iso_random_free(dice);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
