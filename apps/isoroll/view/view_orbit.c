/* view_orbit.c - orbits of a page, and what is found out about them (see view.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "picture/picture.h"
#include "study/study.h"
#include "task/check/check_impl.h"
#include "task/run.h"
#include "view/view.h"

/* Only memory and a stop end the page. An orbit at rest, or one that loses energy, has no verdict and no neighbour. */
static bool is_fatal(iso_status status)
{
    return status == ISO_NO_MEMORY || status == ISO_STOPPED;
}

/* --- runs ------------------------------------------------------------------------------------------------------- */

size_t view_columns(const view_page *page, const iso_record *rows, const char *names[ISO_TRAJECTORY_COLUMNS])
{
    size_t count = 0;
    for (int c = 0; c < iso_columns_count(); c++) {
        iso_effect_id effect = ISO_EFFECTS;
        const char *name = iso_column_name(c);
        const bool of_point =
            c == ISO_CLOCK_TAU || c == ISO_CLOCK_S || (c >= ISO_COLUMN_POINT && c < ISO_COLUMN_EFFECTS);
        if (of_point && *page->alone) continue;
        if (c >= ISO_COLUMN_EFFECTS) iso_effect_column_name(c - ISO_COLUMN_EFFECTS, &effect, NULL, NULL);
        if (effect == ISO_EFFECTS    ? true
            : effect == ISO_ATTITUDE ? name[0] == 'q' || (page->params.k == 1 && strncmp(name, "contact", 7) == 0)
            : rows                   ? iso_record_find(rows, name) >= 0
                                     : page->effects.on[effect])
            names[count++] = name;
    }
    return count;
}

void view_ask_for(iso_scene *scene, const char *columns)
{
    int used = 0;
    while (scene->columns < ISO_MAX_COLUMNS && sscanf(columns, "%31s%n", scene->column[scene->columns], &used) == 1)
        columns += used, scene->columns++;
}

iso_status view_start(iso_context *ctx, const view_page *page, const iso_record *r, size_t row, iso_scene *scene)
{
    iso_start *start = &scene->start;
    const bool ball = iso_record_find(r, "omega1") >= 0 && iso_record_find(r, "n1") >= 0;
    *scene = iso_scene_default();
    scene->params = page->params;
    scene->effects = page->effects;
    scene->backend = ISO_BACKEND_BALL;
    scene->as = *page->alone ? ISO_SHOW_BALL : ISO_SHOW_BOTH;
    ISO_TRY(iso_record_start(ctx, r, &page->params, ball ? ISO_BALL : ISO_POINT, row, start, &scene->effects));
    scene->effects.on[ISO_ATTITUDE] = true;
    if (ball) return ISO_OK;
    iso_point_to_ball(&page->params, start->y, start->y);
    start->model = ISO_BALL;
    return ISO_OK;
}

static void keep_note(void *page, const char *text)
{
    if (page) view_note(page, "%s", text);
}

iso_status view_run(iso_context *ctx, const iso_scene *scene, const double times[], size_t count, view_page *page,
                    iso_record **rows)
{
    const iso_sink sink = {.note = keep_note, .progress = progress_sink, .data = page};
    const iso_run_options o = {.times = times, .count = count};
    *rows = NULL;
    const iso_status status = iso_run(ctx, scene, &o, &sink, rows, NULL);
    if (status != ISO_OK) iso_record_free(*rows), *rows = NULL;
    return status;
}

/* --- the neighbour ---------------------------------------------------------------------------------------------- */

/* Both orbits at the times t of the rows. The neighbour's omega is turned about n, so that (omega, n) = 0 stays. */
static iso_status run_both(iso_context *ctx, const view_page *page, iso_scene *scene, const iso_record *rows,
                           iso_record *both[2])
{
    const size_t count = iso_record_rows(rows);
    double turned[3], *t = malloc(count * sizeof *t);
    if (!t) return iso_context_no_memory(ctx, "the times");
    for (size_t i = 0; i < count; i++) t[i] = *view_vector(rows, i, "t") - *view_vector(rows, 0, "t");
    scene->columns = 0;
    view_ask_for(scene, "omega1 omega2 omega3 n1 n2 n3");
    if (!*page->alone) view_ask_for(scene, "gamma1 gamma2 gamma3");
    scene->effects = iso_scene_acting(scene);
    iso_status status = view_run(ctx, scene, t, count, NULL, &both[0]);
    cross(scene->start.y + 3, scene->start.y, turned);
    for (int i = 0; i < 3; i++) scene->start.y[i] += VIEW_BESIDE * turned[i];
    if (status == ISO_OK) status = view_run(ctx, scene, t, count, NULL, &both[1]);
    free(t);
    return status;
}

static double distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

iso_status view_neighbour(iso_context *ctx, view_page *page, const iso_scene *start, double orbit,
                          const iso_record *rows)
{
    static const char *const of_n[] = {"n1", "n2", "n3", "distance"};
    static const char *const of_gamma[] = {"gamma1", "gamma2", "gamma3", "distance"};
    const char *const *names = *page->alone ? of_n : of_gamma;
    iso_record *both[2] = {NULL, NULL}, *table = NULL;
    iso_scene scene = *start;
    if (largest(start->start.y) == 0) return ISO_OK; /* there is no omega to turn */
    iso_status status = run_both(ctx, page, &scene, rows, both);
    if (status == ISO_OK) status = iso_record_create(ctx, 4, names, &table);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(both[0]) && i < iso_record_rows(both[1]); i++) {
        const double *a = iso_record_const_row(both[0], i), *b = iso_record_const_row(both[1], i);
        const double *seen = view_vector(both[1], i, names[0]),
                     speed = distance(iso_record_const_row(both[0], 0), (double[]){0, 0, 0});
        const double apart = hypot(distance(a, b) / speed, distance(a + 3, b + 3)); /* of (omega/speed, n) */
        status = iso_record_add(ctx, table, 1, (double[]){seen[0], seen[1], seen[2], apart});
    }
    if (status == ISO_OK) status = view_add(ctx, page, "neighbour", orbit, table);
    iso_record_free(both[0]);
    iso_record_free(both[1]);
    return is_fatal(status) ? status : ISO_OK;
}

/* --- verdicts --------------------------------------------------------------------------------------------------- */

/* The rows of `chaos` as the table "orbits"; of a section those from the second on are the starts, by their numbers
 * from 1 on. */
static iso_status keep_verdicts(iso_context *ctx, view_page *page, const iso_record *chaos, const iso_record *section,
                                const size_t first[], const iso_record *shades)
{
    static const char *const names[] = {"orbit", "verdict", "exponent", "shade"};
    static const char *const names_of_shades[] = {"colour", "grey", "dark"}; /* iso_picture_shade */
    const int verdict = iso_record_find(chaos, "verdict"), exponent = iso_record_find(chaos, "ball_exponent_t");
    iso_record *r;
    ISO_TRY(iso_record_create_like(ctx, chaos, 4, names, &r));
    ISO_TRY(view_add(ctx, page, "orbits", -1, r));
    iso_record_set_words(r, 1, true);
    iso_record_set_words(r, 3, true);
    for (size_t i = section ? 1 : 0; i < iso_record_rows(chaos); i++) {
        const double *from = iso_record_const_row(chaos, i);
        double row[] = {section ? *view_vector(section, first[(size_t)from[0] - 1], "orbit") : 0, 0, from[exponent],
                        0};
        ISO_TRY(iso_record_intern(ctx, r, iso_record_word(chaos, from[verdict]), &row[1]));
        const char *shade = "";
        for (size_t o = 0; shades && o < iso_record_rows(shades); o++)
            if (iso_record_const_row(shades, o)[0] == row[0])
                shade = names_of_shades[(int)iso_record_const_row(shades, o)[1]];
        ISO_TRY(iso_record_intern(ctx, r, shade, &row[3]));
        ISO_TRY(iso_record_add(ctx, r, 1, row));
    }
    return ISO_OK;
}

/* The options of `chaos`. After so many turns an orbit without a verdict stays undecided, and an exponent is good
 * enough for the page. The caller frees them; NULL: no memory. */
static char *options_of(const iso_record *section, size_t count, const size_t first[])
{
    size_t size = 0;
    char *text = NULL;
    FILE *f = open_memstream(&text, &size);
    if (!f) return NULL;
    fprintf(f, "model=ball\nturns=1000\n%s", section ? "at=" : "exponent-turns=1000");
    for (size_t i = 0; section && i < count; i++)
        fprintf(f, "%s%s,%s", i ? ";" : "", ISO_SHORT(*view_vector(section, first[i], "l")),
                ISO_SHORT(*view_vector(section, first[i], "x")));
    if (section) fprintf(f, "\naxis=%s", iso_record_get(section, "axis"));
    const bool good = !ferror(f);
    return fclose(f) == 0 && good ? text : (free(text), NULL);
}

iso_status view_verdicts(iso_context *ctx, view_page *page, const iso_scene *start, const iso_record *section,
                         size_t count, const size_t first[])
{
    iso_study_result result = {.failed = false};
    iso_picture picture = {.layout = NULL};
    iso_scene scene = *start;
    char *options = options_of(section, count, first);
    scene.effects = iso_scene_acting(start);
    scene.end = 1;
    iso_status status = options ? iso_study_ask_text(ctx, iso_study_find("chaos"),
                                                     &(iso_study_subject){.scene = &scene}, options, &result)
                                : iso_context_no_memory(ctx, "%zu orbits", count);
    if (status == ISO_OK && section)
        status = iso_picture_make(ctx, (const iso_record *[]){section, result.table[0], NULL}, NULL, &picture);
    if (status == ISO_OK)
        status = keep_verdicts(ctx, page, result.table[0], section, first, iso_picture_table(&picture, "orbits"));
    else if (!is_fatal(status) && section)
        view_note(page, "Which orbits are chaotic is not known: %s.", iso_context_message(ctx));
    iso_picture_free(&picture);
    iso_study_result_free(&result);
    free(options);
    return is_fatal(status) ? status : ISO_OK;
}

/* --- the orbit of a scene or of a trajectory -------------------------------------------------------------------- */

const double *view_vector(const iso_record *r, size_t row, const char *name)
{
    const int column = iso_record_find(r, name);
    return column < 0 ? NULL : iso_record_const_row(r, row) + column;
}

double view_largest_turn(const iso_record *r, double k)
{
    double most = 0;
    for (size_t i = 1; iso_record_find(r, "t") >= 0 && i < iso_record_rows(r); i++) {
        const double *before = view_vector(r, i - 1, "gamma1"), *now = view_vector(r, i, "gamma1");
        const double dt = fabs(*view_vector(r, i, "t") - *view_vector(r, i - 1, "t"));
        for (size_t j = i - 1; j <= i; j++) {
            const double *omega = view_vector(r, j, "omega1");
            most = fmax(most, distance(omega, (double[]){0, 0, 0}) * dt * fmax(1, fabs(k)));
        }
        if (now) most = fmax(most, distance(now, before));
    }
    return most;
}

iso_status view_add_orbit(iso_context *ctx, view_page *page, iso_record *rows)
{
    const double turn = view_largest_turn(rows, page->params.k), degrees = turn * 180 / acos(-1);
    iso_scene scene;
    ISO_TRY(view_add(ctx, page, "trajectory", -1, rows));
    if (turn > 1) /* the error of cubic curves between rows is turn^4/384; from one radian on they are a guess */
        view_note(page, "Rows turn by up to %.0f degrees: between them the motion is a guess.", degrees);
    else if (turn > 2 * VIEW_TURN)
        view_note(page, "Rows turn by up to %.0f degrees: between them the motion is off by about %.0e radians.",
                  degrees, pow(turn, 4) / 384);
    iso_status status = view_start(ctx, page, rows, 0, &scene);
    if (status != ISO_OK) return is_fatal(status) ? status : ISO_OK;
    for (int model = 0; model < (*page->alone ? 1 : 2); model++) {
        iso_record *drifts;
        status = iso_check_drifts(ctx, &page->params, rows, model, &drifts);
        if (status == ISO_OK) status = view_add(ctx, page, "drifts", -1, drifts);
        if (is_fatal(status)) return status;
    }
    if (page->no_orbit) return ISO_OK;
    ISO_TRY(view_verdicts(ctx, page, &scene, NULL, 0, NULL));
    return view_neighbour(ctx, page, &scene, -1, rows);
}
