/* plot_maps.c - how sweeps are drawn: a value over one number as a curve, over two as maps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, CURVE_HEIGHT = 480, PANEL_HEIGHT = 400, LONGEST = 110 };

static double at(const iso_record *rows, size_t row, int column)
{
    return iso_record_const_row(rows, row)[column];
}

/* --- scales ----------------------------------------------------------------------------------------------------- */

static void put_label(FILE *f, const char *axis, const char *name)
{
    fprintf(f, "set %s %s noenhanced\n", axis, QUOTED(name, 40));
}

static void put_value_label(FILE *f, const char *axis, const char *value, bool sizes)
{
    char size[48];
    snprintf(size, sizeof size, sizes ? "|%.40s|" : "%.40s", value);
    put_label(f, axis, size);
}

static int by_size(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

/* The numbers of a column, to choose a scale. */
typedef struct spread {
    double low, high, least; /* least: the smallest size but 0 */
    bool sizes;              /* whether sizes are drawn        */
} spread;

/* Sizes are drawn if a tenth of them are smaller than the largest by 1e4, or by 1e3 if there are both signs. One
 * small number does not count: every smooth function that changes its sign has one. Without memory the scale is
 * even. */
static spread spread_of(const iso_record *rows, int column)
{
    spread s = {.low = INFINITY, .high = -INFINITY};
    double *size = malloc((iso_record_rows(rows) + 1) * sizeof *size);
    size_t count = 0;
    for (size_t i = 0; i < iso_record_rows(rows); i++) {
        const double x = at(rows, i, column);
        if (!isfinite(x)) continue;
        s.low = fmin(s.low, x);
        s.high = fmax(s.high, x);
        if (x != 0 && size) size[count++] = fabs(x);
    }
    if (count > 0) {
        qsort(size, count, sizeof *size, by_size);
        s.least = size[0];
        s.sizes = size[count - 1] > (s.low < 0 && s.high > 0 ? 1e3 : 1e4) * size[count / 10];
    }
    free(size);
    return s;
}

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
    double ratios[2] = {INFINITY, 0}, steps[2] = {INFINITY, 0}; /* least and largest */
    if (l->count < 4 || !(l->at[0] > 0)) return false;
    for (size_t i = 1; i < l->count; i++) {
        const double ratio = log(l->at[i] / l->at[i - 1]), step = l->at[i] - l->at[i - 1];
        ratios[0] = fmin(ratios[0], ratio), ratios[1] = fmax(ratios[1], ratio);
        steps[0] = fmin(steps[0], step), steps[1] = fmax(steps[1], step);
    }
    return ratios[1] < 1.2 * ratios[0] && steps[1] > 3 * steps[0];
}

/* count = 0: no memory. */
static line line_of(const iso_record *rows, int column)
{
    const size_t all = iso_record_rows(rows);
    line l = {.k = strcmp(iso_record_name(rows, (size_t)column), "k") == 0, .at = malloc((all + 1) * sizeof *l.at)};
    if (!l.at) return l;
    for (size_t i = 0; i < all; i++) l.at[i] = at(rows, i, column);
    qsort(l.at, all, sizeof *l.at, by_size);
    for (size_t i = 0; i < all; i++)
        if (l.count == 0 || l.at[i] != l.at[l.count - 1]) l.at[l.count++] = l.at[i];
    l.logarithmic = grows_by_ratios(&l);
    return l;
}

#define MARK "dt (4,3) lw 1.2 lc rgb " ISO_PLOT_INK
#define DASHED "k (dashed: ±1, where the free ball is integrable)"
#define MARKED ", NaN with lines " MARK " title 'k = ±1: the free ball is integrable'"

/* k = 1 and k = -1: only there the free ball is integrable. axis: "x" or "y". Says whether one is marked. */
static bool put_axis(FILE *f, const char *axis, const line *l)
{
    bool marked = false;
    if (l->logarithmic) fprintf(f, "set logscale %s; set format %s '10^{%%T}'\n", axis, axis);
    for (int k = -1; k <= 1 && l->k && l->count > 0; k += 2) {
        if (k < l->at[0] || k > l->at[l->count - 1]) continue;
        fprintf(f,
                *axis == 'x' ? "set arrow from first %d, graph 0 to first %d, graph 1"
                             : "set arrow from graph 0, first %d to graph 1, first %d",
                k, k);
        fputs(" nohead front " MARK "\n", f);
        marked = true;
    }
    return marked;
}

/* --- a curve ---------------------------------------------------------------------------------------------------- */

/* A gap of the curve where there is no value, and at k = 0, where there is no ball. With sizes the band may not
 * reach 0. Says whether there is a band. */
static bool put_curve(FILE *f, const iso_record *rows, bool sizes, bool k)
{
    bool band = false;
    fputs("$curve << EOD\n", f);
    for (size_t i = 0; i < iso_record_rows(rows); i++) {
        const double x = at(rows, i, 0);
        double value = at(rows, i, 1), low = at(rows, i, 2), high = at(rows, i, 3);
        if (k && i > 0 && at(rows, i - 1, 0) < 0 && x > 0) fputs("\n", f);
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
        if (!sizes || value > 0) fprintf(f, "%.17g %.12g %.12g %.12g\n", x, value, low, high);
    }
    fputs("EOD\n", f);
    return band;
}

iso_status iso_plot_sweep_curve(iso_context *ctx, const iso_plot_page *page, const char *title,
                                const iso_record *rows)
{
    int width = WIDTH, height = CURVE_HEIGHT;
    iso_gnuplot_fit(page, true, &width, &height);
    FILE *f = iso_gnuplot_open(ctx, page, width, height);
    const line x = line_of(rows, 0);
    const bool sizes = spread_of(rows, 1).sizes, band = put_curve(f, rows, sizes, x.k);
    fprintf(f,
            "set title %s noenhanced\n" ISO_PLOT_AXES
            "set key outside bottom center horizontal Left reverse samplen 1.6 width 2 height 1 noenhanced\n",
            TITLE(page, title, LONGEST));
    put_label(f, "xlabel", iso_record_name(rows, 0));
    put_value_label(f, "ylabel", iso_record_name(rows, 1), sizes);
    if (sizes) fputs("set logscale y; set format y '10^{%T}'\n", f);
    const bool marked = put_axis(f, "x", &x);
    free(x.at);
    fputs("plot ", f);
    if (band)
        fprintf(f,
                "$curve using 1:3:4 with filledcurves fc rgb " ISO_PLOT_FAR_BLUE " fs solid 0.7 noborder title %s, ",
                QUOTED(iso_record_name(rows, 3), 60));
    fprintf(f, "$curve using 1:2 with linespoints pt 7 ps 0.45 lw 1.4 lc rgb " ISO_PLOT_BLUE " notitle%s\n",
            marked ? MARKED : "");
    return iso_gnuplot_close(ctx, true);
}

/* --- maps ------------------------------------------------------------------------------------------------------- */

/* The points of all maps. If they are a grid, they are its cells, else squares. */
typedef struct grid {
    line x, y;
    bool cells;
    double *half; /* of the square of each row, half its side as a part of an axis */
} grid;

/* A point of a map, for the search of its neighbours; its axes go from 0 to 1. */
typedef struct spot {
    double map, x, y;
    size_t row;
} spot;

static int by_map(const void *a, const void *b)
{
    const spot *one = a, *other = b;
    return one->map != other->map ? by_size(&one->map, &other->map) : by_size(&one->x, &other->x);
}

/* The distance of a point from its nearest neighbour, the larger of both axes; 1 at most. The points are in order. */
static double nearest(const spot *all, size_t count, size_t i)
{
    double best = 1;
    for (int way = -1; way <= 1; way += 2)
        for (size_t j = i + (size_t)way; j < count && all[j].map == all[i].map; j += (size_t)way) {
            const double x = fabs(all[j].x - all[i].x), d = fmax(x, fabs(all[j].y - all[i].y));
            if (x >= best) break;
            if (d > 0) best = fmin(best, d);
        }
    return best;
}

static double range_of(const line *l)
{
    return l->count > 1 ? l->at[l->count - 1] - l->at[0] : 1;
}

/* Squares of half the way to the nearest neighbour do not overlap; `most`: of a lonely one. Without memory there are
 * none. */
static void choose_squares(const iso_record *rows, double most, grid *g)
{
    const size_t count = iso_record_rows(rows);
    spot *all = malloc((count + 1) * sizeof *all);
    g->half = calloc(count + 1, sizeof *g->half);
    for (size_t i = 0; all && i < count; i++)
        all[i] = (spot){at(rows, i, 3), at(rows, i, 0) / range_of(&g->x), at(rows, i, 1) / range_of(&g->y), i};
    if (all) qsort(all, count, sizeof *all, by_map);
    for (size_t i = 0; all && g->half && i < count; i++) g->half[all[i].row] = fmin(nearest(all, count, i) / 2, most);
    free(all);
}

static grid grid_of(const iso_plot_maps *m)
{
    grid g = {.x = line_of(m->rows, 0), .y = line_of(m->rows, 1)};
    const double count = fmax(1, (double)iso_record_rows(m->rows) / m->count);
    g.cells = g.x.count > 1 && g.y.count > 1 && (double)g.x.count * (double)g.y.count < 1.2 * count;
    if (!g.cells) choose_squares(m->rows, 0.4 / sqrt(count), &g);
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
    const double *here = bsearch(&x, l->at, l->count, sizeof x, by_size);
    const bool first = here == l->at, last = here == l->at + l->count - 1;
    const double left = here[first ? 0 : -1], right = here[last ? 0 : 1];
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

static void square_of(const line *l, double x, double half, double edge[2])
{
    edge[0] = x - half * range_of(l);
    edge[1] = x + half * range_of(l);
}

/* A block of points of one map: those with a value, or without. With sizes a value is drawn as its size. There is a
 * last line so that no block is empty. */
static void put_points(FILE *f, const iso_record *rows, int map, const grid *g, bool there, bool sizes)
{
    fprintf(f, "$%s%d << EOD\n", there ? "value" : "none", map);
    for (size_t r = 0; r < iso_record_rows(rows); r++) {
        const double *row = iso_record_const_row(rows, r), value = sizes ? fabs(row[2]) : row[2];
        double x[2] = {0}, y[2] = {0};
        if ((isfinite(value) && !(sizes && value == 0)) != there || row[3] != map) continue;
        if (g->cells)
            cell_of(&g->x, row[0], x), cell_of(&g->y, row[1], y);
        else
            square_of(&g->x, row[0], g->half ? g->half[r] : 0, x),
                square_of(&g->y, row[1], g->half ? g->half[r] : 0, y);
        fprintf(f, "%.17g %.17g %.9g %.17g %.17g %.17g %.17g\n", row[0], row[1], there ? value : 0, x[0], x[1], y[0],
                y[1]);
    }
    fputs("NaN NaN NaN NaN NaN NaN NaN\nEOD\n", f);
}

static void put_map(FILE *f, const iso_plot_maps *m, int i, const grid *g, bool sizes)
{
    const char *with = "using 1:2:4:5:6:7:3 with boxxyerror fs solid 1 noborder lw 0";
    char name[80] = "", number[ISO_PLOT_FRACTION];
    if (m->key_name) snprintf(name, sizeof name, "%s = %s", m->key_name, iso_plot_fraction(number, m->key[i]));
    for (int there = 1; there >= 0; there--) put_points(f, m->rows, i, g, there, sizes);
    fputs("set autoscale noextend; set offsets graph 0.02, graph 0.02, graph 0.02, graph 0.02\n", f);
    fprintf(f, "set title %s noenhanced\nplot $none%d %s lc rgb " ISO_PLOT_GREY ", $value%d %s lc palette\n",
            QUOTED(name, 40), i, with, i, with);
}

/* One scale for all maps. Says whether it is of sizes. */
static bool put_scale(FILE *f, const iso_record *rows)
{
    const spread s = spread_of(rows, 2);
    double low = s.sizes ? s.least : s.low, high = s.sizes ? fmax(fabs(s.low), fabs(s.high)) : s.high;
    if (!(low < high)) low = isfinite(low) ? low : 0, high = low + 1;
    fprintf(f, "set cbrange [%.9g:%.9g]\n%sset colorbox user origin 0.865,0.25 size 0.015,0.5\n", low, high,
            s.sizes ? "set logscale cb; set format cb '10^{%T}'\n" : "");
    iso_plot_put_scale(f, 1);
    put_value_label(f, "cblabel", iso_record_name(rows, 2), s.sizes);
    return s.sizes;
}

/* Maps of one size, left to right, then below; the scale of colours stands on the right of all. */
static void put_place(FILE *f, int i, int across, int down, bool titled)
{
    const double wide = 0.83 / across, high = 0.9 / down;
    const double left = 0.075 + wide * (i % across), bottom = 0.91 - high * (i / across + 1);
    fprintf(f,
            "set lmargin at screen %.4f; set rmargin at screen %.4f\n"
            "set bmargin at screen %.4f; set tmargin at screen %.4f\n",
            left, left + wide - 0.065, bottom + 0.13, bottom + high - (titled ? 0.06 : 0));
}

/* About four steps of 1, 2 or 5 times a power of ten: maps are narrow. */
static void put_steps(FILE *f, const line *x)
{
    if (x->logarithmic || x->count < 2) return;
    const double rough = (x->at[x->count - 1] - x->at[0]) / 3.5, power = pow(10, floor(log10(rough))),
                 digit = rough / power;
    fprintf(f, "set xtics %.6g\n", power * (digit < 2 ? 1 : digit < 5 ? 2 : 5));
}

iso_status iso_plot_sweep_maps(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_plot_maps *m)
{
    const int across = m->count > 3 ? 3 : m->count, down = m->count > 3 ? 2 : 1;
    FILE *f = iso_gnuplot_open(ctx, page, WIDTH, down * PANEL_HEIGHT + (across == 1 ? 200 : 0));
    const grid points = grid_of(m);
    fprintf(f,
            "set multiplot title %s noenhanced\nset border 15 lc rgb " ISO_PLOT_LINE
            "; set tics nomirror out scale 0.6; "
            "unset key\n",
            QUOTED(iso_plot_titled(page, title), LONGEST));
    put_label(f, "xlabel", iso_record_name(m->rows, 0));
    const bool sizes = put_scale(f, m->rows);
    put_steps(f, &points.x);
    if (put_axis(f, "x", &points.x)) put_label(f, "xlabel", DASHED);
    const char *up = put_axis(f, "y", &points.y) ? DASHED : iso_record_name(m->rows, 1);
    for (int i = 0; i < m->count; i++) {
        if (i % across == 0) put_label(f, "ylabel", up);
        if (i % across == 1) fputs("unset ylabel\n", f);
        if (i == 1) fputs("unset colorbox\n", f);
        put_place(f, i, across, down, m->key_name != NULL);
        put_map(f, m, i, &points, sizes);
    }
    free(points.x.at);
    free(points.y.at);
    free(points.half);
    return iso_gnuplot_close(ctx, true);
}
