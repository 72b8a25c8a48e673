/* times.h - the times of `run`: a scene's grid, or a list from a file, in the file's order and in that of the work.
 *
 * An orbit is followed away from its start, and from the start again when a time lies behind: so times are worked on
 * first after the start and then before it, each the nearer ones first, whatever their order in the file.
 */
#ifndef ISOROLL_TIMES_H
#define ISOROLL_TIMES_H

#include "scene_options.h"

/* A time, and its row in the file. */
typedef struct output_time {
    double time;
    size_t row;
} output_time;

typedef struct times {
    const iso_scene *scene;
    double *list;       /* NULL: the scene's grid                         */
    output_time *order; /* of the work; NULL: it is that of the rows      */
    size_t count;
} times;

/* Reads the list from a file, "-" being standard input, and finds its order. The caller frees it.
 * Errors: ISO_BAD_INPUT with the place, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status times_read(iso_context *ctx, const char *path, times *t);
void times_free(times *t);

/* The i-th in the order of the work. */
output_time times_at(const times *t, size_t i);

/* The time farthest from the start. */
double times_farthest(const times *t);

#endif
