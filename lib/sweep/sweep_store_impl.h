/* sweep_store_impl.h - results of sweeps as files of several kinds: what a kind must be able to do.
 *
 *     sweep_journal.c   the journal; sweep_record.c: its records
 *     sweep_result.c    results of any kind: opening, reading, merging
 *     sweep_csv.c, hdf5_sweep.c   the kinds
 */
#ifndef ISO_IO_SWEEP_STORE_IMPL_H
#define ISO_IO_SWEEP_STORE_IMPL_H

#include "sweep/sweep_store.h"

#define ISO_SWEEP_FORMAT "isoroll sweep 1"
#define ISO_SWEEP_PART_FORMAT "isoroll sweep part 1"

/* A result being written. Rows come by growing number. If a file of this name exists at the closing, it is kept. The
 * sum of all rows stands in the file: a result that was changed or damaged later is found out. */
typedef struct iso_sweep_writing {
    iso_status (*create)(iso_context *ctx, const char *path, const iso_sweep_head *head, iso_sweep_shard share,
                         void **file);
    iso_status (*rows)(iso_context *ctx, void *file, const iso_sweep_rows *rows);
    /* Releases the file also after an error. sum: of all rows; NULL: the new file is thrown away. */
    iso_status (*close)(iso_context *ctx, void *file, const uint64_t *sum);
} iso_sweep_writing;

/* What is read of a file before its rows. The text and the columns are released by iso_sweep_reader_close. */
typedef struct iso_sweep_begin {
    iso_sweep_head head;
    iso_sweep_shard share;
    iso_sweep_column *column;
    char *text, *scene;
} iso_sweep_begin;

typedef struct iso_sweep_reading {
    /* Errors: ISO_FILE_TROUBLE. *begin is released by the caller in any case, after close. The caller looks whether
     * its numbers make sense before it reads rows. */
    iso_status (*open)(iso_context *ctx, const char *path, iso_sweep_begin *begin, void **file);
    iso_status (*rows)(iso_context *ctx, void *file, size_t count, iso_sweep_rows *rows);
    bool (*sum)(void *file, uint64_t *sum); /* behind the last row; false: there is none, or more than that */
    void (*close)(void *file);
} iso_sweep_reading;

extern const iso_sweep_writing iso_sweep_csv_writing, iso_sweep_hdf5_writing;
extern const iso_sweep_reading iso_sweep_csv_reading, iso_sweep_hdf5_reading;

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

/* By the ending of the name; for reading also by the first bytes. NULL: this build has no HDF5. */
const iso_sweep_writing *iso_sweep_writing_of(const char *path);

/* Points of a share, the number in the sweep of its i-th point, and whether it is all. */
size_t iso_sweep_shard_points(const iso_sweep_head *head, iso_sweep_shard share);
size_t iso_sweep_shard_point(const iso_sweep_head *head, iso_sweep_shard share, size_t i);
bool iso_sweep_shard_is_all(iso_sweep_shard share);

/* The hash as 32 hexadecimal digits, and back. */
enum { ISO_HASH_SIZE = 33 };
void iso_sweep_hash_print(char text[ISO_HASH_SIZE], const uint64_t hash[2]);
bool iso_sweep_hash_scan(const char *text, uint64_t hash[2]);

/* "vary.k chaos.verdict": all columns, as text; and back. NULL: no memory, or no such text. */
char *iso_sweep_columns_print(const iso_sweep_head *head);
iso_sweep_column *iso_sweep_columns_scan(const char *text, int *count);

/* "cannot read 'path': WHY" */
iso_status iso_sweep_damaged(iso_context *ctx, const char *path, const char *why);

/* Reads all rows, from the first on, for those that have failed. Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_sweep_reader_failures(iso_context *ctx, iso_sweep_reader *reader, iso_sweep_failures *failures);

#endif
