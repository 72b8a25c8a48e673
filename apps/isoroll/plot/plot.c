/* plot.c - what several pictures need: titles, and the columns of a table. */
#include "plot/plot.h"

#include <math.h>
#include <stdarg.h>

#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

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

char *iso_plot_fraction(char text[static ISO_PLOT_FRACTION], double x)
{
    snprintf(text, ISO_PLOT_FRACTION, "%.6g", x);
    for (int below = 1; below < 13; below++) {
        const double above = nearbyint(x * below);
        if (above == 0 || fabs(above) >= 100 || fabs(above / below - x) > 1e-15 * fabs(x)) continue;
        snprintf(text, ISO_PLOT_FRACTION, below > 1 ? "%.0f/%d" : "%.0f", above, below);
        break;
    }
    return text;
}

char *iso_plot_title(char title[static ISO_PLOT_TITLE], const iso_params *p, const char *more, ...)
{
    va_list args;
    va_start(args, more);
    char k[ISO_PLOT_FRACTION];
    const int used = snprintf(title, ISO_PLOT_TITLE, "k = %s, J = (%.6g, %.6g, %.6g)", iso_plot_fraction(k, p->k),
                              p->J[0], p->J[1], p->J[2]);
    vsnprintf(title + used, (size_t)(ISO_PLOT_TITLE - used), more, args);
    va_end(args);
    return title;
}

char *iso_plot_heading(char heading[static ISO_PLOT_HEADING], const char *seen, const iso_params *p)
{
    char title[ISO_PLOT_TITLE];
    snprintf(heading, ISO_PLOT_HEADING, "%s        %s", seen, iso_plot_title(title, p, "%s", ""));
    return heading;
}
