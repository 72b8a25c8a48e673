/* plot_trajectory.c - the picture of one trajectory: its paths on the spheres, integrals, clocks. */
#include <math.h>

#include "base/arithmetic_impl.h"
#include "io/gnuplot_impl.h"
#include "io/plot.h"
#include "io/plot_impl.h"

enum { WIDTH = 900, HEIGHT = 800, CLOCK_ROWS = 1000 };

/* Where a record has three columns side by side; all rows finite. -1, and *status says why, if not. */
static int find_path(iso_context *ctx, const iso_record *r, const char *const names[3], iso_status *status)
{
    int column[3];
    const char *missing;
    if (iso_record_rows(r) == 0)
        *status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture needs at least one row");
    else if (!iso_record_find_all(r, 3, names, column, &missing) || column[1] != column[0] + 1 ||
             column[2] != column[0] + 2)
        *status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, names[0], "a picture: no columns %s, %s, %s side by side",
                                   names[0], names[1], names[2]);
    for (size_t i = 0; *status == ISO_OK && i < iso_record_rows(r); i++)
        for (int c = 0; c < 3; c++)
            if (!isfinite(iso_record_const_row(r, i)[column[c]]))
                *status = iso_context_fail(ctx, ISO_NUMERICAL, names[c], "a picture: %s is not finite in row %zu",
                                           names[c], i + 1);
    return *status == ISO_OK ? column[0] : -1;
}

static void put_title(FILE *f, const char *title)
{
    fputs("unset border; unset tics; set xrange [0:1]; set yrange [0:1]\n"
          "set lmargin at screen 0; set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0\n"
          "set key at screen 0.5,0.408 center center horizontal maxrows 1 samplen 2 Left reverse\nset label 1 ",
          f);
    iso_gnuplot_text(f, title ? title : "", 95);
    fputs(" at screen 0.5,0.972 center noenhanced font ',12'\n"
          "plot NaN w l lw 1.8 lc rgb " ISO_PLOT_BLUE " title 'near side',"
          " NaN w l lw 1.8 lc rgb " ISO_PLOT_FAR_BLUE " title 'far side',"
          " NaN w p " ISO_PLOT_START " lc rgb 'black' title 'start',"
          " NaN w p " ISO_PLOT_END " lc rgb 'black' title 'end'\n",
          f);
}

static void put_path(FILE *f, const iso_record *r, int column, const char *left, const char *right, const char *title)
{
    fprintf(f, "set lmargin at screen %s; set rmargin at screen %s\nset title '%s'\n", left, right, title);
    iso_plot_sphere(f, r, column, NULL, 0, iso_plot_is_long(r, column));
}

/* The second column over the first. */
static void put_clocks(FILE *f, const iso_record *r)
{
    const size_t rows = iso_record_rows(r), drawn = rows < CLOCK_ROWS ? rows : CLOCK_ROWS;
    fputs("$clocks << EOD\n", f);
    for (size_t i = 0; i < drawn; i++) {
        const double *row = iso_record_const_row(r, drawn > 1 ? i * (rows - 1) / (drawn - 1) : 0);
        iso_gnuplot_pair(f, row[0], row[1]);
    }
    fputs(
        "EOD\nunset label; unset arrow; unset object; set size noratio; set border 3 lc rgb '#606060'; unset title\n"
        "unset logscale; set format '%g'; set autoscale; unset key\n"
        "set lmargin at screen 0.715; set rmargin at screen 0.975\n"
        "set tmargin at screen 0.345; set bmargin at screen 0.085\n"
        "set xtics nomirror out scale 0.6; set ytics nomirror out scale 0.6; set grid back lt 1 lw 0.8 lc rgb "
        "'#DDE1E5'\n",
        f);
    fprintf(f, "set xlabel '%s' offset 0,0.3; set ylabel '%s' offset 0.5,0\n", iso_record_name(r, 0),
            iso_record_name(r, 1));
    fputs("plot $clocks with lines lw 1.5 lc rgb " ISO_PLOT_BLUE "\n", f);
}

iso_status iso_plot_trajectory(iso_context *ctx, const char *path, const iso_plot_orbit *plot)
{
    ISO_DEFAULT_ARITHMETIC;
    static const char *const normal[] = {"n1", "n2", "n3"}, *const place[] = {"gamma1", "gamma2", "gamma3"};
    static const iso_plot_chart chart = {85, 400, "drift of integrals, relative", ""};
    iso_gnuplot *g;
    iso_status status = ISO_OK;
    const int n = plot->ball ? find_path(ctx, plot->ball, normal, &status) : -1;
    const int gamma = plot->point && status == ISO_OK ? find_path(ctx, plot->point, place, &status) : -1;
    if (status == ISO_OK && n < 0 && gamma < 0)
        status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture needs the path of the ball or of the point");
    if (status == ISO_OK) status = iso_gnuplot_open(ctx, path, WIDTH, HEIGHT, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    const bool both = n >= 0 && gamma >= 0;
    fputs("set multiplot\n", f);
    put_title(f, plot->title);
    if (n >= 0)
        put_path(f, plot->ball, n, both ? "0.01" : "0.25", both ? "0.49" : "0.75",
                 "ball: the normal n at the contact");
    if (gamma >= 0)
        put_path(f, plot->point, gamma, both ? "0.51" : "0.25", both ? "0.99" : "0.75", "point: its place γ");
    if (plot->drift) iso_plot_differences(f, plot->drift, 0, &chart);
    if (plot->clocks) put_clocks(f, plot->clocks);
    fputs("unset multiplot\nunset output\n", f);
    return iso_gnuplot_close(ctx, g, true);
}
