/* plot_table.h - pictures of the tables that commands write, without computing anew. */
#ifndef ISOROLL_PLOT_TABLE_H
#define ISOROLL_PLOT_TABLE_H

#include "isoroll.h"

/* Whether there is a picture of such tables ("section", "chaos", ...); trajectories and sweeps have their own. */
bool has_table_picture(const char *kind);

/* Draws the table in the file `path`. Errors: those of iso_table_read and of the picture; ISO_BAD_INPUT: a column or a
 * line that the picture needs is missing, or there is no row. */
iso_status plot_table(iso_context *ctx, const char *path, const char *output);

#endif
