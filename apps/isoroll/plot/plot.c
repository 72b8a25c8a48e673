/* plot.c - the picture of a comparison: two spheres, and a chart of differences below. */
#include "plot/plot.h"

#include <math.h>
#include <stdarg.h>

#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 800 };

/* The title, and the key of the spheres, which stands between them and the chart. */
static void put_heading(FILE *f, const char *title)
{
    fprintf(
        f,
        "set multiplot\n" ISO_PLOT_PAGE
        "set key at screen 0.5,0.408 center center horizontal maxrows 1 samplen 2 Left reverse\n"
        "set label 1 %s at screen 0.5,0.972 center noenhanced font ',12'\nplot NaN w l lw 1.8 lc rgb " ISO_PLOT_BLUE
        " title 'backend ball', NaN w p pt 6 ps 0.85 lw 1.5 lc rgb " ISO_PLOT_VERMILLION
        " title 'backend point', " ISO_PLOT_ENDS ", NaN w l lw 1.8 lc rgb " ISO_PLOT_FAR_BLUE " title 'far side'\n",
        QUOTED(title, 95));
}

const char *const iso_plot_normal[3] = {"n1", "n2", "n3"}, *const iso_plot_place_of_point[3] = {"gamma1", "gamma2",
                                                                                                "gamma3"};

iso_status iso_plot_find(iso_context *ctx, const iso_record *r, int count, const char *const names[], int *first)
{
    *first = -1;
    if (!r || iso_record_rows(r) == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture needs at least one row");
    const int found = iso_record_find(r, names[0]);
    for (int c = 0; c < count; c++)
        if (found < 0 || iso_record_find(r, names[c]) != found + c)
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, names[c], "a picture: there is no column '%s'%s", names[c],
                                    c > 0 ? " behind the one before" : "");
    for (size_t i = 0; i < iso_record_rows(r); i++)
        for (int c = 0; c < count; c++)
            if (!isfinite(iso_record_const_row(r, i)[found + c]))
                return iso_context_fail(ctx, ISO_NUMERICAL, names[c], "a picture: %s is not finite in row %zu",
                                        names[c], i + 1);
    *first = found;
    return ISO_OK;
}

static iso_status check_differences(iso_context *ctx, const iso_plot *plot)
{
    const iso_record *r = plot->difference;
    const char *names[ISO_PLOT_DIFFERENCES + 1];
    int first;
    if (!r || iso_record_rows(r) == 0 || iso_record_columns(r) < 2 ||
        iso_record_columns(r) > ISO_PLOT_DIFFERENCES + 1)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture needs 1 to %d columns of differences",
                                ISO_PLOT_DIFFERENCES);
    if (!(plot->tolerance >= 0 && plot->tolerance <= 1))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "tolerance", "a picture: the tolerance must be in [0, 1]");
    for (size_t c = 0; c < iso_record_columns(r); c++) names[c] = iso_record_name(r, c);
    return iso_plot_find(ctx, r, (int)iso_record_columns(r), names, &first);
}

char *iso_plot_title(char title[static ISO_PLOT_TITLE], const iso_params *p, const char *more, ...)
{
    va_list args;
    va_start(args, more);
    const int used = snprintf(title, ISO_PLOT_TITLE, "k = %.6g, J = %.6g %.6g %.6g", p->k, p->J[0], p->J[1], p->J[2]);
    vsnprintf(title + used, (size_t)(ISO_PLOT_TITLE - used), more, args);
    va_end(args);
    return title;
}

iso_status iso_plot_comparison(iso_context *ctx, const char *path, const iso_plot *plot)
{
    int n[2], gamma[2];
    const iso_record *const model[] = {plot->ball, plot->point};
    for (int m = 0; m < 2; m++) {
        ISO_TRY(iso_plot_find(ctx, model[m], 3, iso_plot_normal, &n[m]));
        ISO_TRY(iso_plot_find(ctx, model[m], 3, iso_plot_place_of_point, &gamma[m]));
    }
    ISO_TRY(check_differences(ctx, plot));
    FILE *f = iso_gnuplot_open(ctx, path, WIDTH, HEIGHT);
    const bool fine = iso_plot_is_long(plot->ball, n[0]) || iso_plot_is_long(plot->ball, gamma[0]);
    put_heading(f, plot->title);
    static const iso_plot_box left = {0.01, 0.49, 0.43, 0.905}, right = {0.51, 0.99, 0.43, 0.905},
                              below = {0.095, 0.78, 0.085, 0.34};
    fputs("set title 'ball: the normal n at the contact'\n", f);
    iso_plot_sphere(f, &left, plot->ball, n[0], plot->point, n[1], fine);
    fputs("set title 'point: its place γ'\n", f);
    iso_plot_sphere(f, &right, plot->ball, gamma[0], plot->point, gamma[1], fine);
    iso_plot_differences(f, plot->difference, plot->tolerance, &below, "relative difference of the two computations",
                         ", in the units of the scene");
    return iso_gnuplot_close(ctx, true);
}
