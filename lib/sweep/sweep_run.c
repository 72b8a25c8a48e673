/* sweep_run.c - all chunks of a sweep on many threads: each takes a chunk, computes it, gives its rows away,
 * and takes the next. */
#include <pthread.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/monitor_impl.h"
#include "orbit/pool_impl.h"
#include "sweep/sweep_impl.h"

typedef struct crew crew;

typedef struct worker {
    crew *all;
    iso_context *ctx;
    iso_sweep_rows rows;
    pthread_t thread;
    bool asks; /* this thread may ask the caller's monitor */
} worker;

struct crew {
    iso_context *ctx; /* the caller's: for its thread, and for others inside the lock */
    const iso_sweep *sweep;
    const iso_sweep_source *source;
    pthread_mutex_t lock;
    atomic_bool stopped;
    iso_status status; /* the first failure */
};

/* Only the caller's thread asks its monitor. */
static bool goes_on(void *data)
{
    worker *w = data;
    if (w->asks && !iso_context_goes_on(w->all->ctx)) atomic_store(&w->all->stopped, true);
    return !atomic_load(&w->all->stopped);
}

static bool next_chunk(worker *w, size_t *c)
{
    crew *all = w->all;
    if (!goes_on(w)) return false;
    pthread_mutex_lock(&all->lock);
    const bool more = all->status == ISO_OK && all->source->next(all->source->data, c);
    pthread_mutex_unlock(&all->lock);
    return more;
}

/* The words of a failure go into the caller's context. */
static bool give_away(worker *w, size_t c, iso_status status)
{
    crew *all = w->all;
    pthread_mutex_lock(&all->lock);
    if (status == ISO_OK && all->status == ISO_OK)
        all->status = all->source->take(all->source->data, all->ctx, c, &w->rows);
    else if (status != ISO_STOPPED && all->status == ISO_OK)
        all->status =
            iso_context_fail(all->ctx, status, iso_context_about(w->ctx), "%s", iso_context_message(w->ctx));
    const bool good = all->status == ISO_OK;
    pthread_mutex_unlock(&all->lock);
    if (!good) atomic_store(&all->stopped, true);
    return good && status == ISO_OK;
}

static void *work(void *data)
{
    worker *w = data;
    size_t c;
    while (next_chunk(w, &c))
        if (!give_away(w, c, iso_sweep_compute(w->ctx, w->all->sweep, c, &w->rows))) break;
    return NULL;
}

static bool prepare(crew *all, worker *w, bool asks)
{
    const iso_sweep_head *head = iso_sweep_head_of(all->sweep);
    *w = (worker){.all = all, .ctx = iso_context_create(), .asks = asks};
    if (!w->ctx) return false;
    iso_context_set_monitor(w->ctx, goes_on, w);
    return iso_sweep_rows_create(w->ctx, head->columns, head->chunk, &w->rows) == ISO_OK;
}

static void release(worker *w)
{
    iso_sweep_rows_free(&w->rows);
    iso_context_free(w->ctx);
}

/* If a thread cannot be started, the others do its work. */
static void work_together(worker workers[], size_t count)
{
    size_t started = 1;
    while (started < count && pthread_create(&workers[started].thread, NULL, work, &workers[started]) == 0) started++;
    work(&workers[0]);
    for (size_t i = 1; i < started; i++) pthread_join(workers[i].thread, NULL);
}

iso_status iso_sweep_run(iso_context *ctx, const iso_sweep *sweep, int threads, const iso_sweep_source *source)
{
    ISO_DEFAULT_ARITHMETIC;
    crew all = {.ctx = ctx, .sweep = sweep, .source = source, .lock = PTHREAD_MUTEX_INITIALIZER};
    const size_t wanted = iso_pool_threads(threads, iso_sweep_chunks(iso_sweep_head_of(sweep)), 1);
    worker *workers = calloc(wanted, sizeof *workers);
    size_t ready = 0;
    while (workers && ready < wanted && prepare(&all, &workers[ready], ready == 0)) ready++;
    if (ready > 0) work_together(workers, ready);
    for (size_t i = 0; workers && i < wanted; i++) release(&workers[i]);
    free(workers);
    pthread_mutex_destroy(&all.lock);
    if (ready == 0) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    if (all.status == ISO_OK && atomic_load(&all.stopped))
        return iso_context_fail(ctx, ISO_STOPPED, "", "stopped on request");
    return all.status;
}
