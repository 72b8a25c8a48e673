/* rows_complete.c - gives a trajectory the columns that it lacks (see rows_impl.h). The other model comes from the map
 * (18). The clocks, the attitude, contact and centre come from each row to the next, so that they stay close to the
 * given rows, also on chaotic orbits. */
#include <string.h>

#include "map/state.h"
#include "orbit/rows_impl.h"

typedef struct completion {
    iso_context *ctx;
    const iso_params *params;
    const iso_effects *effects; /* with the attitude */
    bool twin;                  /* the ball has a point */
    const iso_record *in;
    iso_record *out;
    int column[ISO_TRAJECTORY_COLUMNS]; /* of the result, as iso_column_name counts     */
    bool given[ISO_TRAJECTORY_COLUMNS]; /* the trajectory has it                        */
    int q, contact, centre;             /* places in iso_sample.effect                  */
    iso_model_kind model;               /* whose states the rows have                   */
    iso_clock clock;                    /* that gives the times of the rows             */
    double begun[ISO_CLOCKS];           /* clocks at the row before                     */
    double shift[3];                    /* on a plane: the contact there                */
    double attitude[4];                 /* there                                        */
    bool turned;                        /* it is known                                  */
} completion;

static bool has(const iso_record *r, const char *name)
{
    return iso_record_find(r, name) >= 0;
}

/* Copies a row, and adds its state in the other model. */
static iso_status copy_row(completion *c, size_t i)
{
    double *row;
    iso_sample given, mapped;
    ISO_TRY(iso_record_append(c->ctx, c->out, &row));
    iso_record_sample(c->in, i, &given);
    mapped = given;
    if (c->model == ISO_BALL)
        iso_ball_to_point(c->params, given.ball, mapped.point);
    else
        iso_point_to_ball(c->params, given.point, mapped.ball);
    for (size_t j = 0; j < iso_record_columns(c->out); j++)
        row[j] = iso_sample_column(c->given[j] ? &given : &mapped, c->column[j]);
    return ISO_OK;
}

/* The orbit that begins at a row, with the attitude that the last one has reached; at the first row with that of the
 * trajectory, or with the default one. */
static iso_status open_at(void *data, const double row[], iso_orbit **orbit)
{
    completion *c = data;
    iso_start start;
    iso_effects effects = *c->effects;
    ISO_TRY(iso_record_start_at(c->ctx, c->in, c->params, c->model, row, &start, &effects));
    if (c->turned && !has(c->in, "q0"))
        ISO_TRY(iso_effects_set(c->ctx, &effects, "attitude", "quaternion", 4, c->attitude));
    iso_orbit_options o = iso_orbit_defaults(&start);
    effects.on[ISO_ATTITUDE] = true;
    o.effects = &effects;
    o.backend = ISO_BACKEND_BALL;
    o.clock = c->clock;
    o.shown = c->twin ? ISO_SHOW_BOTH : ISO_SHOW_BALL;
    for (int i = 0; c->twin && i < ISO_CLOCKS; i++) o.with_clock[i] = true;
    return iso_orbit_create(c->ctx, c->params, &start, &o, orbit);
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
        if (c->params->k == 1) c->shift[a] = whole.effect[c->contact + a];
    }
    memcpy(c->attitude, now->effect + c->q, sizeof c->attitude);
    c->turned = true;
    for (size_t j = 0; j < iso_record_columns(c->out); j++)
        if (!c->given[j] && (c->column[j] < ISO_COLUMN_BALL || c->column[j] >= ISO_COLUMN_EFFECTS))
            iso_record_row(c->out, i)[j] = iso_sample_column(&whole, c->column[j]);
}

/* Row i, from the row before; the first from the start of its own orbit. */
static iso_status add_row(completion *c, iso_rows *rows, size_t i, iso_row_gap *gap)
{
    const double *row = iso_record_const_row(c->in, i);
    ISO_TRY(copy_row(c, i));
    if (i > 0) {
        iso_rows_take(rows, row);
        ISO_TRY(iso_rows_integrate(rows, gap));
        iso_rows_keep(rows);
        gap->reached.clock[c->clock] = gap->step;
    } else {
        iso_orbit *orbit = NULL;
        iso_status status = open_at(c, row, &orbit);
        if (status == ISO_OK) status = iso_orbit_at(orbit, 0, &gap->reached);
        iso_orbit_free(orbit);
        if (status == ISO_OK) status = iso_rows_begin(rows, NULL, row, 0);
        if (status != ISO_OK) return status;
    }
    fill(c, i, &gap->reached);
    return ISO_OK;
}

static iso_status complete(completion *c, iso_row_miss *worst)
{
    int columns[ISO_TRAJECTORY_COLUMNS];
    const double bound = iso_rows_largest_miss(c->ctx, c->in, iso_record_row_tolerance(c->in));
    iso_status status = ISO_OK;
    iso_row_gap gap = {.miss = 0};
    iso_rows rows = {.ctx = c->ctx,
                     .model = c->model,
                     .clock = c->clock,
                     .columns = columns,
                     .width = iso_record_columns(c->in),
                     .open = open_at,
                     .data = c};
    iso_record_find_columns(c->in, columns);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(c->in); i++) {
        status = add_row(c, &rows, i, &gap);
        if (status != ISO_OK) iso_context_fail(c->ctx, status, "", "row %zu: %s", i + 1, iso_context_message(c->ctx));
        if (status == ISO_OK && !(gap.miss <= bound) && !(gap.miss <= worst->by))
            *worst = (iso_row_miss){i, gap.miss};
    }
    iso_rows_free(&rows);
    return status;
}

iso_status iso_rows_complete(iso_context *ctx, const iso_params *params, const iso_effects *effects, bool twin,
                             const iso_record *in, size_t count, const char *const names[], iso_record **made,
                             iso_row_miss *worst)
{
    completion c = {.ctx = ctx, .params = params, .effects = effects, .twin = twin, .in = in};
    *worst = (iso_row_miss){0, 0};
    c.model = has(in, "omega1") && has(in, "n1") ? ISO_BALL : ISO_POINT;
    c.clock = has(in, "t") ? ISO_CLOCK_T : ISO_CLOCK_S;
    c.q = iso_column_find("q0") - ISO_COLUMN_EFFECTS;
    c.contact = iso_column_find("contact1") - ISO_COLUMN_EFFECTS;
    c.centre = iso_column_find("centre1") - ISO_COLUMN_EFFECTS;
    for (size_t i = 0; i < count; i++) c.column[i] = iso_column_find(names[i]), c.given[i] = has(in, names[i]);
    iso_status status = iso_record_create_like(ctx, in, count, names, &c.out);
    if (status == ISO_OK) status = complete(&c, worst);
    if (status != ISO_OK) iso_record_free(c.out), c.out = NULL;
    *made = c.out;
    return status;
}
