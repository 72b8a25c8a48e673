/* command.h - what a command of isoroll is, and the list of them all. */
#ifndef ISOROLL_COMMAND_H
#define ISOROLL_COMMAND_H

#include <stdio.h>

#include "file_kind.h"
#include "options.h"
#include "progress.h"
#include "report.h"
#include "shell.h"

typedef struct command {
    const char *name;
    const char *argument;       /* "SCENE", "[FILE]", "[TOPIC]": in brackets it may be left out, and is then "-" */
    const char *doc;            /* one line; NULL: the study's                                          */
    const option_row *rows;     /* of its options                                                       */
    const void *defaults;       /* a value of its struct of options; NULL: zeros                        */
    size_t size;                /* of that struct                                                       */
    size_t file;                /* offset of the argument in it, a const char *                         */
    unsigned takes;             /* kinds of file that the argument can be (file_kind.h); 0: not looked at */
    size_t files;               /* offset of a file_list in it, for further arguments; 0: there are none */
    const iso_study *study;     /* its struct of options is the first member; NULL: none             */
    const char *(*word)(int i); /* the words that the argument can be; NULL: it is a file           */
    const char *description;    /* paragraphs with an empty line between; lines are folded          */
    const char *example;        /* lines as they are typed                                          */
    const char *exits;          /* lines about exit statuses that need words; NULL: the usual ones  */
    int (*run)(iso_context *ctx, const void *options); /* returns the exit status; NULL: ...            */
    shell_parts parts; /* ... shell_run, with these; its shell_options begin with the argument          */
} command;

/* What the row of every command begins with: name, argument and doc as above, and where the argument stands in its
 * `options`. Its file has `rows`. */
#define COMMAND_OF_ZEROS(name_, argument_, doc_, file_)                                                              \
    .name = name_, .argument = argument_, .doc = doc_, .rows = rows, .size = sizeof(options),                        \
    .file = offsetof(options, file_)
#define COMMAND(name_, argument_, doc_, file_)                                                                       \
    COMMAND_OF_ZEROS(name_, argument_, doc_, file_), .defaults = &defaults, .run = run

/* The same for a study, whose name and doc it has. */
#define COMMAND_OF_STUDY(study_, argument_, file_)                                                                   \
    COMMAND_OF_ZEROS(#study_, argument_, NULL, file_), .study = &iso_##study_##_study

/* A study of a scene, and the struct of options of its command. */
#define COMMAND_OF_SCENE(study_) COMMAND_OF_STUDY(study_, "SCENE", shell.file), .takes = FILE_SCENE
#define OPTIONS_OF_SCENE(request)                                                                                    \
    typedef struct options {                                                                                         \
        request study;                                                                                               \
        shell_options shell;                                                                                         \
    } options

/* What it does, in one line. */
const char *command_doc(const command *c);

/* All commands in the order of --help; NULL after the last. Adding a command is one file and one word in
 * commands.c, in its group; that of a study has its word in the list of studies (study/options_impl.h). */
extern const command *const commands[];

/* How --help arranges them: the first `count` commands, and so on; title NULL after the last. */
typedef struct command_group {
    const char *title;
    int count;
} command_group;
extern const command_group command_groups[];

/* NULL: there is none of that name. */
const command *command_find(const char *name);

/* The name of the i-th command; NULL past the last. */
const char *command_word(int i);

/* What the program is for, and its exit statuses, in words. */
extern const char *const about_isoroll;
extern const char *const about_exits;

/* Prints the help of one command, of the program. */
void help_command(const command *c, FILE *to);
void help_program(FILE *to);

/* Scripts that complete the command line. They ask `isoroll --complete WORD...`: */
extern const char complete_bash[], complete_zsh[];

/* Prints the words that may stand in the place of the last of word[0..count), which follow "isoroll": one a line, then
 * a tab and what it is for. None: a name of a file, or no command. */
void complete_line(int count, char *word[]);

/* --- program.c: how a program of isoroll begins, runs a command, and ends -------------------------------------- */

/* Sets up the process: streams, signals, the libraries. Call it first. */
void program_begin(void);

/* Reads the options and runs the command; argv[0] is its name. Returns the exit status. */
int program_run(const command *c, int argc, char **argv);

/* Writes what was printed. Returns the exit status: another one if that fails. */
int program_flush(int status);

void program_version(void);

#endif
