/* sweep_store_impl.h - where the rows of a sweep go: into its result, as they come.
 *
 *     iso_sweep_store *s;
 *     status = iso_sweep_store_open(ctx, "out.csv", head, whole, true, &s);      whole: (iso_sweep_shard){0, 1}
 *     for each chunk c of the shard from number s->done on:
 *         status = iso_sweep_store_add(ctx, s, &rows);
 *     status = iso_sweep_store_finish(ctx, s);                                 out.csv.part becomes out.csv
 *     iso_sweep_store_close(s);
 *
 * Rows are written in the order of chunks; a chunk that comes early waits in memory for its turn. So the bytes of the
 * result depend on nothing but the sweep. Until it is whole it is out.csv.part, locked while a program writes it. One
 * that was left is cut behind its last whole chunk, and gone on with. A result in HDF5, out.h5, is made at the end from
 * such a file: out.h5.csv.part.
 *
 * Shard i of n (option --shard) is chunk i, i + n, i + 2n, ... of a sweep. Its result is a part; iso_sweep_merge
 * puts parts together, to the bytes that one program writes.
 */
#ifndef ISO_SWEEP_SWEEP_STORE_IMPL_H
#define ISO_SWEEP_SWEEP_STORE_IMPL_H

#include "io/table_impl.h"
#include "sweep/sweep_impl.h"

#define ISO_SWEEP_KIND "sweep"
#define ISO_SWEEP_PART_KIND "sweep part"

#define ISO_FAIL_FILE(ctx, ...) iso_context_fail(ctx, ISO_FILE_TROUBLE, "", __VA_ARGS__)

/* --- shards, failures, sums ------------------------------------------------------------------------------------- */

/* Chunks index, index + count, ...; {0, 1}: all. count is at most ISO_SWEEP_MOST_SHARDS. */
enum { ISO_SWEEP_MOST_SHARDS = 1000000 };
typedef struct iso_sweep_shard {
    size_t index, count;
} iso_sweep_shard;

/* Its chunks, its points, and the number in the sweep of its i-th point. */
bool iso_sweep_shard_read(const char *text, iso_sweep_shard *shard); /* "i/n", from 1 on; false: it is none */
size_t iso_sweep_shard_chunks(const iso_sweep_head *head, iso_sweep_shard shard);
size_t iso_sweep_shard_points(const iso_sweep_head *head, iso_sweep_shard shard);
size_t iso_sweep_shard_point(const iso_sweep_head *head, iso_sweep_shard shard, size_t i);

/* Points that have failed: how many, and the number and the reason of the first. */
typedef struct iso_sweep_failures {
    size_t count, first;
    char reason[ISO_REASON_SIZE];
} iso_sweep_failures;
void iso_sweep_failures_add(iso_sweep_failures *failures, const iso_sweep_rows *rows);

/* The sum of rows before and these (sweep_hash.c). It begins as 0. All kinds of nan count as one. */
uint64_t iso_sweep_sum(uint64_t before, const iso_sweep_rows *rows);

/* The name of a column in a table: k, chaos_verdict. */
enum { ISO_SWEEP_NAME = 3 * ISO_NAME_SIZE + 1 };
const char *iso_sweep_column_name(const iso_sweep_column *column, char name[ISO_SWEEP_NAME]);

/* --- results: tables (sweep_reader.c, sweep_writer.c) ----------------------------------------------------------- */

typedef struct iso_sweep_reader {
    iso_table_reader *table;
    iso_sweep_head head; /* its texts are lines of the table */
    iso_sweep_shard shard;
    size_t lines, next, points; /* lines before the rows; the row that is read next; rows in the file */
    uint64_t sum;               /* of the rows that were read */
    bool unended;               /* set it: the file may be one that is gone on with, and have no sum */
    double *row;
    const char *path; /* the caller's */
} iso_sweep_reader;

/* Opens a result or a part. Errors: ISO_FILE_TROUBLE: no such file, or none of a sweep. */
iso_status iso_sweep_reader_open(iso_context *ctx, const char *path, iso_sweep_reader **reader);
void iso_sweep_reader_close(iso_sweep_reader *reader);

/* Reads the rows of the next chunk, or of what there is of it. Errors: ISO_FILE_TROUBLE: a row is missing or damaged;
 * with the last rows: the sum of all is not that in the file. */
iso_status iso_sweep_reader_rows(iso_context *ctx, iso_sweep_reader *reader, iso_sweep_rows *rows);

/* Writes a result, chunk by chunk in their order. The sum of all rows stands in the file: a result that was changed or
 * damaged later is found out. */
typedef struct iso_sweep_writer {
    iso_table_writer *file; /* NULL: rows go to the table */
    iso_record *table;      /* lines and columns          */
    double *row;
    uint64_t sum;
} iso_sweep_writer;

/* Begins one; path NULL: in memory. A file that has the name at the end is kept. resumes: a file in CSV that can be
 * gone on with; nothing is written before iso_table_go_on. Errors: those of iso_table_writer_open; close it also
 * then. */
iso_status iso_sweep_writer_open(iso_context *ctx, const char *path, const iso_sweep_head *head,
                                 iso_sweep_shard shard, bool resumes, iso_sweep_writer *writer);
iso_status iso_sweep_writer_rows(iso_context *ctx, iso_sweep_writer *writer, const iso_sweep_rows *rows);
iso_status iso_sweep_writer_end(iso_context *ctx, iso_sweep_writer *writer); /* writes the sum; close does so, too */
iso_status iso_sweep_writer_close(iso_context *ctx, iso_sweep_writer *writer, bool keep);

/* Reads a result or a part into a table. Errors: ISO_FILE_TROUBLE: no such file, none of a sweep, or a damaged one;
 * ISO_NO_MEMORY. */
iso_status iso_sweep_read_table(iso_context *ctx, const char *path, iso_record **table);

/* Puts the parts of one sweep together (sweep_reader.c). *failures: those of all parts. Errors: ISO_FILE_TROUBLE: a
 * part is missing, is there twice, was changed or damaged, or belongs to another sweep; `path` is there. */
iso_status iso_sweep_merge(iso_context *ctx, size_t count, const char *const parts[], const char *path,
                           iso_sweep_failures *failures);

/* Reads the chunks of a shard, each one from part c % count, and writes them to a new result `path`, or to a table
 * without the sum. path, table, failures may be NULL. */
iso_status iso_sweep_copy(iso_context *ctx, iso_sweep_reader *const part[], size_t count, iso_sweep_shard shard,
                          const char *path, iso_record **table, iso_sweep_failures *failures);

/* --- the store (sweep_store.c) ---------------------------------------------------------------------------------- */

typedef struct iso_sweep_store {
    char *path, *rows; /* of the result, and of its rows as CSV */
    char *part;        /* the name that these have until all are there; NULL: nobody can go on with them */
    const iso_sweep_head *head;
    iso_sweep_shard shard;
    size_t wanted, done; /* chunks of the shard, and how many of them are written */
    iso_sweep_failures failures;
    bool complete; /* the result is there already */
    bool ours;     /* its file was not refused */
    size_t next;   /* chunks of the shard that were given out by its source, or are done */
    size_t waiting;
    iso_sweep_rows *early; /* chunks that wait for their turn, by growing first point */
    iso_sweep_writer writer;
    bool (*interrupted)(void); /* set it: its source then has no next chunk; NULL: never */
    void (*progress)(void *data, double part);
    void *data; /* of progress, which may be NULL */
} iso_sweep_store;

/* Begins the result `path`, or goes on with what there is of it (resume). With resume it is no error if there is
 * nothing. If `path` is no regular file, or is "-" (standard output, as CSV), rows go there, and it cannot be resumed.
 * path NULL: rows go to a table in memory.
 * The head must live as long as the store.
 * Errors: ISO_FILE_TROUBLE: rows of another sweep, or that another program works on, or that are there without
 * resume; a journal of an older version; a file `path` that is there, unless it is the result of this sweep and resume
 * is given: then all chunks are done, and finishing writes nothing. Nothing is changed then. ISO_BAD_ARGUMENT: this
 * build has no HDF5; too many shards. ISO_NO_MEMORY. */
iso_status iso_sweep_store_open(iso_context *ctx, const char *path, const iso_sweep_head *head, iso_sweep_shard shard,
                                bool resume, iso_sweep_store **store);

/* Adds a chunk of the shard that is not written yet. Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_sweep_store_add(iso_context *ctx, iso_sweep_store *store, const iso_sweep_rows *rows);

/* Its chunks that are not written yet, as a source for iso_sweep_run: adds what comes. */
iso_sweep_source iso_sweep_store_source(iso_sweep_store *store);

/* The table of a store in memory, to be freed by the caller, with chunks behind one that is missing, too; with the sum
 * if all are there. NULL: there is no row. Errors: ISO_NO_MEMORY. */
iso_status iso_sweep_store_table(iso_context *ctx, iso_sweep_store *store, iso_record **table);

/* Ends the result; all chunks of the shard must be there. Errors: ISO_FILE_TROUBLE, also if a file of this name has
 * appeared: then that file and the rows both stay; ISO_NO_MEMORY. */
iso_status iso_sweep_store_finish(iso_context *ctx, iso_sweep_store *store);

/* The rows stay, if there are any. */
void iso_sweep_store_close(iso_sweep_store *store);

#endif
