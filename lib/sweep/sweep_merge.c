/* sweep_merge.c - one result from the parts of a sweep. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "sweep/sweep_store_impl.h"

iso_status iso_sweep_copy(iso_context *ctx, iso_sweep_reader *const part[], size_t count, iso_sweep_shard shard,
                          const char *path, iso_record **table, iso_sweep_failures *failures)
{
    const iso_sweep_head *head = &part[0]->head;
    iso_sweep_writer writer = {.sum = 0};
    iso_sweep_rows rows;
    ISO_TRY(iso_sweep_rows_create(ctx, head->columns, head->chunk, &rows));
    iso_status status = path || table ? iso_sweep_writer_open(ctx, path, head, shard, false, &writer) : ISO_OK;
    for (size_t c = shard.index; c < iso_sweep_chunks(head) && status == ISO_OK; c += shard.count) {
        status = iso_sweep_reader_rows(ctx, part[c % count], &rows);
        if (status == ISO_OK && writer.table) status = iso_sweep_writer_rows(ctx, &writer, &rows);
        if (status == ISO_OK && failures) iso_sweep_failures_add(failures, &rows);
    }
    if (status == ISO_OK && table) *table = writer.table, writer.table = NULL;
    const iso_status closed = iso_sweep_writer_close(ctx, &writer, path && status == ISO_OK);
    iso_sweep_rows_free(&rows);
    return status == ISO_OK ? closed : status;
}

iso_status iso_sweep_read_table(iso_context *ctx, const char *path, iso_record **table)
{
    iso_sweep_reader *r;
    *table = NULL;
    ISO_TRY(iso_sweep_reader_open(ctx, path, &r));
    const iso_status status = iso_sweep_copy(ctx, &r, 1, r->shard, NULL, table, NULL);
    iso_sweep_reader_close(r);
    return status;
}

/* --- merging ---------------------------------------------------------------------------------------------------- */

typedef struct merger {
    size_t count, given;     /* parts of the sweep; files */
    iso_sweep_reader **part; /* by its index in the sweep */
    const iso_sweep_reader *first;
} merger;

/* The first part says how many there are. Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
static iso_status check_part(iso_context *ctx, merger *m, const iso_sweep_reader *r)
{
    const iso_sweep_head *a = &m->first->head, *b = &r->head;
    const iso_sweep_shard shard = r->shard;
    if (memcmp(a->hash, b->hash, sizeof a->hash) != 0 || a->count != b->count || a->chunk != b->chunk ||
        a->columns != b->columns)
        return ISO_FAIL_FILE(ctx, "'%s' is a part of another sweep than '%s'", r->path, m->first->path);
    if (shard.count == 1) return ISO_FAIL_FILE(ctx, "'%s' is a whole sweep, not a part", r->path);
    if (shard.count < m->given)
        return ISO_FAIL_FILE(ctx, "'%s' is part %zu of %zu, but %zu files are given", r->path, shard.index + 1,
                             shard.count, m->given);
    if (!m->part) m->part = calloc(m->count = shard.count, sizeof *m->part);
    if (!m->part) return iso_context_no_memory(ctx, "the parts");
    if (shard.count != m->count)
        return ISO_FAIL_FILE(ctx, "'%s' is part %zu of %zu, others are parts of %zu", r->path, shard.index + 1,
                             shard.count, m->count);
    if (!m->part[shard.index]) return ISO_OK;
    return ISO_FAIL_FILE(ctx, "part %zu of %zu is there twice: '%s' and '%s'", shard.index + 1, shard.count,
                         m->part[shard.index]->path, r->path);
}

static iso_status add_part(iso_context *ctx, merger *m, const char *path)
{
    iso_sweep_reader *r;
    ISO_TRY(iso_sweep_reader_open(ctx, path, &r));
    if (!m->part) m->first = r;
    iso_status status = check_part(ctx, m, r);
    if (status == ISO_OK)
        m->part[r->shard.index] = r;
    else
        iso_sweep_reader_close(r);
    return status;
}

iso_status iso_sweep_merge(iso_context *ctx, size_t count, const char *const parts[], const char *path,
                           iso_sweep_failures *failures)
{
    struct stat s;
    merger m = {.given = count};
    iso_status status = ISO_OK;
    *failures = (iso_sweep_failures){.count = 0};
    if (strcmp(path, "-") != 0 && stat(path, &s) == 0 && S_ISREG(s.st_mode))
        return ISO_FAIL_FILE(ctx, "'%s' is there: it is not overwritten", path);
    for (size_t i = 0; i < count && status == ISO_OK; i++) status = add_part(ctx, &m, parts[i]);
    for (size_t i = 0; i < m.count && status == ISO_OK; i++)
        if (!m.part[i]) status = ISO_FAIL_FILE(ctx, "part %zu of %zu is missing", i + 1, m.count);
    if (status == ISO_OK)
        status = iso_sweep_copy(ctx, m.part, m.count, (iso_sweep_shard){0, 1}, path, NULL, failures);
    for (size_t i = 0; i < m.count; i++) iso_sweep_reader_close(m.part[i]);
    free(m.part);
    return status;
}
