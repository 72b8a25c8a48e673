/* gnuplot.h - one run of gnuplot: a script in, a picture file out, whole or not at all. */
#ifndef ISOROLL_GNUPLOT_H
#define ISOROLL_GNUPLOT_H

#include <stdio.h>

#include "base/context.h"
#include "plot/page.h"

/* Whether the picture and its script can have these names. Errors: ISO_BAD_ARGUMENT: none of a picture;
 * ISO_FILE_TROUBLE: what has the name is no regular file. */
iso_status iso_gnuplot_check_files(iso_context *ctx, const iso_plot_page *page);

/* Writes what the page is to be, as variables of pictures/page.gp. The page has a name of a picture. */
void iso_gnuplot_write_page(FILE *script, const iso_plot_page *page);

/* Draws the picture by this script, which is kept if the page asks for it. Errors: ISO_FILE_TROUBLE: no gnuplot,
 * gnuplot's own complaint, or the picture cannot be written; nothing is left then. */
iso_status iso_gnuplot_run(iso_context *ctx, const iso_plot_page *page, FILE *script);

#endif
