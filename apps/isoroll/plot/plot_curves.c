/* plot_curves.c - curves over a clock, or any column over another: energies, pressure and friction, the clocks. */
#include <math.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

enum { SLOTS = 1000 /* of the rows; each shows its least and its largest number, so that thinning hides none */ };
#define ROOM 0.04 /* beyond the ends of a curve, as a part of the axis */

/* --- data ------------------------------------------------------------------------------------------------------- */

static double number_at(const iso_plot_panel *p, size_t row, int column)
{
    return iso_record_const_row(p->rows, row)[column];
}

/* The least and the largest number of one slot, in their order. */
static void put_slot(FILE *f, const iso_plot_panel *p, int column, size_t from, size_t to)
{
    size_t least = from, largest = from;
    for (size_t i = from; i < to; i++) {
        if (number_at(p, i, column) < number_at(p, least, column)) least = i;
        if (number_at(p, i, column) > number_at(p, largest, column)) largest = i;
    }
    const size_t first = least < largest ? least : largest, last = least < largest ? largest : least;
    fprintf(f, "%.17g %.17g\n", number_at(p, first, p->over), number_at(p, first, column));
    if (last != first) fprintf(f, "%.17g %.17g\n", number_at(p, last, p->over), number_at(p, last, column));
}

/* One block of data for each curve. Where one column is drawn over another that is no clock, thinning cannot keep the
 * ends of both: rows are then left out evenly. */
static void put_data(FILE *f, const iso_plot_panel *p, int curve)
{
    const size_t rows = iso_record_rows(p->rows), drawn = iso_plot_drawn_rows(p->rows);
    const int column = p->curve[curve].column;
    fprintf(f, "$curve%d << EOD\n", curve);
    if (p->equal || rows <= 2 * SLOTS)
        for (size_t i = 0; i < drawn; i++)
            fprintf(f, "%.17g %.17g\n", iso_plot_drawn_row(p->rows, i)[p->over],
                    iso_plot_drawn_row(p->rows, i)[column]);
    else
        for (size_t slot = 0; slot < SLOTS; slot++)
            put_slot(f, p, column, slot * rows / SLOTS, (slot + 1) * rows / SLOTS);
    fputs("EOD\n", f);
}

/* --- axes ------------------------------------------------------------------------------------------------------- */

/* The range of the curves of one axis, with room; false: it has none. */
static bool range_of(const iso_plot_panel *p, bool right, double range[2])
{
    bool found = false;
    for (int c = 0; c < p->count; c++)
        for (size_t i = 0; p->curve[c].right == right && i < iso_record_rows(p->rows); i++) {
            const double x = number_at(p, i, p->curve[c].column);
            range[0] = found ? fmin(range[0], x) : x;
            range[1] = found ? fmax(range[1], x) : x;
            found = true;
        }
    if (!found) return false;
    if (p->top[right] > 0) range[1] = fmin(range[1], p->top[right]);
    const double room = ROOM * (range[1] - range[0]);
    if (!(range[0] >= 0 && range[0] < 0.3 * range[1]))
        range[0] -= room;
    else
        range[0] = 0; /* an axis of positive numbers begins at 0 */
    range[1] += p->top[right] > 0 && range[1] == p->top[right] ? 0 : room;
    return true;
}

static void put_x_axis(FILE *f, const iso_plot_panel *p)
{
    char name[ISO_PLOT_NAME];
    double x[2] = {number_at(p, 0, p->over), number_at(p, 0, p->over)};
    for (size_t i = 0; i < iso_record_rows(p->rows); i++) {
        x[0] = fmin(x[0], number_at(p, i, p->over));
        x[1] = fmax(x[1], number_at(p, i, p->over));
    }
    const double room = p->equal ? ROOM * (x[1] - x[0]) : 0;
    const iso_plot_axis axis = {.which = "x",
                                .low = x[0] - room,
                                .high = x[1] + room,
                                .most = p->box.right - p->box.left > 0.5 ? 9 : 5,
                                .name = iso_plot_symbol(iso_record_name(p->rows, (size_t)p->over)),
                                .label = true};
    iso_plot_ticks(f, &axis, name);
}

#define NUMBER "number"

/* The power and the shift that are taken out of the ticks stand above the axis: "10⁻⁴", or "number − 66.7". */
static void put_y_axis(FILE *f, const iso_plot_panel *p, bool right)
{
    static const char power[] = NUMBER " / ";
    char name[ISO_PLOT_NAME];
    double range[2];
    if (!range_of(p, right, range)) return;
    const iso_plot_axis axis = {.which = right ? "y2" : "y",
                                .low = range[0],
                                .high = range[1],
                                .most = p->box.top - p->box.bottom < 0.2 ? 3 : 5,
                                .name = NUMBER};
    iso_plot_ticks(f, &axis, name);
    if (strcmp(name, NUMBER) == 0) return;
    const bool short_name = strncmp(name, power, strlen(power)) == 0;
    fprintf(f, "set label %d %s noenhanced tc rgb '#404040' %s at graph %d,1.0 offset %s,0.6\n", 2 + right,
            QUOTED(short_name ? name + strlen(power) : name, ISO_PLOT_NAME), short_name == right ? "left" : "right",
            right,
            !short_name ? "0"
            : right     ? "1"
                        : "-1");
}

static void put_axes(FILE *f, const iso_plot_panel *p)
{
    put_x_axis(f, p);
    put_y_axis(f, p, false);
    put_y_axis(f, p, true);
}

static void put_marks(FILE *f, const iso_plot_panel *p)
{
    for (int i = 0; i < p->marks; i++) {
        const double x = number_at(p, p->mark[i], p->over);
        fprintf(f, "set arrow %d from first %.17g, graph 0 to first %.17g, graph 1 nohead " ISO_PLOT_LOST_LINE "\n",
                i + 1, x, x);
    }
}

static void put_title(FILE *f, const char *title)
{
    if (!title) return;
    fprintf(f, "set label 1 %s left noenhanced at graph 0,1 offset 0,0.9\n", QUOTED(title, 90));
}

void iso_plot_curves(FILE *f, const iso_plot_panel *p)
{
    for (int c = 0; c < p->count; c++) put_data(f, p, c);
    fprintf(f,
            "unset label; unset arrow; unset object; unset title; unset logscale; set border 3 lc rgb '#606060'\n"
            "set grid xtics ytics back lt 1 lw 0.8 lc rgb '#DDE1E5'; unset xlabel; unset ylabel; unset y2tics\n"
            "set key default; set key noenhanced horizontal maxrows 1 Left reverse samplen 2 at graph 1,1.03 "
            "right bottom\nset size %s\n",
            p->equal ? "ratio -1" : "noratio");
    iso_plot_place(f, &p->box);
    put_axes(f, p);
    for (int c = 0; c < p->count; c++)
        if (p->curve[c].right) fputs("set border 11\n", f);
    put_marks(f, p);
    put_title(f, p->title);
    for (int c = 0; c < p->count; c++) {
        const iso_plot_curve *curve = &p->curve[c];
        fprintf(f, "%s $curve%d axes x1y%d with %s lc rgb %s %s", c ? "," : "plot", c, curve->right ? 2 : 1,
                iso_record_rows(p->rows) > 1 ? "lines lw 1.5" : "points pt 7", curve->colour,
                curve->name ? "title " : "notitle");
        if (curve->name) fputs(QUOTED(curve->name, 60), f);
    }
    if (p->marks && p->count < 3) fprintf(f, ", NaN with lines " ISO_PLOT_LOST_LINE " title '%s'", p->marked);
    fputs("\nset autoscale; unset y2tics; unset y2label; unset label; unset arrow; set size noratio\n", f);
}

void iso_plot_heading(FILE *f, const char *title, double y)
{
    fprintf(f,
            "unset border; unset tics; unset key; set xrange [0:1]; set yrange [0:1]\n"
            "set lmargin at screen 0; set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0\n"
            "set label 1 %s at screen 0.5,%.17g center noenhanced font ',12'\nplot NaN notitle\nunset label\n",
            QUOTED(title, 95), y);
}

void iso_plot_key(FILE *f, double x, double y, const char *entries)
{
    fprintf(f,
            "unset border; unset tics; unset label; unset arrow; unset object; unset title; unset logscale; "
            "unset grid\nunset xlabel; unset ylabel; set size noratio; set xrange [0:1]; set yrange [0:1]\n"
            "set lmargin at screen 0; set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0\n"
            "set key default; set key horizontal maxrows 1 samplen 1.4 Left reverse center center at screen "
            "%.17g,%.17g\nplot %s\nunset key\n",
            x, y, entries);
}
