/* shell.h - how a command asks a study (study/study.h) and shows what it found: text, JSON, a table, a picture. */
#ifndef ISOROLL_SHELL_H
#define ISOROLL_SHELL_H

#include "json.h"
#include "plot/draw.h"
#include "study/study.h"

/* Options of every such command. */
typedef struct shell_options {
    const char *file;  /* of the scene; first */
    const char *table; /* NULL: not given     */
    iso_plot_page plot;
    bool json;
} shell_options;

/* What is at hand when the study has been asked. */
typedef struct shell {
    iso_context *ctx;
    const iso_study *study;
    const void *options; /* of the command */
    const shell_options *common;
    iso_scene scene;
    iso_study_subject subject;
    iso_study_result result; /* table[0] is there */
} shell;

/* What a command adds. A function that is NULL has nothing to do. */
typedef struct shell_parts {
    const char *kind;                    /* of the table in files                                  */
    iso_status (*check)(const shell *s); /* refuses options; NULL: `-o -` beside --json            */
    iso_status (*change)(shell *s);      /* changes the scene                                      */
    const char *stopped;                 /* the message after Ctrl-C ...                           */
    void (*interrupted)(const shell *s); /* ... or who prints it; table[0] may be NULL             */
    json_t *(*json)(const shell *s);     /* NULL: version, k, J and all that was found             */
    int (*write)(const shell *s);        /* writes what is no table; returns the exit status       */
    int (*draw)(const shell *s);         /* returns the exit status; NULL: draws the table by kind */
} shell_parts;

/* Returns the exit status. */
int shell_run(iso_context *ctx, const iso_study *study, const shell_parts *parts, const void *options,
              const shell_options *common);

/* A `change` of commands whose options begin with those that change something in a scene. */
iso_status shell_change(shell *s);

/* Draws a table by its kind; returns the exit status. */
int shell_draw(const shell *s, const iso_record *table);

#endif
