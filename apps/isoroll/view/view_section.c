/* view_section.c - a section file for the page: its crossings, and the first part of each orbit (see view.h).
 *
 * An orbit is computed from its first crossing in the file: from the states of that row, or from (l, x), which
 * determine a free orbit (map/section.h).
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "io/table.h"
#include "map/section.h"
#include "map/state.h"
#include "view/view.h"

enum { MOST_VERDICTS = 3000 /* they take seconds */ };
enum { LEAST_ROWS = 60, MOST_ROWS = 1500, ORBIT_NUMBERS = 17 /* of a row: t tau s, M, gamma, q, its neighbour */ };
/* About how far the ball, n or gamma turns from row to row, in radians. LONG: if there are many orbits, each has few
 * rows, farther apart. */
#define ORBIT_TURN 0.15
#define LONG_ORBIT_TURN 0.3
#define MOST_ORBIT 9007199254740992.0 /* 2^53: doubles hold all whole numbers up to it */

typedef struct section {
    const iso_record *in;
    bool states;     /* the rows have states */
    int orbit, l, x; /* columns              */
    size_t *first;   /* row of each orbit's first crossing */
    size_t orbits;
} section;

/* --- what the file must have ------------------------------------------------------------------------------------ */

static iso_status check(iso_context *ctx, const view_page *page, section *s)
{
    const iso_record *r = s->in;
    int columns[ISO_STATE];
    const char *axis = iso_record_get(r, "axis");
    s->states = iso_record_find_all(r, ISO_STATE, iso_system_ball.state, columns, NULL) ||
                iso_record_find_all(r, ISO_STATE, iso_system_point.state, columns, NULL);
    s->orbit = iso_record_find(r, "orbit");
    s->l = iso_record_find(r, "l");
    s->x = iso_record_find(r, "x");
    if (s->orbit < 0) return ISO_FAIL_INPUT(ctx, "", "there is no column 'orbit'");
    if (s->l < 0 || s->x < 0)
        return ISO_FAIL_INPUT(ctx, "",
                              "there are no columns 'l' and 'x': a page draws sections n_A = 0; write the file "
                              "with 'isoroll section --axis A', without --event");
    if (!axis || axis[0] < '1' || axis[0] > '3' || axis[1])
        return ISO_FAIL_INPUT(ctx, "", "there is no line '# axis: 1', 2 or 3");
    if (!s->states && (iso_record_get(r, "effects") || isnan(page->eps)))
        return ISO_FAIL_INPUT(ctx, "",
                              "l and x do not determine these orbits (there are effects, or no line '# eps'): "
                              "write the file with the states, by 'isoroll section --as ball'");
    return ISO_OK;
}

/* Numbers of orbits are whole; all others are finite. Finds the rows where orbits begin. */
static iso_status find_orbits(iso_context *ctx, section *s)
{
    const size_t rows = iso_record_rows(s->in);
    double before = -1;
    if (rows == 0) return ISO_FAIL_INPUT(ctx, "", "expected rows of crossings, found the end of the file");
    s->first = malloc((rows + 1) * sizeof *s->first);
    if (!s->first) return iso_context_no_memory(ctx, "%zu crossings", rows);
    for (size_t i = 0; i < rows; i++) {
        const double *row = iso_record_const_row(s->in, i), orbit = row[s->orbit];
        if (!(orbit >= 0 && orbit <= MOST_ORBIT && orbit == floor(orbit)))
            return ISO_FAIL_INPUT(ctx, "", "row %zu: expected a whole number of 0 or more for orbit, found %s", i + 1,
                                  ISO_SHORT(orbit));
        for (size_t c = 0; c < iso_record_columns(s->in); c++)
            if (!isfinite(row[c]))
                return ISO_FAIL_INPUT(ctx, "", "row %zu: expected a finite number for %s", i + 1,
                                      iso_record_name(s->in, c));
        if (orbit != before) s->first[s->orbits++] = i;
        before = orbit;
    }
    s->first[s->orbits] = rows;
    return ISO_OK;
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

/* The table "section": the first crossings of each orbit, as many orbits and crossings as there is room for. */
static iso_status add_crossings(iso_context *ctx, view_page *page, const section *s)
{
    static const char *const names[] = {"orbit", "l", "x"};
    const size_t orbits = s->orbits < VIEW_MOST_ORBITS ? s->orbits : VIEW_MOST_ORBITS;
    const size_t each = VIEW_MOST_CROSSINGS / orbits;
    size_t most = 0;
    iso_record *r;
    ISO_TRY(iso_record_create(ctx, 3, names, &r));
    ISO_TRY(view_add(ctx, page, "section", -1, r));
    ISO_TRY(iso_record_set(ctx, r, "axis", iso_record_get(s->in, "axis")));
    for (size_t o = 0; o < orbits; o++) {
        const size_t count = s->first[o + 1] - s->first[o];
        if (count > most) most = count;
        for (size_t i = 0; i < count && i < each; i++) {
            const double *from = iso_record_const_row(s->in, s->first[o] + i);
            ISO_TRY(iso_record_add(ctx, r, 1, (double[]){from[s->orbit], from[s->l], from[s->x]}));
        }
    }
    if (orbits < s->orbits) view_note(page, "The section shows the first %zu of %zu orbits.", orbits, s->orbits);
    if (most > each)
        view_note(page, "Of each orbit the section shows at most the first %zu crossings; the file has up to %zu.",
                  each, most);
    return ISO_OK;
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* The scene that starts at a crossing. */
static iso_status start_at(iso_context *ctx, const view_page *page, const section *s, size_t row, iso_scene *scene)
{
    static const char *const names[] = {"M1", "M2", "M3", "gamma1", "gamma2", "gamma3"};
    const double *r = iso_record_const_row(s->in, row);
    double point[ISO_STATE];
    iso_record *one;
    if (s->states) return view_start(ctx, page, s->in, row, scene);
    iso_section_point(iso_free_point(&page->params, page->eps), *iso_record_get(s->in, "axis") - '1', r[s->l],
                      r[s->x], point);
    ISO_TRY(iso_record_create_like(ctx, s->in, ISO_STATE, names, &one));
    iso_status status = iso_record_add(ctx, one, 1, point);
    if (status == ISO_OK) status = view_start(ctx, page, one, 0, scene);
    iso_record_free(one);
    return status;
}

/* The first `rows` rows of the orbit, close enough for cubic curves; omega and n follow from M and gamma. */
static iso_status run_orbit(iso_context *ctx, view_page *page, const section *s, size_t row, size_t rows)
{
    const double number = iso_record_const_row(s->in, row)[s->orbit];
    iso_record *orbit;
    iso_scene scene;
    ISO_TRY(start_at(ctx, page, s, row, &scene));
    view_ask_for(&scene, *page->alone ? "t omega1 omega2 omega3 n1 n2 n3 q0 q1 q2 q3"
                                      : "t tau s M1 M2 M3 gamma1 gamma2 gamma3 q0 q1 q2 q3");
    if (page->params.k == 1) view_ask_for(&scene, "contact1 contact2 contact3");
    const double turn = rows < 400 ? LONG_ORBIT_TURN : ORBIT_TURN;
    scene.step = turn / (norm(scene.start.y) * fmax(1, fabs(page->params.k)));
    scene.end = (double)(rows - 1) * scene.step;
    ISO_TRY(view_run(ctx, &scene, NULL, 0, NULL, &orbit));
    ISO_TRY(view_add(ctx, page, "trajectory", number, orbit));
    return view_neighbour(ctx, page, &scene, number, orbit);
}

/* As many orbits as there is room for, each of at least LEAST_ROWS rows, and which of them are chaotic. */
static iso_status add_orbits(iso_context *ctx, view_page *page, const section *s)
{
    const double most = floor(VIEW_MOST_NUMBERS / (ORBIT_NUMBERS * LEAST_ROWS));
    const size_t count = (double)s->orbits < most ? s->orbits : (size_t)most;
    const double rows = fmin(floor(VIEW_MOST_NUMBERS / (ORBIT_NUMBERS * (double)count)), MOST_ROWS);
    iso_scene scene;
    for (size_t o = 0; o < count; o++) ISO_TRY(run_orbit(ctx, page, s, s->first[o], (size_t)rows));
    if (count < s->orbits) view_note(page, "The first %zu of the %zu orbits can run in this page.", count, s->orbits);
    ISO_TRY(start_at(ctx, page, s, s->first[0], &scene));
    return view_verdicts(ctx, page, &scene, s->in, s->orbits < MOST_VERDICTS ? s->orbits : MOST_VERDICTS, s->first);
}

iso_status view_of_section(iso_context *ctx, const file_options *from, view_page *page)
{
    section s = {.orbits = 0};
    iso_record *in = NULL;
    ISO_TRY(iso_table_read(ctx, from->file, NULL, NULL, &in, NULL)); /* its messages name the file */
    s.in = in;
    iso_status status = view_read_lines(ctx, from, in, page);
    if (status == ISO_OK) status = check(ctx, page, &s);
    if (status == ISO_OK) status = find_orbits(ctx, &s);
    if (status == ISO_OK) status = add_crossings(ctx, page, &s);
    if (status == ISO_OK) status = add_orbits(ctx, page, &s);
    free(s.first);
    iso_record_free(in);
    return name_the_file(ctx, from->file, status);
}
