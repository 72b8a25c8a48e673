/* scene_options.h - what commands that read a scene share: its failures, and times in a file. */
#ifndef ISOROLL_SCENE_OPTIONS_H
#define ISOROLL_SCENE_OPTIONS_H

#include "command.h"

/* As finish(), after a failure with the scene: says where in its file the cause stands, unless an option put it
 * there. */
int finish_scene(iso_context *ctx, const char *file, const iso_scene *scene, iso_status status);

/* The times that `run --times FILE` reads, in the order of the file. */
typedef struct output_times {
    double *list;
    size_t count;
} output_times;

/* Reads them; "-" is standard input. *t begins as {NULL, 0}; the caller frees t->list, after an error, too. Errors:
 * ISO_BAD_INPUT with the place, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status times_read(iso_context *ctx, const char *path, output_times *t);

#endif
