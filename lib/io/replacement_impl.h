/* replacement_impl.h - a file that gets its name when it is whole: nobody sees half of it, and a program that is
 * killed leaves nothing behind. What must have a name before is ".isoroll-*.tmp" in the same folder; if its program
 * is killed, the next one that writes the same file removes it.
 *
 * Behind a link it is the file that is replaced, not the link; a file keeps its permissions, and one that may not be
 * written is not replaced.
 */
#ifndef ISO_IO_REPLACEMENT_IMPL_H
#define ISO_IO_REPLACEMENT_IMPL_H

#include <stdbool.h>

#include "base/context.h"

typedef struct iso_replacement {
    char *target;    /* the name it is to have, links followed */
    char *temporary; /* a path to it till then                 */
    bool named;      /* that is a name in the same folder; else it leads to the descriptor */
    bool fresh;      /* set it between open and close: a file that has the name by then is not replaced */
} iso_replacement;

/* ISO_FILE_TROUBLE in errno's words: "cannot WHAT 'path': ..."; ISO_CLOSED_PIPE when errno is EPIPE. */
iso_status iso_file_trouble(iso_context *ctx, const char *what, const char *path);

/* Whether this name still leads to the open file. */
bool iso_file_has_name(int descriptor, const char *name);

/* A new file, open for reading and writing, which is to become `path`. named: others open r->temporary, so it must be
 * a true name. Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY; nothing is left to be released then. */
iso_status iso_replacement_open(iso_context *ctx, const char *path, bool named, iso_replacement *r, int *descriptor);

/* Brings the file to the disk (keep) or takes it away, closes nothing, releases r. With keep the descriptor is
 * synced, the file named and its folder synced. Errors: ISO_FILE_TROUBLE, also if a fresh file's name is taken; an
 * older file of that name is then as it was. */
iso_status iso_replacement_close(iso_context *ctx, iso_replacement *r, int descriptor, bool keep);

#endif
