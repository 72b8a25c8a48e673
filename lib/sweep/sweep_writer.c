/* sweep_writer.c - results of sweeps are tables (io/table.h): what stands in their lines, columns and rows.
 *
 *     # isoroll sweep 1                                of a part: "sweep part"
 *     # hash: ...                                      and points, chunk, vectors, columns; of a part: part
 *     # | text of the sweep                            and "# scene | text of its scene"
 *     point,k,state_n1,...,status,reason
 *     # sum: ...
 *
 * The bytes of the file depend on nothing but what is in it.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/version.h"
#include "io/table_impl.h"
#include "sweep/sweep_store_impl.h"

struct iso_sweep_writer {
    iso_table_writer *table;
    iso_record *header;
    double *row;
};

static iso_status set_size(iso_context *ctx, iso_record *r, const char *key, size_t size)
{
    char text[32];
    snprintf(text, sizeof text, "%zu", size);
    return iso_record_set(ctx, r, key, text);
}

/* A text as its file has it; lines of CSV have an end each. */
static iso_status set_text(iso_context *ctx, iso_record *r, const char *key, const char *text, bool hdf5)
{
    const size_t length = strlen(text);
    if (hdf5 || length == 0 || text[length - 1] == '\n') return iso_record_set(ctx, r, key, length ? text : NULL);
    char *ended = malloc(length + 2);
    if (!ended) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    memcpy(ended, text, length);
    memcpy(ended + length, "\n", 2);
    const iso_status status = iso_record_set(ctx, r, key, ended);
    free(ended);
    return status;
}

static iso_status set_part(iso_context *ctx, iso_record *r, iso_sweep_shard share, bool hdf5)
{
    char text[64];
    if (iso_sweep_shard_is_all(share)) return ISO_OK;
    snprintf(text, sizeof text, hdf5 ? "%zu %zu" : "%zu of %zu", share.index + 1, share.count);
    return iso_record_set(ctx, r, "part", text);
}

static iso_status set_lines(iso_context *ctx, iso_record *r, const iso_sweep_head *head, iso_sweep_shard share,
                            bool hdf5)
{
    char hash[ISO_HASH_SIZE], *columns = iso_sweep_columns_print(head);
    if (!columns) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    iso_sweep_hash_print(hash, head->hash);
    iso_status status = iso_record_set(ctx, r, "isoroll", ISO_VERSION);
    if (status == ISO_OK) status = iso_record_set(ctx, r, "hash", hash);
    if (status == ISO_OK) status = set_size(ctx, r, "points", head->count);
    if (status == ISO_OK) status = set_size(ctx, r, "chunk", head->chunk);
    if (status == ISO_OK) status = iso_record_set(ctx, r, "vectors", head->vectors);
    if (status == ISO_OK) status = set_part(ctx, r, share, hdf5);
    if (status == ISO_OK) status = iso_record_set(ctx, r, "columns", columns);
    if (status == ISO_OK) status = set_text(ctx, r, ISO_TABLE_TEXT, head->text, hdf5);
    if (status == ISO_OK && head->scene) status = set_text(ctx, r, "scene", head->scene, hdf5);
    free(columns);
    return status;
}

/* point, what varies, what was measured, status, reason */
static iso_status make_header(iso_context *ctx, const iso_sweep_head *head, iso_record **r)
{
    const size_t columns = (size_t)head->columns;
    char(*text)[ISO_SWEEP_NAME] = calloc(columns + 1, sizeof *text);
    const char **name = calloc(columns + 3, sizeof *name);
    iso_status status = ISO_NO_MEMORY;
    if (text && name) {
        for (size_t i = 0; i < columns; i++) name[i + 1] = iso_sweep_column_name(&head->column[i], text[i]);
        name[0] = "point";
        name[columns + 1] = "status";
        name[columns + 2] = "reason";
        status = iso_record_create(ctx, columns + 3, name, r);
    } else
        iso_context_fail(ctx, status, "", "no memory for a sweep");
    if (status == ISO_OK) iso_record_set_words(*r, columns + 2);
    free(text);
    free(name);
    return status;
}

static iso_status begin(iso_context *ctx, const char *path, const iso_sweep_head *head, iso_sweep_shard share,
                        iso_sweep_writer *w)
{
    const bool all = iso_sweep_shard_is_all(share);
    w->row = calloc((size_t)head->columns + 3, sizeof *w->row);
    if (!w->row) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    iso_status status = make_header(ctx, head, &w->header);
    if (status == ISO_OK) status = set_lines(ctx, w->header, head, share, iso_table_is_hdf5(path));
    if (status == ISO_OK)
        status = iso_table_writer_open(ctx, path, all ? ISO_SWEEP_KIND : ISO_SWEEP_PART_KIND, &w->table);
    if (status != ISO_OK) return status;
    iso_table_writer_keep_others(w->table);
    iso_table_writer_expect(w->table, iso_sweep_shard_points(head, share));
    return iso_table_write_header(ctx, w->table, w->header);
}

iso_status iso_sweep_writer_open(iso_context *ctx, const char *path, const iso_sweep_head *head,
                                 iso_sweep_shard share, iso_sweep_writer **writer)
{
    *writer = NULL;
    iso_sweep_writer *w = calloc(1, sizeof *w);
    if (!w) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    const iso_status status = begin(ctx, path, head, share, w);
    if (status == ISO_OK)
        *writer = w;
    else
        iso_sweep_writer_close(ctx, w, NULL);
    return status;
}

iso_status iso_sweep_writer_rows(iso_context *ctx, iso_sweep_writer *w, const iso_sweep_rows *rows)
{
    iso_status status = ISO_OK;
    const size_t columns = (size_t)rows->columns;
    for (size_t i = 0; i < rows->count && status == ISO_OK; i++) {
        const double *number = rows->number + i * columns;
        const bool failed = rows->status[i] != ISO_OK;
        if (!iso_table_writer_waits(w->table)) iso_record_forget_words(w->header);
        w->row[0] = (double)(rows->first + i);
        for (size_t c = 0; c < columns; c++) w->row[c + 1] = isnan(number[c]) ? (double)NAN : number[c];
        w->row[columns + 1] = (double)rows->status[i];
        status = iso_record_intern(ctx, w->header, failed ? rows->reason[i] : "", &w->row[columns + 2]);
        if (status == ISO_OK) status = iso_table_write_row(ctx, w->table, w->row);
    }
    return status;
}

iso_status iso_sweep_writer_close(iso_context *ctx, iso_sweep_writer *w, const uint64_t *sum)
{
    char text[17];
    iso_status status = ISO_OK;
    if (sum) {
        snprintf(text, sizeof text, "%016" PRIx64, *sum);
        status = iso_table_write_line(ctx, w->table, "sum", text);
    }
    const iso_status closed = iso_table_writer_close(ctx, w->table, sum && status == ISO_OK);
    iso_record_free(w->header);
    free(w->row);
    free(w);
    return status == ISO_OK ? closed : status;
}
