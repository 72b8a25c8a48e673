/* parameters.h - the options about a trajectory file: what it does not say itself of k, J, eps and its columns. */
#ifndef ISOROLL_PARAMETERS_H
#define ISOROLL_PARAMETERS_H

#include "command.h"
#include "study/file_parameters_impl.h"

typedef struct file_options {
    const char *file;
    const char *scene, *columns; /* NULL: not given */
    iso_file_parameters added;
} file_options;

#define FILE_OPTIONS_UNSET                                                                                           \
    {                                                                                                                \
        .file = "-", .added = ISO_FILE_PARAMETERS_UNSET                                                              \
    }

/* Their rows; `from` is the place of a file_options in the struct `type`. */
#define ROW_OF_ITS_SCENE(type, field)                                                                                \
    ROW_OF_FILE("scene", "FILE", "a file", "take k, J and the effects from this scene", iso_set_text, type, field,   \
                0, OPTION_READS)
#define ROW_COLUMNS(type, field)                                                                                     \
    ROW("columns", "NAMES", "names with commas between", "the file's columns from left to right; - for others",      \
        iso_set_text, type, field)
#define ROWS_OF_FILE(type, from)                                                                                     \
    ISO_OPTIONS_FILE_PARAMETERS(type, from.added), ROW_OF_ITS_SCENE(type, from.scene),                               \
        ROW_COLUMNS(type, from.columns), ISO_OPTION_ROW_TOLERANCE(type, from.added)

/* The first of these options that was given, `columns` last; NULL: none. */
const char *file_option_given(const file_options *o);

/* Puts what the options say into the record of the file (its lines, its row tolerance), and reads the parameters from
 * the lines. */
iso_status parameters_of_file(iso_context *ctx, const file_options *o, iso_record *record, iso_params *params);

/* Puts the file's name before the context's message, unless it names a place, a file or an option already. Returns
 * `status`. */
iso_status name_the_file(iso_context *ctx, const char *file, iso_status status);

#endif
