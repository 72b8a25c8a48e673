/* family.h - what a sweep is about: many scenes that differ in some numbers, and what is asked of each.
 *
 * A point of a sweep is one scene. Point i is a pure function of i: any process can make it without the other points.
 * A plan is filled by iso_sweep_read (sweep/sweep_file.h) or by hand; sweep/sweep.h computes its rows.
 *
 * Points are computed in chunks. The size of a chunk follows from the plan alone. So the rows of a chunk are the same
 * whoever computes them, on how many threads, and in which order.
 */
#ifndef ISO_ORBIT_FAMILY_H
#define ISO_ORBIT_FAMILY_H

#include <stdint.h>

#include "../base/api.h"
#include "../orbit/scene.h"

ISO_C_BEGIN

/* --- the points ------------------------------------------------------------------------------------------------- */

typedef struct iso_family {
    size_t count;                      /* of points */
    int columns;                       /* how many numbers vary ... */
    const char (*name)[ISO_NAME_SIZE]; /* ... and their names */
    /* Makes the scene of point i, and the numbers that vary. Threads call it at the same time, each with its own
     * context. After an error numbers that are not known are NaN. Errors: those of iso_scene_read. */
    iso_status (*scene)(iso_context *ctx, const void *data, size_t i, iso_scene *scene, double numbers[]);
    const void *data;
    const iso_scene *base; /* the scene that the others are made from: every point has its effects and columns */
} iso_family;

/* --- what is asked ---------------------------------------------------------------------------------------------- */

enum { ISO_SWEEP_SETTINGS = 6, ISO_SWEEP_REQUESTS = 16 };

/* A number or a word that a quantity can be told in a sweep file. */
typedef struct iso_sweep_setting {
    const char *name;           /* NULL ends a list                                                     */
    const char *(*word)(int i); /* the words that it can be: the setting is then i; NULL: it is a number */
    double usual;               /* where the file does not say it; NaN: the scene's                      */
    double least, most;         /* of a number                                                           */
    bool whole;                 /* the number is whole                                                   */
} iso_sweep_setting;

/* What a sweep file must know of a quantity that can be measured. */
typedef struct iso_sweep_quantity {
    const char *name, *doc;
    const iso_sweep_setting *settings; /* NULL: none                                          */
    bool turns, time;                  /* it can go on for a number of turns; to a given time */
} iso_sweep_quantity;

/* One quantity that is asked for. */
typedef struct iso_sweep_request {
    int topic; /* its number in the list of topics */
    double setting[ISO_SWEEP_SETTINGS];
    iso_place place; /* where the file asks for it; line 0: nowhere */
} iso_sweep_request;

typedef struct iso_sweep_plan {
    iso_family family;
    int wishes;
    iso_sweep_request wish[ISO_SWEEP_REQUESTS];
    double turns, time;          /* how long each orbit goes on; NaN: not said           */
    size_t chunk;                /* points of a chunk; 0: as the quantities suggest      */
    char vectors[ISO_NAME_SIZE]; /* see batch.h; empty: the widest of this processor     */
    uint64_t hash[2];            /* of the texts of the sweep and its scene; 0 by hand   */
    const char *text, *scene;    /* of the sweep file and its scene's file, for the result; may be NULL */
} iso_sweep_plan;

/* --- what comes out --------------------------------------------------------------------------------------------- */

enum { ISO_REASON_SIZE = 200 };

typedef struct iso_sweep_column {
    char group[ISO_NAME_SIZE], name[ISO_NAME_SIZE]; /* group: "vary", or the quantity's name */
} iso_sweep_column;

/* What the rows of a sweep are: all that a file of results says besides the rows. */
typedef struct iso_sweep_head {
    size_t count, chunk; /* points, and points of a chunk; the last chunk may have fewer */
    int columns;
    const iso_sweep_column *column;
    char vectors[ISO_NAME_SIZE];
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

/* Errors: ISO_NO_MEMORY. */
ISO_API iso_status iso_sweep_rows_create(iso_context *ctx, int columns, size_t most, iso_sweep_rows *rows);
ISO_API void iso_sweep_rows_free(iso_sweep_rows *rows);

/* The number of chunks, and how many points chunk c has. */
ISO_API size_t iso_sweep_chunks(const iso_sweep_head *head);
ISO_API size_t iso_sweep_chunk_points(const iso_sweep_head *head, size_t c);

ISO_C_END

#endif
