/* table.h - files of tables: named columns of numbers or words under lines "# key: value", of any kind.
 *
 *     # isoroll chaos 1                      the kind: trajectory, section, chaos, periodic, splitting, sweep, ...
 *     # k: -1                                the record's lines
 *     orbit,l,x,verdict                      its columns
 *     0,nan,nan,chaotic                      numbers, nan among them, and words
 *
 * One reader and one writer take all kinds, as CSV and as HDF5 (a name that ends in .h5 or .hdf5; a file that is read
 * is also known by its first bytes). What is written reads back exactly. lib/doc/formats.md says what stands in the
 * files; files of other programs are read as trajectories (io/trajectory.h).
 */
#ifndef ISO_IO_TABLE_H
#define ISO_IO_TABLE_H

#include <stdbool.h>
#include <stdio.h>

#include "../base/api.h"
#include "../base/record.h"

ISO_C_BEGIN

/* --- whole files ------------------------------------------------------------------------------------------------ */

/* Reads a whole file into a new record, to be freed by the caller; iso_record_kind tells what it is. kind: the only one
 * that is wanted; NULL: any. "-" is standard input. Messages about its text read "path:line:column: ...".
 * Errors: ISO_BAD_INPUT, ISO_FILE_TROUBLE, ISO_NO_MEMORY; ISO_BAD_ARGUMENT: this build has no HDF5. */
ISO_API iso_status iso_table_read(iso_context *ctx, const char *path, const char *kind, iso_record **record);

/* Writes a whole record of the kind that it has. Errors: those of the writer below. */
ISO_API iso_status iso_table_write(iso_context *ctx, const char *path, const iso_record *record);

/* --- row by row ------------------------------------------------------------------------------------------------- */

typedef struct iso_table_reader iso_table_reader;
typedef struct iso_table_writer iso_table_writer;

/* The same row by row, as trajectories are read (io/trajectory.h says more). Words are those of the header. */
iso_status iso_table_reader_open(iso_context *ctx, const char *path, const char *kind, iso_table_reader **reader);
iso_record *iso_table_header(iso_table_reader *reader);
iso_status iso_table_next(iso_context *ctx, iso_table_reader *reader, double row[], bool *more);
void iso_table_reader_close(iso_table_reader *reader);

/* The kind is kept by address. A header with columns of words must live until the last row is written.
 * Errors: ISO_BAD_ARGUMENT: a key or value that is no single line, a column whose name is not known as one of words;
 * ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_table_writer_open(iso_context *ctx, const char *path, const char *kind, iso_table_writer **writer);
iso_status iso_table_write_header(iso_context *ctx, iso_table_writer *writer, const iso_record *header);
iso_status iso_table_write_row(iso_context *ctx, iso_table_writer *writer, const double row[]);
iso_status iso_table_write_line(iso_context *ctx, iso_table_writer *writer, const char *key, const char *value);
iso_status iso_table_writer_close(iso_context *ctx, iso_table_writer *writer, bool keep);

/* Of a new writer: how many rows come (HDF5 then takes no more room than these); a file that has the name when this one
 * ends is not replaced. */
void iso_table_writer_expect(iso_table_writer *writer, size_t rows);
void iso_table_writer_keep_others(iso_table_writer *writer);

/* --- the beginning of a text ------------------------------------------------------------------------------------ */

/* Writes one line. A value of whole lines, each with its end, is written as a text: "# KEY | LINE" for each, without KEY if it is
 * "sweep". Errors: ISO_BAD_ARGUMENT: a key or value that does not read back. */
iso_status iso_table_line(iso_context *ctx, FILE *to, const char *key, const char *value);

/* Writes the beginning: the lines and the columns are those of `header`, whose rows are not looked at. Errors: those
 * of iso_table_line, before anything is written. Whether the text arrived, the stream tells. */
iso_status iso_table_begin(iso_context *ctx, FILE *to, const char *kind, const iso_record *header);

ISO_C_END

#endif
