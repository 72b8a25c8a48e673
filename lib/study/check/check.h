/* check.h - does a trajectory solve its model? Constraints, integrals, clocks, and the flow from row to row. */
#ifndef ISO_STUDY_CHECK_H
#define ISO_STUDY_CHECK_H

#include "../../base/api.h"
#include "../../base/field.h"
#include "../../base/record.h"
#include "../../orbit/orbit.h"

ISO_C_BEGIN

enum { ISO_MAX_RESIDUALS = 64 };

/* One quantity that should be zero, up to rounding and the method's error. */
typedef struct iso_residual {
    char name[48];    /* "ball |n|", "point H", "ball flow", "clock s", ... */
    const char *what; /* in words                                           */
    double worst;     /* the largest, relative                              */
    size_t row;       /* the row of the largest, from 1; 0: all are zero    */
} iso_residual;
ISO_API extern const iso_field iso_residual_fields[];

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
ISO_API iso_status iso_check(iso_context *ctx, const iso_params *params, const iso_record *record, double tolerance,
                             iso_residuals *residuals);

/* --- row by row ---------------------------------------------------------------------------------------------------
 *
 *     iso_checking_create(ctx, &params, header, 1e-13, &c);
 *     while (next(row)) status = iso_checking_put(c, row); (before it iso_checking_begin_orbit, where one begins)
 *     status = iso_checking_end(c, &residuals);
 *     iso_checking_free(c);
 *
 * The same as iso_check, in constant memory. Where two rows are near each other, two-point Taylor quadrature
 * finds the rows that are worst, and these alone are integrated. */
typedef struct iso_checking iso_checking;

/* header: columns, lines and row tolerance; it and params must outlive the check. Errors: those of iso_check about
 * columns and lines; *checking is then NULL. */
ISO_API iso_status iso_checking_create(iso_context *ctx, const iso_params *params, const iso_record *header,
                                       double tolerance, iso_checking **checking);
ISO_API void iso_checking_free(iso_checking *checking);

/* The next row: as many numbers as the header has columns. Errors: those of iso_check. */
ISO_API iso_status iso_checking_put(iso_checking *checking, const double row[]);

/* The next row is the first of another orbit, of the same energy: no flow goes to it from the row before, and the
 * integrals but the energy may have other values. */
ISO_API void iso_checking_begin_orbit(iso_checking *checking);

/* Call this in the place of a row of nan: it is counted, and the flow goes from the row before to the one behind. */
ISO_API void iso_checking_pass(iso_checking *checking);

/* After the last row. Errors: ISO_BAD_INPUT, if there was none. */
ISO_API iso_status iso_checking_end(iso_checking *checking, iso_residuals *residuals);

/* What the check does not look at: columns that nothing was compared with, and lines in which each number can be
 * another by a millionth, or the words others, without any residual to show it. This is tried, number by number, at
 * the first row and a little later. Calls `tell` for each: "mu", "# tolerance", "# J, number 2"; and "the flow from row
 * to row" where no orbit has two rows, or no clock. Call it after
 * iso_checking_end. Errors: ISO_NO_MEMORY, ISO_STOPPED. */
ISO_API iso_status iso_checking_unseen(iso_checking *checking, void (*tell)(void *data, const char *name),
                                       void *data);

/* The drifts of the integrals that hold, row by row, as a new record. The first column is the model's first clock, or
 * "row", the row's number. The others ("h", "F_shell", ...) are |I(row) - I(first row)| / size; for a constraint its
 * exact value stands in the place of I(first row). Errors: those of iso_check. */
ISO_API iso_status iso_check_drifts(iso_context *ctx, const iso_params *params, const iso_record *record,
                                    iso_record **drifts);

ISO_C_END

#endif
