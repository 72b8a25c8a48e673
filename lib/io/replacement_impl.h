/* replacement_impl.h - a file written whole beside the one it replaces, then renamed: nobody sees half of it.
 *
 * Behind a link it is the file that is replaced, not the link; a file keeps its permissions, and one that may not be
 * written is not replaced.
 */
#ifndef ISO_IO_REPLACEMENT_IMPL_H
#define ISO_IO_REPLACEMENT_IMPL_H

#include <stdbool.h>

#include "base/context.h"

typedef struct iso_replacement {
    char *target;    /* the name it is to have, links followed     */
    char *temporary; /* the name it has till then, in that folder  */
    bool fresh;      /* set it between open and close: a file that has the name by then is not replaced */
} iso_replacement;

/* ISO_FILE_TROUBLE in errno's words: "cannot WHAT 'path': ..."; ISO_CLOSED_PIPE when errno is EPIPE. */
iso_status iso_file_trouble(iso_context *ctx, const char *what, const char *path);

/* A new file, open for reading and writing, to be renamed to `path`. Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY; nothing
 * is left to be released then. */
iso_status iso_replacement_open(iso_context *ctx, const char *path, iso_replacement *r, int *descriptor);

/* Brings the file to the disk (keep) or takes it away, closes nothing, releases r. With keep the descriptor is
 * synced, the file renamed and its folder synced. Errors: ISO_FILE_TROUBLE, also if a fresh file's name is taken; an
 * older file of that name is then as it was. */
iso_status iso_replacement_close(iso_context *ctx, iso_replacement *r, int descriptor, bool keep);

#endif
