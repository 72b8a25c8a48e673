/* check.h - does a trajectory solve its model? Constraints, integrals, clocks, and the flow from row to row. */
#ifndef ISO_STUDY_CHECK_H
#define ISO_STUDY_CHECK_H

#include "../base/record.h"
#include "../orbit/orbit.h"

enum { ISO_MAX_RESIDUALS = 32 };

/* One thing that should be zero (to rounding and to the method's error). */
typedef struct iso_residual {
    char name[48];    /* "ball |n|", "point H", "ball flow", "clock s", ... */
    const char *what; /* in words                                           */
    double worst;     /* relative                                           */
    size_t row;       /* where, counted from 1; 0: nowhere                  */
} iso_residual;

typedef struct iso_residuals {
    size_t rows;
    int count;
    iso_residual residual[ISO_MAX_RESIDUALS];
} iso_residuals;

/* Looks at every model whose six columns the record has:
 * - constraints (|n| = 1, (w,n) = 0 / |gamma| = 1, (M,gamma) = 0), relative to the vectors' lengths;
 * - integrals that hold for k and J: |I(row) - I(first row)| / size (iso_integral); H of a point against 0
 *   if the record has a ball's columns or clocks;
 * - flow: each row integrated to the time of the next (at `tolerance`), the difference relative to the
 *   largest component of omega or M and to 1; for this the record needs a clock;
 * - the columns of effects (e, q, contact, trace, centre, N, pressure, friction, lambda): likewise, relative to the largest
 *   number of the vector;
 * - the map: with both models in the record, each row's point against the point of its ball;
 * - clocks: with two of t, tau, s in the record, the steps of the one along the other, relative to the whole.
 * Errors, with the row: ISO_BAD_INPUT (no model's columns, a row that is no state, a time that is not finite),
 * ISO_NOT_MAPPED (a point off the level H = 0 in the times of a ball), ISO_NUMERICAL, ISO_NO_MEMORY. */
iso_status iso_check(iso_context *ctx, const iso_params *params, const iso_record *record, double tolerance,
                     iso_residuals *residuals);

/* The drifts of the integrals that hold, over the rows: a new record with the model's first clock (or the row's number,
 * "row"), then |I(row) - I(first row)| / size, or for constraints that from their value, in columns "h", "F_shell", ...
 * Errors: as iso_check. */
iso_status iso_check_drifts(iso_context *ctx, const iso_params *params, const iso_record *record, iso_record **drifts);

#endif
