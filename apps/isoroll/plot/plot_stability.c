/* plot_stability.c - two charts of traces side by side: where a rotation is stable, and the borders. */
#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

#define EDGE (2 + 1e-9) /* with equal moments a trace is -2 up to rounding */

/* Points of the grid, or of the borders, at which the trace is in (low, high]. */
static void put_part(FILE *f, const iso_record *r, const char *trace, const char *kind, double low, double high,
                     const char *name)
{
    size_t count = 0;
    fprintf(f, "$%s_%s << EOD\n", name, trace);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i), T = iso_plot_number(r, i, trace);
        if (!(T > low && T <= high) || !iso_plot_is(r, i, "kind", kind)) continue;
        fprintf(f, "%.17g %.17g\n", row[1], row[2]);
        count++;
    }
    fputs(count ? "EOD\n" : "NaN NaN\nEOD\n", f);
}

static void put_panel(FILE *f, const iso_record *r, int which)
{
    const char *name = which ? "greatest" : "least";
    put_part(f, r, name, "grid", -INFINITY, -EDGE, "inverse");
    put_part(f, r, name, "grid", -EDGE, EDGE, "stable");
    put_part(f, r, name, "grid", EDGE, INFINITY, "unstable");
    put_part(f, r, name, "border", -INFINITY, INFINITY, "border");
    fprintf(f,
            "set title 'rotation about the axis of the %s moment'\n"
            "set lmargin at screen %s; set rmargin at screen %s\nplot $stable_%s w p pt 5 ps 0.3 lc rgb '#CFE3F2' "
            "title 'stable', $inverse_%s w p pt 5 ps 0.3 lc rgb '#E69F00' title 'T < -2', $unstable_%s w p pt 5 ps "
            "0.3 lc rgb '#D55E00' title 'T > 2', $border_%s w p pt 7 ps 0.15 lc rgb 'black' title 'T = 2, -2'\n",
            name, which ? "0.56" : "0.08", which ? "0.97" : "0.49", name, name, name, name);
}

iso_status iso_plot_stability(iso_context *ctx, const char *path, const char *title, const iso_record *r)
{
    FILE *f = iso_gnuplot_open(ctx, path, 900, 480);
    fprintf(f,
            "set multiplot\nset label 1 %s noenhanced at screen 0.5,0.97 center\n"
            "set tmargin at screen 0.86; set bmargin at screen 0.2\n"
            "set key at screen 0.5,0.08 center horizontal samplen 1\nset xlabel 'k'\nset ylabel %s offset 1,0\n"
            "set tics nomirror out scale 0.6\n",
            QUOTED(title, 120), QUOTED(iso_record_name(r, 2), 8));
    for (int which = 0; which < 2; which++) put_panel(f, r, which);
    return iso_gnuplot_close(ctx, true);
}
