/* view_complete.c - gives rows of a file the columns that a page needs (see view.h). The other model comes from the
 * map (18). The clocks, the attitude, contact and centre come from each row to the next (orbit/rows_impl.h), so that
 * they stay close to the file's own rows, also on chaotic orbits. */
#include <math.h>
#include <string.h>

#include "map/state.h"
#include "orbit/rows_impl.h"
#include "view.h"

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
    double begun[ISO_CLOCKS];           /* clocks at the row before                     */
    double shift[3];                    /* on a plane: the contact there                */
    double attitude[4];                 /* there                                        */
    bool turned;                        /* it is known                                  */
    double bound;                       /* a row is missed by more                      */
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

/* The orbit that begins at a row, with the attitude that the last one has reached; at the first row with that of the
 * file, or with the default one. */
static iso_status open_at(void *data, const double row[], iso_orbit **orbit)
{
    completion *c = data;
    iso_start start;
    iso_effects effects = c->page->effects;
    ISO_TRY(iso_record_start_at(c->ctx, c->in, &c->page->params, c->model, row, &start, &effects));
    if (c->turned && !has(c->in, "q0"))
        ISO_TRY(iso_effects_set(c->ctx, &effects, "attitude", "quaternion", 4, c->attitude));
    return view_orbit(c->ctx, c->page, &start, &effects, c->clock, orbit);
}

/* Puts into row `i` the clocks and the columns of effects, `now` on the orbit that began at the row before; goes on
 * from there. */
static void fill(completion *c, size_t i, const iso_sample *now)
{
    iso_sample whole = *now;
    for (int j = 0; j < ISO_CLOCKS; j++) whole.clock[j] = c->begun[j] += now->clock[j];
    for (int a = 0; a < 3; a++) {
        whole.effect[c->centre + a] += c->shift[a];
        whole.effect[c->contact + a] += c->shift[a];
        if (c->page->params.k == 1) c->shift[a] = whole.effect[c->contact + a];
    }
    memcpy(c->attitude, now->effect + c->q, sizeof c->attitude);
    c->turned = true;
    for (size_t j = 0; j < iso_record_columns(c->out); j++)
        if (!c->given[j] && (c->column[j] < ISO_COLUMN_BALL || c->column[j] >= ISO_COLUMN_EFFECTS))
            iso_record_row(c->out, i)[j] = iso_sample_column(&whole, c->column[j]);
}

static iso_status first_row(completion *c, iso_rows *rows)
{
    const double *first = iso_record_const_row(c->in, 0);
    iso_sample sample;
    iso_orbit *orbit = NULL;
    iso_status status = open_at(c, first, &orbit);
    if (status == ISO_OK) status = iso_orbit_at(orbit, 0, &sample);
    iso_orbit_free(orbit);
    if (status == ISO_OK) fill(c, 0, &sample);
    return status == ISO_OK ? iso_rows_begin(rows, NULL, first, 0) : status;
}

static iso_status next_row(completion *c, iso_rows *rows, size_t i)
{
    iso_row_gap gap;
    iso_rows_take(rows, iso_record_const_row(c->in, i));
    ISO_TRY(iso_rows_integrate(rows, &gap));
    iso_rows_keep(rows);
    gap.reached.clock[c->clock] = gap.step;
    fill(c, i, &gap.reached);
    if (!(gap.miss <= c->bound) && !(gap.miss <= c->worst->by)) *c->worst = (view_miss){i, gap.miss};
    return ISO_OK;
}

static iso_status complete(completion *c)
{
    int columns[ISO_TRAJECTORY_COLUMNS];
    const size_t count = iso_record_rows(c->in);
    iso_rows rows = {.ctx = c->ctx,
                     .model = c->model,
                     .clock = c->clock,
                     .columns = columns,
                     .width = iso_record_columns(c->in),
                     .open = open_at,
                     .data = c};
    iso_record_find_columns(c->in, columns);
    c->bound = iso_rows_largest_miss(c->ctx, c->in, iso_record_row_tolerance(c->in));
    iso_status status = create(c);
    for (size_t i = 0; status == ISO_OK && i < count; i++) {
        status = copy_row(c, i);
        if (status == ISO_OK) status = i == 0 ? first_row(c, &rows) : next_row(c, &rows, i);
        if (status != ISO_OK) iso_context_fail(c->ctx, status, "", "row %zu: %s", i + 1, iso_context_message(c->ctx));
    }
    iso_rows_free(&rows);
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
