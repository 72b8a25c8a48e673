/* rows_impl.h - along a trajectory, from row to row: how far a row is from the orbit through the row before it, and
 * what clocks and columns of effects gain in between.
 *
 *     iso_rows rows = {.ctx = ctx, .model = ISO_BALL, .clock = ISO_CLOCK_T, .columns = columns, .width = width, ...};
 *     iso_rows_begin(&rows, orbit of the first row, first, 1e-13);
 *     while (next(row)) {
 *         iso_rows_take(&rows, row);
 *         if (!iso_rows_measure(&rows, 0, &gap)) status = iso_rows_integrate(&rows, &gap);
 *         iso_rows_keep(&rows);
 *     }
 *     iso_rows_free(&rows);
 *
 * Two-point Taylor quadrature (method/two_point_impl.h) measures a gap in about a microsecond. It is certain enough
 * where two rows are near each other, and nothing but the six numbers of the model moves. Elsewhere the orbit of the
 * row before is integrated.
 */
#ifndef ISO_ORBIT_ROWS_IMPL_H
#define ISO_ORBIT_ROWS_IMPL_H

#include "method/two_point_impl.h"
#include "orbit/orbit_impl.h"

/* From the last row to this one, in the caller's units. */
typedef struct iso_row_gap {
    double step;                                  /* of the clock of the rows                                    */
    double gained[ISO_CLOCKS], error[ISO_CLOCKS]; /* by the other clocks of the orbit; NaN: it does not have them */
    double off[ISO_STATE];                        /* the row less the orbit, relative to the longer vectors      */
    double miss;                                  /* the distance of the row from the orbit (watch_impl.h)       */
    iso_sample reached;                           /* where the orbit is now; of an integration only              */
} iso_row_gap;

typedef struct iso_rows {
    iso_context *ctx;
    iso_model_kind model; /* whose states the rows have               */
    iso_clock clock;      /* of their times                           */
    const int *columns;   /* of a trajectory, in a row; -1: not there */
    size_t width;         /* of a row                                 */
    bool alone;           /* do not measure: integrate each gap       */
    /* The orbit through a row, with the clocks and effects that are wanted. */
    iso_status (*open)(void *data, const double row[], iso_orbit **orbit);
    void *data;

    /* set by iso_rows_begin */
    double unit, unit_clock[ISO_CLOCKS]; /* of omega or M, and of the clocks      */
    bool has_clock[ISO_CLOCKS];          /* which the orbit has beside its own    */
    iso_two_point *quadrature;           /* NULL: each gap is integrated          */
    double *last, *now;                  /* the row that was kept; the one in hand */
    bool measured, last_measured;        /* which of them the quadrature has seen */
} iso_rows;

/* The state of a model in a row. */
static inline void iso_row_state(const int columns[], iso_model_kind model, const double row[], double y[ISO_STATE])
{
    const int first = model == ISO_BALL ? ISO_COLUMN_BALL : ISO_COLUMN_POINT;
    for (int i = 0; i < ISO_STATE; i++) y[i] = row[columns[first + i]];
}

/* The first row of an orbit, which that orbit begins at; rows before are forgotten. orbit NULL: it is not known, so
 * that each gap is integrated. tolerance: relative error of a clock's gain. Errors: ISO_NO_MEMORY. */
iso_status iso_rows_begin(iso_rows *rows, const iso_orbit *orbit, const double first[], double tolerance);
void iso_rows_free(iso_rows *rows);

/* The next row: the gap is from the row that was kept last to this one. */
void iso_rows_take(iso_rows *rows, const double row[]);

/* The gap by quadrature. noise: what rows miss as a rule, 0 or more. False: it is not certain enough here. */
bool iso_rows_measure(iso_rows *rows, double noise, iso_row_gap *gap);

/* The gap by integration. A clock that the orbit does not have gains NaN. Errors: those of open and iso_orbit_at. */
iso_status iso_rows_integrate(iso_rows *rows, iso_row_gap *gap);

/* The next gap begins at the row in hand. */
void iso_rows_keep(iso_rows *rows);

/* A row is missed by the orbit through the row before if it is farther from it than the largest of
 * - 1e-5, what six digits make of it; rows of other equations, a thousandth beside the stated ones, are missed by more;
 * - a hundred times the tolerance with which the header says they were made;
 * - ten times the row tolerance, where that is wider than ISO_ROW_TOLERANCE: the rows then have few digits.
 * The same bound holds for gaps that are added up while the unit vector moves by half a radian. */
double iso_rows_largest_miss(iso_context *ctx, const iso_record *header, double row_tolerance);

/* The row that the orbit through the row before misses most, and by how much; by 0: none is missed. */
typedef struct iso_row_miss {
    size_t row; /* from 0 */
    double by;
} iso_row_miss;

/* A trajectory with these columns (iso_column_name), in the same rows: those that it has, and those that it lacks, such
 * as the other model, clocks, and the attitude. It has a clock and the states of one model. twin: the ball has a point.
 * Errors: those of iso_orbit_create and iso_orbit_at, with the row; ISO_NO_MEMORY. */
iso_status iso_rows_complete(iso_context *ctx, const iso_params *params, const iso_effects *effects, bool twin,
                             const iso_record *in, size_t count, const char *const names[], iso_record **made,
                             iso_row_miss *worst);

#endif
