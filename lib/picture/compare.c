/* compare.c - one orbit in both models: over their two clocks, or how far its computations are apart.
 *
 * Of the tables of iso_picture_stretch, layout "compare": states and curve (t, s, n1..3, gamma1..3, t_part, s_part,
 * colour, number, ball_right, ball_up, ball_near, point_right, point_up, point_near). The parts of both clocks that
 * have passed are from 0 to 1; colour is the first of them, in 96 steps; every 8th state has a number, the same
 * wherever it stands, the others NaN. The projection is that of sphere.c: where the curve goes to the other side its
 * row stands twice. axes: see sphere.c. Lines: rolls: what rolls on what; potential: of the point; drawn, result: texts
 * below; t_end, s_end.
 *
 * Of a table of differences, layout "difference": curves and values (curves.c): the chart "difference" of omega, n, M
 * and gamma over the clock, of which a number below 1e-17 is drawn as 1e-17. Given with two trajectories, that by the
 * ball and that by the point: ball and point with ends and axes (sphere.c). Lines: on_ball, on_point: titles of the
 * spheres that there are; differences: that of the chart.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/picture_impl.h"

/* --- differences ------------------------------------------------------------------------------------------------ */

enum { QUANTITIES = 4 };
#define FLOOR 1e-17

static iso_status make_difference(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const iso_record *r = q->table[0];
    const char *names[] = {iso_record_name(r, 0), "omega", "n", "M", "gamma"};
    iso_record **copy = iso_picture_aside(picture);
    picture->layout = "difference";
    ISO_TRY(iso_picture_add_curves(ctx, picture));
    ISO_TRY(iso_record_create(ctx, 1 + QUANTITIES, names, copy));
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        double row[1 + QUANTITIES] = {iso_picture_at(r, i, 0)};
        for (int c = 1; c <= QUANTITIES; c++) {
            const double x = iso_picture_number(r, i, names[c]);
            row[c] = x < FLOOR ? FLOOR : x;
        }
        ISO_TRY(iso_record_add(ctx, *copy, 1, row));
    }
    ISO_TRY(iso_picture_add_chart(ctx, picture, "difference", *copy, NULL, ISO_PICTURE_LARGEST));
    ISO_TRY(iso_picture_line(ctx, picture, "differences", "difference of ball and point"));
    for (int i = 1; i <= 2 && q->table[i]; i++) { /* the ball, then the point; the point may be alone */
        const bool ball = i == 1 && (q->table[2] || iso_record_find(q->table[i], "n1") >= 0);
        if (iso_record_rows(q->table[i]) == 0) continue;
        ISO_TRY(iso_picture_sphere(ctx, picture, ball ? "ball" : "point", q->table[i],
                                   ball ? iso_picture_n : iso_picture_gamma));
        ISO_TRY(iso_picture_line(ctx, picture, ball ? "on_ball" : "on_point",
                                 ball ? ISO_PICTURE_OF_BALL : ISO_PICTURE_OF_POINT));
    }
    return ISO_OK;
}

/* --- two clocks ------------------------------------------------------------------------------------------------- */

enum { STEP = 8, COLOURS = 96, GIVEN = 8, COLUMNS = GIVEN + 10, BALL_NEAR = 14, POINT_NEAR = 17 };
#define OUTLINE 0.1 /* a state so little behind the outline is shown in front */

/* last: the last state. */
static iso_status add_rows(iso_context *ctx, const iso_record *r, const double *last, bool curve, iso_record *to)
{
    double row[COLUMNS], before[COLUMNS];
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        memcpy(row, iso_record_const_row(r, i), GIVEN * sizeof *row);
        double *part = row + GIVEN, *seen = part + 4;
        for (int c = 0; c < 2; c++) part[c] = last[c] == 0 ? 0 : row[c] / last[c];
        part[2] = floor(fmin(fmax(part[0], 0), 1) * COLOURS) / COLOURS;
        part[3] = !curve && i % STEP == 0 ? (double)(i / STEP) : (double)NAN;
        for (int side = 0; side < 2; side++, seen += 3) {
            iso_picture_see(row + 2 + 3 * side, seen);
            seen[2] = seen[2] > (curve ? 0 : -OUTLINE);
        }
        if (curve && i > 0 && (row[BALL_NEAR] != before[BALL_NEAR] || row[POINT_NEAR] != before[POINT_NEAR])) {
            before[BALL_NEAR] = row[BALL_NEAR], before[POINT_NEAR] = row[POINT_NEAR];
            ISO_TRY(iso_record_add(ctx, to, 1, before));
        }
        ISO_TRY(iso_record_add(ctx, to, 1, row));
        memcpy(before, row, sizeof row);
    }
    return ISO_OK;
}

/* What rolls on what, from k alone: the radius of the fixed sphere is |k/(1-k)| times that of the ball. The point has
 * the potential of the theory, with that of a field (`field`). */
static iso_status set_models(iso_context *ctx, iso_picture *picture, double k, bool field)
{
    char where[100] = "on a plane", number[ISO_FRACTION_SIZE], power[40] = "";
    const double ratio = fabs(k / (1 - k));
    const char *side = k < 0 ? "around" : k < 1 ? "on" : "inside";
    if (ratio == 1)
        snprintf(where, sizeof where, "%s a sphere of its own radius", side);
    else if (k != 1)
        snprintf(where, sizeof where, "%s a sphere of %.3g times its radius", side, ratio);
    ISO_TRY(iso_picture_line(ctx, picture, "rolls", "k = %s: a %sball %s", iso_fraction_text(number, k),
                             k < 0 ? "hollow " : "", where));
    if (k != -1) snprintf(power, sizeof power, "^{%s}", iso_fraction_text(number, -1 / k));
    return iso_picture_line(ctx, picture, "potential", "a point in the potential V = −ε (γ, Jγ)%s%s", power,
                            field ? " + U/G" : "");
}

static iso_status set_drawn(iso_context *ctx, iso_picture *picture, double to, double end)
{
    if (to == end)
        return iso_picture_line(ctx, picture, "drawn", "drawn and compared: to t = %.6g; pale: the far side", end);
    return iso_picture_line(
        ctx, picture, "drawn",
        "drawn: a path as long as %.2g great circles, to t = %.4g; compared: to t = %.6g; pale: the far side",
        ISO_STRETCH_TURNS, to, end);
}

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    static const char *const given[GIVEN] = {"t", "s", "n1", "n2", "n3", "gamma1", "gamma2", "gamma3"};
    static const char columns[] = "t s n1 n2 n3 gamma1 gamma2 gamma3 t_part s_part colour number ball_right ball_up "
                                  "ball_near point_right point_up point_near";
    const iso_record *r = q->table[0], *path = iso_picture_given(q, "curve");
    const char *field = iso_record_get(r, "field"), *result = iso_record_get(r, "result");
    iso_record *states, *curve;
    iso_status status;
    double k, end;
    int first;
    if (iso_record_find(r, "omega") >= 0) return make_difference(ctx, q, picture);
    if (!path) return ISO_FAIL_INPUT(ctx, "", "no picture: the states have no curve");
    if (!iso_record_get_numbers(ctx, r, "k", 1, &k, &status) ||
        !iso_record_get_numbers(ctx, r, "compared", 1, &end, &status))
        return status != ISO_OK ? status : ISO_FAIL_INPUT(ctx, "k", "no picture: the states do not say k, compared");
    ISO_TRY(iso_picture_find(ctx, r, GIVEN, given, &first));
    if (first == 0) ISO_TRY(iso_picture_find(ctx, path, GIVEN, given, &first));
    if (first != 0 || iso_record_rows(r) == 0)
        return ISO_FAIL_INPUT(ctx, "t", "no picture: t is not the first column");
    const double *last = iso_record_const_row(r, iso_record_rows(r) - 1);
    ISO_TRY(iso_picture_add(ctx, picture, "states", columns, &states));
    ISO_TRY(iso_picture_add(ctx, picture, "curve", columns, &curve));
    ISO_TRY(add_rows(ctx, r, last, false, states));
    ISO_TRY(add_rows(ctx, path, last, true, curve));
    ISO_TRY(iso_picture_axes(ctx, picture, "ball", r, 2, STEP));
    ISO_TRY(iso_picture_axes(ctx, picture, "point", r, 5, STEP));
    ISO_TRY(set_models(ctx, picture, k, field && strcmp(field, "1") == 0));
    ISO_TRY(set_drawn(ctx, picture, last[0], end));
    ISO_TRY(iso_picture_line(ctx, picture, "result", "%s", result ? result : ""));
    return iso_picture_set(ctx, picture, "t_end s_end", last);
}

const iso_picture_maker iso_picture_compare = {
    "compare", "One orbit, two worlds, two clocks", {NULL}, .options = " ", .make = make};
