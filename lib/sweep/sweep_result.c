/* sweep_result.c - what readers and writers of results share: shards, hashes, columns; and merging parts. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "sweep/sweep_store_impl.h"

enum { MOST_COLUMNS = 4096 }; /* of files; a sweep has about 1000 */

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

const char *iso_sweep_column_name(const iso_sweep_column *c, char name[ISO_SWEEP_NAME])
{
    const bool vary = strcmp(c->group, "vary") == 0;
    snprintf(name, ISO_SWEEP_NAME, "%s%s%s", vary ? "" : c->group, vary ? "" : "_", c->name);
    return name;
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
    const iso_sweep_head *a = first ? &first->head : &one->head, *b = &one->head;
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
    const iso_sweep_shard share = r->share;
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
        if (m->part[i]->share.count != m->count)
            return iso_context_fail(m->ctx, ISO_FILE_TROUBLE, "", "'%s' is part %zu of %zu, others are parts of %zu",
                                    m->part[i]->path, i + 1, m->part[i]->share.count, m->count);
    }
    return ISO_OK;
}

static iso_status write_parts(const merger *m, const char *path, iso_sweep_failures *failures)
{
    const iso_sweep_head *head = &m->part[0]->head;
    iso_sweep_writer *writer = NULL;
    iso_sweep_rows rows;
    uint64_t sum = 0;
    iso_status status = iso_sweep_rows_create(m->ctx, head->columns, head->chunk, &rows);
    if (status == ISO_OK) status = iso_sweep_writer_open(m->ctx, path, head, (iso_sweep_shard){0, 1}, &writer);
    for (size_t c = 0; c < iso_sweep_chunks(head) && status == ISO_OK; c++) {
        status = iso_sweep_reader_rows(m->ctx, m->part[c % m->count], iso_sweep_chunk_points(head, c), &rows);
        if (status != ISO_OK) break;
        iso_sweep_failures_add(failures, &rows);
        sum = iso_sweep_sum(sum, &rows);
        status = iso_sweep_writer_rows(m->ctx, writer, &rows);
    }
    iso_sweep_rows_free(&rows);
    if (!writer) return status;
    const iso_status closed = iso_sweep_writer_close(m->ctx, writer, status == ISO_OK ? &sum : NULL);
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
