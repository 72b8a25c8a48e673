/* sweep_store.h - where the rows of a sweep go: a journal while it runs, and its result when all is there.
 *
 *     iso_sweep_journal *j;
 *     status = iso_sweep_journal_open(ctx, "out.h5", head, whole, true, &j);     whole: iso_sweep_whole_of(head)
 *     for each chunk c with !iso_sweep_journal_has(j, c):
 *         status = iso_sweep_journal_add(ctx, j, c, &rows);
 *     status = iso_sweep_journal_finish(ctx, j);                               writes out.h5, removes out.h5.part
 *     iso_sweep_journal_close(j);
 *
 * The journal is out.h5.part. It begins with what the sweep is. Each finished chunk is one record with a checksum,
 * added at the end by one write. So a program that is killed loses only chunks that were being computed; a record
 * that was cut short is taken away by the next program. A journal is for one program at a time.
 *
 * The result is written from the journal, chunk by chunk by growing number, into a temporary file that is renamed. So
 * its bytes depend on nothing but the sweep. It is HDF5 if its name ends in .h5, else CSV (lib/doc/formats.md).
 *
 * Shard i of n (option --shard) is chunk i, i + n, i + 2n, ... of a sweep. Its result is a part; iso_sweep_merge
 * puts parts together, to the bytes that one program gives.
 */
#ifndef ISO_IO_SWEEP_STORE_H
#define ISO_IO_SWEEP_STORE_H

#include "../base/api.h"
#include "family.h"

ISO_C_BEGIN

/* Chunks index, index + count, ...; {0, 1}: all. count is at most ISO_SWEEP_MOST_SHARES. */
enum { ISO_SWEEP_MOST_SHARES = 1000000 };
typedef struct iso_sweep_shard {
    size_t index, count;
} iso_sweep_shard;

/* Points that have failed: how many, and the number and the reason of the first. */
typedef struct iso_sweep_failures {
    size_t count, first;
    char reason[ISO_REASON_SIZE];
} iso_sweep_failures;

/* --- the journal ------------------------------------------------------------------------------------------------ */

typedef struct iso_sweep_journal iso_sweep_journal;

/* Begins the journal of the result `path`, or goes on with one (resume). With resume it is no error if there is none.
 * If `path` is no regular file, or is "-" (standard output, as CSV), the journal has no name, and cannot be resumed.
 * The head must live as long as the journal.
 * Errors: ISO_FILE_TROUBLE: a journal of another sweep, a damaged one, one that another program works on, one that is
 * there without resume; a file `path` that is there, unless it is the result of this sweep and resume is given: then
 * all chunks are done, and finishing writes nothing. Nothing is changed then. ISO_BAD_ARGUMENT: this build has no
 * HDF5; too many shares. ISO_NO_MEMORY. */
ISO_API iso_status iso_sweep_journal_open(iso_context *ctx, const char *path, const iso_sweep_head *head,
                                          iso_sweep_shard share, bool resume, iso_sweep_journal **journal);

/* Whether chunk c is there or belongs to another share. */
ISO_API bool iso_sweep_journal_has(const iso_sweep_journal *j, size_t c);

/* Chunks of the share, and how many of them are there. */
ISO_API size_t iso_sweep_journal_wanted(const iso_sweep_journal *j);
ISO_API size_t iso_sweep_journal_done(const iso_sweep_journal *j);

/* Points of the share; and the failed points of its finished chunks. */
ISO_API size_t iso_sweep_journal_points(const iso_sweep_journal *j);
ISO_API const iso_sweep_failures *iso_sweep_journal_failures(const iso_sweep_journal *j);

/* Adds a chunk. Errors: ISO_FILE_TROUBLE: the journal is then as it was before. */
ISO_API iso_status iso_sweep_journal_add(iso_context *ctx, iso_sweep_journal *j, size_t c,
                                         const iso_sweep_rows *rows);

/* Writes the result; all chunks of the share must be there. Errors: ISO_FILE_TROUBLE, also if a file of this name
 * has appeared: then that file and the journal both stay; ISO_NO_MEMORY. */
ISO_API iso_status iso_sweep_journal_finish(iso_context *ctx, iso_sweep_journal *j);

/* The journal's file stays, unless nothing is in it. */
ISO_API void iso_sweep_journal_close(iso_sweep_journal *j);

/* Whether the journal stays on the disk, so that another program can go on with it. */
ISO_API bool iso_sweep_journal_lasts(const iso_sweep_journal *j);

/* Rows as bytes, as a record of the journal has them, for programs that compute chunks elsewhere and send them to the
 * one that has the journal. Numbers stand as they are in memory. iso_sweep_rows_bytes: the most bytes that `count`
 * points need. pack gives the number of bytes. Before unpack set rows->first and rows->count; false: the bytes are
 * not those of so many rows. */
ISO_API size_t iso_sweep_rows_bytes(const iso_sweep_rows *rows, size_t count);
ISO_API size_t iso_sweep_rows_pack(const iso_sweep_rows *rows, unsigned char bytes[]);
ISO_API bool iso_sweep_rows_unpack(const unsigned char bytes[], size_t length, iso_sweep_rows *rows);

/* --- results ---------------------------------------------------------------------------------------------------- */

typedef struct iso_sweep_reader iso_sweep_reader;

/* Opens a result or a part. Errors: ISO_FILE_TROUBLE: no such file, or none of a sweep. */
ISO_API iso_status iso_sweep_reader_open(iso_context *ctx, const char *path, iso_sweep_reader **reader);
ISO_API void iso_sweep_reader_close(iso_sweep_reader *reader);
ISO_API const iso_sweep_head *iso_sweep_reader_head(const iso_sweep_reader *reader);
ISO_API iso_sweep_shard iso_sweep_reader_share(const iso_sweep_reader *reader);

/* Reads the next `count` rows of one chunk, at most rows->most. Errors: ISO_FILE_TROUBLE: a row is missing or
 * damaged; with the last rows: the sum of all is not that in the file. */
ISO_API iso_status iso_sweep_reader_rows(iso_context *ctx, iso_sweep_reader *reader, size_t count,
                                         iso_sweep_rows *rows);

/* Puts the parts of one sweep together. *failures: those of all parts. Errors: ISO_FILE_TROUBLE: a part is missing,
 * is there twice, was changed or damaged, or belongs to another sweep; `path` is there. */
ISO_API iso_status iso_sweep_merge(iso_context *ctx, size_t count, const char *const parts[], const char *path,
                                   iso_sweep_failures *failures);

ISO_C_END

#endif
