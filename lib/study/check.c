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
    [ISO_BALL] = ISO_COLUMN_BALL, [ISO_POINT] = ISO_COLUMN_POINT}; /* of a trajectory */

static const iso_system *system_of(iso_model_kind model)
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

static bool has_model(const checker *c, iso_model_kind model)
{
    for (int i = 0; i < ISO_STATE; i++)
        if (c->columns[first_column[model] + i] < 0) return false;
    return true;
}

static void read_state(const checker *c, iso_model_kind model, size_t row, double y[ISO_STATE])
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
static iso_effects effects_of(const checker *c, iso_model_kind model)
{
    if (model == ISO_BALL) return c->effects;
    iso_effects effects = iso_effects_acting(&c->effects);
    if (iso_record_get(c->record, "eps") || iso_record_get(c->record, "h"))
        iso_effects_set_level(&effects, iso_effects_have_level(&effects), NAN);
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
static void expect_integrals(const checker *c, iso_model_kind model, const iso_orbit *first, expectations *e)
{
    const iso_params *own = &iso_orbit_units(first)->own;
    const double level = iso_effects_level(&c->effects) / iso_unit(iso_orbit_units(first), iso_level_dimension());
    const double claimed = iso_effects_have_level(&c->effects) ? iso_coupling(own, level) : 0;
    const bool twin = c->columns[ISO_CLOCK_T] >= 0 || c->columns[ISO_CLOCK_TAU] >= 0 || has_model(c, ISO_BALL);
    *e = (expectations){.system = system_of(model), .first = first};
    e->count = iso_integrals_holding(e->system, &iso_orbit_model(first)->problem, e->integral, ISO_MAX_INTEGRALS);
    for (int i = 0; i < e->count; i++) {
        double size;
        const bool on_level = twin && strcmp(e->integral[i]->name, "H") == 0;
        e->value[i] = e->integral[i]->known == ISO_ONE ? 1 : on_level ? claimed : 0;
        if (e->integral[i]->known == ISO_ANY_VALUE && !on_level) e->value[i] = integral_value(c, e, i, 0, &size);
    }
}

static void check_integrals(checker *c, iso_model_kind model, const iso_orbit *first)
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
static int clock_to_follow(const checker *c, iso_model_kind model)
{
    const int own = (int)system_of(model)->clock;
    if (c->columns[own] >= 0) return own;
    for (int k = 0; k < ISO_CLOCKS; k++)
        if (c->columns[k] >= 0) return k;
    return -1;
}

/* Integrates `row` to the time of the next row. The record's other clocks are integrated, too, where the orbit has
 * them: a point with H not 0 has no free ball and no time t. */
static iso_status next_sample(const checker *c, iso_model_kind model, int clock, size_t row, iso_sample *sample)
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
    for (int k = 0; k < ISO_CLOCKS; k++) o.with_clock[k] = k != clock && c->columns[k] >= 0;
    status = iso_orbit_create(c->ctx, c->params, &start, &o, &orbit);
    if (status == ISO_NOT_MAPPED) {
        for (int k = 0; k < ISO_CLOCKS; k++) o.with_clock[k] = false;
        status = iso_orbit_create(c->ctx, c->params, &start, &o, &orbit);
    }
    if (status == ISO_OK)
        status = iso_orbit_at(orbit, read_clock(c, clock, row + 1) - read_clock(c, clock, row), sample);
    iso_orbit_free(orbit);
    if (status == ISO_OK) return ISO_OK;
    if (status == ISO_BAD_ARGUMENT) status = ISO_BAD_INPUT; /* the number that is refused stands in the file */
    return iso_context_fail(c->ctx, status, "", "row %zu: %s", row + 1, iso_context_message(c->ctx));
}

/* The first column of a group of an effect, in a trajectory; NULL: that of the first group that moves. -1: none. */
static int column_of(iso_effect_id id, const char *name)
{
    int column = ISO_COLUMN_EFFECTS + iso_effect_first_column(id);
    for (const iso_effect_column *g = iso_effect_list[id]->columns; g && g->name; column += g->count, g++)
        if (name ? strcmp(g->name, name) == 0 : g->moves) return column;
    return -1;
}

/* Groups that are side by side and have one name in the report: `count` columns from `first` on. */
typedef struct checked {
    const iso_effect_column *group;
    iso_effect_id effect;
    int first, count;
} checked;

/* The size of the group that errors are measured by as well: of forces, of which the radius makes torques. */
static double other_size(const checker *c, const checked *k, const iso_sample *flow)
{
    const double radius = c->params->body.radius;
    double size = 0;
    if (!k->group->sized_by) return 0;
    const int first = column_of(k->effect, k->group->sized_by);
    for (const iso_effect_column *g = iso_effect_list[k->effect]->columns; first >= 0 && g->name; g++)
        for (int i = 0; strcmp(g->name, k->group->sized_by) == 0 && i < g->count; i++)
            size = fmax(size, fabs(iso_sample_column(flow, first + i)));
    return size * fmax(1, radius > 0 ? radius : 1);
}

/* What moves along a plane goes on from the row before. */
static void check_columns(checker *c, const checked *k, const iso_sample *flow, const iso_sample *before,
                          const iso_sample *there, size_t row)
{
    const bool goes_on = c->params->k == 1 && k->group->moves;
    double error = 0, size = 0;
    char name[sizeof c->out->residual[0].name];
    for (int i = k->first; i < k->first + k->count; i++) {
        double expected = iso_sample_column(flow, i);
        if (goes_on) expected += iso_sample_column(before, column_of(k->effect, NULL) + (i - k->first));
        if (isnan(expected) || c->columns[i] < 0) continue;
        error = fmax(error, fabs(expected - iso_sample_column(there, i)));
        size = fmax(size, fmax(fabs(expected), fabs(iso_sample_column(there, i))));
    }
    size = fmax(size, other_size(c, k, flow));
    snprintf(name, sizeof name, "%s flow", k->group->checked_as);
    if (size > 0) note(c, name, "effects' columns, each row integrated to the next", error / size, row);
}

static bool same_report(const iso_effect_column *a, const iso_effect_column *b)
{
    return b->name && a->checked_as && b->checked_as && strcmp(a->checked_as, b->checked_as) == 0;
}

/* Compares the columns of effects in row `row` with the flow from the row before, relative to the group's largest. */
static void check_effects(checker *c, const iso_sample *flow, size_t row)
{
    iso_sample there, before;
    int first = ISO_COLUMN_EFFECTS;
    read_sample(c, row, &there);
    read_sample(c, row - 1, &before);
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_column *g = iso_effect_list[e]->columns; g && g->name; g++) {
            checked k = {.group = g, .effect = e, .first = first, .count = g->count};
            for (; same_report(g, g + 1); g++) k.count += g[1].count;
            if (g->checked_as) check_columns(c, &k, flow, &before, &there, row);
            first += k.count;
        }
}

/* Whether the record has what an effect that acts on nothing begins with: the numbers that turn with the ball, and
 * on a plane the displacement, without which the height is not known. */
static bool has_beginning(const checker *c, iso_effect_id id)
{
    const int displacement = column_of(id, NULL);
    bool has = c->params->k != 1 || displacement < 0 || c->columns[displacement] >= 0;
    for (const iso_effect_number *n = iso_effect_list[id]->numbers; n && n->name; n++)
        if (n->turns_with) has = has && c->columns[column_of(id, n->turns_with)] >= 0;
    return has;
}

/* Whether an effect that acts on nothing can be asked for because its columns are there: no line has to state a
 * number. */
static bool is_shown(const checker *c, iso_effect_id id)
{
    const iso_effect *effect = iso_effect_list[id];
    bool stated = false;
    for (const iso_effect_number *n = effect->numbers; n && n->name; n++) stated = stated || !n->scene_only;
    return effect->columns && !stated && (!effect->needs_D || c->params->D > 0) &&
           c->columns[ISO_COLUMN_EFFECTS + iso_effect_first_column(id)] >= 0;
}

static void choose_observers(checker *c)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        if (iso_effect_list[e]->observes)
            c->effects.on[e] = (c->effects.on[e] && has_beginning(c, e)) || is_shown(c, e);
}

static iso_status check_step(checker *c, iso_model_kind model, int clock, size_t row)
{
    iso_sample sample;
    double next[ISO_STATE];
    char name[sizeof c->out->residual[0].name];
    const iso_status status = next_sample(c, model, clock, row, &sample);
    if (status != ISO_OK) return status;
    read_state(c, model, row + 1, next);
    snprintf(name, sizeof name, "%s flow", iso_model_kind_name((int)model));
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

static iso_status check_flow(checker *c, iso_model_kind model)
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
static iso_status open_first(checker *c, iso_model_kind model, iso_orbit **first)
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

static iso_status check_model(checker *c, iso_model_kind model)
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
    for (int i = 0; i < ISO_TRAJECTORY_COLUMNS; i++)
        c->columns[i] = i < iso_columns_count() ? iso_record_find(r, iso_column_name(i)) : -1;
    c->out->rows = iso_record_rows(r);
    iso_status status = measure_clocks(c);
    if (status == ISO_OK) status = iso_record_effects(c->ctx, r, &c->effects);
    if (status != ISO_OK) return status;
    choose_observers(c);
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
    const iso_model_kind model = has[0] ? ISO_BALL : ISO_POINT;
    if (status == ISO_OK) status = open_first(&c, model, &first);
    if (status == ISO_OK) {
        expect_integrals(&c, model, first, &e);
        status = record_drifts(&c, &e, clock_to_follow(&c, model), drifts);
    }
    iso_orbit_free(first);
    if (status != ISO_OK) iso_record_free(*drifts), *drifts = NULL;
    return status;
}
