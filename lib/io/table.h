/* table.h - files of tables: named columns of numbers or words under lines "# key: value", of any kind.
 *
 *     # isoroll chaos 1                      the kind: trajectory, section, chaos, periodic, splitting, sweep, ...
 *     # k: -1                                the record's lines
 *     # words: verdict                       which columns have words
 *     orbit,l,x,verdict                      its columns
 *     0,nan,nan,chaotic                      numbers, nan among them, and words
 *
 * One reader and one writer take all kinds, as CSV, which gnuplot, pandas (comment="#") and Julia read as it is, and
 * as HDF5: a name that ends in .h5 or .hdf5; a file that is read is also known by its first bytes. What is written
 * reads back exactly. lib/doc/formats.md says what stands in the files. In every path "-" is standard input or
 * output.
 *
 * If "trajectory" is wanted, files of other programs are read as well: without the lines of #, separated by commas,
 * semicolons or blanks, names quoted or in a line of #, other columns beside ours (iso_column_name), which are passed
 * over, CRLF and blank lines, exponents in D, C's hexadecimal numbers. Trajectories and sections have finite numbers.
 */
#ifndef ISO_IO_TABLE_H
#define ISO_IO_TABLE_H

#include <stdbool.h>

#include "../base/api.h"
#include "../base/record.h"

ISO_C_BEGIN

/* --- whole files ------------------------------------------------------------------------------------------------ */

/* Reads a whole file into a new record, to be freed by the caller; iso_record_kind returns what it is. kind: the only
 * one that is wanted; NULL: any of isoroll. columns: see below. passed: how many rows of nan were passed over; NULL:
 * they are refused. Messages about its text read "path:line:column: ...", column being that of the first character of
 * the field. Errors: ISO_BAD_INPUT, ISO_FILE_TROUBLE, ISO_NO_MEMORY; ISO_BAD_ARGUMENT: this build has no HDF5. */
ISO_API iso_status iso_table_read(iso_context *ctx, const char *path, const char *kind, const char *columns,
                                  iso_record **record, size_t *passed);

/* Writes a whole record of the kind that it has; one without a kind is a trajectory. Errors: those of the writer. */
ISO_API iso_status iso_table_write(iso_context *ctx, const char *path, const iso_record *record);

/* --- row by row: reading ------------------------------------------------------------------------------------------
 *
 *     iso_table_reader *r;
 *     if ((status = iso_table_reader_open(ctx, "orbit.csv", "trajectory", NULL, &r)) != ISO_OK) return status;
 *     double row[ISO_TRAJECTORY_COLUMNS];
 *     bool more;
 *     while ((status = iso_table_next(ctx, r, row, &more)) == ISO_OK && more) use(row);
 *     iso_table_reader_close(r);
 *
 * Memory does not grow with the file. */
typedef struct iso_table_reader iso_table_reader;

/* Where a reader is. */
typedef struct iso_table_place {
    size_t line;         /* of the file, where the row read last stands (HDF5: the row's number)                */
    size_t passed;       /* rows that were passed over so far                                                   */
    bool orbits;         /* the file has a column `orbit`, as files of several orbits have                      */
    double orbit;        /* its number in the row read last; 0: there is no such column                         */
    bool begins_orbit;   /* ... which is another one than that of the row before                                */
    const char *ignored; /* the columns of a file of others that are passed over, as text; NULL: none            */
} iso_table_place;

/* Opens a file and reads on to its first row. columns, of trajectories: names of the file's columns from left to
 * right, with commas between, "-" for one to be passed over; NULL: the file's own header line.
 * Errors: those of iso_table_read; *reader is then NULL. */
ISO_API iso_status iso_table_reader_open(iso_context *ctx, const char *path, const char *kind, const char *columns,
                                         iso_table_reader **reader);
ISO_API void iso_table_reader_close(iso_table_reader *reader);

/* Columns and key: value lines, without rows; lines that follow rows come with these. The caller may set lines. */
ISO_API iso_record *iso_table_header(iso_table_reader *reader);

/* The next row into row[], as many numbers as the header has columns, whose words are those of the header; *more
 * false: there is none. Errors: ISO_BAD_INPUT, a row that is none: the next call goes on behind it; ISO_FILE_TROUBLE,
 * ISO_NO_MEMORY; ISO_STOPPED when a signal comes while a pipe is waited for and the context's monitor says so. */
ISO_API iso_status iso_table_next(iso_context *ctx, iso_table_reader *reader, double row[], bool *more);
ISO_API const iso_table_place *iso_table_at(const iso_table_reader *reader);

/* --- row by row: writing ------------------------------------------------------------------------------------------
 *
 *     iso_table_writer *w;
 *     if ((status = iso_table_writer_open(ctx, "orbit.csv", "trajectory", &w)) != ISO_OK) return status;
 *     status = iso_table_write_header(ctx, w, header);
 *     while (status == ISO_OK && next(row)) status = iso_table_write_row(ctx, w, row);
 *     closed = iso_table_writer_close(ctx, w, status == ISO_OK);
 *
 * A regular file appears under its name only when it is whole: until then its rows are in a temporary file in the
 * same folder. What is no regular file (/dev/stdout, a fifo) is written as the rows come.
 * A write that fails is ISO_FILE_TROUBLE, or ISO_CLOSED_PIPE when the reader of a pipe has gone (the program must
 * ignore SIGPIPE to see it). */
typedef struct iso_table_writer iso_table_writer;

/* The kind is kept by address. Errors: ISO_BAD_ARGUMENT, ISO_FILE_TROUBLE, ISO_NO_MEMORY; *writer is then NULL. */
ISO_API iso_status iso_table_writer_open(iso_context *ctx, const char *path, const char *kind,
                                         iso_table_writer **writer);

/* How numbers of rows are written as text: with 1 to 17 significant digits (17 at the beginning), or ISO_HEXADECIMAL
 * as C's %a, both of which read back exactly. */
enum { ISO_HEXADECIMAL = 0 };
ISO_API void iso_table_set_digits(iso_table_writer *writer, int digits);

/* The first line, the key: value lines and the column names of `header`, whose rows are not looked at. A header with
 * columns of words must live until the last row is written. Errors: ISO_BAD_ARGUMENT (a key, a value or a column that
 * does not read back, words in a trajectory or a section), ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
ISO_API iso_status iso_table_write_header(iso_context *ctx, iso_table_writer *writer, const iso_record *header);

/* One row of as many numbers as the header has columns; NULL, in a trajectory: in the place of a row that could not
 * be made, nan in every column. Errors: ISO_NUMERICAL (in a trajectory or section a number is not finite: nothing is
 * written), ISO_BAD_ARGUMENT, ISO_FILE_TROUBLE. */
ISO_API iso_status iso_table_write_row(iso_context *ctx, iso_table_writer *writer, const double row[]);

/* A line that is known only after the rows. */
ISO_API iso_status iso_table_write_line(iso_context *ctx, iso_table_writer *writer, const char *key,
                                        const char *value);

/* Ends the file and frees the writer (NULL is allowed). keep: flush to the disk and give the file its name;
 * otherwise no trace of it is left, except of what was written directly. Errors: ISO_FILE_TROUBLE; there is no file
 * then, and one that had the name before is as it was. */
ISO_API iso_status iso_table_writer_close(iso_context *ctx, iso_table_writer *writer, bool keep);

ISO_C_END

#endif
