/* plot.c - what several pictures need: titles, a key. */
#include "plot/plot.h"

#include <math.h>
#include <stdarg.h>

#include "picture/picture_impl.h"
#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

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

void iso_plot_key(FILE *f, double x, double y, const char *entries)
{
    fprintf(f,
            ISO_PLOT_PAGE "set key default; set key horizontal maxrows 1 samplen 1.4 Left reverse center center at "
                          "screen %.17g,%.17g\nplot %s\nunset key\n",
            x, y, entries);
}

const char *iso_plot_symbol(const char *name)
{
    return iso_picture_symbol(name);
}
