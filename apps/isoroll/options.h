/* options.h - how a command states its options, and how they are read.
 *
 * Each command has
 *     a struct of its own, with a field for each of its options;
 *     a value of this struct, the defaults (zeros, if there is none);
 *     a table of rows, one row for each option: how it is called, how it is read, and where in the struct it goes.
 * A row that several commands have is written once, here or in the header of the options it belongs to, as a macro.
 * The help, the man pages and the completions are all made from the rows.
 */
#ifndef ISOROLL_OPTIONS_H
#define ISOROLL_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "study/options_impl.h"

struct command;

/* What a file named by an option is for. No file is written over one that is read, or written twice. */
typedef enum option_file { OPTION_NO_FILE, OPTION_READS, OPTION_WRITES } option_file;

/* A row of a study (study/study.h), or of the command alone; `file` is an option_file. */
typedef iso_option option_row;

typedef enum options_result { OPTIONS_WRONG, OPTIONS_HELP, OPTIONS_DONE } options_result;

/* All arguments of a command that takes more than one. */
typedef struct file_list {
    char **path;
    int count;
} file_list;

/* Reads the arguments of a command into its struct, which already holds the defaults. OPTIONS_WRONG: a message has
 * been given. */
options_result options_read(const struct command *c, int argc, char **argv, void *options);

/* The command that was read last, as one line: its name, its options and its arguments, quoted where a shell needs
 * it. Without the options that change no number of a table: bytes of tables do not depend on them. */
const char *options_command(void);

/* The rows of a command, and after them --help; NULL after the last. */
const option_row *options_row(const struct command *c, int i);

/* Setters, beside those of studies (study/options_impl.h). */
bool set_digits(void *at, const char *text); /* int, 1 to 17, or ISO_HEXADECIMAL */

/* An option, and whether it was given. */
typedef struct given_option {
    bool given;
    const char *name;
} given_option;

/* Refuses the first one that was given, in a list that ends with a name NULL; why: a text. */
iso_status refuse_given(iso_context *ctx, const given_option list[], const char *why);

/* Whether `path` names a regular file. Of a pipe nothing may be read to see what it is: it can be read only once. */
bool is_regular(const char *path);

/* Whether a path ends in `ending`, in these letters, and has more before it. */
bool ends_with(const char *path, const char *ending);

/* A row: name, argument, expected, doc, setter, and place in the struct `type`, as above; and further members. */
#define ROW_WITH(name_, argument_, expected_, doc_, set_, type, field, ...)                                          \
    {                                                                                                                \
        .name = name_, .argument = argument_, .expected = expected_, .doc = doc_, .set = set_,                       \
        .offset = offsetof(type, field), __VA_ARGS__                                                                 \
    }
#define ROW ISO_OPTION

/* All rows of a study. Its struct of options must be the first member of the command's. */
#define ROWS_OF_STUDY(rows_)                                                                                         \
    {                                                                                                                \
        .name = "", .rows = rows_                                                                                    \
    }

/* The row of a file, with its short form (0: none) and what the file is for. */
#define ROW_OF_FILE(name_, argument_, expected_, doc_, set_, type, field, letter_, file_)                            \
    ROW_WITH(name_, argument_, expected_, doc_, set_, type, field, .letter = letter_, .file = file_)

/* The row of an option whose argument is one of a list of words. */
#define ROW_OF_WORDS ISO_OPTION_WORDS

/* The last row of a table. */
#define ROW_END ISO_OPTION_END

/* Rows that several commands have; `field` is their place in the struct `type`. */
#define ROW_OUTPUT(type, field)                                                                                      \
    ROW_OF_FILE("output", "FILE", "a file", "write to FILE; - is standard output", iso_set_text, type, field, 'o',   \
                OPTION_WRITES)
#define ROW_THREADS ISO_OPTION_THREADS
#define ROW_JSON(type, field)                                                                                        \
    ROW_WITH("json", NULL, NULL, "print everything as JSON", iso_set_flag, type, field, .aside = true)

#endif
