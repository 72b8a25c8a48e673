/* maps_impl.h - what the pictures of sweeps (sweep.c) ask of maps.c: scales and cells. */
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

/* For qsort: by the first number of a row, the smallest first. */
int iso_picture_by_size(const void *a, const void *b);

#endif
