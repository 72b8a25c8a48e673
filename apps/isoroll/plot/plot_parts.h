/* plot_parts.h - what the parts of a picture share. */
#ifndef ISOROLL_PLOT_PARTS_H
#define ISOROLL_PLOT_PARTS_H

#include <stdio.h>

#include "base/record.h"
#include "plot/page.h"
#include "plot/palette.h"

enum {
    ISO_PLOT_ROWS = 5000,     /* rows of a record that are drawn, at most */
    ISO_PLOT_DIFFERENCES = 16 /* lines of a chart, at most                */
};

/* The signs of the first and the last row. */
#define ISO_PLOT_START "pt 7 ps 1.1"
#define ISO_PLOT_END "pt 9 ps 1.3"
#define ISO_PLOT_ENDS                                                                                                \
    "NaN w p " ISO_PLOT_START " lc rgb 'black' title 'start', NaN w p " ISO_PLOT_END " lc rgb 'black' title 'end'"

/* Where the contact is lost: on a path, and over a clock. */
#define ISO_PLOT_LOST "pt 2 ps 1.7 lw 3 lc rgb " ISO_PLOT_VERMILLION
#define ISO_PLOT_LOST_LINE "dt (6,4) lw 1.5 lc rgb " ISO_PLOT_VERMILLION

/* In labels \u2060, which is not seen, stands before a blank that follows a subscript: some renderers of SVG drop a
 * blank at the beginning of a piece of a text. */

/* What a path on a sphere is. */
#define ISO_PLOT_OF_BALL "the ball: n, the normal where it touches"
#define ISO_PLOT_OF_POINT "the point: γ, its place"

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

/* The least and the largest number of a column. */
void iso_plot_range(const iso_record *r, int column, double range[2]);

/* The first of `count` columns side by side that are finite in all rows. Errors: ISO_BAD_ARGUMENT (they are not
 * there, or no row is), ISO_NUMERICAL; *first is then -1. */
iso_status iso_plot_find(iso_context *ctx, const iso_record *r, int count, const char *const names[], int *first);
extern const char *const iso_plot_normal[3], *const iso_plot_place_of_point[3]; /* n, gamma */

/* A rectangle in parts of the page: 0 and 1 are its edges, (0, 0) is its lower left corner. */
typedef struct iso_plot_box {
    double left, right, bottom, top;
} iso_plot_box;

/* The next plot's axes fill the box. */
void iso_plot_place(FILE *script, const iso_plot_box *box);

/* An axis from low to high with about `most` ticks. `name`: what the numbers are. */
typedef struct iso_plot_axis {
    const char *which; /* "x", "y", "y2" */
    double low, high;  /* equal: a single number, which gets room on both sides */
    int most;
    const char *name;
    bool label; /* whether the name stands at the axis */
} iso_plot_axis;

enum { ISO_PLOT_NAME = 160 };

/* Sets the range, the ticks and the label. Writes into `name` what the ticks mean, such as "t / 10⁶". */
void iso_plot_ticks(FILE *script, const iso_plot_axis *axis, char name[static ISO_PLOT_NAME]);

/* A chart of differences in a box, with a title above and a key on the right. Column 0 is a clock, the others are drawn
 * over it on a logarithmic axis. */
void iso_plot_differences(FILE *script, const iso_record *record, const iso_plot_box *box, const char *title);

/* A symbol for the name of a column: "γ" for "gamma"; the name itself if there is none. */
const char *iso_plot_symbol(const char *name);

/* A plot of the unit sphere with a path on it: three columns of unit vectors. */
void iso_plot_sphere(FILE *script, const iso_plot_box *box, const iso_record *line, int column);

/* Marks on a sphere: every step-th row, at the unit vector that begins with this column. */
typedef struct iso_plot_marks {
    const iso_record *rows;
    size_t step;
    int column;
} iso_plot_marks;

/* The principal axes, where they leave a sphere about (x, y). Their numbers keep away from the marks (NULL: none). */
void iso_plot_put_axes(FILE *script, double x, double y, double radius, const iso_plot_marks *marks);

/* For plots that project vectors themselves: X(x,y,z), Y(x,y,z) and D(x,y,z), which is > 0 on the near side; meridians
 * and parallels, $grid0 behind the unit sphere, $grid1 before it. */
void iso_plot_put_globe(FILE *script);

/* Whether no two rows are so far apart, in radians about 0, that they are no path: then they are drawn as dots. */
bool iso_plot_is_joined(const iso_record *record, int column);

/* Begins a block of data called `name` with the number of the side. Its first point is NaN, so that no block is
 * empty. */
void iso_plot_begin_side(FILE *script, const char *name, bool near);

/* The rows that are drawn: all, or ISO_PLOT_ROWS of them with the first and the last. */
size_t iso_plot_drawn_rows(const iso_record *record);
const double *iso_plot_drawn_row(const iso_record *record, size_t i);

/* A plot that is only a line of words in the middle of the page at the height y; look: its font or colour. */
void iso_plot_words(FILE *script, const char *words, int longest, double y, const char *look);

/* A plot that is only a key, in one line: its entries, as gnuplot's `plot` takes them, at (x, y). */
void iso_plot_key(FILE *script, double x, double y, const char *entries);

/* --- curves over a column --------------------------------------------------------------------------------------- */

typedef struct iso_plot_curve {
    int column;
    const char *name, *colour; /* name NULL: not in the key   */
    bool right;                /* it has the axis on the right */
} iso_plot_curve;

enum { ISO_PLOT_MARKS = 20 };

/* Curves of a record over its column `over`. */
typedef struct iso_plot_panel {
    iso_plot_box box; /* of the axes */
    const iso_record *rows;
    int over, count;
    const iso_plot_curve *curve;
    const char *title;  /* on the left above; NULL: none */
    double top[2];      /* the left and the right axis are cut off there; 0: as far as the curves go */
    const size_t *mark; /* rows at which contact is lost ... */
    int marks;          /* ... how many, at most ISO_PLOT_MARKS ... */
    const char *marked; /* ... and what they are called */
    bool equal;         /* one unit is equally long on both axes */
} iso_plot_panel;

void iso_plot_curves(FILE *script, const iso_plot_panel *panel);

/* --- space ------------------------------------------------------------------------------------------------------ */

struct iso_plot_space;

/* What plot_space.c knows about a path in space. */
typedef struct iso_plot_scenery {
    const iso_record *rows;
    int centre, contact;             /* first columns, -1: not there                                        */
    int place;                       /* the path that is drawn: of the centre if it is known, else of the contact */
    bool plane, level;               /* the support is a plane; a plane that is level, or up is not known   */
    bool normal;                     /* the columns tell its normal                                         */
    bool vertical;                   /* whether up[] is the vertical                                        */
    double right[3], away[3], up[3]; /* of the view from the side; `away` is up in the view from above      */
    double ball, support;            /* radii, 0: not known                                                 */
    double low[3], high[3];          /* of the path along right, away, up                                   */
    size_t lost[ISO_PLOT_MARKS];     /* rows where the contact is lost                                      */
    int losses;
    const char *right_name, *away_name, *up_name;
    const char *from_above, *from_side; /* titles of the two views                                           */
} iso_plot_scenery;

/* Errors: ISO_BAD_ARGUMENT (no columns), ISO_NUMERICAL. */
iso_status iso_plot_look_around(iso_context *ctx, const struct iso_plot_space *space, iso_plot_scenery *scenery);

/* The rows at which contact is lost: `pressure` falls to 0, or becomes negative (the support would have to pull). At
 * most ISO_PLOT_MARKS; returns how many. */
int iso_plot_losses(const iso_record *rows, size_t lost[ISO_PLOT_MARKS]);

/* What they are called: "contact lost" if the rows end there, else "pressure 0", as of a ball that is held on both
 * sides. NULL: there are none. */
const char *iso_plot_loss_name(const iso_record *rows, const size_t lost[], int losses);

/* Whether the path is so long and narrow that it gets a wide panel, with a larger scale across it. */
bool iso_plot_is_narrow(const iso_plot_scenery *scenery);

/* The two views. A narrow path has one, in a wide box. */
void iso_plot_view(FILE *script, const iso_plot_box *box, const iso_plot_scenery *scenery, bool from_above);

/* The height of the higher of the two views, as a part of its width. */
double iso_plot_view_shape(const iso_plot_scenery *scenery);

/* The entries of their key, into text. */
void iso_plot_view_key(const iso_plot_scenery *scenery, char text[static 512]);

/* --- sweeps ----------------------------------------------------------------------------------------------------- */

/* A curve; rows: the number that varies, by growing size, the value, low and high, which may be NaN; the name of the
 * last says what the band from low to high is. */
iso_status iso_plot_sweep_curve(iso_context *ctx, const iso_plot_page *page, const char *title,
                                const iso_record *rows);

/* Maps side by side, with one scale of colours; a NaN is grey. */
enum { ISO_PLOT_MAPS = 6 };
typedef struct iso_plot_maps {
    const char *key_name; /* of what differs from map to map; NULL: there is one */
    int count;            /* of maps, at most ISO_PLOT_MAPS */
    double key[ISO_PLOT_MAPS];
    iso_record *rows; /* x, y, the value, and the map, from 0; the names of the first three are shown */
} iso_plot_maps;
iso_status iso_plot_sweep_maps(iso_context *ctx, const iso_plot_page *page, const char *title,
                               const iso_plot_maps *maps);

#endif
