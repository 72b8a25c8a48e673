/* check.h - does a trajectory solve its model? Constraints, integrals, clocks, and the flow from row to row. */
#ifndef ISO_STUDY_CHECK_H
#define ISO_STUDY_CHECK_H

#include "../base/api.h"
#include "../base/record.h"
#include "../orbit/orbit.h"

ISO_C_BEGIN

enum { ISO_MAX_RESIDUALS = 32 };

/* One quantity that should be zero, up to rounding and the method's error. */
typedef struct iso_residual {
    char name[48];    /* "ball |n|", "point H", "ball flow", "clock s", ... */
    const char *what; /* in words                                           */
    double worst;     /* the largest, relative                              */
    size_t row;       /* the row of the largest, from 1; 0: all are zero    */
} iso_residual;

typedef struct iso_residuals {
    size_t rows;
    int count;
    iso_residual residual[ISO_MAX_RESIDUALS];
} iso_residuals;

/* Looks at every model whose six columns the record has:
 * - constraints (|n| = 1, (w,n) = 0; |gamma| = 1, (M,gamma) = 0), relative to the lengths of the vectors;
 * - integrals that hold for k and J: |I(row) - I(first row)| / size (iso_integral). H of a point must be 0, not its
 *   first value, if the record has a ball's columns or clocks;
 * - flow: each row is integrated to the time of the next row (at `tolerance`) and compared with it, relative to the
 *   largest component of omega or M, and to 1 for n and gamma. The record must have a clock for this;
 * - the columns of effects (e, q, contact, trace, centre, N, pressure, friction, lambda): the same, relative to the
 *   largest number of the vector;
 * - the map: if the record has both models, each row's point against the point that belongs to its ball;
 * - clocks: if the record has two of t, tau, s, the steps of the second along the first, relative to its whole
 *   length.
 * Errors, with the row: ISO_BAD_INPUT (no model's columns, a row that is no state, a time that is not finite),
 * ISO_NOT_MAPPED (a point with H not 0 in the times of a ball), ISO_NUMERICAL, ISO_NO_MEMORY. */
ISO_API iso_status iso_check(iso_context *ctx, const iso_params *params, const iso_record *record, double tolerance,
                             iso_residuals *residuals);

/* The drifts of the integrals that hold, row by row, as a new record. The first column is the model's first clock, or
 * "row", the row's number. The others ("h", "F_shell", ...) are |I(row) - I(first row)| / size; for a constraint its
 * exact value stands in the place of I(first row). Errors: those of iso_check. */
ISO_API iso_status iso_check_drifts(iso_context *ctx, const iso_params *params, const iso_record *record,
                                    iso_record **drifts);

ISO_C_END

#endif
