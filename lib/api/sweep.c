/* sweep.c - a whole sweep, as a table; and what it would take, as text. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "api/interface_impl.h"
#include "base/record_impl.h"
#include "io/text_impl.h"
#include "study/options_impl.h"
#include "sweep/sweep_store_impl.h"

typedef struct request {
    int threads;
    const char *output; /* NULL: to a table in memory */
    const char *shard;  /* NULL: the whole sweep      */
    bool resume;
} request;

ISO_STUDY_BEGIN(request, (request){.threads = 0})

static const iso_option options_of_sweep[] = {
    ISO_OPTION_THREADS(request, threads),
    ISO_OPTION("output", "FILE", "a file", "where rows go as they come: .csv or .h5", iso_set_text, request, output),
    ISO_OPTION("resume", NULL, NULL, "go on with what there is of this file", iso_set_flag, request, resume),
    ISO_OPTION("shard", "I/N", "i/n with 1 <= i <= n", "compute part i of n alone", iso_set_text, request, shard),
    ISO_OPTION_END,
};

/* Only its options are read. */
static const iso_study reading = {ISO_STUDY_AS("sweep", request, options_of_sweep, "")};

static iso_status open_store(iso_context *ctx, const request *r, const iso_sweep_head *head, iso_sweep_store **store)
{
    iso_sweep_shard shard = {0, 1};
    if ((r->resume || r->shard) && !r->output)
        return ISO_FAIL_ARGUMENT(ctx, "output",
                                 "sweep: resume and shard need an output, the file that they are about");
    if (r->shard && !iso_sweep_shard_read(r->shard, &shard))
        return ISO_FAIL_ARGUMENT(ctx, "shard", "shard '%s': expected i/n with 1 <= i <= n", r->shard);
    ISO_TRY(iso_sweep_store_open(ctx, r->output, head, shard, r->resume, store));
    if (!r->output || (*store)->part || (*store)->done == (*store)->wanted) return ISO_OK;
    iso_sweep_store_close(*store), *store = NULL;
    return ISO_FAIL_ARGUMENT(ctx, "output", "output '%s' is no regular file: rows could not be read again",
                             r->output);
}

/* The rows of a store; of a file, those of the whole file. */
static iso_status take_rows(iso_context *ctx, const request *r, iso_sweep_store *store, iso_status status,
                            iso_record **record)
{
    if (!r->output) {
        const iso_status kept = iso_sweep_store_table(ctx, store, record); /* also the chunks before a failure */
        return status == ISO_OK ? kept : status;
    }
    if (status == ISO_STOPPED && store->part)
        iso_context_fail(ctx, status, "", "%zu of %zu chunks are in '%s': go on with resume", store->done,
                         store->wanted, store->part);
    if (status == ISO_OK) status = iso_sweep_store_finish(ctx, store);
    return status == ISO_OK ? iso_sweep_read_table(ctx, r->output, record) : status;
}

iso_status iso_sweep_ask(iso_context *ctx, const char *path, const char *text, size_t length, const char *options,
                         void (*progress)(void *data, double part), void *data, iso_record **record)
{
    request r;
    iso_sweep_file *file = NULL;
    iso_sweep *sweep = NULL;
    iso_sweep_store *store = NULL;
    char *lines = strdup(options ? options : "");
    *record = NULL;
    iso_status status = lines ? iso_study_read(ctx, &reading, lines, &r) : iso_context_no_memory(ctx, "a sweep");
    if (status == ISO_OK)
        status = text ? iso_sweep_parse(ctx, path, text, length, &file) : iso_sweep_read(ctx, path, &file);
    if (status == ISO_OK) status = iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep);
    if (status == ISO_OK) status = open_store(ctx, &r, iso_sweep_head_of(sweep), &store);
    if (store) {
        const iso_sweep_source source = iso_sweep_store_source(store);
        store->progress = progress;
        store->data = data;
        status = take_rows(ctx, &r, store, iso_sweep_run(ctx, sweep, r.threads, &source), record);
    }
    iso_sweep_store_close(store);
    iso_sweep_free(sweep);
    iso_sweep_file_free(file);
    free(lines);
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
