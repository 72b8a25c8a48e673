/* chaos.c - the starts on the section with their verdicts and exponents; indicators of chaos.
 *
 * The kind "chaos": regular (also integrable motions), chaotic, undecided: l, x; chaotic has also the exponent per
 * turn, that of the ball if it is chaotic, else of the point; 0: not known. Rows without l and x are left out. Lines:
 * title; right_name, up_name: names of the axes.
 *
 * The kind "chaos indicators", MEGNO, GALI_2 and the growth of deviations against the turns: ball, point: turn, growth,
 * megno, mean, gali2; the second one has rows if two tables are given. The line "model" of a table says whose it is;
 * without it the first is the ball's.
 */
#include <math.h>
#include <string.h>

#include "picture/picture_impl.h"
#include "study/verdict.h"

static iso_status make_starts(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    static const char *const kinds[] = {"regular", "chaotic", "undecided"};
    enum { REGULAR, CHAOTIC, UNDECIDED, KINDS };
    const iso_record *r = q->table[0];
    iso_record *of[KINDS];
    size_t all = 0;
    for (int kind = 0; kind < KINDS; kind++)
        ISO_TRY(iso_picture_add(ctx, picture, kinds[kind], kind == CHAOTIC ? "l x exponent" : "l x", &of[kind]));
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const bool by_ball = iso_picture_is(r, i, "ball_verdict", "chaotic");
        const double exponent = iso_picture_number(r, i, by_ball ? "ball_per_turn" : "point_per_turn");
        const double row[] = {iso_picture_number(r, i, "l"), iso_picture_number(r, i, "x"),
                              isfinite(exponent) ? exponent : 0};
        const bool chaotic = iso_picture_is(r, i, "verdict", "chaotic"),
                   regular = iso_picture_is(r, i, "verdict", "regular") ||
                             iso_picture_is(r, i, "verdict", iso_verdict_name(ISO_INTEGRABLE));
        if (!isfinite(row[0]) || !isfinite(row[1])) continue;
        ISO_TRY(iso_record_add(ctx, of[regular ? REGULAR : chaotic ? CHAOTIC : UNDECIDED], 1, row));
        all++;
    }
    if (all == 0) return ISO_FAIL_INPUT(ctx, "", "no picture: the table has no orbit that starts on the section");
    const char *const *index = iso_picture_index + iso_picture_axis(r);
    ISO_TRY(iso_picture_line(ctx, picture, "right_name", "l,  where γ%s = cos l, γ%s = −sin l", index[1], index[2]));
    return iso_picture_line(ctx, picture, "up_name", "M%s / |M|", index[0]);
}

/* --- indicators ------------------------------------------------------------------------------------------------- */

#define LEAST_GALI 1e-17 /* an angle is not known better than to rounding */
enum { ROWS = 5000 };

static iso_status make_indicators(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
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

const iso_picture_maker iso_picture_chaos = {
    "chaos", "Chaos on the section", {"l", "x", "verdict"}, .axis = true, .make = make_starts};
const iso_picture_maker iso_picture_indicators = {
    "chaos indicators", "Indicators of chaos", {"turn", "growth", "megno", "mean", "gali2"}, .make = make_indicators};
