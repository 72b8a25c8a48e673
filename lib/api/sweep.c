/* sweep.c - a whole sweep, as a table; and what it would take, in words. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "api/interface_impl.h"
#include "base/record_impl.h"
#include "io/text_impl.h"
#include "sweep/sweep_impl.h"
#include "sweep/sweep_store_impl.h"

typedef struct keeper {
    const iso_sweep_head *head;
    iso_record *table;
    iso_sweep_queue queue;
    size_t chunks, next, taken, added; /* chunks: next to be computed; that were computed; in the table */
    uint64_t sum;                      /* of the rows of the table, in order */
    void (*progress)(void *data, double part);
    void *data;
} keeper;

static bool next_chunk(void *data, size_t *c)
{
    keeper *k = data;
    *c = k->next;
    return k->next++ < k->chunks;
}

/* Puts chunks that have waited into the table: those whose turn it is, or all. */
static iso_status add(iso_context *ctx, keeper *k, bool all)
{
    iso_sweep_rows rows;
    iso_status status = ISO_OK;
    while (status == ISO_OK && iso_sweep_queue_take(&k->queue, all ? SIZE_MAX : k->added * k->head->chunk, &rows)) {
        k->added++;
        k->sum = iso_sweep_sum(k->sum, &rows);
        status = iso_sweep_table_add(ctx, k->table, &rows);
        iso_sweep_rows_free(&rows);
    }
    return status;
}

static iso_status take_chunk(void *data, iso_context *ctx, size_t c, const iso_sweep_rows *rows)
{
    keeper *k = data;
    (void)c;
    iso_status status = iso_sweep_queue_add(ctx, &k->queue, rows);
    if (status == ISO_OK) status = add(ctx, k, false);
    if (k->progress) k->progress(k->data, (double)++k->taken / (double)k->chunks);
    return status;
}

/* Chunks behind one that is missing come into the table as well. */
static iso_status compute(iso_context *ctx, const iso_sweep *sweep, int threads, keeper *k)
{
    const iso_sweep_source source = {next_chunk, take_chunk, k};
    k->chunks = iso_sweep_chunks(k->head);
    const iso_status status = iso_sweep_run(ctx, sweep, threads, &source), added = add(ctx, k, true);
    iso_sweep_queue_free(&k->queue);
    return status == ISO_OK ? added : status;
}

static iso_status run(iso_context *ctx, const iso_sweep_file *file, int threads, keeper *k)
{
    iso_sweep *sweep;
    iso_status status = iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep);
    if (status != ISO_OK) return status;
    k->head = iso_sweep_head_of(sweep);
    status = iso_sweep_table(ctx, k->head, &k->table);
    if (status == ISO_OK) status = compute(ctx, sweep, threads, k);
    if (status == ISO_OK) status = iso_sweep_set_sum(ctx, k->table, k->sum); /* without it, it is no whole result */
    iso_sweep_free(sweep);
    return status;
}

iso_status iso_sweep_ask(iso_context *ctx, const char *path, const char *text, size_t length, int threads,
                         void (*progress)(void *data, double part), void *data, iso_record **record)
{
    keeper k = {.progress = progress, .data = data};
    iso_sweep_file *file;
    *record = NULL;
    iso_status status = text ? iso_sweep_parse(ctx, path, text, length, &file) : iso_sweep_read(ctx, path, &file);
    if (status != ISO_OK) return status;
    status = run(ctx, file, threads, &k);
    iso_sweep_file_free(file);
    if (status == ISO_OK || (k.table && iso_record_rows(k.table) > 0))
        *record = k.table;
    else
        iso_record_free(k.table);
    return status;
}

/* --- in words --------------------------------------------------------------------------------------------------- */

static iso_status explain(iso_context *ctx, const char *path, const char *text, size_t length, iso_record **record)
{
    iso_sweep_file *file;
    char *words;
    iso_status status = iso_sweep_parse(ctx, path, text, length, &file);
    if (status != ISO_OK) return status;
    status = iso_sweep_explain(ctx, file, &words);
    iso_sweep_file_free(file);
    if (status == ISO_OK) status = iso_record_create(ctx, 0, NULL, record);
    if (status == ISO_OK) {
        iso_record_set_kind(*record, "explain");
        iso_record_keep_text(*record, words);
        return ISO_OK;
    }
    free(words);
    iso_record_free(*record);
    *record = NULL;
    return status;
}

/* The text of a regular file; NULL: there is none that can be read. Who reads it next says why. */
static char *load(iso_context *ctx, const char *path, size_t *length)
{
    struct stat s;
    char *text;
    if (stat(path, &s) != 0 || !S_ISREG(s.st_mode)) return NULL;
    return iso_text_load(ctx, path, &text, length) == ISO_OK ? text : NULL;
}

iso_status iso_sweep_text(iso_context *ctx, const char *path, const char *text, size_t length, iso_record **record)
{
    *record = NULL;
    char *own = text ? NULL : load(ctx, path, &length);
    if (own) text = own;
    const bool is_sweep = text && iso_sweep_is_one(text, length);
    const iso_status status = is_sweep ? explain(ctx, path, text, length, record) : ISO_OK;
    free(own);
    return status;
}
