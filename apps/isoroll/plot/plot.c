/* plot.c - pictures of the tables of commands (see plot.h). */
#include "plot/plot.h"

#include <string.h>

#include "embedded.h"
#include "picture/picture_impl.h"
#include "plot/draw.h"

bool iso_plot_has_kind(const char *name)
{
    int i = 0;
    while (iso_picture_kind(i) && strcmp(iso_picture_kind(i), name) != 0) i++;
    return iso_picture_kind(i) || embedded_find(picture_files, name)->name;
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
