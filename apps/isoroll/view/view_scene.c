/* view_scene.c - a scene for the page: the ball's orbit by its own equations, the point's by its own (see view.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "study/study.h"
#include "view/view.h"

/* Two runs whose unit vectors differ by more are no longer the same orbit. */
#define PARTED 1e-3

/* The ball by its own equations, with its attitude, and the point that belongs to it. The rows are each `every`-th of
 * the scene and the last, or, after each but the last, `between` more. */
static iso_status run_ball(iso_context *ctx, iso_scene *scene, view_page *page, iso_record **rows)
{
    const char *names[ISO_TRAJECTORY_COLUMNS];
    const double step = scene->step;
    const size_t total = iso_scene_rows(scene), every = (total + VIEW_MOST_ROWS - 2) / (VIEW_MOST_ROWS - 1);
    size_t between = 0;
    scene->as = *page->alone ? ISO_SHOW_BALL : ISO_SHOW_BOTH;
    scene->columns = 0;
    for (size_t i = 0, count = view_columns(page, NULL, names); i < count; i++) view_ask_for(scene, names[i]);
    if (total < 2) return ISO_FAIL_INPUT(ctx, "end", "a page needs motion: the last time is 0");
    if (every == 1) {
        iso_record *rough;
        ISO_TRY(view_run(ctx, scene, NULL, 0, NULL, &rough));
        const double pieces = ceil(view_largest_turn(rough, scene->params.k) / VIEW_TURN);
        const double most = floor((double)(VIEW_MOST_ROWS - 1) / (double)(total - 1));
        between = (size_t)fmax(fmin(pieces, most), 1) - 1;
        iso_record_free(rough);
    }
    scene->step = fabs(iso_scene_time(scene, 1)) * (double)every / (double)(between + 1);
    const iso_status status = view_run(ctx, scene, NULL, 0, page, rows);
    if (status != ISO_OK) scene->step = step;
    ISO_TRY(status);
    ISO_TRY(view_count(ctx, *rows, "total", total));
    ISO_TRY(view_count(ctx, *rows, "every", every));
    return view_count(ctx, *rows, "between", between);
}

/* The same without the point where the ball has none. */
static iso_status run_scene(iso_context *ctx, iso_scene *scene, view_page *page, iso_record **rows)
{
    scene->backend = ISO_BACKEND_BALL;
    ISO_TRY(iso_effects_set(ctx, &scene->effects, "attitude", NULL, 0, NULL));
    page->effects = scene->effects;
    const iso_status status = run_ball(ctx, scene, page, rows);
    if (status != ISO_NOT_MAPPED || scene->start.model != ISO_BALL) return status;
    page->notes = 0;
    if (!view_is_broken(page)) snprintf(page->alone, sizeof page->alone, "%s", iso_context_message(ctx));
    return run_ball(ctx, scene, page, rows);
}

/* M and gamma of the rows become those of the point's own run; the table "compare" has how far both are apart. Says
 * from when on they differ by more than PARTED. */
static iso_status take_point(iso_context *ctx, view_page *page, iso_record *rows, const iso_record *apart,
                             const iso_record *point)
{
    static const char *const names[] = {"n", "gamma"};
    const int to = iso_record_find(rows, "M1"), from = iso_record_find(point, "M1");
    const char *clock = iso_clock_name(page->clock);
    iso_record *table;
    bool parted = false;
    ISO_TRY(iso_record_create(ctx, 2, names, &table));
    ISO_TRY(view_add(ctx, page, "compare", -1, table));
    for (size_t i = 0; i < iso_record_rows(rows) && i < iso_record_rows(point); i++) {
        const double by[] = {*view_vector(apart, i, "n"), *view_vector(apart, i, "gamma")};
        memcpy(iso_record_row(rows, i) + to, iso_record_const_row(point, i) + from, ISO_STATE * sizeof(double));
        ISO_TRY(iso_record_add(ctx, table, 1, by));
        if (parted || !(fmax(by[0], by[1]) > PARTED)) continue;
        parted = true;
        view_note(page,
                  "From %s = %.6g on the two computations part: this orbit is chaotic, or the time is too long.",
                  clock, *view_vector(rows, i, clock));
    }
    return ISO_OK;
}

/* The same orbit by the point's own equations, and how far both are apart: the tables of `compare`. */
static iso_status compare(iso_context *ctx, const iso_scene *asked, view_page *page, iso_record *rows)
{
    iso_scene scene = *asked;
    iso_study_result result = {.failed = false};
    /* where contact is lost, the ball's run has ended before the last of the times */
    scene.end = *view_vector(rows, iso_record_rows(rows) - 1, iso_clock_name(page->clock));
    iso_status status =
        iso_study_ask_text(ctx, iso_study_find("compare"), &(iso_study_subject){.scene = &scene}, NULL, &result);
    if (status == ISO_OK)
        status = take_point(ctx, page, rows, result.table[0], result.table[2]);
    else if (status != ISO_STOPPED && status != ISO_NO_MEMORY) {
        view_note(page, "The point was not integrated by itself: %s. It is computed from the ball, by the map.",
                  iso_context_message(ctx));
        status = ISO_OK;
    }
    iso_study_result_free(&result);
    return status;
}

/* Times that run backwards are played forwards. */
static void turn_round(iso_record *r)
{
    const size_t rows = iso_record_rows(r), columns = iso_record_columns(r);
    for (size_t i = 0; 2 * i + 1 < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            double *a = iso_record_row(r, i) + j, *b = iso_record_row(r, rows - 1 - i) + j, kept = *a;
            *a = *b;
            *b = kept;
        }
}

iso_status view_of_scene(iso_context *ctx, const iso_scene *asked, view_page *page)
{
    iso_scene scene = *asked;
    iso_record *rows = NULL;
    page->params = scene.params;
    page->attitude = scene.effects.on[ISO_ATTITUDE];
    page->clock = scene.start.model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    iso_status status = run_scene(ctx, &scene, page, &rows);
    if (status == ISO_OK) status = view_read_lines(ctx, NULL, rows, page);
    if (status == ISO_OK && !*page->alone) status = compare(ctx, &scene, page, rows);
    for (size_t i = 0; status == ISO_OK && scene.end < 0 && i < page->tables; i++) turn_round(page->table[i]);
    if (status == ISO_OK && scene.end < 0) turn_round(rows);
    if (status == ISO_OK) return view_add_orbit(ctx, page, rows);
    iso_record_free(rows);
    return status;
}
