/* branch.c - a bifurcation diagram: trace and place of followed periodic orbits over what varies.
 *
 * Tables: points (branch, at, trace, place: 2 u/pi on the symmetry line) and events (the same, and event: a word),
 * which are those of the table but ends of branches. Lines: branches, how many; over, what varies.
 */
#include <math.h>

#include "picture/picture_impl.h"

enum { OVER = 3 }; /* the column of what varies */

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
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
    return iso_picture_say(ctx, picture, "over", "%s", iso_picture_symbol(iso_record_name(r, OVER)));
}

const iso_picture_maker iso_picture_branch = {
    "periodic follow", "Periodic orbits followed", {"branch", "u", "trace", "event"}, .make = make};
