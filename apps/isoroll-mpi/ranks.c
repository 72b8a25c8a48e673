/* ranks.c - the ranks of MPI as the team of a sweep, and what they send to each other (see ranks.h). */
#define _GNU_SOURCE /* CPU_COUNT */
#include "ranks.h"

#include <limits.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "progress.h"
#include "sweep/sweep_store_impl.h"

enum { TAG = 18, WORDS = 1024 };

/* Stands before the rows of a chunk, or before the words of a failure. */
typedef struct message_head {
    uint64_t chunk;       /* UINT64_MAX: the rank has ended */
    int32_t status, stop; /* how it has ended; the signal that told it to, or 0 */
} message_head;

/* --- meeting ---------------------------------------------------------------------------------------------------- */

/* Sleeps: longer each time, up to a millisecond. *seconds begins as 0. */
static void pause_for(double *seconds)
{
    const double least = 2e-5, most = 1e-3;
    *seconds = *seconds < least ? least : 2 * *seconds < most ? 2 * *seconds : most;
    nanosleep(&(struct timespec){.tv_nsec = (long)(1e9 * *seconds)}, NULL);
}

/* Waits until a request is done; looks at it now and then. */
static void wait_for(MPI_Request *request)
{
    double pause = 0;
    int done;
    while (MPI_Test(request, &done, MPI_STATUS_IGNORE), !done) pause_for(&pause);
}

void ranks_meet(ranks *r)
{
    MPI_Request request;
    MPI_Ibarrier(r->comm, &request);
    wait_for(&request);
}

/* Rank 0 prints its own message at once. If it has none, the first rank with trouble prints its message. */
static int agree(void *data, int result)
{
    ranks *r = data;
    MPI_Request request;
    r->agreed = true;
    int mine[2] = {result, result == EXIT_DONE ? INT_MIN : -r->rank}, all[2];
    MPI_Iallreduce(mine, all, 2, MPI_INT, MPI_MAX, r->comm, &request);
    wait_for(&request);
    if (r->rank > 0 && all[1] == -r->rank) fprintf(stderr, "isoroll: rank %d: %s\n", r->rank, last_warning());
    return all[0];
}

/* Threads of this rank, so that all ranks of a machine use each of its processors once: one that n ranks may use
 * counts as 1/n for each. */
static int threads_of(const ranks *r)
{
    MPI_Comm machine;
    cpu_set_t mine, *all;
    int ranks_here;
    double share = 0;
    MPI_Comm_split_type(r->comm, MPI_COMM_TYPE_SHARED, r->rank, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &ranks_here);
    CPU_ZERO(&mine);
    sched_getaffinity(0, sizeof mine, &mine);
    all = calloc((size_t)ranks_here, sizeof mine);
    if (all) MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all, sizeof mine, MPI_BYTE, machine);
    for (size_t p = 0; all && p < CPU_SETSIZE; p++) {
        int users = 0;
        for (int i = 0; i < ranks_here; i++) users += CPU_ISSET(p, &all[i]) != 0;
        if (CPU_ISSET(p, &mine)) share += 1.0 / users;
    }
    free(all);
    MPI_Comm_free(&machine);
    return share > 1 ? (int)(share + 1e-6) : 1;
}

/* --- the counter ------------------------------------------------------------------------------------------------ */

static int64_t change_counter(ranks *r, int64_t by, MPI_Op how)
{
    int64_t old;
    MPI_Fetch_and_op(&by, &old, MPI_INT64_T, 0, 0, how, r->window);
    MPI_Win_flush(0, r->window);
    return old;
}

/* Nobody gets a further chunk. */
static void stop_all(ranks *r)
{
    change_counter(r, INT64_MAX / 2, MPI_REPLACE);
}

static bool fetch(void *data, size_t *c)
{
    ranks *r = data;
    pthread_mutex_lock(&r->lock);
    const double begun = wall_seconds();
    if (interrupted()) stop_all(r);
    const int64_t number = change_counter(r, 1, MPI_SUM);
    r->times[FETCHES]++;
    r->times[FETCH_SECONDS] += wall_seconds() - begun;
    pthread_mutex_unlock(&r->lock);
    if (number >= (int64_t)r->count) return false;
    *c = (size_t)(r->first + (uint64_t)number * r->step);
    return true;
}

/* --- messages to rank 0: the rows of chunks, and a last one when a rank ends ------------------------------------ */

/* Returns when rank 0 takes the message. Until then this rank must be inside MPI now and then. */
static void send(ranks *r, message_head head, size_t length)
{
    MPI_Request request;
    memcpy(r->bytes, &head, sizeof head);
    MPI_Issend(r->bytes, (int)(sizeof head + length), MPI_BYTE, 0, TAG, r->comm, &request);
    wait_for(&request);
}

/* Other ranks: send the rows of a chunk, as they are in memory; without the reasons if no point has failed. */
static void send_rows(ranks *r, size_t c, const iso_sweep_rows *rows)
{
    const double begun = wall_seconds();
    size_t length = (size_t)((char *)rows->reason - (char *)rows->number);
    for (size_t i = 0; i < rows->count; i++)
        if (rows->status[i] != ISO_OK) length = iso_sweep_rows_bytes(rows);
    memcpy(r->bytes + sizeof(message_head), rows->number, length);
    send(r, (message_head){.chunk = c}, length);
    r->times[SENDS]++;
    r->times[SEND_SECONDS] += wall_seconds() - begun;
}

/* Tells rank 0 that this rank has ended, and how. */
static void send_end(ranks *r, iso_status status, const char *words)
{
    const size_t length = strnlen(words, WORDS);
    const int stop = !interrupted() ? 0 : limit_is_near() ? SIGUSR1 : SIGINT;
    memcpy(r->bytes + sizeof(message_head), words, length);
    send(r, (message_head){.chunk = UINT64_MAX, .status = (int32_t)status, .stop = stop}, length);
}

static void note_failure(ranks *r, iso_status status)
{
    r->status = status;
    stop_all(r);
}

static void take_rows(ranks *r, int from, size_t c, size_t length)
{
    const iso_sweep_head *head = iso_sweep_head_of(r->sweep);
    if (r->status != ISO_OK) return; /* rows that come after a failure are thrown away */
    const size_t reasons = (size_t)((char *)r->rows.reason - (char *)r->rows.number),
                 all = iso_sweep_rows_bytes(&r->rows);
    iso_status status;
    if (c < iso_sweep_chunks(head) && (length == reasons || length == all)) {
        memset(r->rows.reason, 0, all - reasons);
        memcpy(r->rows.number, r->bytes + sizeof(message_head), length);
        r->rows.first = c * head->chunk;
        r->rows.count = iso_sweep_chunk_points(head, c);
        status = r->source->take(r->source->data, r->ctx, c, &r->rows);
    } else {
        status = iso_context_fail(r->ctx, ISO_NUMERICAL, "", "rank %d has sent a damaged chunk", from);
    }
    if (status != ISO_OK) note_failure(r, status);
}

/* A signal that another rank got counts as ours: all ranks end in the same way. */
static void take_end(ranks *r, int from, const message_head *head, size_t length)
{
    if (head->stop != 0 && !interrupted()) raise(head->stop);
    if (head->status == ISO_OK || r->status != ISO_OK) return;
    note_failure(r, iso_context_fail(r->ctx, (iso_status)head->status, "", "rank %d: %.*s", from, (int)length,
                                     (const char *)r->bytes + sizeof *head));
}

/* Takes a message if there is one. *left: ranks that have not ended. */
static bool take_message(ranks *r, int *left)
{
    MPI_Status about;
    message_head head;
    int there, length;
    MPI_Iprobe(MPI_ANY_SOURCE, TAG, r->comm, &there, &about);
    if (!there) return false;
    const double begun = wall_seconds();
    MPI_Get_count(&about, MPI_BYTE, &length);
    MPI_Recv(r->bytes, length, MPI_BYTE, about.MPI_SOURCE, TAG, r->comm, MPI_STATUS_IGNORE);
    memcpy(&head, r->bytes, sizeof head);
    const size_t rest = (size_t)length - sizeof head;
    if (head.chunk == UINT64_MAX)
        take_end(r, about.MPI_SOURCE, &head, rest), --*left;
    else
        take_rows(r, about.MPI_SOURCE, head.chunk, rest);
    r->times[WRITES]++;
    r->times[BYTES] += length;
    r->times[WRITE_SECONDS] += wall_seconds() - begun;
    return true;
}

/* Rank 0: takes messages until every other rank has ended. */
static void *listen_on(void *data)
{
    ranks *r = data;
    bool told = false;
    double pause = 0;
    for (int left = r->size - 1; left > 0;) {
        pthread_mutex_lock(&r->lock);
        const bool there = take_message(r, &left);
        if (interrupted() && !told) told = true, stop_all(r);
        pthread_mutex_unlock(&r->lock);
        if (there)
            pause = 0;
        else
            pause_for(&pause);
    }
    return NULL;
}

/* --- a run ------------------------------------------------------------------------------------------------------ */

static iso_status take(void *data, iso_context *ctx, size_t c, const iso_sweep_rows *rows)
{
    ranks *r = data;
    iso_status status = ISO_OK;
    pthread_mutex_lock(&r->lock);
    if (r->rank > 0)
        send_rows(r, c, rows);
    else if (r->status == ISO_OK)
        status = r->source->take(r->source->data, ctx, c, rows);
    if (status != ISO_OK) stop_all(r);
    pthread_mutex_unlock(&r->lock);
    return status;
}

static void no_memory(const ranks *r)
{
    fprintf(stderr, "isoroll: rank %d: no memory for a sweep\n", r->rank);
    MPI_Abort(r->comm, EXIT_NUMERICAL);
}

/* All ranks learn which chunks are missing; the second one gives the step. Returns whether they have the same sweep. */
static bool share_missing(ranks *r, const iso_sweep_source *source)
{
    const iso_sweep_head *head = iso_sweep_head_of(r->sweep);
    size_t c;
    for (; source && source->next(source->data, &c); r->count++) {
        if (r->count == 0) r->first = c;
        if (r->count == 1) r->step = c - r->first;
    }
    uint64_t begin[5] = {r->count, r->first, r->step, head->hash[0], head->hash[1]};
    MPI_Request request;
    MPI_Ibcast(begin, 5, MPI_UINT64_T, 0, r->comm, &request);
    wait_for(&request);
    r->count = begin[0];
    r->first = begin[1];
    r->step = begin[2];
    return begin[3] == head->hash[0] && begin[4] == head->hash[1];
}

static void open_counter(ranks *r)
{
    MPI_Win_allocate(r->rank == 0 ? sizeof *r->counter : 0, sizeof *r->counter, MPI_INFO_NULL, r->comm, &r->counter,
                     &r->window);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, r->window);
    if (r->rank == 0) {
        *r->counter = 0;
        MPI_Win_sync(r->window);
    }
    ranks_meet(r);
}

static iso_status compute(ranks *r, iso_context *ctx, int threads)
{
    const iso_sweep_source mine = {fetch, take, r};
    return r->count > 0 ? iso_sweep_run(ctx, r->sweep, threads, &mine) : ISO_OK;
}

static iso_status compute_and_write(ranks *r, iso_context *ctx, int threads)
{
    pthread_t listener;
    if (pthread_create(&listener, NULL, listen_on, r) != 0) no_memory(r);
    const iso_status status = compute(r, ctx, threads);
    if (status != ISO_OK) {
        pthread_mutex_lock(&r->lock);
        stop_all(r);
        pthread_mutex_unlock(&r->lock);
    }
    pthread_join(listener, NULL);
    if (status != ISO_OK || r->status == ISO_OK) return status;
    return iso_context_fail(ctx, r->status, iso_context_about(r->ctx), "%s", iso_context_message(r->ctx));
}

static double mean(double sum, double count)
{
    return count > 0 ? sum / count : 0;
}

/* For users who measure what MPI costs on their machines (lib/doc/clusters.md). */
static void print_times(ranks *r)
{
    MPI_Request request;
    double t[TIMES];
    MPI_Ireduce(r->times, t, TIMES, MPI_DOUBLE, MPI_SUM, 0, r->comm, &request);
    wait_for(&request);
    const char *wanted = getenv("ISOROLL_TIMES"); /* counts only if it is not empty */
    if (r->rank > 0 || !wanted || !*wanted) return;
    fprintf(stderr, "isoroll: %d ranks: %.0f fetches of %.2f us, %.0f messages sent in %.1f us, ", r->size,
            t[FETCHES], 1e6 * mean(t[FETCH_SECONDS], t[FETCHES]), t[SENDS], 1e6 * mean(t[SEND_SECONDS], t[SENDS]));
    fprintf(stderr, "%.0f received (%.0f bytes each) and written in %.1f us\n", t[WRITES], mean(t[BYTES], t[WRITES]),
            1e6 * mean(t[WRITE_SECONDS], t[WRITES]));
}

static iso_status prepare(ranks *r, iso_context *ctx)
{
    const iso_sweep_head *head = iso_sweep_head_of(r->sweep);
    const size_t rows = iso_sweep_rows_bytes(&(iso_sweep_rows){.columns = head->columns, .most = head->chunk});
    const size_t room = sizeof(message_head) + (rows > WORDS ? rows : WORDS);
    r->bytes = room < INT_MAX ? malloc(room) : NULL;
    r->ctx = iso_context_create();
    if (!r->bytes || !r->ctx) return iso_context_no_memory(ctx, "messages of a chunk");
    return r->rank > 0 ? ISO_OK : iso_sweep_rows_create(ctx, head->columns, head->chunk, &r->rows);
}

static iso_status run(void *data, iso_context *ctx, const iso_sweep *sweep, int threads,
                      const iso_sweep_source *source)
{
    ranks *r = data;
    r->sweep = sweep;
    r->source = source;
    if (prepare(r, ctx) != ISO_OK) no_memory(r);
    const bool same = share_missing(r, source);
    if (threads == 0) threads = threads_of(r);
    open_counter(r);
    iso_status status = ISO_OK;
    if (r->rank == 0) {
        status = compute_and_write(r, ctx, threads);
    } else {
        const iso_status mine = same ? compute(r, ctx, threads)
                                     : ISO_FAIL_ARGUMENT(ctx, "",
                                                         "this rank has another sweep than rank 0: the files or the "
                                                         "processors differ (for processors write 'vectors: avx2')");
        send_end(r, mine, mine == ISO_OK ? "" : iso_context_message(ctx));
    }
    ranks_meet(r);
    print_times(r);
    MPI_Win_unlock_all(r->window);
    MPI_Win_free(&r->window);
    iso_sweep_rows_free(&r->rows);
    iso_context_free(r->ctx);
    free(r->bytes);
    return status;
}

void ranks_begin(ranks *r)
{
    *r = (ranks){.comm = MPI_COMM_WORLD, .lock = PTHREAD_MUTEX_INITIALIZER};
    MPI_Comm_rank(r->comm, &r->rank);
    MPI_Comm_size(r->comm, &r->size);
    r->team = (sweep_team){r->size, r->rank == 0, agree, run, r};
}
