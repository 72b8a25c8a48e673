/* rows_complete.c - adds to a trajectory the columns that it lacks (see rows_impl.h). The other model comes from the map
 * (18). The clocks, the attitude, contact and centre come from each row to the next, so that they stay close to the
 * given rows, also on chaotic orbits. */
#include <string.h>

#include "map/state.h"
#include "orbit/rows_impl.h"
#include "orbit/watch_impl.h"

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
    iso_clock clock;                    /* of the times of the rows                     */
    double begun[ISO_CLOCKS];           /* clocks at the row before                     */
    double shift[3];                    /* on a plane: the contact there                */
    double attitude[4];                 /* there                                        */
} completion;

static bool has(const iso_record *r, const char *name)
{
    return iso_record_find(r, name) >= 0;
}

/* Where the orbit is at row `i` that begins at the row before, with the attitude that the last one has reached; at the
 * first row with that of the trajectory, or with the default one. */
static iso_status reach(const completion *c, size_t i, double step, iso_sample *now)
{
    const double *before = iso_record_const_row(c->in, i > 0 ? i - 1 : 0);
    iso_start start;
    iso_orbit *orbit = NULL;
    iso_effects effects = *c->effects;
    ISO_TRY(iso_record_start_at(c->ctx, c->in, c->params, c->model, before, &start, &effects));
    if (i > 0 && !has(c->in, "q0"))
        ISO_TRY(iso_effects_set(c->ctx, &effects, "attitude", "quaternion", 4, c->attitude));
    iso_orbit_options o = iso_orbit_defaults(&start);
    effects.on[ISO_ATTITUDE] = true;
    o.effects = &effects;
    o.backend = ISO_BACKEND_BALL;
    o.clock = c->clock;
    o.shown = c->twin ? ISO_SHOW_BOTH : ISO_SHOW_BALL;
    for (int k = 0; c->twin && k < ISO_CLOCKS; k++) o.with_clock[k] = true;
    iso_status status = iso_orbit_create(c->ctx, c->params, &start, &o, &orbit);
    if (status == ISO_OK) status = iso_orbit_at(orbit, step, now);
    iso_orbit_free(orbit);
    return status;
}

static iso_status add_row(completion *c, size_t i, double bound, iso_row_miss *worst)
{
    double *row;
    iso_sample before, given, whole;
    iso_record_sample(c->in, i > 0 ? i - 1 : 0, &before);
    iso_record_sample(c->in, i, &given);
    ISO_TRY(reach(c, i, given.clock[c->clock] - before.clock[c->clock], &whole));
    const bool ball = c->model == ISO_BALL;
    const double miss = i == 0 ? 0
                        : ball ? iso_distance(given.ball, whole.ball)
                               : iso_distance(given.point, whole.point);
    if (!(miss <= bound) && !(miss <= worst->by)) *worst = (iso_row_miss){i, miss};
    memcpy(c->attitude, whole.effect + c->q, sizeof c->attitude);
    for (int k = 0; k < ISO_CLOCKS; k++) whole.clock[k] = c->begun[k] += whole.clock[k];
    for (int a = 0; a < 3; a++) {
        whole.effect[c->centre + a] += c->shift[a];
        whole.effect[c->contact + a] += c->shift[a];
        if (c->params->k == 1) c->shift[a] = whole.effect[c->contact + a];
    }
    if (ball)
        iso_ball_to_point(c->params, given.ball, whole.point);
    else
        iso_point_to_ball(c->params, given.point, whole.ball);
    ISO_TRY(iso_record_append(c->ctx, c->out, &row));
    for (size_t j = 0; j < iso_record_columns(c->out); j++)
        row[j] = iso_sample_column(c->given[j] ? &given : &whole, c->column[j]);
    return ISO_OK;
}

iso_status iso_rows_complete(iso_context *ctx, const iso_params *params, const iso_effects *effects, bool twin,
                             const iso_record *in, size_t count, const char *const names[], iso_record **made,
                             iso_row_miss *worst)
{
    completion c = {.ctx = ctx, .params = params, .effects = effects, .twin = twin, .in = in};
    const double bound = iso_rows_largest_miss(ctx, in, iso_record_row_tolerance(in));
    *worst = (iso_row_miss){0, 0};
    c.model = has(in, "omega1") && has(in, "n1") ? ISO_BALL : ISO_POINT;
    c.clock = has(in, "t") ? ISO_CLOCK_T : ISO_CLOCK_S;
    c.q = iso_column_find("q0") - ISO_COLUMN_EFFECTS;
    c.contact = iso_column_find("contact1") - ISO_COLUMN_EFFECTS;
    c.centre = iso_column_find("centre1") - ISO_COLUMN_EFFECTS;
    for (size_t i = 0; i < count; i++) c.column[i] = iso_column_find(names[i]), c.given[i] = has(in, names[i]);
    iso_status status = iso_record_create_like(ctx, in, count, names, &c.out);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(in); i++) {
        status = add_row(&c, i, bound, worst);
        const size_t row = status == ISO_BAD_INPUT && i > 0 ? i : i + 1; /* an orbit begins at the row before */
        if (status != ISO_OK) iso_context_fail(ctx, status, "", "row %zu: %s", row, iso_context_message(ctx));
    }
    if (status != ISO_OK) iso_record_free(c.out), c.out = NULL;
    *made = c.out;
    return status;
}
