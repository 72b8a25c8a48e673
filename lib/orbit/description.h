/* description.h - the # lines of a trajectory: what a record says of its ball and its effects.
 *
 *     # k, J, D      the ball; D = m b^2 where an effect needs it
 *     # radius       |b|, the unit of lengths where columns have some; without it 1
 *     # h, eps       energy of the ball, coupling of the point
 *     # effects      names of those there are (but clock), and their numbers: `# gravity.mgb`, `# level.c`, ...
 */
#ifndef ISO_ORBIT_DESCRIPTION_H
#define ISO_ORBIT_DESCRIPTION_H

#include "base/record.h"
#include "orbit/orbit.h"

/* The column of a file of several orbits that numbers them. It is no column of a trajectory. */
#define ISO_ORBIT_COLUMN "orbit"

/* Reads the parameters from the lines `k`, `J` and `D`. Errors: ISO_BAD_INPUT about "k", "J" or "D" (absent,
 * wrong). */
iso_status iso_record_params(iso_context *ctx, const iso_record *record, iso_params *params);

/* The effects of the lines, `up` and `quaternion` as at time 0. Errors: ISO_BAD_INPUT about "effects". */
iso_status iso_record_effects(iso_context *ctx, const iso_record *record, iso_effects *effects);

/* The coupling that the lines state, by eps or by h; false: they do not, or *status says what is wrong with them. */
bool iso_record_coupling(iso_context *ctx, const iso_record *record, const iso_params *params, double *eps,
                         iso_status *status);

/* Row `row` of a trajectory as a sample; what it lacks is NaN. */
void iso_record_sample(const iso_record *record, size_t row, iso_sample *sample);

/* Row `row` of a record as the start of an orbit in `model`, whose columns it must have; of `effects`, those of the
 * record, `up` and `quaternion` become the row's. A point's coupling is the record's eps (or that of its h), or
 * without these lines the one with which H is 0, or the level's.
 * Errors: ISO_BAD_INPUT with the row: a missing column, a row that is no state. */
iso_status iso_record_start(iso_context *ctx, const iso_record *record, const iso_params *params,
                            iso_model_kind model, size_t row, iso_start *start, iso_effects *effects);

#endif
