/* sphere.c - a path on the unit sphere, as it is seen.
 *
 * Tables: of the name of the path (right, up, near), ends (of, sign, right, up, near) and axes (of, right, up,
 * tip_right, tip_up, number, number_right, number_up). The projection is orthographic, along d: a point x is seen at
 * ((x,right), (x,up)), and is near (1; else 0) where (x,d) > 0. The row where a path goes to the other side stands
 * twice, once for each side. Rows that are far apart, but joined, have the great circle between them.
 *
 *          3 |                right = (-sin a, cos a, 0)
 *            |  . eye         up    = (-sin e cos a, -sin e sin a, cos e)
 *            |.               d     = ( cos e cos a,  cos e sin a, sin e)
 *            /------ 2
 *          1                  a: azimuth of the eye, from axis 1 to axis 2;  e: its elevation over both
 */
#include <math.h>
#include <stdio.h>

#include "base/vec3_impl.h"
#include "picture/picture_impl.h"

#define ARC 0.15   /* longest straight piece of a path, in radians                     */
#define JOINED 0.6 /* rows farther apart than this are no path: they are drawn as dots */

size_t iso_picture_drawn(const iso_record *r)
{
    const size_t rows = iso_record_rows(r);
    return rows < ISO_PICTURE_ROWS ? rows : ISO_PICTURE_ROWS;
}

const double *iso_picture_row(const iso_record *r, size_t i)
{
    const size_t rows = iso_record_rows(r), drawn = iso_picture_drawn(r);
    if (rows == drawn) return iso_record_const_row(r, i);
    return iso_record_const_row(r, (size_t)((double)i * (double)(rows - 1) / (double)(drawn - 1) + 0.5));
}

iso_status iso_picture_find(iso_context *ctx, const iso_record *r, int count, const char *const names[], int *first)
{
    const int found = iso_record_find(r, names[0]);
    *first = -1;
    for (int c = 0; c < count; c++)
        if (found < 0 || iso_record_find(r, names[c]) != found + c)
            return ISO_FAIL_INPUT(ctx, names[c], "no picture: there is no column '%s'%s", names[c],
                                  c > 0 ? " behind the one before" : "");
    for (size_t i = 0; i < iso_record_rows(r); i++)
        for (int c = 0; c < count; c++)
            if (!isfinite(iso_record_const_row(r, i)[found + c]))
                return iso_context_fail(ctx, ISO_NUMERICAL, names[c], "a picture: %s is not finite in row %zu",
                                        names[c], i + 1);
    *first = found;
    return ISO_OK;
}

/* --- the projection --------------------------------------------------------------------------------------------- */

/* right, up, d for a = 25 and e = 24 degrees; pictures/page.gp has the same. */
static const double frame[3][3] = {{-0.42261826174069944, 0.90630778703664996, 0},
                                   {-0.36862823570066146, -0.17189417172037236, 0.91354545764260087},
                                   {0.82795218756063110, 0.38608045045127610, 0.40673664307580021}};

void iso_picture_see(const double v[3], double seen[3])
{
    for (int i = 0; i < 3; i++) seen[i] = dot(v, frame[i]);
}

/* --- paths ------------------------------------------------------------------------------------------------------ */

bool iso_picture_joined(const iso_record *r, int column)
{
    for (size_t i = 1; i < iso_picture_drawn(r); i++)
        if (angle_between(iso_picture_row(r, i - 1) + column, iso_picture_row(r, i) + column) > JOINED) return false;
    return true;
}

/* The great circle from a to b, in pieces; *side: where the piece before was, -1: there was none. */
static iso_status add_arc(iso_context *ctx, iso_record *path, const double a[3], const double b[3], int *side)
{
    const int pieces = 1 + (int)(angle_between(a, b) / ARC);
    double from[3], to[3];
    iso_picture_see(a, from);
    for (int i = 1; i <= pieces; i++) {
        const double part = (double)i / pieces;
        double v[3];
        for (int j = 0; j < 3; j++) v[j] = (1 - part) * a[j] + part * b[j];
        make_unit(v);
        iso_picture_see(v, to);
        const int now = from[2] + to[2] > 0;
        if (now != *side) ISO_TRY(iso_record_add(ctx, path, 1, (double[]){from[0], from[1], now}));
        ISO_TRY(iso_record_add(ctx, path, 1, (double[]){to[0], to[1], now}));
        *side = now;
        copy(to, from, 3);
    }
    return ISO_OK;
}

static iso_status add_end(iso_context *ctx, iso_record *ends, const char *of, const char *sign, const double v[3])
{
    double row[5];
    iso_picture_see(v, row + 2);
    row[4] = row[4] > 0;
    ISO_TRY(iso_record_intern(ctx, ends, of, &row[0]));
    ISO_TRY(iso_record_intern(ctx, ends, sign, &row[1]));
    return iso_record_add(ctx, ends, 1, row);
}

iso_status iso_picture_path(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r, int column)
{
    const size_t rows = iso_picture_drawn(r);
    const bool joined = rows > 1 && iso_picture_joined(r, column);
    char keys[64];
    double length = 0, seen[3];
    int side = -1;
    iso_record *path, *ends = iso_picture_table(picture, "ends");
    ISO_TRY(iso_picture_add(ctx, picture, name, "right up near", &path));
    for (size_t i = 0; i < rows; i++) {
        const double *v = iso_picture_row(r, i) + column, *before = i > 0 ? iso_picture_row(r, i - 1) + column : v;
        iso_picture_see(v, seen);
        if (!joined) ISO_TRY(iso_record_add(ctx, path, 1, (double[]){seen[0], seen[1], seen[2] > 0}));
        if (!joined || i == 0) continue;
        length += angle_between(before, v);
        ISO_TRY(add_arc(ctx, path, before, v, &side));
    }
    snprintf(keys, sizeof keys, "%s_length %s_rows", name, name);
    ISO_TRY(iso_picture_set(ctx, picture, keys, (double[]){length, (double)rows}));
    if (!ends) ISO_TRY(iso_picture_add(ctx, picture, "ends", "of' sign' right up near", &ends));
    ISO_TRY(add_end(ctx, ends, name, "start", iso_picture_row(r, 0) + column));
    return add_end(ctx, ends, name, "end", iso_picture_row(r, rows - 1) + column);
}

/* --- axes ------------------------------------------------------------------------------------------------------- */

/* Where the number of an axis stands: behind its end at (x, y), or beside it where the path would cover it. */
static void place_number(const iso_record *r, int column, size_t step, double x, double y, double place[2])
{
    static const double beside[] = {0, 0.13, -0.13, 0.22, -0.22};
    const double length = fmax(hypot(x, y), 1e-9);
    double best = 0, seen[3];
    place[0] = x, place[1] = y;
    for (int i = 0; i < 5 && best <= 0.14; i++) {
        const double right = x - beside[i] * y / length, up = y + beside[i] * x / length;
        double room = INFINITY;
        for (size_t j = 0; j < iso_record_rows(r); j += step) {
            iso_picture_see(iso_record_const_row(r, j) + column, seen);
            room = fmin(room, hypot(seen[0] - right, seen[1] - up));
        }
        if (room > best + 1e-9) best = room, place[0] = right, place[1] = up;
    }
}

iso_status iso_picture_axes(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r, int column,
                            size_t step)
{
    iso_record *axes = iso_picture_table(picture, "axes");
    if (!axes)
        ISO_TRY(iso_picture_add(ctx, picture, "axes", "of' right up tip_right tip_up number number_right number_up",
                                &axes));
    for (int axis = 0; axis < 3; axis++) {
        double s[3];
        iso_picture_see((double[]){axis == 0, axis == 1, axis == 2}, s);
        const double size = fmax(hypot(s[0], s[1]), 0.5), end = 1 + 0.14 / size, label = end + 0.07 / size;
        double row[] = {0, s[0], s[1], s[0] * end, s[1] * end, axis + 1, 0, 0};
        place_number(r, column, step, s[0] * label, s[1] * label, row + 6);
        ISO_TRY(iso_record_intern(ctx, axes, name, &row[0]));
        ISO_TRY(iso_record_add(ctx, axes, 1, row));
    }
    return ISO_OK;
}

const char *const iso_picture_n[3] = {"n1", "n2", "n3"}, *const iso_picture_gamma[3] = {"gamma1", "gamma2", "gamma3"};

iso_status iso_picture_sphere(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r,
                              const char *const columns[3])
{
    int first;
    ISO_TRY(iso_picture_find(ctx, r, 3, columns, &first));
    ISO_TRY(iso_picture_path(ctx, picture, name, r, first));
    return iso_picture_axes(ctx, picture, name, r, first, 1 + iso_record_rows(r) / 400);
}
