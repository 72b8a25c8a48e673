/* parameters.h - the options about a trajectory file: what it does not say itself of k, J, eps and its columns. */
#ifndef ISOROLL_PARAMETERS_H
#define ISOROLL_PARAMETERS_H

#include <math.h>

#include "command.h"

typedef struct file_options {
    const char *file;
    const char *scene, *columns; /* NULL: not given */
    double k, J[3], eps, h;      /* NAN: not given  */
    double row_tolerance;        /* how far a row may be from a state */
} file_options;

#define FILE_OPTIONS_UNSET                                                                                           \
    {                                                                                                                \
        .file = "-", .k = NAN, .J = {NAN, NAN, NAN}, .eps = NAN, .h = NAN, .row_tolerance = ISO_ROW_TOLERANCE        \
    }

/* Their rows; `from` is the place of a file_options in the struct `type`. */
#define ROWS_OF_FILE(type, from)                                                                                     \
    ROW("k", "K", "a number", "geometry number k, if the file does not say it", iso_set_number, type, from.k),       \
        ROW("J", "J1,J2,J3", "three numbers J1,J2,J3",                                                               \
            "moments about the contact point, if the file does not say them", set_vector, type, from.J),             \
        ROW("eps", "X", "a number", "coupling of the point's potential, if the file does not say it",                \
            iso_set_number, type, from.eps),                                                                         \
        ROW("h", "X", "a number", "energy of the ball, in place of eps", iso_set_number, type, from.h),              \
        ROW_OF_FILE("scene", "FILE", "a file", "take k, J and the effects from this scene", iso_set_text, type,      \
                    from.scene, 0, OPTION_READS),                                                                    \
        ROW("columns", "NAMES", "names with commas between", "the file's columns from left to right; - for others",  \
            iso_set_text, type, from.columns),                                                                       \
        ROW("row-tolerance", "X", "a number in " ISO_TOLERANCE_RANGE,                                                \
            "largest error of a row's state (default 1e-5); more for rows of few digits", iso_set_tolerance, type,   \
            from.row_tolerance)

/* Puts what the options say into the record of the file (its lines, its row tolerance), and reads the parameters from
 * the lines. */
iso_status parameters_of_file(iso_context *ctx, const file_options *o, iso_record *record, iso_params *params);

/* Puts the file's name before the context's message, unless it names a place, a file or an option already. Gives
 * `status`. */
iso_status name_the_file(iso_context *ctx, const char *file, iso_status status);

#endif
