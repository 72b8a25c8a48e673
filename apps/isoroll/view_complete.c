/* view_complete.c - gives rows of a file the columns that a page needs (see view.h). The other model comes from the
 * map (18); the clocks and the attitude come from short orbits.
 *
 * A short orbit begins at a row and gives the clocks, q, contact and centre at the next SEGMENT rows. There the next
 * one begins. So these columns stay close to the file's own rows, also on chaotic orbits.
 */
#include <math.h>
#include <string.h>

#include "map/state.h"
#include "view.h"

enum { SEGMENT = 16, MOST_COLUMNS = ISO_TRAJECTORY_COLUMNS };

static const char *const attitude_names[] = {"q0",       "q1",       "q2",      "q3",      "contact1",
                                             "contact2", "contact3", "centre1", "centre2", "centre3"};
enum { ATTITUDE = 10, CONTACT = 4, CENTRE = 7 };

typedef struct completion {
    iso_context *ctx;
    const view_page *page;
    const iso_record *in;
    iso_record *out;
    iso_model_kind model; /* whose states the rows have              */
    iso_clock clock;      /* that gives the times of the rows        */
    bool twin;
    double begun[ISO_CLOCKS]; /* clocks where this short orbit began     */
    double shift[3];          /* on a plane: the contact there           */
    double q[4];              /* attitude there                          */
} completion;

static bool has(const iso_record *r, const char *name)
{
    return iso_record_find(r, name) >= 0;
}

/* The columns of the result: those of both models, of the effects that the rows have, and of the attitude. */
static iso_status create(completion *c)
{
    const char *names[MOST_COLUMNS];
    size_t count = 0;
    for (int i = 0; i < iso_columns_count(); i++) {
        const char *name = iso_column_name(i);
        const bool of_point =
            i == ISO_CLOCK_TAU || i == ISO_CLOCK_S || (i >= ISO_COLUMN_POINT && i < ISO_COLUMN_EFFECTS);
        bool wanted = i >= ISO_COLUMN_EFFECTS ? has(c->in, name) : !of_point || c->twin;
        for (int a = 0; a < ATTITUDE; a++) wanted = wanted || strcmp(name, attitude_names[a]) == 0;
        if (wanted) names[count++] = name;
    }
    return view_record_like(c->ctx, c->in, count, names, &c->out);
}

static void put(completion *c, double *row, const char *name, double value)
{
    if (has(c->out, name) && !has(c->in, name)) row[iso_record_find(c->out, name)] = value;
}

/* Copies a row of the file, and adds its state in the other model. */
static iso_status copy_row(completion *c, size_t i)
{
    double *row, ball[ISO_STATE], point[ISO_STATE];
    const double *from = iso_record_const_row(c->in, i);
    const iso_status status = iso_record_append(c->ctx, c->out, &row);
    if (status != ISO_OK) return status;
    for (size_t j = 0; j < iso_record_columns(c->out); j++) {
        const int column = iso_record_find(c->in, iso_record_name(c->out, j));
        if (column >= 0) row[j] = from[column];
    }
    const bool is_ball = c->model == ISO_BALL;
    const char *const *names = (is_ball ? &iso_system_ball : &iso_system_point)->state;
    for (int j = 0; j < ISO_STATE; j++) (is_ball ? ball : point)[j] = from[iso_record_find(c->in, names[j])];
    if (is_ball)
        iso_ball_to_point(&c->page->params, ball, point);
    else
        iso_point_to_ball(&c->page->params, point, ball);
    for (int j = 0; j < ISO_STATE; j++) {
        put(c, row, iso_system_ball.state[j], ball[j]);
        put(c, row, iso_system_point.state[j], point[j]);
    }
    return ISO_OK;
}

/* The short orbit that begins at a row, with the attitude that the last one has reached; at row 0 with that of the
 * file, or with the default one. */
static iso_status begin(completion *c, size_t row, iso_orbit **orbit)
{
    iso_start start;
    iso_effects effects = c->page->effects;
    iso_status status = iso_record_start(c->ctx, c->in, &c->page->params, c->model, row, &start, &effects);
    if (status == ISO_OK && row > 0 && !has(c->in, "q0"))
        status = iso_effects_set(c->ctx, &effects, "attitude", "quaternion", 4, c->q);
    if (status != ISO_OK) return status;
    iso_orbit_options o = iso_orbit_defaults(&start);
    effects.on[ISO_ATTITUDE] = true;
    o.effects = &effects;
    o.backend = ISO_BACKEND_BALL;
    o.clock = c->clock;
    o.shown = c->twin ? ISO_SHOW_BOTH : ISO_SHOW_BALL;
    for (int i = 0; c->twin && i < ISO_CLOCKS; i++) o.with_clock[i] = true;
    return iso_orbit_create(c->ctx, &c->page->params, &start, &o, orbit);
}

/* Puts into row `i` what the short orbit gives at its time. */
static iso_status fill(completion *c, iso_orbit *orbit, size_t first, size_t i, iso_sample *sample)
{
    const int time = iso_record_find(c->in, iso_clock_name(c->clock));
    const double since = iso_record_const_row(c->in, i)[time] - iso_record_const_row(c->in, first)[time];
    const iso_status status = iso_orbit_at(orbit, since, sample);
    if (status != ISO_OK) return status;
    sample->clock[c->clock] = since;
    double *row = iso_record_row(c->out, i);
    for (int j = 0; j < ISO_CLOCKS; j++) put(c, row, iso_clock_name((iso_clock)j), c->begun[j] + sample->clock[j]);
    for (int a = 0; a < ATTITUDE; a++) {
        const double moved = a < CONTACT ? 0 : c->shift[(a - CONTACT) % 3];
        put(c, row, attitude_names[a], iso_sample_get(sample, attitude_names[a]) + moved);
    }
    return ISO_OK;
}

/* The next orbit begins where this one is now. */
static void go_on(completion *c, const iso_sample *now)
{
    for (int j = 0; j < ISO_CLOCKS; j++) c->begun[j] += now->clock[j];
    for (int a = 0; a < 4; a++) c->q[a] = iso_sample_get(now, attitude_names[a]);
    for (int a = 0; a < 3 && c->page->params.k == 1; a++)
        c->shift[a] += iso_sample_get(now, attitude_names[CONTACT + a]);
}

static iso_status complete(completion *c)
{
    const size_t rows = iso_record_rows(c->in);
    iso_status status = create(c);
    for (size_t i = 0; status == ISO_OK && i < rows; i++) status = copy_row(c, i);
    for (size_t first = 0; status == ISO_OK && first < rows; first += SEGMENT) {
        iso_orbit *orbit;
        iso_sample sample;
        status = begin(c, first, &orbit);
        if (status != ISO_OK) break;
        for (size_t i = first; status == ISO_OK && i <= first + SEGMENT && i < rows; i++)
            status = fill(c, orbit, first, i, &sample);
        if (status == ISO_OK) go_on(c, &sample);
        iso_orbit_free(orbit);
    }
    return status;
}

iso_status view_complete(iso_context *ctx, const view_page *page, iso_record *rows, iso_record **made)
{
    completion c = {.ctx = ctx, .page = page, .in = rows, .twin = !*page->alone};
    c.model = has(rows, "omega1") && has(rows, "n1") ? ISO_BALL : ISO_POINT;
    c.clock = has(rows, "t") ? ISO_CLOCK_T : ISO_CLOCK_S;
    const iso_status status = complete(&c);
    *made = c.out;
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(c.out);
    *made = NULL;
    return status;
}
