/* plot_table.c - pictures of the tables that commands write (see plot.h). A kind of table is a row of `kinds`. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "orbit/description.h"
#include "plot/draw.h"
#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"
#include "plot/section_picture.h"

/* --- sections --------------------------------------------------------------------------------------------------- */

static iso_status draw_section(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *r)
{
    section_picture *p = NULL;
    iso_status status = section_picture_create(ctx, r, &p);
    (void)title;
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(r); i++)
        status = section_picture_row(ctx, p, iso_record_const_row(r, i));
    if (status == ISO_OK) status = section_picture_draw(ctx, p, page);
    section_picture_free(p);
    return status;
}

/* The images of a crossing by the reversors and by half turns. */
static iso_status put_images(iso_context *ctx, const iso_record *r, size_t i, iso_record *images)
{
    const bool grey = iso_plot_is(r, i, "stability", "unstable") || iso_plot_is(r, i, "stability", "inverse");
    for (int n = 0; n < 8; n++) {
        double row[] = {iso_plot_number(r, i, "orbit") - 1, 0, 0, grey};
        iso_plot_image(n, iso_plot_number(r, i, "l"), iso_plot_number(r, i, "x"), &row[1]);
        ISO_TRY(iso_record_add(ctx, images, 1, row));
    }
    return ISO_OK;
}

static iso_status draw_orbits(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *r)
{
    static const char *const names[] = {"orbit", "l", "x", "grey"};
    char words[200];
    iso_params params;
    iso_record *images = NULL;
    const bool part = !iso_record_get(r, "title"); /* a file has one crossing of each orbit */
    snprintf(words, sizeof words, "%s%s", title, part ? ": a crossing of each orbit, its images" : "");
    iso_status status = iso_record_params(ctx, r, &params);
    if (status == ISO_OK) status = iso_record_create(ctx, 4, names, &images);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(r); i++) status = put_images(ctx, r, i, images);
    const iso_plot_section plot = {.title = words,
                                   .params = &params,
                                   .axis = iso_plot_axis_of(r),
                                   .rows = images,
                                   .grey_means = "unstable; each stable orbit has a colour",
                                   .few = true};
    if (status == ISO_OK) status = iso_plot_sections(ctx, page, &plot);
    iso_record_free(images);
    return status;
}

/* --- the kinds -------------------------------------------------------------------------------------------------- */

static const struct kind {
    const char *name, *shows; /* shows: the title of a table that has none */
    const char *columns[5];   /* that the picture needs; NULL ends them */
    bool axis;                /* and the line "axis"                    */
    iso_status (*draw)(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *rows);
} kinds[] = {
    {"section", "Poincaré section", {"orbit", "l", "x"}, true, draw_section},
    {"chaos", "Chaos on the section", {"l", "x", "verdict"}, true, iso_plot_exponents},
    {"periodic", "Periodic orbits", {"orbit", "l", "x", "stability"}, true, draw_orbits},
};

static const struct kind *find_kind(const char *name)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(kinds[i].name, name) == 0) return &kinds[i];
    return NULL;
}

bool iso_plot_has_kind(const char *name)
{
    for (int i = 0; iso_picture_kind(i); i++)
        if (strcmp(iso_picture_kind(i), name) == 0) return true;
    return find_kind(name) != NULL;
}

static iso_status check(iso_context *ctx, const iso_record *r, const struct kind *kind)
{
    for (size_t i = 0; kind->columns[i]; i++)
        if (iso_record_find(r, kind->columns[i]) < 0)
            return iso_context_fail(ctx, ISO_BAD_INPUT, "", "no picture: the table has no column '%s'",
                                    kind->columns[i]);
    if (iso_record_rows(r) == 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "", "no picture: the table has no rows");
    if (!kind->axis || iso_plot_axis_of(r) >= 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, "",
                            "no picture: the table does not say its axis, in a line '# axis: 3'");
}

iso_status iso_plot_table(iso_context *ctx, const iso_plot_page *page, const iso_record *r)
{
    char title[ISO_PLOT_HEADING];
    iso_params p;
    const struct kind *kind = find_kind(iso_record_kind(r));
    if (!kind) return plot_tables(ctx, page, (const iso_record *[]){r, NULL}, NULL);
    ISO_TRY(check(ctx, r, kind));
    ISO_TRY(iso_record_params(ctx, r, &p));
    const char *own = iso_record_get(r, "title"), *wish = iso_plot_section_wish(page);
    if (wish && kind->draw != draw_section)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, wish, "--%s is for sections, and this is a table '%s'", wish,
                                kind->name);
    return kind->draw(ctx, page, own ? own : iso_plot_heading(title, kind->shows, &p), r);
}
