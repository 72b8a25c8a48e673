/* plot_parts.h - what the parts of a picture share. */
#ifndef ISOROLL_PLOT_PARTS_H
#define ISOROLL_PLOT_PARTS_H

#include <stdio.h>

#include "base/record.h"
#include "plot/page.h"
#include "plot/palette.h"

enum { ISO_PLOT_ROWS = 5000 }; /* rows of a record that are drawn, at most */

/* In labels \u2060, which is not seen, stands before a blank that follows a subscript: some renderers of SVG drop a
 * blank at the beginning of a piece of a text. */

/* Axes on the left and below, and a grid. */
#define ISO_PLOT_AXES                                                                                                \
    "set border 3 lc rgb " ISO_PLOT_LINE                                                                             \
    "; set tics nomirror out scale 0.6; set grid back lt 1 lw 0.8 lc rgb " ISO_PLOT_GRID "\n"

/* A plot that is the whole page, without axes: for titles and keys. */
#define ISO_PLOT_PAGE                                                                                                \
    "unset border; unset tics; unset label; unset arrow; unset object; unset title; unset logscale; unset grid\n"    \
    "unset xlabel; unset ylabel; set size noratio; set xrange [0:1]; set yrange [0:1]\nset lmargin at screen 0; "    \
    "set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0\n"

/* Axes on all sides, and one of angles below. */
#define ISO_PLOT_FRAME "set border 15 lw 0.8 lc rgb " ISO_PLOT_LINE "; set tics out scale 0.6 nomirror; unset grid\n"
#define ISO_PLOT_ANGLES "set xrange [-pi:pi]; set xtics ('−π' -pi, '−π/2' -pi/2, '0' 0, 'π/2' pi/2, 'π' pi)\n"

/* A number of a table by the name of its column (NaN: there is none); whether a word is this one; the axis of the
 * line "axis", 0 to 2 (-1: there is none). */
double iso_plot_number(const iso_record *table, size_t row, const char *column);
bool iso_plot_is(const iso_record *table, size_t row, const char *column, const char *word);
int iso_plot_axis_of(const iso_record *table);

/* A block of data: columns of a record (NULL: without rows) in this order, NULL ends them. Words stand in quotes. What
 * is no finite number, and a column that is not there, is NaN, and from now on missing: lines go on across it. */
void iso_plot_block(FILE *script, const char *name, const iso_record *record, const char *const columns[]);

/* A symbol for the name of a column: "γ" for "gamma"; the name itself if there is none. */
const char *iso_plot_symbol(const char *name);

/* A plot that is only a key, in one line: its entries, as gnuplot's `plot` takes them, at (x, y). */
void iso_plot_key(FILE *script, double x, double y, const char *entries);

/* --- over a section --------------------------------------------------------------------------------------------- */

struct iso_plot_section;
typedef struct iso_plot_spot {
    double right, up;
} iso_plot_spot;

/* The n-th of eight images of (l, x) by the reversors S1: (l, -x), S2: (-l, x), S3: (pi - l, x); 0: itself. */
void iso_plot_image(int n, double l, double x, double image[2]);

/* Reads the files that --over names: columns l, x, and how it is drawn. NULL: there are none. The caller frees it, also
 * after an error. Errors: ISO_BAD_INPUT: a file of another kind, or of another ball. */
iso_status iso_plot_read_over(iso_context *ctx, const iso_plot_page *page, const struct iso_plot_section *section,
                              iso_record **over);

/* Writes its blocks of data for one side; goes on with a `plot` of this side; draws its key in the middle at y. */
void iso_plot_put_over(FILE *script, const struct iso_plot_section *section, const char *side,
                       iso_plot_spot (*place)(const struct iso_plot_section *section, const double chart[2]));
void iso_plot_draw_over(FILE *script, const struct iso_plot_section *section, const char *side);
void iso_plot_over_key(FILE *script, const struct iso_plot_section *section, double y);

#endif
