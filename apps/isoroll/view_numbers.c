/* view_numbers.c - the integrals that hold along the rows of a page, and how far they drift (see view.h). */
#include <math.h>
#include <string.h>

#include "view.h"

/* The orbit through the first row; it tells which integrals hold. */
static iso_status orbit_of(iso_context *ctx, view_page *page, iso_orbit **orbit)
{
    iso_start start;
    iso_effects effects = page->effects;
    const bool ball = iso_record_find(page->rows, "omega1") >= 0;
    iso_status status =
        iso_record_start(ctx, page->rows, &page->params, ball ? ISO_BALL : ISO_POINT, 0, &start, &effects);
    if (status != ISO_OK) return status;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &effects;
    return iso_orbit_create(ctx, &page->params, &start, &o, orbit);
}

/* Row i as a sample; numbers that the row lacks are NaN. */
static iso_sample sample_of(const iso_record *r, size_t i)
{
    iso_sample s;
    const double *row = iso_record_const_row(r, i);
    for (int c = 0; c < ISO_CLOCKS; c++) s.clock[c] = NAN;
    for (int c = 0; c < ISO_STATE; c++) s.ball[c] = s.point[c] = NAN;
    for (int c = 0; c < ISO_EFFECT_COLUMNS; c++) s.effect[c] = NAN;
    for (size_t j = 0; j < iso_record_columns(r); j++) {
        const int c = iso_column_find(iso_record_name(r, j));
        if (c < 0) continue;
        if (c < ISO_CLOCKS)
            s.clock[c] = row[j];
        else if (c < ISO_COLUMN_POINT)
            s.ball[c - ISO_COLUMN_BALL] = row[j];
        else if (c < ISO_COLUMN_EFFECTS)
            s.point[c - ISO_COLUMN_POINT] = row[j];
        else
            s.effect[c - ISO_COLUMN_EFFECTS] = row[j];
    }
    return s;
}

/* Lists the integrals of one model that hold. Those with a known value, such as |n| = 1, are left out, but not H. */
static void list_integrals(view_page *page, const iso_orbit *orbit, iso_model_kind model)
{
    const iso_system *system = model == ISO_BALL ? &iso_system_ball : &iso_system_point;
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const int count = iso_integrals_holding(system, &iso_orbit_model(orbit)->problem, list, ISO_MAX_INTEGRALS);
    for (int i = 0; i < count && i < ISO_MAX_INTEGRALS; i++)
        if (list[i]->known == ISO_ANY_VALUE || (model == ISO_POINT && strcmp(list[i]->name, "H") == 0))
            page->integral[page->integrals++] = (view_integral){list[i], model, 0, 0};
}

/* Fills the column of one integral. */
static void follow(view_page *page, const iso_orbit *orbit, int which)
{
    view_integral *v = &page->integral[which];
    const iso_system *system = v->model == ISO_BALL ? &iso_system_ball : &iso_system_point;
    const double unit = iso_unit(iso_orbit_units(orbit), v->integral->dimension);
    double first = 0;
    for (size_t i = 0; i < iso_record_rows(page->rows); i++) {
        const iso_sample sample = sample_of(page->rows, i);
        double size;
        const double value = iso_orbit_integral(orbit, system, v->integral, &sample, &size);
        if (i == 0) first = value;
        const double drift = size > 0 ? (value - first) / size : 0;
        iso_record_row(page->drifts, i)[which] = drift;
        v->worst = fmax(v->worst, fabs(drift));
    }
    v->start = first * unit;
}

iso_status view_numbers(iso_context *ctx, view_page *page)
{
    const char *names[2 * ISO_MAX_INTEGRALS];
    char name[2 * ISO_MAX_INTEGRALS][ISO_NAME_SIZE];
    iso_orbit *orbit;
    double *row;
    iso_status status = orbit_of(ctx, page, &orbit);
    if (status == ISO_NOT_MAPPED) return ISO_OK; /* a point at rest, ... : no integrals are shown */
    if (status != ISO_OK) return status;
    if (iso_record_find(page->rows, "omega1") >= 0) list_integrals(page, orbit, ISO_BALL);
    if (!*page->alone && iso_record_find(page->rows, "M1") >= 0) list_integrals(page, orbit, ISO_POINT);
    for (int i = 0; i < page->integrals; i++) snprintf(name[i], sizeof name[i], "drift%d", i), names[i] = name[i];
    if (page->integrals > 0) status = iso_record_create(ctx, (size_t)page->integrals, names, &page->drifts);
    for (size_t i = 0; page->drifts && status == ISO_OK && i < iso_record_rows(page->rows); i++)
        status = iso_record_append(ctx, page->drifts, &row);
    for (int i = 0; status == ISO_OK && i < page->integrals; i++) follow(page, orbit, i);
    iso_orbit_free(orbit);
    return status;
}
