/* trajectory.h - trajectory files: CSV that gnuplot, pandas (comment="#") and Julia read as it is.
 *
 *     # isoroll trajectory 1
 *     # model: ball                                key: value lines, the record's
 *     # k: -1
 *     t,omega1,omega2,omega3,n1,n2,n3              some of iso_trajectory_columns, each once
 *     0,0.9,-0.3,-0.225,0.36,0.48,0.8              finite numbers, written in %.17g: they read back exactly
 *
 * The lines with # may be missing, blank lines and CRLF line ends are let pass. In every path "-" is standard input or
 * output. HDF5 (.h5) is not built yet: such a path is refused with ISO_BAD_ARGUMENT.
 */
#ifndef ISO_IO_TRAJECTORY_H
#define ISO_IO_TRAJECTORY_H

#include <stdbool.h>

#include "../base/record.h"

/* Reads a whole file into a new record, to be freed by the caller. Messages about its text read
 * "path:line:column: ...", column being that of the first character of the field.
 * Errors: ISO_BAD_INPUT, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_trajectory_read(iso_context *ctx, const char *path, iso_record **record);

/* Writes a whole record. Errors: those of the writer below. */
iso_status iso_trajectory_write(iso_context *ctx, const char *path, const iso_record *record);

/* A file being written row by row:
 *
 *     iso_trajectory_writer *w;
 *     if ((status = iso_trajectory_open(ctx, "orbit.csv", &w)) != ISO_OK) return status;
 *     status = iso_trajectory_write_header(ctx, w, header);
 *     while (status == ISO_OK && next(row)) status = iso_trajectory_write_row(ctx, w, row, count);
 *     closed = iso_trajectory_close(ctx, w, status == ISO_OK);
 *
 * A regular file appears under its name only when it is whole: until then its rows are in a temporary file in the
 * same folder. What is no regular file (/dev/stdout, a fifo) is written as the rows come.
 * Failing writes are ISO_FILE_TROUBLE, with iso_context_field() "pipe" when the reader of a pipe has gone (the program
 * must ignore SIGPIPE to see it). */
typedef struct iso_trajectory_writer iso_trajectory_writer;

/* Errors: ISO_BAD_ARGUMENT, ISO_FILE_TROUBLE, ISO_NO_MEMORY; *writer is then NULL. */
iso_status iso_trajectory_open(iso_context *ctx, const char *path, iso_trajectory_writer **writer);

/* The magic line, the key: value lines and the column names of `header`, whose rows are not looked at.
 * Errors: ISO_BAD_ARGUMENT (a key or value that is no single line), ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_trajectory_write_header(iso_context *ctx, iso_trajectory_writer *writer, const iso_record *header);

/* One row of as many numbers as the header has columns.
 * Errors: ISO_NUMERICAL (a number is not finite: nothing is written), ISO_BAD_ARGUMENT, ISO_FILE_TROUBLE. */
iso_status iso_trajectory_write_row(iso_context *ctx, iso_trajectory_writer *writer, const double *row, size_t count);

/* Ends the file and frees the writer (NULL is allowed). keep: flush to the disk and give the file its name;
 * otherwise no trace of it is left, except of what was written directly. Errors: ISO_FILE_TROUBLE; there is no file
 * then, and one that had the name before is as it was. */
iso_status iso_trajectory_close(iso_context *ctx, iso_trajectory_writer *writer, bool keep);

#endif
