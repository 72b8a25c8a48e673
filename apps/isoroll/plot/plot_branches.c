/* plot_branches.c - a bifurcation diagram: trace and place of followed orbits over what varies. */
#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

/* A column over what varies, times a factor. Each branch is a block of its own: two empty lines between. Gives the
 * number of the last one, from 0. */
static int put_points(FILE *f, const iso_record *r, const char *name, const char *column, double factor)
{
    double branch = NAN;
    fprintf(f, "$%s << EOD\n", name);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        if (!iso_plot_is(r, i, "event", "")) continue;
        if (branch != iso_plot_number(r, i, "branch") && !isnan(branch)) fputs("\n\n", f);
        branch = iso_plot_number(r, i, "branch");
        fprintf(f, "%.17g %.17g\n", iso_record_const_row(r, i)[3], factor * iso_plot_number(r, i, column));
    }
    fputs("EOD\n", f);
    return isnan(branch) ? 0 : (int)branch - 1;
}

iso_status iso_plot_branches(iso_context *ctx, const char *path, const char *title, const iso_record *r)
{
    FILE *f = iso_gnuplot_open(ctx, path, 900, 640);
    const int last = put_points(f, r, "trace", "trace", 1);
    put_points(f, r, "place", "u", 2 / acos(-1));
    fprintf(f,
            "set multiplot\nset label 1 %s noenhanced at screen 0.5,0.97 center\nunset key\n"
            "set tics nomirror out scale 0.6\nset lmargin at screen 0.1; set rmargin at screen 0.97\n"
            "set tmargin at screen 0.93; set bmargin at screen 0.54\nset ylabel 'trace' offset 1,0\n"
            "set yrange [-6:6]\nset arrow 1 from graph 0, first 2 to graph 1, first 2 nohead dt 2 lc rgb "
            "'#707070'\nset arrow 2 from graph 0, first -2 to graph 1, first -2 nohead dt 2 lc rgb '#707070'\n"
            "plot for [i=0:%d] $trace index i w l lw 1.5 lc i\nunset arrow; set yrange [0:1]\n"
            "set tmargin at screen 0.48; set bmargin at screen 0.09\n"
            "set ylabel 'place on the line: 2 u/π' offset 1,0\nset xlabel %s\n"
            "plot for [i=0:%d] $place index i w l lw 1.5 lc i",
            QUOTED(title, 120), last, QUOTED(iso_record_name(r, 3), 8), last);
    return iso_gnuplot_close(ctx, true);
}
