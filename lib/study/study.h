/* study.h - studies by their names, with options as text: what the command, Python and others ask of every study.
 *
 *     const iso_study *study = iso_study_find("chaos");
 *     iso_study_result result = {0};
 *     void *how = malloc(study->size);
 *     study->begin(how);
 *     status = iso_study_set(ctx, study, "turns", "500", how);
 *     if (status == ISO_OK && study->prepare) status = study->prepare(ctx, how);
 *     if (status == ISO_OK) status = study->run(ctx, &scene, how, &result);
 *     if (study->end) study->end(how);
 *     free(how);
 *
 * Then result.table[0] has a row for each orbit; iso_record_free frees it.
 *
 * An option of a study is described once, by an iso_option: its name, help and place in the struct of options. The
 * command line and the calls for other languages are read by the same rows.
 */
#ifndef ISO_STUDY_STUDY_H
#define ISO_STUDY_STUDY_H

#include <stdbool.h>
#include <stddef.h>

#include "../base/api.h"
#include "../base/record.h"
#include "../orbit/scene.h"

ISO_C_BEGIN

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
    const struct iso_option *more; /* not NULL: in place of this row, `count` rows from here on */
    int count;
} iso_option;

/* A row: name, argument, expected and doc as above, its setter, and its member in the struct `type`. */
#define ISO_OPTION(name_, argument_, expected_, doc_, set_, type, member)                                            \
    {                                                                                                                \
        .name = name_, .argument = argument_, .expected = expected_, .doc = doc_, .set = set_,                       \
        .offset = offsetof(type, member)                                                                             \
    }

enum { ISO_STUDY_TABLES = 3, ISO_STUDY_MOST_AT = 64 };

/* What a study gives. The tables are the caller's to free; NULL: there is none. */
typedef struct iso_study_result {
    iso_record *table[ISO_STUDY_TABLES];
    void (*note)(void *data, const char *words); /* called with a remark for the user; NULL: remarks are dropped */
    void *data;
} iso_study_result;

typedef struct iso_study {
    const char *name;
    const iso_option *options;
    size_t size;                  /* of its struct of options */
    void (*begin)(void *options); /* puts the defaults there */
    void (*end)(void *options);   /* frees what `prepare` has allocated; NULL: nothing */
    /* Reads the arguments that setters only kept as text; NULL: there are none. Errors: ISO_BAD_ARGUMENT,
     * ISO_NO_MEMORY. */
    iso_status (*prepare)(iso_context *ctx, void *options);
    /* The `key: value` lines of the first table hold the whole result, with the names of the command's JSON. After an
     * error the tables may have what was found before. Errors: those of the study. */
    iso_status (*run)(iso_context *ctx, const iso_scene *scene, const void *options, iso_study_result *result);
} iso_study;

/* The i-th study; NULL past the end. By its name; NULL: there is none. */
ISO_API const iso_study *iso_study_at(int i);
ISO_API const iso_study *iso_study_find(const char *name);

/* Reads one option, `name` as the command calls it; of a flag the text is "true". Errors: ISO_BAD_ARGUMENT about the
 * name. */
ISO_API iso_status iso_study_set(iso_context *ctx, const iso_study *study, const char *name, const char *text,
                                 void *options);

ISO_C_END

#endif
