/* plot_curves.c - curves over a clock, or any column over another: energies, pressure and friction, the clocks. */
#include <math.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
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

void iso_plot_range(const iso_record *r, int column, double range[2])
{
    range[0] = INFINITY, range[1] = -INFINITY;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        range[0] = fmin(range[0], iso_record_const_row(r, i)[column]);
        range[1] = fmax(range[1], iso_record_const_row(r, i)[column]);
    }
}

/* The range of the curves of one axis, with room; false: it has none. */
static bool range_of(const iso_plot_panel *p, bool right, double range[2])
{
    double own[2];
    range[0] = INFINITY, range[1] = -INFINITY;
    for (int c = 0; c < p->count; c++) {
        if (p->curve[c].right != right) continue;
        iso_plot_range(p->rows, p->curve[c].column, own);
        range[0] = fmin(range[0], own[0]), range[1] = fmax(range[1], own[1]);
    }
    if (range[0] > range[1]) return false;
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
    double x[2];
    iso_plot_range(p->rows, p->over, x);
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

/* What the numbers of an axis are: the letter of its one curve, or NUMBER. */
static const char *name_of(const iso_plot_panel *p, bool right)
{
    const char *name = NULL;
    for (int c = 0; c < p->count; c++) {
        if (p->curve[c].right != right) continue;
        name = name ? NUMBER : iso_plot_symbol(iso_record_name(p->rows, (size_t)p->curve[c].column));
    }
    return name && strlen(name) <= 2 ? name : NUMBER;
}

/* The power and the shift that are taken out of the ticks stand above the axis: "μ / 10⁻⁴", "×10⁻⁴", or
 * "number − 66.7". */
static void put_y_axis(FILE *f, const iso_plot_panel *p, bool right)
{
    char name[ISO_PLOT_NAME], text[ISO_PLOT_NAME + 4];
    double range[2];
    if (!range_of(p, right, range)) return;
    if (right) fputs("set border 11\n", f);
    const iso_plot_axis axis = {.which = right ? "y2" : "y",
                                .low = range[0],
                                .high = range[1],
                                .most = p->box.top - p->box.bottom < 0.2 ? 3 : 5,
                                .name = name_of(p, right)};
    iso_plot_ticks(f, &axis, name);
    const size_t length = strlen(axis.name);
    if (strcmp(name, axis.name) == 0) return;
    const bool power = strncmp(name, axis.name, length) == 0 && strncmp(name + length, " / ", 3) == 0;
    const bool bare = power && strcmp(axis.name, NUMBER) == 0;
    snprintf(text, sizeof text, "%s%s", bare ? "×" : "", bare ? name + length + 3 : name);
    fprintf(f, "set label %d %s noenhanced tc rgb " ISO_PLOT_INK " %s at graph %d,1.0 offset %s,0.6\n", 2 + right,
            QUOTED(text, ISO_PLOT_NAME), power == right ? "left" : "right", right,
            !power  ? "0"
            : right ? "0.5"
                    : "-1");
}

void iso_plot_curves(FILE *f, const iso_plot_panel *p)
{
    for (int c = 0; c < p->count; c++) put_data(f, p, c);
    fprintf(
        f,
        "unset label; unset arrow; unset object; unset title; unset logscale; set border 3 lc rgb " ISO_PLOT_LINE "\n"
        "set grid xtics ytics back lt 1 lw 0.8 lc rgb " ISO_PLOT_GRID "; unset xlabel; unset ylabel; unset y2tics\n"
        "set key default; set key noenhanced horizontal maxrows 1 Left reverse samplen 2 at graph 1,1.03 "
        "right bottom\nset size %s\n",
        p->equal ? "ratio -1" : "noratio");
    iso_plot_place(f, &p->box);
    put_x_axis(f, p);
    for (int right = 0; right < 2; right++) put_y_axis(f, p, right);
    for (int i = 0; i < p->marks; i++) {
        const double x = number_at(p, p->mark[i], p->over);
        fprintf(f, "set arrow %d from first %.17g, graph 0 to first %.17g, graph 1 nohead " ISO_PLOT_LOST_LINE "\n",
                i + 1, x, x);
    }
    if (p->title) fprintf(f, "set label 1 %s left noenhanced at graph 0,1 offset 0,0.9\n", QUOTED(p->title, 90));
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

iso_status iso_plot_columns(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *rows,
                            const char *x, const char *y, bool equal)
{
    iso_plot_curve curve = {0, NULL, ISO_PLOT_BLUE, false};
    iso_plot_panel panel = {.rows = rows, .count = 1, .curve = &curve, .equal = equal};
    char words[100];
    int width = 900, height = equal ? 900 : 560;
    iso_gnuplot_fit(page, true, &width, &height);
    ISO_TRY(iso_plot_find(ctx, rows, 1, &x, &panel.over));
    ISO_TRY(iso_plot_find(ctx, rows, 1, &y, &curve.column));
    snprintf(words, sizeof words, "%s over %s", iso_plot_symbol(y), iso_plot_symbol(x));
    panel.title = words;
    panel.box = (iso_plot_box){95.0 / width, 1 - 55.0 / width, 60.0 / height, 1 - 85.0 / height};
    FILE *f = iso_gnuplot_open(ctx, page, width, height);
    fputs("set multiplot\n", f);
    iso_plot_words(f, iso_plot_titled(page, title), 95, 1 - 22.0 / height, "font ',12'");
    iso_plot_curves(f, &panel);
    return iso_gnuplot_close(ctx, true);
}

void iso_plot_words(FILE *f, const char *words, int longest, double y, const char *look)
{
    fprintf(f,
            ISO_PLOT_PAGE "unset key; set label 1 %s at screen 0.5,%.17g center noenhanced %s\nplot NaN notitle\n"
                          "unset label\n",
            QUOTED(words, longest), y, look);
}

void iso_plot_key(FILE *f, double x, double y, const char *entries)
{
    fprintf(f,
            ISO_PLOT_PAGE "set key default; set key horizontal maxrows 1 samplen 1.4 Left reverse center center at "
                          "screen %.17g,%.17g\nplot %s\nunset key\n",
            x, y, entries);
}
