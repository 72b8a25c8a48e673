/* sweep_run.c - all chunks of a sweep on many threads: each takes a chunk, computes it, gives its rows away, and
 * takes the next. */
#include "base/arithmetic_impl.h"
#include "base/pool_impl.h"
#include "sweep/sweep_impl.h"

typedef struct work {
    iso_context *ctx; /* has the words of the first failure */
    const iso_sweep *sweep;
    const iso_sweep_source *source;
    pthread_mutex_t lock;
    bool ended;        /* there is no next chunk */
    iso_status status; /* the first failure */
} work;

static bool next_chunk(work *all, size_t *c)
{
    pthread_mutex_lock(&all->lock);
    all->ended = all->ended || all->status != ISO_OK || !all->source->next(all->source->data, c);
    const bool more = !all->ended;
    pthread_mutex_unlock(&all->lock);
    return more;
}

static void give_away(iso_pool_worker *w, work *all, size_t c, const iso_sweep_rows *rows, iso_status status)
{
    pthread_mutex_lock(&all->lock);
    if (status == ISO_OK && all->status == ISO_OK)
        all->status = all->source->take(all->source->data, all->ctx, c, rows);
    else if (status != ISO_STOPPED && all->status == ISO_OK)
        all->status =
            iso_context_fail(all->ctx, status, iso_context_about(w->ctx), "%s", iso_context_message(w->ctx));
    if (all->status != ISO_OK) atomic_store(&w->all->stopped, true);
    pthread_mutex_unlock(&all->lock);
}

/* The source says which chunk is the next one: the pool counts how many there can be. */
static bool solve(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    work *all = data;
    const iso_sweep_head *head = iso_sweep_head_of(all->sweep);
    iso_sweep_rows rows;
    size_t c;
    (void)first;
    (void)count;
    if (!next_chunk(all, &c)) return true;
    if (iso_sweep_rows_create(w->ctx, head->columns, head->chunk, &rows) != ISO_OK) return false;
    give_away(w, all, c, &rows,
              iso_sweep_compute_points(w->ctx, all->sweep, c * head->chunk, iso_sweep_chunk_points(head, c), &rows));
    iso_sweep_rows_free(&rows);
    return true;
}

iso_status iso_sweep_run(iso_context *ctx, const iso_sweep *sweep, int threads, const iso_sweep_source *source)
{
    ISO_DEFAULT_ARITHMETIC;
    const size_t chunks = iso_sweep_chunks(iso_sweep_head_of(sweep));
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
