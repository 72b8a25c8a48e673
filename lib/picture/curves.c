/* curves.c - curves of charts: any column over another.
 *
 * Tables: curves (chart, over, name, right, begin, end, low, high) has a row for each curve: its chart, the symbols of
 * what it is over and of itself, whether its axis is on the right, and its range, along and up. values (curve, x, y)
 * has the numbers of the curves, counted from 1. Of many rows not all are there: over a clock the least and the
 * largest number of each of 1000 slots, or the largest of each of 450, so that thinning hides none; else 5000 rows.
 *
 * The picture "columns" is one curve; line equal: 1: one unit is equally long on both axes.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/names_impl.h"
#include "orbit/orbit_impl.h"
#include "picture/picture_impl.h"

enum { SLOTS = 1000, SLOTS_OF_LARGEST = 450 };

static iso_status add_value(iso_context *ctx, iso_record *values, const iso_picture_curve *c, double number,
                            const double *row)
{
    return iso_record_add(ctx, values, 1, (double[]){number, row[c->over], row[c->column]});
}

/* The least and the largest number of one slot, in their order; or the largest alone. */
static iso_status add_slot(iso_context *ctx, iso_record *values, const iso_picture_curve *c, double number,
                           size_t from, size_t to)
{
    size_t least = from, largest = from;
    for (size_t i = from; i < to; i++) {
        const double x = iso_picture_at(c->rows, i, c->column);
        if (x < iso_picture_at(c->rows, least, c->column)) least = i;
        if (x > iso_picture_at(c->rows, largest, c->column)) largest = i;
    }
    if (c->thinning == ISO_PICTURE_LARGEST) least = largest;
    const size_t first = least < largest ? least : largest, last = least < largest ? largest : least;
    ISO_TRY(add_value(ctx, values, c, number, iso_record_const_row(c->rows, first)));
    return last != first ? add_value(ctx, values, c, number, iso_record_const_row(c->rows, last)) : ISO_OK;
}

iso_status iso_picture_add_curves(iso_context *ctx, iso_picture *picture)
{
    iso_record *table;
    ISO_TRY(iso_picture_add(ctx, picture, "curves", "chart' over' name' right begin end low high", &table));
    return iso_picture_add(ctx, picture, "values", "curve x y", &table);
}

/* Where a column is over another that is no clock, thinning cannot keep the ends of both: rows are left out evenly. */
iso_status iso_picture_add_curve(iso_context *ctx, iso_picture *picture, const iso_picture_curve *c)
{
    iso_record *curves = iso_picture_table(picture, "curves"), *values = iso_picture_table(picture, "values");
    const size_t rows = iso_record_rows(c->rows),
                 slots = c->thinning == ISO_PICTURE_LARGEST ? SLOTS_OF_LARGEST : SLOTS;
    const char *over = iso_picture_symbol(iso_record_name(c->rows, (size_t)c->over));
    const char *name = c->name ? c->name : iso_picture_symbol(iso_record_name(c->rows, (size_t)c->column));
    double row[8] = {0, 0, 0, c->right};
    ISO_TRY(iso_record_intern(ctx, curves, c->chart, &row[0]));
    ISO_TRY(iso_record_intern(ctx, curves, over, &row[1]));
    ISO_TRY(iso_record_intern(ctx, curves, name, &row[2]));
    iso_picture_range(c->rows, c->over, &row[4]);
    iso_picture_range(c->rows, c->column, &row[6]);
    row[7] = fmin(row[7], c->top);
    ISO_TRY(iso_record_add(ctx, curves, 1, row));
    const double number = (double)iso_record_rows(curves);
    const bool all = c->thinning == ISO_PICTURE_EVENLY || rows <= 2 * slots;
    for (size_t i = 0; i < (all ? iso_picture_drawn(c->rows) : slots); i++)
        ISO_TRY(all ? add_value(ctx, values, c, number, iso_picture_row(c->rows, i))
                    : add_slot(ctx, values, c, number, i * rows / slots, (i + 1) * rows / slots));
    return ISO_OK;
}

iso_status iso_picture_add_chart(iso_context *ctx, iso_picture *picture, const char *chart, const iso_record *r,
                                 const char *const names[], iso_picture_thinning thinning)
{
    for (int c = 1; c < (int)iso_record_columns(r); c++)
        ISO_TRY(iso_picture_add_curve(
            ctx, picture,
            &(iso_picture_curve){chart, names ? names[c - 1] : NULL, r, 0, c, false, thinning, INFINITY}));
    return ISO_OK;
}

/* --- two columns ------------------------------------------------------------------------------------------------ */

/* The column of a name, which has numbers. */
static iso_status find_column(iso_context *ctx, const iso_record *r, const char *name, int *column)
{
    char suggested[ISO_SUGGEST_SIZE];
    const char *names[ISO_TRAJECTORY_COLUMNS];
    size_t count = 0;
    for (; count < iso_record_columns(r) && count < ISO_TRAJECTORY_COLUMNS; count++)
        names[count] = iso_record_name(r, count);
    *column = iso_record_find(r, name);
    if (*column < 0)
        return ISO_FAIL_INPUT(ctx, "columns", "there is no column '%s'; %s", name,
                              iso_suggest(suggested, name, count, names));
    if (iso_record_has_words(r, (size_t)*column))
        return ISO_FAIL_INPUT(ctx, "columns", "no picture: the column '%s' has words", name);
    return ISO_OK;
}

/* The rows that have both numbers. */
static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const iso_record *r = q->table[0];
    char text[ISO_PICTURE_OPTION], x[ISO_PICTURE_OPTION];
    iso_record **two = iso_picture_aside(picture);
    int column[2];
    iso_picture_option(q, "columns", text);
    snprintf(x, sizeof x, "%.*s", (int)strcspn(text, ","), text);
    const char *y = text + strlen(x) + 1;
    if (!strchr(text, ',') || strchr(y, ','))
        return ISO_FAIL_ARGUMENT(ctx, "columns", "--columns %s: expected two columns X,Y", text);
    if (strcmp(x, y) == 0) return ISO_FAIL_ARGUMENT(ctx, "columns", "--columns %s: a column over itself", text);
    ISO_TRY(find_column(ctx, r, x, &column[0]));
    ISO_TRY(find_column(ctx, r, y, &column[1]));
    ISO_TRY(iso_record_create(ctx, 2, (const char *const[]){x, y}, two));
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double row[] = {iso_picture_at(r, i, column[0]), iso_picture_at(r, i, column[1])};
        if (isfinite(row[0]) && isfinite(row[1])) ISO_TRY(iso_record_add(ctx, *two, 1, row));
    }
    if (iso_record_rows(*two) == 0)
        return ISO_FAIL_INPUT(ctx, "columns", "no picture: no row has numbers of '%s' and of '%s'", x, y);
    const size_t length = strlen(x); /* components of one vector: one unit is equally long on both axes */
    const bool equal = length > 1 && strlen(y) == length && strncmp(x, y, length - 1) == 0 && x[0] != 'q' &&
                       strchr("123", x[length - 1]) && strchr("123", y[length - 1]);
    ISO_TRY(iso_picture_add_curves(ctx, picture));
    ISO_TRY(iso_picture_add_chart(ctx, picture, "columns", *two, NULL,
                                  equal ? ISO_PICTURE_EVENLY : ISO_PICTURE_EXTREMES));
    return iso_picture_set(ctx, picture, "equal", (double[]){equal});
}

const iso_picture_maker iso_picture_columns = {"columns", "", {NULL}, .options = " columns ", .make = make};
