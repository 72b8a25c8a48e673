/* error.h - how wrong an orbit is: a number that covers the true error, from the same orbit computed again.
 *
 *     iso_error_rows *rows = calloc(1, sizeof *rows);      (some 90 kB)
 *     ... iso_error_keep(rows, &sample) for every row, from iso_orbit_at(orbit, ...)
 *     iso_error error;
 *     iso_error_find(ctx, &params, &start, &options, orbit, rows, &error);     error.state[ISO_BALL].worst
 *
 * The estimate of a row is the sum of two parts:
 * - its distance from the row of a finer orbit: by `taylor_extended` at 1e-15, that is in long double and by another
 *   code than the model's right-hand side; where series do not serve (iso_method_auto), by the orbit's method at a
 *   hundredth of its tolerance, which is taken to leave at most a tenth of the error;
 * - what ISO_ERROR_ULPS ulps in the numbers of the start and in J would make of it, from four more orbits whose starts
 *   differ in generic directions by far more than that. It covers decimals that are no doubles, and what becomes of
 *   them on the way to own units.
 * It does not cover an error of the equations themselves, or numbers of k, of effects and of times that are no
 * doubles; nor, after the orbit has lost its start altogether (an estimate of about 1), how far it is away.
 */
#ifndef ISO_STUDY_ERROR_H
#define ISO_STUDY_ERROR_H

#include "../orbit/orbit.h"

enum { ISO_ERROR_ROWS = 256, ISO_ERROR_ULPS = 2 };

/* Rows of an orbit: all of them, or every second, fourth, ..., and the last. Begins as {0}. */
typedef struct iso_error_rows {
    size_t seen, stride, count; /* rows given; one in `stride` of them is kept, `count` in all */
    iso_sample sample[ISO_ERROR_ROWS], last;
} iso_error_rows;

void iso_error_keep(iso_error_rows *rows, const iso_sample *sample);

/* One error along the rows: the largest, its time, and that of the last row. NaN: not shown. */
typedef struct iso_error_of {
    double worst, worst_time, last;
} iso_error_of;

typedef struct iso_error {
    iso_error_of state[2];          /* of (omega, n) and of (M, gamma): each vector relative to its length */
    iso_error_of clock[ISO_CLOCKS]; /* of a carried clock, relative to its largest value in the rows       */
    double start;                   /* the part of the largest state error that is the start's             */
    size_t rows;                    /* how many were compared                                              */
    const iso_method *method;       /* of the finer orbit                                                  */
    double tolerance, seconds;      /* its tolerance; processor time for all of it                         */
} iso_error;

/* The error of `orbit` at the rows kept of it; params, start and options are those it was created with. Errors:
 * ISO_BAD_ARGUMENT where there is nothing finer (taylor_quad, taylor_extended without it, tolerances below 1e-13, or
 * backend exact, where series do not serve) or no row; ISO_NUMERICAL when the finer orbit does not get there, or needs
 * more than twenty times the steps (for backend exact, which has none: than 200000); ISO_STOPPED, ISO_NO_MEMORY. */
iso_status iso_error_find(iso_context *ctx, const iso_params *params, const iso_start *start,
                          const iso_orbit_options *options, const iso_orbit *orbit, const iso_error_rows *rows,
                          iso_error *error);

#endif
