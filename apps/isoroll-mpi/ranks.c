/* ranks.c - the ranks of MPI as the team of a sweep (see ranks.h). */
#define _GNU_SOURCE /* CPU_COUNT */
#include "ranks.h"

#include <limits.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "progress.h"

/* --- meeting ---------------------------------------------------------------------------------------------------- */

void ranks_meet(ranks *r)
{
    MPI_Request request;
    MPI_Ibarrier(r->comm, &request);
    ranks_wait(&request);
}

static void tell(ranks *r, void *numbers, size_t count)
{
    MPI_Request request;
    MPI_Ibcast(numbers, (int)count, MPI_UINT64_T, 0, r->comm, &request);
    ranks_wait(&request);
}

/* Rank 0 says its own words at once. If it has none, the first rank with trouble says its words. */
static int agree(void *data, int result)
{
    ranks *r = data;
    MPI_Request request;
    r->agreed = true;
    int mine[2] = {result, result == EXIT_DONE ? INT_MIN : -r->rank}, all[2];
    MPI_Iallreduce(mine, all, 2, MPI_INT, MPI_MAX, r->comm, &request);
    ranks_wait(&request);
    if (r->rank > 0 && all[1] == -r->rank) fprintf(stderr, "isoroll: rank %d: %s\n", r->rank, complaint());
    return all[0];
}

/* A processor that n ranks may use counts as 1/n for each. */
int ranks_threads(const ranks *r)
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

void ranks_stop(ranks *r)
{
    change_counter(r, INT64_MAX / 2, MPI_REPLACE);
}

/* The missing chunk of this number: in the last gap that begins with it or before it. */
static size_t chunk_of(const ranks *r, uint64_t number)
{
    size_t low = 0, high = r->gaps - 1;
    while (low < high) {
        const size_t middle = (low + high + 1) / 2;
        if (r->gap[middle].before > number)
            high = middle - 1;
        else
            low = middle;
    }
    return (size_t)(r->gap[low].first + (number - r->gap[low].before) * r->gap[low].step);
}

static bool fetch(void *data, size_t *c)
{
    ranks *r = data;
    pthread_mutex_lock(&r->lock);
    const double begun = wall_seconds();
    if (interrupted()) ranks_stop(r);
    const int64_t number = change_counter(r, 1, MPI_SUM);
    r->times[FETCHES]++;
    r->times[FETCH_SECONDS] += wall_seconds() - begun;
    pthread_mutex_unlock(&r->lock);
    if (number >= (int64_t)r->count) return false;
    *c = chunk_of(r, (uint64_t)number);
    return true;
}

static iso_status take(void *data, iso_context *ctx, size_t c, const iso_sweep_rows *rows)
{
    ranks *r = data;
    iso_status status = ISO_OK;
    pthread_mutex_lock(&r->lock);
    if (r->rank > 0)
        ranks_send(r, c, rows);
    else if (r->status == ISO_OK)
        status = r->source->take(r->source->data, ctx, c, rows);
    if (status != ISO_OK) ranks_stop(r);
    pthread_mutex_unlock(&r->lock);
    return status;
}

/* --- a run ------------------------------------------------------------------------------------------------------ */

static void no_memory(const ranks *r)
{
    fprintf(stderr, "isoroll: rank %d: no memory for a sweep\n", r->rank);
    MPI_Abort(r->comm, EXIT_NUMERICAL);
}

static void begin_gap(ranks *r, size_t c)
{
    if ((r->gaps & (r->gaps - 1)) == 0) { /* 0, 1, 2, 4, ... are full */
        missing *more = realloc(r->gap, (2 * r->gaps + 1) * sizeof *more);
        if (!more) no_memory(r);
        r->gap = more;
    }
    r->gap[r->gaps++] = (missing){c, 0, r->count};
}

/* The second chunk of a gap gives its step. */
static void list_missing(ranks *r, const iso_sweep_source *source)
{
    size_t c;
    for (; source->next(source->data, &c); r->count++) {
        missing *last = r->gaps > 0 ? &r->gap[r->gaps - 1] : NULL;
        const size_t length = last ? r->count - last->before : 0;
        if (length == 1) last->step = c - last->first;
        if (length == 0 || c != last->first + length * last->step) begin_gap(r, c);
    }
}

/* All ranks learn which chunks are missing. Gives whether they have the same sweep. */
static bool share_missing(ranks *r)
{
    enum { PIECE = 1 << 24, NUMBERS = sizeof(missing) / sizeof(uint64_t) };
    const iso_sweep_head *head = iso_sweep_head_of(r->sweep);
    uint64_t begin[4] = {r->count, head->hash[0], head->hash[1], r->gaps};
    tell(r, begin, 4);
    r->count = (size_t)begin[0];
    r->gaps = (size_t)begin[3];
    if (r->rank > 0) r->gap = calloc(r->gaps + 1, sizeof *r->gap);
    if (!r->gap && r->gaps > 0) no_memory(r);
    for (size_t at = 0; at < r->gaps; at += PIECE)
        tell(r, r->gap + at, NUMBERS * (r->gaps - at < PIECE ? r->gaps - at : PIECE));
    return begin[1] == head->hash[0] && begin[2] == head->hash[1];
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

static iso_status compute(ranks *r, iso_context *ctx, int threads, bool same)
{
    const iso_sweep_source mine = {fetch, take, r};
    if (!same)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "this rank has another sweep than rank 0: the files or the processors differ (for "
                                "processors write 'vectors: avx2')");
    return r->count > 0 ? iso_sweep_run(ctx, r->sweep, threads, &mine) : ISO_OK;
}

static iso_status compute_and_write(ranks *r, iso_context *ctx, int threads)
{
    pthread_t listener;
    if (pthread_create(&listener, NULL, ranks_listen, r) != 0) no_memory(r);
    const iso_status status = compute(r, ctx, threads, true);
    if (status != ISO_OK) {
        pthread_mutex_lock(&r->lock);
        ranks_stop(r);
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
    ranks_wait(&request);
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
    r->room = ranks_message_size(r->sweep);
    r->bytes = r->room < INT_MAX ? malloc(r->room) : NULL;
    r->ctx = iso_context_create();
    if (!r->bytes || !r->ctx) return iso_context_no_memory(ctx, "messages of a chunk");
    return r->rank > 0 ? ISO_OK : iso_sweep_rows_create(ctx, head->columns, head->chunk, &r->rows);
}

static void release(ranks *r)
{
    iso_sweep_rows_free(&r->rows);
    iso_context_free(r->ctx);
    free(r->bytes);
    free(r->gap);
}

static iso_status run(void *data, iso_context *ctx, const iso_sweep *sweep, int threads,
                      const iso_sweep_source *source)
{
    ranks *r = data;
    r->sweep = sweep;
    r->source = source;
    if (prepare(r, ctx) != ISO_OK) no_memory(r);
    if (source) list_missing(r, source);
    const bool same = share_missing(r);
    if (threads == 0) threads = ranks_threads(r);
    open_counter(r);
    iso_status status = ISO_OK;
    if (r->rank == 0) {
        status = compute_and_write(r, ctx, threads);
    } else {
        const iso_status mine = compute(r, ctx, threads, same);
        ranks_send_end(r, mine, mine == ISO_OK ? "" : iso_context_message(ctx));
    }
    ranks_meet(r);
    print_times(r);
    MPI_Win_unlock_all(r->window);
    MPI_Win_free(&r->window);
    release(r);
    return status;
}

void ranks_begin(ranks *r)
{
    *r = (ranks){.comm = MPI_COMM_WORLD, .lock = PTHREAD_MUTEX_INITIALIZER};
    MPI_Comm_rank(r->comm, &r->rank);
    MPI_Comm_size(r->comm, &r->size);
    r->team = (sweep_team){r->size, r->rank == 0, agree, run, r};
}
