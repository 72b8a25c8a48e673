/* times.h - the times that `run --times FILE` reads. */
#ifndef ISOROLL_TIMES_H
#define ISOROLL_TIMES_H

#include "scene_options.h"

typedef struct times {
    double *list; /* in the order of the file */
    size_t count;
} times;

/* Reads the times of a file, "-" being standard input. *t begins as {NULL, 0}; the caller frees t->list, after an
 * error, too. Errors: ISO_BAD_INPUT with the place, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status times_read(iso_context *ctx, const char *path, times *t);

#endif
