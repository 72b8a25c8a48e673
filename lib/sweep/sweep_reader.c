/* sweep_reader.c - reads results of sweeps (sweep_writer.c says what stands in them), finds out damaged ones, and makes
 * one result from the parts of a sweep. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/output_impl.h"
#include "sweep/sweep_store_impl.h"

enum { MOST_CHUNK = 1 << 16, MOST_COLUMNS = 4096 }; /* of files; a sweep has 4096 at most, and about 1000 */

static iso_status damaged(iso_context *ctx, const char *path, const char *why)
{
    return ISO_FAIL_FILE(ctx, "cannot read '%s': %s", path, why);
}

/* --- the head --------------------------------------------------------------------------------------------------- */

/* The columns are those of the line "names", in older files "columns": "vary/k chaos/verdict". */
static bool read_columns(const iso_record *r, iso_sweep_head *h)
{
    const char *text = iso_record_get(r, iso_record_get(r, "names") ? "names" : "columns");
    const size_t all = iso_record_columns(r), columns = all - 3;
    iso_sweep_column *column = text && all > 3 && columns <= MOST_COLUMNS ? calloc(columns, sizeof *column) : NULL;
    h->column = column;
    h->columns = (int)columns;
    bool good = column && strcmp(iso_record_name(r, 0), "point") == 0 &&
                strcmp(iso_record_name(r, columns + 1), "status") == 0 && iso_record_has_words(r, columns + 2);
    for (size_t i = 0; good && i < columns; i++) {
        char name[ISO_SWEEP_NAME];
        int used = 0;
        good = sscanf(text, " %31[^/ ]/%63[^ ]%n", column[i].group, column[i].name, &used) == 2 &&
               strcmp(iso_sweep_column_name(&column[i], name), iso_record_name(r, i + 1)) == 0;
        text += used;
    }
    return good && !*text;
}

static bool read_head(iso_sweep_reader *r)
{
    const iso_record *lines = iso_table_header(r->table);
    iso_sweep_head *h = &r->head;
    const char *hash = iso_record_get(lines, "hash"), *vectors = iso_record_get(lines, "vectors"),
               *text = iso_record_get(lines, ISO_TABLE_TEXT), *points = iso_record_get(lines, "points"),
               *chunk = iso_record_get(lines, "chunk"), *part = iso_record_get(lines, "part");
    h->version = iso_record_get(lines, "isoroll");
    h->text = text ? text : "";
    h->scene = iso_record_get(lines, "scene");
    r->shard = (iso_sweep_shard){0, 1};
    const bool whole = strcmp(iso_record_kind(lines), ISO_SWEEP_KIND) == 0;
    const bool named = whole
                           ? !part
                           : part && strcmp(iso_record_kind(lines), ISO_SWEEP_PART_KIND) == 0 &&
                                 (sscanf(part, "%zu of %zu", &r->shard.index, &r->shard.count) == 2 ||
                                  sscanf(part, "%zu %zu", &r->shard.index, &r->shard.count) == 2) && /* older HDF5 */
                                 r->shard.index-- > 0 &&
                                 r->shard.count > 1;
    return named && hash && strlen(hash) == 32 &&
           sscanf(hash, "%16" SCNx64 "%16" SCNx64, &h->hash[0], &h->hash[1]) == 2 && vectors &&
           snprintf(h->vectors, sizeof h->vectors, "%s", vectors) < ISO_NAME_SIZE && points &&
           sscanf(points, "%zu", &h->count) == 1 && chunk && sscanf(chunk, "%zu", &h->chunk) == 1 &&
           read_columns(lines, h);
}

/* --- the sum ---------------------------------------------------------------------------------------------------- */

static size_t count_lines(const iso_sweep_reader *r, const char **last)
{
    const char *value;
    size_t count = 0;
    while (iso_record_line(iso_table_header(r->table), count, last, &value)) count++;
    return count;
}

/* Nothing follows the last row but the sum. */
static iso_status check_sum(iso_context *ctx, const iso_sweep_reader *r)
{
    uint64_t sum;
    const char *last = "", *text;
    bool more;
    const iso_status status = iso_table_next(ctx, r->table, r->row, &more);
    const size_t behind = count_lines(r, &last) - r->lines;
    const bool ended = status == ISO_OK && !more && (behind == 0 || (behind == 1 && strcmp(last, "sum") == 0));
    text = iso_record_get(iso_table_header(r->table), "sum");
    if (!ended || !text || strlen(text) != 16 || sscanf(text, "%16" SCNx64, &sum) != 1)
        return damaged(ctx, r->path, "its end is missing, or there is more behind it");
    return sum == r->sum ? ISO_OK : damaged(ctx, r->path, "its rows were changed after it was written");
}

/* --- the file --------------------------------------------------------------------------------------------------- */

static iso_status open_table(iso_context *ctx, iso_sweep_reader *r)
{
    const iso_sweep_head *h = &r->head;
    const char *last;
    if (access(r->path, R_OK) != 0) return iso_file_trouble(ctx, "open", r->path);
    const iso_status status = iso_table_reader_open(ctx, r->path, NULL, NULL, &r->table);
    if (status == ISO_NO_MEMORY) return status;
    if (status == ISO_BAD_ARGUMENT) return damaged(ctx, r->path, "this build has no HDF5");
    if (status != ISO_OK)
        return ISO_FAIL_FILE(ctx, "cannot read '%s': it is no result of a sweep: %s", r->path,
                             iso_context_message(ctx));
    if (!read_head(r)) return damaged(ctx, r->path, "it is no result of a sweep");
    /* Numbers from outside: no sum or product of them may overflow, and no memory is asked for that no sweep needs. */
    if (h->count == 0 || h->count > (uint64_t)1 << 53 || h->chunk == 0 || h->chunk > MOST_CHUNK ||
        r->shard.count > ISO_SWEEP_MOST_SHARDS || r->shard.index >= r->shard.count)
        return damaged(ctx, r->path, "its head is damaged");
    if (!h->version || !iso_sweep_head_fits(h))
        return damaged(ctx, r->path,
                       "its texts or its head do not fit its hash: they were changed, or another version wrote them");
    r->table->forgets = true;
    r->row = calloc((size_t)h->columns + 3, sizeof *r->row);
    if (!r->row) return iso_context_no_memory(ctx, "'%s'", r->path);
    r->lines = count_lines(r, &last);
    r->points = iso_sweep_shard_points(h, r->shard);
    return r->points > 0 ? ISO_OK : check_sum(ctx, r);
}

iso_status iso_sweep_reader_open(iso_context *ctx, const char *path, iso_sweep_reader **reader)
{
    iso_sweep_reader *r = *reader = calloc(1, sizeof *r);
    if (!r) return iso_context_no_memory(ctx, "'%s'", path);
    r->path = path;
    const iso_status status = open_table(ctx, r);
    if (status != ISO_OK) iso_sweep_reader_close(r), *reader = NULL;
    return status;
}

void iso_sweep_reader_close(iso_sweep_reader *r)
{
    if (!r) return;
    iso_table_reader_close(r->table);
    free((void *)r->head.column);
    free(r->row);
    free(r);
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

iso_status iso_sweep_reader_rows(iso_context *ctx, iso_sweep_reader *r, iso_sweep_rows *rows)
{
    const size_t left = r->points - r->next, columns = (size_t)rows->columns;
    if (left == 0) return damaged(ctx, r->path, "it has no more rows");
    rows->first = iso_sweep_shard_point(&r->head, r->shard, r->next);
    rows->count = left < r->head.chunk ? left : r->head.chunk;
    for (size_t i = 0; i < rows->count; i++) {
        bool more;
        const iso_status status = iso_table_next(ctx, r->table, r->row, &more);
        if (status == ISO_NO_MEMORY) return status;
        bool good = status == ISO_OK && more && r->row[0] == (double)(rows->first + i); /* else it has been moved */
        if (good) {
            const char *reason = iso_record_word(iso_table_header(r->table), r->row[columns + 2]);
            memcpy(rows->number + i * columns, r->row + 1, columns * sizeof *r->row);
            rows->status[i] = (iso_status)r->row[columns + 1];
            snprintf(rows->reason[i], ISO_REASON_SIZE, "%s", reason);
            good = rows->status[i] != ISO_OK || !*reason;
        }
        if (!good) return damaged(ctx, r->path, "a row is missing, moved or damaged");
    }
    r->next += rows->count;
    r->sum = iso_sweep_sum(r->sum, rows);
    return r->unended || r->next < r->points ? ISO_OK : check_sum(ctx, r);
}

/* --- copies ------------------------------------------------------------------------------------------------------ */

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

iso_status iso_sweep_merge(iso_context *ctx, size_t count, const char *const parts[], const char *path,
                           iso_sweep_failures *failures)
{
    struct stat s;
    merger m = {.given = count};
    iso_status status = ISO_OK;
    *failures = (iso_sweep_failures){.count = 0};
    if (strcmp(path, "-") != 0 && stat(path, &s) == 0 && S_ISREG(s.st_mode))
        return ISO_FAIL_FILE(ctx, "'%s' is there: it is not overwritten", path);
    for (size_t i = 0; i < count && status == ISO_OK; i++) {
        iso_sweep_reader *r;
        status = iso_sweep_reader_open(ctx, parts[i], &r);
        if (!m.part) m.first = r;
        if (status == ISO_OK) status = check_part(ctx, &m, r);
        if (status == ISO_OK)
            m.part[r->shard.index] = r;
        else
            iso_sweep_reader_close(r);
    }
    for (size_t i = 0; i < m.count && status == ISO_OK; i++)
        if (!m.part[i]) status = ISO_FAIL_FILE(ctx, "part %zu of %zu is missing", i + 1, m.count);
    if (status == ISO_OK)
        status = iso_sweep_copy(ctx, m.part, m.count, (iso_sweep_shard){0, 1}, path, NULL, failures);
    for (size_t i = 0; i < m.count; i++) iso_sweep_reader_close(m.part[i]);
    free(m.part);
    return status;
}
