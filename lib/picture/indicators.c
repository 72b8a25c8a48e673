/* indicators.c - the kind "chaos indicators": MEGNO, GALI_2 and the growth of deviations against the turns.
 *
 * Tables: ball, point: turn, growth, megno, mean, gali2; the second one has rows if two tables are given. The line
 * "model" of a table says whose it is; without it the first is the ball's. Lines: title.
 */
#include <string.h>

#include "picture/picture_impl.h"

#define LEAST_GALI 1e-17 /* an angle is not known better than to rounding */
enum { ROWS = 5000 };

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    enum { COLUMNS = 5, GALI = COLUMNS - 1 };
    static const char columns[] = "turn growth megno mean gali2";
    iso_record *side[2];
    picture->layout = "indicators";
    ISO_TRY(iso_picture_add(ctx, picture, "ball", columns, &side[0]));
    ISO_TRY(iso_picture_add(ctx, picture, "point", columns, &side[1]));
    for (int i = 0; i < 2 && q->table[i] && strcmp(iso_record_kind(q->table[i]), "chaos indicators") == 0; i++) {
        const iso_record *r = q->table[i];
        const char *model = iso_record_get(r, "model");
        iso_record *to = side[model ? strcmp(model, "point") == 0 : i];
        for (size_t j = 0; j < iso_record_rows(r); j += iso_record_rows(r) / ROWS + 1) {
            double row[COLUMNS];
            for (int c = 0; c < COLUMNS; c++) row[c] = iso_picture_number(r, j, iso_picture_indicators.columns[c]);
            if (row[GALI] < LEAST_GALI) row[GALI] = LEAST_GALI;
            ISO_TRY(iso_record_add(ctx, to, 1, row));
        }
    }
    return ISO_OK;
}

const iso_picture_maker iso_picture_indicators = {
    "chaos indicators", "Indicators of chaos", {"turn", "growth", "megno", "mean", "gali2"}, .make = make};
