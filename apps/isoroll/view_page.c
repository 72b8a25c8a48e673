/* view_page.c - what the parts of `isoroll view` share: the struct of the page, and records (see view.h). */
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "view.h"

static void free_section(view_section *s)
{
    if (!s) return;
    for (size_t i = 0; i < s->count; i++) iso_record_free(s->orbit[i]), iso_record_free(s->beside[i]);
    iso_record_free(s->crossings);
    free(s->orbit);
    free(s->beside);
    free(s->fate);
    free(s->number);
    free(s);
}

void view_page_free(view_page *page)
{
    iso_record_free(page->rows);
    iso_record_free(page->drifts);
    iso_record_free(page->apart);
    iso_record_free(page->beside);
    free(page->times);
    free_section(page->section);
}

iso_status view_read_effects(iso_context *ctx, const iso_record *r, view_page *page)
{
    iso_start start;
    const iso_model_kind model = iso_record_find(r, "n1") >= 0 ? ISO_BALL : ISO_POINT;
    const iso_status status = iso_record_effects(ctx, r, &page->effects);
    if (status != ISO_OK || iso_record_rows(r) == 0) return status;
    iso_effects settled = page->effects;
    if (iso_record_start(ctx, r, &page->params, model, 0, &start, &settled) == ISO_OK)
        memcpy(page->effects.idle, settled.idle, sizeof settled.idle);
    return ISO_OK; /* a row that is no start is refused later, with its place */
}

bool view_is_broken(view_page *page)
{
    const iso_effect *breaking = iso_effects_breaking(&page->effects);
    if (breaking)
        snprintf(page->alone, sizeof page->alone, "the effect '%s' breaks the isomorphism: %s", breaking->name,
                 iso_effect_why_broken(breaking));
    return breaking != NULL;
}

iso_status view_read_lines(iso_context *ctx, const file_options *from, iso_record *r, view_page *page)
{
    iso_status status = parameters_of_file(ctx, from, r, &page->params);
    if (status == ISO_OK) status = view_read_effects(ctx, r, page);
    page->attitude = page->effects.on[ISO_ATTITUDE];
    if (status == ISO_OK && !iso_record_get_numbers(ctx, r, "h", 1, &page->h, &status)) page->h = NAN;
    if (status == ISO_OK && !iso_record_coupling(ctx, r, &page->params, &page->eps, &status)) page->eps = NAN;
    return status;
}

void view_note(view_page *page, const char *format, ...)
{
    va_list arguments;
    if (page->notes == VIEW_NOTES) return;
    va_start(arguments, format);
    vsnprintf(page->note[page->notes++], VIEW_WORDS, format, arguments);
    va_end(arguments);
}

bool view_is_of_point(int column)
{
    return column == ISO_CLOCK_TAU || column == ISO_CLOCK_S ||
           (column >= ISO_COLUMN_POINT && column < ISO_COLUMN_EFFECTS);
}

iso_status view_orbit(iso_context *ctx, const view_page *page, const iso_start *start, iso_effects *effects,
                      iso_clock clock, iso_orbit **orbit)
{
    const bool twin = !*page->alone;
    iso_orbit_options o = iso_orbit_defaults(start);
    effects->on[ISO_ATTITUDE] = true;
    o.effects = effects;
    o.backend = ISO_BACKEND_BALL;
    o.clock = clock;
    o.shown = twin ? ISO_SHOW_BOTH : ISO_SHOW_BALL;
    for (int i = 0; twin && i < ISO_CLOCKS; i++) o.with_clock[i] = true;
    return iso_orbit_create(ctx, &page->params, start, &o, orbit);
}

const double *view_vector(const iso_record *r, size_t row, const char *name)
{
    const int column = iso_record_find(r, name);
    return column < 0 ? NULL : iso_record_const_row(r, row) + column;
}

double view_distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

double view_largest_turn(const iso_record *r, double k)
{
    const int t = iso_record_find(r, "t");
    double most = 0;
    for (size_t i = 1; t >= 0 && i < iso_record_rows(r); i++) {
        const double *before = view_vector(r, i - 1, "gamma1"), *now = view_vector(r, i, "gamma1");
        const double dt = fabs(iso_record_const_row(r, i)[t] - iso_record_const_row(r, i - 1)[t]);
        for (size_t j = i - 1; j <= i; j++) {
            const double *omega = view_vector(r, j, "omega1");
            most = fmax(most, hypot(hypot(omega[0], omega[1]), omega[2]) * dt * fmax(1, fabs(k)));
        }
        if (now) most = fmax(most, view_distance(now, before));
    }
    return most;
}

void view_note_turn(view_page *page)
{
    const double turn = view_largest_turn(page->rows, page->params.k), degrees = turn * 180 / acos(-1);
    if (turn > 1)
        view_note(page, "Rows turn by up to %.0f degrees: between them the motion is a guess.", degrees);
    else if (turn > 2 * VIEW_TURN)
        view_note(page, "Rows turn by up to %.0f degrees: between them the motion is off by about %.0e radians.",
                  degrees, pow(turn, 4) / 384);
}
