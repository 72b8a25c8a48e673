/* sweep_reader.c - reads results of sweeps (sweep_writer.c says what stands in them), and finds out damaged ones. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "io/replacement_impl.h"
#include "sweep/sweep_store_impl.h"

enum { MOST_CHUNK = 1 << 16, MOST_COLUMNS = 4096 }; /* of files; a sweep has 4096 at most, and about 1000 */

static iso_status damaged(iso_context *ctx, const char *path, const char *why)
{
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot read '%s': %s", path, why);
}

/* --- the head --------------------------------------------------------------------------------------------------- */

static bool take_size(const iso_record *r, const char *key, size_t *size)
{
    const char *text = iso_record_get(r, key);
    return text && sscanf(text, "%zu", size) == 1;
}

/* "1 of 3"; in HDF5 of older ones "1 3" */
static bool take_part(const iso_record *r, iso_sweep_shard *shard)
{
    const char *text = iso_record_get(r, "part");
    *shard = (iso_sweep_shard){0, 1};
    if (strcmp(iso_record_kind(r), ISO_SWEEP_KIND) == 0) return !text;
    if (!text || strcmp(iso_record_kind(r), ISO_SWEEP_PART_KIND) != 0) return false;
    if (sscanf(text, "%zu of %zu", &shard->index, &shard->count) != 2 &&
        sscanf(text, "%zu %zu", &shard->index, &shard->count) != 2)
        return false;
    return shard->index-- > 0 && shard->count > 1;
}

/* "vary/k chaos/verdict": all columns. NULL: no memory, or no such text. */
static iso_sweep_column *scan_columns(const char *text, int *count)
{
    *count = 1;
    for (const char *c = text; *c && *count <= MOST_COLUMNS; c++) *count += *c == ' ';
    if (*count > MOST_COLUMNS) return NULL;
    iso_sweep_column *columns = calloc((size_t)*count, sizeof *columns);
    for (int i = 0; columns && i < *count; i++) {
        int used = 0;
        if (sscanf(text, " %31[^/ ]/%63[^ ]%n", columns[i].group, columns[i].name, &used) != 2) {
            free(columns);
            return NULL;
        }
        text += used;
    }
    return columns;
}

/* The columns are those that the line "names" says, of older ones "columns". */
static bool take_columns(const iso_record *r, iso_sweep_head *h)
{
    char name[ISO_SWEEP_NAME];
    const char *text = iso_record_get(r, iso_record_get(r, "names") ? "names" : "columns");
    const iso_sweep_column *column = h->column = text ? scan_columns(text, &h->columns) : NULL;
    const size_t columns = column ? (size_t)h->columns : 0;
    bool good = columns > 0 && iso_record_columns(r) == columns + 3 && strcmp(iso_record_name(r, 0), "point") == 0 &&
                strcmp(iso_record_name(r, columns + 1), "status") == 0 && iso_record_has_words(r, columns + 2);
    for (size_t i = 0; good && i < columns; i++)
        good = strcmp(iso_sweep_column_name(&column[i], name), iso_record_name(r, i + 1)) == 0;
    return good;
}

static bool take_head(iso_sweep_reader *r)
{
    const iso_record *lines = iso_table_header(r->table);
    iso_sweep_head *h = &r->head;
    const char *hash = iso_record_get(lines, "hash"), *vectors = iso_record_get(lines, "vectors"),
               *text = iso_record_get(lines, ISO_TABLE_TEXT);
    h->version = iso_record_get(lines, "isoroll");
    h->text = text ? text : "";
    h->scene = iso_record_get(lines, "scene");
    return take_part(lines, &r->shard) && hash && strlen(hash) == 32 &&
           sscanf(hash, "%16" SCNx64 "%16" SCNx64, &h->hash[0], &h->hash[1]) == 2 && vectors &&
           snprintf(h->vectors, sizeof h->vectors, "%s", vectors) < ISO_NAME_SIZE &&
           take_size(lines, "points", &h->count) && take_size(lines, "chunk", &h->chunk) && take_columns(lines, h);
}

/* Numbers that cannot be: the file is damaged. They come from outside: no sum or product of them may overflow, and
 * no memory is asked for that a sweep does not need. */
static bool makes_sense(const iso_sweep_reader *r)
{
    const iso_sweep_head *h = &r->head;
    return h->count > 0 && h->count <= (uint64_t)1 << 53 && h->chunk > 0 && h->chunk <= MOST_CHUNK &&
           r->shard.count <= ISO_SWEEP_MOST_SHARDS && r->shard.index < r->shard.count;
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
    const char *last;
    if (access(r->path, R_OK) != 0) return iso_file_trouble(ctx, "open", r->path);
    const iso_status status = iso_table_reader_open(ctx, r->path, NULL, NULL, &r->table);
    if (status == ISO_NO_MEMORY) return status;
    if (status == ISO_BAD_ARGUMENT) return damaged(ctx, r->path, "this build has no HDF5");
    if (status != ISO_OK)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot read '%s': it is no result of a sweep: %s",
                                r->path, iso_context_message(ctx));
    if (!take_head(r)) return damaged(ctx, r->path, "it is no result of a sweep");
    if (!makes_sense(r)) return damaged(ctx, r->path, "its head is damaged");
    if (!r->head.version || !iso_sweep_head_fits(&r->head))
        return damaged(ctx, r->path,
                       "its texts or its head do not fit its hash: they were changed, or another version wrote them");
    r->table->forgets = true;
    r->row = calloc((size_t)r->head.columns + 3, sizeof *r->row);
    if (!r->row) return iso_context_no_memory(ctx, "'%s'", r->path);
    r->lines = count_lines(r, &last);
    r->points = iso_sweep_shard_points(&r->head, r->shard);
    return r->points > 0 ? ISO_OK : check_sum(ctx, r);
}

iso_status iso_sweep_reader_open(iso_context *ctx, const char *path, iso_sweep_reader **reader)
{
    *reader = NULL;
    iso_sweep_reader *r = calloc(1, sizeof *r);
    if (r) r->path = strdup(path);
    if (!r || !r->path) {
        free(r);
        return iso_context_no_memory(ctx, "'%s'", path);
    }
    const iso_status status = open_table(ctx, r);
    if (status != ISO_OK) iso_sweep_reader_close(r), r = NULL;
    *reader = r;
    return status;
}

void iso_sweep_reader_close(iso_sweep_reader *r)
{
    if (!r) return;
    iso_table_reader_close(r->table);
    free((void *)r->head.column);
    free(r->row);
    free(r->path);
    free(r);
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* The next row as row i. A row that says another number than that of its place has been moved. */
static bool take_row(iso_context *ctx, const iso_sweep_reader *r, iso_sweep_rows *rows, size_t i, iso_status *status)
{
    const size_t columns = (size_t)rows->columns;
    bool more;
    *status = iso_table_next(ctx, r->table, r->row, &more);
    if (*status != ISO_OK || !more || r->row[0] != (double)(rows->first + i)) return false;
    const char *reason = iso_record_word(iso_table_header(r->table), r->row[columns + 2]);
    memcpy(rows->number + i * columns, r->row + 1, columns * sizeof *r->row);
    rows->status[i] = (iso_status)r->row[columns + 1];
    snprintf(rows->reason[i], ISO_REASON_SIZE, "%s", reason);
    return rows->status[i] != ISO_OK || !*reason;
}

iso_status iso_sweep_reader_rows(iso_context *ctx, iso_sweep_reader *r, iso_sweep_rows *rows)
{
    iso_status status = ISO_OK;
    const size_t left = r->points - r->next;
    rows->first = left > 0 ? iso_sweep_shard_point(&r->head, r->shard, r->next) : 0;
    rows->count = left < r->head.chunk ? left : r->head.chunk;
    if (left == 0) return damaged(ctx, r->path, "it has no more rows");
    for (size_t i = 0; i < rows->count; i++)
        if (!take_row(ctx, r, rows, i, &status))
            return status == ISO_NO_MEMORY ? status : damaged(ctx, r->path, "a row is missing, moved or damaged");
    r->next += rows->count;
    r->sum = iso_sweep_sum(r->sum, rows);
    return r->unended || r->next < r->points ? ISO_OK : check_sum(ctx, r);
}
