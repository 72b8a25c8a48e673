/* pool_impl.h - threads that take orbits in chunks until all are taken, or the caller stops them. */
#ifndef ISO_ORBIT_POOL_IMPL_H
#define ISO_ORBIT_POOL_IMPL_H

#include <pthread.h>
#include <stdatomic.h>

#include "method/taylor/lanes_impl.h"
#include "orbit/orbit.h"

enum { ISO_MOST_THREADS = 1024 };

typedef struct iso_pool iso_pool;

/* A thread. */
typedef struct iso_pool_worker {
    iso_pool *all;
    iso_context *ctx, *asks; /* its own; the caller's, if this thread may ask its monitor, else NULL */
    size_t failed;           /* the first of its orbits that failed, with its message; else all->count */
    char message[1024], about[32];
    pthread_t thread;
} iso_pool_worker;

/* What all threads share. */
struct iso_pool {
    size_t count, chunk; /* orbits, and how many a thread takes at a time: fewer, if there are not so many */
    bool (*solve)(iso_pool_worker *w, void *data, size_t first, size_t count); /* false: no memory */
    void *data;
    atomic_size_t next; /* the first orbit that nobody has taken */
    atomic_bool stopped;
};

/* The number of threads that have work, if `threads` are asked for (0: as many as there are processors). */
size_t iso_pool_threads(int threads, size_t count, int lanes);

/* Solves all orbits on `threads` threads. Only the calling thread asks the monitor of ctx. Errors: ISO_NO_MEMORY;
 * ISO_STOPPED by the monitor; else the status of the first orbit that failed (status[i]), with its number. status is
 * NULL if `solve` notes no failures (iso_pool_note). */
iso_status iso_pool_run(iso_context *ctx, iso_pool *pool, size_t threads, const iso_status status[]);

/* Keeps the first failure of a worker. The message is in w->ctx. */
void iso_pool_note(iso_pool_worker *w, size_t i, iso_status status);

/* Whether to go on. Asks the caller's monitor, if this worker may. It can be used as a monitor, with an
 * iso_pool_worker as its data. */
bool iso_pool_goes_on(void *worker);

/* Solves jobs in lanes, in groups of jobs that can share the lanes. Overwrites jobs[]. False: no memory. */
bool iso_pool_in_groups(iso_pool_worker *w, const iso_lane_code *code, double tolerance, long max_steps,
                        iso_lane_job *jobs[], size_t count);

/* Whether lanes can follow an orbit. Lanes compute Taylor series, so the ball must move, must not be stiff, and must
 * have equations for series. */
bool iso_pool_suits(const iso_orbit *orbit);

#endif
