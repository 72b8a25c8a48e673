/* pool_impl.h - threads that take pieces of work in chunks until all are taken, or the caller stops them. */
#ifndef ISO_BASE_POOL_IMPL_H
#define ISO_BASE_POOL_IMPL_H

#include <pthread.h>
#include <stdatomic.h>

#include "base/context.h"

enum { ISO_MOST_THREADS = 1024 };

typedef struct iso_pool iso_pool;

/* A thread. */
typedef struct iso_pool_worker {
    iso_pool *all;
    iso_context *ctx, *asks; /* its own; the caller's, if this thread may ask its monitor, else NULL */
    size_t failed;           /* the first of its pieces that failed, with its message; else all->count */
    char message[1024], about[32];
    void *room; /* of `solve`, which allocates it; it is freed in the end */
    pthread_t thread;
} iso_pool_worker;

/* What all threads share. */
struct iso_pool {
    size_t count, chunk; /* pieces, and how many a thread takes at a time: fewer, if there are not so many */
    const char *what;    /* the pieces are, in messages: "orbit" */
    bool (*solve)(iso_pool_worker *w, void *data, size_t first, size_t count); /* false: no memory */
    void *data;
    atomic_size_t next; /* the first piece that nobody has taken */
    atomic_bool stopped;
};

/* The number of threads that have work, if `threads` are asked for (0: as many as there are processors). */
size_t iso_pool_threads(int threads, size_t count, int lanes);

/* Solves all pieces on `threads` threads. Only the calling thread asks the monitor of ctx. Errors: ISO_NO_MEMORY;
 * ISO_STOPPED by the monitor; else the status of the first piece that failed (status[i]), with its number. status is
 * NULL if `solve` notes no failures (iso_pool_note). */
iso_status iso_pool_run(iso_context *ctx, iso_pool *pool, size_t threads, const iso_status status[]);

/* Keeps the first failure of a worker. The message is in w->ctx. */
void iso_pool_note(iso_pool_worker *w, size_t i, iso_status status);

/* Whether to go on. Asks the caller's monitor, if this worker may. It can be used as a monitor, with an
 * iso_pool_worker as its data. */
bool iso_pool_goes_on(void *worker);

#endif
