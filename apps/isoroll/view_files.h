/* view_files.h - the files of view/ and three.js, which the build puts into the program (view/embed.cmake). */
#ifndef ISOROLL_VIEW_FILES_H
#define ISOROLL_VIEW_FILES_H

#include <stddef.h>

typedef struct view_file {
    const char *name; /* "page", "style", "three", "clocks", ...: without its ending */
    const unsigned char *bytes;
    size_t length; /* 0: the build had no such file */
} view_file;

/* All of them, ended by a row without a name. */
extern const view_file view_files[];

/* The file called `name`, or the row without a name, which is empty. */
const view_file *view_file_find(const char *name);

#endif
