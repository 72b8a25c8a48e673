/* options.h - how a command states its options, and how they are read.
 *
 * Each command has
 *     a struct of its own, with a field for each thing that it can be told;
 *     a value of this struct, with what holds when the user says nothing;
 *     a table of rows, one row for each option: how it is called, how it is read, and where in the struct it goes.
 * A row that several commands have is written once, here or in the header of the options it belongs to, as a macro.
 * The help, the man pages and the completions are all made from the rows.
 */
#ifndef ISOROLL_OPTIONS_H
#define ISOROLL_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

struct command;

/* What a file named by an option is for. No file is written over one that is read, or written twice. */
typedef enum option_file { OPTION_NO_FILE, OPTION_READS, OPTION_WRITES } option_file;

typedef struct option_row {
    const char *name;     /* without the two dashes; NULL ends a table              */
    const char *argument; /* in --help; "[=N]": it may be left out; NULL: no argument */
    const char *expected; /* in the message about a wrong argument                  */
    const char *doc;
    bool (*set)(void *at, const char *text); /* false: the text is wrong            */
    size_t offset;                           /* of the field in the command's struct */
    char letter;                             /* of the short form, 'o' for -o; 0: none */
    option_file file;
    const char *(*word)(int i); /* the i-th word that the argument can be, NULL after the last; NULL: no such list */
    bool aside;                 /* changes no number of a table; so does a row whose file is written         */
} option_row;

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

/* Setters: each reads one kind of argument into the field at `at`. */
bool set_text(void *at, const char *text);      /* const char *, not empty              */
bool set_flag(void *at, const char *text);      /* bool                                 */
bool set_number(void *at, const char *text);    /* double, finite                       */
bool set_positive(void *at, const char *text);  /* double, > 0                          */
bool set_bound(void *at, const char *text);     /* double, >= 0                         */
bool set_whole(void *at, const char *text);     /* double, a whole number from 0 on     */
bool set_count(void *at, const char *text);     /* double, a whole number from 1 on     */
bool set_tolerance(void *at, const char *text); /* double, as the methods take it       */
bool set_vector(void *at, const char *text);    /* double[3], three numbers and commas  */
bool set_method(void *at, const char *text);    /* const char *, a method or auto       */
bool set_backend(void *at, const char *text);   /* iso_backend: ball, point, exact, auto */
bool set_as(void *at, const char *text);        /* iso_models: ball, point, both         */
bool set_target(void *at, const char *text);    /* iso_model_kind: ball, point          */
bool set_digits(void *at, const char *text);    /* int, 1 to 17, or ISO_HEXADECIMAL     */

/* A whole number from 0 on, as set_whole and set_count read it, as an int: 1e9 if it is larger. */
int as_int(double whole);

/* Whether `path` names a regular file. Of a pipe nothing may be read to see what it is: it can be read only once. */
bool is_regular(const char *path);

/* Whether a path ends in `ending`, in these letters, and has more before it. */
bool ends_with(const char *path, const char *ending);

/* Lists of words. */
const char *backend_word(int i);
const char *as_word(int i);
const char *target_word(int i);

/* A row: name, argument, expected and doc as above, its setter, and its field in the struct `type`. */
#define ROW(name_, argument_, expected_, doc_, set_, type, field)                                                    \
    {                                                                                                                \
        .name = name_, .argument = argument_, .expected = expected_, .doc = doc_, .set = set_,                       \
        .offset = offsetof(type, field)                                                                              \
    }

/* The row of a file, with its short form (0: none) and what the file is for. */
#define ROW_OF_FILE(name_, argument_, expected_, doc_, set_, type, field, letter_, file_)                            \
    {                                                                                                                \
        .name = name_, .argument = argument_, .expected = expected_, .doc = doc_, .set = set_,                       \
        .offset = offsetof(type, field), .letter = letter_, .file = file_                                            \
    }

/* The row of an option whose argument is one of a list of words. */
#define ROW_OF_WORDS(name_, argument_, expected_, doc_, set_, type, field, word_)                                    \
    {                                                                                                                \
        .name = name_, .argument = argument_, .expected = expected_, .doc = doc_, .set = set_,                       \
        .offset = offsetof(type, field), .word = word_                                                               \
    }

/* The last row of a table. */
#define ROW_END                                                                                                      \
    {                                                                                                                \
        .name = NULL                                                                                                 \
    }

/* Rows that several commands have; `field` is their place in the struct `type`. */
#define ROW_OUTPUT(type, field)                                                                                      \
    ROW_OF_FILE("output", "FILE", "a file", "write to FILE; - is standard output", set_text, type, field, 'o',       \
                OPTION_WRITES)
#define ROW_PLOT(type, field)                                                                                        \
    ROW_OF_FILE("plot", "FILE", "a file", "draw a picture: .svg, .png or .pdf", set_text, type, field, 0,            \
                OPTION_WRITES)
#define ROW_THREADS(type, field)                                                                                     \
    {                                                                                                                \
        .name = "threads", .argument = "N", .expected = "a whole number from 1 on",                                  \
        .doc = "threads that work (default: one for each processor)", .set = set_count,                              \
        .offset = offsetof(type, field), .letter = 'j', .aside = true                                                \
    }
#define ROW_MODELS(type, field)                                                                                      \
    ROW_OF_WORDS("model", "M", "ball, point or both",                                                                \
                 "which model is integrated (default: both, where the ball has a twin)", set_as, type, field,        \
                 as_word)
#define ROW_SEED(type, field)                                                                                        \
    ROW("seed", "N", "a whole number from 0 on", "another number spreads --starts in another way (default 0)",       \
        set_whole, type, field)
#define ROW_JSON(type, field)                                                                                        \
    {                                                                                                                \
        .name = "json", .doc = "print everything as JSON", .set = set_flag, .offset = offsetof(type, field),         \
        .aside = true                                                                                                \
    }

#endif
