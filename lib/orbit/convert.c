#include "orbit/convert.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "map/state.h"

/* --- what a record says of its ball -------------------------------------------------------------------------------- */

iso_status iso_record_describe(iso_context *ctx, iso_record *r, const char *model, const iso_params *p,
                               const iso_orbit *orbit)
{
    iso_status status = iso_record_set(ctx, r, "model", model);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, r, "k", 1, &p->k);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, r, "J", 3, p->J);
    if (status != ISO_OK || !orbit) return status;
    const bool twin = iso_orbit_has_twin(orbit), point = iso_orbit_model(orbit)->system == &iso_system_point;
    const double h = iso_orbit_energy(orbit), eps = iso_orbit_coupling(orbit);
    if (twin && isnormal(h)) status = iso_record_set_numbers(ctx, r, "h", 1, &h);
    if (status == ISO_OK && ((twin && isnormal(eps)) || (!twin && point && isfinite(eps))))
        status = iso_record_set_numbers(ctx, r, "eps", 1, &eps);
    return status;
}

iso_status iso_record_params(iso_context *ctx, const iso_record *r, iso_params *p)
{
    double k, J[3];
    iso_status status;
    const bool has_k = iso_record_get_numbers(ctx, r, "k", 1, &k, &status);
    if (status != ISO_OK) return status;
    const bool has_J = iso_record_get_numbers(ctx, r, "J", 3, J, &status);
    if (status != ISO_OK) return status;
    if (has_k && has_J) return iso_params_reduced(ctx, k, J, p);
    return iso_context_fail(ctx, ISO_BAD_INPUT, has_k ? "J" : "k",
                            "the trajectory does not say its %s: a line '# %s' or the option --%s must",
                            has_k ? "J" : "k", has_k ? "J: J1 J2 J3" : "k: K", has_k ? "J J1,J2,J3" : "k K");
}

/* The six columns of a model. */
static iso_status find_state(iso_context *ctx, const iso_record *r, iso_picture model, int columns[ISO_STATE])
{
    const char *const *names = (model == ISO_BALL ? &iso_system_ball : &iso_system_point)->state;
    const char *missing;
    if (iso_record_find_all(r, ISO_STATE, names, columns, &missing)) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, "columns", "the trajectory has no column '%s', which a %s has",
                            missing, iso_picture_name((int)model));
}

/* The coupling that the lines state, by eps or by h; false: they do not. */
static bool stated_coupling(iso_context *ctx, const iso_record *r, const iso_params *p, double *eps,
                            iso_status *status)
{
    if (iso_record_get_numbers(ctx, r, "eps", 1, eps, status)) return true;
    if (*status != ISO_OK || !iso_record_get_numbers(ctx, r, "h", 1, eps, status)) return false;
    const double h = *eps;
    *eps = iso_coupling(p, h); /* may not fit a double where h does */
    return h == 0 || isnormal(*eps);
}

iso_status iso_record_start(iso_context *ctx, const iso_record *r, const iso_params *p, iso_picture model, size_t row,
                            iso_start *start)
{
    int columns[ISO_STATE];
    iso_status status = find_state(ctx, r, model, columns);
    if (status != ISO_OK) return status;
    const double *x = iso_record_const_row(r, row);
    double v[3], unit[3];
    for (int i = 0; i < 3; i++) {
        v[i] = x[columns[i]];
        unit[i] = x[columns[3 + i]];
    }
    double eps;
    const bool states_eps = model == ISO_POINT && stated_coupling(ctx, r, p, &eps, &status);
    if (status != ISO_OK) return status;
    const double size = largest(v);
    const double along = size > 0 ? v[0] / size * unit[0] + v[1] / size * unit[1] + v[2] / size * unit[2] : 0;
    if (model == ISO_BALL)
        status = iso_start_ball(ctx, v, unit, true, start);
    else
        status = iso_start_point(ctx, v, unit, states_eps ? &eps : NULL, true, start);
    if (status == ISO_OK && fabs(along) > 1e-6)
        status = iso_context_fail(ctx, ISO_BAD_INPUT, "", "%s has a part %.3g of its size along %s: this is no %s",
                                  model == ISO_BALL ? "omega" : "M", along, model == ISO_BALL ? "n" : "gamma",
                                  model == ISO_BALL ? "rubber ball's motion" : "point on a sphere");
    if (status == ISO_OK) return ISO_OK;
    return iso_context_fail(ctx, status, "", "row %zu: %s", row + 1, iso_context_message(ctx));
}

/* --- conversion ---------------------------------------------------------------------------------------------------- */

typedef struct conversion {
    iso_context *ctx;
    const iso_params *params;
    const iso_record *in;
    iso_picture from;
    double tolerance;
    int state[ISO_STATE];         /* columns of the model converted from                                  */
    iso_clock own, other;         /* the clocks of the two models                                         */
    int own_column, other_column; /* their columns in `in`, -1: not there                         */
    iso_units units;
} conversion;

/* Lines that say where a clock began which the record has lost. */
static const char *const origin_line[] = {[ISO_CLOCK_T] = "t0", [ISO_CLOCK_S] = "s0"};

/* What a call does not take is here what the file says. */
static iso_status fail_row(const conversion *c, iso_status status, size_t row)
{
    if (status == ISO_BAD_ARGUMENT) status = ISO_BAD_INPUT;
    return iso_context_fail(c->ctx, status, "", "row %zu: %s", row + 1, iso_context_message(c->ctx));
}

static double row_largest(const conversion *c, size_t row)
{
    const double *x = iso_record_const_row(c->in, row);
    return largest((double[]){x[c->state[0]], x[c->state[1]], x[c->state[2]]});
}

/* A point off the level H = 0 of the record's coupling is no free ball's. The start's own coupling becomes the one of
 * H = 0, from which the record's may differ by the digits it is written with. */
static iso_status settle_level(const conversion *c, size_t row, iso_start *start)
{
    if (c->from != ISO_POINT || isnan(start->eps)) return ISO_OK;
    const iso_params *own = &c->units.own;
    const double *gamma = start->y + 3, unit_M = iso_unit(&c->units, iso_system_point.fast_dimension);
    const double eps = start->eps / iso_unit(&c->units, iso_dimension_eps);
    const double q = dot_diag(gamma, own->J, gamma), M = row_largest(c, row) / unit_M;
    /* |M| over what it is on the level, in parts that do not overflow; NAN for eps < 0 */
    const double direction[3] = {start->y[0] / unit_M / M, start->y[1] / unit_M / M, start->y[2] / unit_M / M};
    const double ratio = norm(direction) * (M / (sqrt(2) * sqrt(eps))) * pow(q, 1 / (2 * own->k));
    const double stated = start->eps;
    start->eps = NAN;
    if (M == 0 || fabs(ratio - 1) <= 1e-6) return ISO_OK;
    iso_context_fail(c->ctx, ISO_NOT_MAPPED, "eps",
                     "this point is off the level H = 0, and only there is it the twin of a free ball: its M does "
                     "not belong to eps = %.10g",
                     stated);
    return fail_row(c, ISO_NOT_MAPPED, row);
}

/* The state of one row, carried over. */
static iso_status convert_state(const conversion *c, size_t row, double out[ISO_STATE])
{
    const double *x = iso_record_const_row(c->in, row);
    const double unit_M = iso_unit(&c->units, iso_system_point.fast_dimension);
    double y[ISO_STATE];
    iso_start start;
    iso_status status = iso_record_start(c->ctx, c->in, c->params, c->from, row, &start);
    if (status == ISO_OK) status = settle_level(c, row, &start);
    if (status != ISO_OK) return status;
    if (row_largest(c, row) == 0) {
        iso_context_fail(c->ctx, ISO_NOT_MAPPED, "", "at rest (h = 0): a resting ball has no twin");
        return fail_row(c, ISO_NOT_MAPPED, row);
    }
    /* the row as it stands: what iso_record_start made orthogonal is for integration */
    for (int i = 0; i < ISO_STATE; i++) y[i] = x[c->state[i]];
    for (int i = 0; i < 3 && c->from == ISO_POINT; i++) y[i] /= unit_M;
    (c->from == ISO_BALL ? iso_ball_to_point : iso_point_to_ball)(&c->units.own, y, out);
    for (int i = 0; i < 3 && c->from == ISO_BALL; i++) out[i] *= unit_M;
    double size = 0;
    bool fits = isnormal(unit_M);
    for (int i = 0; i < ISO_STATE; i++) fits = fits && isfinite(out[i]);
    for (int i = 0; i < 3; i++) size = fmax(size, fabs(out[i]));
    if (fits && size >= DBL_MIN) return ISO_OK;
    iso_context_fail(c->ctx, ISO_NUMERICAL, "", "the result does not fit a double in these units");
    return fail_row(c, ISO_NUMERICAL, row);
}

/* How far the other clock goes from `row` to the next: along the orbit that starts in the row. */
static iso_status clock_step(const conversion *c, size_t row, double own, double *other)
{
    iso_start start;
    iso_orbit *orbit;
    iso_sample sample;
    *other = 0;
    if (own == 0) return ISO_OK;
    iso_status status = iso_record_start(c->ctx, c->in, c->params, c->from, row, &start);
    if (status == ISO_OK) status = settle_level(c, row, &start);
    if (status != ISO_OK) return status;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.tolerance = c->tolerance;
    o.carry[c->other] = true;
    o.max_steps = ISO_MAX_ROW_STEPS;
    status = iso_orbit_create(c->ctx, c->params, &start, &o, &orbit);
    if (status != ISO_OK) return fail_row(c, status, row);
    status = iso_orbit_at(orbit, own, &sample);
    iso_orbit_free(orbit);
    if (status != ISO_OK) return fail_row(c, status, row);
    *other = sample.clock[c->other];
    return ISO_OK;
}

/* The clock's column `column` in row `row`. */
static iso_status read_clock(const conversion *c, int column, size_t row, double *time)
{
    *time = iso_record_const_row(c->in, row)[column];
    if (isfinite(*time)) return ISO_OK;
    return iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "row %zu: %s is not finite", row + 1,
                            iso_record_name(c->in, (size_t)column));
}

/* The own clock's step from `row` to the next; *direction is that of the steps before, and becomes this one's. */
static iso_status own_step(const conversion *c, size_t row, double *step, double *direction)
{
    double here, next;
    iso_status status = read_clock(c, c->own_column, row, &here);
    if (status == ISO_OK) status = read_clock(c, c->own_column, row + 1, &next);
    if (status != ISO_OK) return status;
    *step = next - here;
    if ((*step < 0 && *direction > 0) || (*step > 0 && *direction < 0))
        return iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "row %zu: %s turns back; sort the rows by time", row + 2,
                                iso_clock_name(c->own));
    if (*step != 0) *direction = *step;
    return ISO_OK;
}

/* The other clock in every row, into column 0 of `out`; the sum is compensated (Neumaier). */
static iso_status integrate_clock(const conversion *c, double origin, iso_record *out)
{
    double sum = origin, lost = 0, direction = 0;
    const size_t rows = iso_record_rows(c->in);
    for (size_t row = 0; row < rows; row++) {
        double here, there;
        iso_record_row(out, row)[0] = sum + lost;
        if (!isfinite(sum + lost)) {
            iso_context_fail(c->ctx, ISO_NUMERICAL, "", "%s is too large for a double", iso_clock_name(c->other));
            return fail_row(c, ISO_NUMERICAL, row);
        }
        if (row + 1 == rows) break;
        iso_status status = own_step(c, row, &here, &direction);
        if (status == ISO_OK) status = clock_step(c, row, here, &there);
        if (status != ISO_OK) return status;
        const double next = sum + there;
        lost += fabs(sum) >= fabs(there) ? (sum - next) + there : (there - next) + sum;
        sum = next;
    }
    return ISO_OK;
}

static iso_status convert_clock(const conversion *c, double origin, iso_record *out)
{
    if (c->other_column < 0) return integrate_clock(c, origin, out);
    iso_status status = ISO_OK;
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(c->in); row++)
        status = read_clock(c, c->other_column, row, iso_record_row(out, row));
    return status;
}

/* h and eps: what the record states, if its first row agrees to 1e-6 (a point's rows have been held to it, a ball needs
 * neither to be carried over), else those of the first row. */
static iso_status describe_energy(const conversion *c, iso_picture to, iso_record *out)
{
    iso_start start;
    iso_orbit *orbit;
    double stated;
    iso_status status = iso_record_start(c->ctx, c->in, c->params, c->from, 0, &start);
    if (status != ISO_OK) return status;
    const iso_orbit_options o = iso_orbit_defaults(&start);
    status = iso_orbit_create(c->ctx, c->params, &start, &o, &orbit);
    if (status != ISO_OK) return status;
    const double eps = iso_orbit_coupling(orbit);
    const bool agrees =
        stated_coupling(c->ctx, out, c->params, &stated, &status) && fabs(stated - eps) <= 1e-6 * fabs(eps);
    if (status == ISO_OK)
        status = iso_record_describe(c->ctx, out, iso_picture_name((int)to), c->params, agrees ? NULL : orbit);
    iso_orbit_free(orbit);
    return status;
}

/* The lines of `in`, now about the other model, and where its own clock began. */
static iso_status convert_lines(const conversion *c, iso_picture to, iso_record *out)
{
    const char *key, *value;
    iso_status status = ISO_OK;
    for (size_t i = 0; status == ISO_OK && iso_record_line(c->in, i, &key, &value); i++)
        status = iso_record_set(c->ctx, out, key, value);
    if (status == ISO_OK) status = describe_energy(c, to, out);
    if (status != ISO_OK || c->own_column < 0) return status;
    const char *origin = origin_line[c->own];
    double begin;
    status = read_clock(c, c->own_column, 0, &begin);
    if (status == ISO_OK && (begin != 0 || iso_record_get(out, origin)))
        status = iso_record_set_numbers(c->ctx, out, origin, 1, &begin);
    return status;
}

static iso_status prepare(conversion *c, double *origin)
{
    int columns[ISO_STATE];
    const iso_picture to = c->from == ISO_BALL ? ISO_POINT : ISO_BALL;
    iso_status status = find_state(c->ctx, c->in, c->from, c->state);
    if (status != ISO_OK && find_state(c->ctx, c->in, to, columns) == ISO_OK)
        return iso_context_fail(c->ctx, ISO_BAD_INPUT, "columns", "this is a %s's trajectory already",
                                iso_picture_name((int)to));
    if (status != ISO_OK) return find_state(c->ctx, c->in, c->from, c->state);
    if (iso_record_rows(c->in) == 0) return iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "the trajectory has no rows");
    c->own = c->from == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    c->other = c->from == ISO_BALL ? ISO_CLOCK_S : ISO_CLOCK_T;
    c->own_column = iso_record_find(c->in, iso_clock_name(c->own));
    c->other_column = iso_record_find(c->in, iso_clock_name(c->other));
    iso_units_choose(c->params, 0, &c->units);
    *origin = 0;
    iso_record_get_numbers(c->ctx, c->in, origin_line[c->other], 1, origin, &status);
    return status;
}

iso_status iso_convert(iso_context *ctx, const iso_params *params, const iso_record *in, iso_picture to,
                       double tolerance, iso_record **out)
{
    const iso_system *target = to == ISO_BALL ? &iso_system_ball : &iso_system_point;
    conversion c = {.ctx = ctx,
                    .params = params,
                    .in = in,
                    .tolerance = tolerance,
                    .from = to == ISO_BALL ? ISO_POINT : ISO_BALL};
    double origin, state[ISO_STATE];
    *out = NULL;
    iso_status status = prepare(&c, &origin);
    if (status != ISO_OK) return status;
    const int has_clock = c.own_column >= 0 || c.other_column >= 0;
    const char *names[1 + ISO_STATE] = {iso_clock_name(c.other)};
    for (int i = 0; i < ISO_STATE; i++) names[has_clock + i] = target->state[i];
    status = iso_record_create(ctx, (size_t)(has_clock + ISO_STATE), names, out);
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(in); row++) {
        double *to_row;
        status = convert_state(&c, row, state);
        if (status == ISO_OK) status = iso_record_append(ctx, *out, &to_row);
        if (status == ISO_OK) copy(state, to_row + has_clock, ISO_STATE);
    }
    if (status == ISO_OK && has_clock) status = convert_clock(&c, origin, *out);
    if (status == ISO_OK) status = convert_lines(&c, to, *out);
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(*out);
    *out = NULL;
    return status;
}
