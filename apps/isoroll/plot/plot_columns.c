/* plot_columns.c - one column over another. */
#include <math.h>
#include <stdio.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900 };

static iso_status find_column(iso_context *ctx, const iso_record *r, const char *name, int *column)
{
    *column = iso_record_find(r, name);
    if (*column < 0) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "a picture: there is no column '%s'", name);
    for (size_t i = 0; i < iso_record_rows(r); i++)
        if (!isfinite(iso_record_const_row(r, i)[*column]))
            return iso_context_fail(ctx, ISO_NUMERICAL, name, "a picture: %s is not finite in row %zu", name, i + 1);
    return ISO_OK;
}

iso_status iso_plot_columns(iso_context *ctx, const char *path, const char *title, const iso_record *rows,
                            const char *x, const char *y, bool equal)
{
    iso_gnuplot *g;
    iso_plot_curve curve = {0, NULL, ISO_PLOT_BLUE, false};
    int over = -1;
    char words[100];
    const int height = equal ? 900 : 560;
    iso_status status = iso_record_rows(rows) > 0
                            ? find_column(ctx, rows, x, &over)
                            : iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture needs at least one row");
    if (status == ISO_OK) status = find_column(ctx, rows, y, &curve.column);
    if (status == ISO_OK) status = iso_gnuplot_open(ctx, path, WIDTH, height, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
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
    fputs("unset multiplot\nunset output\n", f);
    return iso_gnuplot_close(ctx, g, true);
}
