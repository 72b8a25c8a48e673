/* sweep_writer.c - results of sweeps are tables (io/table.h): what stands in their lines, columns and rows.
 *
 *     # isoroll sweep 1                                of a part: "sweep part"
 *     # hash: ...                                      and points, chunk, vectors, names; of a part: part
 *     # | text of the sweep                            and "# scene | text of its scene"
 *     point,k,state_n1,...,status,reason
 *     # sum: ...
 *
 * The bytes of the file depend on nothing but what is in it.
 */
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sweep/sweep_store_impl.h"

/* --- shards, failures, names ------------------------------------------------------------------------------------- */

size_t iso_sweep_shard_chunks(const iso_sweep_head *head, iso_sweep_shard shard)
{
    const size_t chunks = iso_sweep_chunks(head);
    return chunks > shard.index ? (chunks - shard.index - 1) / shard.count + 1 : 0;
}

size_t iso_sweep_shard_points(const iso_sweep_head *head, iso_sweep_shard shard)
{
    const size_t mine = iso_sweep_shard_chunks(head, shard);
    if (mine == 0) return 0;
    const size_t last = shard.index + (mine - 1) * shard.count;
    return (mine - 1) * head->chunk + iso_sweep_chunk_points(head, last);
}

/* All its chunks are full, but perhaps the last one. */
size_t iso_sweep_shard_point(const iso_sweep_head *head, iso_sweep_shard shard, size_t i)
{
    return (shard.index + i / head->chunk * shard.count) * head->chunk + i % head->chunk;
}

const char *iso_sweep_column_name(const iso_sweep_column *c, char name[ISO_SWEEP_NAME])
{
    const bool vary = strcmp(c->group, "vary") == 0;
    snprintf(name, ISO_SWEEP_NAME, "%s%s%s", vary ? "" : c->group, vary ? "" : "_", c->name);
    return name;
}

/* The failure of the lowest number counts as the first. */
void iso_sweep_failures_add(iso_sweep_failures *f, const iso_sweep_rows *rows)
{
    for (size_t i = 0; i < rows->count; i++) {
        if (rows->status[i] == ISO_OK) continue;
        if (f->count++ > 0 && f->first < rows->first + i) continue;
        f->first = rows->first + i;
        snprintf(f->reason, sizeof f->reason, "%s", rows->reason[i]);
    }
}

/* --- the header --------------------------------------------------------------------------------------------------- */

__attribute__((format(printf, 4, 5))) static iso_status set(iso_context *ctx, iso_record *r, const char *key,
                                                            const char *format, ...)
{
    char text[64];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return iso_record_set(ctx, r, key, text);
}

/* A text of whole lines: the last one gets an end if its file has none. */
static iso_status set_text(iso_context *ctx, iso_record *r, const char *key, const char *text)
{
    const size_t length = strlen(text);
    if (length == 0 || text[length - 1] == '\n') return iso_record_set(ctx, r, key, length ? text : NULL);
    char *ended = malloc(length + 2);
    if (!ended) return iso_context_no_memory(ctx, "a sweep");
    memcpy(ended, text, length);
    memcpy(ended + length, "\n", 2);
    const iso_status status = iso_record_set(ctx, r, key, ended);
    free(ended);
    return status;
}

/* "vary/k chaos/verdict": all columns, as text. NULL: no memory. */
static char *print_columns(const iso_sweep_head *head)
{
    char *text = malloc((size_t)(head->columns + 1) * (ISO_SWEEP_NAME + 1)), *at = text;
    if (!text) return NULL;
    *at = '\0';
    for (int i = 0; i < head->columns; i++)
        at += sprintf(at, "%s%s/%s", i > 0 ? " " : "", head->column[i].group, head->column[i].name);
    return text;
}

static iso_status set_lines(iso_context *ctx, iso_record *r, const iso_sweep_head *head, iso_sweep_shard shard)
{
    ISO_TRY(iso_record_set(ctx, r, "isoroll", head->version));
    ISO_TRY(set(ctx, r, "hash", "%016" PRIx64 "%016" PRIx64, head->hash[0], head->hash[1]));
    ISO_TRY(set(ctx, r, "points", "%zu", head->count));
    ISO_TRY(set(ctx, r, "chunk", "%zu", head->chunk));
    ISO_TRY(iso_record_set(ctx, r, "vectors", head->vectors));
    if (shard.count > 1) ISO_TRY(set(ctx, r, "part", "%zu of %zu", shard.index + 1, shard.count));
    char *columns = print_columns(head);
    const iso_status status =
        columns ? iso_record_set(ctx, r, "names", columns) : iso_context_no_memory(ctx, "a sweep");
    free(columns);
    ISO_TRY(status);
    ISO_TRY(set_text(ctx, r, ISO_TABLE_TEXT, head->text));
    return head->scene ? set_text(ctx, r, "scene", head->scene) : ISO_OK;
}

/* point, what varies, what was measured, status, reason */
static iso_status make_header(iso_context *ctx, const iso_sweep_head *head, iso_record **r)
{
    const size_t columns = (size_t)head->columns;
    char(*text)[ISO_SWEEP_NAME] = calloc(columns + 1, sizeof *text);
    const char **name = calloc(columns + 3, sizeof *name);
    const bool memory = text && name;
    if (memory) name[0] = "point", name[columns + 1] = "status", name[columns + 2] = "reason";
    for (size_t i = 0; memory && i < columns; i++) name[i + 1] = iso_sweep_column_name(&head->column[i], text[i]);
    const iso_status status =
        memory ? iso_record_create(ctx, columns + 3, name, r) : iso_context_no_memory(ctx, "a sweep");
    if (status == ISO_OK) iso_record_set_words(*r, columns + 2, true);
    free(text);
    free(name);
    return status;
}

/* Row i of a chunk as the table has it. */
static iso_status fill_row(iso_context *ctx, iso_record *table, const iso_sweep_rows *rows, size_t i, double row[])
{
    const size_t columns = (size_t)rows->columns;
    const double *number = rows->number + i * columns;
    row[0] = (double)(rows->first + i);
    for (size_t c = 0; c < columns; c++) row[c + 1] = isnan(number[c]) ? (double)NAN : number[c];
    row[columns + 1] = (double)rows->status[i];
    return iso_record_intern(ctx, table, rows->status[i] != ISO_OK ? rows->reason[i] : "", &row[columns + 2]);
}

iso_status iso_sweep_table(iso_context *ctx, const iso_sweep_head *head, iso_record **table)
{
    ISO_TRY(make_header(ctx, head, table));
    iso_record_set_kind(*table, ISO_SWEEP_KIND);
    return set_lines(ctx, *table, head, (iso_sweep_shard){0, 1});
}

iso_status iso_sweep_set_sum(iso_context *ctx, iso_record *table, uint64_t sum)
{
    return set(ctx, table, "sum", "%016" PRIx64, sum);
}

iso_status iso_sweep_table_add(iso_context *ctx, iso_record *table, const iso_sweep_rows *rows)
{
    iso_status status = ISO_OK;
    double *row;
    for (size_t i = 0; i < rows->count && status == ISO_OK; i++) {
        status = iso_record_append(ctx, table, &row);
        if (status == ISO_OK) status = fill_row(ctx, table, rows, i, row);
    }
    return status;
}

/* --- files ------------------------------------------------------------------------------------------------------ */

iso_status iso_sweep_writer_open(iso_context *ctx, const char *path, const iso_sweep_head *head,
                                 iso_sweep_shard shard, bool resumes, iso_sweep_writer *w)
{
    const char *kind = shard.count == 1 ? ISO_SWEEP_KIND : ISO_SWEEP_PART_KIND;
    *w = (iso_sweep_writer){.row = calloc((size_t)head->columns + 3, sizeof *w->row)};
    if (!w->row) return iso_context_no_memory(ctx, "a sweep");
    ISO_TRY(make_header(ctx, head, &w->header));
    ISO_TRY(set_lines(ctx, w->header, head, shard));
    ISO_TRY(iso_table_writer_open_as(ctx, path, kind, resumes, &w->table));
    w->table->fresh = true;
    w->table->expected = iso_sweep_shard_points(head, shard);
    return resumes ? ISO_OK : iso_table_write_header(ctx, w->table, w->header);
}

iso_status iso_sweep_writer_rows(iso_context *ctx, iso_sweep_writer *w, const iso_sweep_rows *rows)
{
    for (size_t i = 0; i < rows->count; i++) {
        if (!w->table->waits) iso_record_forget_words(w->header);
        ISO_TRY(fill_row(ctx, w->header, rows, i, w->row));
        ISO_TRY(iso_table_write_row(ctx, w->table, w->row));
    }
    w->sum = iso_sweep_sum(w->sum, rows);
    return ISO_OK;
}

iso_status iso_sweep_writer_end(iso_context *ctx, iso_sweep_writer *w)
{
    char text[17];
    snprintf(text, sizeof text, "%016" PRIx64, w->sum);
    return iso_table_write_line(ctx, w->table, "sum", text);
}

iso_status iso_sweep_writer_close(iso_context *ctx, iso_sweep_writer *w, bool keep)
{
    const iso_status status = keep ? iso_sweep_writer_end(ctx, w) : ISO_OK;
    const iso_status closed = iso_table_writer_close(ctx, w->table, keep && status == ISO_OK);
    iso_record_free(w->header);
    free(w->row);
    *w = (iso_sweep_writer){.sum = 0};
    return status == ISO_OK ? closed : status;
}
