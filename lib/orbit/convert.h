/* convert.h - whole trajectories from one model to the other.
 *
 * A record with the lines `k` and `J` (and `h` or `eps`) can be carried over and back: states row by row through (18),
 * the other model's clock by integrating from each row to the next. The columns are those of iso_trajectory_columns.
 */
#ifndef ISO_ORBIT_CONVERT_H
#define ISO_ORBIT_CONVERT_H

#include "description.h"

/* The most steps from one row of a record to the next: a damaged time must not keep a program busy for ever. */
enum { ISO_MAX_ROW_STEPS = 10000000 };

/* Carries `in`, which has one model's six columns, over to the model `to`: clock, then the six columns, one row for
 * each row of `in`, with the same lines. A clock already in the record is taken as it is; else it begins at 0 (or where
 * the line `t0` or `s0`, left by an earlier conversion, says) and is integrated from row to row at `tolerance` along
 * the record's own clock; without any clock in `in` there is none in the result. A point whose rows have one energy H off 0
 * becomes a ball in the potential of the effect `level`, which the lines of the result then name.
 * Errors: ISO_BAD_INPUT with the row (a state that is none, times that do not run one way), ISO_NOT_MAPPED with the row
 * (at rest; a point whose M does not belong to the record's eps or h and to the energy of the first row), or about an
 * effect that breaks the isomorphism, ISO_NUMERICAL, ISO_NO_MEMORY. */
iso_status iso_convert(iso_context *ctx, const iso_params *params, const iso_record *in, iso_picture to,
                       double tolerance, iso_record **out);

#endif
