/* command.h - what the commands of isoroll share: their table, their options, their exit statuses. */
#ifndef ISOROLL_COMMAND_H
#define ISOROLL_COMMAND_H

#include <stdbool.h>
#include <stdio.h>

#include "isoroll.h"

enum exit_status {
    EXIT_DONE = 0,
    EXIT_SOME_FAILED = 1, /* rows or cells; a bound of `check`; interrupted */
    EXIT_USAGE = 2,
    EXIT_BAD_INPUT = 3,
    EXIT_NUMERICAL = 4,
    EXIT_FILE = 5,
};

/* Everything the commands can be told; each command takes the options it names. */
typedef struct options {
    const char *file;      /* the argument after the options, "-" when absent and optional     */
    const char *output;    /* -o                                                               */
    const char *plot;      /* --plot                                                           */
    const char *times;     /* --times                                                          */
    const char *method;    /* --method                                                         */
    iso_picture backend, as, to; /* -1: not given                                              */
    double tolerance, end, step, k, eps, h, bound; /* NAN: not given                           */
    double J[3], neumann[3]; /* [0] NAN: not given                                             */
    double energy;         /* NAN: not given                                                   */
    double mass, radius;   /* --mass, --radius                                                 */
    double rows;           /* --rows                                                           */
    double turns, samples; /* NAN: not given                                                   */
    const char *csv;       /* --csv                                                            */
    double want;           /* --want; NAN: not given                                           */
    double horizons;       /* --horizons; 0: not given                                         */
    const char *scene;     /* --scene                                                          */
    const char *columns;   /* --columns                                                        */
    int digits;            /* --digits; ISO_HEXADECIMAL                                        */
    double max_defect;     /* NAN: not given                                                   */
    double row_tolerance;  /* --row-tolerance                                                  */
    bool json, level, quick, quiet, shift_J, strict, verbose, help;
} options;

typedef struct command {
    const char *name;
    const char *argument; /* "SCENE", "[FILE]", "[TOPIC]": in brackets it may be absent        */
    const char *doc;      /* one line                                                          */
    const char *options;  /* names of those it takes, blanks around each                       */
    const char *more;     /* paragraph of --help                                               */
    int (*run)(iso_context *ctx, const options *o);
} command;

extern const command command_run, command_convert, command_compare, command_cost, command_check, command_analogue,
    command_explain, command_frequencies, command_list, command_plot;

/* Reads the options of `command`. False: wrong ones, a message has been given. */
bool options_read(const command *c, int argc, char **argv, options *o);

/* Prints the usage of one command. */
void options_help(const command *c, FILE *to);

/* Says "isoroll: MESSAGE" on stderr. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Says the context's message and gives the exit status that belongs to `status`. A closed pipe and a
 * stop on request are not complained of. */
int finish(iso_context *ctx, iso_status status);

/* The scene in o->file with what the options change in it. */
iso_status scene_with_options(iso_context *ctx, const options *o, iso_scene *scene);

/* As finish(), after a failure with the scene: says where in its file the cause stands, unless an option put it there. */
int finish_scene(iso_context *ctx, const options *o, const iso_scene *scene, iso_status status);

/* The effects that act, with their numbers and, if wanted, what they are; nothing where there are none. */
void print_effects(const iso_effects *effects, bool docs);

/* From now on SIGINT, SIGTERM and SIGHUP only ask to stop, unless they come again two seconds later. */
void stop_gently(void);

/* True once the user has asked to stop. */
bool interrupted(void);

/* A bar on stderr, drawn when it is a terminal and the work has lasted longer than a second. */
void progress_show(double part);
void progress_end(void);

#endif
