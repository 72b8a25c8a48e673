/* plot.c - the picture of a comparison: two spheres, and a chart of differences below. */
#include "plot/plot.h"

#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 800 };

/* The title, and the key of the spheres, which stands between them and the chart: a plot of its own, as wide as the
 * page. */
static void put_heading(FILE *f, const char *title)
{
    fputs("unset border; unset tics; set xrange [0:1]; set yrange [0:1]\n"
          "set lmargin at screen 0; set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0\n"
          "set key at screen 0.5,0.408 center center horizontal maxrows 1 samplen 2 Left reverse\n"
          "set label 1 ",
          f);
    iso_gnuplot_text(f, title ? title : "", 95);
    fputs(" at screen 0.5,0.972 center noenhanced font ',12'\n"
          "plot NaN w l lw 1.8 lc rgb " ISO_PLOT_BLUE " title 'backend ball',"
          " NaN w p pt 6 ps 0.85 lw 1.5 lc rgb " ISO_PLOT_VERMILLION " title 'backend point',"
          " NaN w p " ISO_PLOT_START " lc rgb 'black' title 'start',"
          " NaN w p " ISO_PLOT_END " lc rgb 'black' title 'end',"
          " NaN w l lw 1.8 lc rgb " ISO_PLOT_FAR_BLUE " title 'far side'\n",
          f);
}

static iso_status check_finite(iso_context *ctx, const iso_record *r, const int column[], int count)
{
    for (size_t i = 0; i < iso_record_rows(r); i++)
        for (int c = 0; c < count; c++)
            if (!isfinite(iso_record_const_row(r, i)[column[c]]))
                return iso_context_fail(ctx, ISO_NUMERICAL, iso_record_name(r, (size_t)column[c]),
                                        "a picture: %s is not finite in row %zu",
                                        iso_record_name(r, (size_t)column[c]), i + 1);
    return ISO_OK;
}

/* Where a backend's record has n and gamma. */
static iso_status find_vectors(iso_context *ctx, const iso_record *r, int *n, int *gamma)
{
    static const char *const names[] = {"n1", "n2", "n3", "gamma1", "gamma2", "gamma3"};
    const char *missing;
    int column[6];
    if (!r || iso_record_rows(r) == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture needs at least one row");
    if (!iso_record_find_all(r, 6, names, column, &missing))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, missing, "a picture: the record has no column %s", missing);
    for (int i = 0; i < 6; i++)
        if (column[i] != column[i / 3 * 3] + i % 3)
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, names[i], "a picture: column %s is out of order",
                                    names[i]);
    *n = column[0];
    *gamma = column[3];
    return check_finite(ctx, r, column, 6);
}

static iso_status check_differences(iso_context *ctx, const iso_plot *plot)
{
    const iso_record *r = plot->difference;
    int column[ISO_PLOT_DIFFERENCES + 1];
    for (int c = 0; c <= ISO_PLOT_DIFFERENCES; c++) column[c] = c;
    if (!r || iso_record_rows(r) == 0 || iso_record_columns(r) < 2 ||
        iso_record_columns(r) > ISO_PLOT_DIFFERENCES + 1)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture needs 1 to %d columns of differences",
                                ISO_PLOT_DIFFERENCES);
    if (!(plot->tolerance >= 0 && plot->tolerance <= 1))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "tolerance", "a picture: the tolerance must be in [0, 1]");
    return check_finite(ctx, r, column, (int)iso_record_columns(r));
}

iso_status iso_plot_check_format(iso_context *ctx, const char *path)
{
    return iso_gnuplot_check_format(ctx, path);
}

iso_status iso_plot_comparison(iso_context *ctx, const char *path, const iso_plot *plot)
{
    int n[2], gamma[2];
    iso_gnuplot *g;
    iso_status status = find_vectors(ctx, plot->ball, &n[0], &gamma[0]);
    if (status == ISO_OK) status = find_vectors(ctx, plot->point, &n[1], &gamma[1]);
    if (status == ISO_OK) status = check_differences(ctx, plot);
    if (status == ISO_OK) status = iso_gnuplot_open(ctx, path, WIDTH, HEIGHT, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    const bool fine = iso_plot_is_long(plot->ball, n[0]) || iso_plot_is_long(plot->ball, gamma[0]);
    fputs("set multiplot\n", f);
    put_heading(f, plot->title);
    static const iso_plot_box left = {0.01, 0.49, 0.43, 0.905}, right = {0.51, 0.99, 0.43, 0.905};
    fputs("set title 'ball: the normal n at the contact'\n", f);
    iso_plot_sphere(f, &left, plot->ball, n[0], plot->point, n[1], fine);
    fputs("set title 'point: its place γ'\n", f);
    iso_plot_sphere(f, &right, plot->ball, gamma[0], plot->point, gamma[1], fine);
    static const iso_plot_chart chart = {
        {0.095, 0.78, 0.085, 0.34}, "relative difference of the two computations", ", in the units of the scene"};
    iso_plot_differences(f, plot->difference, plot->tolerance, &chart);
    fputs("unset multiplot\nunset output\n", f);
    return iso_gnuplot_close(ctx, g, true);
}
