/* draw.h - draws what a picture shows (lib/picture) by a template of gnuplot (apps/isoroll/pictures). */
#ifndef ISOROLL_DRAW_H
#define ISOROLL_DRAW_H

#include "picture/picture.h"
#include "plot/page.h"

/* The script is: variables (the look of the page, and the lines of the picture's first table: a number is a number,
 * anything else a text), pictures/page.gp, a data block for each table with the names of its columns, and the template
 * pictures/LAYOUT.gp, or the user's. Whatever the texts are, gnuplot takes them as texts.
 * Errors: ISO_BAD_ARGUMENT (name of the file), ISO_FILE_TROUBLE (no gnuplot, or what it said; a file cannot be read or
 * written), ISO_STOPPED, ISO_NO_MEMORY. */
iso_status plot_draw(iso_context *ctx, const iso_plot_page *page, const iso_picture *picture);

/* Makes the picture of these tables, says what it notes, and draws it; options: see iso_picture_make. */
iso_status plot_tables(iso_context *ctx, const iso_plot_page *page, const iso_record *const table[],
                       const char *options);

/* The files of --over, NULL behind the last. The caller frees them, also after an error. Errors: ISO_BAD_INPUT: a table
 * of another kind; those of iso_table_read. */
iso_status plot_read_over(iso_context *ctx, const iso_plot_page *page, iso_record *over[ISO_PLOT_OVERS + 1]);

/* The options of a section's picture: its window; for .svg and .pdf, which store each spot, the most spots of a side.
 * Returns `text`. */
enum { PLOT_SECTION_OPTIONS = 256 };
const char *plot_section_options(const iso_plot_page *page, char text[static PLOT_SECTION_OPTIONS]);

/* Draws a table by its kind, a section with all that the page asks for. Errors: ISO_BAD_ARGUMENT: --over or --window,
 * and it is no section; those of plot_tables. */
iso_status plot_table(iso_context *ctx, const iso_plot_page *page, const iso_record *table);

#endif
