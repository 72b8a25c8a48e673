/* embedded.h - files that the build puts into the program (embed.cmake): those of view/ with three.js, and the
 * templates of pictures/. */
#ifndef ISOROLL_EMBEDDED_H
#define ISOROLL_EMBEDDED_H

#include <stddef.h>
#include <string.h>

typedef struct embedded_file {
    const char *name; /* "page", "style", "three", "clocks", ...: without its ending; NULL after the last */
    const unsigned char *bytes;
    size_t length; /* 0: the build had no such file */
} embedded_file;

extern const embedded_file view_files[], picture_files[];

/* The file called `name`, or the row without a name, which is empty. */
static inline const embedded_file *embedded_find(const embedded_file *files, const char *name)
{
    while (files->name && strcmp(files->name, name) != 0) files++;
    return files;
}

#endif
