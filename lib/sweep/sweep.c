/* sweep.c - the rows of a sweep: columns, chunks, points, what is noted of those that fail, and all chunks on many
 * threads (see sweep_impl.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/pool_impl.h"
#include "base/version.h"
#include "orbit/batch.h"
#include "orbit/lane_groups_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"
#include "sweep/sweep_impl.h"

struct iso_sweep {
    const iso_sweep_plan *plan;
    iso_sweep_head head;
    iso_sweep_job job[ISO_SWEEP_REQUESTS];
    iso_sweep_column *column;
};

/* One block: numbers, statuses, reasons. */
iso_status iso_sweep_rows_create(iso_context *ctx, int columns, size_t most, iso_sweep_rows *rows)
{
    *rows = (iso_sweep_rows){.columns = columns, .most = most};
    rows->number = calloc(1, iso_sweep_rows_bytes(rows) + 1);
    if (!rows->number) return iso_context_no_memory(ctx, "the rows of %zu points", most);
    rows->status = (iso_status *)(void *)(rows->number + most * (size_t)columns);
    rows->reason = (char(*)[ISO_REASON_SIZE])(void *)(rows->status + most);
    return ISO_OK;
}

size_t iso_sweep_rows_bytes(const iso_sweep_rows *rows)
{
    return rows->most * ((size_t)rows->columns * sizeof *rows->number + sizeof *rows->status + sizeof *rows->reason);
}

void iso_sweep_rows_free(iso_sweep_rows *rows)
{
    free(rows->number);
    *rows = (iso_sweep_rows){.columns = 0};
}

size_t iso_sweep_chunks(const iso_sweep_head *head)
{
    return head->count / head->chunk + (head->count % head->chunk > 0);
}

size_t iso_sweep_chunk_points(const iso_sweep_head *head, size_t c)
{
    const size_t first = c * head->chunk;
    return head->count - first < head->chunk ? head->count - first : head->chunk;
}

/* --- failures --------------------------------------------------------------------------------------------------- */

iso_status iso_sweep_note(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *batch, size_t i,
                          iso_status status)
{
    iso_sweep_rows *rows = batch->rows;
    if (status == ISO_STOPPED || status == ISO_NO_MEMORY) return status;
    if (status == ISO_OK || rows->status[i] != ISO_OK) return ISO_OK;
    rows->status[i] = status;
    snprintf(rows->reason[i], sizeof rows->reason[i], "%s%s%s", job ? job->quantity.name : "", job ? ": " : "",
             iso_context_message(ctx));
    for (char *c = rows->reason[i]; *c; c++)
        if (*c == '"' || (unsigned char)*c < ' ') *c = '\'';
    return ISO_OK;
}

/* --- columns ---------------------------------------------------------------------------------------------------- */

/* The columns of what varies, and those of each quantity. */
static iso_status make_columns(iso_context *ctx, iso_sweep *s)
{
    const iso_family *f = &s->plan->family;
    s->head.column = s->column;
    for (int c = 0; c < f->columns; c++) {
        strcpy(s->column[c].group, "vary");
        strcpy(s->column[c].name, f->name[c]);
    }
    s->head.columns = f->columns;
    for (int i = 0; i < s->plan->requests; i++) {
        iso_sweep_job *job = &s->job[i];
        *job = (iso_sweep_job){.vectors = s->head.vectors, .first = s->head.columns};
        job->column = s->column + s->head.columns;
        ISO_TRY(iso_sweep_job_begin(ctx, s->plan, &s->plan->request[i], job));
        s->head.columns += job->count;
    }
    return ISO_OK;
}

/* The size that the quantities suggest. A sweep of few points gets smaller chunks, so that every thread has some.
 * Multiples of 8 fill the lanes of vectors. */
static size_t chunk_of(const iso_sweep *s)
{
    enum { CHUNKS = 64, LANES = 8 };
    size_t chunk = s->plan->family.count / CHUNKS + 1;
    if (chunk > LANES / 2) chunk = (chunk + LANES - 1) / LANES * LANES;
    for (const iso_sweep_job *job = s->job; job < s->job + s->plan->requests; job++) {
        const size_t fits = job->quantity.chunk ? job->quantity.chunk(job) : job->quantity.points;
        if (fits < chunk) chunk = fits;
    }
    return chunk;
}

/* The vectors of this processor that are asked for; "": the widest. NULL: it has none of them. */
static const char *find_vectors(const char *asked)
{
    const char *kind;
    int i = 0;
    while ((kind = iso_batch_vectors(i++, NULL)) != NULL && *asked && strcmp(asked, kind) != 0) continue;
    return kind;
}

iso_status iso_sweep_create(iso_context *ctx, const iso_sweep_plan *plan, iso_sweep **sweep)
{
    ISO_DEFAULT_ARITHMETIC;
    const char *vectors = find_vectors(plan->vectors);
    *sweep = NULL;
    ISO_TRY(iso_lanes_check(ctx, 0, plan->vectors, vectors != NULL));
    iso_sweep *s = calloc(1, sizeof *s);
    if (!s) return iso_context_no_memory(ctx, "a sweep");
    s->plan = plan;
    snprintf(s->head.vectors, sizeof s->head.vectors, "%s", vectors);
    s->column = calloc((size_t)plan->family.columns + ISO_SWEEP_REQUESTS * ISO_SWEEP_NUMBERS, sizeof *s->column);
    const iso_status status = s->column ? make_columns(ctx, s) : iso_context_no_memory(ctx, "a sweep");
    if (status != ISO_OK) return iso_sweep_free(s), status;
    iso_sweep_head *h = &s->head;
    h->count = plan->family.count;
    h->chunk = plan->chunk > 0 ? plan->chunk : chunk_of(s);
    h->version = ISO_VERSION;
    h->text = plan->text ? plan->text : "";
    h->scene = plan->scene;
    memcpy(h->hash, plan->hash, sizeof h->hash);
    iso_sweep_hash_head(h->hash, h, find_vectors("avx2") != NULL, false); /* an orbit that is alone takes these */
    *sweep = s;
    return ISO_OK;
}

void iso_sweep_free(iso_sweep *s)
{
    if (!s) return;
    for (int i = 0; i < s->plan->requests; i++) iso_sweep_job_end(&s->job[i]);
    free(s->column);
    free(s);
}

const iso_sweep_head *iso_sweep_head_of(const iso_sweep *s)
{
    return &s->head;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

iso_status iso_sweep_compute_points(iso_context *ctx, const iso_sweep *s, size_t first, size_t count,
                                    iso_sweep_rows *rows)
{
    ISO_DEFAULT_ARITHMETIC;
    const iso_family *f = &s->plan->family;
    iso_sweep_batch b = {.count = count, .rows = rows};
    rows->first = first;
    rows->count = count;
    b.room = malloc((count + 1) * sizeof *b.room);
    b.scene = malloc((count + 1) * sizeof *b.scene);
    iso_status status = b.room && b.scene ? ISO_OK : iso_context_no_memory(ctx, "%zu points", count);
    for (size_t i = 0; i < count && status == ISO_OK; i++) { /* a point without a scene is a failed row */
        double *row = rows->number + i * (size_t)rows->columns;
        for (int c = 0; c < rows->columns; c++) row[c] = NAN;
        rows->status[i] = ISO_OK;
        rows->reason[i][0] = '\0';
        status = iso_sweep_note(ctx, NULL, &b, i, f->scene(ctx, f->data, first + i, &b.room[i], row));
        b.scene[i] = rows->status[i] == ISO_OK ? &b.room[i] : NULL;
    }
    for (const iso_sweep_job *job = s->job; job < s->job + s->plan->requests && status == ISO_OK; job++)
        status = iso_sweep_measure(ctx, job, &b);
    free(b.room);
    free(b.scene);
    return status;
}

/* --- all chunks ------------------------------------------------------------------------------------------------- */

typedef struct work {
    iso_context *ctx; /* has the words of the first failure */
    const iso_sweep *sweep;
    const iso_sweep_source *source;
    pthread_mutex_t lock;
    bool ended;        /* there is no next chunk */
    iso_status status; /* the first failure */
} work;

/* The source says which chunk is the next one: the pool counts how many there can be. */
static bool solve(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    work *all = data;
    const iso_sweep_head *head = iso_sweep_head_of(all->sweep);
    iso_sweep_rows rows;
    size_t c;
    (void)first, (void)count;
    pthread_mutex_lock(&all->lock);
    all->ended = all->ended || all->status != ISO_OK || !all->source->next(all->source->data, &c);
    const bool ended = all->ended;
    pthread_mutex_unlock(&all->lock);
    if (ended) return true;
    if (iso_sweep_rows_create(w->ctx, head->columns, head->chunk, &rows) != ISO_OK) return false;
    const iso_status status =
        iso_sweep_compute_points(w->ctx, all->sweep, c * head->chunk, iso_sweep_chunk_points(head, c), &rows);
    pthread_mutex_lock(&all->lock);
    if (status == ISO_OK && all->status == ISO_OK)
        all->status = all->source->take(all->source->data, all->ctx, c, &rows);
    else if (status != ISO_STOPPED && all->status == ISO_OK)
        all->status =
            iso_context_fail(all->ctx, status, iso_context_about(w->ctx), "%s", iso_context_message(w->ctx));
    if (all->status != ISO_OK) atomic_store(&w->all->stopped, true);
    pthread_mutex_unlock(&all->lock);
    iso_sweep_rows_free(&rows);
    return true;
}

iso_status iso_sweep_run(iso_context *ctx, const iso_sweep *sweep, int threads, const iso_sweep_source *source)
{
    ISO_DEFAULT_ARITHMETIC;
    const size_t chunks = iso_sweep_chunks(iso_sweep_head_of(sweep));
    if (threads > ISO_MOST_THREADS) threads = ISO_MOST_THREADS;
    work all = {.ctx = iso_context_create(), .sweep = sweep, .source = source, .lock = PTHREAD_MUTEX_INITIALIZER};
    iso_pool pool = {.what = "chunk", .count = chunks, .chunk = 1, .solve = solve, .data = &all};
    iso_status status = all.ctx ? iso_pool_run(ctx, &pool, iso_pool_threads(threads, chunks, 1), NULL)
                                : iso_context_no_memory(ctx, "a sweep");
    if (all.status != ISO_OK)
        status = iso_context_fail(ctx, all.status, iso_context_about(all.ctx), "%s", iso_context_message(all.ctx));
    iso_context_free(all.ctx);
    pthread_mutex_destroy(&all.lock);
    return status;
}
