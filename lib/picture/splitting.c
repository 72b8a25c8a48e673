/* splitting.c - |m| over k or the level, and both curves of one row on the section.
 *
 * Tables: rows (over, size, low, high; sign: 1: m > 0, -1: m < 0, 0: |m| is below `size`) and curve (u, x): W^u(O);
 * its mirror image u -> pi - u is W^s(O'). Given with a table "separatrix" (u, x; lines name, number, axis) the curve
 * is drawn, else the rows alone. A row whose m is 0 by an argument, or has no error, is left out.
 */
#include <math.h>
#include <string.h>

#include "picture/picture_impl.h"

#define KNOWN 10 /* errors from which on m has a sign */

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const iso_record *r = q->table[0], *curve = iso_picture_given(q, "separatrix");
    const bool several = iso_record_rows(r) > 1, sizes = several || !curve;
    const char *over = several && iso_picture_number(r, 0, "k") == iso_picture_number(r, 1, "k") ? "level" : "k";
    iso_record *rows, *copy;
    ISO_TRY(iso_picture_add(ctx, picture, "rows", "over size low high sign", &rows));
    for (size_t i = 0; sizes && i < iso_record_rows(r); i++) {
        const double at = iso_picture_number(r, i, over), m = iso_picture_number(r, i, "m"), size = fabs(m),
                     error = iso_picture_number(r, i, "error");
        const int sign = size < KNOWN * error ? 0 : m > 0 ? 1 : -1;
        if (!isfinite(at) || !isfinite(m) || !(error > 0) || iso_picture_number(r, i, "zero") == 1) continue;
        ISO_TRY(iso_record_add(ctx, rows, 1,
                               (double[]){at, sign ? size : size + error, size - error, size + error, sign}));
    }
    ISO_TRY(iso_picture_line(ctx, picture, "over", "%s", over));
    ISO_TRY(iso_picture_set(ctx, picture, "sizes curves", (double[]){sizes, curve != NULL}));
    ISO_TRY(iso_picture_add(ctx, picture, "curve", "u x", &copy));
    if (!curve) return ISO_OK;
    const char *at = iso_record_get(curve, "at");
    ISO_TRY(iso_picture_line(ctx, picture, "at", "%s", at ? at : ""));
    ISO_TRY(iso_picture_set(ctx, picture, "axis", (double[]){iso_picture_axis(curve) + 1}));
    int u;
    ISO_TRY(iso_picture_find(ctx, curve, 2, (const char *const[]){"u", "x"}, &u));
    for (size_t i = 0; i < iso_record_rows(curve); i++)
        ISO_TRY(iso_record_add(ctx, copy, 1, iso_record_const_row(curve, i) + u));
    return ISO_OK;
}

const iso_picture_maker iso_picture_splitting = {
    "splitting", "Splitting of the separatrix", {"k", "level", "m", "error"}, .make = make};
