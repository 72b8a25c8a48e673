/* sweep.h - sweeps: many scenes that differ in some numbers, and what is measured at each of them.
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
 * order. lib/doc/formats.md tells what stands in a file of a sweep and in its result.
 *
 * What is measured is a study (study/study.h) of the scene of the point, with options of its own: its numbers are the
 * columns. Older words stand for some of them: `frequencies`, `splitting`, `rotations` (of `periodic`) and `backends`
 * (of `compare`). Besides there are the quantities of a run:
 *
 *     state        the state at the time `until`, or at the turn `until`
 *     error        largest errors over the rows of `run`
 *     contact      when contact is lost
 *
 * The numbers are those that the command gives for the scene of the point, to the bit, with the same vectors. A word
 * is the number of its place: a verdict is 0 (regular), 1 (chaotic), 2 (undecided) or 3 (integrable).
 */
#ifndef ISO_SWEEP_H
#define ISO_SWEEP_H

#include <stdint.h>

#include "orbit/scene.h"

/* --- the points ------------------------------------------------------------------------------------------------- */

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

/* --- what is asked ---------------------------------------------------------------------------------------------- */

enum { ISO_SWEEP_REQUESTS = 16 };

/* The name of the i-th quantity; NULL past the end. */
const char *iso_sweep_quantity_name(int i);

/* One quantity that is asked for. */
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

typedef struct iso_sweep_file iso_sweep_file;

/* Reads the sweep in the file `path` ("-" is standard input). The file of its scene is sought in the same folder.
 * Errors: ISO_BAD_INPUT with line and column, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_sweep_read(iso_context *ctx, const char *path, iso_sweep_file **file);
void iso_sweep_file_free(iso_sweep_file *file);

/* What the file says. It is valid until the file is freed. */
const iso_sweep_plan *iso_sweep_file_plan(const iso_sweep_file *file);

/* --- what comes out --------------------------------------------------------------------------------------------- */

enum { ISO_REASON_SIZE = 200 };

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

/* The rows of one chunk. A point that fails has a status and a reason; its missing numbers are NaN. */
typedef struct iso_sweep_rows {
    int columns;
    size_t most, first, count; /* room, in points; first point; points here */
    double *number;            /* number[columns i + c]                     */
    iso_status *status;
    char (*reason)[ISO_REASON_SIZE];
} iso_sweep_rows;

typedef struct iso_sweep iso_sweep;

/* The plan must live as long as the sweep. Errors: ISO_BAD_INPUT or ISO_NOT_MAPPED about the name of a quantity that the
 * scene does not have, or whose options are wrong; ISO_BAD_ARGUMENT about "vectors"; ISO_NO_MEMORY. */
iso_status iso_sweep_create(iso_context *ctx, const iso_sweep_plan *plan, iso_sweep **sweep);
void iso_sweep_free(iso_sweep *sweep);

/* What its rows are. It is valid until the sweep is freed. */
const iso_sweep_head *iso_sweep_head_of(const iso_sweep *sweep);

/* The number of chunks. */
size_t iso_sweep_chunks(const iso_sweep_head *head);

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

#endif
