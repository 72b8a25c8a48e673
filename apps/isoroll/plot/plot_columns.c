/* plot_columns.c - one column over another. */
#include <stdio.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900 };

iso_status iso_plot_columns(iso_context *ctx, const char *path, const char *title, const iso_record *rows,
                            const char *x, const char *y, bool equal)
{
    iso_plot_curve curve = {0, NULL, ISO_PLOT_BLUE, false};
    int over;
    char words[100];
    const int height = equal ? 900 : 560;
    iso_status status = iso_plot_find(ctx, rows, 1, &x, &over);
    if (status == ISO_OK) status = iso_plot_find(ctx, rows, 1, &y, &curve.column);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_open(ctx, path, WIDTH, height);
    snprintf(words, sizeof words, "%s over %s", iso_plot_symbol(y), iso_plot_symbol(x));
    fputs("set multiplot\n", f);
    iso_plot_heading(f, title, 1 - 22.0 / height);
    iso_plot_curves(f, &(iso_plot_panel){.box = {95.0 / WIDTH, 1 - 55.0 / WIDTH, 60.0 / height, 1 - 85.0 / height},
                                         .rows = rows,
                                         .over = over,
                                         .count = 1,
                                         .curve = &curve,
                                         .title = words,
                                         .equal = equal});
    return iso_gnuplot_close(ctx, true);
}
