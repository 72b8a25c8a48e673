/* periodic.c - what is found of families of periodic orbits: branches, and charts of stability.
 *
 * The kind "periodic follow", layout "branch", a bifurcation diagram: trace and place of followed periodic orbits over
 * what varies. Tables: points (branch, at, trace, place: 2 u/pi on the symmetry line) and events (the same, and event: a
 * word), which are those of the table but ends of branches. Lines: branches, how many; over, what varies.
 *
 * The kind "periodic chart", layout "chart": where rotations about the axes of the least and of the greatest moment are
 * stable. Tables: cells (side: 1: of the least moment, 2: of the greatest; class; left, right, bottom, top) and borders
 * (side, k, up), where a trace is 2 or -2. The cells of a side cover the grid; neighbours of one class are one cell.
 * Classes: 0: stable; -1: unstable, the trace T < -2; 1: unstable, T > 2; 2: there is no such rotation.
 * Lines: up, what varies beside k; none: whether a cell has class 2.
 */
#include <math.h>

#include "picture/picture_impl.h"

enum { OVER = 3 }; /* the column of what varies */

static iso_status make_branch(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const iso_record *r = q->table[0];
    iso_record *points, *events;
    double most = 0;
    picture->layout = "branch";
    ISO_TRY(iso_picture_add(ctx, picture, "points", "branch at trace place", &points));
    ISO_TRY(iso_picture_add(ctx, picture, "events", "branch at trace place event'", &events));
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const bool end = iso_picture_is(r, i, "event", "end"), point = iso_picture_is(r, i, "event", "");
        double row[] = {iso_picture_number(r, i, "branch"), iso_picture_at(r, i, OVER),
                        iso_picture_number(r, i, "trace"), iso_picture_number(r, i, "u") / acos(0), 0};
        if (end) continue;
        if (!(row[0] >= 1 && row[0] <= (double)iso_record_rows(r) && row[0] == floor(row[0])))
            return ISO_FAIL_INPUT(ctx, "branch", "no picture: row %zu has no number of a branch", i + 1);
        most = fmax(most, row[0]);
        if (!point)
            ISO_TRY(iso_record_intern(ctx, events, iso_record_word(r, iso_picture_number(r, i, "event")), &row[4]));
        ISO_TRY(iso_record_add(ctx, point ? points : events, 1, row)); /* an event repeats a point */
    }
    ISO_TRY(iso_picture_set(ctx, picture, "branches", &most));
    return iso_picture_line(ctx, picture, "over", "%s", iso_picture_symbol(iso_record_name(r, OVER)));
}

const iso_picture_maker iso_picture_branch = {
    "periodic follow", "Periodic orbits followed", {"branch", "u", "trace", "event"}, .make = make_branch};

/* --- charts ------------------------------------------------------------------------------------------------------ */

enum { K = 1, UP = 2 }; /* columns */

/* The trace is -2 or 2 up to rounding with equal moments. */
static int class_of(double trace)
{
    const double edge = 2 + 1e-9;
    return isnan(trace) ? 2 : trace <= -edge ? -1 : trace > edge ? 1 : 0;
}

/* The least step of a column from row to row of the grid. */
static double step_of(const iso_record *r, int column)
{
    double step = INFINITY;
    for (size_t i = 1; i < iso_record_rows(r); i++) {
        const double d = fabs(iso_picture_at(r, i, column) - iso_picture_at(r, i - 1, column));
        if (iso_picture_is(r, i, "kind", "grid") && iso_picture_is(r, i - 1, "kind", "grid") && d > 0)
            step = fmin(step, d);
    }
    return isfinite(step) ? step : 1;
}

/* From one grid point to the last of its class that follows it with the same k, or with the same height. */
static iso_status add_cells(iso_context *ctx, const iso_record *r, int side, int trace, iso_record *cells)
{
    const double half[] = {step_of(r, K) / 2, step_of(r, UP) / 2};
    const size_t rows = iso_record_rows(r);
    for (size_t i = 0, next; i < rows; i = next) {
        const double *first = iso_record_const_row(r, i), *last = first;
        next = i + 1;
        if (!iso_picture_is(r, i, "kind", "grid")) continue;
        for (; next < rows && iso_picture_is(r, next, "kind", "grid"); last = iso_record_const_row(r, next++)) {
            const double *row = iso_record_const_row(r, next);
            const bool along = last == first         ? row[K] == first[K] || row[UP] == first[UP]
                               : last[K] == first[K] ? row[K] == first[K]
                                                     : row[UP] == first[UP];
            if (!along || class_of(row[trace]) != class_of(first[trace])) break;
        }
        ISO_TRY(iso_record_add(ctx, cells, 1,
                               (double[]){side, class_of(first[trace]), fmin(first[K], last[K]) - half[0],
                                          fmax(first[K], last[K]) + half[0], fmin(first[UP], last[UP]) - half[1],
                                          fmax(first[UP], last[UP]) + half[1]}));
    }
    return ISO_OK;
}

static iso_status make_chart(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    static const char *const trace[] = {"least", "greatest"};
    const iso_record *r = q->table[0];
    iso_record *cells, *borders;
    bool none = false;
    picture->layout = "chart";
    if (iso_record_find(r, "k") != K || iso_record_columns(r) <= UP)
        return ISO_FAIL_INPUT(ctx, "k", "no picture: k is not the second column, what varies not the third");
    ISO_TRY(iso_picture_add(ctx, picture, "cells", "side class left right bottom top", &cells));
    ISO_TRY(iso_picture_add(ctx, picture, "borders", "side k up", &borders));
    for (int side = 1; side <= 2; side++) {
        const int column = iso_record_find(r, trace[side - 1]);
        ISO_TRY(add_cells(ctx, r, side, column, cells));
        for (size_t i = 0; i < iso_record_rows(r); i++) {
            const double *row = iso_record_const_row(r, i);
            const bool grid = iso_picture_is(r, i, "kind", "grid");
            none = none || (grid && isnan(row[column]));
            if (!grid && isfinite(row[column]))
                ISO_TRY(iso_record_add(ctx, borders, 1, (double[]){side, row[K], row[UP]}));
        }
    }
    ISO_TRY(iso_picture_set(ctx, picture, "none", (double[]){none}));
    return iso_picture_line(ctx, picture, "up", "%s", iso_picture_symbol(iso_record_name(r, UP)));
}

const iso_picture_maker iso_picture_chart = {
    "periodic chart", "Where rotations are stable", {"kind", "k", "least", "greatest"}, .make = make_chart};
