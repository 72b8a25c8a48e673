/* plot_table.c - pictures of the tables that commands write (see plot.h). A kind of table is a row of `kinds`. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "orbit/description.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"
#include "plot/section_picture.h"

double iso_plot_number(const iso_record *r, size_t row, const char *name)
{
    const int column = iso_record_find(r, name);
    return column < 0 ? (double)NAN : iso_record_const_row(r, row)[column];
}

bool iso_plot_is(const iso_record *r, size_t row, const char *name, const char *word)
{
    return strcmp(iso_record_word(r, iso_plot_number(r, row, name)), word) == 0;
}

int iso_plot_axis_of(const iso_record *r)
{
    const char *axis = iso_record_get(r, "axis");
    return axis && axis[0] >= '1' && axis[0] <= '3' ? axis[0] - '1' : -1;
}

static iso_status draw_section(iso_context *ctx, const char *path, const char *title, const iso_record *r)
{
    (void)title;
    iso_params params;
    section_picture *p = NULL;
    iso_status status = iso_record_params(ctx, r, &params);
    if (status == ISO_OK) status = section_picture_create(ctx, &params, &p);
    if (status == ISO_OK) section_picture_begin(p, r);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(r); i++)
        status = section_picture_row(ctx, p, iso_record_const_row(r, i));
    if (status == ISO_OK) status = section_picture_draw(ctx, p, path);
    section_picture_free(p);
    return status;
}

/* The images of a crossing by the reversors and by half turns. */
static iso_status put_images(iso_context *ctx, const iso_record *r, size_t i, iso_record *images)
{
    const double pi = acos(-1), l = iso_plot_number(r, i, "l"), x = iso_plot_number(r, i, "x");
    const bool grey = iso_plot_is(r, i, "stability", "unstable") || iso_plot_is(r, i, "stability", "inverse");
    iso_status status = ISO_OK;
    for (int n = 0; n < 8 && status == ISO_OK; n++) {
        const double sign = n & 1 ? -1 : 1;
        status = iso_record_add(ctx, images, 1,
                                (double[]){iso_plot_number(r, i, "orbit") - 1,
                                           remainder(sign * l + (n & 2 ? pi : 0), 2 * pi), (n & 4 ? -sign : sign) * x,
                                           grey});
    }
    return status;
}

static iso_status draw_orbits(iso_context *ctx, const char *path, const char *title, const iso_record *r)
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
    const iso_plot_section plot = {
        .title = words, .params = &params, .axis = iso_plot_axis_of(r), .rows = images, .grey_means = "unstable"};
    if (status == ISO_OK) status = iso_plot_sections(ctx, path, &plot);
    iso_record_free(images);
    return status;
}

static iso_status draw_splitting(iso_context *ctx, const char *path, const char *title, const iso_record *r)
{
    return iso_plot_splitting(ctx, path, title, r, NULL, NAN, 0);
}

/* --- the kinds -------------------------------------------------------------------------------------------------- */

static const struct kind {
    const char *name;
    const char *columns[5]; /* that the picture needs; NULL ends them */
    bool axis;              /* and the line "axis"                    */
    iso_status (*draw)(iso_context *ctx, const char *path, const char *title, const iso_record *rows);
} kinds[] = {
    {"section", {"orbit", "l", "x"}, true, draw_section},
    {"chaos", {"l", "x", "verdict"}, true, iso_plot_exponents},
    {"periodic", {"orbit", "l", "x", "stability"}, true, draw_orbits},
    {"periodic follow", {"branch", "u", "trace", "event"}, false, iso_plot_branches},
    {"periodic chart", {"kind", "k", "least", "greatest"}, false, iso_plot_stability},
    {"cost", {"backend", "method", "error", "total"}, false, iso_plot_cost},
    {"splitting", {"k", "level", "m", "error"}, false, draw_splitting},
};

static const struct kind *find_kind(const char *name)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(kinds[i].name, name) == 0) return &kinds[i];
    return NULL;
}

bool iso_plot_has_kind(const char *name)
{
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

iso_status iso_plot_table(iso_context *ctx, const char *path, const char *name, const iso_record *r)
{
    char title[160];
    iso_params p;
    const struct kind *kind = find_kind(iso_record_kind(r));
    iso_status status = check(ctx, r, kind);
    if (status == ISO_OK) status = iso_record_params(ctx, r, &p);
    if (status != ISO_OK) return status;
    snprintf(title, sizeof title, "%.60s: k = %.6g, J = %.6g %.6g %.6g", name, p.k, p.J[0], p.J[1], p.J[2]);
    const char *own = iso_record_get(r, "title");
    return kind->draw(ctx, path, own ? own : title, r);
}
