/* maps_impl.h - what the pictures of sweeps share (sweep.c, sweep_maps.c), and ask of maps.c: scales and cells. */
#ifndef ISO_PICTURE_MAPS_IMPL_H
#define ISO_PICTURE_MAPS_IMPL_H

#include "picture/picture_impl.h"

/* The numbers of a column, to choose a scale. low > high: none is finite. */
typedef struct iso_picture_spread {
    double low, high, least; /* least: the smallest size but 0 */
    bool sizes;              /* sizes are to be drawn, on a logarithmic scale */
} iso_picture_spread;
iso_status iso_picture_spread_of(iso_context *ctx, iso_picture *picture, const iso_record *r, int column,
                                 iso_picture_spread *spread);

/* The numbers along one axis, each once, by size; they belong to the picture. */
typedef struct iso_picture_scale {
    double *at;
    size_t count;
    bool logarithmic; /* they grow by equal ratios, not by equal steps */
    bool k;           /* no cell reaches across k = 0 */
} iso_picture_scale;
iso_status iso_picture_scale_of(iso_context *ctx, iso_picture *picture, const iso_record *r, int column, bool k,
                                iso_picture_scale *scale);

/* The points of maps, and where their cells are sought: a plane in which straight lines are those of the picture. */
enum { ISO_POINT_MAP, ISO_POINT_X, ISO_POINT_Y, ISO_POINT_VALUE, ISO_POINT_U, ISO_POINT_V, ISO_POINT_COLUMNS };
typedef struct iso_picture_maps {
    iso_record *points; /* those columns; a map from 1 on */
    double count;       /* of maps */
    iso_picture_scale x, y;
    void (*back)(const double uv[2], double xy[2]); /* NULL: u, v are x, y as parts of their range */
} iso_picture_maps;

/* Fills the table of the picture: cell, map, missing, value, x, y, the corners of each cell, closed, with a gap behind.
 * The cells of a grid are rectangles; else a cell is all that is nearer to its point than to others. */
iso_status iso_picture_cells(iso_context *ctx, const iso_picture_maps *maps, bool sizes, iso_record *cells);

/* --- sweeps ----------------------------------------------------------------------------------------------------- */

enum { ISO_SWEPT_AXES = 64, ISO_SWEPT_NAME = 64 };

/* The rows of a result, and which columns are drawn. */
typedef struct iso_swept {
    const iso_record *r;
    int axis[ISO_SWEPT_AXES], axes; /* those that vary, and differ from row to row */
    int value, low, high;           /* -1: there is none; low -1: high is an error +- */
    char text[2 * ISO_SWEPT_NAME];  /* what the value is */
} iso_swept;

/* What varies, as text; whether it is k. */
const char *iso_swept_axis(const iso_swept *s, int column);
bool iso_swept_is_k(const iso_swept *s, int column);

/* For qsort: by the first number of a row, the smallest first. */
int iso_picture_by_size(const void *a, const void *b);

/* Adds k = 1 and k = -1, if they are on this axis: 1: x, 2: y. */
iso_status iso_swept_marks(iso_context *ctx, const iso_picture_scale *scale, int axis, iso_record *marks);

/* Lines: "sizes" and "value"; the title, of the values of a number, or of points. */
iso_status iso_swept_say_value(iso_context *ctx, iso_picture *picture, const iso_swept *s, bool sizes);
iso_status iso_swept_say_title(iso_context *ctx, iso_picture *picture, const iso_swept *s, const char *of);

/* The picture of a sweep in which more than one number varies. */
iso_status iso_swept_maps(iso_context *ctx, const iso_swept *s, iso_picture *picture);

#endif
