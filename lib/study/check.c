/* Does a trajectory solve its model? See check.h: constraints and integrals, the flow from row to row, the map. */
#include "study/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "orbit/convert.h"

typedef struct checker {
    iso_context *ctx;
    const iso_params *params;
    const iso_record *record;
    iso_effects effects;
    double tolerance;
    int columns[ISO_TRAJECTORY_COLUMNS]; /* of the record, -1: not there */
    double span[ISO_CLOCKS];             /* largest |clock| in the record */
    iso_residuals *out;
} checker;

static const int first_column[] = {
    [ISO_BALL] = ISO_COLUMN_BALL, [ISO_POINT] = ISO_COLUMN_POINT}; /* in iso_trajectory_columns */

static const iso_system *system_of(iso_picture model)
{
    return model == ISO_BALL ? &iso_system_ball : &iso_system_point;
}

/* Notes a value of the residual `name`, and makes the residual at its first value. A NaN counts as infinite. */
static void note(checker *c, const char *name, const char *what, double value, size_t row)
{
    iso_residuals *r = c->out;
    int i = 0;
    while (i < r->count && strcmp(r->residual[i].name, name) != 0) i++;
    if (i == ISO_MAX_RESIDUALS) return;
    iso_residual *at = &r->residual[i];
    if (i == r->count) {
        r->count++;
        *at = (iso_residual){.what = what};
        snprintf(at->name, sizeof at->name, "%s", name);
    }
    if (!(fabs(value) > at->worst) && !isnan(value)) return;
    at->worst = isnan(value) ? INFINITY : fabs(value);
    at->row = row + 1;
}

static bool has_model(const checker *c, iso_picture model)
{
    for (int i = 0; i < ISO_STATE; i++)
        if (c->columns[first_column[model] + i] < 0) return false;
    return true;
}

static void read_state(const checker *c, iso_picture model, size_t row, double y[ISO_STATE])
{
    const double *x = iso_record_const_row(c->record, row);
    for (int i = 0; i < ISO_STATE; i++) y[i] = x[c->columns[first_column[model] + i]];
}

/* The columns of the record as a sample; NaN for columns that are missing. */
static void read_sample(const checker *c, size_t row, iso_sample *sample)
{
    const double *x = iso_record_const_row(c->record, row);
    for (int i = 0; i < ISO_TRAJECTORY_COLUMNS; i++)
        iso_sample_set_column(sample, i, c->columns[i] < 0 ? NAN : x[c->columns[i]]);
}

static double read_clock(const checker *c, int clock, size_t row)
{
    return iso_record_const_row(c->record, row)[c->columns[clock]];
}

/* The effects of a model's orbit. A point shows nothing that belongs to the ball alone, and its level follows from
 * each row if eps is known. */
static iso_effects effects_of(const checker *c, iso_picture model)
{
    if (model == ISO_BALL) return c->effects;
    iso_effects effects = iso_effects_acting(&c->effects);
    if (iso_record_get(c->record, "eps") || iso_record_get(c->record, "h")) effects.level = NAN;
    return effects;
}

/* --- constraints and integrals, in the units of the first row --------------------------------------------------- */

/* The integrals that hold for a model, and the value each should have. */
typedef struct expectations {
    const iso_system *system;
    const iso_orbit *first;
    int count;
    const iso_integral *integral[ISO_MAX_INTEGRALS];
    double value[ISO_MAX_INTEGRALS];
} expectations;

static double integral_value(const checker *c, const expectations *e, int i, size_t row, double *size)
{
    iso_sample sample;
    read_sample(c, row, &sample);
    return iso_orbit_integral(e->first, e->system, e->integral[i], &sample, size);
}

/* The integral less its expected value, relative to the size of its terms. */
static double integral_drift(const checker *c, const expectations *e, int i, size_t row)
{
    double size;
    const double value = integral_value(c, e, i, row, &size);
    return value == e->value[i] ? 0 : (value - e->value[i]) / size;
}

/* An integral should keep the value of the first row. There are two exceptions: a constraint has its own exact value;
 * and where the record has a ball's columns or clocks, H of the point must be 0, or the level that it states. */
static void expect_integrals(const checker *c, iso_picture model, const iso_orbit *first, expectations *e)
{
    const iso_params *own = &iso_orbit_units(first)->own;
    const double unit = iso_unit(iso_orbit_units(first), iso_effect_list[ISO_LEVEL]->numbers->dimension);
    const double claimed = c->effects.on[ISO_LEVEL] ? iso_coupling(own, c->effects.level / unit) : 0;
    const bool twin = c->columns[ISO_CLOCK_T] >= 0 || c->columns[ISO_CLOCK_TAU] >= 0 || has_model(c, ISO_BALL);
    *e = (expectations){.system = system_of(model), .first = first};
    e->count = iso_integrals_holding(e->system, &iso_orbit_model(first)->field, e->integral, ISO_MAX_INTEGRALS);
    for (int i = 0; i < e->count; i++) {
        double size;
        const bool level = twin && strcmp(e->integral[i]->name, "H") == 0;
        e->value[i] = e->integral[i]->known == ISO_ONE ? 1 : level ? claimed : 0;
        if (e->integral[i]->known == ISO_ANY_VALUE && !level) e->value[i] = integral_value(c, e, i, 0, &size);
    }
}

static void check_integrals(checker *c, iso_picture model, const iso_orbit *first)
{
    char name[sizeof c->out->residual[0].name];
    expectations e;
    expect_integrals(c, model, first, &e);
    for (int i = 0; i < e.count; i++) {
        snprintf(name, sizeof name, "%s %s", e.system->name, e.integral[i]->name);
        for (size_t row = 0; row < iso_record_rows(c->record); row++)
            note(c, name, e.integral[i]->doc, integral_drift(c, &e, i, row), row);
    }
}

/* --- the flow from row to row ----------------------------------------------------------------------------------- */

static double distance(const double a[ISO_STATE], const double b[ISO_STATE])
{
    double d[ISO_STATE];
    const double size = fmax(largest(a), largest(b));
    for (int i = 0; i < 3; i++) {
        d[i] = size > 0 ? a[i] / size - b[i] / size : 0;
        d[3 + i] = a[3 + i] - b[3 + i];
    }
    return fmax(norm(d), norm(d + 3));
}

/* The clock to follow: the model's own if the record has it, else the first one there; -1: the record has none. */
static int clock_to_follow(const checker *c, iso_picture model)
{
    const int own = (int)system_of(model)->clock;
    if (c->columns[own] >= 0) return own;
    for (int k = 0; k < ISO_CLOCKS; k++)
        if (c->columns[k] >= 0) return k;
    return -1;
}

/* Integrates `row` to the time of the next row. The record's other clocks are integrated, too, where the orbit has
 * them: a point with H not 0 has no free ball and no time t. */
static iso_status next_sample(const checker *c, iso_picture model, int clock, size_t row, iso_sample *sample)
{
    iso_start start;
    iso_effects effects = effects_of(c, model);
    iso_orbit *orbit;
    iso_status status = iso_record_start(c->ctx, c->record, c->params, model, row, &start, &effects);
    if (status != ISO_OK) return status;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &effects;
    o.tolerance = c->tolerance;
    o.clock = (iso_clock)clock;
    o.max_steps = ISO_MAX_ROW_STEPS;
    for (int k = 0; k < ISO_CLOCKS; k++) o.carry[k] = k != clock && c->columns[k] >= 0;
    status = iso_orbit_create(c->ctx, c->params, &start, &o, &orbit);
    if (status == ISO_NOT_MAPPED) {
        for (int k = 0; k < ISO_CLOCKS; k++) o.carry[k] = false;
        status = iso_orbit_create(c->ctx, c->params, &start, &o, &orbit);
    }
    if (status == ISO_OK)
        status = iso_orbit_at(orbit, read_clock(c, clock, row + 1) - read_clock(c, clock, row), sample);
    iso_orbit_free(orbit);
    if (status == ISO_OK) return ISO_OK;
    if (status == ISO_BAD_ARGUMENT) status = ISO_BAD_INPUT; /* the number that is refused stands in the file */
    return iso_context_fail(c->ctx, status, "", "row %zu: %s", row + 1, iso_context_message(c->ctx));
}

/* The columns that effects add, in groups that are compared together. `moves`: places on a plane, which are counted
 * from the row before. */
static const struct {
    const char *name;
    int first, count;
    bool moves;
} groups[] = {
    {"e flow", ISO_COLUMN_GRAVITY, 3, false},           {"q flow", ISO_COLUMN_ATTITUDE, 4, false},
    {"contact flow", ISO_COLUMN_ATTITUDE + 4, 3, true}, {"trace flow", ISO_COLUMN_ATTITUDE + 7, 3, false},
    {"centre flow", ISO_COLUMN_ATTITUDE + 10, 3, true}, {"N flow", ISO_COLUMN_REACTIONS, 3, false},
    {"force flow", ISO_COLUMN_REACTIONS + 3, 2, false}, {"lambda flow", ISO_COLUMN_REACTIONS + 6, 1, false},
};
enum { GROUPS = sizeof groups / sizeof *groups };

/* Compares the columns of effects in row `row` with the flow from the row before, relative to the group's largest. */
static void check_effects(checker *c, const iso_sample *flow, size_t row)
{
    iso_sample there, before;
    const double length = c->params->body.radius > 0 ? c->params->body.radius : 1;
    const double force = largest(flow->force) * fmax(1, length);
    read_sample(c, row, &there);
    read_sample(c, row - 1, &before);
    for (int g = 0; g < GROUPS; g++) {
        double error = 0, size = 0;
        for (int i = groups[g].first; i < groups[g].first + groups[g].count; i++) {
            const bool plane = c->params->k == 1 && groups[g].moves;
            double expected = iso_sample_column(flow, i);
            if (plane) expected += iso_sample_column(&before, ISO_COLUMN_ATTITUDE + 4 + (i - groups[g].first));
            if (isnan(expected) || c->columns[i] < 0) continue;
            error = fmax(error, fabs(expected - iso_sample_column(&there, i)));
            size = fmax(size, fmax(fabs(expected), fabs(iso_sample_column(&there, i))));
        }
        if (groups[g].first >= ISO_COLUMN_REACTIONS) size = fmax(size, force); /* lambda is a torque of this size */
        if (size > 0) note(c, groups[g].name, "effects' columns, each row integrated to the next", error / size, row);
    }
}

/* Whether the record has the quaternion, and on a plane also the contact point: the height needs it. */
static bool has_attitude(const checker *c)
{
    return c->columns[ISO_COLUMN_ATTITUDE] >= 0 && (c->params->k != 1 || c->columns[ISO_COLUMN_ATTITUDE + 4] >= 0);
}

static iso_status check_step(checker *c, iso_picture model, int clock, size_t row)
{
    iso_sample sample;
    double next[ISO_STATE];
    char name[sizeof c->out->residual[0].name];
    const iso_status status = next_sample(c, model, clock, row, &sample);
    if (status != ISO_OK) return status;
    read_state(c, model, row + 1, next);
    snprintf(name, sizeof name, "%s flow", iso_picture_name((int)model));
    note(c, name, "each row integrated to the next", distance(model == ISO_BALL ? sample.ball : sample.point, next),
         row + 1);
    check_effects(c, &sample, row + 1);
    for (int k = 0; k < ISO_CLOCKS; k++) {
        if (k == clock || c->columns[k] < 0 || isnan(sample.clock[k])) continue;
        snprintf(name, sizeof name, "clock %s", iso_clock_name((iso_clock)k));
        const double step = read_clock(c, k, row + 1) - read_clock(c, k, row);
        note(c, name, "its steps, from the equations of motion",
             c->span[k] > 0 ? (step - sample.clock[k]) / c->span[k] : 0, row + 1);
    }
    return ISO_OK;
}

static iso_status check_flow(checker *c, iso_picture model)
{
    const int clock = clock_to_follow(c, model);
    for (size_t row = 0; clock >= 0 && row + 1 < iso_record_rows(c->record); row++) {
        const iso_status status = check_step(c, model, clock, row);
        if (status != ISO_OK) return status;
    }
    return ISO_OK;
}

/* --- the map ---------------------------------------------------------------------------------------------------- */

static void check_map(checker *c)
{
    iso_units units;
    iso_units_choose(c->params, 0, &units);
    const double unit_M = iso_unit(&units, iso_system_point.fast_dimension);
    for (size_t row = 0; row < iso_record_rows(c->record); row++) {
        double ball[ISO_STATE], point[ISO_STATE];
        read_state(c, ISO_BALL, row, ball);
        read_state(c, ISO_POINT, row, point);
        iso_ball_to_point(&units.own, ball, ball);
        scale(ball, unit_M);
        note(c, "map", "the ball's point (18) against the record's", distance(ball, point), row);
    }
}

/* The orbit of the first row. Every row must be a valid start. */
static iso_status open_first(checker *c, iso_picture model, iso_orbit **first)
{
    iso_start start;
    iso_effects effects = effects_of(c, model);
    iso_status status = ISO_OK;
    *first = NULL;
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(c->record); row++)
        status = iso_record_start(c->ctx, c->record, c->params, model, row, &start, &effects);
    if (status == ISO_OK) status = iso_record_start(c->ctx, c->record, c->params, model, 0, &start, &effects);
    if (status != ISO_OK) return status;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &effects;
    return iso_orbit_create(c->ctx, c->params, &start, &o, first);
}

static iso_status check_model(checker *c, iso_picture model)
{
    iso_orbit *first;
    const iso_status status = open_first(c, model, &first);
    if (status != ISO_OK) return status;
    check_integrals(c, model, first);
    iso_orbit_free(first);
    return check_flow(c, model);
}

static iso_status measure_clocks(checker *c)
{
    for (int k = 0; k < ISO_CLOCKS; k++)
        for (size_t row = 0; c->columns[k] >= 0 && row < c->out->rows; row++) {
            const double time = read_clock(c, k, row);
            if (!isfinite(time))
                return iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "row %zu: %s is not finite", row + 1,
                                        iso_clock_name((iso_clock)k));
            c->span[k] = fmax(c->span[k], fabs(time));
        }
    return ISO_OK;
}

/* Reads columns, clocks and effects of the record, and finds which models it has. */
static iso_status begin(checker *c, bool has[2])
{
    const iso_record *r = c->record;
    for (int i = 0; i < ISO_TRAJECTORY_COLUMNS; i++) c->columns[i] = iso_record_find(r, iso_trajectory_columns[i]);
    c->out->rows = iso_record_rows(r);
    iso_status status = measure_clocks(c);
    if (status == ISO_OK) status = iso_record_effects(c->ctx, r, &c->effects);
    c->effects.on[ISO_ATTITUDE] = c->effects.on[ISO_ATTITUDE] && has_attitude(c); /* they change no motion */
    if (c->params->D > 0 && c->columns[ISO_COLUMN_REACTIONS] >= 0) c->effects.on[ISO_REACTIONS] = true;
    if (status != ISO_OK) return status;
    for (int m = 0; m < 2; m++) has[m] = has_model(c, m ? ISO_POINT : ISO_BALL);
    if (!has[0] && !has[1])
        return iso_context_fail(c->ctx, ISO_BAD_INPUT, "columns",
                                "the trajectory has neither a ball's six columns "
                                "(omega1 ... n3) nor a point's (M1 ... gamma3)");
    if (c->out->rows == 0) return iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "the trajectory has no rows");
    return ISO_OK;
}

iso_status iso_check(iso_context *ctx, const iso_params *params, const iso_record *record, double tolerance,
                     iso_residuals *residuals)
{
    ISO_DEFAULT_ARITHMETIC;
    checker c = {.ctx = ctx, .params = params, .record = record, .tolerance = tolerance, .out = residuals};
    bool has[2];
    *residuals = (iso_residuals){.rows = 0};
    iso_status status = begin(&c, has);
    if (status == ISO_OK && has[0]) status = check_model(&c, ISO_BALL);
    if (status == ISO_OK && has[1]) status = check_model(&c, ISO_POINT);
    if (status == ISO_OK && has[0] && has[1]) check_map(&c);
    return status;
}

/* --- drifts over time ------------------------------------------------------------------------------------------- */

static iso_status record_drifts(const checker *c, const expectations *e, int clock, iso_record **drifts)
{
    const char *names[1 + ISO_MAX_INTEGRALS] = {clock < 0 ? "row" : iso_clock_name((iso_clock)clock)};
    for (int i = 0; i < e->count; i++) names[1 + i] = e->integral[i]->name;
    iso_status status = iso_record_create(c->ctx, (size_t)(1 + e->count), names, drifts);
    for (size_t row = 0; status == ISO_OK && row < c->out->rows; row++) {
        double *to;
        status = iso_record_append(c->ctx, *drifts, &to);
        if (status != ISO_OK) break;
        to[0] = clock < 0 ? (double)row + 1 : read_clock(c, clock, row);
        for (int i = 0; i < e->count; i++) to[1 + i] = fabs(integral_drift(c, e, i, row));
    }
    return status;
}

iso_status iso_check_drifts(iso_context *ctx, const iso_params *params, const iso_record *record, iso_record **drifts)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_residuals unused = {.rows = 0};
    checker c = {.ctx = ctx, .params = params, .record = record, .out = &unused};
    iso_orbit *first = NULL;
    expectations e;
    bool has[2];
    *drifts = NULL;
    iso_status status = begin(&c, has);
    const iso_picture model = has[0] ? ISO_BALL : ISO_POINT;
    if (status == ISO_OK) status = open_first(&c, model, &first);
    if (status == ISO_OK) {
        expect_integrals(&c, model, first, &e);
        status = record_drifts(&c, &e, clock_to_follow(&c, model), drifts);
    }
    iso_orbit_free(first);
    if (status != ISO_OK) iso_record_free(*drifts), *drifts = NULL;
    return status;
}
