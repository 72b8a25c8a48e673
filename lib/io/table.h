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

/* What kind of table of isoroll a file is, "" if none that can be read. "-" is never looked at. */
enum { ISO_KIND_SIZE = 32 };
ISO_API void iso_table_kind(const char *path, char kind[ISO_KIND_SIZE]);

/* --- the beginning of a text ------------------------------------------------------------------------------------ */

/* Writes the beginning: the lines and the columns are those of `header`, whose rows are not looked at. Errors:
 * ISO_BAD_ARGUMENT, before anything is written: a key or value that does not read back. Whether the text arrived, the
 * stream tells. */
ISO_API iso_status iso_table_begin(iso_context *ctx, FILE *to, const char *kind, const iso_record *header);

ISO_C_END

#endif
