/* view_complete.c - gives rows of a file the columns that a page needs (see view.h). The other model comes from the
 * map (18); the clocks and the attitude come from short orbits.
 *
 * A short orbit begins at a row and gives the clocks, q, contact and centre at the next SEGMENT rows. There the next
 * one begins. So these columns stay close to the file's own rows, also on chaotic orbits. Where a short orbit misses
 * a row of the file by more than MISSED, the next one begins at the row before. If that one misses it too, the rows
 * are no orbit.
 */
#include <math.h>
#include <string.h>

#include "map/state.h"
#include "orbit/convert_impl.h"
#include "view.h"

/* An orbit misses a row if it is farther from it. */
#define MISSED 1e-3

enum { SEGMENT = 16 };

typedef struct completion {
    iso_context *ctx;
    const view_page *page;
    const iso_record *in;
    iso_record *out;
    int column[ISO_TRAJECTORY_COLUMNS]; /* of the result, as iso_column_name counts     */
    bool given[ISO_TRAJECTORY_COLUMNS]; /* the file has it                              */
    int q, contact, centre;             /* places in iso_sample.effect                  */
    iso_model_kind model;               /* whose states the rows have                   */
    iso_clock clock;                    /* that gives the times of the rows             */
    double begun[ISO_CLOCKS];           /* clocks where this short orbit began          */
    double shift[3];                    /* on a plane: the contact there                */
    double attitude[4];                 /* there                                        */
    double bound, speed;                /* a row is missed by more; largest |omega|     */
    view_miss *worst;
} completion;

static bool has(const iso_record *r, const char *name)
{
    return iso_record_find(r, name) >= 0;
}

/* The columns of the result: those of both models, of the effects that the rows have, and of the attitude. */
static iso_status create(completion *c)
{
    const char *names[ISO_TRAJECTORY_COLUMNS];
    size_t count = 0;
    c->q = iso_column_find("q0") - ISO_COLUMN_EFFECTS;
    c->contact = iso_column_find("contact1") - ISO_COLUMN_EFFECTS;
    c->centre = iso_column_find("centre1") - ISO_COLUMN_EFFECTS;
    for (int i = 0; i < iso_columns_count(); i++) {
        const char *name = iso_column_name(i);
        const bool given = has(c->in, name);
        const int e = i - ISO_COLUMN_EFFECTS;
        const bool attitude = (e >= c->q && e < c->contact + 3) || (e >= c->centre && e < c->centre + 3);
        if (e < 0 ? view_is_of_point(i) && *c->page->alone : !given && !attitude) continue;
        c->given[count] = given;
        c->column[count] = i;
        names[count++] = name;
    }
    return iso_record_create_like(c->ctx, c->in, count, names, &c->out);
}

/* Copies a row of the file, and adds its state in the other model. */
static iso_status copy_row(completion *c, size_t i)
{
    double *row;
    iso_sample given, mapped;
    ISO_TRY(iso_record_append(c->ctx, c->out, &row));
    iso_record_sample(c->in, i, &given);
    mapped = given;
    if (c->model == ISO_BALL)
        iso_ball_to_point(&c->page->params, given.ball, mapped.point);
    else
        iso_point_to_ball(&c->page->params, given.point, mapped.ball);
    for (size_t j = 0; j < iso_record_columns(c->out); j++)
        row[j] = iso_sample_column(c->given[j] ? &given : &mapped, c->column[j]);
    return ISO_OK;
}

/* The short orbit that begins at a row, with the attitude that the last one has reached; at row 0 with that of the
 * file, or with the default one. */
static iso_status begin(completion *c, size_t row, iso_orbit **orbit)
{
    iso_start start;
    iso_effects effects = c->page->effects;
    ISO_TRY(iso_record_start(c->ctx, c->in, &c->page->params, c->model, row, &start, &effects));
    if (row > 0 && !has(c->in, "q0"))
        ISO_TRY(iso_effects_set(c->ctx, &effects, "attitude", "quaternion", 4, c->attitude));
    return view_orbit(c->ctx, c->page, &start, &effects, c->clock, orbit);
}

/* Puts into row `i` the clocks and the attitude that the short orbit gives at its time. */
static iso_status fill(completion *c, iso_orbit *orbit, size_t first, size_t i, iso_sample *sample)
{
    const int time = iso_record_find(c->in, iso_clock_name(c->clock));
    const double since = iso_record_const_row(c->in, i)[time] - iso_record_const_row(c->in, first)[time];
    ISO_TRY(iso_orbit_at(orbit, since, sample));
    sample->clock[c->clock] = since;
    iso_sample whole = *sample;
    for (int j = 0; j < ISO_CLOCKS; j++) whole.clock[j] += c->begun[j];
    for (int a = 0; a < 3; a++)
        whole.effect[c->contact + a] += c->shift[a], whole.effect[c->centre + a] += c->shift[a];
    for (size_t j = 0; j < iso_record_columns(c->out); j++)
        if (!c->given[j] && (c->column[j] < ISO_COLUMN_BALL || c->column[j] >= ISO_COLUMN_EFFECTS))
            iso_record_row(c->out, i)[j] = iso_sample_column(&whole, c->column[j]);
    return ISO_OK;
}

/* How far the short orbit is from row `i` of the file: |difference| of n, and of omega against the largest. */
static double missed_by(const completion *c, size_t i, const iso_sample *sample)
{
    const double *omega = view_vector(c->out, i, "omega1"), *n = view_vector(c->out, i, "n1");
    const double off = c->speed > 0 ? view_distance(omega, sample->ball) / c->speed : 0;
    return fmax(off, view_distance(n, sample->ball + 3));
}

/* The bound: MISSED, or the drift that the rows of a file may have, if that is larger. */
static void find_bound(completion *c)
{
    c->bound = fmax(MISSED, iso_conversion_largest_drift(c->ctx, c->in, iso_record_row_tolerance(c->in)));
    for (size_t i = 0; i < iso_record_rows(c->out); i++) {
        const double *w = view_vector(c->out, i, "omega1");
        c->speed = fmax(c->speed, hypot(hypot(w[0], w[1]), w[2]));
    }
}

/* The next orbit begins where this one is now. */
static void go_on(completion *c, const iso_sample *now)
{
    for (int j = 0; j < ISO_CLOCKS; j++) c->begun[j] += now->clock[j];
    memcpy(c->attitude, now->effect + c->q, sizeof c->attitude);
    for (int a = 0; a < 3 && c->page->params.k == 1; a++) c->shift[a] += now->effect[c->contact + a];
}

/* The rows after `first` by the orbit that begins there; *last: the row where the next one begins. */
static iso_status follow(completion *c, iso_orbit *orbit, size_t first, size_t *last)
{
    const size_t rows = iso_record_rows(c->in);
    iso_sample now, before;
    iso_status status = fill(c, orbit, first, first, &before);
    for (size_t i = first + 1; status == ISO_OK && i <= first + SEGMENT && i < rows; i++) {
        status = fill(c, orbit, first, i, &now);
        if (status != ISO_OK) return status;
        const double miss = missed_by(c, i, &now);
        if (!(miss <= c->bound) && i > first + 1) break;
        if (!(miss <= c->bound) && !(miss <= c->worst->by)) *c->worst = (view_miss){i, miss};
        before = now;
        *last = i;
        if (!(miss <= c->bound)) break;
    }
    if (status == ISO_OK) go_on(c, &before);
    return status;
}

static iso_status complete(completion *c)
{
    const size_t rows = iso_record_rows(c->in);
    iso_status status = create(c);
    for (size_t i = 0; status == ISO_OK && i < rows; i++) status = copy_row(c, i);
    if (status == ISO_OK) find_bound(c);
    for (size_t first = 0, last; status == ISO_OK && first + 1 < rows; first = last) {
        iso_orbit *orbit;
        last = first + 1;
        status = begin(c, first, &orbit);
        if (status != ISO_OK) break;
        status = follow(c, orbit, first, &last);
        iso_orbit_free(orbit);
    }
    return status;
}

iso_status view_complete(iso_context *ctx, const view_page *page, iso_record *rows, iso_record **made,
                         view_miss *worst)
{
    completion c = {.ctx = ctx, .page = page, .in = rows, .worst = worst};
    *worst = (view_miss){0, 0};
    c.model = has(rows, "omega1") && has(rows, "n1") ? ISO_BALL : ISO_POINT;
    c.clock = has(rows, "t") ? ISO_CLOCK_T : ISO_CLOCK_S;
    const iso_status status = complete(&c);
    *made = c.out;
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(c.out);
    *made = NULL;
    return status;
}
