/* output_impl.h - a file being written: under its name only when it is whole, so that nobody sees half of it.
 *
 *     iso_output *out;
 *     if ((status = iso_output_open(ctx, "table.csv", &out)) != ISO_OK) return status;
 *     fprintf(iso_output_stream(out), "a,b\n");
 *     status = iso_output_close(ctx, out, true);
 *
 * Until it is closed, a regular FILE is FILE.part, which is locked. A part that nobody has locked was left by a killed
 * program, and is written anew. Behind a link it is the file that is replaced or made, not the link; a file keeps its
 * permissions, and one that may not be written is not replaced. "-" is standard output; that and what is no regular
 * file (/dev/stdout, a fifo) are written as the text comes.
 */
#ifndef ISO_IO_OUTPUT_IMPL_H
#define ISO_IO_OUTPUT_IMPL_H

#include <stdbool.h>
#include <stdio.h>

#include "base/context.h"

typedef struct iso_output iso_output;

/* Errors: ISO_FILE_TROUBLE, also if another program writes the file; ISO_NO_MEMORY; *out is then NULL. */
iso_status iso_output_open(iso_context *ctx, const char *path, iso_output **out);

/* The same of a regular file alone, or of "-". resumes: FILE.part is as it was, is to be cut before anything is
 * written, and stays when this ends without keeping it. */
iso_status iso_output_open_regular(iso_context *ctx, const char *path, bool resumes, iso_output **out);

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

/* What messages call it, and what it is called until it is whole (NULL: it is written directly). */
const char *iso_output_name(const iso_output *out);
const char *iso_output_part(const iso_output *out);

/* Ends the file and frees it (NULL is allowed). keep: flush to the disk and give the file its name; otherwise no
 * trace of it is left, except of what was written directly or can be resumed. Errors: ISO_FILE_TROUBLE; there is no
 * file then, and one that had the name before is as it was. */
iso_status iso_output_close(iso_context *ctx, iso_output *out, bool keep);

/* For a program that a signal ends: takes away all that is being written. May be called in a signal's handler. */
void iso_output_unlink_all(void);

/* --- files by their names --- */

/* ISO_FILE_TROUBLE in errno's words: "cannot WHAT 'path': ..."; ISO_CLOSED_PIPE when errno is EPIPE. */
iso_status iso_file_trouble(iso_context *ctx, const char *what, const char *path);

/* The name behind all links of a path, whether a file has it or not, to be freed by the caller; a name of an open
 * stream is not followed. NULL with errno set: ELOOP, links go round. */
char *iso_file_follow(const char *path);

/* FILE.part of a path, to be freed by the caller; NULL: errno says why. */
char *iso_file_part(const char *path);

#endif
