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

typedef struct spot {
    double right, up, depth;
} spot;

static spot project(const double v[3])
{
    return (spot){dot(v, frame[0]), dot(v, frame[1]), dot(v, frame[2])};
}

void iso_picture_see(const double v[3], double seen[3])
{
    for (int i = 0; i < 3; i++) seen[i] = dot(v, frame[i]);
}

/* --- paths ------------------------------------------------------------------------------------------------------ */

static double step_length(const iso_record *r, int column, size_t i)
{
    return angle_between(iso_picture_row(r, i - 1) + column, iso_picture_row(r, i) + column);
}

bool iso_picture_joined(const iso_record *r, int column)
{
    for (size_t i = 1; i < iso_picture_drawn(r); i++)
        if (step_length(r, column, i) > JOINED) return false;
    return true;
}

/* The great circle from a to b, in pieces; *side: where the piece before was, -1: there was none. */
static iso_status add_arc(iso_context *ctx, iso_record *path, const double a[3], const double b[3], int *side)
{
    const int pieces = 1 + (int)(angle_between(a, b) / ARC);
    spot from = project(a);
    for (int i = 1; i <= pieces; i++) {
        const double part = (double)i / pieces;
        double v[3];
        for (int j = 0; j < 3; j++) v[j] = (1 - part) * a[j] + part * b[j];
        make_unit(v);
        const spot to = project(v);
        const int now = from.depth + to.depth > 0;
        if (now != *side) ISO_TRY(iso_record_add(ctx, path, 1, (double[]){from.right, from.up, now}));
        ISO_TRY(iso_record_add(ctx, path, 1, (double[]){to.right, to.up, now}));
        *side = now, from = to;
    }
    return ISO_OK;
}

static iso_status add_end(iso_context *ctx, iso_record *ends, const char *of, const char *sign, const double v[3])
{
    const spot s = project(v);
    double row[] = {0, 0, s.right, s.up, s.depth > 0};
    ISO_TRY(iso_record_intern(ctx, ends, of, &row[0]));
    ISO_TRY(iso_record_intern(ctx, ends, sign, &row[1]));
    return iso_record_add(ctx, ends, 1, row);
}

static iso_status add_ends(iso_context *ctx, iso_picture *picture, const char *name, const double a[3],
                           const double b[3])
{
    static const char *const names[] = {"of", "sign", "right", "up", "near"};
    iso_record *ends = iso_picture_table(picture, "ends");
    if (!ends) {
        ISO_TRY(iso_picture_add(ctx, picture, "ends", 5, names, &ends));
        for (size_t c = 0; c < 2; c++) iso_record_set_words(ends, c, true);
    }
    ISO_TRY(add_end(ctx, ends, name, "start", a));
    return add_end(ctx, ends, name, "end", b);
}

iso_status iso_picture_path(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r, int column)
{
    static const char *const names[] = {"right", "up", "near"};
    const size_t rows = iso_picture_drawn(r);
    const bool joined = rows > 1 && iso_picture_joined(r, column);
    char key[64];
    double length = 0;
    int side = -1;
    iso_record *path;
    ISO_TRY(iso_picture_add(ctx, picture, name, 3, names, &path));
    for (size_t i = 0; i < rows; i++) {
        const double *v = iso_picture_row(r, i) + column;
        const spot s = project(v);
        if (!joined) ISO_TRY(iso_record_add(ctx, path, 1, (double[]){s.right, s.up, s.depth > 0}));
        if (!joined || i == 0) continue;
        length += step_length(r, column, i);
        ISO_TRY(add_arc(ctx, path, iso_picture_row(r, i - 1) + column, v, &side));
    }
    snprintf(key, sizeof key, "%s_length", name);
    ISO_TRY(iso_picture_count(ctx, picture, key, length));
    snprintf(key, sizeof key, "%s_rows", name);
    ISO_TRY(iso_picture_count(ctx, picture, key, (double)rows));
    return add_ends(ctx, picture, name, iso_picture_row(r, 0) + column, iso_picture_row(r, rows - 1) + column);
}

/* --- axes ------------------------------------------------------------------------------------------------------- */

/* Where the number of an axis stands: behind its end at (x, y), or beside it where the path would cover it. */
static spot place_of_number(const iso_record *r, int column, size_t step, double x, double y)
{
    static const double beside[] = {0, 0.13, -0.13, 0.22, -0.22};
    const double length = fmax(hypot(x, y), 1e-9);
    spot best = {x, y, 0};
    for (int i = 0; i < 5 && best.depth <= 0.14; i++) {
        const spot to = {x - beside[i] * y / length, y + beside[i] * x / length, 0};
        double room = INFINITY;
        for (size_t j = 0; j < iso_record_rows(r); j += step) {
            const spot s = project(iso_record_const_row(r, j) + column);
            room = fmin(room, hypot(s.right - to.right, s.up - to.up));
        }
        if (room > best.depth + 1e-9) best = (spot){to.right, to.up, room};
    }
    return best;
}

iso_status iso_picture_axes(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r, int column,
                            size_t step)
{
    static const char *const names[] = {"of",     "right",  "up",           "tip_right",
                                        "tip_up", "number", "number_right", "number_up"};
    iso_record *axes = iso_picture_table(picture, "axes");
    if (!axes) {
        ISO_TRY(iso_picture_add(ctx, picture, "axes", 8, names, &axes));
        iso_record_set_words(axes, 0, true);
    }
    for (int axis = 0; axis < 3; axis++) {
        const spot s = project((double[]){axis == 0, axis == 1, axis == 2});
        const double size = fmax(hypot(s.right, s.up), 0.5), end = 1 + 0.14 / size, label = end + 0.07 / size;
        const spot number = place_of_number(r, column, step, s.right * label, s.up * label);
        double row[] = {0, s.right, s.up, s.right * end, s.up * end, axis + 1, number.right, number.up};
        ISO_TRY(iso_record_intern(ctx, axes, name, &row[0]));
        ISO_TRY(iso_record_add(ctx, axes, 1, row));
    }
    return ISO_OK;
}
