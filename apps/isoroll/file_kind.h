/* file_kind.h - which kind of file a command was given, where its beginning tells; and options about a trajectory file:
 * what it does not say itself of k, J, eps and its columns. */
#ifndef ISOROLL_FILE_KIND_H
#define ISOROLL_FILE_KIND_H

#include <stdbool.h>
#include <stddef.h>

#include "io/table_impl.h"
#include "io/text_impl.h"
#include "study/file_parameters_impl.h"

struct command;

/* The kinds, as bits of command.takes. */
enum {
    FILE_SCENE = 1,
    FILE_SWEEP = 2, /* the YAML of a sweep */
    FILE_TRAJECTORY = 4,
    FILE_SECTION = 8,     /* or periodic orbits: a row is a place on the section, and can have the state there */
    FILE_RESULT = 16,     /* of a sweep */
    FILE_TABLE = 32,      /* of other commands: its rows are no states of one scene */
    FILE_HDF5 = 64,       /* its beginning does not tell what is in it */
    FILE_CERTIFIED = 128, /* rows of 'run --certify' */
    FILE_ROWS = FILE_TRAJECTORY | FILE_SECTION | FILE_HDF5
};

/* One of the kinds. 0: the file is no regular file, cannot be read, or its beginning does not tell. table: the name of
 * one of isoroll's tables; else "". */
unsigned file_kind(const char *path, char table[ISO_KIND_SIZE]);

/* Refuses a file that is surely of a kind that the command does not take: says what it is, and for what. False: it
 * was refused. */
bool file_fits(const struct command *c, const char *path);

/* --- options ---------------------------------------------------------------------------------------------------- */

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

#endif
