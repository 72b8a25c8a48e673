/* plot_splitting.c - a picture of the splitting: |m| over k or the level, and the two manifolds on the section. */
#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 480, ONE_HEIGHT = 600 /* of a picture of one panel */ };
#define TOLD 10 /* errors from which on m is drawn as a spot */

/* What varies from row to row. */
static const char *name_of(const iso_record *r)
{
    return r && iso_record_rows(r) > 1 && iso_plot_number(r, 0, "k") == iso_plot_number(r, 1, "k") ? "level" : "k";
}

/* The block $rows: |m| with its error, and the kind: m > 0, m < 0, or only bounded. Counts the rows of each kind. */
enum { POSITIVE, NEGATIVE, BOUNDED, KINDS };

static void put_rows(FILE *f, const iso_record *r, size_t count[KINDS])
{
    fputs("$rows << EOD\n", f);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double at = iso_plot_number(r, i, name_of(r)), m = iso_plot_number(r, i, "m"), size = fabs(m),
                     error = iso_plot_number(r, i, "error");
        const int kind = size < TOLD * error ? BOUNDED : m > 0 ? POSITIVE : NEGATIVE;
        if (!isfinite(at) || !isfinite(m) || !(error > 0) || iso_plot_number(r, i, "zero") == 1) continue;
        fprintf(f, "%.17g %.6g %.6g %.6g %d\n", at, kind == BOUNDED ? size + error : size, size - error, size + error,
                kind);
        count[kind]++;
    }
    fputs("EOD\n", f);
}

static void put_size(FILE *f, const iso_record *r)
{
    static const char *const look[] = {":3:4 with yerrorbars pt 7 ps 0.7 lc rgb " ISO_PLOT_BLUE " title 'm > 0'",
                                       ":3:4 with yerrorbars pt 6 ps 0.8 lc rgb " ISO_PLOT_VERMILLION
                                       " title 'm < 0'",
                                       " with points pt 11 ps 1 lc rgb " ISO_PLOT_LINE " title '|m| below'"};
    const char *before = "plot";
    size_t count[KINDS] = {0};
    put_rows(f, r, count);
    fprintf(f,
            ISO_PLOT_AXES
            "set logscale y; set format y '10^{%%T}'; set xlabel %s offset 0,0.5\n"
            "set title 'slope m of the curves where they meet, at π/2' offset 0,-0.5\n"
            "set ylabel '|m| (0: no splitting)' offset 1,0; set xtics autofreq; set mxtics 2\n"
            "set key outside bottom center horizontal maxrows 1 Left reverse samplen 1 width 2 height 1\n",
            QUOTED(name_of(r), 8));
    for (int kind = 0; kind < KINDS; kind++) {
        if (count[kind] == 0) continue;
        fprintf(f, "%s $rows using ($5 == %d ? $1 : NaN):2%s", before, kind, look[kind]);
        before = ",";
    }
    if (*before == 'p') fputs("plot 1 notitle with lines lc rgb 'white'", f);
    fputs("\nunset logscale y; set format y '%g'\n", f);
}

/* name: of the number `at`. O is the unstable rotation, O' the opposite one. */
static void put_curve(FILE *f, const iso_record *curve, const char *name, double at, int axis)
{
    char number[ISO_PLOT_FRACTION];
    fputs("$curve << EOD\n", f);
    for (size_t i = 0; i < iso_record_rows(curve); i++)
        fprintf(f, "%.6f %.6f\n", iso_record_const_row(curve, i)[0], iso_record_const_row(curve, i)[1]);
    fprintf(f,
            "EOD\n" ISO_PLOT_FRAME
            "set xrange [-0.35:pi+0.35]; set xtics ('O' 0, 'π/4' pi/4, 'π/2' pi/2, '3π/4' 3*pi/4, \"O'\" pi)\n"
            "set arrow 1 from first pi/2, graph 0 to first pi/2, graph 1 nohead back dt (3,3) lw 1.2 lc "
            "rgb " ISO_PLOT_HELP
            "\nset key outside bottom center horizontal Left reverse samplen 2 width 2 height 1\n"
            "set title 'both curves on the section γ_%d\u2060 = 0, %s = %s' offset 0,-0.5\n"
            "set xlabel 'l − l(O)'; set ylabel 'M_%d\u2060 / |M|' offset 1,0\n"
            "plot $curve using 1:2 with lines lw 1.6 lc rgb " ISO_PLOT_VERMILLION
            " title 'leaves the unstable rotation O', $curve using (pi-$1):2 with lines lw 1.6 dt (12,8) lc "
            "rgb " ISO_PLOT_BLUE " title \"enters the opposite one, O'\"\n",
            axis + 1, name, iso_plot_fraction(number, at), axis + 1);
}

iso_status iso_plot_splitting(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *rows,
                              const iso_record *curve, double at, int axis)
{
    const bool both = rows && curve;
    int width = WIDTH, height = both ? HEIGHT : ONE_HEIGHT;
    iso_gnuplot_fit(page, !both, &width, &height);
    FILE *f = iso_gnuplot_open(ctx, page, width, height);
    fprintf(f, "set multiplot layout 1,%d title %s noenhanced font ',12'\n", both ? 2 : 1,
            both ? QUOTED(iso_plot_titled(page, title), 110) : TITLE(page, title, 110));
    if (rows) put_size(f, rows);
    if (curve) put_curve(f, curve, name_of(rows), at, axis);
    return iso_gnuplot_close(ctx, true);
}
