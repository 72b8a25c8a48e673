/* pool.c - threads: each takes a chunk of the work, solves it, and takes the next (pool_impl.h). */
#define _GNU_SOURCE /* CPU_COUNT, pthread_timedjoin_np */
#include "base/pool_impl.h"

#include <errno.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "base/context_impl.h"

void iso_pool_note(iso_pool_worker *w, size_t i, iso_status status)
{
    if (status == ISO_OK || i >= w->failed) return;
    w->failed = i;
    snprintf(w->message, sizeof w->message, "%s", iso_context_message(w->ctx));
    snprintf(w->about, sizeof w->about, "%s", iso_context_about(w->ctx));
}

bool iso_pool_goes_on(void *worker)
{
    iso_pool_worker *w = worker;
    if (w->asks && !iso_context_goes_on(w->asks)) atomic_store(&w->all->stopped, true);
    return !atomic_load(&w->all->stopped);
}

static void *work(void *worker)
{
    iso_pool_worker *w = worker;
    iso_pool *all = w->all;
    bool memory = true;
    while (memory && iso_pool_goes_on(w)) {
        const size_t first = atomic_fetch_add(&all->next, all->chunk);
        if (first >= all->count) break;
        memory = all->solve(w, all->data, first, all->count - first < all->chunk ? all->count - first : all->chunk);
    }
    return memory ? NULL : w;
}

/* Waits for a thread, and meanwhile asks the caller's monitor. */
static void *await(iso_pool_worker *asking, pthread_t thread)
{
    enum { SLICE = 20000000 }; /* nanoseconds */
    void *result = NULL;
    struct timespec until;
    do {
        iso_pool_goes_on(asking);
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += SLICE;
        if (until.tv_nsec >= 1000000000) until.tv_sec++, until.tv_nsec -= 1000000000;
    } while (pthread_timedjoin_np(thread, &result, &until) == ETIMEDOUT);
    return result;
}

size_t iso_pool_threads(int threads, size_t count, int lanes)
{
    cpu_set_t set; /* of processors that this process may use */
    const size_t most = count / (size_t)lanes + 1, asked = threads > 0 ? (size_t)threads
                                                           : sched_getaffinity(0, sizeof set, &set) == 0
                                                               ? (size_t)CPU_COUNT(&set)
                                                               : 1;
    return asked < most ? asked : most;
}

/* Starts threads beside this one, as many as can be had, and works with them. False: no memory. */
static bool work_together(iso_context *ctx, iso_pool *all, iso_pool_worker workers[], size_t threads)
{
    size_t started = 1;
    for (size_t i = 0; i < threads; i++) {
        workers[i] = (iso_pool_worker){
            .all = all, .ctx = iso_context_create(), .asks = i == 0 ? ctx : NULL, .failed = all->count};
        if (!workers[i].ctx)
            threads = i;
        else
            iso_context_set_monitor(workers[i].ctx, iso_pool_goes_on, &workers[i]);
    }
    if (threads == 0) return false;
    while (started < threads && pthread_create(&workers[started].thread, NULL, work, &workers[started]) == 0)
        started++;
    bool memory = work(&workers[0]) == NULL;
    for (size_t i = 1; i < started; i++) memory = await(&workers[0], workers[i].thread) == NULL && memory;
    return memory;
}

iso_status iso_pool_run(iso_context *ctx, iso_pool *all, size_t threads, const iso_status status[])
{
    if (all->count / threads < all->chunk) all->chunk = all->count / threads + 1;
    iso_pool_worker *workers = calloc(threads, sizeof *workers);
    const iso_pool_worker *first = workers;
    const bool memory = workers && work_together(ctx, all, workers, threads);
    iso_status answer = ISO_OK;
    for (size_t i = 0; workers && i < threads && workers[i].ctx; i++) {
        iso_context_free(workers[i].ctx);
        free(workers[i].room);
        if (workers[i].failed < first->failed) first = &workers[i];
    }
    if (!memory)
        answer = iso_context_no_memory(ctx, "%zu %ss", all->count, all->what);
    else if (atomic_load(&all->stopped))
        answer = iso_context_stopped(ctx);
    else if (first->failed < all->count)
        answer = iso_context_fail(ctx, status[first->failed], first->about, "%s %zu: %s", all->what, first->failed,
                                  first->message);
    free(workers);
    return answer;
}
