/* check_flow.c - from each row to the next: the state and the other clocks (check_impl.h).
 *
 * Two-point Taylor quadrature (method/two_point_impl.h) tells in about a microsecond how far a row is from the orbit
 * of the row before it. That is a sieve: rows which are off by more than half of the worst so far are integrated from
 * the row before, and what is reported comes from these integrations alone. So the numbers do not depend on the
 * quadrature, and few rows of a good trajectory are integrated. Rows far apart, and models with states or columns of
 * effects, are always integrated. */
#include <math.h>
#include <stdio.h>

#include "base/vec3_impl.h"
#include "method/methods_impl.h"
#include "orbit/convert.h"
#include "orbit/orbit_impl.h"
#include "study/check/check_impl.h"

/* Of the worst so far. */
static const double SIEVE = 0.5;
/* The quadrature's own measure of a defect is that of the integration as long as the state moves little: by so much
 * of its length. */
static const double NEAR = 0.5;

/* --- by integration --------------------------------------------------------------------------------------------- */

static iso_orbit_options options_of(const checker *c, const checked_model *m, const iso_start *start,
                                    const iso_effects *effects)
{
    iso_orbit_options o = iso_orbit_defaults(start);
    o.effects = effects;
    o.tolerance = c->tolerance;
    o.method = m->method;
    if (m->clock >= 0) o.clock = (iso_clock)m->clock;
    o.max_steps = ISO_MAX_ROW_STEPS;
    for (int k = 0; k < ISO_CLOCKS; k++) o.with_clock[k] = k != m->clock && c->columns[k] >= 0;
    return o;
}

iso_status iso_checker_open(const checker *c, const checked_model *m, const double row[], iso_orbit **orbit)
{
    iso_start start;
    iso_effects effects = iso_checker_effects(c, m->kind);
    ISO_TRY(iso_record_start_at(c->ctx, c->record, c->params, m->kind, row, &start, &effects));
    iso_orbit_options o = options_of(c, m, &start, &effects);
    iso_status status = iso_orbit_create(c->ctx, c->params, &start, &o, orbit);
    if (status != ISO_NOT_MAPPED) return status;
    for (int k = 0; k < ISO_CLOCKS; k++) o.with_clock[k] = false;
    return iso_orbit_create(c->ctx, c->params, &start, &o, orbit);
}

/* Integrates a row by so much of its clock. */
static iso_status integrate(const checker *c, const checked_model *m, const double row[], size_t number, double time,
                            iso_sample *sample)
{
    iso_orbit *orbit = NULL;
    iso_status status = iso_checker_open(c, m, row, &orbit);
    if (status == ISO_OK) status = iso_orbit_at(orbit, time, sample);
    iso_orbit_free(orbit);
    if (status == ISO_OK) return ISO_OK;
    if (status == ISO_BAD_ARGUMENT) status = ISO_BAD_INPUT; /* the number that is refused stands in the file */
    return iso_context_fail(c->ctx, status, "", "row %zu: %s", number, iso_context_message(c->ctx));
}

/* The columns of effects in a row to which nothing is integrated: they belong to its state. */
static iso_status check_alone(checker *c, checked_model *m, const double row[])
{
    iso_sample sample;
    if (m->kind != ISO_BALL || !iso_checker_has_effects(c)) return ISO_OK;
    ISO_TRY(integrate(c, m, row, c->number, 0, &sample));
    iso_checker_go_on(c, row, &sample);
    iso_checker_effects_flow(c, &m->found, &sample, row);
    return ISO_OK;
}

static iso_status check_step(checker *c, checked_model *m, const double row[])
{
    iso_sample sample;
    double here[ISO_STATE];
    char name[sizeof m->found.residual[0].name];
    const double time = iso_checker_at(c, row, m->clock) - iso_checker_at(c, c->last, m->clock);
    ISO_TRY(integrate(c, m, c->last, c->before, time, &sample));
    m->followed = c->looked[m->clock] = true;
    iso_checker_go_on(c, c->last, &sample);
    iso_checker_state(c, m, row, here);
    snprintf(name, sizeof name, "%s flow", iso_model_kind_name((int)m->kind));
    iso_checker_note(&m->found, name, "each row integrated to the next",
                     iso_checker_distance(m->kind == ISO_BALL ? sample.ball : sample.point, here), c->number);
    iso_checker_effects_flow(c, &m->found, &sample, row);
    for (int k = 0; k < ISO_CLOCKS; k++) {
        if (k == m->clock || c->columns[k] < 0 || isnan(sample.clock[k])) continue;
        c->looked[k] = true;
        snprintf(name, sizeof name, "clock %s", iso_clock_name((iso_clock)k));
        const double step = iso_checker_at(c, row, k) - iso_checker_at(c, c->last, k);
        iso_checker_note(&m->found, name, "its steps, from the equations of motion", step - sample.clock[k],
                         c->number); /* divided by the clock's span at the end */
    }
    return ISO_OK;
}

/* --- by quadrature ---------------------------------------------------------------------------------------------- */

static void add_sample(const checker *c, checked_model *m, const double row[])
{
    double own[ISO_STATE];
    iso_checker_state(c, m, row, own);
    for (int i = 0; i < 3; i++) own[i] /= m->kind == ISO_BALL ? m->way->units.w : m->way->unit_M;
    iso_two_point_add(m->quadrature, own);
}

/* Whether nothing but the six numbers of the model goes on from row to row, by equations that have a series. */
static bool suits(const checker *c, const checked_model *m)
{
    const iso_model *model = iso_orbit_model(m->way);
    const iso_effects effects = iso_orbit_effects(m->way);
    return model->system == m->system && (int)model->clock == m->clock && m->clock == (int)m->system->clock &&
           model->moving == ISO_STATE && !m->way->rests && !iso_checker_has_effects(c) &&
           !iso_effects_breaking(&effects);
}

/* The state moves little from the last row to this one. */
static bool is_near(const checker *c, const checked_model *m, const double row[])
{
    double a[ISO_STATE], b[ISO_STATE];
    iso_checker_state(c, m, c->last, a);
    iso_checker_state(c, m, row, b);
    return iso_checker_distance(a, b) <= NEAR;
}

/* How far the clock's step in the rows is from that of the quadrature. */
static double clock_defect(const checker *c, const checked_model *m, const iso_gap *gap, int k, const double row[])
{
    if (k == m->clock || c->columns[k] < 0 || !m->way->options.with_clock[k]) return 0;
    return fabs(iso_checker_at(c, row, k) - iso_checker_at(c, c->last, k) - gap->gained[k] * m->way->unit_clock[k]);
}

/* Whether the row is so near to the orbit of the last one that it needs no integration. */
static bool passes(checker *c, checked_model *m, const double row[])
{
    iso_gap gap;
    if (!m->quadrature) return false;
    add_sample(c, m, row);
    if (!m->followed) return false;
    const double h =
        (iso_checker_at(c, row, m->clock) - iso_checker_at(c, c->last, m->clock)) / m->way->unit_clock[m->clock];
    if (!is_near(c, m, row) || !iso_two_point_measure(m->quadrature, h, 0, &gap)) return false;
    bool good = gap.defect <= SIEVE * m->seen;
    for (int k = 0; k < ISO_CLOCKS; k++) good = good && clock_defect(c, m, &gap, k, row) <= SIEVE * m->seen_clock[k];
    if (good) return true;
    m->seen = fmax(m->seen, gap.defect);
    for (int k = 0; k < ISO_CLOCKS; k++) m->seen_clock[k] = fmax(m->seen_clock[k], clock_defect(c, m, &gap, k, row));
    return false;
}

iso_status iso_checker_flow_begin(checker *c, checked_model *m, const double first[])
{
    iso_status status = check_alone(c, m, first);
    if (m->clock < 0 || status != ISO_OK) return status;
    status = iso_checker_open(c, m, first, &m->way);
    m->method = status == ISO_OK ? iso_method_of_other_kind(iso_orbit_model(m->way)) : NULL;
    if (status == ISO_OK && suits(c, m))
        status = iso_two_point_create(c->ctx, iso_orbit_model(m->way), c->tolerance, &m->quadrature);
    if (m->quadrature) add_sample(c, m, first);
    return status == ISO_NO_MEMORY ? status : ISO_OK; /* what else is wrong is told when the row is integrated */
}

iso_status iso_checker_flow(checker *c, checked_model *m, const double row[])
{
    if (m->clock < 0) return check_alone(c, m, row);
    return passes(c, m, row) ? ISO_OK : check_step(c, m, row);
}
