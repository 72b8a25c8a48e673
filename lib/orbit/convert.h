/* convert.h - whole trajectories from one model to the other, and what a record says of its ball.
 *
 * A record with the lines `k` and `J` (and `h` or `eps`) can be carried over and back: states row by row through (18),
 * the other model's clock by integrating from each row to the next. The columns are those of iso_trajectory_columns.
 */
#ifndef ISO_ORBIT_CONVERT_H
#define ISO_ORBIT_CONVERT_H

#include "../base/record.h"
#include "orbit.h"

/* The most steps from one row of a record to the next: a damaged time must not keep a program busy for ever. */
enum { ISO_MAX_ROW_STEPS = 10000000 };

/* Writes the lines that a record needs to be carried back: model, k, J, and of the orbit (NULL: not touched) h and eps.
 * On the level H = 0 what is no normal double in these units is left out: both follow from any row. A point off that
 * level has no h, and always its eps. */
iso_status iso_record_describe(iso_context *ctx, iso_record *record, const char *model, const iso_params *params,
                               const iso_orbit *orbit);

/* Reads them back: parameters from `k` and `J`. Errors: ISO_BAD_INPUT about "k" or "J" (absent or wrong). */
iso_status iso_record_params(iso_context *ctx, const iso_record *record, iso_params *params);

/* Row `row` of a record as the start of an orbit in `model`, whose columns it must have. A point's
 * coupling is the record's eps (or that of its h), or without these lines the one with which H = 0.
 * Errors: ISO_BAD_INPUT with the row: missing column, |n| or |gamma| not 1 to 1e-6, a part of omega along n (of M along
 * gamma) above 1e-6 of its length. */
iso_status iso_record_start(iso_context *ctx, const iso_record *record, const iso_params *params, iso_picture model,
                            size_t row, iso_start *start);

/* Carries `in`, which has one model's six columns, over to the model `to`: clock, then the six columns, one row for
 * each row of `in`, with the same lines. A clock already in the record is taken as it is; else it begins at 0 (or where
 * the line `t0` or `s0`, left by an earlier conversion, says) and is integrated from row to row at `tolerance` along
 * the record's own clock; without any clock in `in` there is none in the result.
 * Errors: ISO_BAD_INPUT with the row (a state that is none, times that do not run one way), ISO_NOT_MAPPED with the row
 * (at rest; a point off the level H = 0 of the record's eps or h), ISO_NUMERICAL, ISO_NO_MEMORY. */
iso_status iso_convert(iso_context *ctx, const iso_params *params, const iso_record *in, iso_picture to,
                       double tolerance, iso_record **out);

#endif
