/* replacement_impl.h - a file that is written as FILE.part and renamed to FILE when it is whole: nobody sees half of it.
 *
 * FILE.part is locked while it is written. One that nobody has locked was left by a killed program, and is written
 * anew. Behind a link it is the file that is replaced or made, not the link; a file keeps its permissions, and one
 * that may not be written is not replaced.
 */
#ifndef ISO_IO_REPLACEMENT_IMPL_H
#define ISO_IO_REPLACEMENT_IMPL_H

#include <stdbool.h>

#include "base/context.h"

typedef struct iso_replacement {
    char *target;    /* the name it is to have, links followed */
    char *temporary; /* target.part                            */
    bool fresh;      /* set it between open and close: a file that has the name by then is not replaced */
    bool stays;      /* target.part outlives failures and signals: it can be gone on with */
} iso_replacement;

/* ISO_FILE_TROUBLE in errno's words: "cannot WHAT 'path': ..."; ISO_CLOSED_PIPE when errno is EPIPE. */
iso_status iso_file_trouble(iso_context *ctx, const char *what, const char *path);

/* The name behind all links of a path, whether a file has it or not, to be freed by the caller; a name of an open stream
 * is not followed. NULL with errno set: ELOOP, links go round. */
char *iso_file_follow(const char *path);

/* Whether it is another name of a stream that is already open: /dev/stdout, /dev/fd/3. */
bool iso_file_is_stream(const char *path);

/* What would be written beside `path`, to be freed by the caller; NULL: errno says why. */
char *iso_replacement_name(const char *path);

/* A new file, open for reading and writing, which is to become `path`. stays: it is kept as it is, if it is there, and
 * stays unless it gets its name. Errors: ISO_FILE_TROUBLE, also if `path` leads
 * to what is no regular file, and if another program writes it; nothing is left to be released then. */
iso_status iso_replacement_open(iso_context *ctx, const char *path, bool stays, iso_replacement *r, int *descriptor);

/* Brings the file to the disk (keep) or takes it away, if it does not stay, closes nothing, releases r. Errors: ISO_FILE_TROUBLE, also if
 * a fresh file's name is taken; an older file of that name is then as it was. */
iso_status iso_replacement_close(iso_context *ctx, iso_replacement *r, int descriptor, bool keep);

/* For a program that a signal ends: takes away all that is being written. May be called in a signal's handler. */
void iso_replacement_unlink_all(void);

#endif
