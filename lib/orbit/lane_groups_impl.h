/* lane_groups_impl.h - orbits in the lanes of vectors (method/taylor/lanes_impl.h), by the threads of
 * base/pool_impl.h. */
#ifndef ISO_ORBIT_LANE_GROUPS_IMPL_H
#define ISO_ORBIT_LANE_GROUPS_IMPL_H

#include "base/pool_impl.h"
#include "method/taylor/lanes_impl.h"
#include "orbit/orbit.h"

/* Refuses a number of threads, or vectors that were not found: ISO_BAD_ARGUMENT about "threads" or "vectors". */
iso_status iso_lanes_check(iso_context *ctx, int threads, const char *vectors, bool found);

/* Solves jobs in lanes, in groups of jobs that can share the lanes. Overwrites jobs[]. False: no memory. */
bool iso_lanes_in_groups(iso_pool_worker *w, const iso_lane_build *code, double tolerance, long max_steps,
                         iso_lane_job *jobs[], size_t count);

/* Whether lanes can follow an orbit. Lanes compute Taylor series, so the ball must move, must not be stiff, and must
 * have equations for series, within their room. */
bool iso_lanes_suit(const iso_orbit *orbit);

/* Fails with ISO_NUMERICAL for a job that has an error; steps: the message says after how many. */
iso_status iso_lanes_failed(iso_context *ctx, const iso_lane_job *job, bool steps);

#endif
