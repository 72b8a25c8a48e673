/* plot_impl.h - what the parts of a picture share. */
#ifndef ISO_IO_PLOT_IMPL_H
#define ISO_IO_PLOT_IMPL_H

#include <stdio.h>

#include "base/record.h"

enum {
    ISO_PLOT_ROWS = 5000,     /* rows of a record that are drawn, at most */
    ISO_PLOT_DIFFERENCES = 16 /* lines of a chart, at most                */
};

/* Okabe & Ito's colours, for all kinds of sight, and paler twins for the far side of a sphere. */
#define ISO_PLOT_BLUE "'#0072B2'"
#define ISO_PLOT_VERMILLION "'#D55E00'"
#define ISO_PLOT_FAR_BLUE "'#A9CDE2'"
#define ISO_PLOT_FAR_VERMILLION "'#F0BE9B'"

/* The signs of the first and the last row. */
#define ISO_PLOT_START "pt 7 ps 1.1"
#define ISO_PLOT_END "pt 9 ps 1.3"

/* A chart below the spheres: its sides in thousandths of the page, a key on the right of it. */
typedef struct iso_plot_chart {
    int left, right;
    const char *ylabel, *units; /* units: said after the name of the clock */
} iso_plot_chart;

/* Column 0 is a clock, the others are drawn over it on a logarithmic axis. */
void iso_plot_differences(FILE *script, const iso_record *record, double tolerance, const iso_plot_chart *chart);

/* A plot of the unit sphere with a path, `line`, and markers on it (NULL: none): three columns of unit vectors
 * each. */
void iso_plot_sphere(FILE *script, const iso_record *line, int line_column, const iso_record *markers,
                     int marker_column, bool fine);

/* Whether a path has so many turns that it wants a fine line. */
bool iso_plot_is_long(const iso_record *record, int column);

#endif
