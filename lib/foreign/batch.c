/* batch.c - many orbits into one table: the scene's columns alone, in an array of the caller's. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "foreign/foreign_impl.h"
#include "orbit/batch.h"
#include "orbit/orbit_impl.h"
#include "orbit/pool_impl.h"

/* Samples have all columns, so they take more room than the table. A thread makes them for a chunk of orbits at a time,
 * in a buffer that should stay in the cache, then copies the columns that are wanted. Fewer orbits than LEAST would
 * leave lanes empty. An orbit's numbers do not depend on the chunk. */
enum { LEAST = 64, MOST = 256, LANES = 8 };
static const size_t BUFFER = (size_t)1 << 22;

/* The samples of a thread. */
typedef struct buffer {
    atomic_flag taken;
    iso_sample *sample;
} buffer;

typedef struct work {
    iso_context *ctx;
    const iso_foreign_scene *const *scene;
    size_t scenes, count, rows;
    const double *k, *J, *y, *times; /* of k, J, y, the start: NULL: those of the scenes */
    int columns[ISO_MAX_COLUMNS], width;
    iso_batch_options how;
    iso_batch_orbit *orbit;
    iso_params *params; /* made from k and J, NULL: those of the scenes */
    iso_start *start;   /* made from y, likewise                        */
    iso_status *status;
    double *table;
    size_t chunk, threads;
    buffer *buffers; /* one for each thread */
    bool began;      /* the call makes sense, and status says how each orbit went */
} work;

/* The status of an orbit that no thread has taken. */
static const iso_status UNTOUCHED = (iso_status)-1;

static const iso_scene *scene_of(const work *w, size_t i)
{
    return &w->scene[w->scenes == 1 ? 0 : i]->scene;
}

static bool same_columns(const work *w, const iso_scene *scene)
{
    int columns[ISO_MAX_COLUMNS];
    return iso_scene_columns(scene, columns) == w->width &&
           memcmp(columns, w->columns, (size_t)w->width * sizeof *columns) == 0;
}

static iso_status check_scene(work *w, size_t i)
{
    const iso_scene *first = scene_of(w, 0), *scene = scene_of(w, i);
    const char *apart = !same_columns(w, scene)                    ? "columns"
                        : scene->backend != first->backend         ? "backend"
                        : scene->tolerance != first->tolerance     ? "tolerance"
                        : scene->start.model != first->start.model ? "model of the start"
                                                                   : NULL;
    if (apart)
        return iso_context_fail(w->ctx, ISO_BAD_ARGUMENT, "scenes", "scene %zu has another %s than scene 0", i,
                                apart);
    if (strcmp(scene->method, "auto") != 0 && strcmp(scene->method, "taylor") != 0)
        return iso_context_fail(w->ctx, ISO_BAD_ARGUMENT, "method",
                                "scene %zu: a batch is by method taylor, not '%s': run it by itself", i,
                                scene->method);
    if (iso_effects_watch_contact(&scene->effects))
        return iso_context_fail(w->ctx, ISO_BAD_ARGUMENT, "scenes",
                                "scene %zu: a batch does not see where contact is lost: write "
                                "'reactions: {two_sided: true}', or run it by itself",
                                i);
    return iso_scene_check_columns(w->ctx, scene);
}

/* Options that all orbits share, from the first scene and its columns. */
static void choose_options(work *w, int threads, const char *vectors)
{
    const iso_scene *scene = scene_of(w, 0);
    bool ball = false, point = false;
    w->how = iso_batch_defaults();
    for (int i = 0; i < w->width; i++) {
        const int c = w->columns[i];
        if (c < ISO_CLOCKS) w->how.with_clock[c] = true;
        point = point || (c >= ISO_COLUMN_POINT && c < ISO_COLUMN_EFFECTS);
        ball = ball || (c >= ISO_COLUMN_BALL && c < ISO_COLUMN_POINT) || c >= ISO_COLUMN_EFFECTS;
    }
    w->how.shown = ball && point ? ISO_SHOW_BOTH
                   : ball        ? ISO_SHOW_BALL
                   : point       ? ISO_SHOW_POINT
                                 : (iso_models)scene->start.model;
    w->how.clock = scene->start.model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    w->how.backend = scene->backend;
    w->how.tolerance = scene->tolerance;
    w->how.threads = threads;
    w->how.vectors = vectors;
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* What replaces numbers of the scene, for orbit i. */
static iso_status make_params(iso_context *ctx, const work *w, size_t i)
{
    if (!w->params) return ISO_OK;
    return iso_foreign_replace_params(ctx, scene_of(w, i), w->k ? w->k + i : NULL, w->J ? w->J + 3 * i : NULL,
                                      &w->params[i]);
}

static iso_status make_start(iso_context *ctx, const work *w, size_t i)
{
    return w->start ? iso_foreign_replace_start(ctx, scene_of(w, i), w->y + 6 * i, &w->start[i]) : ISO_OK;
}

static iso_status prepare_orbits(work *w)
{
    w->orbit = calloc(w->count, sizeof *w->orbit);
    w->status = malloc(w->count * sizeof *w->status);
    if (w->k || w->J) w->params = malloc(w->count * sizeof *w->params);
    if (w->y) w->start = malloc(w->count * sizeof *w->start);
    if (!w->orbit || !w->status || ((w->k || w->J) && !w->params) || (w->y && !w->start))
        return iso_context_no_memory(w->ctx, "%zu orbits", w->count);
    for (size_t i = 0; i < w->count; i++) {
        const iso_scene *s = scene_of(w, i);
        w->orbit[i] = (iso_batch_orbit){w->params ? &w->params[i] : &s->params, w->start ? &w->start[i] : &s->start,
                                        &s->effects};
        w->status[i] = UNTOUCHED;
    }
    return ISO_OK;
}

/* --- the table -------------------------------------------------------------------------------------------------- */

/* The numbers of a sample stand in the order of the columns. */
_Static_assert(sizeof(iso_sample) == ISO_TRAJECTORY_COLUMNS * sizeof(double), "a sample is an array of its columns");

/* Orbits from `first` on, whose samples these are. */
static void take_columns(const work *w, const iso_sample sample[], size_t first, size_t count)
{
    const double *from = (const double *)sample;
    double *to = w->table + first * w->rows * (size_t)w->width;
    for (size_t i = 0; i < count * w->rows; i++, from += ISO_TRAJECTORY_COLUMNS)
        for (int c = 0; c < w->width; c++) *to++ = from[w->columns[c]];
}

static void blank_rows(const work *w, size_t first, size_t count)
{
    const size_t each = w->rows * (size_t)w->width;
    for (size_t j = 0; j < count * each; j++) w->table[first * each + j] = NAN;
}

/* The caller's status. Orbits that no thread has taken have no rows, and the status of the call. A call that makes no
 * sense leaves table and status as they were. */
static void tell(const work *w, iso_status answer, int32_t status[])
{
    if (!w->began && answer != ISO_NO_MEMORY && answer != ISO_STOPPED) return;
    for (size_t i = 0; i < w->count; i++) {
        const bool untouched = !w->began || w->status[i] == UNTOUCHED;
        if (untouched) blank_rows(w, i, 1);
        if (status) status[i] = (int32_t)(untouched ? answer : w->status[i]);
    }
}

/* Notes the first failure of a chunk, whose message begins with the number of the orbit in the chunk. */
static void note_failure(iso_pool_worker *worker, const work *w, size_t first, size_t count)
{
    size_t i = first;
    while (i < first + count && w->status[i] == ISO_OK) i++;
    if (i == first + count) return;
    char copy[1024];
    const char *words = iso_context_message(worker->ctx), *reason = strstr(words, ": ");
    snprintf(copy, sizeof copy, "%s", strncmp(words, "orbit ", 6) == 0 && reason ? reason + 2 : words);
    iso_context_fail(worker->ctx, w->status[i], iso_context_about(worker->ctx), "%s", copy);
    iso_pool_note(worker, i, w->status[i]);
}

static buffer *take_buffer(const work *w)
{
    size_t i = 0;
    while (atomic_flag_test_and_set(&w->buffers[i].taken)) i = (i + 1) % w->threads;
    return &w->buffers[i];
}

/* Orbits beside each other, all with a ball and a start that make sense. */
static iso_status solve_row(iso_pool_worker *worker, const work *w, size_t first, size_t count, iso_sample sample[])
{
    const iso_status status =
        iso_batch_run(worker->ctx, w->orbit + first, count, &w->how, w->times, w->rows, sample, w->status + first);
    if (status == ISO_NO_MEMORY) return status;
    take_columns(w, sample, first, count);
    if (status != ISO_OK) note_failure(worker, w, first, count);
    return ISO_OK;
}

/* Makes orbit i; one that makes no sense fails, and has no rows. */
static bool make_orbit(iso_pool_worker *worker, const work *w, size_t i)
{
    iso_status status = make_params(worker->ctx, w, i);
    if (status == ISO_OK) status = make_start(worker->ctx, w, i);
    if (status == ISO_OK) return true;
    w->status[i] = status;
    blank_rows(w, i, 1);
    iso_pool_note(worker, i, status);
    return false;
}

/* Orbits from `first` to before `end`: those that fail part them into rows. ISO_OK, or ISO_NO_MEMORY. */
static iso_status solve_between(iso_pool_worker *worker, const work *w, size_t first, size_t end, iso_sample sample[])
{
    iso_status status = ISO_OK;
    for (size_t i = first; status == ISO_OK && i <= end; i++) {
        if (i < end && make_orbit(worker, w, i)) continue;
        if (i > first) status = solve_row(worker, w, first, i - first, sample);
        first = i + 1;
    }
    return status;
}

static bool solve_chunk(iso_pool_worker *worker, void *data, size_t first, size_t count)
{
    const work *w = data;
    buffer *b = take_buffer(w);
    if (!b->sample) b->sample = malloc(w->chunk * w->rows * sizeof *b->sample + 1);
    const bool memory = b->sample && solve_between(worker, w, first, first + count, b->sample) == ISO_OK;
    if (!memory) {
        for (size_t i = first; i < first + count; i++) w->status[i] = ISO_NO_MEMORY;
        blank_rows(w, first, count);
    }
    atomic_flag_clear(&b->taken);
    return memory;
}

static iso_status solve_all(work *w, int threads)
{
    /* without orbits: only looks at the options and times */
    iso_status status = iso_batch_run(w->ctx, w->orbit, 0, &w->how, w->times, w->rows, NULL, w->status);
    if (status != ISO_OK) return status;
    const size_t fits = BUFFER / ((w->rows + 1) * sizeof(iso_sample));
    w->chunk = fits < LEAST ? LEAST : fits > MOST ? MOST : fits;
    w->threads = iso_pool_threads(threads, w->count, LANES);
    w->how.threads = 1;
    w->buffers = calloc(w->threads, sizeof *w->buffers);
    if (!w->buffers) return iso_context_no_memory(w->ctx, "a batch");
    iso_pool pool = {.count = w->count, .chunk = w->chunk, .solve = solve_chunk, .data = w};
    w->began = true;
    status = iso_pool_run(w->ctx, &pool, w->threads, w->status);
    for (size_t i = 0; i < w->threads; i++) free(w->buffers[i].sample);
    free(w->buffers);
    return status;
}

iso_status iso_foreign_batch(iso_context *ctx, const iso_foreign_scene *const scene[], size_t scenes, size_t count,
                             const double k[], const double J[], const double start[], const double times[],
                             size_t rows, int threads, const char *vectors, double table[], int32_t status[])
{
    ISO_DEFAULT_ARITHMETIC;
    work w = {.ctx = ctx,
              .scene = scene,
              .scenes = scenes,
              .count = count,
              .rows = rows,
              .k = k,
              .J = J,
              .y = start,
              .times = times,
              .table = table};
    if (scenes == 0 || (scenes != 1 && scenes != count))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "scenes",
                                "%zu scenes for %zu orbits: give one, or one for each", scenes, count);
    if (count == 0) return ISO_OK;
    w.width = iso_scene_columns(scene_of(&w, 0), w.columns);
    iso_status answer = ISO_OK;
    for (size_t i = 0; answer == ISO_OK && i < scenes; i++) answer = check_scene(&w, i);
    choose_options(&w, threads, vectors);
    if (answer == ISO_OK) answer = prepare_orbits(&w);
    if (answer == ISO_OK) answer = solve_all(&w, threads);
    tell(&w, answer, status);
    free(w.params);
    free(w.start);
    free(w.orbit);
    free(w.status);
    return answer;
}
