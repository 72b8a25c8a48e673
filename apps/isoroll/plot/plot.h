/* plot.h - pictures, drawn by gnuplot (package gnuplot-nox), which is started for each.
 *
 * The file's name chooses the format: .svg, .png or .pdf. It is written whole, then renamed: on failure nothing has
 * changed. The user's gnuplot start-up files and the locale have no influence.
 */
#ifndef ISOROLL_PLOT_H
#define ISOROLL_PLOT_H

#include "base/record.h"
#include "model/params.h"
#include "plot/page.h"

/* "1/2" of 0.5, if the number is such a fraction to its last digits; else its first digits. Gives `text`. */
enum { ISO_PLOT_FRACTION = 32 };
char *iso_plot_fraction(char text[static ISO_PLOT_FRACTION], double x);

/* "k = ..., J = ...", and what follows. Gives `title`. */
enum { ISO_PLOT_TITLE = 200 };
char *iso_plot_title(char title[static ISO_PLOT_TITLE], const iso_params *p, const char *more, ...)
    __attribute__((format(printf, 3, 4)));

/* What is seen, and "k = ..., J = ...", with a gap between. Gives `heading`. */
enum { ISO_PLOT_HEADING = 2 * ISO_PLOT_TITLE };
char *iso_plot_heading(char heading[static ISO_PLOT_HEADING], const char *seen, const iso_params *p);

/* The indicators of chaos against the turns. The records have the columns turn, t, growth, megno, mean and gali2, as
 * in iso_chaos. Above: ln D. Below: MEGNO and its mean on the left, GALI_2 on the right. A record that is NULL or
 * empty is left out.
 * Errors: as iso_plot_columns. */
iso_status iso_plot_indicators(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *ball,
                               const iso_record *point);

/* --- tables of commands ----------------------------------------------------------------------------------------- */

/* Whether there is a picture of such tables ("section", "chaos", ...); trajectories and sweeps have their own. */
bool iso_plot_has_kind(const char *kind);

/* Draws a table by its kind. Its title is its line "title", else what it shows, with k and J. Errors: ISO_BAD_INPUT: a
 * column or a line that the picture needs is missing, or there is no row; those of the picture. */
iso_status iso_plot_table(iso_context *ctx, const iso_plot_page *page, const iso_record *table);

/* Of chaos: the section, with a spot for each orbit that starts on it, coloured by its exponent. Errors: as
 * iso_plot_columns. */
iso_status iso_plot_exponents(iso_context *ctx, const iso_plot_page *page, const char *title,
                              const iso_record *table);

/* How an orbit is drawn: 0: in colours; grey, behind the others; dark. */
typedef enum iso_plot_shade {
    ISO_PLOT_COLOURED,
    ISO_PLOT_CHAOTIC,
    ISO_PLOT_UNDECIDED,
    ISO_PLOT_SHADES
} iso_plot_shade;

/* Crossings of one section n_a = 0 by both models, as points (l, x) of the chart (map/section.h). */
typedef struct iso_plot_section {
    const char *title; /* one line, any characters; NULL: none                                          */
    const iso_params *params;
    double eps, energy; /* coupling, > 0, and level H, if the section has its chart; eps 0: x is drawn, not L */
    bool alone;         /* ... and nothing acts but a level                                              */
    int axis;           /* a, 0 to 2                                                                     */
    /* Columns orbit (0, 1, ...), l, x and grey, an iso_plot_shade. If there is a column rotation, an orbit has the
     * colour of its rotation number; else each has its own. The crossings of the point are the same, or in columns
     * point_l, point_x. */
    const iso_record *rows;
    const char *grey_means, *dark_means; /* what the key says of these shades, such as "chaotic"; NULL: nothing */
    const iso_record *over;              /* of iso_plot_read_over; NULL: nothing */
    bool few; /* few crossings, as of periodic orbits: in colours and large; the axes end with them */
} iso_plot_section;

/* Left: the section of the ball. Its axes are the angle of n in the plane n_a = 0, and omega_a/|omega|. Right: that
 * of the point. Its axes are l and L = M_a, and its boundaries are L = +-G(l).
 * Errors: ISO_BAD_ARGUMENT (name, no crossing, a wrong axis), ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_plot_sections(iso_context *ctx, const iso_plot_page *page, const iso_plot_section *section);

#endif
