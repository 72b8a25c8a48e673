/* machine.h - the answers of every backend and method, and of the other calls, as bytes. They must not depend on the
 * state of the machine, and must be the same in every run. */
#ifndef ISO_TESTS_MACHINE_H
#define ISO_TESTS_MACHINE_H

#include <unistd.h>

#include "base/number_impl.h"
#include "batches.h"
#include "hard.h"
#include "instrument/frequencies/frequencies.h"
#include "io/scene_file.h"
#include "io/table.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"
#include "task/analogue.h"
#include "task/check/check.h"
#include "task/compare.h"
#include "task/convert/convert.h"
#include "task/cost/cost.h"

static iso_context *ctx;
static batch_pool pool; /* filled before the machine's state is changed */

/* --- answers as bytes ---------------------------------------------------------------------------------------- */

typedef struct answer {
    char *bytes;
    size_t length;
} answer;

/* The number of bytes that differ. */
static double differing(const answer *a, const answer *b)
{
    size_t count = a->length > b->length ? a->length - b->length : b->length - a->length;
    for (size_t i = 0; i < a->length && i < b->length; i++) count += a->bytes[i] != b->bytes[i];
    return (double)count;
}

static void put(FILE *to, const void *data, size_t size)
{
    fwrite(data, 1, size, to);
}

/* Adds the message of a call. If `right` is false, the test fails. */
static void put_status(FILE *to, iso_context *c, iso_status status, bool right)
{
    put(to, &status, sizeof status);
    if (status != ISO_OK) fputs(iso_context_message(c), to);
    if (status != ISO_OK && right) fputs("unexpected", to);
}

static void put_record(FILE *to, const iso_record *r)
{
    const char *key, *value;
    for (size_t i = 0; iso_record_line(r, i, &key, &value); i++) fprintf(to, "%s %s\n", key, value);
    for (size_t i = 0; i < iso_record_rows(r); i++)
        put(to, iso_record_const_row(r, i), iso_record_columns(r) * sizeof(double));
}

static void put_file(FILE *to, const char *path)
{
    FILE *file = fopen(path, "r");
    for (int c; file && (c = getc(file)) != EOF;) putc(c, to);
    if (!file) fputs("no file", to);
    if (file) fclose(file);
    unlink(path);
}

/* --- orbits by every way -------------------------------------------------------------------------------------- */

/* Ten turns of the ball of the README. */
static void put_orbit(FILE *to, iso_context *c, const hard_road *way)
{
    const iso_params p = laws_params(-1, orbit_J);
    iso_sample sample;
    const iso_status status = hard_solve(c, way, &p, &batch_usual, NULL, true, ISO_CLOCK_T, 10, &sample);
    put_status(to, c, status, true);
    if (status == ISO_OK) put(to, &sample, sizeof sample);
}

static answer orbit_by(iso_context *c, const hard_road *way)
{
    answer a;
    FILE *to = open_memstream(&a.bytes, &a.length);
    put_orbit(to, c, way);
    fclose(to);
    return a;
}

/* --- all else: what people call -------------------------------------------------------------------------------- */

#define BALL "reduced: {k: -1, J: [1.4, 2.1, 3.0], D: 0.4}\n"
#define ODD "reduced: {k: 0.5, J: [1.4, 2.1, 3.0], D: 0.4}\n"
#define START                                                                                                        \
    "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\ntime: {end: 10, step: 2.5}\n"

static const char *const scenes[] = {
    BALL START,
    BALL START "solver: {backend: exact}\n",
    BALL START "output: {as: both}\n",
    ODD START "solver: {backend: point}\n",
    "ball: {mass: 6.8, radius: 0.1092, inertia: [0.0270, 0.0274, 0.0283]}\nsurface: {kind: plane}\n" START,
    "ball: {mass: 6.8, radius: 0.1092, inertia: [0.0270, 0.0274, 0.0283]}\nsurface: {kind: outside, radius: "
    "0.3}\n" START,
    "ball: {mass: 6.8, radius: 0.1092, inertia: [0.0270, 0.0274, 0.0283]}\nsurface: {kind: inside, radius: "
    "0.3}\n" START,
    "point: {k: -1, J: [1.4, 2.1, 3.0], eps: 6.5}\ninitial: {gamma: [0.36, 0.48, 0.8], M: [0.9, -0.3, -0.225]}\n"
    "time: {end: -3}\n",
    "reduced: {k: -1, J: [1.4e-103, 2.1e-103, 3.0e-103]}\n" START,
    ODD START "effects: {gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}}\n",
    ODD START "effects: {field: {quadratic: [[0.3, 0, 0], [0, 0, 0], [0, 0, 0]], linear: [0, 0, 0.1]}}\n",
    ODD START "effects: {level: {c: 0.3}}\n",
    ODD START "effects: {twist: {resistance: 0}}\n",
    ODD START "effects: {twist: {resistance: 10}}\n",
    ODD START "effects: {twist: {resistance: 1.0e+6}}\n",
    ODD START "effects: {rolling_resistance: {coefficient: 0.01}}\n",
    ODD START "effects: {rolling_resistance: {coefficient: 1000}}\n",
    ODD START "effects: {attitude: {}, reactions: {}, clock: {}}\n",
    ODD START
    "effects: {gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}, twist: {resistance: 3}, attitude: {}, reactions: {}}\n",
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static iso_scene scene_of(FILE *to, const char *text)
{
    iso_scene scene = iso_scene_default();
    put_status(to, ctx, iso_scene_load_text(ctx, "scene", text, strlen(text), &scene), true);
    return scene;
}

/* Every scene to its end, row by row. */
static void put_scenes(FILE *to)
{
    for (int i = 0; i < SCENES; i++) {
        const iso_scene scene = scene_of(to, scenes[i]);
        iso_orbit_options o = iso_orbit_defaults(&scene.start);
        iso_orbit *made;
        iso_sample sample;
        o.effects = &scene.effects;
        o.backend = scene.backend;
        o.shown = scene.as == ISO_SHOW_START ? (iso_models)scene.start.model : scene.as;
        put(to, &scene.params.k, sizeof(double));
        put(to, scene.params.J, sizeof scene.params.J);
        put(to, &scene.params.det_J, sizeof(double)); /* of one of them subnormal */
        iso_status status = iso_orbit_create(ctx, &scene.params, &scene.start, &o, &made);
        put_status(to, ctx, status, true);
        for (int row = 0; status == ISO_OK && row <= 4; row++) {
            status = iso_orbit_at(made, row * scene.end / 4, &sample);
            put_status(to, ctx, status, true);
            put(to, &sample, sizeof sample);
        }
        iso_orbit_free(made);
    }
}

/* A comparison of all backends, its file written and read, its conversion, its check, and a picture. */
static void put_studies(FILE *to)
{
    const iso_scene scene = scene_of(to, scenes[0]);
    iso_comparison *c;
    iso_record *read, *converted;
    iso_residuals residuals;
    iso_status status = iso_compare(ctx, &scene, NULL, NULL, &c);
    put_status(to, ctx, status, true);
    if (status != ISO_OK) return;
    put(to, c->worst, sizeof c->worst);
    for (int b = 0; b < c->runs; b++) put_record(to, c->run[b].trajectory);
    put_record(to, c->difference);
    iso_record *const written = c->run[ISO_BALL].trajectory;
    put_status(to, ctx, iso_record_describe(ctx, written, "both", &scene.params, NULL), true);
    put_status(to, ctx, iso_record_set_numbers(ctx, written, "h", 1, &c->h), true);
    put_status(to, ctx, iso_table_write(ctx, "hard_machine.csv", written), true);
    status = iso_table_read(ctx, "hard_machine.csv", "trajectory", NULL, &read, NULL);
    put_file(to, "hard_machine.csv");
    put_status(to, ctx, status, true);
    if (status == ISO_OK) {
        status = iso_convert(ctx, read, ISO_POINT, 1e-14, &converted);
        put_status(to, ctx, status, true);
        if (status == ISO_OK) put_record(to, converted), iso_record_free(converted);
        status = iso_check(ctx, &scene.params, read, 1e-14, &residuals);
        put_status(to, ctx, status, true);
        for (int i = 0; status == ISO_OK && i < residuals.count; i++)
            put(to, &residuals.residual[i].worst, sizeof(double));
        iso_record_free(read);
    }
    iso_comparison_free(c);
}

static void put_batches(FILE *to)
{
    iso_batch_options o = iso_batch_defaults();
    iso_status status[BATCH_ORBITS], all;
    const double times[] = {0.5, 2, 5};
    o.threads = 2;
    o.max_steps = 2000; /* among the odd orbits are some that are too fast */
    for (int i = 0; (o.vectors = iso_batch_vectors(i, NULL)); i++) {
        iso_sample *samples = batch_run(ctx, pool.orbit, pool.count, &o, times, 3, status, &all);
        put_status(to, ctx, all, false);
        put(to, status, sizeof status);
        put(to, samples, (size_t)pool.count * 3 * sizeof *samples);
        free(samples);
    }
}

static void put_frequencies(FILE *to)
{
    static iso_frequencies f;
    iso_frequencies_options o = iso_frequencies_defaults();
    const iso_scene closed = scene_of(to, scenes[0]), open = scene_of(to, ODD START);
    o.turns = 64;
    for (int i = 0; i < 2; i++) {
        memset(&f, 0, sizeof f);
        put_status(to, ctx, iso_frequencies_find(ctx, i ? &open : &closed, &o, &f), true);
        for (int a = 0; a < f.angles; a++) put(to, f.angle[a].frequency, sizeof f.angle[a].frequency);
        put(to, &f.ratio, sizeof f.ratio);
    }
    iso_analogue ball;
    const iso_analogue_problem problem = {.neumann = true, .c = {1, 2, 2.5}, .energy = 3};
    put_status(to, ctx, iso_analogue_find(ctx, &problem, 1, 1, &ball), true);
    put(to, ball.body.params.J, sizeof ball.body.params.J);
}

/* The error estimate of an orbit, and numbers as text: also subnormal ones, and ones with no short decimal form. */
static void put_numbers(FILE *to)
{
    iso_error_finder *finder;
    const iso_scene scene = scene_of(to, scenes[0]);
    const iso_orbit_options o = iso_orbit_defaults(&scene.start);
    iso_orbit *made;
    iso_sample sample;
    iso_error e;
    put_status(to, ctx, iso_orbit_create(ctx, &scene.params, &scene.start, &o, &made), true);
    put_status(to, ctx, iso_orbit_at(made, 10, &sample), true);
    put_status(to, ctx, iso_error_finder_create(ctx, &scene.params, &scene.start, &o, made, &finder), true);
    put_status(to, ctx, iso_error_finder_add(finder, &sample), true);
    e = iso_error_finder_read(finder);
    put(to, &e.state[ISO_BALL].worst, sizeof(double));
    iso_error_finder_free(finder);
    iso_orbit_free(made);
    static const char *const texts[] = {
        "0.1",    "-0.3",    "1e23",   "5e-324",   "-1.1e-310", "2.2250738585072011e-308",
        "1e-310", "1.7e308", "1e-400", "123456.7", "-1e-324",   "8.98846567431158e307"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        double x = 0;
        char text[ISO_NUMBER_SIZE] = "";
        putc(iso_number_read(texts[i], strlen(texts[i]), &x), to);
        put(to, &x, sizeof x);
        iso_number_print(text, x);
        fputs(text, to);
    }
}

/* Measured times differ from run to run, so their bytes are not compared. */
static void put_cost(FILE *to)
{
    const iso_scene scene = scene_of(to, scenes[0]);
    iso_cost_options o = iso_cost_defaults();
    iso_cost *cost;
    o.seconds = 0.2;
    const iso_status status = iso_cost_measure(ctx, &scene, &o, &cost);
    put_status(to, ctx, status, true);
    if (status == ISO_OK) iso_cost_free(cost);
}

static const struct study {
    const char *name;
    void (*put)(FILE *to);
} studies[] = {{"scenes", put_scenes},           {"studies", put_studies}, {"batches", put_batches},
               {"frequencies", put_frequencies}, {"numbers", put_numbers}, {"cost", put_cost}};
enum { STUDIES = sizeof studies / sizeof *studies };

static answer study_by(const struct study *s)
{
    answer a;
    FILE *to = open_memstream(&a.bytes, &a.length);
    s->put(to);
    fclose(to);
    return a;
}

#endif
