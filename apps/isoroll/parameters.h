/* parameters.h - k, J and eps of a trajectory file: its own lines, or the options. */
#ifndef ISOROLL_PARAMETERS_H
#define ISOROLL_PARAMETERS_H

#include "command.h"

/* Puts what the options say into the record of the file (its lines, its row tolerance), and reads the parameters from
 * the lines. */
iso_status parameters_of_file(iso_context *ctx, const options *o, iso_record *record, iso_params *params);

/* Puts the file's name before the context's message, where it is not there yet; gives `status`. */
iso_status name_the_file(iso_context *ctx, const options *o, iso_status status);

#endif
