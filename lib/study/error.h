/* error.h - how wrong an orbit is: a number that covers the true error, from the same orbit computed again beside it.
 *
 *     iso_error_finder *finder;
 *     iso_error_finder_create(ctx, &params, &start, &options, orbit, &finder);
 *     for each row: iso_orbit_at(orbit, time, &sample), then iso_error_finder_add(finder, &sample)
 *     iso_error error = iso_error_finder_read(finder);                     error.state[ISO_BALL].worst
 *     iso_error_finder_free(finder);
 *
 * Every row is compared, and none is kept: memory does not grow with the number of rows.
 *
 * The estimate of a row is the sum of two parts:
 * - Its distance from the row of a finer orbit. The finer orbit is found by `taylor_extended` at tolerance 1e-15: in
 *   long double, and by another code than the model's right-hand side. Where series do not serve (iso_method_auto),
 *   it is found by the orbit's own method at a hundredth of the tolerance. That orbit is assumed to have at most a
 *   tenth of the error.
 * - The rounding of the start: what ISO_ERROR_ULPS ulps in the numbers of the start and of J do to the row. Four more
 *   orbits show it; their starts differ from the orbit's in four directions, by far more than that. This part
 *   covers decimal numbers that are no doubles, and the change to own units.
 * The estimate does not cover
 * - an error of the equations themselves;
 * - the rounding of k, of the numbers of effects, and of times;
 * - the distance after the orbit has lost its start completely (then the estimate is about 1).
 */
#ifndef ISO_STUDY_ERROR_H
#define ISO_STUDY_ERROR_H

#include "orbit/orbit.h"

enum { ISO_ERROR_ULPS = 2 };

/* One error along the rows: the largest, its time, and the error of the last row. NaN: the rows do not show it. */
typedef struct iso_error_of {
    double worst, worst_time, last;
} iso_error_of;

typedef struct iso_error {
    iso_error_of state[2];          /* of (omega, n) and of (M, gamma): each vector relative to its length */
    iso_error_of clock[ISO_CLOCKS]; /* of a carried clock, relative to its largest value in the rows       */
    double start;                   /* the part of the largest state error that the start's rounding makes */
    size_t rows;                    /* how many were compared: all that were added                         */
    const iso_method *method;       /* of the finer orbit                                                  */
    double tolerance, seconds;      /* its tolerance; processor time for all of it                         */
} iso_error;

#endif
