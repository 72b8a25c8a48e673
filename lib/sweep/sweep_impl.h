/* sweep_impl.h - what can be measured at the points of a sweep, and what the library and the command need besides of
 * sweeps, their files and rows.
 *
 * Every study that has numbers of a scene (iso_study.fields) can be measured. sweep_quantity.c lists them, and the few
 * that have columns of their own.
 */
#ifndef ISO_SWEEP_IMPL_H
#define ISO_SWEEP_IMPL_H

#include <stdio.h>

#include "base/field.h"
#include "study/study.h"
#include "sweep/sweep.h"

enum { ISO_SWEEP_NUMBERS = 192 /* of one quantity, at most */ };

struct iso_sweep_job;

/* What can be measured: a study, whose numbers are the columns. */
typedef struct iso_sweep_quantity {
    const char *name; /* in sweeps */
    const iso_study *study;
    const char *columns; /* NAME or NAME=NUMBER with blanks between; NULL: all numbers of the study, by their names */
    size_t points;       /* of a chunk of about a second; 0: `chunk` tells */
    size_t (*chunk)(const struct iso_sweep_job *job);
    void (*add)(struct iso_sweep_job *job); /* not NULL: adds the columns, which depend on the scene               */
    bool (*has)(const struct iso_sweep_job *job, const char *name); /* of its columns a job has those; NULL: all   */
    void (*settle)(const struct iso_sweep_job *job, void *options); /* sets what no option says; NULL: nothing     */
    /* Why a point has failed though it has a result. NULL: if the study says that some of it failed. */
    iso_status (*check)(iso_context *ctx, const void *found);
    bool (*together)(
        const struct iso_sweep_job *job); /* whether the points of a chunk are measured together; NULL: no */
} iso_sweep_quantity;

/* A request of the plan with all that its quantity needs: options, vectors, and its columns. */
typedef struct iso_sweep_job {
    iso_sweep_quantity quantity;
    const iso_scene *base;
    const char *vectors;
    char *text;                                      /* of the options, which keep parts of it */
    void *options;                                   /* of the study */
    bool begun;                                      /* they are to be ended */
    iso_sweep_column *column;                        /* of its own ... */
    char number[ISO_SWEEP_NUMBERS][ISO_COLUMN_SIZE]; /* ... and which numbers of the study they are */
    int count, first;                                /* how many; in a row they begin at `first` */
} iso_sweep_job;

/* The points of a chunk. */
typedef struct iso_sweep_batch {
    size_t count;
    iso_scene *room;
    const iso_scene **scene; /* of point i; NULL: it could not be made */
    iso_sweep_rows *rows;
} iso_sweep_batch;

/* The quantities of one run (sweep_run.c). state: at the end, or at a turn; its columns are those of the scene. */
extern const iso_study iso_state_study, iso_error_study, iso_contact_study;
void iso_sweep_add_state(iso_sweep_job *job);
void iso_sweep_settle_state(const iso_sweep_job *job, void *options);
size_t iso_sweep_state_chunk(const iso_sweep_job *job);

/* The value of an option in lines NAME=VALUE, the last one of this name. NULL: it is not there. */
const char *iso_sweep_option(const char *options, const char *name);

/* The i-th quantity; false past the end. */
bool iso_sweep_quantity_at(int i, iso_sweep_quantity *quantity);

/* The study of a quantity, by its name; NULL: there is none. Whether it has such an option. */
const iso_study *iso_sweep_study(const char *quantity);
bool iso_sweep_has_option(const char *quantity, const char *option);

/* Prepares a job, without columns: column and first are set. plan: tells for how long, the base and the vectors.
 * Errors: ISO_BAD_INPUT and ISO_NOT_MAPPED about the quantity, whose study refuses the options, or an effect of the
 * base; ISO_NO_MEMORY. */
iso_status iso_sweep_job_begin(iso_context *ctx, const iso_sweep_plan *plan, const iso_sweep_request *request,
                               iso_sweep_job *job);
void iso_sweep_job_end(iso_sweep_job *job);

/* Adds all columns of a job; those of these columns that it has, as in iso_sweep_quantity.columns. */
void iso_sweep_add_columns(iso_sweep_job *job);
void iso_sweep_add(iso_sweep_job *job, const char *columns);

/* Its numbers of all points of a chunk. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
iso_status iso_sweep_measure(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *batch);

/* Calls `visit` for each column that a table of a sweep can have, besides those of what varies. There are no values.
 * The field lives as long as the call. */
void iso_sweep_columns_visit(iso_column_visitor *visit, void *data);

/* Notes a failure of point i, whose words the context has; a second one of the same point is not noted. Gives ISO_OK,
 * or the status if this computer failed now, not the point: ISO_NO_MEMORY, ISO_STOPPED. job NULL: of no quantity. */
iso_status iso_sweep_note(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *batch, size_t i,
                          iso_status status);

/* Adds bytes to a hash of 128 bits, which begins as {0, 0}. It is for telling sweeps apart, not for secrets. */
void iso_sweep_hash(uint64_t hash[2], const void *bytes, size_t length);

/* Adds the version of isoroll and the texts of a sweep and of its scene's own file (NULL: it has none). Ends of lines
 * do not count: a result as CSV keeps the lines alone. */
void iso_sweep_hash_texts(uint64_t hash[2], const char *version, const char *text, const char *scene);

/* Adds all else that the rows depend on. alone: the vectors of an orbit that is alone are there. swapped: as a machine
 * with the other order of bytes has it. */
void iso_sweep_hash_head(uint64_t hash[2], const iso_sweep_head *head, bool alone, bool swapped);

/* Whether the hash of a head is that of what it says, by its version on some machine: with or without AVX2, of
 * either order of bytes. */
bool iso_sweep_head_fits(const iso_sweep_head *head);

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* Errors: ISO_NO_MEMORY. */
iso_status iso_sweep_rows_create(iso_context *ctx, int columns, size_t most, iso_sweep_rows *rows);
void iso_sweep_rows_free(iso_sweep_rows *rows);

/* All of it is one block of so many bytes, from rows->number on; the reasons stand last. */
size_t iso_sweep_rows_bytes(const iso_sweep_rows *rows);

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
