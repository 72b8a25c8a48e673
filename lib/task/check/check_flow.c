/* check_flow.c - from each row to the next: the state and the other clocks (check_impl.h).
 *
 * Two-point Taylor quadrature (method/two_point_impl.h) tells in about a microsecond how far a row is from the orbit
 * of the row before it. That is a sieve: rows which are off by more than half of the worst so far are integrated from
 * the row before, and what is reported comes from these integrations alone. So the numbers do not depend on the
 * quadrature, and few rows of a good trajectory are integrated. Rows far apart, and models with states or columns of
 * effects, are always integrated. */
#include <math.h>
#include <stdio.h>

#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"
#include "task/check/check_impl.h"
#include "task/convert/convert.h"

/* Of the worst so far. */
static const double SIEVE = 0.5;
/* The quadrature's own measure of a defect is that of the integration as long as the state moves little: by so much
 * of its length. */
static const double NEAR = 0.5;

/* --- by integration --------------------------------------------------------------------------------------------- */

/* The orbit of a row. The record's other clocks are computed, too, where the orbit has them: a point with H not 0 has
 * no free ball and no time t. */
static iso_status open_row(const checker *c, const checked_model *m, const double row[], iso_orbit **orbit)
{
    iso_start start;
    iso_effects effects = iso_checker_effects(c, m->kind);
    ISO_TRY(iso_record_start_at(c->ctx, c->record, c->params, m->kind, row, &start, &effects));
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &effects;
    o.tolerance = c->tolerance;
    o.method = m->method;
    if (m->clock >= 0) o.clock = (iso_clock)m->clock;
    o.max_steps = ISO_MAX_ROW_STEPS;
    for (int k = 0; k < ISO_CLOCKS; k++) o.with_clock[k] = k != m->clock && c->columns[k] >= 0;
    iso_status status = iso_orbit_create(c->ctx, c->params, &start, &o, orbit);
    if (status != ISO_NOT_MAPPED) return status;
    for (int k = 0; k < ISO_CLOCKS; k++) o.with_clock[k] = false;
    return iso_orbit_create(c->ctx, c->params, &start, &o, orbit);
}

/* Names the row whose numbers are refused; from: the row before it, if the motion between them is, else 0. */
static iso_status name_row(const checker *c, iso_status status, size_t from)
{
    if (status == ISO_OK) return ISO_OK;
    if (status == ISO_BAD_ARGUMENT) status = ISO_BAD_INPUT; /* the number that is refused stands in the file */
    if (from == 0) return iso_context_fail(c->ctx, status, "", "row %zu: %s", c->number, iso_context_message(c->ctx));
    return iso_context_fail(c->ctx, status, "", "from row %zu to row %zu: %s", from, c->number,
                            iso_context_message(c->ctx));
}

/* The columns of effects in a row to which nothing is integrated: they belong to its state. */
static iso_status check_alone(checker *c, checked_model *m, const double row[])
{
    iso_sample sample;
    iso_orbit *orbit = NULL;
    if (m->kind != ISO_BALL || !iso_checker_has_effects(c)) return ISO_OK;
    iso_status status = open_row(c, m, row, &orbit);
    if (status == ISO_OK) status = iso_orbit_at(orbit, 0, &sample);
    iso_orbit_free(orbit);
    ISO_TRY(name_row(c, status, 0));
    iso_checker_go_on(c, row, &sample);
    iso_checker_effects_flow(c, &m->found, &sample, row);
    return ISO_OK;
}

static iso_status check_step(checker *c, checked_model *m, const double row[])
{
    iso_row_gap gap;
    char name[sizeof m->found.residual[0].name];
    ISO_TRY(name_row(c, iso_rows_integrate(&m->rows, &gap), c->before));
    m->followed = c->looked[m->clock] = true;
    snprintf(name, sizeof name, "%s flow", iso_model_kind_name((int)m->kind));
    iso_checker_note(&m->found, name, "each row integrated to the next", gap.miss, c->number);
    iso_checker_go_on(c, m->rows.last, &gap.reached);
    iso_checker_effects_flow(c, &m->found, &gap.reached, row);
    for (int k = 0; k < ISO_CLOCKS; k++) {
        if (k == m->clock || c->columns[k] < 0 || isnan(gap.gained[k])) continue;
        c->looked[k] = true;
        snprintf(name, sizeof name, "clock %s", iso_clock_name((iso_clock)k));
        const double step = iso_checker_at(c, row, k) - iso_checker_at(c, m->rows.last, k);
        iso_checker_note(&m->found, name, "its steps, from the equations of motion", step - gap.gained[k],
                         c->number); /* divided by the clock's span at the end */
    }
    return ISO_OK;
}

/* --- by quadrature ---------------------------------------------------------------------------------------------- */

/* How far the clock's step in the rows is from that of the quadrature. */
static double clock_defect(const checker *c, const checked_model *m, const iso_row_gap *gap, int k,
                           const double row[])
{
    if (k == m->clock || c->columns[k] < 0 || isnan(gap->gained[k])) return 0;
    return fabs(iso_checker_at(c, row, k) - iso_checker_at(c, m->rows.last, k) - gap->gained[k]);
}

/* Whether the row is so near to the orbit of the last one that it needs no integration. */
static bool passes(checker *c, checked_model *m, const double row[])
{
    iso_row_gap gap;
    double last[ISO_STATE], here[ISO_STATE];
    if (!m->followed) return false;
    iso_row_state(c->columns, m->kind, m->rows.last, last);
    iso_row_state(c->columns, m->kind, row, here);
    if (!(iso_distance(last, here) <= NEAR) || !iso_rows_measure(&m->rows, 0, &gap)) return false;
    bool good = gap.miss <= SIEVE * m->seen;
    for (int k = 0; k < ISO_CLOCKS; k++) good = good && clock_defect(c, m, &gap, k, row) <= SIEVE * m->seen_clock[k];
    if (good) return true;
    m->seen = fmax(m->seen, gap.miss);
    for (int k = 0; k < ISO_CLOCKS; k++) m->seen_clock[k] = fmax(m->seen_clock[k], clock_defect(c, m, &gap, k, row));
    return false;
}

static iso_status open_at(void *data, const double row[], iso_orbit **orbit)
{
    const checked_model *m = data;
    return open_row(m->checker, m, row, orbit);
}

iso_status iso_checker_flow_begin(checker *c, checked_model *m, const double first[])
{
    iso_orbit *orbit = NULL;
    iso_status status = check_alone(c, m, first);
    if (m->clock < 0 || status != ISO_OK) return status;
    iso_rows_free(&m->rows);
    m->rows = (iso_rows){.ctx = c->ctx,
                         .model = m->kind,
                         .clock = (iso_clock)m->clock,
                         .columns = c->columns,
                         .width = c->width,
                         .alone = iso_checker_has_effects(c),
                         .open = open_at,
                         .data = m};
    status = open_row(c, m, first, &orbit);
    if (status == ISO_NO_MEMORY) return status; /* what else is wrong is said when the row is integrated */
    m->method = orbit ? iso_method_of_other_kind(iso_orbit_model(orbit)) : NULL;
    status = iso_rows_begin(&m->rows, orbit, first, c->tolerance);
    iso_orbit_free(orbit);
    return status;
}

iso_status iso_checker_flow(checker *c, checked_model *m, const double row[])
{
    if (m->clock < 0) return check_alone(c, m, row);
    iso_rows_take(&m->rows, row);
    const iso_status status = passes(c, m, row) ? ISO_OK : check_step(c, m, row);
    iso_rows_keep(&m->rows);
    return status;
}
