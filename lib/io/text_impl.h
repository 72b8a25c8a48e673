/* text_impl.h - what readers of scenes and of trajectories share: whole files and safe quotations. */
#ifndef ISO_IO_TEXT_IMPL_H
#define ISO_IO_TEXT_IMPL_H

#include <stddef.h>
#include <stdio.h>

#include "base/context.h"

enum { ISO_QUOTE_SIZE = 64, ISO_LARGEST_TEXT = 16 << 20 /* of scenes and sweeps */ };

/* How messages call the file `path`: "<stdin>" for "-". */
const char *iso_text_name(const char *path);

/* Records "no memory to WHAT 'name'" and returns ISO_NO_MEMORY. */
iso_status iso_text_no_memory(iso_context *ctx, const char *what, const char *name);

/* Opens `path` for reading, "-" being standard input. NULL: ISO_FILE_TROUBLE is recorded in ctx. */
FILE *iso_text_open(iso_context *ctx, const char *path);
void iso_text_close(FILE *file);

/* Reads all of `path` into *text (to be freed by the caller, a '\0' behind it).
 * Errors: ISO_FILE_TROUBLE; ISO_BAD_INPUT for more than ISO_LARGEST_TEXT bytes; ISO_NO_MEMORY. */
iso_status iso_text_load(iso_context *ctx, const char *path, char **text, size_t *length);

/* Text of the user's as it can be shown in a message: one line, short, nothing that moves a terminal's cursor. */
const char *iso_text_quote(char quoted[ISO_QUOTE_SIZE], const char *text, size_t length);

#endif
