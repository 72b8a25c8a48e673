/* difference.c - how far the computations of one orbit are apart over its clock, and the orbit on both spheres.
 *
 * Tables: curves and values (curves.c): the chart "difference" of omega, n, M and gamma, of which a number below 1e-17
 * is drawn as 1e-17. Given with two trajectories, that by the ball and that by the point: ball and point with ends and
 * axes (sphere.c). Lines: on_ball, on_point: titles of the spheres that there are; differences: that of the chart.
 */
#include <math.h>

#include "picture/picture_impl.h"

enum { QUANTITIES = 4 };
#define FLOOR 1e-17

/* The clock, the first column, and the differences. */
static iso_status copy_differences(iso_context *ctx, const iso_record *r, iso_record **copy)
{
    const char *names[] = {iso_record_name(r, 0), "omega", "n", "M", "gamma"};
    ISO_TRY(iso_record_create(ctx, 1 + QUANTITIES, names, copy));
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        double row[1 + QUANTITIES] = {iso_record_const_row(r, i)[0]};
        for (int c = 1; c <= QUANTITIES; c++) {
            const double x = iso_picture_number(r, i, names[c]);
            row[c] = x < FLOOR ? FLOOR : x;
        }
        ISO_TRY(iso_record_add(ctx, *copy, 1, row));
    }
    return ISO_OK;
}

static iso_status add_sphere(iso_context *ctx, iso_picture *picture, bool ball, const iso_record *r)
{
    static const char *const normal[] = {"n1", "n2", "n3"}, *const place[] = {"gamma1", "gamma2", "gamma3"};
    const char *name = ball ? "ball" : "point";
    int first;
    if (!r || iso_record_rows(r) == 0) return ISO_OK;
    ISO_TRY(iso_picture_find(ctx, r, 3, ball ? normal : place, &first));
    ISO_TRY(iso_picture_path(ctx, picture, name, r, first));
    ISO_TRY(iso_picture_axes(ctx, picture, name, r, first, 1 + iso_record_rows(r) / 400));
    return iso_picture_say(ctx, picture, ball ? "on_ball" : "on_point",
                           ball ? ISO_PICTURE_OF_BALL : ISO_PICTURE_OF_POINT);
}

iso_status iso_picture_difference(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    iso_record *copy = NULL;
    picture->layout = "difference";
    ISO_TRY(iso_picture_add_curves(ctx, picture));
    iso_status status = copy_differences(ctx, q->table[0], &copy);
    for (int c = 1; status == ISO_OK && c <= QUANTITIES; c++)
        status = iso_picture_add_curve(
            ctx, picture, &(iso_picture_curve){"difference", NULL, copy, 0, c, false, ISO_PICTURE_LARGEST, INFINITY});
    iso_record_free(copy);
    ISO_TRY(status);
    ISO_TRY(iso_picture_say(ctx, picture, "differences", "difference of ball and point"));
    for (int i = 1; i <= 2 && q->table[i]; i++) { /* the ball, then the point; the point may be alone */
        const bool ball = i == 1 && (q->table[2] || iso_record_find(q->table[i], "n1") >= 0);
        ISO_TRY(add_sphere(ctx, picture, ball, q->table[i]));
    }
    return ISO_OK;
}
