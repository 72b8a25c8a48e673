/* plot_branches.c - a bifurcation diagram: trace and place of followed orbits over what varies. */
#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

/* Each branch is a block of its own: two empty lines between. */
static void put_points(FILE *f, const iso_record *r, int column, const char *name)
{
    fprintf(f, "$%s << EOD\n", name);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        if (i > 0 && row[0] != iso_record_const_row(r, i - 1)[0]) fputs("\n\n", f);
        iso_gnuplot_pair(f, row[1], row[column]);
    }
    fputs("EOD\n", f);
}

iso_status iso_plot_branches(iso_context *ctx, const char *path, const char *title, const char *parameter,
                             const iso_record *points)
{
    iso_gnuplot *g;
    if (iso_record_rows(points) == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "points", "there is nothing to draw");
    const iso_status status = iso_gnuplot_open(ctx, path, 900, 640, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    const double branches = iso_record_const_row(points, iso_record_rows(points) - 1)[0];
    put_points(f, points, 3, "trace");
    put_points(f, points, 2, "place");
    fputs("set multiplot\nset label 1 ", f);
    iso_gnuplot_text(f, title, 120);
    fputs(
        " noenhanced at screen 0.5,0.97 center\nunset key\nset tics nomirror out scale 0.6\nset lmargin at screen "
        "0.1; "
        "set rmargin at screen 0.97\nset tmargin at screen 0.93; set bmargin at screen 0.54\nset ylabel 'trace' "
        "offset "
        "1,0\nset yrange [-6:6]\nset arrow 1 from graph 0, first 2 to graph 1, first 2 nohead dt 2 lc rgb '#707070'\n"
        "set arrow 2 from graph 0, first -2 to graph 1, first -2 nohead dt 2 lc rgb '#707070'\n",
        f);
    fprintf(f, "plot for [i=0:%d] $trace index i w l lw 1.5 lc i\n", (int)branches);
    fputs("unset arrow; set yrange [0:1]\nset tmargin at screen 0.48; set bmargin at screen 0.09\nset ylabel 'place "
          "on the line: 2 u/π' offset 1,0\nset xlabel ",
          f);
    iso_gnuplot_text(f, parameter, 8);
    fprintf(f, "\nplot for [i=0:%d] $place index i w l lw 1.5 lc i\nunset multiplot\n", (int)branches);
    return iso_gnuplot_close(ctx, g, true);
}
