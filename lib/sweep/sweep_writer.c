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
#define _GNU_SOURCE /* asprintf */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fold_impl.h"
#include "study/options_impl.h"
#include "sweep/sweep_store_impl.h"

/* --- shards, failures, names ------------------------------------------------------------------------------------- */

bool iso_sweep_shard_read(const char *text, iso_sweep_shard *shard)
{
    double i, n;
    char first[24];
    const char *slash = strchr(text, '/');
    snprintf(first, sizeof first, "%.*s", (int)strcspn(text, "/"), text);
    if (!slash || !iso_set_whole(&n, slash + 1) || !iso_set_whole(&i, first) || i < 1 || i > n) return false;
    *shard = (iso_sweep_shard){(size_t)i - 1, (size_t)n};
    return true;
}

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

/* A text of whole lines: the last one gets an end if its file has none. */
static iso_status set_text(iso_context *ctx, iso_record *r, const char *key, const char *text)
{
    char *whole;
    if (!text || !*text) return ISO_OK;
    if (asprintf(&whole, "%s%s", text, text[strlen(text) - 1] == '\n' ? "" : "\n") < 0)
        return iso_context_no_memory(ctx, "a sweep");
    const iso_status status = iso_record_set(ctx, r, key, whole);
    free(whole);
    return status;
}

static iso_status set_lines(iso_context *ctx, iso_record *r, const iso_sweep_head *head, iso_sweep_shard shard)
{
    char text[64];
    iso_memory memory;
    iso_record_set_kind(r, shard.count == 1 ? ISO_SWEEP_KIND : ISO_SWEEP_PART_KIND);
    ISO_TRY(iso_record_set(ctx, r, "isoroll", head->version));
    snprintf(text, sizeof text, "%016" PRIx64 "%016" PRIx64, head->hash[0], head->hash[1]);
    ISO_TRY(iso_record_set(ctx, r, "hash", text));
    snprintf(text, sizeof text, "%zu", head->count);
    ISO_TRY(iso_record_set(ctx, r, "points", text));
    snprintf(text, sizeof text, "%zu", head->chunk);
    ISO_TRY(iso_record_set(ctx, r, "chunk", text));
    ISO_TRY(iso_record_set(ctx, r, "vectors", head->vectors));
    snprintf(text, sizeof text, "%zu of %zu", shard.index + 1, shard.count);
    if (shard.count > 1) ISO_TRY(iso_record_set(ctx, r, "part", text));
    FILE *to = iso_memory_open(&memory);
    for (int i = 0; to && i < head->columns; i++) /* "vary/k chaos/verdict": all columns */
        fprintf(to, "%s%s/%s", i > 0 ? " " : "", head->column[i].group, head->column[i].name);
    char *names = iso_memory_close(to, &memory);
    const iso_status status = names ? iso_record_set(ctx, r, "names", names) : iso_context_no_memory(ctx, "a sweep");
    free(names);
    ISO_TRY(status);
    ISO_TRY(set_text(ctx, r, ISO_TABLE_TEXT, head->text));
    return set_text(ctx, r, "scene", head->scene);
}

/* point, what varies, what was measured, status, reason */
static iso_status make_columns(iso_context *ctx, const iso_sweep_head *head, iso_record **r)
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

/* --- rows --------------------------------------------------------------------------------------------------------- */

iso_status iso_sweep_writer_open(iso_context *ctx, const char *path, const iso_sweep_head *head,
                                 iso_sweep_shard shard, bool resumes, iso_sweep_writer *w)
{
    *w = (iso_sweep_writer){.row = calloc((size_t)head->columns + 3, sizeof *w->row)};
    if (!w->row) return iso_context_no_memory(ctx, "a sweep");
    ISO_TRY(make_columns(ctx, head, &w->table));
    ISO_TRY(set_lines(ctx, w->table, head, shard));
    if (!path) return ISO_OK;
    const char *kind = iso_record_kind(w->table);
    ISO_TRY(iso_table_writer_open_as(ctx, path, kind, resumes, &w->file));
    w->file->fresh = true;
    w->file->expected = iso_sweep_shard_points(head, shard);
    return resumes ? ISO_OK : iso_table_write_header(ctx, w->file, w->table);
}

iso_status iso_sweep_writer_rows(iso_context *ctx, iso_sweep_writer *w, const iso_sweep_rows *rows)
{
    const size_t columns = (size_t)rows->columns;
    for (size_t i = 0; i < rows->count; i++) {
        const double *number = rows->number + i * columns;
        if (w->file && !w->file->waits) iso_record_forget_words(w->table);
        w->row[0] = (double)(rows->first + i);
        for (size_t c = 0; c < columns; c++) w->row[c + 1] = isnan(number[c]) ? (double)NAN : number[c];
        w->row[columns + 1] = (double)rows->status[i];
        ISO_TRY(
            iso_record_intern(ctx, w->table, rows->status[i] != ISO_OK ? rows->reason[i] : "", &w->row[columns + 2]));
        ISO_TRY(w->file ? iso_table_write_row(ctx, w->file, w->row) : iso_record_add(ctx, w->table, 1, w->row));
    }
    w->sum = iso_sweep_sum(w->sum, rows);
    return ISO_OK;
}

iso_status iso_sweep_writer_end(iso_context *ctx, iso_sweep_writer *w)
{
    char text[17];
    snprintf(text, sizeof text, "%016" PRIx64, w->sum);
    return w->file ? iso_table_write_line(ctx, w->file, "sum", text) : iso_record_set(ctx, w->table, "sum", text);
}

iso_status iso_sweep_writer_close(iso_context *ctx, iso_sweep_writer *w, bool keep)
{
    const iso_status status = keep ? iso_sweep_writer_end(ctx, w) : ISO_OK;
    const iso_status closed = iso_table_writer_close(ctx, w->file, keep && status == ISO_OK);
    iso_record_free(w->table);
    free(w->row);
    *w = (iso_sweep_writer){.sum = 0};
    return status == ISO_OK ? closed : status;
}
