/* batch.c - many orbits into one table: the scene's columns alone, in an array of the caller's. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "foreign/foreign_impl.h"
#include "orbit/batch.h"

/* Samples have all columns, so they take more room than the table. They are made for as many orbits at a time as fit
 * in MOST_BYTES, but for at least LEAST_ORBITS, which keep all threads busy. An orbit's numbers do not depend on it. */
static const size_t MOST_BYTES = (size_t)1 << 29, LEAST_ORBITS = 2048;

typedef struct work {
    iso_context *ctx;
    const iso_foreign_scene *const *scene;
    size_t scenes, count, rows;
    const double *times;
    int columns[ISO_MAX_COLUMNS], width;
    iso_batch_options how;
    iso_batch_orbit *orbit;
    iso_params *params; /* NULL: those of the scenes */
    iso_start *start;   /* likewise                  */
    iso_sample *sample;
    iso_status *status; /* of the orbits of one part */
    size_t part;
} work;

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
                                 : (iso_shown)scene->start.model;
    w->how.clock = scene->start.model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    w->how.backend = scene->backend;
    w->how.tolerance = scene->tolerance;
    w->how.threads = threads;
    w->how.vectors = vectors;
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

static iso_status number_failure(iso_context *ctx, size_t i, iso_status status)
{
    char words[512], about[ISO_NAME_SIZE];
    const char *text = iso_context_message(ctx);
    strncpy(words, text, sizeof words - 1)[sizeof words - 1] = '\0';
    strncpy(about, iso_context_about(ctx), sizeof about - 1)[sizeof about - 1] = '\0';
    return iso_context_fail(ctx, status, about, "orbit %zu: %s", i, words);
}

static iso_status make_params(work *w, const double k[], const double J[])
{
    if (!k && !J) return ISO_OK;
    w->params = malloc(w->count * sizeof *w->params);
    if (!w->params) return iso_context_fail(w->ctx, ISO_NO_MEMORY, "", "no memory for %zu balls", w->count);
    for (size_t i = 0; i < w->count; i++) {
        const iso_params *from = &scene_of(w, i)->params;
        iso_status status = iso_params_reduced(w->ctx, k ? k[i] : from->k, J ? J + 3 * i : from->J, &w->params[i]);
        if (status == ISO_OK && from->D > 0) status = iso_params_set_D(w->ctx, from->D, &w->params[i]);
        if (status != ISO_OK) return number_failure(w->ctx, i, status);
    }
    return ISO_OK;
}

static iso_status make_starts(work *w, const double start[])
{
    if (!start) return ISO_OK;
    w->start = malloc(w->count * sizeof *w->start);
    if (!w->start) return iso_context_fail(w->ctx, ISO_NO_MEMORY, "", "no memory for %zu starts", w->count);
    for (size_t i = 0; i < w->count; i++) {
        const iso_scene *s = scene_of(w, i);
        const double *y = start + 6 * i;
        const iso_status status =
            s->start.model == ISO_BALL
                ? iso_start_ball(w->ctx, y, y + 3, s->effects.on[ISO_TWIST] ? ISO_SPIN_KEEP : ISO_SPIN_REFUSE,
                                 &w->start[i])
                : iso_start_point(w->ctx, y, y + 3, isnan(s->start.eps) ? NULL : &s->start.eps, false, &w->start[i]);
        if (status != ISO_OK) return number_failure(w->ctx, i, status);
    }
    return ISO_OK;
}

static iso_status make_orbits(work *w)
{
    const size_t each = (w->rows ? w->rows : 1) * sizeof *w->sample, fits = MOST_BYTES / each;
    w->part = fits > LEAST_ORBITS ? fits : LEAST_ORBITS;
    if (w->part > w->count) w->part = w->count;
    w->orbit = calloc(w->count, sizeof *w->orbit);
    w->status = calloc(w->part, sizeof *w->status);
    w->sample = malloc(w->part * each);
    if (!w->orbit || !w->status || !w->sample)
        return iso_context_fail(w->ctx, ISO_NO_MEMORY, "", "no memory for %zu orbits", w->count);
    for (size_t i = 0; i < w->count; i++) {
        const iso_scene *s = scene_of(w, i);
        w->orbit[i] = (iso_batch_orbit){w->params ? &w->params[i] : &s->params, w->start ? &w->start[i] : &s->start,
                                        &s->effects};
    }
    return ISO_OK;
}

/* --- the table -------------------------------------------------------------------------------------------------- */

static void take_columns(const work *w, size_t first, size_t count, double table[])
{
    double *to = table + first * w->rows * (size_t)w->width;
    for (size_t i = 0; i < count * w->rows; i++)
        for (int c = 0; c < w->width; c++) *to++ = iso_sample_column(&w->sample[i], w->columns[c]);
}

/* The library has numbered the orbits of a part from 0: their numbers in the whole stand in the message. */
static iso_status renumber(const work *w, size_t first, iso_status status)
{
    const char *words = iso_context_message(w->ctx), *reason = strstr(words, ": ");
    size_t i = 0;
    while (i < w->part && w->status[i] == ISO_OK) i++;
    if (first == 0 || i == w->part || strncmp(words, "orbit ", 6) != 0 || !reason) return status;
    char copy[512];
    strncpy(copy, reason + 2, sizeof copy - 1)[sizeof copy - 1] = '\0';
    return iso_context_fail(w->ctx, status, "", "orbit %zu: %s", first + i, copy);
}

/* An error of all orbits, or a stop, ends the work; that of one orbit does not. */
static bool ends(const work *w, size_t count, iso_status status)
{
    size_t i = 0;
    while (i < count && w->status[i] == ISO_OK) i++;
    return status == ISO_STOPPED || status == ISO_NO_MEMORY || (status != ISO_OK && i == count);
}

static iso_status run_parts(work *w, double table[], int32_t statuses[])
{
    iso_status answer = ISO_OK;
    for (size_t first = 0; first < w->count; first += w->part) {
        const size_t count = w->count - first < w->part ? w->count - first : w->part;
        if (answer != ISO_OK && !iso_context_goes_on(w->ctx))
            return iso_context_fail(w->ctx, ISO_STOPPED, "", "stopped on request");
        memset(w->status, 0, w->part * sizeof *w->status);
        const iso_status status =
            iso_batch_run(w->ctx, w->orbit + first, count, &w->how, w->times, w->rows, w->sample, w->status);
        if (ends(w, count, status)) return status;
        if (answer == ISO_OK && status != ISO_OK) answer = renumber(w, first, status);
        take_columns(w, first, count, table);
        for (size_t i = 0; statuses && i < count; i++) statuses[first + i] = (int32_t)w->status[i];
    }
    return answer;
}

iso_status iso_foreign_batch(iso_context *ctx, const iso_foreign_scene *const scene[], size_t scenes, size_t count,
                             const double k[], const double J[], const double start[], const double times[],
                             size_t rows, int threads, const char *vectors, double table[], int32_t status[])
{
    ISO_DEFAULT_ARITHMETIC;
    work w = {.ctx = ctx, .scene = scene, .scenes = scenes, .count = count, .rows = rows, .times = times};
    if (scenes == 0 || (scenes != 1 && scenes != count))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "scenes",
                                "%zu scenes for %zu orbits: give one, or one for each", scenes, count);
    if (count == 0) return ISO_OK;
    w.width = iso_scene_columns(scene_of(&w, 0), w.columns);
    iso_status answer = ISO_OK;
    for (size_t i = 0; answer == ISO_OK && i < scenes; i++) answer = check_scene(&w, i);
    choose_options(&w, threads, vectors);
    if (answer == ISO_OK) answer = make_params(&w, k, J);
    if (answer == ISO_OK) answer = make_starts(&w, start);
    if (answer == ISO_OK) answer = make_orbits(&w);
    if (answer == ISO_OK) answer = run_parts(&w, table, status);
    free(w.params);
    free(w.start);
    free(w.orbit);
    free(w.status);
    free(w.sample);
    return answer;
}
