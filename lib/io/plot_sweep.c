/* plot_sweep.c - pictures of sweeps: a value over one number as a curve, over two as a map. */
#include <math.h>

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

/* k = 1 and k = -1: only there the problem is integrable. */
static void mark_k(FILE *f, bool k)
{
    if (!k) return;
    for (int i = -1; i <= 1; i += 2)
        fprintf(
            f, "set arrow from first %d, graph 0 to first %d, graph 1 nohead back dt (4,3) lw 1.2 lc rgb '#707070'\n",
            i, i);
}

/* --- a curve ---------------------------------------------------------------------------------------------------- */

/* Whether sizes are drawn: the value has both signs and sizes that differ by 1e3, or positive ones by 1e4. */
static bool wants_sizes(const iso_record *rows)
{
    double least = INFINITY, most = 0;
    bool signs[2] = {false, false};
    for (size_t i = 0; i < iso_record_rows(rows); i++) {
        const double value = iso_record_const_row(rows, i)[VALUE], size = fabs(value);
        if (!isfinite(value) || value == 0) continue;
        least = fmin(least, size);
        most = fmax(most, size);
        signs[value > 0] = true;
    }
    return most > (signs[0] && signs[1] ? 1e3 : 1e4) * least;
}

/* A gap of the curve where there is no value, and at k = 0, where there is no ball. With sizes the band may not reach 0. */
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
                          bool k, const iso_record *rows)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_gnuplot *g;
    if (!rows || iso_record_columns(rows) != 4 || iso_record_rows(rows) == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a curve needs rows of x, value, low and high");
    const iso_status status = iso_gnuplot_open(ctx, path, WIDTH, CURVE_HEIGHT, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    const bool sizes = wants_sizes(rows), band = put_curve(f, rows, sizes, k);
    fputs("set title ", f);
    iso_gnuplot_text(f, title, LONGEST);
    fputs(" noenhanced\n" AXES "unset key\n", f);
    put_label(f, "xlabel", name);
    char size[48];
    snprintf(size, sizeof size, sizes ? "|%.40s|" : "%.40s", value);
    put_label(f, "ylabel", size);
    if (sizes) fputs("set logscale y; set format y '10^{%T}'\n", f);
    mark_k(f, k);
    fputs("plot ", f);
    if (band) fputs("$curve using 1:3:4 with filledcurves fc rgb " ISO_PLOT_FAR_BLUE " fs solid 0.7 noborder, ", f);
    fputs("$curve using 1:2 with linespoints pt 7 ps 0.45 lw 1.4 lc rgb " ISO_PLOT_BLUE "\n", f);
    return iso_gnuplot_close(ctx, g, true);
}

/* --- maps ------------------------------------------------------------------------------------------------------- */

/* Squares that fill the panel, as if the points were spread evenly. */
static double size_of(const iso_record *rows, int panels)
{
    const double side = 640.0 / (panels > 3 ? 3 : panels), count = fmax(1, (double)iso_record_rows(rows));
    return fmin(3, fmax(0.15, side / sqrt(count) / 9));
}

static void put_panel(FILE *f, const iso_plot_panels *p, int i)
{
    const iso_record *rows = p->rows[i];
    for (int there = 1; there >= 0; there--) {
        fprintf(f, "$%s%d << EOD\n", there ? "value" : "none", i);
        size_t count = 0;
        for (size_t r = 0; r < iso_record_rows(rows); r++) {
            const double *row = iso_record_const_row(rows, r);
            if (isfinite(row[2]) != (there == 1)) continue;
            fprintf(f, there ? "%.9g %.9g %.9g\n" : "%.9g %.9g\n", row[0], row[1], row[2]);
            count++;
        }
        if (count == 0) fputs("NaN NaN NaN\n", f);
        fputs("EOD\n", f);
    }
    fputs("set title ", f);
    iso_gnuplot_text(f, p->name[i], 40);
    const double size = size_of(rows, p->count);
    fprintf(f,
            " noenhanced\nplot $none%d using 1:2 with points pt 5 ps %.3g lc rgb '#B0B0B0', "
            "$value%d using 1:2:3 with points pt 5 ps %.3g lc palette\n",
            i, size, i, size);
}

/* One scale for all panels. */
static void put_scale(FILE *f, const iso_plot_panels *p)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < p->count; i++)
        for (size_t r = 0; r < iso_record_rows(p->rows[i]); r++) {
            const double value = iso_record_const_row(p->rows[i], r)[2];
            if (!isfinite(value)) continue;
            low = fmin(low, value);
            high = fmax(high, value);
        }
    if (!(low < high)) low = isfinite(low) ? low - 0.5 : 0, high = low + 1;
    fprintf(f, "set cbrange [%.9g:%.9g]\n", low, high);
    fputs("set palette defined (0 '#0B2E59', 1 '#0072B2', 2 '#A9CDE2', 3 '#F7E3B0', 4 '#E69F00', 5 '#A03A00')\n", f);
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
static void put_steps(FILE *f, const iso_plot_panels *p)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < p->count; i++)
        for (size_t r = 0; r < iso_record_rows(p->rows[i]); r++) {
            low = fmin(low, iso_record_const_row(p->rows[i], r)[0]);
            high = fmax(high, iso_record_const_row(p->rows[i], r)[0]);
        }
    if (!(high > low)) return;
    const double rough = (high - low) / 3.5, power = pow(10, floor(log10(rough))), digit = rough / power;
    fprintf(f, "set xtics %.6g\n", power * (digit < 2 ? 1 : digit < 5 ? 2 : 5));
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
    put_label(f, "cblabel", p->value);
    put_scale(f, p);
    put_steps(f, p);
    fputs("set colorbox user origin 0.91,0.25 size 0.015,0.5\n", f);
    mark_k(f, p->k);
    for (int i = 0; i < p->count; i++) {
        if (i % across == 0) put_label(f, "ylabel", p->y);
        put_place(f, i, across, down);
        if (i == 1) fputs("unset colorbox\n", f);
        put_panel(f, p, i);
    }
    fputs("unset multiplot\n", f);
    return iso_gnuplot_close(ctx, g, true);
}
