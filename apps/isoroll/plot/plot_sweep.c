/* plot_sweep.c - pictures of sweeps: a value over one number as a curve, over two as a map. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

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

/* What numbers are there, to choose a scale. */
typedef struct spread {
    double low, high;
    double *size; /* of numbers other than 0 */
    size_t sizes, room;
} spread;

static const spread no_numbers = {INFINITY, -INFINITY, NULL, 0, 0};

/* Without memory for their sizes the scale is even. */
static void add_numbers(spread *s, const iso_record *rows, int column)
{
    const size_t room = s->sizes + iso_record_rows(rows);
    double *more = room > 0 ? realloc(s->size, room * sizeof *more) : NULL;
    if (more) s->size = more;
    for (size_t i = 0; i < iso_record_rows(rows); i++) {
        const double x = iso_record_const_row(rows, i)[column];
        if (!isfinite(x)) continue;
        s->low = fmin(s->low, x);
        s->high = fmax(s->high, x);
        if (x != 0 && more) s->size[s->sizes++] = fabs(x);
    }
}

static int by_size(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

/* Whether sizes are drawn: a tenth of them are smaller than the largest by 1e4, or by 1e3 if there are both signs.
 * One small number does not count: every smooth function that changes its sign has one. Frees the sizes; *least: the
 * smallest of them. */
static bool wants_sizes(spread *s, double *least)
{
    bool wants = false;
    if (s->sizes > 0) {
        qsort(s->size, s->sizes, sizeof *s->size, by_size);
        *least = s->size[0];
        wants = s->size[s->sizes - 1] > (s->low < 0 && s->high > 0 ? 1e3 : 1e4) * s->size[s->sizes / 10];
    }
    free(s->size);
    s->size = NULL;
    return wants;
}

/* --- axes ------------------------------------------------------------------------------------------------------- */

/* The numbers along one axis, each once, by size. */
typedef struct line {
    double *at;
    size_t count;
    bool logarithmic; /* they grow by equal ratios, not by equal steps */
    bool k;
} line;

/* Ratios that differ by little, steps that differ by much. */
static bool grows_by_ratios(const line *l)
{
    double least_ratio = INFINITY, most_ratio = 0, least_step = INFINITY, most_step = 0;
    if (l->count < 4 || !(l->at[0] > 0)) return false;
    for (size_t i = 1; i < l->count; i++) {
        const double ratio = log(l->at[i] / l->at[i - 1]), step = l->at[i] - l->at[i - 1];
        least_ratio = fmin(least_ratio, ratio);
        most_ratio = fmax(most_ratio, ratio);
        least_step = fmin(least_step, step);
        most_step = fmax(most_step, step);
    }
    return most_ratio < 1.2 * least_ratio && most_step > 3 * least_step;
}

/* count = 0: no memory. */
static line line_of(const iso_record *const rows[], int records, int column, const char *name)
{
    line l = {.k = strcmp(name, "k") == 0};
    size_t all = 0, used = 0;
    for (int r = 0; r < records; r++) all += iso_record_rows(rows[r]);
    l.at = malloc((all + 1) * sizeof *l.at);
    for (int r = 0; l.at && r < records; r++)
        for (size_t i = 0; i < iso_record_rows(rows[r]); i++) l.at[used++] = iso_record_const_row(rows[r], i)[column];
    if (l.at) qsort(l.at, used, sizeof *l.at, by_size);
    for (size_t i = 0; i < used; i++)
        if (l.count == 0 || l.at[i] != l.at[l.count - 1]) l.at[l.count++] = l.at[i];
    l.logarithmic = grows_by_ratios(&l);
    return l;
}

/* k = 1 and k = -1: only there the problem is integrable. axis: "x" or "y". */
static void put_axis(FILE *f, const char *axis, const line *l)
{
    if (l->logarithmic) fprintf(f, "set logscale %s; set format %s '10^{%%T}'\n", axis, axis);
    for (int k = -1; k <= 1 && l->k && l->count > 0; k += 2) {
        if (k < l->at[0] || k > l->at[l->count - 1]) continue;
        fprintf(f,
                *axis == 'x' ? "set arrow from first %d, graph 0 to first %d, graph 1"
                             : "set arrow from graph 0, first %d to graph 1, first %d",
                k, k);
        fputs(" nohead front dt (4,3) lw 1.2 lc rgb '#404040'\n", f);
    }
}

/* --- a curve ---------------------------------------------------------------------------------------------------- */

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
        fprintf(f, "%.17g %.12g %.12g %.12g\n", row[X], value, low, high);
    }
    fputs("EOD\n", f);
    return band;
}

iso_status iso_plot_sweep_curve(iso_context *ctx, const char *path, const char *title, const char *name,
                                const char *value, const iso_record *rows)
{
    iso_gnuplot *g;
    if (!rows || iso_record_columns(rows) != 4 || iso_record_rows(rows) == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a curve needs rows of x, value, low and high");
    const iso_status status = iso_gnuplot_open(ctx, path, WIDTH, CURVE_HEIGHT, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    const line x = line_of(&rows, 1, X, name);
    spread values = no_numbers;
    double least;
    add_numbers(&values, rows, VALUE);
    const bool sizes = wants_sizes(&values, &least), band = put_curve(f, rows, sizes, x.k);
    fputs("set title ", f);
    iso_gnuplot_text(f, title, LONGEST);
    fputs(" noenhanced\n" AXES "unset key\n", f);
    put_label(f, "xlabel", name);
    put_value_label(f, "ylabel", value, sizes);
    if (sizes) fputs("set logscale y; set format y '10^{%T}'\n", f);
    put_axis(f, "x", &x);
    free(x.at);
    fputs("plot ", f);
    if (band) fputs("$curve using 1:3:4 with filledcurves fc rgb " ISO_PLOT_FAR_BLUE " fs solid 0.7 noborder, ", f);
    fputs("$curve using 1:2 with linespoints pt 7 ps 0.45 lw 1.4 lc rgb " ISO_PLOT_BLUE "\n", f);
    return iso_gnuplot_close(ctx, g, true);
}

/* --- maps ------------------------------------------------------------------------------------------------------- */

/* The points of all panels: cells if they are a grid, else squares that fill a panel as if they were spread evenly. */
typedef struct grid {
    line x, y;
    bool cells;
    double size; /* of a square */
} grid;

static grid grid_of(const iso_plot_panels *p)
{
    grid g = {.x = line_of(p->rows, p->count, 0, p->x), .y = line_of(p->rows, p->count, 1, p->y)};
    size_t points = 0;
    for (int i = 0; i < p->count; i++) points += iso_record_rows(p->rows[i]);
    const double side = 640.0 / (p->count > 3 ? 3 : p->count), count = fmax(1, (double)points / p->count);
    g.size = fmin(3, fmax(0.15, side / sqrt(count) / 9));
    g.cells = g.x.count > 1 && g.y.count > 1 && (double)g.x.count * (double)g.y.count < 1.2 * count;
    return g;
}

/* Half way to a neighbour, but not across k = 0, and not much farther than to the other neighbour. */
static double edge_of(const line *l, double x, double step, double other)
{
    const double half = (fabs(step) < 1.5 * fabs(other) ? step : copysign(1.5 * other, step)) / 2;
    return l->k && x * (x + half) < 0 ? 0 : x + half;
}

/* Of a logarithmic axis the steps are those of the logarithm. */
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
    const bool first = low == 0, last = low + 1 == l->count;
    const double left = l->at[first ? 0 : low - 1], right = l->at[last ? low : low + 1];
    if (l->logarithmic) {
        const double before = first ? right / x : x / left, after = last ? before : right / x;
        edge[0] = x / sqrt(before);
        edge[1] = x * sqrt(after);
        return;
    }
    const double before = first ? right - x : x - left, after = last ? x - left : right - x;
    edge[0] = edge_of(l, x, -before, after);
    edge[1] = edge_of(l, x, after, before);
}

/* With sizes a value is drawn as its size. There is a last line so that no block is empty. */
static void put_points(FILE *f, const iso_record *rows, const grid *g, bool there, bool sizes)
{
    for (size_t r = 0; r < iso_record_rows(rows); r++) {
        const double *row = iso_record_const_row(rows, r), value = sizes ? fabs(row[2]) : row[2];
        double x[2] = {0}, y[2] = {0};
        if ((isfinite(value) && !(sizes && value == 0)) != there) continue;
        if (g->cells) cell_of(&g->x, row[0], x), cell_of(&g->y, row[1], y);
        fprintf(f, "%.17g %.17g %.9g ", row[0], row[1], there ? value : 0);
        fprintf(f, "%.17g %.17g %.17g %.17g\n", x[0], x[1], y[0], y[1]);
    }
    fputs("NaN NaN NaN NaN NaN NaN NaN\n", f);
}

static void put_panel(FILE *f, const iso_plot_panels *p, int i, const grid *g, bool sizes)
{
    char with[96];
    for (int there = 1; there >= 0; there--) {
        fprintf(f, "$%s%d << EOD\n", there ? "value" : "none", i);
        put_points(f, p->rows[i], g, there, sizes);
        fputs("EOD\n", f);
    }
    if (g->cells)
        snprintf(with, sizeof with, "using 1:2:4:5:6:7:3 with boxxyerror fs solid 1 noborder lw 0");
    else
        snprintf(with, sizeof with, "using 1:2:3 with points pt 5 ps %.3g", g->size);
    fputs(g->cells ? "set autoscale noextend; set offsets graph 0.02, graph 0.02, graph 0.02, graph 0.02\n" : "", f);
    fputs("set title ", f);
    iso_gnuplot_text(f, p->name[i], 40);
    fprintf(f, " noenhanced\nplot $none%d %s lc rgb '#B0B0B0', $value%d %s lc palette\n", i, with, i, with);
}

/* One scale for all panels. */
static bool put_scale(FILE *f, const iso_plot_panels *p)
{
    spread s = no_numbers;
    double least = 0;
    for (int i = 0; i < p->count; i++) add_numbers(&s, p->rows[i], 2);
    const bool sizes = wants_sizes(&s, &least);
    double low = sizes ? least : s.low, high = sizes ? fmax(fabs(s.low), fabs(s.high)) : s.high;
    if (!(low < high)) low = isfinite(low) ? low : 0, high = low + 1;
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
static void put_steps(FILE *f, const line *x)
{
    if (x->logarithmic || x->count < 2) return;
    const double rough = (x->at[x->count - 1] - x->at[0]) / 3.5, power = pow(10, floor(log10(rough))),
                 digit = rough / power;
    fprintf(f, "set xtics %.6g\n", power * (digit < 2 ? 1 : digit < 5 ? 2 : 5));
}

iso_status iso_plot_sweep_maps(iso_context *ctx, const char *path, const iso_plot_panels *p)
{
    iso_gnuplot *g;
    const int across = p->count > 3 ? 3 : p->count, down = p->count > 3 ? 2 : 1;
    if (p->count < 1 || p->count > ISO_PLOT_MAPS)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "%d maps: a picture has 1 to %d", p->count, ISO_PLOT_MAPS);
    const iso_status status = iso_gnuplot_open(ctx, path, WIDTH, down * PANEL_HEIGHT + (across == 1 ? 200 : 0), &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    const grid points = grid_of(p);
    fputs("set multiplot title ", f);
    iso_gnuplot_text(f, p->title, LONGEST);
    fputs(" noenhanced\nset border 15 lc rgb '#606060'; set tics nomirror out scale 0.6; unset key\n", f);
    put_label(f, "xlabel", p->x);
    put_label(f, "ylabel", p->y);
    const bool sizes = put_scale(f, p);
    put_steps(f, &points.x);
    put_axis(f, "x", &points.x);
    put_axis(f, "y", &points.y);
    fputs("set colorbox user origin 0.865,0.25 size 0.015,0.5\n", f);
    for (int i = 0; i < p->count; i++) {
        if (i % across == 0) put_label(f, "ylabel", p->y);
        put_place(f, i, across, down);
        if (i == 1) fputs("unset colorbox\n", f);
        put_panel(f, p, i, &points, sizes);
    }
    free(points.x.at);
    free(points.y.at);
    fputs("unset multiplot\n", f);
    return iso_gnuplot_close(ctx, g, true);
}
