/* cost.c - a work-precision diagram: a panel for each backend, a line for each method.
 *
 * Tables: points (panel, from 1; series, from 1; named: the number of the method's name, 0: one of the others; error,
 * seconds), panels (name), methods (name, those that have one) and closed (error, seconds: the closed solution; no row
 * if there is none). A measured row is in one series. An error of 0 is drawn as 1e-17.
 * Lines: series, their number; nameless: whether some have no name; uncertainty: smaller errors are not known.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "picture/picture_impl.h"

enum { NAMES = 10, NAMED = 6 }; /* methods that have a name, in all, and of each backend */
#define FLOOR 1e-17

typedef struct tables {
    const iso_record *r;
    iso_record *points, *panels, *methods, *closed;
    int series;
    bool others;
} tables;

static const char *method_of(const iso_record *r, size_t row)
{
    return iso_record_word(r, iso_picture_number(r, row, "method"));
}

static bool is_drawn(const iso_record *r, size_t row)
{
    const double seconds = iso_picture_number(r, row, "total");
    return isfinite(iso_picture_number(r, row, "error")) && isfinite(seconds) && seconds > 0;
}

static iso_status add_name(iso_context *ctx, iso_record *names, const char *name)
{
    double word;
    ISO_TRY(iso_record_intern(ctx, names, name, &word));
    return iso_record_add(ctx, names, 1, &word);
}

/* The number of a method's name. The first methods of a backend, and one that is named already, have a name. */
static iso_status find_name(iso_context *ctx, tables *t, const char *name, int in_panel, int *number)
{
    const int count = (int)iso_record_rows(t->methods);
    for (int i = 0; i < count; i++)
        if (iso_picture_is(t->methods, (size_t)i, "name", name)) return *number = i + 1, ISO_OK;
    *number = in_panel > NAMED || count == NAMES ? 0 : count + 1;
    t->others = t->others || *number == 0;
    return *number ? add_name(ctx, t->methods, name) : ISO_OK;
}

/* The rows of one backend and method from row `first` on. */
static iso_status add_series(iso_context *ctx, tables *t, size_t first, const char *backend, int named)
{
    const double panel = (double)iso_record_rows(t->panels);
    for (size_t i = first; i < iso_record_rows(t->r); i++)
        if (is_drawn(t->r, i) && iso_picture_is(t->r, i, "backend", backend) &&
            strcmp(method_of(t->r, i), method_of(t->r, first)) == 0)
            ISO_TRY(
                iso_record_add(ctx, t->points, 1,
                               (double[]){panel, t->series, named, fmax(iso_picture_number(t->r, i, "error"), FLOOR),
                                          iso_picture_number(t->r, i, "total")}));
    return ISO_OK;
}

/* A backend without a measured row has no panel. */
static iso_status add_panel(iso_context *ctx, tables *t, const char *backend)
{
    int in_panel = 0, named;
    for (size_t i = 0; i < iso_record_rows(t->r); i++) {
        bool begins = is_drawn(t->r, i) && iso_picture_is(t->r, i, "backend", backend);
        for (size_t j = 0; begins && j < i; j++)
            begins = !is_drawn(t->r, j) || !iso_picture_is(t->r, j, "backend", backend) ||
                     strcmp(method_of(t->r, j), method_of(t->r, i)) != 0;
        if (!begins) continue;
        if (in_panel++ == 0) ISO_TRY(add_name(ctx, t->panels, backend));
        t->series++;
        ISO_TRY(find_name(ctx, t, method_of(t->r, i), in_panel, &named));
        ISO_TRY(add_series(ctx, t, i, backend, named));
    }
    return ISO_OK;
}

static iso_status add_names(iso_context *ctx, iso_picture *picture, const char *table, iso_record **names)
{
    ISO_TRY(iso_picture_add(ctx, picture, table, 1, (const char *const[]){"name"}, names));
    iso_record_set_words(*names, 0, true);
    return ISO_OK;
}

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    static const char *const names[] = {"panel", "series", "named", "error", "seconds"};
    const char *uncertainty = iso_record_get(q->table[0], "uncertainty");
    tables t = {.r = q->table[0]};
    ISO_TRY(iso_picture_add(ctx, picture, "points", 5, names, &t.points));
    ISO_TRY(add_names(ctx, picture, "panels", &t.panels));
    ISO_TRY(add_names(ctx, picture, "methods", &t.methods));
    ISO_TRY(iso_picture_add(ctx, picture, "closed", 2, names + 3, &t.closed));
    ISO_TRY(add_panel(ctx, &t, "ball"));
    ISO_TRY(add_panel(ctx, &t, "point"));
    for (size_t i = 0; i < iso_record_rows(t.r) && iso_record_rows(t.closed) == 0; i++)
        if (is_drawn(t.r, i) && !*method_of(t.r, i))
            ISO_TRY(iso_record_add(
                ctx, t.closed, 1,
                (double[]){fmax(iso_picture_number(t.r, i, "error"), FLOOR), iso_picture_number(t.r, i, "total")}));
    if (t.series == 0 && iso_record_rows(t.closed) == 0)
        return ISO_FAIL_INPUT(ctx, "", "there are no measurements to draw");
    if (t.series == 0) ISO_TRY(add_name(ctx, t.panels, ""));
    ISO_TRY(iso_picture_count(ctx, picture, "series", t.series));
    ISO_TRY(iso_picture_count(ctx, picture, "nameless", t.others));
    return iso_picture_count(ctx, picture, "uncertainty", uncertainty ? strtod(uncertainty, NULL) : 0);
}

const iso_picture_maker iso_picture_cost = {
    "cost", "Time and error of the methods", {"backend", "method", "error", "total"}, .make = make};
