/* view_section.c - a section file for the page: its crossings, and the first part of each orbit (see view.h).
 *
 * An orbit is computed from its first crossing in the file: from the states of that row, or from (l, x), which
 * determine a free orbit (map/section.h).
 */
#include "io/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "map/section.h"
#include "map/state.h"
#include "view.h"

enum { LEAST_ROWS = 60, MOST_ROWS = 1500, ORBIT_NUMBERS = 17 /* of a row: t tau s, M, gamma, q, its neighbour */ };
/* About how far the ball, n or gamma turns from row to row, in radians. LONG: if there are many orbits, each has few
 * rows, farther apart. */
#define ORBIT_TURN 0.15
#define LONG_ORBIT_TURN 0.3
#define MOST_ORBIT 9007199254740992.0 /* 2^53: doubles hold all whole numbers up to it */

typedef struct builder {
    iso_context *ctx;
    view_page *page;
    const iso_record *in;
    iso_model_kind model; /* of the states in the rows           */
    bool states;          /* the rows have states                */
    int orbit, l, x;      /* columns                             */
    size_t rows;          /* of each orbit                       */
} builder;

/* --- what the file must have ------------------------------------------------------------------------------------ */

static iso_status check(builder *b)
{
    const iso_record *r = b->in;
    int columns[ISO_STATE];
    const char *axis = iso_record_get(r, "axis");
    const bool ball = iso_record_find_all(r, ISO_STATE, iso_system_ball.state, columns, NULL);
    b->states = ball || iso_record_find_all(r, ISO_STATE, iso_system_point.state, columns, NULL);
    b->model = ball ? ISO_BALL : ISO_POINT;
    b->orbit = iso_record_find(r, "orbit");
    b->l = iso_record_find(r, "l");
    b->x = iso_record_find(r, "x");
    if (b->orbit < 0) return iso_context_fail(b->ctx, ISO_BAD_INPUT, "", "there is no column 'orbit'");
    if (b->l < 0 || b->x < 0)
        return iso_context_fail(b->ctx, ISO_BAD_INPUT, "",
                                "there are no columns 'l' and 'x': a page draws sections n_A = 0; write the file "
                                "with 'isoroll section --axis A', without --event");
    if (!axis || axis[0] < '1' || axis[0] > '3' || axis[1])
        return iso_context_fail(b->ctx, ISO_BAD_INPUT, "", "there is no line '# axis: 1', 2 or 3");
    b->page->section->axis = axis[0] - '1';
    if (!b->states && (iso_record_get(r, "effects") || isnan(b->page->eps)))
        return iso_context_fail(b->ctx, ISO_BAD_INPUT, "",
                                "l and x do not determine these orbits (there are effects, or no line '# eps'): "
                                "write the file with the states, by 'isoroll section --as ball'");
    return ISO_OK;
}

/* Numbers of orbits are whole; all others are finite. */
static iso_status check_rows(const builder *b)
{
    for (size_t i = 0; i < iso_record_rows(b->in); i++) {
        const double *row = iso_record_const_row(b->in, i), orbit = row[b->orbit];
        if (!(orbit >= 0 && orbit <= MOST_ORBIT && orbit == floor(orbit)))
            return iso_context_fail(b->ctx, ISO_BAD_INPUT, "",
                                    "row %zu: expected a whole number of 0 or more for orbit, found %s", i + 1,
                                    ISO_SHORT(orbit));
        for (size_t c = 0; c < iso_record_columns(b->in); c++)
            if (!isfinite(row[c]))
                return iso_context_fail(b->ctx, ISO_BAD_INPUT, "", "row %zu: expected a finite number for %s", i + 1,
                                        iso_record_name(b->in, c));
    }
    if (iso_record_rows(b->in) == 0)
        return iso_context_fail(b->ctx, ISO_BAD_INPUT, "", "expected rows of crossings, found the end of the file");
    return ISO_OK;
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

static size_t orbit_of(const builder *b, size_t row)
{
    return (size_t)iso_record_const_row(b->in, row)[b->orbit];
}

static size_t count_orbits(const builder *b)
{
    size_t count = 0;
    for (size_t i = 0; i < iso_record_rows(b->in); i++) count += i == 0 || orbit_of(b, i) != orbit_of(b, i - 1);
    return count;
}

/* The first crossings of each orbit, as many orbits and crossings as there is room for. */
static iso_status keep_crossings(builder *b)
{
    view_section *s = b->page->section;
    const size_t orbits = s->orbits < VIEW_MOST_ORBITS ? s->orbits : VIEW_MOST_ORBITS;
    const size_t each = VIEW_MOST_CROSSINGS / orbits;
    iso_status status = iso_record_create(b->ctx, 3, (const char *const[]){"orbit", "l", "x"}, &s->crossings);
    size_t first = 0, most = 0, orbit = 0;
    s->total = iso_record_rows(b->in);
    for (size_t i = 0; status == ISO_OK && i < s->total; i++) {
        const double *from = iso_record_const_row(b->in, i);
        if (orbit_of(b, i) != orbit_of(b, first)) first = i, orbit++;
        if (orbit == orbits) break;
        if (i - first + 1 > most) most = i - first + 1;
        if (i - first >= each) continue;
        status = iso_record_add(b->ctx, s->crossings, 1, (double[]){from[b->orbit], from[b->l], from[b->x]});
    }
    if (orbits < s->orbits) view_note(b->page, "The section shows the first %zu of %zu orbits.", orbits, s->orbits);
    if (most > each)
        view_note(b->page, "Of each orbit the section shows at most the first %zu crossings; the file has up to %zu.",
                  each, most);
    return status;
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

static iso_status start_of(const builder *b, size_t row, iso_start *start, iso_effects *effects)
{
    const view_page *page = b->page;
    const double *r = iso_record_const_row(b->in, row);
    double point[ISO_STATE];
    if (b->states) return iso_record_start(b->ctx, b->in, &page->params, b->model, row, start, effects);
    iso_section_point(iso_free_point(&page->params, page->eps), page->section->axis, r[b->l], r[b->x], point);
    return iso_start_point(b->ctx, point, point + 3, &page->eps, true, start);
}

/* A step of t in which neither the ball, n nor gamma turns by much more than `turn`. */
static double step_of(const view_page *page, const iso_start *start, double turn)
{
    const iso_params *p = &page->params;
    double ball[ISO_STATE];
    if (start->model == ISO_POINT)
        iso_point_to_ball(p, start->y, ball);
    else
        memcpy(ball, start->y, sizeof ball);
    const double speed = sqrt(ball[0] * ball[0] + ball[1] * ball[1] + ball[2] * ball[2]);
    return turn / (speed * fmax(1, fabs(p->k)));
}

static iso_status follow(const builder *b, iso_orbit *orbit, double step, iso_record *to)
{
    iso_status status = ISO_OK;
    for (size_t i = 0; status == ISO_OK && i < b->rows; i++) {
        iso_sample sample;
        double *row;
        status = iso_orbit_at(orbit, (double)i * step, &sample);
        if (status == ISO_OK) status = iso_record_append(b->ctx, to, &row);
        for (size_t j = 0; status == ISO_OK && j < iso_record_columns(to); j++)
            row[j] = iso_sample_get(&sample, iso_record_name(to, j));
        if (status == ISO_OK && iso_record_find(to, "t") == 0) row[0] = (double)i * step;
    }
    return status;
}

/* Columns of an orbit. If it has M and gamma, omega and n follow from them. */
static size_t columns_of(const view_page *page, const char *names[])
{
    static const char *const twin[] = {"t", "tau", "s", "M1", "M2", "M3", "gamma1", "gamma2", "gamma3"};
    static const char *const alone[] = {"t", "omega1", "omega2", "omega3", "n1", "n2", "n3"};
    static const char *const both[] = {"q0", "q1", "q2", "q3", "contact1", "contact2", "contact3"};
    const bool has_twin = !*page->alone;
    size_t count = 0;
    for (size_t i = 0; i < (has_twin ? 9 : 7); i++) names[count++] = has_twin ? twin[i] : alone[i];
    for (size_t i = 0; i < (page->params.k == 1 ? 7 : 4); i++) names[count++] = both[i];
    return count;
}

static iso_status run_orbit(const builder *b, size_t row, size_t i)
{
    view_section *s = b->page->section;
    iso_record **to = &s->orbit[i];
    const char *names[16];
    iso_start start;
    iso_orbit *orbit = NULL;
    iso_effects effects = b->page->effects;
    iso_status status = start_of(b, row, &start, &effects);
    if (status == ISO_OK) status = view_orbit(b->ctx, b->page, &start, &effects, ISO_CLOCK_T, &orbit);
    if (status == ISO_OK) status = iso_record_create(b->ctx, columns_of(b->page, names), names, to);
    if (status == ISO_OK)
        status = follow(b, orbit, step_of(b->page, &start, b->rows < 400 ? LONG_ORBIT_TURN : ORBIT_TURN), *to);
    iso_orbit_free(orbit);
    if (status == ISO_OK) status = view_neighbour(b->ctx, b->page, &start, &effects, *to, &s->beside[i]);
    return status;
}

/* Whether they are chaotic, each by its first crossing. `row`: of each orbit its first one. */
static iso_status judge(const builder *b, const size_t row[])
{
    const view_section *s = b->page->section;
    iso_start start;
    iso_effects effects = b->page->effects;
    double(*at)[2] = malloc(s->count * sizeof *at);
    if (!at) return iso_context_no_memory(b->ctx, "%zu orbits", s->count);
    for (size_t i = 0; i < s->count; i++) {
        const double *from = iso_record_const_row(b->in, row[i]);
        at[i][0] = from[b->l];
        at[i][1] = from[b->x];
    }
    iso_status status = start_of(b, row[0], &start, &effects);
    if (status == ISO_OK) status = view_judge_section(b->ctx, b->page, &start, &effects, (const double(*)[2])at);
    free(at);
    return status;
}

/* As many orbits as there is room for, each of at least LEAST_ROWS rows. */
static iso_status run_orbits(builder *b)
{
    view_section *s = b->page->section;
    const double most = floor(VIEW_MOST_NUMBERS / (ORBIT_NUMBERS * LEAST_ROWS));
    const size_t wanted = (double)s->orbits < most ? s->orbits : (size_t)most;
    b->rows = (size_t)fmin(floor(VIEW_MOST_NUMBERS / (ORBIT_NUMBERS * (double)wanted)), MOST_ROWS);
    s->orbit = calloc(wanted, sizeof *s->orbit);
    s->beside = calloc(wanted, sizeof *s->beside);
    s->fate = calloc(wanted, sizeof *s->fate);
    s->number = calloc(wanted, sizeof *s->number);
    size_t *row = calloc(wanted, sizeof *row); /* of each orbit its first one */
    iso_status status = s->orbit && s->beside && s->fate && s->number && row
                            ? ISO_OK
                            : iso_context_no_memory(b->ctx, "%zu orbits", wanted);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(b->in) && s->count < wanted; i++) {
        if (i > 0 && orbit_of(b, i) == orbit_of(b, i - 1)) continue;
        s->number[s->count] = orbit_of(b, i);
        row[s->count] = i;
        status = run_orbit(b, i, s->count++);
    }
    if (status == ISO_OK) status = judge(b, row);
    free(row);
    if (wanted < s->orbits)
        view_note(b->page, "The first %zu of the %zu orbits can run in this page.", wanted, s->orbits);
    return status;
}

/* --- the page --------------------------------------------------------------------------------------------------- */

static iso_status of_record(iso_context *ctx, const file_options *from, iso_record *in, view_page *page)
{
    builder b = {.ctx = ctx, .page = page, .in = in};
    ISO_TRY(view_read_lines(ctx, from, in, page));
    view_is_broken(page);
    ISO_TRY(check(&b));
    ISO_TRY(check_rows(&b));
    page->section->orbits = count_orbits(&b);
    ISO_TRY(keep_crossings(&b));
    return run_orbits(&b);
}

iso_status view_of_section(iso_context *ctx, const file_options *from, view_page *page)
{
    iso_record *in = NULL;
    page->section = calloc(1, sizeof *page->section);
    if (!page->section) return iso_context_no_memory(ctx, "a section");
    ISO_TRY(iso_table_read(ctx, from->file, NULL, NULL, &in, NULL)); /* its messages name the file */
    iso_status status = of_record(ctx, from, in, page);
    iso_record_free(in);
    return name_the_file(ctx, from->file, status);
}
