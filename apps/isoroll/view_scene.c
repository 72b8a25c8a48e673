/* view_scene.c - a scene for the page: the ball's orbit by its own equations, the point's by its own (see view.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "scene_options.h"
#include "view.h"

/* Two runs whose unit vectors differ by more are no longer the same orbit. */
#define PARTED 1e-3

static void show_progress(void *data, double part)
{
    (void)data;
    progress_show(part);
}

/* page NULL: notes are not wanted. */
static void keep_note(void *page, iso_run_note note, const char *words)
{
    (void)note;
    if (page) view_note(page, "%s", words);
}

/* Runs a scene at the given times (NULL: the scene's own) into a new record. */
static iso_status run_at(iso_context *ctx, const iso_scene *scene, const double times[], size_t count,
                         view_page *page, iso_record **rows)
{
    const iso_run_sink sink = {.note = keep_note, .progress = show_progress, .data = page, .record = rows};
    iso_run_options how = iso_run_defaults();
    how.times = times;
    how.count = count;
    *rows = NULL;
    const iso_status status = iso_run(ctx, scene, &how, &sink, NULL);
    if (status != ISO_OK) iso_record_free(*rows), *rows = NULL;
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
static iso_status find_times(iso_context *ctx, const iso_scene *scene, view_page *page)
{
    const size_t last = iso_scene_rows(scene) - 1, pieces = page->between + 1;
    page->count = (last + page->every - 1) / page->every * pieces + 1;
    free(page->times);
    page->times = malloc(page->count * sizeof *page->times);
    if (!page->times) return iso_context_no_memory(ctx, "the times");
    for (size_t n = 0; n < page->count; n++) {
        const size_t m = scene->end < 0 ? page->count - 1 - n : n, row = m / pieces * page->every;
        const double from = iso_scene_time(scene, row < last ? row : last);
        const double to = iso_scene_time(scene, row + page->every < last ? row + page->every : last);
        const double step = (to - from) / (double)pieces;
        page->times[n] = from + (double)(m % pieces) * step;
    }
    return ISO_OK;
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
    ISO_TRY(run_at(ctx, scene, NULL, 0, NULL, &rough));
    const double pieces = ceil(view_largest_turn(rough, scene->params.k) / VIEW_TURN);
    const double most = floor((double)(VIEW_MOST_ROWS - 1) / (double)(page->total - 1));
    page->between = (size_t)fmax(fmin(pieces, most), 1) - 1;
    iso_record_free(rough);
    return ISO_OK;
}

/* --- the two models --------------------------------------------------------------------------------------------- */

/* The ball by its own equations, with its attitude; with `twin` also the point that belongs to it. */
static iso_status run_with(iso_context *ctx, iso_scene *scene, bool twin, view_page *page)
{
    scene->as = twin ? ISO_SHOW_BOTH : ISO_SHOW_BALL;
    choose_columns(scene, twin);
    iso_status status = choose_rows(ctx, scene, page);
    if (status == ISO_OK) status = find_times(ctx, scene, page);
    return status == ISO_OK ? run_at(ctx, scene, page->times, page->count, page, &page->rows) : status;
}

/* The ball and its point, or the ball alone where it has none. */
static iso_status run_ball(iso_context *ctx, const iso_scene *asked, view_page *page)
{
    iso_scene scene = *asked;
    iso_status status = iso_effects_set(ctx, &scene.effects, "attitude", NULL, 0, NULL);
    scene.backend = ISO_BACKEND_BALL;
    if (status == ISO_OK) status = run_with(ctx, &scene, true, page);
    if (status != ISO_NOT_MAPPED || scene.start.model != ISO_BALL) return status;
    page->effects = scene.effects;
    page->notes = 0;
    if (!view_is_broken(page)) snprintf(page->alone, sizeof page->alone, "%s", iso_context_message(ctx));
    return run_with(ctx, &scene, false, page);
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
        double *row = iso_record_row(page->rows, i);
        double *gamma = row + iso_record_find(page->rows, "gamma1"), *M = row + iso_record_find(page->rows, "M1");
        const double to[] = {relative_difference(view_vector(page->rows, i, "n1"), view_vector(own, i, "n1")),
                             relative_difference(gamma, view_vector(own, i, "gamma1"))};
        status = iso_record_add(ctx, page->apart, 1, to);
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
static iso_status run_point(iso_context *ctx, const iso_scene *asked, view_page *page)
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
    iso_status status = run_at(ctx, &scene, page->times, iso_record_rows(page->rows), NULL, &own);
    if (status == ISO_OK)
        status = compare(ctx, page, own);
    else if (status != ISO_STOPPED && status != ISO_NO_MEMORY) {
        view_note(page, "The point was not integrated by itself: %s. It is computed from the ball, by the map.",
                  iso_context_message(ctx));
        status = ISO_OK;
    }
    iso_record_free(own);
    return status;
}

iso_status view_of_scene(iso_context *ctx, const iso_scene *scene, view_page *page)
{
    page->params = scene->params;
    page->attitude = scene->effects.on[ISO_ATTITUDE];
    page->clock = scene->start.model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    iso_status status = run_ball(ctx, scene, page);
    if (status == ISO_OK) status = view_read_effects(ctx, page->rows, page);
    if (status != ISO_OK || *page->alone) return status;
    iso_record_get_numbers(ctx, page->rows, "h", 1, &page->h, &status);
    iso_record_get_numbers(ctx, page->rows, "eps", 1, &page->eps, &status);
    /* where contact is lost, the ball's run has ended before the last of the times: the point's shall end there */
    const size_t last = iso_record_rows(page->rows) - 1;
    page->times[last] =
        iso_record_const_row(page->rows, last)[iso_record_find(page->rows, iso_clock_name(page->clock))];
    return run_point(ctx, scene, page);
}
