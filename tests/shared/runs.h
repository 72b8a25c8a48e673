/* runs.h - runs of scenes (task/run.h) into a sink that keeps everything, and what their rows should be. */
#ifndef ISO_TESTS_RUNS_H
#define ISO_TESTS_RUNS_H

#include "orbit/orbit_impl.h"
#include "scenes.h"
#include "studies.h"
#include "task/run.h"

#define HEAVY "ball: {mass: 2, radius: 1, inertia: [0.7, 0.8, 0.9]}\n"
#define OUTSIDE HEAVY "surface: {kind: outside, radius: 3}\n"
#define START "initial: {normal: [0.6, 0, 0.8], angular_velocity: [0.8, 1.5, -0.6]}\n"
#define FREE_START "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\n"
#define REDUCED(k) "reduced: {k: " k ", J: [1.4, 2.1, 3.0]}\n" FREE_START
#define POINT "point: {k: -1, J: [1.4, 2.1, 3.0]}\ninitial: {gamma: [0.6, 0, 0.8], M: [0, 2.5, 0]}\n"
#define GRAVITY "gravity: {g: 9.81, up: [0.48, 0.6, 0.64]}"
#define TIME "time: {end: 2, step: 0.25}\n"

/* --- a sink that keeps everything ------------------------------------------------------------------------------- */

enum { MOST = 400 };

typedef struct kept {
    size_t headers, columns, rows, notes, steps;
    double row[MOST][ISO_MAX_COLUMNS], time[MOST];
    char note[160];
    size_t rows_at_note;
    size_t stop_at; /* the row that is refused, from 1; 0: none */
    bool refuses_header, wrong_progress;
    double part;
    iso_run_result result;
    iso_status status;
} kept;

static inline iso_status keep_header(void *data, int table, const iso_record *header)
{
    kept *k = data;
    gsl_test(table != 0, "a run has one table");
    k->headers++;
    k->columns = iso_record_columns(header);
    return k->refuses_header ? iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "no header, please") : ISO_OK;
}

static inline iso_status keep_row(void *data, int table, const double row[], size_t count)
{
    kept *k = data;
    laws_stop_if(ctx, table != 0 || k->rows == MOST || count != k->columns, "a row of another kind");
    if (k->rows + 1 == k->stop_at) return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "no more rows, please");
    memcpy(k->row[k->rows++], row, count * sizeof *row);
    return ISO_OK;
}

static inline void keep_note(void *data, const char *words)
{
    kept *k = data;
    k->notes++;
    snprintf(k->note, sizeof k->note, "%s", words);
    k->rows_at_note = k->rows;
    gsl_test(*words == '\0', "a note: %s", words);
}

static inline void keep_progress(void *data, double part)
{
    kept *k = data;
    k->steps++;
    k->wrong_progress = k->wrong_progress || !(part >= 0 && part <= 1);
    k->part = part;
}

/* A run into a sink that keeps everything; what stops it is set in *like before. The caller frees it. */
static inline kept *run_like(const kept *like, const iso_scene *scene, const double times[], size_t count,
                             bool errors)
{
    kept *k = malloc(sizeof *k);
    laws_stop_if(ctx, !k, "no memory");
    *k = *like;
    const iso_sink sink = {keep_header, keep_row, keep_note, keep_progress, k};
    const iso_run_options o = {.times = times, .count = count, .errors = errors};
    k->status = iso_run(ctx, scene, &o, &sink, NULL, &k->result);
    gsl_test(k->result.rows != k->rows, "the result counts the sink's rows");
    return k;
}

static const kept nothing = {.headers = 0};

static inline kept *run(const iso_scene *scene, const double times[], size_t count)
{
    return run_like(&nothing, scene, times, count, false);
}

/* --- what it should give ---------------------------------------------------------------------------------------- */

/* How many numbers of row `at` differ from those of a new orbit that is asked for this time alone. */
static inline int different(const iso_scene *scene, const kept *k, size_t at, double time)
{
    int columns[ISO_MAX_COLUMNS], wrong = 0;
    const int count = iso_scene_column_list(scene, columns);
    iso_orbit *orbit;
    iso_sample sample;
    laws_stop_if(ctx,
                 iso_scene_orbit(ctx, scene, columns, count, &orbit) != ISO_OK ||
                     iso_orbit_at(orbit, time, &sample) != ISO_OK,
                 "an orbit");
    for (int c = 0; c < count; c++) wrong += !(k->row[at][c] == iso_sample_column(&sample, columns[c]));
    iso_orbit_free(orbit);
    return wrong + ((size_t)count != k->columns);
}

/* The times of a scene's grid, every one of them twice, in no order; some go to the other side of the start, `back`
 * times as far. */
static inline size_t shuffle(const iso_scene *scene, double back, double times[])
{
    const size_t rows = iso_scene_rows(scene);
    size_t count = 0;
    for (size_t i = 0; i < rows; i++) {
        times[count++] = iso_scene_time(scene, i * 7 % rows);
        times[count++] = iso_scene_time(scene, i * 5 % rows) * (i % 3 ? 1 : -back);
    }
    return count;
}

#endif
