/* messages.c - what ranks send to rank 0: the rows of chunks, and a last message when they end. */
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "sweep/sweep_store.h"
#include "progress.h"
#include "ranks.h"

enum { TAG = 18, WORDS = 1024 };
enum { GOES_ON, INTERRUPTED, LIMIT_IS_NEAR };

/* Stands before the rows of a chunk, or before the words of a failure. */
typedef struct message_head {
    uint64_t chunk;       /* UINT64_MAX: the rank has ended */
    int32_t status, stop; /* how it has ended; whether it was told to */
} message_head;

size_t ranks_message_size(const iso_sweep *sweep)
{
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    const iso_sweep_rows shape = {.columns = head->columns};
    const size_t rows = iso_sweep_rows_bytes(&shape, head->chunk);
    return sizeof(message_head) + (rows > WORDS ? rows : WORDS);
}

void ranks_pause(double *seconds)
{
    const double least = 2e-5, most = 1e-3;
    *seconds = *seconds < least ? least : 2 * *seconds < most ? 2 * *seconds : most;
    nanosleep(&(struct timespec){.tv_nsec = (long)(1e9 * *seconds)}, NULL);
}

void ranks_wait(MPI_Request *request)
{
    double pause = 0;
    int done;
    while (MPI_Test(request, &done, MPI_STATUS_IGNORE), !done) ranks_pause(&pause);
}

/* --- sending ---------------------------------------------------------------------------------------------------- */

/* Returns when rank 0 takes the message. Until then this rank must be inside MPI now and then. */
static void send(ranks *r, message_head head, size_t length)
{
    MPI_Request request;
    memcpy(r->bytes, &head, sizeof head);
    MPI_Issend(r->bytes, (int)(sizeof head + length), MPI_BYTE, 0, TAG, r->comm, &request);
    ranks_wait(&request);
}

void ranks_send(ranks *r, size_t c, const iso_sweep_rows *rows)
{
    const double begun = wall_seconds();
    send(r, (message_head){.chunk = c}, iso_sweep_rows_pack(rows, r->bytes + sizeof(message_head)));
    r->times[SENDS]++;
    r->times[SEND_SECONDS] += wall_seconds() - begun;
}

void ranks_send_end(ranks *r, iso_status status, const char *words)
{
    const size_t length = strnlen(words, WORDS);
    const int stop = !interrupted() ? GOES_ON : limit_is_near() ? LIMIT_IS_NEAR : INTERRUPTED;
    memcpy(r->bytes + sizeof(message_head), words, length);
    send(r, (message_head){.chunk = UINT64_MAX, .status = (int32_t)status, .stop = stop}, length);
}

/* --- taking ----------------------------------------------------------------------------------------------------- */

static void note_failure(ranks *r, iso_status status)
{
    r->status = status;
    ranks_stop(r);
}

static void take_rows(ranks *r, int from, size_t c, size_t length)
{
    const iso_sweep_head *head = iso_sweep_head_of(r->sweep);
    if (r->status != ISO_OK) return; /* rows that come after a failure are thrown away */
    const bool known = c < iso_sweep_chunks(head);
    r->rows.first = c * head->chunk;
    r->rows.count = known ? iso_sweep_chunk_points(head, c) : 0;
    iso_status status;
    if (known && iso_sweep_rows_unpack(r->bytes + sizeof(message_head), length, &r->rows))
        status = r->source->take(r->source->data, r->ctx, c, &r->rows);
    else
        status = iso_context_fail(r->ctx, ISO_NUMERICAL, "", "rank %d has sent a damaged chunk", from);
    if (status != ISO_OK) note_failure(r, status);
}

/* A signal that another rank got counts as ours: all ranks end in the same way. */
static void take_end(ranks *r, int from, const message_head *head, size_t length)
{
    if (head->stop != GOES_ON && !interrupted()) raise(head->stop == LIMIT_IS_NEAR ? SIGUSR1 : SIGINT);
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
    if (head.chunk == UINT64_MAX) {
        take_end(r, about.MPI_SOURCE, &head, rest);
        --*left;
    } else {
        take_rows(r, about.MPI_SOURCE, head.chunk, rest);
    }
    r->times[WRITES]++;
    r->times[BYTES] += length;
    r->times[WRITE_SECONDS] += wall_seconds() - begun;
    return true;
}

void *ranks_listen(void *data)
{
    ranks *r = data;
    bool told = false;
    double pause = 0;
    for (int left = r->size - 1; left > 0;) {
        pthread_mutex_lock(&r->lock);
        const bool there = take_message(r, &left);
        if (interrupted() && !told) told = true, ranks_stop(r);
        pthread_mutex_unlock(&r->lock);
        if (there)
            pause = 0;
        else
            ranks_pause(&pause);
    }
    return NULL;
}
