/* test_run.c - iso_run (study/run.h): its rows are those of the orbit asked time by time, whatever the order of the times,
 * and whoever ends the run: the sink, the watch, a failure, the ball that leaves its support. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/scene_file.h"
#include "laws.h"
#include "study/run.h"

static iso_context *ctx;

#define HEAVY "ball: {mass: 2, radius: 1, inertia: [0.7, 0.8, 0.9]}\n"
#define OUTSIDE HEAVY "surface: {kind: outside, radius: 3}\n"
#define START "initial: {normal: [0.6, 0, 0.8], angular_velocity: [0.8, 1.5, -0.6]}\n"
#define FREE_START "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\n"
#define REDUCED(k) "reduced: {k: " k ", J: [1.4, 2.1, 3.0]}\n" FREE_START
#define POINT "point: {k: -1, J: [1.4, 2.1, 3.0]}\ninitial: {gamma: [0.6, 0, 0.8], M: [0, 2.5, 0]}\n"
#define GRAVITY "gravity: {g: 9.81, up: [0.48, 0.6, 0.64]}"
#define TIME "time: {end: 2, step: 0.25}\n"

/* Scenes of every kind, none of which loses contact. */
static const char *const kinds[] = {
    REDUCED("-1") TIME,
    REDUCED("1") TIME "solver: {backend: exact}\noutput: {as: both}\n",
    REDUCED("0.7") TIME "solver: {backend: point, tolerance: 1e-9}\noutput: {as: both}\n",
    REDUCED("-1") TIME "output: {columns: [s, n3, t, gamma1, omega2]}\n",
    REDUCED("-0.4") "time: {end: -3, step: 0.5}\nsolver: {method: rk8pd}\n",
    REDUCED("3") TIME "effects: {field: {linear: [0.1, 0.2, 0.3]}, level: {c: 0.3}}\noutput: {as: both}\n",
    REDUCED("-1") "time: {end: 0}\n",
    POINT TIME,
    POINT TIME "solver: {method: kahan_li8}\noutput: {as: ball}\n",
    OUTSIDE START TIME "effects: {" GRAVITY ", attitude: {}, reactions: {two_sided: true}}\n",
    OUTSIDE START TIME "effects: {" GRAVITY ", twist: {resistance: 3000}, rolling_resistance: {coefficient: 0.1}}\n",
    HEAVY "surface: {kind: plane}\n" START TIME "effects: {" GRAVITY ", attitude: {}, clock: {}}\n",
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void give_up(const char *what)
{
    gsl_test(1, "%s: %s", what, iso_context_message(ctx));
    exit(gsl_test_summary());
}

static iso_scene parse(const char *text)
{
    iso_scene scene;
    if (iso_scene_parse(ctx, "scene", text, strlen(text), &scene) != ISO_OK) give_up(text);
    return scene;
}

/* --- a sink that keeps everything -------------------------------------------------------------------------------- */

enum { MOST = 400 };

typedef struct kept {
    size_t headers, columns, rows, notes, steps;
    double row[MOST][ISO_MAX_COLUMNS], time[MOST];
    iso_run_note note;
    size_t rows_at_note;
    size_t stop_at; /* the row that is refused, from 1; 0: none */
    bool refuses_header, wrong_progress;
    double part;
    iso_run_result result;
    iso_status status;
} kept;

static iso_status keep_header(void *data, const iso_record *header)
{
    kept *k = data;
    k->headers++;
    k->columns = iso_record_columns(header);
    return k->refuses_header ? iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "no header, please") : ISO_OK;
}

static iso_status keep_row(void *data, const double row[], size_t count)
{
    kept *k = data;
    if (k->rows == MOST || count != k->columns) give_up("a row of another kind");
    if (k->rows + 1 == k->stop_at) return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "no more rows, please");
    memcpy(k->row[k->rows++], row, count * sizeof *row);
    return ISO_OK;
}

static void keep_note(void *data, iso_run_note note, const char *words)
{
    kept *k = data;
    k->notes++;
    k->note = note;
    k->rows_at_note = k->rows;
    gsl_test(*words == '\0', "a note: %s", words);
}

static void keep_progress(void *data, double part)
{
    kept *k = data;
    k->steps++;
    k->wrong_progress = k->wrong_progress || !(part >= 0 && part <= 1);
    k->part = part;
}

/* A run into a sink that keeps everything; what stops it is set in *like before. The caller frees it. */
static kept *run_like(const kept *like, const iso_scene *scene, const double times[], size_t count, bool errors)
{
    kept *k = malloc(sizeof *k);
    if (!k) give_up("no memory");
    *k = *like;
    const iso_run_sink sink = {keep_header, keep_row, keep_note, keep_progress, k};
    const iso_run_options o = {times, count, errors};
    k->status = iso_run(ctx, scene, &o, &sink, &k->result);
    gsl_test(k->result.rows != k->rows, "the result counts the sink's rows");
    return k;
}

static const kept nothing = {.headers = 0};

static kept *run(const iso_scene *scene, const double times[], size_t count)
{
    return run_like(&nothing, scene, times, count, false);
}

/* --- what it should give ------------------------------------------------------------------------------------------ */

/* How many numbers of row `at` differ from those of a new orbit that is asked for this time alone. */
static int different(const iso_scene *scene, const kept *k, size_t at, double time)
{
    int columns[ISO_MAX_COLUMNS], wrong = 0;
    const int count = iso_scene_columns(scene, columns);
    iso_orbit *orbit;
    iso_sample sample;
    if (iso_scene_orbit(ctx, scene, columns, count, &orbit) != ISO_OK || iso_orbit_at(orbit, time, &sample) != ISO_OK)
        give_up("an orbit");
    for (int c = 0; c < count; c++) wrong += !(k->row[at][c] == iso_sample_column(&sample, columns[c]));
    iso_orbit_free(orbit);
    return wrong + ((size_t)count != k->columns);
}

/* The times of a scene's grid, every one of them twice, in no order; some go to the other side of the start, `back`
 * times as far. */
static size_t shuffle(const iso_scene *scene, double back, double times[])
{
    const size_t rows = iso_scene_rows(scene);
    size_t count = 0;
    for (size_t i = 0; i < rows; i++) {
        times[count++] = iso_scene_time(scene, i * 7 % rows);
        times[count++] = iso_scene_time(scene, i * 5 % rows) * (i % 3 ? 1 : -back);
    }
    return count;
}

static void check_kind(int kind)
{
    const iso_scene scene = parse(kinds[kind]);
    double times[MOST];
    kept *grid = run(&scene, NULL, 0);
    int wrong = 0;
    gsl_test(grid->status != ISO_OK || grid->headers != 1, "scene %d runs: %s", kind, iso_context_message(ctx));
    gsl_test(grid->rows != iso_scene_rows(&scene) || grid->result.asked != grid->rows, "scene %d: all rows", kind);
    for (size_t i = 0; i < grid->rows; i++) wrong += different(&scene, grid, i, iso_scene_time(&scene, i));
    gsl_test(wrong, "scene %d: %zu rows, each the one of an orbit asked for it alone", kind, grid->rows);
    gsl_test(grid->wrong_progress || (scene.backend != ISO_EXACT && scene.end != 0 && !(grid->part > 0.5)),
             "scene %d: progress is a part, to %g", kind, grid->part);
    free(grid);
    const size_t count = shuffle(&scene, 0.001, times);
    kept *any = run(&scene, times, count);
    wrong = any->status != ISO_OK || any->rows != count;
    for (size_t i = 0; i < any->rows; i++) wrong += different(&scene, any, i, times[i]);
    gsl_test(wrong, "scene %d: %zu times in any order have the same rows", kind, count);
    free(any);
}

/* Of an orbit: what made it, and what it took. */
static void check_result(void)
{
    static const struct expected {
        int kind;
        iso_picture backend;
        const char *method;
        iso_clock clock;
    } list[] = {{0, ISO_BALL, "taylor", ISO_CLOCK_T},
                {1, ISO_EXACT, "exact", ISO_CLOCK_T},
                {4, ISO_BALL, "rk8pd", ISO_CLOCK_T},
                {7, ISO_POINT, "taylor", ISO_CLOCK_S}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const iso_scene scene = parse(kinds[list[i].kind]);
        kept *k = run(&scene, NULL, 0);
        const iso_run_result *r = &k->result;
        gsl_test(r->backend != list[i].backend || r->clock != list[i].clock || !r->method ||
                     strcmp(r->method->name, list[i].method) != 0,
                 "scene %d: the orbit is found by %s", list[i].kind, list[i].method);
        gsl_test((r->statistics.steps > 0) == (r->backend == ISO_EXACT), "scene %d: %ld steps", list[i].kind,
                 r->statistics.steps);
        gsl_test(r->lost[0] || r->lost[1] || k->notes != 0, "scene %d: no contact is lost", list[i].kind);
        free(k);
    }
    const iso_scene scene = parse(kinds[0]);
    const iso_run_sink none = {.data = NULL};
    gsl_test(iso_run(ctx, &scene, NULL, &none, NULL) != ISO_OK, "nobody takes anything: that is a run as well");
}

/* --- who ends it early -------------------------------------------------------------------------------------------- */

static bool some_times(void *data)
{
    return (*(int *)data)-- > 0;
}

/* Rows of a run that ended early: the first ones of the whole. */
static bool begins(const kept *part, const kept *whole)
{
    bool same = part->rows <= whole->rows;
    for (size_t i = 0; same && i < part->rows; i++)
        same = memcmp(part->row[i], whole->row[i], whole->columns * sizeof(double)) == 0;
    return same;
}

static void check_sink_stops(void)
{
    const iso_scene scene = parse(kinds[0]);
    kept *whole = run(&scene, NULL, 0), like = {.refuses_header = true};
    kept *k = run_like(&like, &scene, NULL, 0, false);
    gsl_test(k->status != ISO_FILE_TROUBLE || k->rows != 0 || strstr(iso_context_message(ctx), "no header") == NULL,
             "a sink that wants no header gets no row");
    free(k);
    for (size_t stop = 1; stop <= whole->rows; stop++) {
        like = (kept){.stop_at = stop};
        k = run_like(&like, &scene, NULL, 0, stop % 2);
        gsl_test(k->status != ISO_FILE_TROUBLE || k->rows + 1 != stop || !begins(k, whole),
                 "a sink that refuses row %zu has those before: %s", stop, iso_context_message(ctx));
        free(k);
    }
    free(whole);
}

/* Stopped by the watch: whatever was found is there, in the order asked for. */
static void check_watch_stops(bool ordered)
{
    const iso_scene scene = parse(kinds[4]);
    double times[MOST];
    const size_t count = ordered ? 0 : shuffle(&scene, 1, times);
    kept *whole = run(&scene, ordered ? NULL : times, count);
    size_t most = 0, least = MOST;
    bool done = false;
    for (int asked = 0; !done && asked < 100000; asked++) {
        int left = asked;
        iso_context_watch(ctx, some_times, &left);
        kept *k = run(&scene, ordered ? NULL : times, count);
        done = k->status == ISO_OK;
        bool right = done || k->status == ISO_STOPPED, mine = iso_context_goes_on(ctx) == (left >= 0);
        for (size_t i = 0, at = 0; right && i < k->rows; i++) { /* its rows are rows of the whole, in their order */
            while (at < whole->rows && memcmp(k->row[i], whole->row[at], whole->columns * sizeof(double)) != 0) at++;
            right = at++ < whole->rows;
        }
        if (!right || !mine) gsl_test(1, "stopped after %d steps: %s", asked, iso_context_message(ctx));
        if (!done) most = k->rows > most ? k->rows : most, least = k->rows < least ? k->rows : least;
        free(k);
    }
    iso_context_watch(ctx, NULL, NULL);
    gsl_test(!done || least != 0 || most + 1 < whole->rows, "stopped anywhere, %s: the rows before are there, to %zu",
             ordered ? "on the grid" : "with times in any order", most);
    free(whole);
}

/* Backwards, resistance drives the ball until it is refused: what was found before stays, on both sides. */
static void check_failure(void)
{
    const iso_scene scene = parse(OUTSIDE START TIME "effects: {rolling_resistance: {coefficient: 20}}\n");
    static const double times[] = {-0.25, 1, -1000, 0.5, -0.5, -2000, 2};
    kept *k = run(&scene, times, 7);
    static const double found[] = {-0.25, 1, 0.5, -0.5, 2};
    int wrong = k->status != ISO_NUMERICAL || k->rows != 5 || k->result.asked != 7;
    gsl_test(wrong, "a failure after 5 of 7 times: %zu rows, %s", k->rows, iso_context_message(ctx));
    for (size_t i = 0; !wrong && i < k->rows; i++) wrong += different(&scene, k, i, found[i]);
    gsl_test(wrong, "those rows are right");
    free(k);
    iso_scene back = scene;
    back.end = -1000;
    back.step = 0.25;
    k = run(&back, NULL, 0);
    wrong = k->status != ISO_NUMERICAL || k->rows < 3;
    for (size_t i = 0; i < k->rows; i++) wrong += different(&back, k, i, iso_scene_time(&back, i));
    gsl_test(wrong, "a failure on the grid keeps %zu rows: %s", k->rows, iso_context_message(ctx));
    free(k);
}

/* What cannot be asked for is refused before there is a header. */
static void check_refusals(void)
{
    const iso_scene usual = parse(kinds[0]);
    iso_scene scene = usual;
    static const double odd[] = {1, NAN}, far[] = {1, 1e300};
    const struct refusal {
        const char *what, *field;
        const double *times;
        size_t count;
    } list[] = {
        {"no times", "times", odd, 0}, {"a time that is NaN", "times", odd, 2}, {"a far time", "end", far, 2}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        kept *k = run(&scene, list[i].times, list[i].count);
        gsl_test(k->status != ISO_BAD_ARGUMENT || k->headers || strcmp(iso_context_field(ctx), list[i].field) != 0,
                 "%s: %s", list[i].what, iso_context_message(ctx));
        free(k);
    }
    snprintf(scene.method, sizeof scene.method, "sundial");
    kept *k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_BAD_ARGUMENT || k->headers || k->result.method, "%s", iso_context_message(ctx));
    free(k);
    scene = usual;
    scene.columns = 1;
    snprintf(scene.column[0], sizeof scene.column[0], "e1");
    k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_BAD_INPUT || k->headers, "%s", iso_context_message(ctx));
    free(k);
    scene = usual;
    scene.end = INFINITY;
    k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_BAD_ARGUMENT || k->headers, "%s", iso_context_message(ctx));
    free(k);
}

/* --- contact ------------------------------------------------------------------------------------------------------ */

static int column_of(const iso_scene *scene, const char *name)
{
    int columns[ISO_MAX_COLUMNS];
    const int count = iso_scene_columns(scene, columns);
    for (int c = 0; c < count; c++)
        if (strcmp(iso_trajectory_columns[columns[c]], name) == 0) return c;
    give_up("a column is missing");
    return -1;
}

/* The ball rolls down the outside of a sphere, after the start as before it, and leaves it. */
static void check_loss(void)
{
    const iso_scene scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0.3, 0.2, 0]}\n"
                                          "time: {end: 6, step: 0.25}\n"
                                          "effects: {gravity: {g: 9.81, up: [0, 0, 1]}, reactions: {}}\n");
    const int pressure = column_of(&scene, "pressure");
    double times[MOST];
    kept *k = run(&scene, NULL, 0);
    const double lost = k->result.lost_at[0], weight = 2 * 9.81;
    bool pressed = true;
    for (size_t i = 0; i + 1 < k->rows; i++) pressed = pressed && k->row[i][pressure] > 0;
    gsl_test(k->status != ISO_OK || !k->result.lost[0] || k->result.lost[1] || !(lost > 0 && lost < 6), "lost at %g",
             lost);
    gsl_test(k->notes != 1 || k->note != ISO_NOTE_LOST || k->rows_at_note + 1 != k->rows,
             "said once, before its row");
    gsl_test(!pressed || k->row[k->rows - 1][0] != lost || !(fabs(k->row[k->rows - 1][pressure]) < 1e-12 * weight),
             "pressed until then, and not there: %.1e", k->row[k->rows - 1][pressure]);
    gsl_test(k->rows != (size_t)floor(lost / 0.25) + 2, "%zu rows: those before, and that one", k->rows);
    free(k);
    const size_t count = shuffle(&scene, 1, times);
    k = run(&scene, times, count);
    const double before = k->result.lost_at[1];
    size_t expected = 2; /* the two moments of loss */
    int wrong = k->status != ISO_OK || !k->result.lost[0] || !k->result.lost[1] || k->notes != 2;
    for (size_t i = 0, at = 0; i < count; i++) {
        const double time = at < k->rows ? k->row[at][0] : NAN;
        expected += times[i] < lost && times[i] > before;
        if (time == times[i])
            wrong += different(&scene, k, at++, times[i]);
        else if ((times[i] > lost && time == lost) || (times[i] < before && time == before))
            at++;
        else
            wrong += times[i] < lost && times[i] > before;
    }
    gsl_test(wrong || k->rows != expected || k->result.lost_at[0] != lost,
             "times in any order: rows between %.6g and %.6g, and at both", before, lost);
    free(k);
}

/* Nothing presses the ball at the start, or the support would have to pull it there. */
static void check_no_pressure(void)
{
    iso_scene scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0.3, 0.2, 0]}\n"
                                    "time: {end: 1, step: 0.25}\n"
                                    "effects: {gravity: {g: 9.81, up: [0, 0, -1]}, reactions: {}}\n");
    kept *k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_OK || k->notes != 1 || k->note != ISO_NOTE_PULLED || k->rows_at_note != 0 ||
                 k->rows != 5 || k->result.lost[0],
             "below the sphere: two-sided, %zu rows", k->rows);
    free(k);
    scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0, 0, 0]}\n"
                          "time: {end: 1, step: 0.25}\n"
                          "effects: {gravity: {g: 9.81, up: [0, 1, 0]}, reactions: {}}\n");
    k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_OK || k->notes != 1 || k->note != ISO_NOTE_LOST_AT_START || k->rows != 1 ||
                 !k->result.lost[0] || k->result.lost_at[0] != 0,
             "at rest beside the sphere: one row, %zu", k->rows);
    free(k);
}

/* --- errors of the rows ------------------------------------------------------------------------------------------- */

static void check_errors(void)
{
    for (int kind = 0; kind < KINDS; kind++) {
        const iso_scene scene = parse(kinds[kind]);
        double times[MOST];
        const size_t count = shuffle(&scene, 0.001, times);
        kept *plain = run(&scene, times, count), *k = run_like(&nothing, &scene, times, count, true);
        const iso_error *e = &k->result.error;
        gsl_test(plain->result.error_status == ISO_OK, "scene %d: errors that nobody asked for are not known", kind);
        gsl_test(k->rows != plain->rows || !begins(k, plain), "scene %d: errors change no row", kind);
        gsl_test(k->result.error_status != ISO_OK || e->rows != k->rows ||
                     !(fmax(e->state[0].worst, e->state[1].worst) > 0),
                 "scene %d: the error of all %zu rows: %s", kind, e->rows, k->result.error_words);
        free(plain);
        free(k);
    }
    iso_scene scene = parse(kinds[4]);
    scene.tolerance = 1e-15;
    snprintf(scene.method, sizeof scene.method, iso_method_find("taylor_quad") ? "taylor_quad" : "taylor_extended");
    kept *k = run_like(&nothing, &scene, NULL, 0, true);
    gsl_test(k->status != ISO_OK || k->result.error_status != ISO_BAD_ARGUMENT || !*k->result.error_words,
             "an error that is not known is no failure: %s", k->result.error_words);
    free(k);
    const kept like = {.stop_at = 1};
    scene = parse(kinds[0]);
    k = run_like(&like, &scene, NULL, 0, true);
    gsl_test(k->status != ISO_FILE_TROUBLE || strstr(iso_context_message(ctx), "no more rows") == NULL,
             "the words of a failure stay: %s", iso_context_message(ctx));
    free(k);
}

int main(void)
{
    gsl_test_verbose(1);
    ctx = iso_context_create();
    for (int kind = 0; kind < KINDS; kind++) check_kind(kind);
    check_result();
    check_sink_stops();
    check_watch_stops(true);
    check_watch_stops(false);
    check_failure();
    check_refusals();
    check_loss();
    check_no_pressure();
    check_errors();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
