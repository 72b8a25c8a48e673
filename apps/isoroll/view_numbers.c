/* view_numbers.c - the integrals that hold along the rows of a page, and how far they drift (see view.h). */
#include <float.h>
#include <math.h>
#include <string.h>

#include "view.h"

/* The orbit through the first row; it tells which integrals hold. */
static iso_status orbit_of(iso_context *ctx, const view_page *page, iso_orbit **orbit)
{
    iso_start start;
    iso_effects effects = page->effects;
    ISO_TRY(iso_record_start(ctx, page->rows, &page->params, ISO_BALL, 0, &start, &effects));
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &effects;
    return iso_orbit_create(ctx, &page->params, &start, &o, orbit);
}

/* Lists the integrals of one model that hold. Those with a known value, such as |n| = 1, are left out, but not H. */
static void list_integrals(view_page *page, const iso_orbit *orbit, iso_model_kind model)
{
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const int count =
        iso_integrals_holding(iso_systems[model], &iso_orbit_model(orbit)->problem, list, ISO_MAX_INTEGRALS);
    for (int i = 0; i < count; i++)
        if (list[i]->known == ISO_ANY_VALUE || (model == ISO_POINT && strcmp(list[i]->name, "H") == 0))
            page->integral[page->integrals++] = (view_integral){list[i], model, NAN, 0, 0, false};
}

/* How far an integral is from its first value. */
static double drift(view_integral *v, const iso_orbit *orbit, const iso_sample *sample)
{
    double size;
    const double value = iso_orbit_integral(orbit, iso_systems[v->model], v->integral, sample, &size);
    if (isnan(v->first))
        v->first = value, v->start = value * iso_unit(iso_orbit_units(orbit), v->integral->dimension),
        v->zero = fabs(value) <= VIEW_ROUNDING * size;
    const double drifted = size > 0 ? (value - v->first) / size : 0;
    v->worst = fmax(v->worst, fabs(drifted));
    return drifted;
}

iso_status view_numbers(iso_context *ctx, view_page *page)
{
    const char *names[2 * ISO_MAX_INTEGRALS];
    char name[2 * ISO_MAX_INTEGRALS][ISO_NAME_SIZE];
    iso_orbit *orbit;
    double *row;
    iso_sample sample;
    iso_status status = orbit_of(ctx, page, &orbit);
    if (status == ISO_NOT_MAPPED) return ISO_OK; /* a point at rest, ... : no integrals are shown */
    if (status != ISO_OK) return status;
    list_integrals(page, orbit, ISO_BALL);
    if (!*page->alone) list_integrals(page, orbit, ISO_POINT);
    for (int i = 0; i < page->integrals; i++) snprintf(name[i], sizeof name[i], "drift%d", i), names[i] = name[i];
    if (page->integrals > 0) status = iso_record_create(ctx, (size_t)page->integrals, names, &page->drifts);
    for (size_t i = 0; page->drifts && status == ISO_OK && i < iso_record_rows(page->rows); i++) {
        iso_record_sample(page->rows, i, &sample);
        status = iso_record_append(ctx, page->drifts, &row);
        for (int j = 0; status == ISO_OK && j < page->integrals; j++)
            row[j] = drift(&page->integral[j], orbit, &sample);
    }
    iso_orbit_free(orbit);
    return status;
}
