/* plot.c - pictures of the tables of commands (see plot.h). */
#include "plot/plot.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "picture/picture_impl.h"
#include "plot/draw.h"

char *iso_plot_title(char title[static ISO_PLOT_TITLE], const iso_params *p, const char *more, ...)
{
    va_list args;
    va_start(args, more);
    char ball[ISO_PICTURE_BALL];
    const int used = snprintf(title, ISO_PLOT_TITLE, "%s", iso_picture_ball(ball, p));
    vsnprintf(title + used, (size_t)(ISO_PLOT_TITLE - used), more, args);
    va_end(args);
    return title;
}

bool iso_plot_has_kind(const char *name)
{
    int i = 0;
    while (iso_picture_kind(i) && strcmp(iso_picture_kind(i), name) != 0) i++;
    return iso_picture_kind(i);
}

iso_status iso_plot_table(iso_context *ctx, const iso_plot_page *page, const iso_record *table)
{
    const char *wish = iso_plot_section_wish(page);
    if (strcmp(iso_record_kind(table), "section") == 0) return plot_section(ctx, page, table);
    if (wish)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, wish, "--%s is for sections, and this is a table '%s'", wish,
                                iso_record_kind(table));
    return plot_tables(ctx, page, (const iso_record *[]){table, NULL}, NULL);
}
