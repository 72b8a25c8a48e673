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

/* --- numbers ---------------------------------------------------------------------------------------------------- */

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
        const double x = iso_record_const_row(c->rows, i)[c->column];
        if (x < iso_record_const_row(c->rows, least)[c->column]) least = i;
        if (x > iso_record_const_row(c->rows, largest)[c->column]) largest = i;
    }
    if (c->thinning == ISO_PICTURE_LARGEST) least = largest;
    const size_t first = least < largest ? least : largest, last = least < largest ? largest : least;
    ISO_TRY(add_value(ctx, values, c, number, iso_record_const_row(c->rows, first)));
    return last != first ? add_value(ctx, values, c, number, iso_record_const_row(c->rows, last)) : ISO_OK;
}

/* Where a column is over another that is no clock, thinning cannot keep the ends of both: rows are left out evenly. */
static iso_status add_values(iso_context *ctx, iso_record *values, const iso_picture_curve *c, double number)
{
    const size_t rows = iso_record_rows(c->rows),
                 slots = c->thinning == ISO_PICTURE_LARGEST ? SLOTS_OF_LARGEST : SLOTS;
    if (c->thinning == ISO_PICTURE_EVENLY || rows <= 2 * slots) {
        for (size_t i = 0; i < iso_picture_drawn(c->rows); i++)
            ISO_TRY(add_value(ctx, values, c, number, iso_picture_row(c->rows, i)));
        return ISO_OK;
    }
    for (size_t i = 0; i < slots; i++)
        ISO_TRY(add_slot(ctx, values, c, number, i * rows / slots, (i + 1) * rows / slots));
    return ISO_OK;
}

static void find_range(const iso_record *r, int column, double range[2])
{
    range[0] = INFINITY, range[1] = -INFINITY;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        range[0] = fmin(range[0], iso_record_const_row(r, i)[column]);
        range[1] = fmax(range[1], iso_record_const_row(r, i)[column]);
    }
}

/* --- curves ----------------------------------------------------------------------------------------------------- */

iso_status iso_picture_add_curves(iso_context *ctx, iso_picture *picture)
{
    static const char *const names[] = {"chart", "over", "name", "right", "begin", "end", "low", "high"};
    iso_record *curves, *values;
    ISO_TRY(iso_picture_add(ctx, picture, "curves", 8, names, &curves));
    for (size_t c = 0; c < 3; c++) iso_record_set_words(curves, c, true);
    return iso_picture_add(ctx, picture, "values", 3, (const char *const[]){"curve", "x", "y"}, &values);
}

iso_status iso_picture_add_curve(iso_context *ctx, iso_picture *picture, const iso_picture_curve *c)
{
    iso_record *curves = iso_picture_table(picture, "curves"), *values = iso_picture_table(picture, "values");
    const char *over = iso_picture_symbol(iso_record_name(c->rows, (size_t)c->over));
    const char *name = c->name ? c->name : iso_picture_symbol(iso_record_name(c->rows, (size_t)c->column));
    double row[8] = {0, 0, 0, c->right};
    ISO_TRY(iso_record_intern(ctx, curves, c->chart, &row[0]));
    ISO_TRY(iso_record_intern(ctx, curves, over, &row[1]));
    ISO_TRY(iso_record_intern(ctx, curves, name, &row[2]));
    find_range(c->rows, c->over, &row[4]);
    find_range(c->rows, c->column, &row[6]);
    row[7] = fmin(row[7], c->top);
    ISO_TRY(iso_record_add(ctx, curves, 1, row));
    return add_values(ctx, values, c, (double)iso_record_rows(curves));
}

/* --- two columns ------------------------------------------------------------------------------------------------ */

/* Whether x and y are components of one vector: one unit is then equally long on both axes. */
static bool are_components(const char *x, const char *y)
{
    const size_t length = strlen(x);
    return length > 1 && strlen(y) == length && strncmp(x, y, length - 1) == 0 && x[0] != 'q' &&
           strchr("123", x[length - 1]) && strchr("123", y[length - 1]);
}

/* The rows that have both numbers. */
static iso_status copy_two(iso_context *ctx, const iso_record *r, char name[2][ISO_PICTURE_OPTION], iso_record **two)
{
    char suggested[ISO_SUGGEST_SIZE];
    const char *names[ISO_TRAJECTORY_COLUMNS];
    size_t count = 0;
    int column[2];
    for (; count < iso_record_columns(r) && count < ISO_TRAJECTORY_COLUMNS; count++)
        names[count] = iso_record_name(r, count);
    for (int i = 0; i < 2; i++) {
        column[i] = iso_record_find(r, name[i]);
        if (column[i] < 0)
            return ISO_FAIL_INPUT(ctx, "columns", "there is no column '%s'; %s", name[i],
                                  iso_suggest(suggested, name[i], count, names));
        if (iso_record_has_words(r, (size_t)column[i]))
            return ISO_FAIL_INPUT(ctx, "columns", "no picture: the column '%s' has words", name[i]);
    }
    ISO_TRY(iso_record_create(ctx, 2, (const char *const[]){name[0], name[1]}, two));
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        if (isfinite(row[column[0]]) && isfinite(row[column[1]]))
            ISO_TRY(iso_record_add(ctx, *two, 1, (double[]){row[column[0]], row[column[1]]}));
    }
    if (iso_record_rows(*two) > 0) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "columns", "no picture: no row has numbers of '%s' and of '%s'", name[0], name[1]);
}

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    char text[ISO_PICTURE_OPTION], name[2][ISO_PICTURE_OPTION] = {"", ""};
    iso_record *two = NULL;
    iso_picture_option(q, "columns", text);
    const size_t comma = strcspn(text, ",");
    if (text[comma] != ',' || strchr(text + comma + 1, ','))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "columns", "--columns %s: expected two columns X,Y", text);
    snprintf(name[0], sizeof name[0], "%.*s", (int)comma, text);
    snprintf(name[1], sizeof name[1], "%s", text + comma + 1);
    const bool equal = are_components(name[0], name[1]);
    ISO_TRY(iso_picture_add_curves(ctx, picture));
    iso_status status = strcmp(name[0], name[1]) == 0 ? iso_context_fail(ctx, ISO_BAD_ARGUMENT, "columns",
                                                                         "--columns %s: a column over itself", text)
                                                      : copy_two(ctx, q->table[0], name, &two);
    const iso_picture_curve curve = {
        "columns", NULL, two, 0, 1, false, equal ? ISO_PICTURE_EVENLY : ISO_PICTURE_EXTREMES, INFINITY};
    if (status == ISO_OK) status = iso_picture_add_curve(ctx, picture, &curve);
    if (status == ISO_OK) status = iso_picture_count(ctx, picture, "equal", equal);
    iso_record_free(two);
    return status;
}

const iso_picture_maker iso_picture_columns = {"columns", "", {NULL}, .options = " columns ", .make = make};
