/* sweep_impl.h - what can be measured at the points of a sweep: one struct for each quantity.
 *
 * To add a quantity, write its struct and a line in ISO_SWEEP_LIST. The reader of sweep files, the help and the rows
 * of results know it from there. sweep.c calls the quantities through this table; their files call back to note
 * failures and names of columns.
 */
#ifndef ISO_STUDY_SWEEP_IMPL_H
#define ISO_STUDY_SWEEP_IMPL_H

#include "sweep/sweep.h"

enum { ISO_SWEEP_NUMBERS = 48 /* of one quantity, at most */ };

struct iso_sweep_computation;

/* A wish of the plan with all that its quantity needs: settings, length, vectors, and its columns in a row. */
typedef struct iso_sweep_job {
    const struct iso_sweep_computation *quantity;
    double setting[ISO_SWEEP_SETTINGS];
    double turns, time; /* NaN: not said */
    const char *vectors;
    const iso_scene *base;
    int count; /* of its columns in a row, from `first` on */
    int first;
} iso_sweep_job;

/* The points of a chunk. */
typedef struct iso_sweep_batch {
    size_t count;
    iso_scene *scene;
    const bool *made; /* whether point i has a scene */
    iso_sweep_rows *rows;
} iso_sweep_batch;

typedef struct iso_sweep_computation {
    iso_sweep_quantity topic;
    /* The names of its columns, at most ISO_SWEEP_NUMBERS; gives their number. */
    int (*columns)(const iso_sweep_job *ask, const char *name[]);
    /* How many points make a chunk of about a second. */
    size_t (*chunk)(const iso_sweep_job *ask);
    /* Why the scenes of this sweep do not have it. NULL: all do. Errors: ISO_BAD_INPUT. */
    iso_status (*refuse)(iso_context *ctx, const iso_sweep_job *ask);
    /* Its numbers for one scene. Numbers that are not set are NaN. Errors: those of the point. */
    iso_status (*find)(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene, double number[]);
    /* Instead of find, where `together` says so: for all points of a chunk. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
    iso_status (*find_all)(iso_context *ctx, const iso_sweep_job *ask, iso_sweep_batch *batch);
    bool (*together)(const iso_sweep_job *ask);
} iso_sweep_computation;

#define ISO_SWEEP_LIST(X) X(state) X(chaos) X(frequencies) X(splitting) X(rotations) X(backends) X(error) X(contact)
#define ISO_SWEEP_DECLARE(name) extern const iso_sweep_computation iso_sweep_##name;
ISO_SWEEP_LIST(ISO_SWEEP_DECLARE)

/* Notes a failure of point i, whose words the context has. A second failure of the same point is not noted. */
void iso_sweep_note(iso_context *ctx, const iso_sweep_job *ask, iso_sweep_batch *batch, size_t i, iso_status status);

/* The numbers of this quantity in the row of point i. */
double *iso_sweep_numbers(const iso_sweep_job *ask, const iso_sweep_batch *batch, size_t i);

/* Fills name[] and gives the number of names. */
int iso_sweep_names(const char *name[], int count, const char *const names[]);

/* Adds bytes to a hash of 128 bits, which begins as {0, 0}. It is for telling sweeps apart, not for secrets. */
void iso_sweep_hash(uint64_t hash[2], const void *bytes, size_t length);

/* Measures the points of chunk c. rows has room for head->chunk points. Threads may call this at the same time, with
 * contexts and rows of their own. A point that fails is a row with its reason, and no error of the call.
 * Errors: ISO_STOPPED by the context's monitor, ISO_NO_MEMORY: then the rows are not valid. */
iso_status iso_sweep_compute(iso_context *ctx, const iso_sweep *sweep, size_t c, iso_sweep_rows *rows);

#endif
