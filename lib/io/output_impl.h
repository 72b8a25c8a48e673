/* output_impl.h - a text file being written: under its name only when it is whole.
 *
 *     iso_output *out;
 *     if ((status = iso_output_open(ctx, "table.csv", &out)) != ISO_OK) return status;
 *     fprintf(iso_output_stream(out), "a,b\n");
 *     status = iso_output_close(ctx, out, true);
 *
 * Until it is closed, a regular file is FILE.part (replacement_impl.h). "-" is standard output; that and what is no
 * regular file (/dev/stdout, a fifo) are written as the text comes.
 */
#ifndef ISO_IO_OUTPUT_IMPL_H
#define ISO_IO_OUTPUT_IMPL_H

#include <stdbool.h>
#include <stdio.h>

#include "base/context.h"

typedef struct iso_output iso_output;

/* Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY; *out is then NULL. */
iso_status iso_output_open(iso_context *ctx, const char *path, iso_output **out);

/* The same of a regular file that can be gone on with: FILE.part, locked, is as it was, and stays when this ends without
 * keeping it. It is to be cut before anything is written. */
iso_status iso_output_resume(iso_context *ctx, const char *path, iso_output **out);

/* Cuts it behind its first `length` bytes, where it goes on. Errors: ISO_FILE_TROUBLE. */
iso_status iso_output_cut(iso_context *ctx, iso_output *out, size_t length);

/* Where to write. */
FILE *iso_output_stream(iso_output *out);

/* A file that has the name when this one ends is not replaced: closing fails then. Nothing changes for what is
 * written directly. */
void iso_output_keep_others(iso_output *out);

/* Whether all that was written so far arrived. Errors: ISO_FILE_TROUBLE; ISO_CLOSED_PIPE when the
 * reader of a pipe has gone (the program must ignore SIGPIPE to see it). */
iso_status iso_output_check(iso_context *ctx, iso_output *out);

/* Writes all of a temporary file that is open for reading and writing. Errors: ISO_FILE_TROUBLE, also about it, and
 * those of iso_output_check. */
iso_status iso_output_copy(iso_context *ctx, iso_output *out, FILE *from);

/* What messages call it. */
const char *iso_output_name(const iso_output *out);

/* Ends the file and frees it (NULL is allowed). keep: flush to the disk and give the file its name; otherwise no
 * trace of it is left, except of what was written directly. Errors: ISO_FILE_TROUBLE; there is no file then, and one
 * that had the name before is as it was. */
iso_status iso_output_close(iso_context *ctx, iso_output *out, bool keep);

#endif
