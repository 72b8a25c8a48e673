/* plot_sweep.c - pictures of sweeps: a value over one number as a curve, over two as a map. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "io/gnuplot_impl.h"
#include "io/plot.h"
#include "io/plot_impl.h"

enum { WIDTH = 900, CURVE_HEIGHT = 480, PANEL_HEIGHT = 400, LONGEST = 110 };
enum { X, VALUE, LOW, HIGH }; /* of a curve */

#define AXES                                                                                                         \
    "set border 3 lc rgb '#606060'; set tics nomirror out scale 0.6; set grid back lt 1 lw 0.8 lc rgb '#DDE1E5'\n"

static void put_label(FILE *f, const char *axis, const char *name)
{
    fprintf(f, "set %s ", axis);
    iso_gnuplot_text(f, name, 40);
    fputs(" noenhanced\n", f);
}

/* What values are there, to choose a scale. */
typedef struct spread {
    double low, high;   /* of values */
    double least, most; /* of sizes; zeros do not count */
} spread;

static const spread no_values = {INFINITY, -INFINITY, INFINITY, 0};

static void add_values(spread *s, const iso_record *rows, int column)
{
    for (size_t i = 0; i < iso_record_rows(rows); i++) {
        const double value = iso_record_const_row(rows, i)[column];
        if (!isfinite(value)) continue;
        s->low = fmin(s->low, value);
        s->high = fmax(s->high, value);
        if (value == 0) continue;
        s->least = fmin(s->least, fabs(value));
        s->most = fmax(s->most, fabs(value));
    }
}

/* k = 1 and k = -1: only there the problem is integrable. axis 0: x; 1: y. */
static void mark_k(FILE *f, const char *name, int axis, const spread *s)
{
    for (int k = -1; k <= 1; k += 2) {
        if (strcmp(name, "k") != 0 || k < s->low || k > s->high) continue;
        fprintf(f,
                axis == 0 ? "set arrow from first %d, graph 0 to first %d, graph 1"
                          : "set arrow from graph 0, first %d to graph 1, first %d",
                k, k);
        fputs(" nohead front dt (4,3) lw 1.2 lc rgb '#404040'\n", f);
    }
}

/* --- a curve ---------------------------------------------------------------------------------------------------- */

/* Whether sizes are drawn: the value has both signs and sizes that differ by 1e3, or one sign and 1e4. */
static bool wants_sizes(const spread *s)
{
    return s->most > (s->low < 0 && s->high > 0 ? 1e3 : 1e4) * s->least;
}

static void put_value_label(FILE *f, const char *axis, const char *value, bool sizes)
{
    char size[48];
    snprintf(size, sizeof size, sizes ? "|%.40s|" : "%.40s", value);
    put_label(f, axis, size);
}

/* A gap of the curve where there is no value, and at k = 0, where there is no ball. With sizes the band may not
 * reach 0. */
static bool put_curve(FILE *f, const iso_record *rows, bool sizes, bool k)
{
    bool band = false;
    fputs("$curve << EOD\n", f);
    for (size_t i = 0; i < iso_record_rows(rows); i++) {
        const double *row = iso_record_const_row(rows, i);
        double value = row[VALUE], low = row[LOW], high = row[HIGH];
        if (k && i > 0 && iso_record_const_row(rows, i - 1)[X] < 0 && row[X] > 0) fputs("\n", f);
        if (!isfinite(value)) {
            fputs("\n", f);
            continue;
        }
        if (sizes) {
            const double error = (high - low) / 2;
            value = fabs(value);
            low = fmax(value - error, value / 1e3);
            high = value + error;
        }
        if (!isfinite(low) || !isfinite(high)) low = high = value;
        band = band || high > low;
        if (sizes && !(value > 0)) continue;
        fprintf(f, "%.12g %.12g %.12g %.12g\n", row[X], value, low, high);
    }
    fputs("EOD\n", f);
    return band;
}

iso_status iso_plot_curve(iso_context *ctx, const char *path, const char *title, const char *name, const char *value,
                          const iso_record *rows)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_gnuplot *g;
    if (!rows || iso_record_columns(rows) != 4 || iso_record_rows(rows) == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a curve needs rows of x, value, low and high");
    const iso_status status = iso_gnuplot_open(ctx, path, WIDTH, CURVE_HEIGHT, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    spread x = no_values, values = no_values;
    add_values(&x, rows, X);
    add_values(&values, rows, VALUE);
    const bool sizes = wants_sizes(&values), band = put_curve(f, rows, sizes, strcmp(name, "k") == 0);
    fputs("set title ", f);
    iso_gnuplot_text(f, title, LONGEST);
    fputs(" noenhanced\n" AXES "unset key\n", f);
    put_label(f, "xlabel", name);
    put_value_label(f, "ylabel", value, sizes);
    if (sizes) fputs("set logscale y; set format y '10^{%T}'\n", f);
    mark_k(f, name, 0, &x);
    fputs("plot ", f);
    if (band) fputs("$curve using 1:3:4 with filledcurves fc rgb " ISO_PLOT_FAR_BLUE " fs solid 0.7 noborder, ", f);
    fputs("$curve using 1:2 with linespoints pt 7 ps 0.45 lw 1.4 lc rgb " ISO_PLOT_BLUE "\n", f);
    return iso_gnuplot_close(ctx, g, true);
}

/* --- maps ------------------------------------------------------------------------------------------------------- */

/* The numbers along one axis of a grid, by size. */
typedef struct line {
    double *at;
    size_t count;
} line;

static int by_size(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

/* All different numbers of a column. count = 0: no memory. */
static line line_of(const iso_record *rows, int column)
{
    line l = {malloc((iso_record_rows(rows) + 1) * sizeof(double)), 0};
    for (size_t i = 0; l.at && i < iso_record_rows(rows); i++) l.at[i] = iso_record_const_row(rows, i)[column];
    if (l.at) qsort(l.at, iso_record_rows(rows), sizeof *l.at, by_size);
    for (size_t i = 0; l.at && i < iso_record_rows(rows); i++)
        if (l.count == 0 || l.at[i] != l.at[l.count - 1]) l.at[l.count++] = l.at[i];
    return l;
}

/* The cell of x reaches half way to both neighbours. */
static void cell_of(const line *l, double x, double edge[2])
{
    size_t low = 0, high = l->count - 1;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (l->at[middle] < x)
            low = middle + 1;
        else
            high = middle;
    }
    const double before = low > 0 ? x - l->at[low - 1] : l->at[1] - x,
                 after = low + 1 < l->count ? l->at[low + 1] - x : x - l->at[low - 1];
    edge[0] = x - before / 2;
    edge[1] = x + after / 2;
}

/* Cells if the points are a grid, else squares that fill the panel as if the points were spread evenly. */
typedef struct marks {
    line x, y;
    bool cells;
    double size;
} marks;

static marks marks_of(const iso_record *rows, int panels)
{
    const double side = 640.0 / (panels > 3 ? 3 : panels), count = fmax(1, (double)iso_record_rows(rows));
    marks m = {line_of(rows, 0), line_of(rows, 1), false, fmin(3, fmax(0.15, side / sqrt(count) / 9))};
    m.cells = m.x.count > 1 && m.y.count > 1 && (double)m.x.count * (double)m.y.count < 1.2 * count;
    return m;
}

/* With sizes a value is drawn as its size. There is a last line so that no block is empty. */
static void put_points(FILE *f, const iso_record *rows, const marks *m, bool there, bool sizes)
{
    for (size_t r = 0; r < iso_record_rows(rows); r++) {
        const double *row = iso_record_const_row(rows, r), value = sizes ? fabs(row[2]) : row[2];
        double x[2] = {0}, y[2] = {0};
        if ((isfinite(value) && !(sizes && value == 0)) != there) continue;
        if (m->cells) cell_of(&m->x, row[0], x), cell_of(&m->y, row[1], y);
        fprintf(f, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", row[0], row[1], x[0], x[1], y[0], y[1], there ? value : 0);
    }
    fputs("NaN NaN NaN NaN NaN NaN NaN\n", f);
}

static void put_panel(FILE *f, const iso_plot_panels *p, int i, bool sizes)
{
    const iso_record *rows = p->rows[i];
    const marks m = marks_of(rows, p->count);
    char with[96];
    for (int there = 1; there >= 0; there--) {
        fprintf(f, "$%s%d << EOD\n", there ? "value" : "none", i);
        put_points(f, rows, &m, there, sizes);
        fputs("EOD\n", f);
    }
    if (m.cells)
        snprintf(with, sizeof with, "using 1:2:3:4:5:6:7 with boxxyerror fs solid 1 noborder lw 0");
    else
        snprintf(with, sizeof with, "using 1:2:7 with points pt 5 ps %.3g", m.size);
    fputs(m.cells ? "set autoscale noextend; set offsets graph 0.02, graph 0.02, graph 0.02, graph 0.02\n" : "", f);
    fputs("set title ", f);
    iso_gnuplot_text(f, p->name[i], 40);
    fprintf(f, " noenhanced\nplot $none%d %s lc rgb '#B0B0B0', $value%d %s lc palette\n", i, with, i, with);
    free(m.x.at);
    free(m.y.at);
}

/* One scale for all panels. */
static bool put_scale(FILE *f, const iso_plot_panels *p)
{
    spread s = no_values;
    for (int i = 0; i < p->count; i++) add_values(&s, p->rows[i], 2);
    const bool sizes = wants_sizes(&s);
    double low = sizes ? s.least : s.low, high = sizes ? s.most : s.high;
    if (!(low < high)) low = isfinite(low) ? low - 0.5 : 0, high = low + 1;
    fprintf(f, "set cbrange [%.9g:%.9g]\n", low, high);
    if (sizes) fputs("set logscale cb; set format cb '10^{%T}'\n", f);
    fputs("set palette defined (0 '#0B2E59', 1 '#0072B2', 2 '#A9CDE2', 3 '#F7E3B0', 4 '#E69F00', 5 '#A03A00')\n", f);
    put_value_label(f, "cblabel", p->value, sizes);
    return sizes;
}

/* Panels of one size, left to right, then below; the scale of colours stands on the right of all. */
static void put_place(FILE *f, int i, int across, int down)
{
    const double wide = 0.83 / across, high = 0.9 / down;
    const double left = 0.075 + wide * (i % across), bottom = 0.91 - high * (i / across + 1);
    fprintf(f, i % across == 0 ? "" : "unset ylabel\n");
    fprintf(f, "set lmargin at screen %.4f; set rmargin at screen %.4f\n", left, left + wide - 0.065);
    fprintf(f, "set bmargin at screen %.4f; set tmargin at screen %.4f\n", bottom + 0.13, bottom + high - 0.06);
}

/* About four steps of 1, 2 or 5 times a power of ten: panels are narrow. */
static void put_steps(FILE *f, const spread *x)
{
    if (!(x->high > x->low)) return;
    const double rough = (x->high - x->low) / 3.5, power = pow(10, floor(log10(rough))), digit = rough / power;
    fprintf(f, "set xtics %.6g\n", power * (digit < 2 ? 1 : digit < 5 ? 2 : 5));
}

static void put_axes(FILE *f, const iso_plot_panels *p)
{
    spread x = no_values, y = no_values;
    for (int i = 0; i < p->count; i++) {
        add_values(&x, p->rows[i], 0);
        add_values(&y, p->rows[i], 1);
    }
    put_steps(f, &x);
    mark_k(f, p->x, 0, &x);
    mark_k(f, p->y, 1, &y);
}

iso_status iso_plot_values(iso_context *ctx, const char *path, const iso_plot_panels *p)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_gnuplot *g;
    const int across = p->count > 3 ? 3 : p->count, down = p->count > 3 ? 2 : 1;
    if (p->count < 1 || p->count > ISO_PLOT_MAPS)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "%d maps: a picture has 1 to %d", p->count, ISO_PLOT_MAPS);
    const iso_status status = iso_gnuplot_open(ctx, path, WIDTH, down * PANEL_HEIGHT + (across == 1 ? 200 : 0), &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    fputs("set multiplot title ", f);
    iso_gnuplot_text(f, p->title, LONGEST);
    fputs(" noenhanced\nset border 15 lc rgb '#606060'; set tics nomirror out scale 0.6; unset key\n", f);
    put_label(f, "xlabel", p->x);
    put_label(f, "ylabel", p->y);
    const bool sizes = put_scale(f, p);
    put_axes(f, p);
    fputs("set colorbox user origin 0.865,0.25 size 0.015,0.5\n", f);
    for (int i = 0; i < p->count; i++) {
        if (i % across == 0) put_label(f, "ylabel", p->y);
        put_place(f, i, across, down);
        if (i == 1) fputs("unset colorbox\n", f);
        put_panel(f, p, i, sizes);
    }
    fputs("unset multiplot\n", f);
    return iso_gnuplot_close(ctx, g, true);
}
