/* plot.h - pictures of the tables of commands: by their kind, with their titles. */
#ifndef ISOROLL_PLOT_H
#define ISOROLL_PLOT_H

#include "base/record.h"
#include "plot/page.h"

/* Whether there is a picture of such tables ("section", "chaos", ...). */
bool iso_plot_has_kind(const char *kind);

/* Draws a table by its kind. Errors: ISO_BAD_ARGUMENT: --over or --window, and it is no section; those of
 * plot_tables. */
iso_status iso_plot_table(iso_context *ctx, const iso_plot_page *page, const iso_record *table);

#endif
