#include "orbit/convert.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"

typedef struct conversion {
    iso_context *ctx;
    const iso_params *params;
    const iso_record *in;
    iso_picture from;
    double tolerance;
    int state[ISO_STATE];         /* columns of the model converted from                                  */
    iso_clock own, other;         /* the clocks of the two models                                         */
    int own_column, other_column; /* their columns in `in`, -1: not there                         */
    iso_effects effects;          /* of the record, and the level of a point off H = 0; the caller's units */
    iso_orbit *first;             /* from the first row                                                    */
    iso_units units;              /* its own                                                               */
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

/* H of a point in own units, and the level it should have. */
static double off_level(const conversion *c, const iso_start *start, double eps)
{
    double y[ISO_STATE], size;
    iso_field field = iso_orbit_model(c->first)->field;
    field.eps = eps;
    copy(start->y, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= iso_unit(&c->units, iso_system_point.fast_dimension);
    const double level = c->effects.on[ISO_LEVEL] ? iso_coupling(&field.p, field.effects.level) : 0;
    const double H = iso_system_point.integrals[0].value(&field, y, &size);
    return H == level ? 0 : (H - level) / fmax(size, fabs(level));
}

/* The start that a row is, at the record's level. A point's own coupling becomes the one of that level, from which the
 * record's may differ by the digits it is written with; by more, the row is none of this trajectory. */
static iso_status row_start(const conversion *c, size_t row, iso_start *start)
{
    iso_effects effects = c->effects;
    iso_status status = iso_record_start(c->ctx, c->in, c->params, c->from, row, start, &effects);
    if (status != ISO_OK || c->from != ISO_POINT || isnan(start->eps)) return status;
    const double stated = start->eps;
    start->eps = NAN;
    if (fabs(off_level(c, start, stated / iso_unit(&c->units, iso_dimension_eps))) <= 1e-6) return ISO_OK;
    iso_context_fail(c->ctx, ISO_NOT_MAPPED, "eps",
                     "the energy of this point is not that of the rows before: its M does not belong to eps = %.10g",
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
    const iso_status status = row_start(c, row, &start);
    if (status != ISO_OK) return status;
    const bool rest = row_largest(c, row) == 0;
    if (rest && !c->effects.on[ISO_FIELD] && !c->effects.on[ISO_LEVEL]) {
        iso_context_fail(c->ctx, ISO_NOT_MAPPED, "", "at rest (h = 0): a resting ball has no twin");
        return fail_row(c, ISO_NOT_MAPPED, row);
    }
    /* the row as it stands: what iso_record_start made orthogonal is for integration */
    for (int i = 0; i < ISO_STATE; i++) y[i] = x[c->state[i]];
    for (int i = 0; i < 3; i++) y[i] /= c->from == ISO_BALL ? c->units.w : unit_M;
    (c->from == ISO_BALL ? iso_ball_to_point : iso_point_to_ball)(&c->units.own, y, out);
    for (int i = 0; i < 3; i++) out[i] *= c->from == ISO_BALL ? unit_M : c->units.w;
    double size = 0;
    bool fits = isnormal(unit_M);
    for (int i = 0; i < ISO_STATE; i++) fits = fits && isfinite(out[i]);
    for (int i = 0; i < 3; i++) size = fmax(size, fabs(out[i]));
    if (fits && (rest || size >= DBL_MIN)) return ISO_OK;
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
    iso_status status = row_start(c, row, &start);
    if (status != ISO_OK) return status;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &c->effects;
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
    double stated;
    iso_status status = ISO_OK;
    const double eps = iso_orbit_coupling(c->first);
    const bool agrees =
        iso_record_coupling(c->ctx, out, c->params, &stated, &status) && fabs(stated - eps) <= 1e-6 * fabs(eps);
    if (status != ISO_OK) return status;
    const bool named = !c->effects.on[ISO_LEVEL] || iso_record_get(out, "level.c");
    return iso_record_describe(c->ctx, out, iso_picture_name((int)to), c->params, agrees && named ? NULL : c->first);
}

/* The lines of `in`, now about the other model, and where its own clock began. */
static iso_status convert_lines(const conversion *c, iso_picture to, iso_record *out)
{
    const char *key, *value;
    iso_status status = ISO_OK;
    for (size_t i = 0; status == ISO_OK && iso_record_line(c->in, i, &key, &value); i++)
        if (strcmp(key, "effects") != 0 && strncmp(key, "attitude.", 9) != 0) /* the ball's columns are not carried over */
            status = iso_record_set(c->ctx, out, key, value);
    if (status == ISO_OK) status = iso_record_describe_effects(c->ctx, out, &c->effects);
    if (status == ISO_OK) status = describe_energy(c, to, out);
    if (status != ISO_OK || c->own_column < 0) return status;
    const char *origin = origin_line[c->own];
    double begin;
    status = read_clock(c, c->own_column, 0, &begin);
    if (status == ISO_OK && (begin != 0 || iso_record_get(out, origin)))
        status = iso_record_set_numbers(c->ctx, out, origin, 1, &begin);
    return status;
}

/* The orbit of the first row; off the level H = 0 by more than the digits a record may be written with, it has a level. */
static iso_status open_first(conversion *c)
{
    iso_start start;
    iso_effects effects = c->effects;
    iso_status status = iso_record_start(c->ctx, c->in, c->params, c->from, 0, &start, &effects);
    if (status != ISO_OK) return status;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &c->effects;
    status = iso_orbit_create(c->ctx, c->params, &start, &o, &c->first);
    if (status != ISO_OK) return fail_row(c, status, 0);
    c->units = *iso_orbit_units(c->first);
    if (!iso_orbit_effects(c->first).on[ISO_LEVEL] || c->effects.on[ISO_LEVEL]) return ISO_OK;
    if (fabs(off_level(c, &start, iso_orbit_model(c->first)->field.eps)) > 1e-6) {
        c->effects = iso_orbit_effects(c->first);
        return ISO_OK;
    }
    start.eps = NAN;
    iso_orbit_free(c->first);
    status = iso_orbit_create(c->ctx, c->params, &start, &o, &c->first);
    return status == ISO_OK ? ISO_OK : fail_row(c, status, 0);
}

static iso_status refuse_effect(const conversion *c)
{
    const iso_effect *e = iso_effects_breaking(&c->effects);
    if (!e) return ISO_OK;
    return iso_context_fail(c->ctx, ISO_NOT_MAPPED, "effects",
                            "this trajectory was made with '%s', which breaks the isomorphism: %s", e->name,
                            e->breaks);
}

static iso_status prepare(conversion *c, double *origin)
{
    int columns[ISO_STATE];
    const iso_picture to = c->from == ISO_BALL ? ISO_POINT : ISO_BALL;
    iso_status status = iso_record_find_state(c->ctx, c->in, c->from, c->state);
    if (status != ISO_OK && iso_record_find_state(c->ctx, c->in, to, columns) == ISO_OK)
        return iso_context_fail(c->ctx, ISO_BAD_INPUT, "columns", "this is a %s's trajectory already",
                                iso_picture_name((int)to));
    if (status != ISO_OK) return iso_record_find_state(c->ctx, c->in, c->from, c->state);
    if (iso_record_rows(c->in) == 0) return iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "the trajectory has no rows");
    c->own = c->from == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    c->other = c->from == ISO_BALL ? ISO_CLOCK_S : ISO_CLOCK_T;
    c->own_column = iso_record_find(c->in, iso_clock_name(c->own));
    c->other_column = iso_record_find(c->in, iso_clock_name(c->other));
    status = iso_record_effects(c->ctx, c->in, &c->effects);
    if (status == ISO_OK) status = refuse_effect(c);
    c->effects = iso_effects_acting(&c->effects);
    if (status == ISO_OK) status = open_first(c);
    if (status != ISO_OK) return status;
    *origin = 0;
    iso_record_get_numbers(c->ctx, c->in, origin_line[c->other], 1, origin, &status);
    return status;
}

iso_status iso_convert(iso_context *ctx, const iso_params *params, const iso_record *in, iso_picture to,
                       double tolerance, iso_record **out)
{
    ISO_DEFAULT_ARITHMETIC;
    const iso_system *target = to == ISO_BALL ? &iso_system_ball : &iso_system_point;
    conversion c = {.ctx = ctx,
                    .params = params,
                    .in = in,
                    .tolerance = tolerance,
                    .from = to == ISO_BALL ? ISO_POINT : ISO_BALL};
    double origin, state[ISO_STATE];
    *out = NULL;
    iso_status status = prepare(&c, &origin);
    if (status != ISO_OK) return iso_orbit_free(c.first), status;
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
    iso_orbit_free(c.first);
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(*out);
    *out = NULL;
    return status;
}
