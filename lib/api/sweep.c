/* sweep.c - a whole sweep, as a table; and what it would take, as text. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "api/interface_impl.h"
#include "base/record_impl.h"
#include "io/text_impl.h"
#include "sweep/sweep_store_impl.h"

iso_status iso_sweep_ask(iso_context *ctx, const char *path, const char *text, size_t length, int threads,
                         void (*progress)(void *data, double part), void *data, iso_record **record)
{
    iso_sweep_file *file;
    iso_sweep *sweep = NULL;
    iso_sweep_store *store = NULL;
    *record = NULL;
    iso_status status = text ? iso_sweep_parse(ctx, path, text, length, &file) : iso_sweep_read(ctx, path, &file);
    if (status == ISO_OK) status = iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep);
    if (status == ISO_OK)
        status = iso_sweep_store_open(ctx, NULL, iso_sweep_head_of(sweep), (iso_sweep_shard){0, 1}, false, &store);
    if (store) {
        const iso_sweep_source source = iso_sweep_store_source(store);
        store->progress = progress;
        store->data = data;
        status = iso_sweep_run(ctx, sweep, threads, &source);
        const iso_status kept = iso_sweep_store_table(ctx, store, record); /* also the chunks before a failure */
        if (status == ISO_OK) status = kept;
    }
    iso_sweep_store_close(store);
    iso_sweep_free(sweep);
    iso_sweep_file_free(file);
    return status;
}

iso_status iso_sweep_text(iso_context *ctx, const char *path, const char *text, size_t length, iso_record **record)
{
    struct stat s;
    iso_sweep_file *file = NULL;
    char *loaded = NULL, *said = NULL;
    *record = NULL;
    if (!text) { /* who reads a file next says why it cannot be read */
        const bool regular = stat(path, &s) == 0 && S_ISREG(s.st_mode);
        if (!regular || iso_text_load(ctx, path, &loaded, &length) != ISO_OK) return ISO_OK;
    }
    if (loaded) text = loaded;
    iso_status status = ISO_OK;
    if (iso_sweep_is_one(text, length)) {
        status = iso_sweep_parse(ctx, path, text, length, &file);
        if (status == ISO_OK) status = iso_sweep_explain(ctx, file, &said);
        if (status == ISO_OK) status = iso_record_create(ctx, 0, NULL, record);
        if (status == ISO_OK)
            iso_record_set_kind(*record, "explain"), iso_record_keep_text(*record, said), said = NULL;
    }
    iso_sweep_file_free(file);
    free(loaded);
    free(said);
    return status;
}
