/* sweep.c - a whole sweep, as a table; and what it would take, in words.
 *
 * Chunks end in any order; those that come early wait as bytes.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "api/foreign_impl.h"
#include "base/record_impl.h"
#include "io/text_impl.h"
#include "sweep/sweep_impl.h"
#include "sweep/sweep_store_impl.h"

typedef struct packed {
    unsigned char *bytes; /* NULL: not there, or in the table already */
    size_t length;
} packed;

typedef struct keeper {
    const iso_sweep_head *head;
    iso_record *table;
    iso_sweep_rows rows; /* room for a chunk */
    packed *chunk;
    /* next: to be computed; taken: were computed; added: looked at for the table */
    size_t chunks, next, taken, added;
    uint64_t sum; /* of the rows of the table, in order */
    void (*progress)(double part, void *data);
    void *data;
} keeper;

static bool next_chunk(void *data, size_t *c)
{
    keeper *k = data;
    *c = k->next;
    return k->next++ < k->chunks;
}

/* Puts the next chunk into the table, if it is there. */
static iso_status add(iso_context *ctx, keeper *k, size_t c)
{
    packed *p = &k->chunk[c];
    if (!p->bytes) return ISO_OK;
    k->rows.first = c * k->head->chunk;
    k->rows.count = iso_sweep_chunk_points(k->head, c);
    iso_sweep_rows_unpack(p->bytes, p->length, &k->rows); /* they are our own bytes */
    free(p->bytes);
    *p = (packed){NULL, 0};
    k->sum = iso_sweep_sum(k->sum, &k->rows);
    return iso_sweep_table_add(ctx, k->table, &k->rows);
}

static iso_status take_chunk(void *data, iso_context *ctx, size_t c, const iso_sweep_rows *rows)
{
    keeper *k = data;
    packed *p = &k->chunk[c];
    p->bytes = malloc(iso_sweep_rows_bytes(rows, rows->count) + 1);
    if (!p->bytes) return iso_context_no_memory(ctx, "the rows of a sweep");
    p->length = iso_sweep_rows_pack(rows, p->bytes);
    k->taken++;
    iso_status status = ISO_OK;
    while (status == ISO_OK && k->added < k->chunks && k->chunk[k->added].bytes) status = add(ctx, k, k->added++);
    if (k->progress) k->progress((double)k->taken / (double)k->chunks, k->data);
    return status;
}

/* Chunks behind one that is missing come into the table as well. */
static iso_status compute(iso_context *ctx, const iso_sweep *sweep, int threads, keeper *k)
{
    const iso_sweep_source source = {next_chunk, take_chunk, k};
    k->chunks = iso_sweep_chunks(k->head);
    k->chunk = calloc(k->chunks + 1, sizeof *k->chunk);
    if (!k->chunk) return iso_context_no_memory(ctx, "a sweep");
    const iso_status status = iso_sweep_run(ctx, sweep, threads, &source);
    iso_status added = ISO_OK;
    for (; added == ISO_OK && k->added < k->chunks; k->added++) added = add(ctx, k, k->added);
    for (size_t c = 0; c < k->chunks; c++) free(k->chunk[c].bytes);
    free(k->chunk);
    return status == ISO_OK ? added : status;
}

/* A file without the sum is no whole result. */
static iso_status set_sum(iso_context *ctx, const keeper *k)
{
    char text[17];
    snprintf(text, sizeof text, "%016" PRIx64, k->sum);
    return iso_record_set(ctx, k->table, "sum", text);
}

static iso_status run(iso_context *ctx, const iso_sweep_file *file, int threads, keeper *k)
{
    iso_sweep *sweep;
    iso_status status = iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep);
    if (status != ISO_OK) return status;
    k->head = iso_sweep_head_of(sweep);
    status = iso_sweep_rows_create(ctx, k->head->columns, k->head->chunk, &k->rows);
    if (status == ISO_OK) status = iso_sweep_table(ctx, k->head, &k->table);
    if (status == ISO_OK) status = compute(ctx, sweep, threads, k);
    if (status == ISO_OK) status = set_sum(ctx, k);
    iso_sweep_rows_free(&k->rows);
    iso_sweep_free(sweep);
    return status;
}

iso_status iso_foreign_sweep(iso_context *ctx, const char *path, const char *text, size_t length, int threads,
                             void (*progress)(double part, void *data), void *data, iso_record **record)
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
    if (status == ISO_OK) iso_record_set_kind(*record, "explain");
    if (status == ISO_OK) status = iso_record_set(ctx, *record, "text", words);
    free(words);
    if (status != ISO_OK) {
        iso_record_free(*record);
        *record = NULL;
    }
    return status;
}

/* The text of a regular file; NULL: there is none that can be read. Who reads it next says why. */
static char *load(iso_context *ctx, const char *path, size_t *length)
{
    struct stat s;
    char *text;
    if (stat(path, &s) != 0 || !S_ISREG(s.st_mode)) return NULL;
    return iso_text_load(ctx, path, ISO_LARGEST_TEXT, &text, length) == ISO_OK ? text : NULL;
}

iso_status iso_foreign_sweep_explain(iso_context *ctx, const char *path, const char *text, size_t length,
                                     iso_record **record)
{
    *record = NULL;
    char *own = text ? NULL : load(ctx, path, &length);
    if (own) text = own;
    const bool is_sweep = text && iso_sweep_is_one(text, length);
    const iso_status status = is_sweep ? explain(ctx, path, text, length, record) : ISO_OK;
    free(own);
    return status;
}
