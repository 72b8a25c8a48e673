/* check_common.c - what all parts of a check ask: residuals by name, a row as a state and as a sample, distances; and
 * constraints and integrals at each row, in the units of the first one. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/model_impl.h"
#include "task/check/check_impl.h"

iso_residual *iso_checker_residual(iso_residuals *r, const char *name, const char *what)
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
    iso_residual *at = iso_checker_residual(found, name, what);
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

/* --- integrals -------------------------------------------------------------------------------------------------- */

void iso_checker_own(const checker *c, const expectations *e, const double row[], double own[ISO_MAX_STATE])
{
    iso_sample sample;
    iso_sample_of_row(c->columns, row, &sample);
    iso_orbit_state_of(e->first, e->system, &sample, own);
}

/* The orbit of the first row, and the level that H of a point should have: the one that the lines state, or 0 where the
 * record has a ball's columns or clocks; else any. */
static void find_level(const checker *c, checked_model *m)
{
    expectations *e = &m->expect;
    const iso_units *units = iso_orbit_units(m->orbit);
    const double level = iso_effects_level(&c->effects) / iso_unit(units, iso_level_dimension());
    const bool twin = c->columns[ISO_CLOCK_T] >= 0 || c->columns[ISO_CLOCK_TAU] >= 0 || c->model[ISO_BALL].there;
    e->level = iso_effects_have_level(&c->effects) ? iso_coupling(&units->own, level) : 0;
    e->on_level = twin || iso_effects_have_level(&c->effects);
    e->system = m->system;
    e->first = m->orbit;
    e->problem = iso_orbit_model(m->orbit)->problem;
    e->energy = e->on_level && m->kind == ISO_POINT ? e->level : (double)NAN;
}

void iso_checker_expect(const checker *c, checked_model *m, const double first[])
{
    expectations *e = &m->expect;
    iso_sample sample;
    if (!e->first) find_level(c, m);
    iso_sample_of_row(c->columns, first, &sample);
    e->count = iso_watch_begin(m->orbit, m->system, e->energy, &sample, e->integral, ISO_MAX_INTEGRALS);
    for (int i = 0; i < e->count; i++)
        if (e->integral[i].integral->value == m->system->energy) e->energy = e->integral[i].expected;
}

void iso_checker_integrals(const checker *c, checked_model *m, const double row[])
{
    char name[sizeof m->found.residual[0].name];
    iso_sample sample;
    expectations *e = &m->expect;
    iso_sample_of_row(c->columns, row, &sample);
    iso_watch_follow(m->orbit, &sample, e->integral, e->count);
    for (int i = 0; i < e->count; i++) {
        const iso_drift *d = &e->integral[i];
        snprintf(name, sizeof name, "%s %s", d->system->name, d->integral->name);
        iso_checker_note(&m->found, name, d->integral->doc, d->now, c->number);
    }
}
