/* chaos.c - the kind "chaos": the starts on the section, with their verdicts and exponents.
 *
 * Tables: regular (also integrable motions), chaotic, undecided: l, x; chaotic has also the exponent per turn, that of
 * the ball if it is chaotic, else of the point; 0: not known. Rows without l and x are left out. Lines: title;
 * right_name, up_name: names of the axes.
 */
#include <math.h>

#include "picture/picture_impl.h"
#include "study/verdict.h"

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
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
    ISO_TRY(iso_picture_say(ctx, picture, "right_name", "l,  where γ%s = cos l, γ%s = −sin l", index[1], index[2]));
    return iso_picture_say(ctx, picture, "up_name", "M%s / |M|", index[0]);
}

const iso_picture_maker iso_picture_chaos = {
    "chaos", "Chaos on the section", {"l", "x", "verdict"}, .axis = true, .make = make};
