/* sweep_store_impl.h - where the rows of a sweep go: a journal while it runs, and its result when all is there.
 *
 *     iso_sweep_journal *j;
 *     status = iso_sweep_journal_open(ctx, "out.h5", head, whole, true, &j);     whole: (iso_sweep_shard){0, 1}
 *     for each chunk c with !iso_sweep_journal_has(j, c):
 *         status = iso_sweep_journal_add(ctx, j, c, &rows);
 *     status = iso_sweep_journal_finish(ctx, j);                               writes out.h5, removes out.h5.journal
 *     iso_sweep_journal_close(j);
 *
 * The journal is out.h5.journal. It begins with what the sweep is. Each finished chunk is one record with a checksum,
 * added at the end by one write. So a program that is killed loses only chunks that were being computed; a record
 * that was cut short is taken away by the next program. A journal is for one program at a time.
 *
 * The result is written from the journal, chunk by chunk by growing number, into a temporary file that is renamed. So
 * its bytes depend on nothing but the sweep. It is HDF5 if its name ends in .h5, else CSV (lib/doc/formats.md).
 *
 * Shard i of n (option --shard) is chunk i, i + n, i + 2n, ... of a sweep. Its result is a part; iso_sweep_merge
 * puts parts together, to the bytes that one program gives.
 */
#ifndef ISO_SWEEP_STORE_IMPL_H
#define ISO_SWEEP_STORE_IMPL_H

#include <sys/types.h>
#include <time.h>

#include "io/table_impl.h"
#include "sweep/sweep_impl.h"

#define ISO_SWEEP_KIND "sweep"
#define ISO_SWEEP_PART_KIND "sweep part"

/* --- shards, failures, sums (sweep_record.c) -------------------------------------------------------------------- */

/* Chunks index, index + count, ...; {0, 1}: all. count is at most ISO_SWEEP_MOST_SHARDS. */
enum { ISO_SWEEP_MOST_SHARDS = 1000000 };
typedef struct iso_sweep_shard {
    size_t index, count;
} iso_sweep_shard;

/* Its points, and the number in the sweep of its i-th point. */
size_t iso_sweep_shard_points(const iso_sweep_head *head, iso_sweep_shard shard);
size_t iso_sweep_shard_point(const iso_sweep_head *head, iso_sweep_shard shard, size_t i);

/* Points that have failed: how many, and the number and the reason of the first. */
typedef struct iso_sweep_failures {
    size_t count, first;
    char reason[ISO_REASON_SIZE];
} iso_sweep_failures;
void iso_sweep_failures_add(iso_sweep_failures *failures, const iso_sweep_rows *rows);

/* Of bytes; another salt gives another number. */
uint64_t iso_sweep_checksum(const void *bytes, size_t length, uint64_t salt);

/* The sum of rows before and these. It begins as 0. All kinds of nan count as one. */
uint64_t iso_sweep_sum(uint64_t before, const iso_sweep_rows *rows);

/* The name of a column in a table: k, chaos_verdict. */
enum { ISO_SWEEP_NAME = 3 * ISO_NAME_SIZE + 1 };
const char *iso_sweep_column_name(const iso_sweep_column *column, char name[ISO_SWEEP_NAME]);

/* --- rows as bytes (sweep_record.c) ----------------------------------------------------------------------------- */

/* As a record of the journal has them, for programs that compute chunks elsewhere and send them to the one that has
 * the journal. Numbers stand as they are in memory. iso_sweep_rows_bytes: the most bytes that `count` points need.
 * pack gives the number of bytes. Before unpack set rows->first and rows->count; false: the bytes are not those of so
 * many rows. */
size_t iso_sweep_rows_bytes(const iso_sweep_rows *rows, size_t count);
size_t iso_sweep_rows_pack(const iso_sweep_rows *rows, unsigned char bytes[]);
bool iso_sweep_rows_unpack(const unsigned char bytes[], size_t length, iso_sweep_rows *rows);

/* What stands before the bytes of a chunk in a journal; `bytes` are those behind it. */
typedef struct iso_sweep_record {
    uint64_t chunk, length, checksum;
} iso_sweep_record;
uint64_t iso_sweep_record_sum(const iso_sweep_record *r, const unsigned char bytes[]);

/* Whether a whole record begins somewhere in these bytes. */
bool iso_sweep_record_inside(const iso_sweep_head *head, const unsigned char bytes[], size_t length);

/* --- the journal ------------------------------------------------------------------------------------------------ */

typedef struct iso_sweep_journal {
    char *path, *name; /* of the result, of the journal; name NULL: nobody can go on with it */
    const iso_sweep_head *head;
    iso_sweep_shard shard;
    size_t wanted, done; /* chunks of the shard, and how many of them are there */
    iso_sweep_failures failures;
    bool complete; /* the result is there already */
    bool ours;     /* the journal's file was not refused */
    int descriptor;
    off_t end;
    off_t *at;             /* of the record of each chunk; 0: it is not there */
    unsigned char *buffer; /* for the largest record */
    size_t room;
    time_t synced;
} iso_sweep_journal;

/* Begins the journal of the result `path`, or goes on with one (resume). With resume it is no error if there is none.
 * If `path` is no regular file, or is "-" (standard output, as CSV), the journal has no name, and cannot be resumed.
 * The head must live as long as the journal.
 * Errors: ISO_FILE_TROUBLE: a journal of another sweep, a damaged one, one that another program works on, one that is
 * there without resume; a file `path` that is there, unless it is the result of this sweep and resume is given: then
 * all chunks are done, and finishing writes nothing. Nothing is changed then. ISO_BAD_ARGUMENT: this build has no
 * HDF5; too many shards. ISO_NO_MEMORY. */
iso_status iso_sweep_journal_open(iso_context *ctx, const char *path, const iso_sweep_head *head,
                                  iso_sweep_shard shard, bool resume, iso_sweep_journal **journal);

/* Whether chunk c is there or belongs to another shard. */
bool iso_sweep_journal_has(const iso_sweep_journal *j, size_t c);

/* Adds a chunk. Errors: ISO_FILE_TROUBLE: the journal is then as it was before. */
iso_status iso_sweep_journal_add(iso_context *ctx, iso_sweep_journal *j, size_t c, const iso_sweep_rows *rows);

/* Writes the result; all chunks of the shard must be there. Errors: ISO_FILE_TROUBLE, also if a file of this name
 * has appeared: then that file and the journal both stay; ISO_NO_MEMORY. */
iso_status iso_sweep_journal_finish(iso_context *ctx, iso_sweep_journal *j);

/* The journal's file stays, unless nothing is in it. */
void iso_sweep_journal_close(iso_sweep_journal *j);

/* --- results: tables (sweep_reader.c, sweep_writer.c) ----------------------------------------------------------- */

typedef struct iso_sweep_reader {
    iso_table_reader *table;
    iso_sweep_head head; /* its texts are lines of the table */
    iso_sweep_shard shard;
    size_t lines, next, points; /* lines before the rows; the row that is read next; rows in the file */
    uint64_t sum;               /* of the rows that were read */
    double *row;
    char *path;
} iso_sweep_reader;

/* Opens a result or a part. Errors: ISO_FILE_TROUBLE: no such file, or none of a sweep. */
iso_status iso_sweep_reader_open(iso_context *ctx, const char *path, iso_sweep_reader **reader);
void iso_sweep_reader_close(iso_sweep_reader *reader);

/* Reads the next `count` rows of one chunk, at most rows->most. Errors: ISO_FILE_TROUBLE: a row is missing or
 * damaged; with the last rows: the sum of all is not that in the file. */
iso_status iso_sweep_reader_rows(iso_context *ctx, iso_sweep_reader *reader, size_t count, iso_sweep_rows *rows);

/* Reads all rows, from the first on, for those that have failed. Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_sweep_reader_failures(iso_context *ctx, iso_sweep_reader *reader, iso_sweep_failures *failures);

/* Writes a result: `next` gives the rows of chunk c, by growing number. If a file of this name exists at the end, it
 * is kept. The sum of all rows stands in the file: a result that was changed or damaged later is found out. Errors:
 * ISO_FILE_TROUBLE, ISO_NO_MEMORY, those of `next`: then there is no new file. */
iso_status iso_sweep_write(iso_context *ctx, const char *path, const iso_sweep_head *head, iso_sweep_shard shard,
                           iso_status (*next)(iso_context *ctx, void *data, size_t c, iso_sweep_rows *rows),
                           void *data);

/* The same in memory: a table without rows, to be freed also after an error, and the rows of a chunk. Errors:
 * ISO_NO_MEMORY. */
iso_status iso_sweep_table(iso_context *ctx, const iso_sweep_head *head, iso_record **table);
iso_status iso_sweep_table_add(iso_context *ctx, iso_record *table, const iso_sweep_rows *rows);

/* Reads a result or a part into a table. Errors: ISO_FILE_TROUBLE: no such file, none of a sweep, or a damaged one;
 * ISO_NO_MEMORY. */
iso_status iso_sweep_read_table(iso_context *ctx, const char *path, iso_record **table);

/* Puts the parts of one sweep together. *failures: those of all parts. Errors: ISO_FILE_TROUBLE: a part is missing,
 * is there twice, was changed or damaged, or belongs to another sweep; `path` is there. */
iso_status iso_sweep_merge(iso_context *ctx, size_t count, const char *const parts[], const char *path,
                           iso_sweep_failures *failures);

#endif
