/* study.h - studies by their names, with options as text: what the command, Python and others ask of a scene or of a
 * trajectory.
 *
 *     iso_study_result result = {.sink = {.note = show, .progress = draw}};
 *     const iso_study_subject subject = {.scene = &scene};
 *     status = iso_study_ask_text(ctx, iso_study_find("chaos"), &subject, "turns=500\nstarts=20", &result);
 *     ... iso_record_rows(result.table[0]) ...
 *     iso_study_result_free(&result);
 *
 * An option of a study is described once, by an iso_option: its name, help and place in the struct of options. The
 * command line and the calls for other languages are read by the same rows.
 */
#ifndef ISO_STUDY_STUDY_H
#define ISO_STUDY_STUDY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/field.h"
#include "base/record.h"
#include "base/sink.h"
#include "orbit/scene.h"

typedef struct iso_option {
    const char *name;     /* without the two dashes; NULL ends a table              */
    const char *argument; /* in --help; "[=N]": it may be left out; NULL: no argument */
    const char *expected; /* in the message about a wrong argument                  */
    const char *doc;
    bool (*set)(void *at, const char *text); /* false: the text is wrong            */
    size_t offset;                           /* of the member in the struct of options */
    char letter;                             /* of the command's short form, 'o' for -o; 0: none */
    int file;                                /* for the command: what the named file is for; 0: it names no file */
    const char *(*word)(int i); /* the i-th word that the argument can be, NULL after the last; NULL: no such list */
    bool aside;                 /* changes no number of a table, as names of output files do not */
    const struct iso_option *rows; /* not NULL: in place of this row, all of these */
} iso_option;

/* A row: name, argument, expected and doc as above, its setter, and its member in the struct `type`. */
#define ISO_OPTION(name_, argument_, expected_, doc_, set_, type, member)                                            \
    {                                                                                                                \
        .name = name_, .argument = argument_, .expected = expected_, .doc = doc_, .set = set_,                       \
        .offset = offsetof(type, member)                                                                             \
    }

/* What its text is: "flag", "whole", "number", "numbers" (three, with commas between), "word", or "text". */
const char *iso_option_type(const iso_option *option);

enum { ISO_STUDY_TABLES = 6, ISO_STUDY_MOST_AT = 64 };

/* Where rows come from: next() gives one in *row, which has the last one before. */
typedef struct iso_source_row {
    double *number;
    size_t line;  /* of the file; of a record the number of the row, from 1                         */
    bool orbits;  /* there are several, told apart by a column `orbit`, ...                         */
    double orbit; /* ... which has this number                                                  */
    bool more, begins_orbit;
    size_t passed;       /* rows of nan so far                                         */
    const char *ignored; /* columns that are no part of the rows, in words; NULL: none */
} iso_source_row;

typedef struct iso_row_source {
    iso_status (*next)(iso_context *ctx, void *data, iso_source_row *row);
    void *data;
} iso_row_source;

/* The rows of a record as such a source, whose data are an iso_kept_rows: next row 0 at the beginning. */
typedef struct iso_kept_rows {
    const iso_record *record;
    const iso_sink *sink; /* of progress */
    bool passes_nan;      /* over rows of nan, which are counted */
    size_t row;
} iso_kept_rows;
iso_status iso_kept_rows_next(iso_context *ctx, void *kept, iso_source_row *row);

/* What is studied. */
typedef struct iso_study_subject {
    const iso_scene *scene;     /* NULL: none                                                        */
    const char *name;           /* of its file, in the line `command` of tables and in messages; NULL: not known */
    const iso_record *record;   /* a trajectory; NULL: none                                           */
    const iso_row_source *rows; /* of the record, which has columns and lines alone; NULL: it has its rows  */
    const char *command;        /* the line itself; NULL: made from the options                       */
} iso_study_subject;

/* The result of a study, and who takes rows, notes and progress meanwhile. */
typedef struct iso_study_result {
    /* NULL: there is none. The lines of the first table hold the scene, the command line, and the whole result with the
     * names of the command's JSON. */
    iso_record *table[ISO_STUDY_TABLES];
    const iso_field *fields; /* of `found`: the result as a struct, ...                         */
    void *found;             /* ... which some studies have besides                             */
    void (*free)(void *found);
    char *text;  /* what the study tells people (base/fold_impl.h prints it); NULL: nothing */
    bool failed; /* some of what was asked for failed, or was found to be wrong: notes or the tables say what */
    /* Of the studies run, section and convert, rows go to sink.row where that is not NULL, and to no table. */
    iso_sink sink;
} iso_study_result;

/* What a study needs, ... and what it can use as well. */
enum { ISO_STUDY_OF_SCENE = 1, ISO_STUDY_OF_RECORD = 2, ISO_STUDY_USES_SCENE = 4, ISO_STUDY_USES_RECORD = 8 };

/* Its rows go to the sink as they are found; their header says all, without a command line. */
enum { ISO_STUDY_STREAMS = 16 };

typedef struct iso_study {
    const char *name, *doc; /* doc: one line */
    const iso_option *options;
    size_t size;                  /* of its struct of options */
    void (*begin)(void *options); /* puts the defaults there */
    void (*end)(void *options);   /* frees what `prepare` has allocated; NULL: nothing */
    /* Reads the arguments that setters only kept as text, and refuses options that exclude each other; NULL: there is
     * nothing to do. Errors: ISO_BAD_ARGUMENT, ISO_NO_MEMORY. */
    iso_status (*prepare)(iso_context *ctx, void *options);
    /* After an error the result may have what was found before. Errors: those of the study. */
    iso_status (*run)(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result);
    unsigned of; /* ISO_STUDY_OF_SCENE, ... */
    /* Of what it finds in one scene. Its numbers are columns of sweeps; NULL: it is no quantity of a sweep, as its
     * numbers differ from run to run. */
    const iso_field *fields;
    /* Prints what was found, for people; NULL: nothing. */
    void (*print)(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);
    /* Adds lines to the first table, among them its title; NULL: none. */
    iso_status (*describe)(iso_context *ctx, const iso_scene *scene, const void *options, iso_study_result *result);
} iso_study;

/* The i-th study; NULL past the end. By its name; NULL: there is none. */
const iso_study *iso_study_at(int i);
const iso_study *iso_study_find(const char *name);

/* Reads one option, `name` as the command calls it; of a flag the text is "true". Errors: ISO_BAD_ARGUMENT about the
 * name. */
iso_status iso_study_set(iso_context *ctx, const iso_study *study, const char *name, const char *text, void *options);

/* The row of an option, of which `length` characters are the name; NULL: there is none. */
const iso_option *iso_study_option_find(const iso_study *study, const char *name, size_t length);

/* Runs a study. options: lines NAME=VALUE with a newline between, or NULL. Errors: ISO_BAD_ARGUMENT about an option,
 * or about "scene" or "record", which the study needs; those of the study. Without a row the tables are NULL then. */
iso_status iso_study_ask_text(iso_context *ctx, const iso_study *study, const iso_study_subject *subject,
                              const char *options, iso_study_result *result);

/* The same with options that were read before (iso_study_read). */
iso_status iso_study_answer(iso_context *ctx, const iso_study *study, const iso_study_subject *subject,
                            const void *options, iso_study_result *result);

/* Adds the lines `command`, `title` and the study's own to the first table. */
iso_status iso_study_describe(iso_context *ctx, const iso_study *study, const iso_study_subject *subject,
                              const void *options, iso_study_result *result);

/* Frees the tables, the text and what was found. */
void iso_study_result_free(iso_study_result *result);

#endif
