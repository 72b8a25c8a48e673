/* momentum.c - the image of the momentum map: kinds of motion over the energy h and the integral F, and the orbit.
 *
 * Tables: parts (part, h, low, high of F), kinds (part, name; h, over: where the name stands in the picture of F/h;
 * NaN: it has no room), lines (line, h, f) and rotations (line, name). Lines: f, the name of F; at_h, at_f: the
 * orbit; low, high: F/h that is drawn.
 */
#include <math.h>

#include "instrument/frequencies/momentum.h"
#include "picture/picture_impl.h"

enum { PARTS = ISO_MOMENTUM_PARTS };

/* The columns of the bounds: h, low and high of each part, and F of each line. */
static int first_of(int part)
{
    return 1 + 2 * part;
}

/* Largest and least F/h, with room. */
static void find_range(const iso_record *bounds, double range[2])
{
    double low = INFINITY, high = -INFINITY;
    const size_t rows = iso_record_rows(bounds);
    for (size_t i = rows / 4; i < rows; i++) /* near h = 0, off H = 0, it grows without bound */
        for (int c = 1; c <= 2 * PARTS; c++) {
            const double *row = iso_record_const_row(bounds, i), x = row[c] / row[0];
            if (!isfinite(x)) continue;
            low = fmin(low, x);
            high = fmax(high, x);
        }
    const double room = high > low ? 0.06 * (high - low) : 0.1 * fabs(high);
    range[0] = low - room;
    range[1] = high + room;
}

/* h and F/h where a part is thickest, if it is thicker than `room`; else NaN. */
static void find_place(const iso_record *bounds, int part, double room, double place[2])
{
    const int low = first_of(part), high = low + 1;
    const size_t rows = iso_record_rows(bounds);
    const double *best = iso_record_const_row(bounds, rows * 2 / 5);
    double thickest = isfinite(best[low]) ? 1.001 * (best[high] - best[low]) / best[0] : 0;
    for (size_t i = rows / 4; i < rows * 3 / 4; i++) {
        const double *row = iso_record_const_row(bounds, i), here = (row[high] - row[low]) / row[0];
        if (here > thickest) thickest = here, best = row;
    }
    place[0] = thickest > room ? best[0] : (double)NAN;
    place[1] = thickest > room ? (best[low] + best[high]) / 2 / best[0] : (double)NAN;
}

/* The rows of a part, or of a line: first is last, and the table has three columns. Says whether there is one. */
static iso_status add_rows(iso_context *ctx, const iso_record *bounds, int number, int first, int last,
                           iso_record *table, bool *any)
{
    *any = false;
    for (size_t i = 0; i < iso_record_rows(bounds); i++) {
        const double *row = iso_record_const_row(bounds, i);
        if (!isfinite(row[first]) || !isfinite(row[last])) continue;
        *any = true;
        ISO_TRY(iso_record_add(ctx, table, 1, (double[]){number, row[0], row[first], row[last]}));
    }
    return ISO_OK;
}

static iso_status fill(iso_context *ctx, const iso_momentum *m, const iso_record *bounds, iso_picture *picture)
{
    iso_record *parts = picture->table[0], *kinds = picture->table[1], *lines = picture->table[2],
               *rotations = picture->table[3];
    double range[2];
    char name[ISO_MOMENTUM_WORDS];
    bool any;
    find_range(bounds, range);
    for (int i = 0; i < PARTS; i++) {
        double row[4] = {i + 1, 0, 0, 0};
        ISO_TRY(add_rows(ctx, bounds, i + 1, first_of(i), first_of(i) + 1, parts, &any));
        find_place(bounds, i, 0.12 * (range[1] - range[0]), row + 2);
        iso_momentum_name_part(m, (iso_momentum_part)i, name);
        ISO_TRY(iso_record_intern(ctx, kinds, name, &row[1]));
        if (any) ISO_TRY(iso_record_add(ctx, kinds, 1, row));
    }
    for (int i = 0; i < ISO_MOMENTUM_LINES; i++) {
        double row[2] = {i + 1, 0};
        ISO_TRY(add_rows(ctx, bounds, i + 1, 1 + 2 * PARTS + i, 1 + 2 * PARTS + i, lines, &any));
        iso_momentum_name_line(m, i, name);
        ISO_TRY(iso_record_intern(ctx, rotations, name, &row[1]));
        if (any) ISO_TRY(iso_record_add(ctx, rotations, 1, row));
    }
    ISO_TRY(iso_picture_count(ctx, picture, "low", range[0]));
    return iso_picture_count(ctx, picture, "high", range[1]);
}

iso_status iso_picture_momentum(iso_context *ctx, const iso_momentum *m, const double at[2], iso_picture *picture)
{
    static const char *const names[] = {"part", "h", "low", "high"}, *const line[] = {"line", "h", "f"},
                             *const kind[] = {"part", "name", "h", "over"};
    iso_record *table, *bounds;
    picture->layout = "momentum";
    ISO_TRY(iso_picture_add(ctx, picture, "parts", 4, names, &table));
    ISO_TRY(iso_picture_add(ctx, picture, "kinds", 4, kind, &table));
    iso_record_set_words(table, 1, true);
    ISO_TRY(iso_picture_add(ctx, picture, "lines", 3, line, &table));
    ISO_TRY(iso_picture_add(ctx, picture, "rotations", 2, (const char *const[]){"line", "name"}, &table));
    iso_record_set_words(table, 1, true);
    ISO_TRY(iso_picture_say(ctx, picture, "f", m->k == 1 ? "plane" : "shell"));
    ISO_TRY(iso_picture_count(ctx, picture, "at_h", at[0]));
    ISO_TRY(iso_picture_count(ctx, picture, "at_f", at[1]));
    ISO_TRY(iso_momentum_bounds(ctx, m, at[0], &bounds));
    const iso_status status = fill(ctx, m, bounds, picture);
    iso_record_free(bounds);
    return status;
}
