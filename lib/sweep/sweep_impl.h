/* sweep_impl.h - what can be measured at the points of a sweep: one struct for each quantity; and what the library
 * and the command need besides of sweeps, their files and rows.
 *
 * To add a quantity, write its struct and a line in ISO_SWEEP_LIST. The reader of sweep files, the help and the rows
 * of results know it from there.
 */
#ifndef ISO_SWEEP_IMPL_H
#define ISO_SWEEP_IMPL_H

#include <stdio.h>

#include "base/field.h"
#include "sweep/sweep.h"

enum { ISO_SWEEP_NUMBERS = 48 /* of one quantity, at most */ };

struct iso_sweep_computation;

/* A request of the plan with all that its quantity needs: settings, length, vectors, and its columns. */
typedef struct iso_sweep_job {
    const struct iso_sweep_computation *computation;
    double setting[ISO_SWEEP_SETTINGS];
    double turns, time; /* NaN: not said */
    const char *vectors;
    const iso_scene *base;
    iso_sweep_column *column; /* of its own ... */
    int count, first;         /* ... of which there are `count`; in a row they begin at `first` */
} iso_sweep_job;

/* The points of a chunk. */
typedef struct iso_sweep_batch {
    size_t count;
    iso_scene *room;
    const iso_scene **scene; /* of point i; NULL: it could not be made */
    iso_sweep_rows *rows;
} iso_sweep_batch;

typedef struct iso_sweep_computation {
    iso_sweep_quantity quantity;
    const iso_field *fields[3]; /* what its columns are; NULL ends the lists */
    const char *names;          /* of its columns, with blanks between; NULL: those of the first list */
    bool (*has)(const iso_sweep_job *job, const char *name); /* of these names a job has those; NULL: all */
    void (*columns)(iso_sweep_job *job); /* not NULL: adds the columns, which depend on the scene         */
    size_t points;                       /* of a chunk of about a second; 0: `chunk` tells */
    size_t (*chunk)(const iso_sweep_job *job);
    /* Why the scenes of this sweep do not have it. NULL: all do. */
    iso_status (*refuse)(iso_context *ctx, const iso_sweep_job *job);
    /* Its numbers for one scene. Numbers that are not set are NaN. Errors: those of the point. */
    iso_status (*find)(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene, double number[]);
    /* Instead of find, where `together` says so: for all points of a chunk. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
    iso_status (*find_all)(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *batch);
    bool (*together)(const iso_sweep_job *job);
} iso_sweep_computation;

#define ISO_SWEEP_LIST(X) X(state) X(chaos) X(frequencies) X(splitting) X(rotations) X(backends) X(error) X(contact)
#define ISO_SWEEP_DECLARE(name) extern const iso_sweep_computation iso_sweep_##name;
ISO_SWEEP_LIST(ISO_SWEEP_DECLARE)

/* Adds those of these columns that the job has; their names have blanks between. */
void iso_sweep_add(iso_sweep_job *job, const char *names);

/* Calls `visit` for each column that a table of a sweep can have, besides those of what varies. There are no values.
 * The field lives as long as the call. */
void iso_sweep_columns_visit(iso_column_visitor *visit, void *data);

/* Fills those columns that a list of fields has, also those that are not for tables. */
void iso_sweep_fill(const iso_sweep_job *job, const iso_field fields[], const void *row, double number[]);

/* Notes a failure of point i, whose words the context has; a second one of the same point is not noted. Gives ISO_OK,
 * or the status if this computer failed now, not the point: ISO_NO_MEMORY, ISO_STOPPED. */
iso_status iso_sweep_note(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *batch, size_t i,
                          iso_status status);

/* The numbers of this quantity in the row of point i. */
double *iso_sweep_numbers(const iso_sweep_job *job, const iso_sweep_batch *batch, size_t i);

/* About an effect that acts, other than a level; the refusal of several quantities. */
iso_status iso_sweep_refuse_effects(iso_context *ctx, const iso_sweep_job *job);

/* ball, point, both */
const char *iso_sweep_models(int i);

/* Adds bytes to a hash of 128 bits, which begins as {0, 0}. It is for telling sweeps apart, not for secrets. */
void iso_sweep_hash(uint64_t hash[2], const void *bytes, size_t length);

/* Adds the version of isoroll and the texts of a sweep and of its scene's own file (NULL: it has none). Ends of lines
 * do not count: a result as CSV keeps the lines alone. */
void iso_sweep_hash_texts(uint64_t hash[2], const char *version, const char *text, const char *scene);

/* Adds all else that the rows depend on. alone: the vectors of an orbit that is alone are there. swapped: as a machine
 * with the other order of bytes has it. */
void iso_sweep_hash_head(uint64_t hash[2], const iso_sweep_head *head, bool alone, bool swapped);

/* Whether the hash of a head is that of what it says, by this version on some machine: with or without AVX2, of
 * either order of bytes. */
bool iso_sweep_head_fits(const iso_sweep_head *head, const char *version);

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* Errors: ISO_NO_MEMORY. */
iso_status iso_sweep_rows_create(iso_context *ctx, int columns, size_t most, iso_sweep_rows *rows);
void iso_sweep_rows_free(iso_sweep_rows *rows);

/* How many points chunk c has. */
size_t iso_sweep_chunk_points(const iso_sweep_head *head, size_t c);

/* Measures `count` points from `first` on. rows has room for them. Threads may call this at the
 * same time, with contexts and rows of their own. A point that fails is a row with its reason, and no error of the
 * call. Errors: ISO_STOPPED by the context's monitor, ISO_NO_MEMORY: then the rows are not valid. */
iso_status iso_sweep_compute_points(iso_context *ctx, const iso_sweep *sweep, size_t first, size_t count,
                                    iso_sweep_rows *rows);

/* --- files ------------------------------------------------------------------------------------------------------ */

/* As iso_sweep_read, from text, which messages call `name`. A scene's file is sought in the folder of `name`. */
iso_status iso_sweep_parse(iso_context *ctx, const char *name, const char *text, size_t length,
                           iso_sweep_file **file);

/* What varies, in words, such as "k: 61 values from -3 to 3"; false past the last. */
enum { ISO_SWEEP_WORDS = 176 };
bool iso_sweep_axis_words(const iso_sweep_file *file, int i, char words[ISO_SWEEP_WORDS]);

/* How many points have k = 0, where there is no ball: they will fail. Of values that are drawn none is counted. */
size_t iso_sweep_zeros_of_k(const iso_sweep_file *file);

/* Prints the scene of point i: it reads back as the same scene, to the bit. Errors: those of the point, which is then
 * not printed. */
iso_status iso_sweep_print_point(iso_context *ctx, const iso_sweep_file *file, size_t i, FILE *to);

/* How many points it has, and how long it takes here, in words; for this a few points are computed. *text is the
 * caller's to free. Errors: ISO_STOPPED, ISO_NO_MEMORY, and those of iso_sweep_create. */
iso_status iso_sweep_explain(iso_context *ctx, const iso_sweep_file *file, char **text);

/* Whether a text is a sweep, with mistakes in it or not: YAML that has a key `vary` or `measure` at its top. */
bool iso_sweep_is_one(const char *text, size_t length);

#endif
