/* trajectory.h - trajectory files: CSV that gnuplot, pandas (comment="#") and Julia read as it is, and HDF5.
 *
 *     # isoroll trajectory 1
 *     # model: ball                                key: value lines, the record's
 *     # k: -1
 *     t,omega1,omega2,omega3,n1,n2,n3              some of the columns (iso_column_name), each once
 *     0,0.9,-0.3,-0.225,0.36,0.48,0.8              finite numbers, written in %.17g: they read back exactly
 *
 * Files of others are read as well: without the lines of #, separated by commas, semicolons or blanks, names quoted
 * or in a line of #, other columns beside ours (which are passed over), CRLF and blank lines, exponents in D, C's
 * hexadecimal numbers. In every path "-" is standard input or output. A path that ends in .h5 is HDF5 (io/hdf5/hdf5.c
 * says how it is laid out), where the build has it; else ISO_BAD_ARGUMENT.
 */
#ifndef ISO_IO_TRAJECTORY_H
#define ISO_IO_TRAJECTORY_H

#include <stdbool.h>

#include "../base/api.h"
#include "../base/record.h"

ISO_C_BEGIN

/* --- whole files ------------------------------------------------------------------------------------------------ */

/* Reads a whole file into a new record, to be freed by the caller; `columns` as below. Messages about its text read
 * "path:line:column: ...", column being that of the first character of the field.
 * Errors: ISO_BAD_INPUT, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
ISO_API iso_status iso_trajectory_read(iso_context *ctx, const char *path, const char *columns, iso_record **record);

/* The same, but rows that are nan in every column, as `convert` writes them for rows that cannot be converted, are
 * passed over; *passed is how many. */
ISO_API iso_status iso_trajectory_read_good(iso_context *ctx, const char *path, const char *columns,
                                            iso_record **record, size_t *passed);

/* Writes a whole record. Errors: those of the writer below. */
ISO_API iso_status iso_trajectory_write(iso_context *ctx, const char *path, const iso_record *record);

/* --- row by row: reading ------------------------------------------------------------------------------------------
 *
 *     iso_trajectory_reader *r;
 *     if ((status = iso_trajectory_reader_open(ctx, "orbit.csv", NULL, &r)) != ISO_OK) return status;
 *     double row[ISO_TRAJECTORY_COLUMNS];
 *     bool more;
 *     while ((status = iso_trajectory_next(ctx, r, row, &more)) == ISO_OK && more) use(row);
 *     iso_trajectory_reader_close(r);
 *
 * Memory does not grow with the file. */
typedef struct iso_table_reader iso_trajectory_reader;

/* Opens a file and reads on to its first row. columns: names of the file's columns from left to right, with commas
 * between, "-" for one to be passed over; NULL: the file's own header line.
 * Errors: ISO_BAD_INPUT, ISO_FILE_TROUBLE, ISO_NO_MEMORY, ISO_BAD_ARGUMENT; *reader is then NULL. */
ISO_API iso_status iso_trajectory_reader_open(iso_context *ctx, const char *path, const char *columns,
                                              iso_trajectory_reader **reader);
ISO_API void iso_trajectory_reader_close(iso_trajectory_reader *reader);

/* Columns and key: value lines, without rows; lines that follow rows come with these. The caller may set lines. */
ISO_API iso_record *iso_trajectory_header(iso_trajectory_reader *reader);

/* The next row into row[], as many numbers as the header has columns; *more false: there is none.
 * Errors: ISO_BAD_INPUT, a row that is none: the next call goes on behind it; ISO_FILE_TROUBLE, ISO_NO_MEMORY;
 * ISO_STOPPED when a signal comes while a pipe is waited for and the context's monitor says so. */
ISO_API iso_status iso_trajectory_next(iso_context *ctx, iso_trajectory_reader *reader, double row[], bool *more);

/* Whether the row read last is of another orbit than the row before it: it has another number in the column `orbit`,
 * as files of several orbits have it. */
ISO_API bool iso_trajectory_begins_orbit(const iso_trajectory_reader *reader);

/* From now on rows that are nan in every column are passed over; otherwise they are ISO_BAD_INPUT, as are rows that
 * are nan in some columns. */
ISO_API void iso_trajectory_pass_nan(iso_trajectory_reader *reader);

/* How many rows were passed over so far. */
ISO_API size_t iso_trajectory_passed(const iso_trajectory_reader *reader);

/* The line of the file at which the row read last stands (HDF5: the row's number). */
ISO_API size_t iso_trajectory_line(const iso_trajectory_reader *reader);

/* What columns of a file of others are passed over, in words, or NULL. */
ISO_API const char *iso_trajectory_ignored(const iso_trajectory_reader *reader);

/* --- row by row: writing ------------------------------------------------------------------------------------------
 *
 *     iso_trajectory_writer *w;
 *     if ((status = iso_trajectory_open(ctx, "orbit.csv", &w)) != ISO_OK) return status;
 *     status = iso_trajectory_write_header(ctx, w, header);
 *     while (status == ISO_OK && next(row)) status = iso_trajectory_write_row(ctx, w, row, count);
 *     closed = iso_trajectory_close(ctx, w, status == ISO_OK);
 *
 * A regular file appears under its name only when it is whole: until then its rows are in a temporary file in the
 * same folder. What is no regular file (/dev/stdout, a fifo) is written as the rows come.
 * A write that fails is ISO_FILE_TROUBLE, or ISO_CLOSED_PIPE when the reader of a pipe has gone (the program must
 * ignore SIGPIPE to see it). */
typedef struct iso_table_writer iso_trajectory_writer;

/* Errors: ISO_BAD_ARGUMENT, ISO_FILE_TROUBLE, ISO_NO_MEMORY; *writer is then NULL. */
ISO_API iso_status iso_trajectory_open(iso_context *ctx, const char *path, iso_trajectory_writer **writer);

/* How numbers of rows are written as text: with 1 to 17 significant digits (17 at the beginning), or ISO_HEXADECIMAL
 * as C's %a, both of which read back exactly. */
enum { ISO_HEXADECIMAL = 0 };
ISO_API void iso_trajectory_set_digits(iso_trajectory_writer *writer, int digits);

/* Sets the kind of file that the first line names: "trajectory" unless this is called, "section" for rows of
 * crossings. Call it before the header is written. */
ISO_API void iso_trajectory_set_kind(iso_trajectory_writer *writer, const char *kind);

/* The magic line, the key: value lines and the column names of `header`, whose rows are not looked at.
 * Errors: ISO_BAD_ARGUMENT (a key or value that is no single line), ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
ISO_API iso_status iso_trajectory_write_header(iso_context *ctx, iso_trajectory_writer *writer,
                                               const iso_record *header);

/* One row of as many numbers as the header has columns.
 * Errors: ISO_NUMERICAL (a number is not finite: nothing is written), ISO_BAD_ARGUMENT, ISO_FILE_TROUBLE. */
ISO_API iso_status iso_trajectory_write_row(iso_context *ctx, iso_trajectory_writer *writer, const double *row,
                                            size_t count);

/* In the place of a row that could not be made: nan in every column. */
ISO_API iso_status iso_trajectory_write_mark(iso_context *ctx, iso_trajectory_writer *writer);

/* A line that is known only after the rows. */
ISO_API iso_status iso_trajectory_write_line(iso_context *ctx, iso_trajectory_writer *writer, const char *key,
                                             const char *value);

/* Ends the file and frees the writer (NULL is allowed). keep: flush to the disk and give the file its name;
 * otherwise no trace of it is left, except of what was written directly. Errors: ISO_FILE_TROUBLE; there is no file
 * then, and one that had the name before is as it was. */
ISO_API iso_status iso_trajectory_close(iso_context *ctx, iso_trajectory_writer *writer, bool keep);

ISO_C_END

#endif
