/* section_impl.h - the picture of a section: both models side by side, as charts of one section n_a = 0.
 *
 *     section.c           the kinds "section" and "periodic", and what is drawn over them
 *     section_points.c    collects crossings row by row, in bounded memory: which orbits are grey, rotation numbers
 *     section_charts.c    from points (l, x) to the spots of both charts
 *
 * Tables of the picture, SIDE is ball or point:
 * - SIDE: spots; right, up; shade: an iso_picture_shade; colour: if `bar` the rotation number, else a hue in [0, 1); 0
 *   if the shade is no colour. What is drawn first comes first. Of spots that would cover each other one is kept. If
 *   `images`, because there are more than the option `points`: an image, see ISO_PICTURE_CELLS;
 * - orbits: orbit, shade, rotation: of each orbit of the file, of a section alone;
 * - boundary: l, low, high: where L = -G(l) and G(l), from -pi to pi;
 * - SIDE_orbits: right, up, stable: periodic orbits over it; SIDE_leaves, SIDE_enters: right, up: the curves of the
 *   unstable rotation.
 * Lines: title; SIDE_title, SIDE_right, SIDE_up: names; SIDE_x0, SIDE_x1, SIDE_y0, SIDE_y1: the ends of the axes;
 * window: 1: only a part is drawn; few: 1: few spots, as of periodic orbits; images; grey_means, dark_means: the key of
 * these shades, "": there are none; bar, low, high: the scale of the rotation numbers; stable, unstable, curves: 1:
 * there are such orbits, or curves, over it.
 */
#ifndef ISO_PICTURE_SECTION_IMPL_H
#define ISO_PICTURE_SECTION_IMPL_H

#include "orbit/crossings.h"
#include "picture/picture_impl.h"

/* Of a row of crossings. */
typedef enum iso_picture_shade { ISO_PICTURE_COLOURED, ISO_PICTURE_GREY, ISO_PICTURE_DARK } iso_picture_shade;

/* A chart is so many cells wide and high: in each there is at most one spot, which is about three cells wide. In an
 * image the rows of the table are the rows of cells from below, and a cell is its rotation number or ... */
enum { ISO_PICTURE_CELLS = 640, ISO_PICTURE_CELL_GREY = -1, ISO_PICTURE_CELL_DARK = -2, ISO_PICTURE_CELL_EMPTY = -3 };

/* --- crossings, row by row (section_points.c) ------------------------------------------------------------------- */

typedef struct iso_picture_points iso_picture_points;

/* Takes the header of the rows; to be freed also after an error. */
iso_status iso_picture_points_create(iso_context *ctx, const iso_record *header, iso_picture_points **points);
void iso_picture_points_free(iso_picture_points *p);

/* Takes the next row. Of very many rows only an even choice is kept. Errors: ISO_NO_MEMORY. */
iso_status iso_picture_points_row(iso_context *ctx, iso_picture_points *p, const double row[]);

/* Takes the crossing of the last row by both models, as points (l, x). */
void iso_picture_points_pair(iso_picture_points *p, const double ball[2], const double point[2]);

/* The first crossing (l, x) of each orbit that has one. Returns how many; valid until the next row. */
size_t iso_picture_points_starts(iso_picture_points *p, const double (**starts)[2]);

/* The verdict ("regular", ...) on the orbit whose first crossing is (l, x): chaotic ones are grey. Without this call,
 * orbits are grey on which the two models part, or of which no rotation number is found. */
void iso_picture_points_verdict(iso_picture_points *p, double l, double x, const char *verdict);

/* The picture, empty at first. Tables "periodic" and "splitting" of over[] (NULL behind the last) are drawn over it;
 * options: "window" and "points", as iso_picture_make takes them. Errors: ISO_BAD_INPUT: the section is an event, which
 * has no coordinates, or there is no crossing; what is drawn over it is of another ball; ISO_BAD_ARGUMENT about an
 * option; ISO_NO_MEMORY. The caller frees the picture, also after an error. */
iso_status iso_picture_points_make(iso_context *ctx, iso_picture_points *p, const iso_record *const over[],
                                   const char *options, iso_picture *picture);

/* --- charts (section_charts.c) ---------------------------------------------------------------------------------- */

typedef struct iso_picture_charts {
    iso_params params;
    double eps, energy; /* coupling, > 0, and level H, if the section has its chart; eps 0: x is drawn, not L */
    bool alone;         /* ... and nothing acts but a level                                                   */
    int axis;           /* a, 0 to 2                                                                          */
    bool few;           /* few crossings: each is large, and the axes end with them                           */
    bool windowed;
    double window[2][2]; /* of l and x                                                                         */
    size_t points;       /* single spots of a side, at most; 0: any number                                     */
} iso_picture_charts;

/* Columns of crossings: by the ball, by the point, how, and which of the eight images are drawn (bit n: the n-th). */
enum {
    ISO_PICTURE_L,
    ISO_PICTURE_X,
    ISO_PICTURE_POINT_L,
    ISO_PICTURE_POINT_X,
    ISO_PICTURE_SHADE,
    ISO_PICTURE_COLOUR,
    ISO_PICTURE_IMAGES,
    ISO_PICTURE_COLUMNS
};
extern const char *const iso_picture_crossing_names[ISO_PICTURE_COLUMNS];

/* The n-th of eight images of (l, x) by the reversors S1: (l, -x), S2: (-l, x), S3: (pi - l, x); 0: itself. */
void iso_picture_image(int n, double l, double x, double image[2]);

/* Reads "L0:L1,X0:X1"; false: it is none. A pi in few digits is pi. */
bool iso_picture_window(const char *text, double window[2][2]);

/* The options "window" and "points". Errors: ISO_BAD_ARGUMENT. */
iso_status iso_picture_charts_options(iso_context *ctx, const iso_picture_request *request, iso_picture_charts *c);

/* Adds ball, point and boundary, and the lines about them. crossings: columns as above, and more. */
iso_status iso_picture_charts_add(iso_context *ctx, const iso_picture_charts *c, const iso_record *crossings,
                                  iso_picture *picture);

/* Where a point (l, x) stands on one side: right and up. */
typedef struct iso_picture_spot {
    double right, up;
} iso_picture_spot;
iso_picture_spot iso_picture_place(const iso_picture_charts *c, bool ball, double l, double x);

/* Adds what is drawn over it (section.c); over[] may have other tables, too, which are passed over. */
iso_status iso_picture_over(iso_context *ctx, const iso_picture_charts *c, const iso_record *const over[],
                            iso_picture *picture);

#endif
