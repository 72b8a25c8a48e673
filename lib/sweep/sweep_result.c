/* sweep_result.c - results of sweeps of any kind: which kind a file is, reading it, and merging parts. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/replacement_impl.h"
#include "sweep/sweep_store_impl.h"

enum { MOST_COLUMNS = 4096, MOST_CHUNK = 1 << 16 }; /* of files; a sweep has about 1000 and 4096 at most */

/* --- kinds ------------------------------------------------------------------------------------------------------ */

static bool ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), end = strlen(ending);
    return length >= end && strcasecmp(path + length - end, ending) == 0;
}

const iso_sweep_writing *iso_sweep_writing_of(const char *path)
{
    if (!ends_in(path, ".h5") && !ends_in(path, ".hdf5")) return &iso_sweep_csv_writing;
#ifdef ISO_HDF5
    return &iso_sweep_hdf5_writing;
#else
    return NULL;
#endif
}

/* By its first bytes. */
static const iso_sweep_reading *reading_of(const char *path)
{
    char begin[8] = "";
    FILE *file = fopen(path, "re");
    if (!file) return NULL;
    const size_t got = fread(begin, 1, sizeof begin, file);
    fclose(file);
    if (got < sizeof begin || memcmp(begin, "\x89HDF\r\n\x1a\n", 8) != 0) return &iso_sweep_csv_reading;
#ifdef ISO_HDF5
    return &iso_sweep_hdf5_reading;
#else
    return NULL;
#endif
}

iso_status iso_sweep_damaged(iso_context *ctx, const char *path, const char *why)
{
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot read '%s': %s", path, why);
}

/* --- shares, hashes, columns ------------------------------------------------------------------------------------ */

bool iso_sweep_shard_is_all(iso_sweep_shard share)
{
    return share.count == 1;
}

size_t iso_sweep_shard_points(const iso_sweep_head *head, iso_sweep_shard share)
{
    const size_t chunks = iso_sweep_chunks(head);
    if (share.index >= chunks) return 0;
    const size_t mine = (chunks - share.index - 1) / share.count + 1, last = share.index + (mine - 1) * share.count;
    return (mine - 1) * head->chunk + iso_sweep_chunk_points(head, last);
}

/* All its chunks are full, but perhaps the last one. */
size_t iso_sweep_shard_point(const iso_sweep_head *head, iso_sweep_shard share, size_t i)
{
    return (share.index + i / head->chunk * share.count) * head->chunk + i % head->chunk;
}

void iso_sweep_hash_print(char text[ISO_HASH_SIZE], const uint64_t hash[2])
{
    snprintf(text, ISO_HASH_SIZE, "%016" PRIx64 "%016" PRIx64, hash[0], hash[1]);
}

bool iso_sweep_hash_scan(const char *text, uint64_t hash[2])
{
    return strlen(text) == ISO_HASH_SIZE - 1 && sscanf(text, "%16" SCNx64 "%16" SCNx64, &hash[0], &hash[1]) == 2;
}

char *iso_sweep_columns_print(const iso_sweep_head *head)
{
    char *text = malloc((size_t)(head->columns + 1) * 2 * ISO_NAME_SIZE), *at = text;
    if (!text) return NULL;
    *at = '\0';
    for (int i = 0; i < head->columns; i++)
        at += sprintf(at, "%s%s/%s", i > 0 ? " " : "", head->column[i].group, head->column[i].name);
    return text;
}

iso_sweep_column *iso_sweep_columns_scan(const char *text, int *count)
{
    *count = 1;
    for (const char *c = text; *c && *count <= MOST_COLUMNS; c++) *count += *c == ' ';
    if (*count > MOST_COLUMNS) return NULL;
    iso_sweep_column *columns = calloc((size_t)*count, sizeof *columns);
    for (int i = 0; columns && i < *count; i++) {
        int used = 0;
        if (sscanf(text, " %31[^/ ]/%31[^ ]%n", columns[i].group, columns[i].name, &used) != 2) {
            free(columns);
            return NULL;
        }
        text += used;
    }
    return columns;
}

/* --- reading ---------------------------------------------------------------------------------------------------- */

struct iso_sweep_reader {
    const iso_sweep_reading *kind;
    void *file;
    iso_sweep_begin begin;
    size_t next, points; /* the row that is read next; rows in the file */
    uint64_t sum;        /* of the rows that were read */
    char *path;
};

/* Numbers that cannot be: the file is damaged. They come from outside: no sum or product of them may overflow, and
 * no memory is asked for that a sweep does not need. */
static bool makes_sense(const iso_sweep_begin *b)
{
    const iso_sweep_head *h = &b->head;
    return h->count > 0 && h->count <= (size_t)1 << 53 && h->chunk > 0 && h->chunk <= MOST_CHUNK && h->columns > 0 &&
           b->column && b->share.count > 0 && b->share.count <= ISO_SWEEP_MOST_SHARES &&
           b->share.index < b->share.count;
}

static iso_status check_sum(iso_context *ctx, const iso_sweep_reader *r)
{
    uint64_t sum;
    if (!r->kind->sum(r->file, &sum))
        return iso_sweep_damaged(ctx, r->path, "its end is missing, or there is more behind it");
    if (sum != r->sum) return iso_sweep_damaged(ctx, r->path, "its rows were changed after it was written");
    return ISO_OK;
}

iso_status iso_sweep_reader_open(iso_context *ctx, const char *path, iso_sweep_reader **reader)
{
    *reader = NULL;
    iso_sweep_reader *r = calloc(1, sizeof *r);
    if (r) r->path = strdup(path);
    if (!r || !r->path) {
        free(r);
        return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for '%s'", path);
    }
    r->kind = access(path, R_OK) == 0 ? reading_of(path) : NULL;
    iso_status status = ISO_OK;
    if (access(path, R_OK) != 0)
        status = iso_file_trouble(ctx, "open", path);
    else if (!r->kind)
        status = iso_sweep_damaged(ctx, path, "this build has no HDF5");
    if (status == ISO_OK) status = r->kind->open(ctx, path, &r->begin, &r->file);
    r->begin.head.column = r->begin.column;
    r->begin.head.scene = r->begin.scene;
    r->begin.head.text = r->begin.text ? r->begin.text : "";
    if (status == ISO_OK && !makes_sense(&r->begin)) status = iso_sweep_damaged(ctx, path, "its head is damaged");
    if (status == ISO_OK) {
        r->points = iso_sweep_shard_points(&r->begin.head, r->begin.share);
        if (r->points == 0) status = check_sum(ctx, r);
    }
    if (status == ISO_OK) {
        *reader = r;
    } else {
        iso_sweep_reader_close(r);
    }
    return status;
}

void iso_sweep_reader_close(iso_sweep_reader *r)
{
    if (!r) return;
    if (r->file) r->kind->close(r->file);
    free(r->begin.column);
    free(r->begin.text);
    free(r->begin.scene);
    free(r->path);
    free(r);
}

const iso_sweep_head *iso_sweep_reader_head(const iso_sweep_reader *r)
{
    return &r->begin.head;
}

iso_sweep_shard iso_sweep_reader_share(const iso_sweep_reader *r)
{
    return r->begin.share;
}

iso_status iso_sweep_reader_rows(iso_context *ctx, iso_sweep_reader *r, size_t count, iso_sweep_rows *rows)
{
    if (r->points - r->next < count) return iso_sweep_damaged(ctx, r->path, "it has no more rows");
    rows->first = iso_sweep_shard_point(&r->begin.head, r->begin.share, r->next);
    rows->count = count;
    r->next += count;
    const iso_status status = r->kind->rows(ctx, r->file, count, rows);
    if (status != ISO_OK) return status;
    r->sum = iso_sweep_sum(r->sum, rows);
    return r->next < r->points ? ISO_OK : check_sum(ctx, r);
}

iso_status iso_sweep_reader_failures(iso_context *ctx, iso_sweep_reader *r, iso_sweep_failures *failures)
{
    const size_t chunk = r->begin.head.chunk;
    iso_sweep_rows rows;
    *failures = (iso_sweep_failures){.count = 0};
    iso_status status = iso_sweep_rows_create(ctx, r->begin.head.columns, chunk, &rows);
    if (status != ISO_OK) return status;
    while (r->next < r->points && status == ISO_OK) {
        status = iso_sweep_reader_rows(ctx, r, r->points - r->next < chunk ? r->points - r->next : chunk, &rows);
        if (status == ISO_OK) iso_sweep_failures_add(failures, &rows);
    }
    iso_sweep_rows_free(&rows);
    return status;
}

/* --- merging ---------------------------------------------------------------------------------------------------- */

typedef struct merger {
    iso_context *ctx;
    size_t count;
    const char *const *path;
    iso_sweep_reader **part; /* by its index in the sweep */
} merger;

static iso_status same_sweep(const merger *m, const iso_sweep_reader *one, const char *path)
{
    const iso_sweep_reader *first = NULL;
    for (size_t i = 0; i < m->count && !first; i++) first = m->part[i];
    const iso_sweep_head *a = first ? &first->begin.head : &one->begin.head, *b = &one->begin.head;
    if (memcmp(a->hash, b->hash, sizeof a->hash) == 0 && a->count == b->count && a->chunk == b->chunk &&
        a->columns == b->columns)
        return ISO_OK;
    return iso_context_fail(m->ctx, ISO_FILE_TROUBLE, "", "'%s' is a part of another sweep than '%s'", path,
                            first->path);
}

static iso_status add_part(merger *m, const char *path)
{
    iso_sweep_reader *r;
    iso_status status = iso_sweep_reader_open(m->ctx, path, &r);
    if (status != ISO_OK) return status;
    const iso_sweep_shard share = r->begin.share;
    status = same_sweep(m, r, path);
    if (status == ISO_OK && share.count == 1)
        status = iso_context_fail(m->ctx, ISO_FILE_TROUBLE, "", "'%s' is a whole sweep, not a part", path);
    if (status == ISO_OK && share.count < m->count)
        status = iso_context_fail(m->ctx, ISO_FILE_TROUBLE, "", "'%s' is part %zu of %zu, but %zu files are given",
                                  path, share.index + 1, share.count, m->count);
    if (status == ISO_OK && share.count > m->count) {
        /* which of them is missing is known when all are open */
        iso_sweep_reader **more = realloc(m->part, share.count * sizeof *more);
        if (!more) status = iso_context_fail(m->ctx, ISO_NO_MEMORY, "", "no memory for the parts");
        if (more) {
            memset(more + m->count, 0, (share.count - m->count) * sizeof *more);
            m->part = more;
            m->count = share.count;
        }
    }
    if (status == ISO_OK && m->part[share.index])
        status = iso_context_fail(m->ctx, ISO_FILE_TROUBLE, "", "part %zu of %zu is there twice: '%s' and '%s'",
                                  share.index + 1, share.count, m->part[share.index]->path, path);
    if (status == ISO_OK)
        m->part[share.index] = r;
    else
        iso_sweep_reader_close(r);
    return status;
}

static iso_status check_parts(const merger *m)
{
    for (size_t i = 0; i < m->count; i++) {
        if (!m->part[i])
            return iso_context_fail(m->ctx, ISO_FILE_TROUBLE, "", "part %zu of %zu is missing", i + 1, m->count);
        if (m->part[i]->begin.share.count != m->count)
            return iso_context_fail(m->ctx, ISO_FILE_TROUBLE, "", "'%s' is part %zu of %zu, others are parts of %zu",
                                    m->part[i]->path, i + 1, m->part[i]->begin.share.count, m->count);
    }
    return ISO_OK;
}

static iso_status write_parts(const merger *m, const char *path, iso_sweep_failures *failures)
{
    const iso_sweep_head *head = &m->part[0]->begin.head;
    const iso_sweep_writing *kind = iso_sweep_writing_of(path);
    iso_sweep_rows rows;
    uint64_t sum = 0;
    void *file;
    if (!kind) return iso_context_fail(m->ctx, ISO_BAD_ARGUMENT, "", "'%s': this build has no HDF5", path);
    iso_status status = iso_sweep_rows_create(m->ctx, head->columns, head->chunk, &rows);
    if (status != ISO_OK) return status;
    status = kind->create(m->ctx, path, head, (iso_sweep_shard){0, 1}, &file);
    const bool created = status == ISO_OK;
    for (size_t c = 0; c < iso_sweep_chunks(head) && status == ISO_OK; c++) {
        status = iso_sweep_reader_rows(m->ctx, m->part[c % m->count], iso_sweep_chunk_points(head, c), &rows);
        if (status != ISO_OK) break;
        iso_sweep_failures_add(failures, &rows);
        sum = iso_sweep_sum(sum, &rows);
        status = kind->rows(m->ctx, file, &rows);
    }
    iso_sweep_rows_free(&rows);
    if (!created) return status;
    const iso_status closed = kind->close(m->ctx, file, status == ISO_OK ? &sum : NULL);
    return status == ISO_OK ? closed : status;
}

iso_status iso_sweep_merge(iso_context *ctx, size_t count, const char *const parts[], const char *path,
                           iso_sweep_failures *failures)
{
    struct stat s;
    merger m = {.ctx = ctx, .count = count, .path = parts};
    if (strcmp(path, "-") != 0 && stat(path, &s) == 0 && S_ISREG(s.st_mode))
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s' is there: it is not overwritten", path);
    *failures = (iso_sweep_failures){.count = 0};
    m.part = calloc(count + 1, sizeof *m.part);
    if (!m.part) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for the parts");
    iso_status status = ISO_OK;
    for (size_t i = 0; i < count && status == ISO_OK; i++) status = add_part(&m, parts[i]);
    if (status == ISO_OK) status = check_parts(&m);
    if (status == ISO_OK) status = write_parts(&m, path, failures);
    for (size_t i = 0; i < m.count; i++) iso_sweep_reader_close(m.part[i]);
    free(m.part);
    return status;
}
