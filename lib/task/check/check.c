/* Does a trajectory solve its model? See check.h. This file takes the rows one after the other, in constant memory,
 * and puts the residuals together. check_impl.h says which files look at what. */
#include "task/check/check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "task/check/check_impl.h"

/* --- residuals -------------------------------------------------------------------------------------------------- */

/* The residual of a name; it is made if it is new. NULL: there are too many. */
static iso_residual *residual_of(iso_residuals *r, const char *name, const char *what)
{
    int i = 0;
    while (i < r->count && strcmp(r->residual[i].name, name) != 0) i++;
    if (i == ISO_MAX_RESIDUALS) return NULL;
    iso_residual *at = &r->residual[i];
    if (i < r->count) return at;
    r->count++;
    *at = (iso_residual){.what = what};
    snprintf(at->name, sizeof at->name, "%s", name);
    return at;
}

void iso_checker_note(iso_residuals *found, const char *name, const char *what, double value, size_t row)
{
    iso_residual *at = residual_of(found, name, what);
    if (!at || (!(fabs(value) > at->worst) && !isnan(value))) return;
    at->worst = isnan(value) ? INFINITY : fabs(value);
    at->row = row;
}

iso_effects iso_checker_effects(const checker *c, iso_model_kind kind)
{
    if (kind == ISO_BALL) return c->effects;
    iso_effects effects = iso_effects_acting(&c->effects);
    if (iso_record_get(c->record, "eps") || iso_record_get(c->record, "h"))
        iso_effects_set_level(&effects, iso_effects_have_level(&effects), NAN);
    return effects;
}

/* --- beginning -------------------------------------------------------------------------------------------------- */

/* The clock to follow is the model's own if the record has it, else the first one there; -1: the record has none. */
static iso_status find_model(checker *c, iso_model_kind kind)
{
    checked_model *m = &c->model[kind];
    iso_status status = ISO_OK;
    m->checker = c;
    m->kind = kind;
    m->system = kind == ISO_BALL ? &iso_system_ball : &iso_system_point;
    m->first = kind == ISO_BALL ? ISO_COLUMN_BALL : ISO_COLUMN_POINT;
    m->there = true;
    for (int i = 0; i < ISO_STATE; i++) m->there = m->there && c->columns[m->first + i] >= 0;
    m->clock = -1;
    for (int k = ISO_CLOCKS - 1; k >= 0; k--)
        if (c->columns[k] >= 0) m->clock = k;
    if (c->columns[m->system->clock] >= 0) m->clock = (int)m->system->clock;
    m->has_eps = m->there && kind == ISO_POINT && iso_record_coupling(c->ctx, c->record, c->params, &m->eps, &status);
    return status;
}

/* Reads the names and lines of the record, chooses effects, finds the models. Errors: those of iso_check. */
static iso_status begin(checker *c)
{
    iso_record_find_columns(c->record, c->columns);
    c->width = iso_record_columns(c->record);
    ISO_TRY(iso_record_effects(c->ctx, c->record, &c->effects));
    c->stated = c->effects;
    iso_checker_choose_observers(c);
    for (int k = 0; k < 2; k++) ISO_TRY(find_model(c, (iso_model_kind)k));
    if (c->model[0].there || c->model[1].there) return ISO_OK;
    return ISO_FAIL_INPUT(
        c->ctx, "columns",
        "the trajectory has neither a ball's six columns (omega1 ... n3) nor a point's (M1 ... gamma3)");
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

static iso_status measure_clocks(checker *c, const double row[])
{
    for (int k = 0; k < ISO_CLOCKS; k++) {
        if (c->columns[k] < 0) continue;
        const double time = iso_checker_at(c, row, k);
        if (!isfinite(time))
            return ISO_FAIL_INPUT(c->ctx, "", "row %zu: %s is not finite", c->number, iso_clock_name((iso_clock)k));
        c->span[k] = fmax(c->span[k], fabs(time));
    }
    return ISO_OK;
}

/* A row as a start. Where nothing turns with the ball it is enough to look at the six numbers. */
static iso_status find_start(const checker *c, const checked_model *m, const double row[], iso_start *start,
                             iso_effects *effects)
{
    double y[ISO_STATE];
    iso_row_state(c->columns, m->kind, row, y);
    const iso_status status = m->rows.quadrature
                                  ? iso_start_from_row(c->ctx, m->kind, y, m->has_eps ? &m->eps : NULL, false,
                                                       iso_record_row_tolerance(c->record), start)
                                  : iso_record_start_at(c->ctx, c->record, c->params, m->kind, row, start, effects);
    if (status == ISO_OK) return ISO_OK;
    return iso_context_fail(c->ctx, status, "", "row %zu: %s", c->number, iso_context_message(c->ctx));
}

/* The first row of an orbit gives the values, but all orbits of a file have the energy of its first row. */
static void expect(checked_model *m, const iso_sample *first)
{
    m->count = iso_watch_begin(m->orbit, m->system, m->energy, first, m->integral, ISO_MAX_INTEGRALS);
    for (int i = 0; i < m->count; i++)
        if (m->integral[i].integral->value == m->system->energy) m->energy = m->integral[i].expected;
}

static void check_integrals(const checker *c, checked_model *m, const iso_sample *row)
{
    char name[sizeof m->found.residual[0].name];
    iso_watch_follow(m->orbit, row, m->integral, m->count);
    for (int i = 0; i < m->count; i++) {
        const iso_drift *d = &m->integral[i];
        snprintf(name, sizeof name, "%s %s", d->system->name, d->integral->name);
        iso_checker_note(&m->found, name, d->integral->doc, d->now, c->number);
    }
}

/* The orbit of the first row, and the level that H of a point should have: the one that the lines state, or 0 where the
 * record has a ball's columns or clocks; else any. */
static iso_status open_first(checker *c, checked_model *m, const double row[])
{
    iso_start start;
    iso_effects effects = iso_checker_effects(c, m->kind);
    ISO_TRY(find_start(c, m, row, &start, &effects));
    for (int e = 0; e < ISO_EFFECTS; e++) c->effects.idle[e] = c->effects.idle[e] || effects.idle[e];
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &effects;
    ISO_TRY(iso_orbit_create(c->ctx, c->params, &start, &o, &m->orbit));
    const iso_units *units = iso_orbit_units(m->orbit);
    const bool level = iso_effects_have_level(&c->effects);
    m->on_level = level || c->columns[ISO_CLOCK_T] >= 0 || c->columns[ISO_CLOCK_TAU] >= 0 || c->model[ISO_BALL].there;
    m->level =
        level ? iso_coupling(&units->own, iso_effects_level(&c->effects) / iso_unit(units, iso_level_dimension()))
              : 0;
    m->energy = m->on_level && m->kind == ISO_POINT ? m->level : (double)NAN;
    return ISO_OK;
}

static iso_status check_model(checker *c, checked_model *m, const double row[])
{
    iso_start start;
    iso_sample sample;
    iso_effects effects = iso_checker_effects(c, m->kind);
    ISO_TRY(m->orbit ? find_start(c, m, row, &start, &effects) : open_first(c, m, row));
    iso_sample_of_row(c->columns, row, &sample);
    if (c->begins) expect(m, &sample);
    check_integrals(c, m, &sample);
    if (m->kind == ISO_BALL) iso_checker_beginning(c, m, row);
    if (!c->begins) return iso_checker_flow(c, m, row);
    for (int i = 0; i < ISO_STATE; i++) c->looked[m->first + i] = true;
    ISO_TRY(iso_checker_energy(c, m, row));
    return iso_checker_flow_begin(c, m, row);
}

iso_status iso_checking_put(iso_checking *c, const double row[])
{
    ISO_DEFAULT_ARITHMETIC;
    c->before = c->number;
    c->number = ++c->rows + c->passed;
    ISO_TRY(measure_clocks(c, row));
    for (int k = 0; k < 2; k++)
        if (c->model[k].there) ISO_TRY(check_model(c, &c->model[k], row));
    c->begins = false;
    if (!c->model[ISO_BALL].there || !c->model[ISO_POINT].there) return ISO_OK;
    double ball[ISO_STATE], point[ISO_STATE];
    iso_row_state(c->columns, ISO_BALL, row, ball);
    iso_row_state(c->columns, ISO_POINT, row, point);
    iso_ball_to_point(&c->units.own, ball, ball);
    scale(ball, iso_unit(&c->units, iso_system_point.fast_dimension));
    iso_checker_note(&c->map, "map", "the ball's point (18) against the record's", iso_distance(ball, point),
                     c->number);
    return ISO_OK;
}

/* --- the answer ------------------------------------------------------------------------------------------------- */

static void add(const checker *c, const iso_residuals *found, iso_residuals *all)
{
    for (int i = 0; i < found->count; i++) {
        const iso_residual *r = &found->residual[i];
        double size = 1; /* the steps of a clock are measured by its whole length */
        for (int k = 0; k < ISO_CLOCKS && strncmp(r->name, "clock ", 6) == 0; k++)
            if (strcmp(r->name + 6, iso_clock_name((iso_clock)k)) == 0) size = c->span[k];
        iso_residual *to = residual_of(all, r->name, r->what);
        if (to && size > 0 && r->worst / size > to->worst) to->worst = r->worst / size, to->row = r->row;
    }
}

iso_status iso_checking_end(iso_checking *c, iso_residuals *residuals)
{
    ISO_DEFAULT_ARITHMETIC;
    *residuals = (iso_residuals){.rows = c->rows + c->passed, .passed = c->passed};
    if (c->rows == 0)
        return ISO_FAIL_INPUT(c->ctx, "",
                              c->passed ? "all rows of the trajectory are nan" : "the trajectory has no rows");
    for (int k = 0; k < 2; k++) add(c, &c->model[k].found, residuals);
    add(c, &c->map, residuals);
    return ISO_OK;
}

void iso_checking_free(iso_checking *c)
{
    if (!c) return;
    for (int k = 0; k < 2; k++) {
        iso_rows_free(&c->model[k].rows);
        iso_orbit_free(c->model[k].orbit);
    }
    free(c);
}

iso_status iso_checking_create(iso_context *ctx, const iso_params *params, const iso_record *header, double tolerance,
                               iso_checking **checking)
{
    ISO_DEFAULT_ARITHMETIC;
    checker *c = *checking = calloc(1, sizeof *c);
    if (!c) return iso_context_no_memory(ctx, "a check");
    *c = (checker){.ctx = ctx, .params = params, .record = header, .tolerance = tolerance, .begins = true};
    iso_units_choose(params, 0, &c->units);
    const iso_status status = begin(c);
    if (status == ISO_OK) return ISO_OK;
    iso_checking_free(c);
    *checking = NULL;
    return status;
}

/* --- whole records ---------------------------------------------------------------------------------------------- */

iso_status iso_check(iso_context *ctx, const iso_params *params, const iso_record *record, double tolerance,
                     iso_residuals *residuals)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_checking *c;
    *residuals = (iso_residuals){.rows = 0};
    iso_status status = iso_checking_create(ctx, params, record, tolerance, &c);
    if (status != ISO_OK) return status;
    const int orbit = iso_record_find(record, ISO_ORBIT_COLUMN);
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(record); row++) {
        const double *x = iso_record_const_row(record, row);
        if (orbit >= 0 && row > 0 && x[orbit] != iso_record_const_row(record, row - 1)[orbit]) c->begins = true;
        status = iso_checking_put(c, x);
    }
    if (status == ISO_OK) status = iso_checking_end(c, residuals);
    iso_checking_free(c);
    return status;
}

/* --- drifts over time ------------------------------------------------------------------------------------------- */

/* Exponents of the unit of an integral, (mass length^2)^(a + b/(2k)) / time^c. */
static void find_dimension(const void *row, int i, iso_value *v)
{
    const iso_dimension d = ((const iso_drift *)row)->integral->dimension;
    v->number = i == 0 ? d.J : i == 1 ? d.J_2k : d.w;
}

static const iso_field doc_fields[] = {ISO_MEMBER(iso_integral, "doc", doc, "", "what it is"), ISO_FIELD_END};
static const iso_field model_fields[] = {ISO_MEMBER(iso_system, "model", name, "", "ball or point"), ISO_FIELD_END};
static const iso_field drift_fields[] = {
    ISO_STRUCT(iso_drift, "", integral, doc_fields, "which", .pointer = true),
    ISO_STRUCT(iso_drift, "", system, model_fields, "of which model", .pointer = true),
    ISO_FOUND("dimension", ISO_FIELD_INT, find_dimension, "", "exponents a, b, c of its unit", .count = 3),
    ISO_MEMBER(iso_drift, "start", start, "", "its value at the start; 0 within rounding"),
    ISO_MEMBER(iso_drift, "worst", worst, "", "its largest drift"),
    ISO_FIELD_END,
};

static iso_status record_drifts(checker *c, checked_model *m, const iso_record *rows, iso_record **drifts)
{
    iso_sample sample;
    const char *names[1 + ISO_MAX_INTEGRALS] = {m->clock < 0 ? "row" : iso_clock_name((iso_clock)m->clock)};
    double *to;
    for (int i = 0; i < m->count; i++) names[1 + i] = m->integral[i].integral->name;
    iso_status status = iso_record_create(c->ctx, (size_t)(1 + m->count), names, drifts);
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(rows); row++) {
        const double *x = iso_record_const_row(rows, row);
        status = iso_record_append(c->ctx, *drifts, &to);
        if (status != ISO_OK) break;
        to[0] = m->clock < 0 ? (double)row + 1 : iso_checker_at(c, x, m->clock);
        iso_sample_of_row(c->columns, x, &sample);
        iso_watch_follow(m->orbit, &sample, m->integral, m->count);
        for (int i = 0; i < m->count; i++) to[1 + i] = fabs(m->integral[i].now);
    }
    for (int i = 0; status == ISO_OK && i < m->count; i++) { /* what an integral is, in lines: "h.doc", ... */
        const iso_drift *d = &m->integral[i];
        const iso_field one[] = {
            {.name = d->integral->name, .type = ISO_FIELD_STRUCT, .fields = drift_fields, .doc = ""}, ISO_FIELD_END};
        if (d->integral->known == ISO_ANY_VALUE) status = iso_record_set_fields(c->ctx, *drifts, one, d);
    }
    return status;
}

/* Every row must be a state; the first one says what to expect. */
static iso_status look_at_rows(checker *c, checked_model *m, const iso_record *rows)
{
    iso_start start;
    iso_sample first;
    iso_status status = ISO_OK;
    if (iso_record_rows(rows) == 0) return ISO_FAIL_INPUT(c->ctx, "", "the trajectory has no rows");
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(rows); row++) {
        iso_effects effects = iso_checker_effects(c, m->kind);
        c->number = row + 1;
        status = measure_clocks(c, iso_record_const_row(rows, row));
        if (status == ISO_OK) status = find_start(c, m, iso_record_const_row(rows, row), &start, &effects);
    }
    c->number = 1;
    ISO_TRY(status);
    ISO_TRY(open_first(c, m, iso_record_const_row(rows, 0)));
    iso_sample_of_row(c->columns, iso_record_const_row(rows, 0), &first);
    expect(m, &first);
    return ISO_OK;
}

iso_status iso_check_drifts(iso_context *ctx, const iso_params *params, const iso_record *record, int model,
                            iso_record **drifts)
{
    ISO_DEFAULT_ARITHMETIC;
    checker *c;
    *drifts = NULL;
    ISO_TRY(iso_checking_create(ctx, params, record, 1e-12, &c));
    checked_model *m = &c->model[model >= 0 ? model : c->model[ISO_BALL].there ? ISO_BALL : ISO_POINT];
    iso_status status = look_at_rows(c, m, record);
    if (status == ISO_OK) status = record_drifts(c, m, record, drifts);
    iso_checking_free(c);
    if (status != ISO_OK) iso_record_free(*drifts), *drifts = NULL;
    return status;
}

const iso_field iso_residual_fields[] = {
    ISO_MEMBER(iso_residual, "name", name, "", "of what is 0"),
    ISO_MEMBER(iso_residual, "worst", worst, "", "the largest, relative"),
    ISO_MEMBER(iso_residual, "row", row, "", "the row of the largest"),
    ISO_MEMBER(iso_residual, "of", what, "", "in words"),
    ISO_FIELD_END,
};
