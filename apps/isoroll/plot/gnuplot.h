/* gnuplot.h - one run of gnuplot: a script in, a picture file out, whole or not at all.
 *
 *     iso_gnuplot *g;
 *     status = iso_gnuplot_open(ctx, "orbit.svg", 900, 800, &g);
 *     FILE *script = iso_gnuplot_script(g);                      gnuplot commands and data go in here
 *     status = iso_gnuplot_close(ctx, g, true);                  runs gnuplot
 */
#ifndef ISOROLL_GNUPLOT_H
#define ISOROLL_GNUPLOT_H

#include <stdbool.h>
#include <stdio.h>

#include "base/context.h"

typedef struct iso_gnuplot iso_gnuplot;

/* Whether the name ends in .svg, .png or .pdf. Errors: ISO_BAD_ARGUMENT. */
iso_status iso_gnuplot_check_format(iso_context *ctx, const char *path);

/* Begins a picture of width x height, in pixels of a page 900 wide: the same lay-out in every format.
 * Errors: ISO_BAD_ARGUMENT (format), ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_gnuplot_open(iso_context *ctx, const char *path, int width, int height, iso_gnuplot **g);

FILE *iso_gnuplot_script(iso_gnuplot *g);

/* Ends the script. keep: draws it and gives the picture its name; else nothing is left. Releases g.
 * Errors: ISO_FILE_TROUBLE: no gnuplot, gnuplot's own complaint, or the picture cannot be written. */
iso_status iso_gnuplot_close(iso_context *ctx, iso_gnuplot *g, bool keep);

/* Numbers and texts as gnuplot takes them, whatever the locale and whatever the text: always one quoted string of one
 * line, valid UTF-8, cut after `longest` characters. It still needs `noenhanced`. */
void iso_gnuplot_number(FILE *script, double value);
void iso_gnuplot_pair(FILE *script, double x, double y); /* one line of a data block */
void iso_gnuplot_text(FILE *script, const char *text, int longest);

#endif
