/* cost.c - a work-precision diagram: a panel for each backend, a line for each method.
 *
 * Tables: points (panel, from 1; series, from 1; named: the number of the method's name, 0: one of the others; error,
 * seconds), panels (name), methods (name, those that have one) and closed (error, seconds: the closed solution; no row
 * if there is none). A measured row is in one series. An error of 0 is drawn as 1e-17.
 * Lines: series, their number; nameless: whether some have no name; uncertainty: smaller errors are not known.
 */
#include <math.h>
#include <stdlib.h>

#include "picture/picture_impl.h"

enum { NAMES = 10, NAMED = 6 }; /* methods that have a name, in all, and of each backend */
#define FLOOR 1e-17

typedef struct tables {
    const iso_record *r;
    iso_record *points, *panels, *methods, *closed;
    int series;
    bool others;
} tables;

/* Error and time of a row; false: it was not measured. */
static bool read_row(const iso_record *r, size_t row, double at[2])
{
    const double error = iso_picture_number(r, row, "error");
    at[0] = fmax(error, FLOOR), at[1] = iso_picture_number(r, row, "total");
    return isfinite(error) && isfinite(at[1]) && at[1] > 0;
}

static iso_status add_name(iso_context *ctx, iso_record *names, const char *name)
{
    double word;
    ISO_TRY(iso_record_intern(ctx, names, name, &word));
    return iso_record_add(ctx, names, 1, &word);
}

/* A backend without a measured row has no panel. The first methods of a backend, and one that is named already, have a
 * name. */
static iso_status add_panel(iso_context *ctx, tables *t, const char *backend)
{
    const iso_record *r = t->r;
    int in_panel = 0;
    double at[2];
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double method = iso_picture_number(r, i, "method");
        const char *name = iso_record_word(r, method);
        bool begins = read_row(r, i, at) && iso_picture_is(r, i, "backend", backend);
        for (size_t j = 0; begins && j < i; j++)
            begins = !read_row(r, j, at) || !iso_picture_is(r, j, "backend", backend) ||
                     iso_picture_number(r, j, "method") != method;
        if (!begins) continue;
        if (in_panel++ == 0) ISO_TRY(add_name(ctx, t->panels, backend));
        const int names = (int)iso_record_rows(t->methods);
        int named = 1;
        while (named <= names && !iso_picture_is(t->methods, (size_t)named - 1, "name", name)) named++;
        if (named > names && (in_panel > NAMED || names == NAMES)) named = 0, t->others = true;
        if (named > names) ISO_TRY(add_name(ctx, t->methods, name));
        double row[5] = {(double)iso_record_rows(t->panels), ++t->series, named}; /* of the points from here on */
        for (size_t j = i; j < iso_record_rows(r); j++)
            if (read_row(r, j, row + 3) && iso_picture_is(r, j, "backend", backend) &&
                iso_picture_number(r, j, "method") == method)
                ISO_TRY(iso_record_add(ctx, t->points, 1, row));
    }
    return ISO_OK;
}

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const char *uncertainty = iso_record_get(q->table[0], "uncertainty");
    tables t = {.r = q->table[0]};
    double at[2];
    ISO_TRY(iso_picture_add(ctx, picture, "points", "panel series named error seconds", &t.points));
    ISO_TRY(iso_picture_add(ctx, picture, "panels", "name'", &t.panels));
    ISO_TRY(iso_picture_add(ctx, picture, "methods", "name'", &t.methods));
    ISO_TRY(iso_picture_add(ctx, picture, "closed", "error seconds", &t.closed));
    ISO_TRY(add_panel(ctx, &t, "ball"));
    ISO_TRY(add_panel(ctx, &t, "point"));
    for (size_t i = 0; i < iso_record_rows(t.r) && iso_record_rows(t.closed) == 0; i++)
        if (read_row(t.r, i, at) && iso_picture_is(t.r, i, "method", ""))
            ISO_TRY(iso_record_add(ctx, t.closed, 1, at));
    if (t.series == 0 && iso_record_rows(t.closed) == 0)
        return ISO_FAIL_INPUT(ctx, "", "there are no measurements to draw");
    if (t.series == 0) ISO_TRY(add_name(ctx, t.panels, ""));
    return iso_picture_set(ctx, picture, "series nameless uncertainty",
                           (double[]){t.series, t.others, uncertainty ? strtod(uncertainty, NULL) : 0});
}

const iso_picture_maker iso_picture_cost = {
    "cost", "Time and error of the methods", {"backend", "method", "error", "total"}, .make = make};
