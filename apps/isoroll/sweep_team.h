/* sweep_team.h - who computes the chunks of a sweep: this process alone, or this one as a member of a team.
 *
 * All members read the same sweep and run the same code. One of them writes: it has the result. */
#ifndef ISOROLL_SWEEP_TEAM_H
#define ISOROLL_SWEEP_TEAM_H

#include "report.h"
#include "sweep/sweep_impl.h"

typedef struct sweep_team {
    int members;
    bool writes; /* this member has the result */
    /* Every member calls it with its exit status. All get the same answer: the largest. */
    int (*agree)(void *data, int result);
    /* Computes all chunks that the source has; every member calls it. threads: 0 for all processors. The source is
     * that of the member that writes; NULL elsewhere. Errors: those of iso_sweep_run, told to the one that writes. */
    iso_status (*run)(void *data, iso_context *ctx, const iso_sweep *sweep, int threads,
                      const iso_sweep_source *source);
    void *data;
} sweep_team;

/* The command sweep as a member of a team; NULL: alone. `options` are those of command_sweep. */
int sweep_with(iso_context *ctx, const void *options, const sweep_team *team);

#endif
