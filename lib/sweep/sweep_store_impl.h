/* sweep_store_impl.h - what journals and results of sweeps share.
 *
 *     sweep_journal.c   the journal; sweep_record.c: its records
 *     sweep_writer.c, sweep_reader.c   results, which are tables
 *     sweep_result.c    shards, hashes, columns; merging
 */
#ifndef ISO_IO_SWEEP_STORE_IMPL_H
#define ISO_IO_SWEEP_STORE_IMPL_H

#include "sweep/sweep_store.h"

#define ISO_SWEEP_KIND "sweep"
#define ISO_SWEEP_PART_KIND "sweep part"

/* A result being written. Rows come by growing number. If a file of this name exists at the closing, it is kept. The
 * sum of all rows stands in the file: a result that was changed or damaged later is found out. */
typedef struct iso_sweep_writer iso_sweep_writer;
iso_status iso_sweep_writer_open(iso_context *ctx, const char *path, const iso_sweep_head *head,
                                 iso_sweep_shard share, iso_sweep_writer **writer);
iso_status iso_sweep_writer_rows(iso_context *ctx, iso_sweep_writer *writer, const iso_sweep_rows *rows);

/* Frees the writer. sum: of all rows; NULL: the new file is thrown away. */
iso_status iso_sweep_writer_close(iso_context *ctx, iso_sweep_writer *writer, const uint64_t *sum);

struct iso_sweep_reader {
    struct iso_table_reader *table;
    iso_sweep_head head; /* its texts are lines of the table */
    iso_sweep_shard share;
    size_t lines, next, points; /* lines before the rows; the row that is read next; rows in the file */
    uint64_t sum;               /* of the rows that were read */
    double *row;
    char *path;
};

/* Of bytes; another salt gives another number. */
uint64_t iso_sweep_checksum(const void *bytes, size_t length, uint64_t salt);

/* The sum of rows before and these. It begins as 0. All kinds of nan count as one. */
uint64_t iso_sweep_sum(uint64_t before, const iso_sweep_rows *rows);

/* Adds the failures of these rows. */
void iso_sweep_failures_add(iso_sweep_failures *failures, const iso_sweep_rows *rows);

/* What stands before the bytes of a chunk in a journal; `bytes` are those behind it. */
typedef struct iso_sweep_record {
    uint64_t chunk, length, checksum;
} iso_sweep_record;

uint64_t iso_sweep_record_sum(const iso_sweep_record *r, const unsigned char bytes[]);

/* Whether a whole record begins somewhere in these bytes. */
bool iso_sweep_record_inside(const iso_sweep_head *head, const unsigned char bytes[], size_t length);

/* Points of a share, the number in the sweep of its i-th point, and whether it is all. */
size_t iso_sweep_shard_points(const iso_sweep_head *head, iso_sweep_shard share);
size_t iso_sweep_shard_point(const iso_sweep_head *head, iso_sweep_shard share, size_t i);
bool iso_sweep_shard_is_all(iso_sweep_shard share);

/* The hash as 32 hexadecimal digits, and back. */
enum { ISO_HASH_SIZE = 33 };
void iso_sweep_hash_print(char text[ISO_HASH_SIZE], const uint64_t hash[2]);
bool iso_sweep_hash_scan(const char *text, uint64_t hash[2]);

/* The name of a column in a table: k, chaos_verdict. */
enum { ISO_SWEEP_NAME = 2 * ISO_NAME_SIZE };
const char *iso_sweep_column_name(const iso_sweep_column *column, char name[ISO_SWEEP_NAME]);

/* "vary/k chaos/verdict": all columns, as text; and back. NULL: no memory, or no such text. */
char *iso_sweep_columns_print(const iso_sweep_head *head);
iso_sweep_column *iso_sweep_columns_scan(const char *text, int *count);

/* Reads all rows, from the first on, for those that have failed. Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_sweep_reader_failures(iso_context *ctx, iso_sweep_reader *reader, iso_sweep_failures *failures);

#endif
