/* plot_sphere.c - one sphere of a picture, with a path on it.
 *
 * Spheres are projected here and drawn in two dimensions, because gnuplot's own 3D cannot show the far side through
 * the near one. The projection is orthographic, along d: a point x of the unit sphere is drawn at ((x,right),
 * (x,up)), and lies on the near side where (x,d) > 0. The far side is drawn first, in pale colours, then the near
 * side.
 *
 *          3 |                right = (-sin a, cos a, 0)
 *            |  . eye         up    = (-sin e cos a, -sin e sin a, cos e)
 *            |.               d     = ( cos e cos a,  cos e sin a, sin e)
 *            /------ 2
 *          1                  a: azimuth of the eye, from axis 1 to axis 2;  e: its elevation over both
 */
#include <math.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

enum { FEW = 500 /* rows that are drawn as larger dots */ };
#define ARC 0.15   /* longest straight piece of a path, in radians                     */
#define JOINED 0.6 /* rows farther apart than this are no path: they are drawn as dots */
#define LONG 40.0  /* a path of more radians is drawn with a finer line                */

size_t iso_plot_drawn_rows(const iso_record *r)
{
    const size_t rows = iso_record_rows(r);
    return rows < ISO_PLOT_ROWS ? rows : ISO_PLOT_ROWS;
}

const double *iso_plot_drawn_row(const iso_record *r, size_t i)
{
    const size_t rows = iso_record_rows(r), drawn = iso_plot_drawn_rows(r);
    if (rows == drawn) return iso_record_const_row(r, i);
    return iso_record_const_row(r, (size_t)((double)i * (double)(rows - 1) / (double)(drawn - 1) + 0.5));
}

/* --- paths on the sphere ---------------------------------------------------------------------------------------- */

typedef struct spot {
    double x, y, depth;
} spot;

/* right, up, d */
static const double frame[3][3] = {{-0.42261826174069944, 0.90630778703664996, 0}, /* a = 25, e = 24 degrees */
                                   {-0.36862823570066146, -0.17189417172037236, 0.91354545764260087},
                                   {0.82795218756063110, 0.38608045045127610, 0.40673664307580021}};

static spot project(const double v[3])
{
    return (spot){dot(v, frame[0]), dot(v, frame[1]), dot(v, frame[2])};
}

/* The great circle from a to b, as far as it lies on one side; *open: whether the last piece did. */
static void put_arc(FILE *f, const double a[3], const double b[3], bool near, bool *open)
{
    const int pieces = 1 + (int)(angle_between(a, b) / ARC);
    spot from = project(a);
    for (int i = 1; i <= pieces; i++) {
        const double part = (double)i / pieces;
        double v[3];
        for (int j = 0; j < 3; j++) v[j] = (1 - part) * a[j] + part * b[j];
        make_unit(v);
        const spot to = project(v);
        const bool seen = (from.depth + to.depth > 0) == near;
        if (seen && !*open) fprintf(f, "%.17g %.17g\n", from.x, from.y);
        if (seen) fprintf(f, "%.17g %.17g\n", to.x, to.y);
        if (!seen && *open) fputc('\n', f);
        *open = seen;
        from = to;
    }
}

bool iso_plot_is_joined(const iso_record *r, int column)
{
    for (size_t i = 1; i < iso_plot_drawn_rows(r); i++)
        if (angle_between(iso_plot_drawn_row(r, i - 1) + column, iso_plot_drawn_row(r, i) + column) > JOINED)
            return false;
    return true;
}

void iso_plot_begin_side(FILE *f, const char *name, bool near)
{
    fprintf(f, "$%s%d << EOD\nNaN NaN\n\n", name, near);
}

static void put_path(FILE *f, const iso_record *r, int column, bool near)
{
    const bool joined = iso_plot_is_joined(r, column);
    bool open = false;
    iso_plot_begin_side(f, "path", near);
    for (size_t i = 0; i < iso_plot_drawn_rows(r); i++) {
        const double *v = iso_plot_drawn_row(r, i) + column;
        const spot s = project(v);
        if (joined && i > 0) put_arc(f, iso_plot_drawn_row(r, i - 1) + column, v, near, &open);
        if (!joined && (s.depth > 0) == near) fprintf(f, "%.17g %.17g\n", s.x, s.y);
    }
    fputs("EOD\n", f);
}

/* A sign for the first or the last row. It is a label, so that it stays visible where both are at the same place. */
static void put_end(FILE *f, const double v[3], const char *type)
{
    const spot s = project(v);
    const char *colour = s.depth > 0 ? "'black'" : ISO_PLOT_BEHIND;
    fprintf(f, "set label '' at %.17g,%.17g front point %s lc rgb %s\n", s.x, s.y, type, colour);
}

static void put_graticule(FILE *f, bool near)
{
    const double degree = M_PI / 180;
    iso_plot_begin_side(f, "grid", near);
    for (int circle = 0; circle < 11; circle++) { /* 6 meridians, 5 parallels, 30 degrees apart */
        const double angle0 = (circle < 6 ? circle : circle - 8) * 30 * degree;
        double last[3] = {0, 0, 0};
        bool open = false;
        for (int i = 0; i <= 360; i += 5) {
            const double lat = circle < 6 ? i * degree : angle0, lon = circle < 6 ? angle0 : i * degree;
            const double v[3] = {cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)};
            if (i > 0) put_arc(f, last, v, near, &open);
            memcpy(last, v, sizeof v);
        }
        fputc('\n', f);
    }
    fputs("EOD\n", f);
}

/* How far the nearest of the marked rows is from (x, y), in radii of the sphere. */
static double room_at(const iso_plot_marks *marks, double x, double y)
{
    double room = INFINITY;
    for (size_t i = 0; marks && i < iso_record_rows(marks->rows); i += marks->step) {
        const spot s = project(iso_record_const_row(marks->rows, i) + marks->column);
        room = fmin(room, hypot(s.x - x, s.y - y));
    }
    return room;
}

/* Where the number of an axis stands: behind its end, or beside it where a mark would cover it. */
static spot place_of_number(const iso_plot_marks *marks, double x, double y)
{
    static const double beside[] = {0, 0.13, -0.13, 0.22, -0.22};
    const double length = fmax(hypot(x, y), 1e-9);
    spot best = {x, y, 0};
    for (int i = 0; i < 5; i++) {
        const double to[] = {x - beside[i] * y / length, y + beside[i] * x / length},
                     room = room_at(marks, to[0], to[1]);
        if (room > best.depth + 1e-9) best = (spot){to[0], to[1], room};
        if (best.depth > 0.14) break;
    }
    return best;
}

void iso_plot_put_axes(FILE *f, double x, double y, double radius, const iso_plot_marks *marks)
{
    for (int axis = 0; axis < 3; axis++) {
        const double v[3] = {axis == 0, axis == 1, axis == 2};
        const spot s = project(v);
        const double end = 1 + 0.14 / fmax(hypot(s.x, s.y), 0.5), label = end + 0.07 / fmax(hypot(s.x, s.y), 0.5);
        const spot number = place_of_number(marks, s.x * label, s.y * label);
        fprintf(f,
                "set arrow nohead back lw 1.2 lc rgb " ISO_PLOT_LINE " from %.17g,%.17g to %.17g,%.17g\n"
                "set label '%d' center tc rgb " ISO_PLOT_INK " at %.17g,%.17g\n",
                x + radius * s.x, y + radius * s.y, x + radius * s.x * end, y + radius * s.y * end, axis + 1,
                x + radius * number.x, y + radius * number.y);
    }
}

void iso_plot_put_globe(FILE *f)
{
    for (int i = 0; i < 3; i++)
        fprintf(f, "%c(x,y,z) = %.17g*x + %.17g*y + %.17g*z\n", "XYD"[i], frame[i][0], frame[i][1], frame[i][2]);
    for (int near = 0; near < 2; near++) put_graticule(f, near);
}

static const char *const setup = "unset border; unset tics; unset key; unset label; unset arrow; set size ratio -1\n"
                                 "set xrange [-1.2:1.2]; set yrange [-1.07:1.2]\n"
                                 "set object 1 circle at 0,0 size 1 back fillcolor rgb " ISO_PLOT_SPHERE
                                 " fillstyle solid border lc rgb " ISO_PLOT_OUTLINE "\n";

static bool is_long(const iso_record *r, int column)
{
    double length = 0;
    for (size_t i = 1; i < iso_plot_drawn_rows(r); i++)
        length += angle_between(iso_plot_drawn_row(r, i - 1) + column, iso_plot_drawn_row(r, i) + column);
    return length > LONG;
}

void iso_plot_sphere(FILE *f, const iso_plot_box *box, const iso_record *line, int line_column)
{
    const char *near_style = is_long(line, line_column) ? "lines lw 0.8" : "lines lw 1.8";
    const char *far_style = "lines lw 0.8";
    if (!iso_plot_is_joined(line, line_column))
        near_style = far_style = iso_plot_drawn_rows(line) > FEW ? "points pt 7 ps 0.2" : "points pt 7 ps 0.5";
    for (int near = 0; near < 2; near++) {
        put_graticule(f, near);
        put_path(f, line, line_column, near);
    }
    fputs(setup, f);
    iso_plot_place(f, box);
    iso_plot_put_axes(f, 0, 0, 1, &(iso_plot_marks){line, 1 + iso_record_rows(line) / 400, line_column});
    put_end(f, iso_plot_drawn_row(line, 0) + line_column, ISO_PLOT_START);
    put_end(f, iso_plot_drawn_row(line, iso_plot_drawn_rows(line) - 1) + line_column, ISO_PLOT_END);
    fprintf(f, "plot $grid0 w l lw 0.6 lc rgb " ISO_PLOT_GRID ", $path0 w %s lc rgb " ISO_PLOT_FAR_BLUE ",",
            far_style);
    fprintf(f, " $grid1 w l lw 0.8 lc rgb " ISO_PLOT_NEAR_GRID ", $path1 w %s lc rgb " ISO_PLOT_BLUE, near_style);
    fputs("\n", f);
}
