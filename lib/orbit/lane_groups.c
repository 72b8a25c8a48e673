/* lane_groups.c - which orbits the lanes of vectors can follow, and which of them together (lane_groups_impl.h). */
#include "orbit/lane_groups_impl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"

bool iso_lanes_suit(const iso_orbit *orbit)
{
    char why[ISO_WHY_SIZE];
    return !orbit->rests && !iso_model_too_large(&orbit->model) &&
           iso_effects_stiffness(&orbit->model.problem) <= ISO_STIFF &&
           iso_method_serves(&iso_method_taylor, &orbit->model, why);
}

iso_status iso_lanes_failed(iso_context *ctx, const iso_lane_job *job, bool steps)
{
    char after[40] = "", blame[ISO_BLAME_SIZE];
    if (steps) snprintf(after, sizeof after, " after %ld steps", job->steps);
    iso_model_blame(job->model, job->last_y, blame);
    return ISO_FAIL_NUMERICAL(ctx, "taylor stopped%s: %s; last good %s = %s%s", after, job->error,
                              iso_clock_name(job->model->clock), ISO_SHORT(job->last * job->unit), blame);
}

iso_status iso_lanes_check(iso_context *ctx, int threads, const char *vectors, bool found)
{
    if (threads < 0 || threads > ISO_MOST_THREADS)
        return ISO_FAIL_ARGUMENT(ctx, "threads", "%d threads are not in [0, %d]", threads, ISO_MOST_THREADS);
    if (found) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "vectors", "this processor, or this build, has no vectors '%s'", vectors);
}

bool iso_lanes_in_groups(iso_pool_worker *w, const iso_lane_build *code, double tolerance, long max_steps,
                         iso_lane_job *jobs[], size_t count)
{
    const iso_lane_options lanes = {tolerance, max_steps, iso_pool_goes_on, w};
    iso_lane_job **other = malloc((count + 1) * sizeof *other);
    bool memory = other != NULL;
    while (memory && count > 0) {
        const iso_lane_job *a = jobs[0];
        size_t alike = 1, others = 0;
        for (size_t i = 1; i < count; i++)
            if (a->axis == jobs[i]->axis && !a->time == !jobs[i]->time && iso_lanes_alike(a->model, jobs[i]->model))
                jobs[alike++] = jobs[i];
            else
                other[others++] = jobs[i];
        if (!code->solve(jobs, alike, &lanes)) {
            memory = atomic_load(&w->all->stopped);
            break;
        }
        memcpy(jobs, other, others * sizeof *jobs);
        count = others;
    }
    free(other);
    return memory;
}
