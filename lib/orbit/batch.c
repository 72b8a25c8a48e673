/* batch.c - many orbits at once: threads take orbits in chunks, and solve a chunk in the lanes of vectors. */
#include "orbit/batch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/options_impl.h"
#include "method/integrator_impl.h"
#include "orbit/orbit_impl.h"
#include "orbit/pool_impl.h"

/* Orbits that a thread takes at a time: enough to keep its lanes busy to the end. */
enum { CHUNK = 256 };

/* What all threads share. */
typedef struct batch {
    const iso_batch_orbit *orbits;
    size_t rows;
    const iso_batch_options *options;
    const double *times;
    iso_sample *samples;
    iso_status *status;
    const iso_lane_code *code;
} batch;

/* An orbit of a chunk: prepared, then solved by one of its lanes. */
typedef struct member {
    iso_orbit orbit;
    iso_lane_job job;
} member;

_Static_assert((int)ISO_MAX_STATE <= (int)ISO_TRAJECTORY_COLUMNS, "a sample has room for a state");

const char *iso_batch_vectors(int i, int *lanes)
{
    for (const iso_lane_code *const *code = iso_lane_codes; *code; code++) {
        if (!(*code)->runs_here() || i-- > 0) continue;
        if (lanes) *lanes = (*code)->lanes;
        return (*code)->name;
    }
    return NULL;
}

/* --- one orbit -------------------------------------------------------------------------------------------------- */

static void note(iso_pool_worker *w, const batch *b, size_t i, iso_status status)
{
    b->status[i] = status;
    iso_pool_note(w, i, status);
}

static iso_orbit_options options_of(const batch *b, size_t i, iso_backend backend)
{
    const iso_batch_options *o = b->options;
    return (iso_orbit_options){.effects = b->orbits[i].effects,
                               .backend = backend,
                               .tolerance = o->tolerance,
                               .max_steps = o->max_steps,
                               .clock = o->clock,
                               .shown = o->shown,
                               .with_clock = {o->with_clock[0], o->with_clock[1], o->with_clock[2]}};
}

static iso_status prepare(iso_pool_worker *w, const batch *b, size_t i, member *m)
{
    const iso_batch_orbit *orbit = &b->orbits[i];
    const iso_backend asked = b->options->backend;
    iso_way way = iso_way_first(orbit->params, asked, asked, false);
    iso_status status;
    do {
        memset(&m->orbit, 0, sizeof m->orbit);
        m->orbit.ctx = w->ctx;
        m->orbit.options = options_of(b, i, way.backend);
        status = iso_orbit_prepare(&m->orbit, orbit->params, orbit->start, m->job.start);
    } while (iso_way_next(&way, status));
    return status == ISO_OK && b->rows > 0 ? iso_orbit_check_time(&m->orbit, b->times[b->rows - 1]) : status;
}

/* Follows an orbit alone, if lanes cannot hold it (iso_pool_suits). */
static iso_status solve_alone(iso_pool_worker *w, const batch *b, size_t i)
{
    const iso_orbit_options options = options_of(b, i, b->options->backend);
    iso_orbit *orbit;
    iso_status status = iso_orbit_create(w->ctx, b->orbits[i].params, b->orbits[i].start, &options, &orbit);
    for (size_t j = 0; j < b->rows && status == ISO_OK; j++) {
        iso_sample *sample = &b->samples[i * b->rows + j];
        status = iso_orbit_at(orbit, b->times[j], sample);
        if (status != ISO_OK) iso_sample_blank(sample);
    }
    iso_orbit_free(orbit);
    return status;
}

/* --- a chunk of them -------------------------------------------------------------------------------------------- */

/* The samples of what a lane has reached: each stands where its state did. */
static iso_status finish(iso_pool_worker *w, const batch *b, size_t i, const member *m)
{
    const iso_lane_job *job = &m->job;
    if (job->error) iso_sample_blank(&b->samples[i * b->rows + job->done]);
    for (size_t j = 0; j < job->done; j++) {
        double y[ISO_MAX_STATE];
        iso_sample *sample = &b->samples[i * b->rows + j];
        memcpy(y, sample, (size_t)m->orbit.model.dim * sizeof *y);
        const iso_status status = iso_orbit_make_sample(&m->orbit, b->times[j], y, sample);
        for (; status != ISO_OK && j < job->done; j++) iso_sample_blank(&b->samples[i * b->rows + j]);
        if (status != ISO_OK) return status;
    }
    if (job->error)
        return iso_context_fail(w->ctx, ISO_NUMERICAL, "", "taylor stopped after %ld steps: %s; last good %s = %.17g",
                                job->steps, job->error, iso_clock_name(m->orbit.model.clock), job->last * job->unit);
    return job->done == b->rows ? ISO_OK : iso_context_stopped(w->ctx);
}

static void set_job(const batch *b, size_t i, member *m)
{
    iso_lane_job *job = &m->job;
    job->model = &m->orbit.model;
    job->unit = m->orbit.unit_clock[b->options->clock];
    job->rows = b->rows;
    job->time = b->times;
    job->states = (double *)&b->samples[i * b->rows];
    job->stride = sizeof(iso_sample) / sizeof(double);
}

static bool solve_members(iso_pool_worker *w, const batch *b, member members[], size_t first, size_t count)
{
    const iso_batch_options *o = b->options;
    iso_lane_job *jobs[CHUNK];
    bool in_lanes[CHUNK] = {false};
    size_t waiting = 0;
    for (size_t i = 0; i < count && iso_pool_goes_on(w); i++) {
        member *m = &members[i];
        iso_status status = prepare(w, b, first + i, m);
        in_lanes[i] = status == ISO_OK && iso_pool_suits(&m->orbit);
        if (status == ISO_OK && !in_lanes[i]) status = solve_alone(w, b, first + i);
        note(w, b, first + i, status);
        if (!in_lanes[i]) continue;
        set_job(b, first + i, m);
        jobs[waiting++] = &m->job;
    }
    const bool memory = iso_pool_in_groups(w, b->code, o->tolerance, o->max_steps, jobs, waiting);
    for (size_t i = 0; i < count; i++)
        if (in_lanes[i]) note(w, b, first + i, finish(w, b, first + i, &members[i]));
    return memory;
}

static bool solve_chunk(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    member *members = calloc(count, sizeof *members);
    const bool memory = members && solve_members(w, data, members, first, count);
    free(members);
    return memory;
}

/* --- all -------------------------------------------------------------------------------------------------------- */

static iso_status check(iso_context *ctx, const iso_batch_options *o, const iso_lane_code *code, const double times[],
                        size_t rows)
{
    if (o->backend == ISO_BACKEND_EXACT)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "backend",
                                "a batch integrates: backend exact is for single orbits, which share nothing");
    if (iso_tolerance_check(ctx, o->tolerance) != ISO_OK) return ISO_BAD_ARGUMENT;
    if (o->threads < 0 || o->threads > ISO_MOST_THREADS)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "threads", "%d threads are not in [0, 1024]", o->threads);
    if (!code)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "vectors",
                                "this processor, or this build, has no vectors '%s'", o->vectors);
    for (size_t j = 0; j < rows; j++) {
        const double before = j > 0 ? times[j - 1] : 0;
        const bool back = times[rows - 1] < 0;
        if (!isfinite(times[j]) || (back ? times[j] > before || times[j] > 0 : times[j] < before))
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "times",
                                    "the times of a batch go away from 0, in one direction: not %g after %g",
                                    times[j], before);
    }
    return ISO_OK;
}

iso_status iso_batch_run(iso_context *ctx, const iso_batch_orbit orbits[], size_t count,
                         const iso_batch_options *options, const double times[], size_t rows, iso_sample samples[],
                         iso_status status[])
{
    ISO_DEFAULT_ARITHMETIC;
    iso_batch_options own = iso_batch_defaults();
    iso_status checked = iso_options_take(ctx, "iso_batch_options", &own, sizeof own, options);
    if (checked != ISO_OK) return checked;
    const iso_lane_code *code = iso_lane_code_find(own.vectors, false);
    checked = check(ctx, &own, code, times, rows);
    if (checked != ISO_OK) return checked;
    for (size_t i = 0; i < count * rows; i++) iso_sample_blank(&samples[i]);
    const size_t threads = iso_pool_threads(own.threads, count, code->lanes);
    batch b = {.orbits = orbits, .rows = rows, .options = &own, .times = times, .samples = samples, .code = code};
    iso_pool pool = {.count = count, .chunk = CHUNK, .solve = solve_chunk, .data = &b};
    b.status = status ? status : malloc((count + 1) * sizeof *b.status);
    if (!b.status) return iso_context_no_memory(ctx, "a batch");
    for (size_t i = 0; i < count; i++) b.status[i] = ISO_STOPPED;
    checked = iso_pool_run(ctx, &pool, threads, b.status);
    if (!status) free(b.status);
    return checked;
}
