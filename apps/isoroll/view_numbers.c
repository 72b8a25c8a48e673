/* view_numbers.c - the integrals that hold along the rows of a page, and how far they drift (see view.h). */
#include <math.h>

#include "orbit/watch_impl.h"
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

/* Lists the integrals of one model that hold, without the constraints. */
static void list_integrals(view_page *page, const iso_orbit *orbit, iso_model_kind model, const iso_sample *first)
{
    iso_drift list[ISO_MAX_INTEGRALS];
    const double level = model == ISO_POINT ? orbit->level : (double)NAN;
    const int count = iso_watch_begin(orbit, iso_systems[model], level, first, list, ISO_MAX_INTEGRALS);
    for (int i = 0; i < count; i++)
        if (list[i].integral->known == ISO_ANY_VALUE) page->integral[page->integrals++] = list[i];
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
    iso_record_sample(page->rows, 0, &sample);
    list_integrals(page, orbit, ISO_BALL, &sample);
    if (!*page->alone) list_integrals(page, orbit, ISO_POINT, &sample);
    for (int i = 0; i < page->integrals; i++) snprintf(name[i], sizeof name[i], "drift%d", i), names[i] = name[i];
    if (page->integrals > 0) status = iso_record_create(ctx, (size_t)page->integrals, names, &page->drifts);
    for (size_t i = 0; page->drifts && status == ISO_OK && i < iso_record_rows(page->rows); i++) {
        iso_record_sample(page->rows, i, &sample);
        iso_watch_follow(orbit, &sample, page->integral, page->integrals);
        status = iso_record_append(ctx, page->drifts, &row);
        for (int j = 0; status == ISO_OK && j < page->integrals; j++) row[j] = page->integral[j].now;
    }
    iso_orbit_free(orbit);
    return status;
}
