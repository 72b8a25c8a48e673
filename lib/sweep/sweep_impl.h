/* sweep_impl.h - sweeps: many scenes that differ in some numbers, and what is measured at each of them.
 *
 *     iso_sweep_file *file;
 *     iso_sweep *sweep;
 *     status = iso_sweep_read(ctx, "sweep.yaml", &file);
 *     status = iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep);
 *     status = iso_sweep_run(ctx, sweep, 0, &source);                   source.take gets the rows, chunk by chunk
 *     iso_sweep_free(sweep);
 *     iso_sweep_file_free(file);
 *
 * A point of a sweep is one scene. Point i is a pure function of i. Points are computed in chunks, whose size follows
 * from the plan alone. So the rows of a chunk are the same whoever computes them, on how many threads, and in which
 * order. lib/doc/formats.md says what stands in a file of a sweep and in its result.
 *
 * What is measured is a study (study/study.h) of the scene of the point, with options of its own: its numbers
 * (iso_study.fields) are the columns. sweep_quantity.c lists the few that have columns of their own: the words of older
 * sweeps, and the quantities of a run,
 *
 *     state        the state at the time `until`, or at the turn `until`
 *     error        largest errors over the rows of `run`
 *     contact      when contact is lost
 *
 * The numbers are those that the command finds for the scene of the point, to the bit, with the same vectors. A word
 * is the number of its place: a verdict is 0 (regular), 1 (chaotic), 2 (undecided) or 3 (integrable).
 */
#ifndef ISO_SWEEP_SWEEP_IMPL_H
#define ISO_SWEEP_SWEEP_IMPL_H

#include <stdint.h>
#include <stdio.h>

#include "base/field.h"
#include "orbit/scene.h"
#include "study/study.h"

/* --- the points, and what is measured --------------------------------------------------------------------------- */

typedef struct iso_family {
    size_t count;                      /* of points */
    int columns;                       /* how many numbers vary ... */
    const char (*name)[ISO_NAME_SIZE]; /* ... and their names */
    /* Makes the scene of point i, and the numbers that vary. Threads call it at the same time, each with its own
     * context. After an error numbers that are not known are NaN. Errors: those of iso_scene_load. */
    iso_status (*scene)(iso_context *ctx, const void *data, size_t i, iso_scene *scene, double numbers[]);
    const void *data;
    const iso_scene *base; /* the scene that the others are made from: every point has its effects and columns */
} iso_family;

/* One quantity that is asked for. */
enum { ISO_SWEEP_REQUESTS = 16 };
typedef struct iso_sweep_request {
    const char *name;    /* of the quantity */
    const char *options; /* of its study, lines NAME=VALUE; NULL: none */
    iso_place place;     /* where the file asks for it; line 0: nowhere */
} iso_sweep_request;

/* Filled by iso_sweep_read, or by hand. */
typedef struct iso_sweep_plan {
    iso_family family;
    int requests;
    iso_sweep_request request[ISO_SWEEP_REQUESTS];
    double turns, time;          /* how long each orbit goes on; NaN: not said           */
    size_t chunk;                /* points of a chunk; 0: as the quantities suggest      */
    char vectors[ISO_NAME_SIZE]; /* see batch.h; empty: the widest of this processor     */
    uint64_t hash[2];            /* of the texts of the sweep and its scene; 0 by hand   */
    const char *text, *scene;    /* of the sweep file and its scene's file, for the result; may be NULL */
} iso_sweep_plan;

/* --- files ------------------------------------------------------------------------------------------------------ */

typedef struct iso_sweep_file iso_sweep_file;

/* Reads the sweep in the file `path` ("-" is standard input), or in a text that messages call `name`. A scene's file is
 * sought in the folder of this name. Errors: ISO_BAD_INPUT with line and column, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_sweep_read(iso_context *ctx, const char *path, iso_sweep_file **file);
iso_status iso_sweep_parse(iso_context *ctx, const char *name, const char *text, size_t length,
                           iso_sweep_file **file);
void iso_sweep_file_free(iso_sweep_file *file);

/* What the file says. It is valid until the file is freed. */
const iso_sweep_plan *iso_sweep_file_plan(const iso_sweep_file *file);

/* Prints what varies, in lines such as "  k: 61 values from -3 to 3". */
void iso_sweep_print_axes(const iso_sweep_file *file, FILE *to);

/* How many points have k = 0, where there is no ball: they will fail. Of values that are drawn none is counted. */
size_t iso_sweep_zeros_of_k(const iso_sweep_file *file);

/* Prints the scene of point i: it reads back as the same scene, to the bit. Errors: those of the point, which is then
 * not printed. */
iso_status iso_sweep_print_point(iso_context *ctx, const iso_sweep_file *file, size_t i, FILE *to);

/* How many points it has, and how long it takes here, as text; for this a few points are computed. *text is the
 * caller's to free. Errors: ISO_STOPPED, ISO_NO_MEMORY, and those of iso_sweep_create. */
iso_status iso_sweep_explain(iso_context *ctx, const iso_sweep_file *file, char **text);

/* Whether a text is a sweep, with mistakes in it or not: YAML that has a key `vary` or `measure` at its top. */
bool iso_sweep_is_one(const char *text, size_t length);

/* --- rows ------------------------------------------------------------------------------------------------------- */

typedef struct iso_sweep_column {
    char group[ISO_NAME_SIZE], name[2 * ISO_NAME_SIZE]; /* group: "vary", or the quantity's name */
} iso_sweep_column;

/* What the rows of a sweep are: all that a file of results says besides the rows. */
typedef struct iso_sweep_head {
    size_t count, chunk; /* points, and points of a chunk; the last chunk may have fewer */
    int columns;
    const iso_sweep_column *column;
    char vectors[ISO_NAME_SIZE];
    const char *version;      /* of isoroll, that computes or computed its rows */
    uint64_t hash[2];         /* of everything that the rows depend on */
    const char *text, *scene; /* of the sweep file, and of the scene's own; scene NULL: it is in the sweep's */
} iso_sweep_head;

/* The number of chunks, and of points of chunk c. */
size_t iso_sweep_chunks(const iso_sweep_head *head);
size_t iso_sweep_chunk_points(const iso_sweep_head *head, size_t c);

enum { ISO_REASON_SIZE = 200 };

/* The rows of one chunk. A point that fails has a status and a reason; its missing numbers are NaN. */
typedef struct iso_sweep_rows {
    int columns;
    size_t most, first, count; /* room, in points; first point; points here */
    double *number;            /* number[columns i + c]                     */
    iso_status *status;
    char (*reason)[ISO_REASON_SIZE];
} iso_sweep_rows;

/* Errors: ISO_NO_MEMORY. */
iso_status iso_sweep_rows_create(iso_context *ctx, int columns, size_t most, iso_sweep_rows *rows);
void iso_sweep_rows_free(iso_sweep_rows *rows);

/* All of it is one block of so many bytes, from rows->number on; the reasons stand last. */
size_t iso_sweep_rows_bytes(const iso_sweep_rows *rows);

/* --- running ---------------------------------------------------------------------------------------------------- */

typedef struct iso_sweep iso_sweep;

/* The plan must live as long as the sweep. Errors: ISO_BAD_INPUT or ISO_NOT_MAPPED about the name of a quantity that
 * the scene does not have, or whose options are wrong; ISO_BAD_ARGUMENT about "vectors"; ISO_NO_MEMORY. */
iso_status iso_sweep_create(iso_context *ctx, const iso_sweep_plan *plan, iso_sweep **sweep);
void iso_sweep_free(iso_sweep *sweep);

/* What its rows are. It is valid until the sweep is freed. */
const iso_sweep_head *iso_sweep_head_of(const iso_sweep *sweep);

/* Where chunks come from and where their rows go. Both functions are called by one thread at a time. */
typedef struct iso_sweep_source {
    bool (*next)(void *data, size_t *c); /* the next chunk to be computed; false: there is none */
    /* The rows of a chunk. Any answer but ISO_OK ends the run: chunks that are being computed are thrown away. */
    iso_status (*take)(void *data, iso_context *ctx, size_t c, const iso_sweep_rows *rows);
    void *data;
} iso_sweep_source;

/* Measures chunks on `threads` threads (0: as many as there are processors) until there is no next one.
 * Errors: what `take` answers; ISO_STOPPED by the context's monitor, which is asked often and throws away what is
 * being computed (to let it end, let `next` answer false); ISO_NO_MEMORY. */
iso_status iso_sweep_run(iso_context *ctx, const iso_sweep *sweep, int threads, const iso_sweep_source *source);

/* Measures `count` points from `first` on. rows has room for them. Threads may call this at the
 * same time, with contexts and rows of their own. A point that fails is a row with its reason, and no error of the
 * call. Errors: ISO_STOPPED by the context's monitor, ISO_NO_MEMORY: then the rows are not valid. */
iso_status iso_sweep_compute_points(iso_context *ctx, const iso_sweep *sweep, size_t first, size_t count,
                                    iso_sweep_rows *rows);

/* --- quantities ------------------------------------------------------------------------------------------------- */

enum { ISO_SWEEP_NUMBERS = 192 /* of one quantity, at most */ };

struct iso_sweep_job;

/* What can be measured: a study, whose numbers are the columns. */
typedef struct iso_sweep_quantity {
    const char *name; /* in sweeps */
    const iso_study *study;
    const char *columns; /* NAME or NAME=NUMBER with blanks between; NULL: all numbers of the study, by their names */
    size_t points;       /* of a chunk of about a second; 0: see `chunk` */
    size_t (*chunk)(const struct iso_sweep_job *job);
    void (*add)(struct iso_sweep_job *job); /* not NULL: adds the columns, which depend on the scene               */
    bool (*has)(const struct iso_sweep_job *job, const char *name); /* of its columns a job has those; NULL: all   */
    size_t vectors,
        flag; /* offsets + 1 of options that no text sets: the plan's vectors, a bool that is true; 0: none */
    /* Why a point has failed though it has a result. NULL: if the study says that some of it failed. */
    iso_status (*check)(iso_context *ctx, const void *found);
    bool (*together)(
        const struct iso_sweep_job *job); /* whether the points of a chunk are measured together; NULL: no */
} iso_sweep_quantity;

/* The i-th quantity; false past the end. The study of one, by its name; NULL: there is none. */
bool iso_sweep_quantity_at(int i, iso_sweep_quantity *quantity);
const iso_study *iso_sweep_study(const char *quantity);

/* The value of an option in lines NAME=VALUE, the last one of this name. NULL: it is not there. */
const char *iso_sweep_option(const char *options, const char *name);

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

/* Prepares a job whose vectors, column and first are set, and adds its columns. plan: for how long, and the base.
 * Errors: ISO_BAD_INPUT and ISO_NOT_MAPPED about the quantity, whose study refuses the options, or an effect of the
 * base; ISO_NO_MEMORY. */
iso_status iso_sweep_job_begin(iso_context *ctx, const iso_sweep_plan *plan, const iso_sweep_request *request,
                               iso_sweep_job *job);
void iso_sweep_job_end(iso_sweep_job *job);

/* Adds those of these columns that a job has, as in iso_sweep_quantity.columns. */
void iso_sweep_add(iso_sweep_job *job, const char *columns);

/* Calls `visit` for each column that a table of a sweep can have, besides those of what varies. There are no values.
 * The field lives as long as the call. */
void iso_sweep_columns_visit(iso_column_visitor *visit, void *data);

/* The points of a chunk. */
typedef struct iso_sweep_batch {
    size_t count;
    iso_scene *room;
    const iso_scene **scene; /* of point i; NULL: it could not be made */
    iso_sweep_rows *rows;
} iso_sweep_batch;

/* The numbers of a job for all points of a chunk. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
iso_status iso_sweep_measure(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *batch);

/* Notes a failure of point i, whose message the context has; a second one of the same point is not noted. Returns
 * ISO_OK, or the status if this computer failed now, not the point: ISO_NO_MEMORY, ISO_STOPPED. job NULL: of no
 * quantity. */
iso_status iso_sweep_note(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *batch, size_t i,
                          iso_status status);

/* The quantities of one run (sweep_run.c). state: at the end, or at a turn; its columns are those of the scene. */
extern const iso_study iso_state_study, iso_error_study, iso_contact_study;
typedef struct iso_state_request {
    iso_models as, models;        /* -1: not given */
    double turns, end, tolerance; /* NAN: not given */
    const char *vectors;
} iso_state_request;
void iso_sweep_add_state(iso_sweep_job *job);
size_t iso_sweep_state_chunk(const iso_sweep_job *job);

/* --- the hash --------------------------------------------------------------------------------------------------- */

/* Adds the version of isoroll and the texts of a sweep and of its scene's own file (NULL: it has none) to a hash of 128
 * bits, which begins as {0, 0}. It is for telling sweeps apart, not for secrets. Ends of lines do not count: a result
 * as CSV keeps the lines alone. */
void iso_sweep_hash_texts(uint64_t hash[2], const char *version, const char *text, const char *scene);

/* Adds all else that the rows depend on. alone: the vectors of an orbit that is alone are there. swapped: as a machine
 * with the other order of bytes has it. */
void iso_sweep_hash_head(uint64_t hash[2], const iso_sweep_head *head, bool alone, bool swapped);

/* Whether the hash of a head is that of what it says, by its version on some machine: with or without AVX2, of
 * either order of bytes. */
bool iso_sweep_head_fits(const iso_sweep_head *head);

#endif
