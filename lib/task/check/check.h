/* check.h - does a trajectory solve its model? Constraints, integrals, clocks, and the flow from row to row. */
#ifndef ISO_TASK_CHECK_CHECK_H
#define ISO_TASK_CHECK_CHECK_H

#include "base/field.h"
#include "base/record.h"
#include "orbit/orbit.h"

enum { ISO_MAX_RESIDUALS = 64 };

/* One quantity that should be zero, up to rounding and the method's error. */
typedef struct iso_residual {
    char name[48];    /* "ball |n|", "point H", "ball flow", "clock s", ... */
    const char *what; /* in words                                           */
    double worst;     /* the largest, relative                              */
    size_t row;       /* the row of the largest, from 1; 0: all are zero    */
} iso_residual;

typedef struct iso_residuals {
    size_t rows, passed; /* all rows, and those of nan, which were passed over */
    int count;
    iso_residual residual[ISO_MAX_RESIDUALS];
} iso_residuals;

/* A record with the column `orbit` holds several orbits of one energy; another begins where that number changes.
 * Looks at every model whose six columns the record has:
 * - constraints (|n| = 1, (w,n) = 0; |gamma| = 1, (M,gamma) = 0), relative to the lengths of the vectors;
 * - integrals that hold for k and J: |I(row) - I(first row of the orbit)| / size (iso_integral); of the energy
 *   the first row of all. H of a point must be 0, not its first value, if the record has a ball's columns or clocks;
 * - flow: each row is integrated to the time of the next row (at `tolerance`) and compared with it, relative to the
 *   largest component of omega or M, and to 1 for n and gamma. The record must have a clock for this;
 * - the columns of effects (e, q, contact, trace, centre, N, pressure, friction, lambda): the same, relative to the
 *   largest number of the vector; forces and torques also to N; mu as the angle atan mu;
 * - the map: if the record has both models, each row's point against the point that belongs to its ball;
 * - clocks: if the record has two of t, tau, s, the steps of the second along the first, relative to its length;
 * - lines: h, eps and c of a level against the first row of each orbit, relative to the size of the energy's terms;
 *   numbers that turn with the ball (`# gravity.up`, `# attitude.quaternion`) against a row at time 0. Other lines
 *   are the numbers of the equations that all this is done with.
 * Errors, with the row: ISO_BAD_INPUT (no model's columns, a row that is no state, a time that is not finite),
 * ISO_NOT_MAPPED (a point with H not 0 in the times of a ball), ISO_NUMERICAL, ISO_NO_MEMORY. */
iso_status iso_check(iso_context *ctx, const iso_params *params, const iso_record *record, double tolerance,
                     iso_residuals *residuals);

#endif
