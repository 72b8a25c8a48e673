/* plot.h - pictures, drawn by gnuplot (package gnuplot-nox), which is started for each.
 *
 *     status = iso_plot_stretch(ctx, &scene, 30, &curve, &states);                (plot/stretch.h)
 *     iso_plot_twins plot = {"k = -1", "to t = 30", "both agree", &params, false, curve, states};
 *     status = iso_plot_comparison(ctx, &(iso_plot_page){.path = "orbit.svg"}, &plot);
 *
 * The file's name chooses the format: .svg, .png or .pdf. It is written whole, then renamed: on failure nothing has
 * changed. The user's gnuplot start-up files and the locale have no influence.
 */
#ifndef ISOROLL_PLOT_H
#define ISOROLL_PLOT_H

#include "base/record.h"
#include "model/params.h"
#include "plot/page.h"
#include "study/frequencies/frequencies.h"
#include "study/frequencies/momentum.h"

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

/* One orbit in both models. Texts are one line, any characters; NULL: none. */
typedef struct iso_plot_twins {
    const char *title, *drawn, *result; /* above; below: what is drawn, and what was found               */
    const iso_params *params;           /* tell what rolls on what, and the potential of the point       */
    bool field;                         /* the point's potential has a further part, U/G of the theory   */
    const iso_record *curve, *states;   /* columns t, s, n1..3, gamma1..3 from the first on, a row or more */
} iso_plot_twins;

/* Left n on the sphere of the ball, right gamma on that of the point, seen from the same side, coloured by t. The
 * states, at equal steps of t, are joined between the two clocks below; every 8th has a number, the same wherever it
 * stands.
 * Errors: ISO_BAD_ARGUMENT (name, missing columns or rows), ISO_NUMERICAL (a number that is not finite),
 * ISO_FILE_TROUBLE (no gnuplot, or what it said; the file cannot be written), ISO_NO_MEMORY. */
iso_status iso_plot_comparison(iso_context *ctx, const iso_plot_page *page, const iso_plot_twins *plot);

/* The path of a ball in space. If the columns do not tell where the support is, it is not drawn. */
typedef struct iso_plot_space {
    const iso_record *rows; /* columns centre1..3, or contact1..3, or both; pressure: where contact is lost       */
    /* Upward vertical, a unit vector in axes of space; NULL: not known. Then nothing is called up: the eye is on axis
     * 3 of space, or on the normal of the plane. */
    const double *up;
    bool plane; /* the support is a plane; else a sphere about 0 */
} iso_plot_space;

/* One trajectory, in one model or both. */
typedef struct iso_plot_orbit {
    const char *title;
    const iso_record *ball, *point; /* columns n1..3, and gamma1..3; NULL: not known                              */
    const iso_record *drift;        /* a clock, then non-negative drifts of integrals; NULL: none                 */
    const iso_record *paces;        /* a clock, then "ds/dt" and "dtau/dt"; NULL: no other clock is known         */
    const iso_record *energies;     /* a clock, then "h", "kinetic", "potential"; NULL: not known                 */
    const iso_plot_space *space;    /* NULL: not known                                                            */
} iso_plot_orbit;

/* A sheet of panels, as many as there is something to show in:
 * - the path in space, from above and from the side, with the support, the ball at the start and at the end, and
 *   where contact is lost (pressure 0, or the support would have to pull);
 * - the paths on their spheres, start and end marked: gamma of the point, n of the ball, or trace1..3 of a ball that
 *   is drawn without its point;
 * - energies over time, unless they are constant; pressure and mu, if the ball has these columns;
 * - the integrals' drift; if all drifts are rounding (below 1000 DBL_EPSILON = 2.2e-13), one line of text instead;
 * - how fast the clocks s and tau run against t.
 * Errors: as iso_plot_comparison. */
iso_status iso_plot_trajectory(iso_context *ctx, const iso_plot_page *page, const iso_plot_orbit *plot);

/* Column y over column x; equal: one unit is equally long on both axes. Of many rows not all are drawn: over a clock
 * the least and the largest number in each of 1000 slots, else 5000 rows. Errors: ISO_BAD_ARGUMENT (name, columns, no
 * rows), ISO_NUMERICAL (a number that is not finite), ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_plot_columns(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *rows,
                            const char *x, const char *y, bool equal);

/* The image of the momentum map: kinds of motion over the energy h and a second integral F, with the orbit at
 * (h, F) in it. On the left F over h, on the right F/h over h, where thin parts can be told apart.
 * Errors: ISO_BAD_ARGUMENT (name), those of iso_momentum_bounds, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_plot_momentum(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_momentum *m,
                             const double at[2]);

/* The spectral lines of n(t): of the pair of components across the axis, and of the one along it. Errors: as
 * iso_plot_momentum; ISO_BAD_ARGUMENT: there is no line. */
iso_status iso_plot_lines(iso_context *ctx, const iso_plot_page *page, const char *title,
                          const iso_estimate *estimate);

/* --- tables of commands ----------------------------------------------------------------------------------------- */

/* Whether there is a picture of such tables ("section", "chaos", ...); trajectories and sweeps have their own. */
bool iso_plot_has_kind(const char *kind);

/* Draws a table by its kind. Its title is its line "title", else what it shows, with k and J. Errors: ISO_BAD_INPUT: a
 * column or a line that the picture needs is missing, or there is no row; those of the picture. */
iso_status iso_plot_table(iso_context *ctx, const iso_plot_page *page, const iso_record *table);

/* Of cost: a work-precision diagram, time over error, both logarithmic, small errors on the right; a panel for each
 * backend. The first methods of each, which should be the fastest, have names. Errors: as iso_plot_momentum. */
iso_status iso_plot_cost(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *table);

/* The result of a sweep in a file. value: which column is drawn (NULL: the first that is there of a list of usual
 * ones), over the numbers that vary: over one as a curve with the band of its error, over two as maps. Marks stand at
 * k = +-1. Values of both signs or of very different sizes are drawn as |value| on a logarithmic axis. Errors:
 * ISO_BAD_INPUT: no such column, or a sweep that no picture shows; those of iso_plot_momentum. */
iso_status iso_plot_sweep(iso_context *ctx, const iso_plot_page *page, const char *file, const char *value);

#endif
