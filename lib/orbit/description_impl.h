/* description_impl.h - single lines of a description, and starts from rows. */
#ifndef ISO_ORBIT_DESCRIPTION_IMPL_H
#define ISO_ORBIT_DESCRIPTION_IMPL_H

#include "orbit/description.h"

/* The key of the line that states a number of an effect: "effect.number". */
void iso_effect_line(char key[ISO_NAME_SIZE], const iso_effect *effect, const iso_effect_number *number);

/* Writes the start of an orbit as a scene states it: `initial.normal` and `initial.angular_velocity` of a ball,
 * `initial.gamma` and `initial.M` of a point. */
iso_status iso_record_describe_start(iso_context *ctx, iso_record *record, const iso_start *start);

/* The six columns of a model. Errors: ISO_BAD_INPUT about "columns". */
iso_status iso_record_find_state(iso_context *ctx, const iso_record *record, iso_model_kind model,
                                 int columns[ISO_STATE]);

/* Six numbers of a row as the start of an orbit in `model`; eps of a point, or NULL. Rows of others have few
 * digits: `tolerance` says how far |n| (|gamma|) may be from 1, and how large a part of omega along n (of M along
 * gamma) may be, relative to omega. A ball that twists may have any such part.
 * Errors: ISO_BAD_INPUT: not within the tolerance (the message names one that takes the row), or no state at all. */
iso_status iso_start_from_row(iso_context *ctx, iso_model_kind model, const double y[ISO_STATE], const double *eps,
                              bool twists, double tolerance, iso_start *start);

/* The same of a row that is not in the record: `row` has as many numbers as the record has columns. Messages do not
 * give its place. */
iso_status iso_record_start_at(iso_context *ctx, const iso_record *record, const iso_params *params,
                               iso_model_kind model, const double row[], iso_start *start, iso_effects *effects);

#endif
