/* plot_stability.c - two charts of traces side by side: where a rotation is stable, and the borders. */
#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

#define EDGE (2 + 1e-9) /* with equal moments a trace is -2 up to rounding */

/* Rows of which column `c` is in (low, high]. */
static size_t put_part(FILE *f, const iso_record *r, int c, double low, double high, const char *name)
{
    size_t count = 0;
    fprintf(f, "$%s%d << EOD\n", name, c);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        if (row[c] > low && row[c] <= high) iso_gnuplot_pair(f, row[0], row[1]), count++;
    }
    if (count == 0) fputs("NaN NaN\n", f);
    fputs("EOD\n", f);
    return count;
}

static void put_borders(FILE *f, const iso_record *r, int which)
{
    size_t count = 0;
    fprintf(f, "$border%d << EOD\n", which);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        if ((int)row[0] == which) iso_gnuplot_pair(f, row[2], row[3]), count++;
    }
    if (count == 0) fputs("NaN NaN\n", f);
    fputs("EOD\n", f);
}

static void put_panel(FILE *f, const iso_record *grid, const iso_record *borders, int which)
{
    static const char *const names[] = {"least", "greatest"};
    const int c = 2 + which;
    put_part(f, grid, c, -INFINITY, -EDGE, "inverse");
    put_part(f, grid, c, -EDGE, EDGE, "stable");
    put_part(f, grid, c, EDGE, INFINITY, "unstable");
    put_borders(f, borders, which);
    fprintf(f, "set title 'rotation about the axis of the %s moment'\n", names[which]);
    fprintf(f, "set lmargin at screen %s; set rmargin at screen %s\n", which ? "0.56" : "0.08",
            which ? "0.97" : "0.49");
    fprintf(
        f,
        "plot $stable%d w p pt 5 ps 0.3 lc rgb '#CFE3F2' title 'stable', $inverse%d w p pt 5 ps 0.3 lc rgb "
        "'#E69F00' title 'T < -2', $unstable%d w p pt 5 ps 0.3 lc rgb '#D55E00' title 'T > 2', $border%d w p pt 7 "
        "ps 0.15 lc rgb 'black' title 'T = 2, -2'\n",
        c, c, c, which);
}

iso_status iso_plot_stability(iso_context *ctx, const char *path, const char *title, const char *moment,
                              const iso_record *grid, const iso_record *borders)
{
    iso_gnuplot *g;
    const iso_status status = iso_gnuplot_open(ctx, path, 900, 480, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    fputs("set multiplot\nset label 1 ", f);
    iso_gnuplot_text(f, title, 120);
    fputs(" noenhanced at screen 0.5,0.97 center\nset tmargin at screen 0.86; set bmargin at screen 0.2\n"
          "set key at screen 0.5,0.08 center horizontal samplen 1\nset xlabel 'k'\nset ylabel ",
          f);
    iso_gnuplot_text(f, moment, 8);
    fputs(" offset 1,0\nset tics nomirror out scale 0.6\n", f);
    for (int which = 0; which < 2; which++) put_panel(f, grid, borders, which);
    fputs("unset multiplot\n", f);
    return iso_gnuplot_close(ctx, g, true);
}
