/* view_scene.c - a scene for the page: the ball's orbit by its own equations, the point's by its own (see view.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene_options.h"
#include "view.h"

/* Two runs whose unit vectors differ by more are no longer the same orbit. */
#define PARTED 1e-3

/* Rows of a run. */
typedef struct collector {
    iso_context *ctx;
    view_page *page; /* NULL: notes are not wanted */
    iso_record *rows;
} collector;

static iso_status keep_header(void *data, const iso_record *header)
{
    collector *c = data;
    return iso_record_create_like(c->ctx, header, 0, NULL, &c->rows);
}

static iso_status keep_row(void *data, const double row[], size_t count)
{
    collector *c = data;
    double *to;
    const iso_status status = iso_record_append(c->ctx, c->rows, &to);
    if (status == ISO_OK) memcpy(to, row, count * sizeof *row);
    return status;
}

static void show_progress(void *data, double part)
{
    (void)data;
    progress_show(part);
}

static void keep_note(void *data, iso_run_note note, const char *words)
{
    collector *c = data;
    (void)note;
    if (c->page) view_note(c->page, "%s", words);
}

/* Runs a scene at the given times (count 0: the scene's own) into a new record. */
static iso_status run_at(iso_context *ctx, const iso_scene *scene, const double times[], size_t count,
                         view_page *page, iso_record **rows)
{
    collector c = {ctx, page, NULL};
    const iso_run_sink sink = {
        .header = keep_header, .row = keep_row, .note = keep_note, .progress = show_progress, .data = &c};
    iso_run_options how = iso_run_defaults();
    iso_run_result result;
    how.times = count > 0 ? times : NULL;
    how.count = count;
    const iso_status status = iso_run(ctx, scene, &how, &sink, &result);
    *rows = c.rows;
    if (status == ISO_OK) return status;
    iso_record_free(c.rows);
    *rows = NULL;
    return status;
}

/* --- columns ---------------------------------------------------------------------------------------------------- */

/* All columns of the effects that are on, of both models or of the ball alone. */
static void choose_columns(iso_scene *scene, bool twin)
{
    scene->columns = 0;
    for (int c = 0; c < iso_columns_count() && scene->columns < ISO_MAX_COLUMNS; c++) {
        iso_effect_id effect = ISO_EFFECTS;
        if (c >= ISO_COLUMN_EFFECTS) iso_effect_column_name(c - ISO_COLUMN_EFFECTS, &effect, NULL, NULL);
        if ((view_is_of_point(c) && !twin) || (effect != ISO_EFFECTS && !scene->effects.on[effect])) continue;
        if (effect == ISO_ATTITUDE && strncmp(iso_column_name(c), "trace", 5) == 0) continue; /* -b n */
        snprintf(scene->column[scene->columns++], ISO_NAME_SIZE, "%s", iso_column_name(c));
    }
}

/* --- times ------------------------------------------------------------------------------------------------------ */

/* The times of the page, growing: those of each `every`-th row of the scene and of the last row. After each but the
 * last there are `between` more. */
static double *times_of(const iso_scene *scene, const view_page *page, size_t *count)
{
    const size_t rows = iso_scene_rows(scene), pieces = page->between + 1;
    const size_t steps = (rows - 1 + page->every - 1) / page->every;
    double *times = malloc((steps * pieces + 1) * sizeof *times);
    if (!times) return NULL;
    *count = 0;
    for (size_t i = 0; i < steps; i++) {
        const double from = iso_scene_time(scene, i * page->every);
        const size_t last = (i + 1) * page->every < rows - 1 ? (i + 1) * page->every : rows - 1;
        const double step = (iso_scene_time(scene, last) - from) / (double)pieces;
        for (size_t j = 0; j < pieces; j++) times[(*count)++] = from + (double)j * step;
    }
    times[(*count)++] = iso_scene_time(scene, rows - 1);
    for (size_t i = 0, j = *count - 1; scene->end < 0 && i < j; i++, j--) {
        const double swapped = times[i];
        times[i] = times[j];
        times[j] = swapped;
    }
    return times;
}

/* Chooses page->every, or runs the scene once at its own times and chooses page->between. */
static iso_status choose_rows(iso_context *ctx, const iso_scene *scene, view_page *page)
{
    iso_record *rough;
    page->total = iso_scene_rows(scene);
    if (page->total < 2)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "end", "a page needs motion: the last time is 0");
    page->every = (page->total + VIEW_MOST_ROWS - 2) / (VIEW_MOST_ROWS - 1);
    page->between = 0;
    if (page->every > 1) return ISO_OK;
    const iso_status status = run_at(ctx, scene, NULL, 0, NULL, &rough);
    if (status != ISO_OK) return status;
    const double pieces = ceil(view_largest_turn(rough, scene->params.k) / VIEW_TURN);
    const double most = floor((double)(VIEW_MOST_ROWS - 1) / (double)(page->total - 1));
    page->between = (size_t)fmax(fmin(pieces, most), 1) - 1;
    iso_record_free(rough);
    return ISO_OK;
}

/* --- the two models --------------------------------------------------------------------------------------------- */

/* The ball by its own equations, with its attitude; with `twin` also the point that belongs to it. */
static iso_status run_with(iso_context *ctx, iso_scene *scene, bool twin, view_page *page, double **times,
                           size_t *count)
{
    scene->as = twin ? ISO_SHOW_BOTH : ISO_SHOW_BALL;
    choose_columns(scene, twin);
    const iso_status status = choose_rows(ctx, scene, page);
    if (status != ISO_OK) return status;
    free(*times);
    *times = times_of(scene, page, count);
    if (!*times) return iso_context_no_memory(ctx, "the times");
    return run_at(ctx, scene, *times, *count, page, &page->rows);
}

/* The ball and its point, or the ball alone where it has none. */
static iso_status run_ball(iso_context *ctx, const iso_scene *asked, view_page *page, double **times, size_t *count)
{
    iso_scene scene = *asked;
    iso_status status = iso_effects_set(ctx, &scene.effects, "attitude", NULL, 0, NULL);
    scene.backend = ISO_BACKEND_BALL;
    if (status == ISO_OK) status = run_with(ctx, &scene, true, page, times, count);
    if (status != ISO_NOT_MAPPED || scene.start.model != ISO_BALL) return status;
    page->effects = scene.effects;
    page->notes = 0;
    if (!view_is_broken(page)) snprintf(page->alone, sizeof page->alone, "%s", iso_context_message(ctx));
    return run_with(ctx, &scene, false, page, times, count);
}

/* Puts the columns M and gamma of the point's own run into the rows of the page, and how far n and gamma of the two
 * runs differ into page->apart. Says from when on they differ by more than PARTED. */
static iso_status compare(iso_context *ctx, view_page *page, const iso_record *own)
{
    static const char *const names[] = {"apart_n", "apart_gamma"};
    const char *clock = iso_clock_name(page->clock);
    bool parted = false;
    iso_status status = iso_record_create(ctx, 2, names, &page->apart);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(page->rows); i++) {
        double *to, *row = iso_record_row(page->rows, i);
        double *gamma = row + iso_record_find(page->rows, "gamma1"), *M = row + iso_record_find(page->rows, "M1");
        status = iso_record_append(ctx, page->apart, &to);
        if (status != ISO_OK) break;
        to[0] = view_distance(view_vector(page->rows, i, "n1"), view_vector(own, i, "n1"));
        to[1] = view_distance(gamma, view_vector(own, i, "gamma1"));
        memcpy(gamma, view_vector(own, i, "gamma1"), 3 * sizeof *gamma);
        memcpy(M, view_vector(own, i, "M1"), 3 * sizeof *M);
        if (parted || !(fmax(to[0], to[1]) > PARTED)) continue;
        parted = true;
        view_note(page,
                  "From %s = %.6g on the two computations part: this orbit is chaotic, or the time is too long.",
                  clock, row[iso_record_find(page->rows, clock)]);
    }
    return status;
}

/* The same orbit by the point's own equations. */
static iso_status run_point(iso_context *ctx, const iso_scene *asked, view_page *page, const double times[],
                            size_t count)
{
    static const char *const names[] = {"n1", "n2", "n3", "M1", "M2", "M3", "gamma1", "gamma2", "gamma3"};
    iso_record *own = NULL;
    iso_scene scene = *asked;
    scene.backend = ISO_BACKEND_POINT;
    scene.as = ISO_SHOW_BOTH;
    snprintf(scene.method, sizeof scene.method, "auto");
    scene.effects = iso_scene_acting(asked);
    scene.columns = sizeof names / sizeof *names;
    for (size_t i = 0; i < scene.columns; i++) snprintf(scene.column[i], ISO_NAME_SIZE, "%s", names[i]);
    iso_status status = run_at(ctx, &scene, times, count, NULL, &own);
    if (status == ISO_OK) {
        status = compare(ctx, page, own);
        iso_record_free(own);
        return status;
    }
    if (status == ISO_STOPPED || status == ISO_NO_MEMORY) return status;
    view_note(page, "The point was not integrated by itself: %s. It is computed from the ball, by the map.",
              iso_context_message(ctx));
    return ISO_OK;
}

/* The ball's run may have ended before the last of the times, where contact is lost: the point's shall end there. */
static size_t end_of(const view_page *page, double times[])
{
    const size_t count = iso_record_rows(page->rows);
    const int clock = iso_record_find(page->rows, iso_clock_name(page->clock));
    if (clock >= 0) times[count - 1] = iso_record_const_row(page->rows, count - 1)[clock];
    return count;
}

iso_status view_of_scene(iso_context *ctx, const iso_scene *scene, view_page *page)
{
    double *times = NULL;
    size_t count;
    page->params = scene->params;
    page->clock = scene->start.model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    iso_status status = run_ball(ctx, scene, page, &times, &count);
    if (status == ISO_OK) status = view_read_effects(ctx, page->rows, page);
    if (status == ISO_OK && !*page->alone) {
        iso_record_get_numbers(ctx, page->rows, "h", 1, &page->h, &status);
        iso_record_get_numbers(ctx, page->rows, "eps", 1, &page->eps, &status);
        count = end_of(page, times);
        status = run_point(ctx, scene, page, times, count);
    }
    free(times);
    return status;
}
