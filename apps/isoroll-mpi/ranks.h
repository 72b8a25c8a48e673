/* ranks.h - the ranks of MPI as the team of a sweep.
 *
 * Rank 0 writes. It tells all ranks which chunks are missing. A counter in its memory says how many of them are
 * taken: each rank fetches the next number by one MPI_Fetch_and_op, which needs no help of rank 0 where the network
 * can do it. The rows of a chunk go to rank 0 as a message. A rank has one message on the way, so memory does not
 * grow. On rank 0 a thread of its own takes the messages; the other threads of rank 0 compute like all others.
 *
 * To stop, any rank sets the counter to a number that is too large. Nobody gets a further chunk then. */
#ifndef ISOROLL_RANKS_H
#define ISOROLL_RANKS_H

#include <mpi.h>
#include <pthread.h>

#include "sweep_team.h"

/* What MPI costs, for print_times: numbers of calls, their seconds, bytes. */
enum { FETCHES, FETCH_SECONDS, SENDS, SEND_SECONDS, WRITES, WRITE_SECONDS, BYTES, TIMES };

typedef struct ranks {
    MPI_Comm comm;
    int rank, size;
    bool agreed; /* at least once */
    sweep_team team;

    /* while it runs */
    pthread_mutex_t lock; /* one thread of this process at a time is inside MPI */
    MPI_Win window;
    int64_t *counter;            /* of rank 0: numbers taken */
    uint64_t count, first, step; /* chunks that are missing: first, first + step, ... */
    const iso_sweep *sweep;
    const iso_sweep_source *source; /* of rank 0 */
    unsigned char *bytes;           /* one message */
    iso_sweep_rows rows;            /* of rank 0: what came */
    iso_context *ctx;               /* of rank 0: the first failure of a rank, or of writing what came */
    iso_status status;
    double times[TIMES];
} ranks;

/* MPI must be initialised with MPI_THREAD_SERIALIZED at least. */
void ranks_begin(ranks *r);

/* Waits for all ranks without using the processor. */
void ranks_meet(ranks *r);

#endif
