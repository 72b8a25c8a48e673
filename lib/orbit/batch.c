/* batch.c - many orbits at once: threads take orbits in chunks, and solve a chunk in the lanes of vectors. */
#include "orbit/batch.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/arithmetic_impl.h"
#include "base/options_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "method/taylor/lanes_impl.h"
#include "orbit/orbit_impl.h"

/* Orbits that a thread takes at a time, if there are so many: enough to keep its lanes busy to the end. */
enum { CHUNK = 256, MOST_THREADS = 1024 };

/* What all threads share. */
typedef struct batch {
    const iso_batch_orbit *orbits;
    size_t count, rows;
    const iso_batch_options *options;
    const double *times;
    iso_sample *samples;
    iso_status *status;
    const iso_lane_code *code;
    size_t chunk;
    atomic_size_t next; /* the first orbit that nobody has taken */
    atomic_bool stopped;
} batch;

typedef struct worker {
    batch *b;
    iso_context *ctx, *asks; /* its own; the caller's, for the thread that may ask it (else NULL) */
    size_t failed;           /* the first of its orbits that failed, with its message in ctx; else count */
    char message[1024], about[32];
    pthread_t thread;
} worker;

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

static void note(worker *w, size_t i, iso_status status)
{
    w->b->status[i] = status;
    if (status == ISO_OK || i >= w->failed) return;
    w->failed = i;
    snprintf(w->message, sizeof w->message, "%s", iso_context_message(w->ctx));
    snprintf(w->about, sizeof w->about, "%s", iso_context_about(w->ctx));
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

static iso_status prepare_as(worker *w, size_t i, member *m, iso_backend backend)
{
    const iso_batch_orbit *orbit = &w->b->orbits[i];
    memset(&m->orbit, 0, sizeof m->orbit);
    m->orbit.ctx = w->ctx;
    m->orbit.options = options_of(w->b, i, backend);
    return iso_orbit_prepare(&m->orbit, orbit->params, orbit->start, m->job.start);
}

/* The point needs fewer products than the ball; small |k| makes the map between them steep. */
static iso_status prepare(worker *w, size_t i, member *m)
{
    const batch *b = w->b;
    const bool try_point = b->options->backend == ISO_BACKEND_AUTO && fabs(b->orbits[i].params->k) >= 0.125;
    iso_status status = try_point ? prepare_as(w, i, m, ISO_BACKEND_POINT) : ISO_NOT_MAPPED;
    if (status != ISO_OK) status = prepare_as(w, i, m, b->options->backend);
    return status == ISO_OK && b->rows > 0 ? iso_orbit_check_time(&m->orbit, b->times[b->rows - 1]) : status;
}

/* What lanes cannot hold (see is_for_lanes) is followed by itself. */
static iso_status solve_alone(worker *w, size_t i)
{
    const batch *b = w->b;
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

/* Lanes hold Taylor series. So the ball must move, must not be stiff, and must have equations for series. */
static bool is_for_lanes(const member *m)
{
    const iso_model *model = &m->orbit.model;
    char why[ISO_WHY_SIZE];
    return !m->orbit.rests && iso_effects_stiffness(&model->problem) <= ISO_STIFF &&
           iso_method_serves(&iso_method_taylor, model, why);
}

/* --- a chunk of them -------------------------------------------------------------------------------------------- */

static bool going_on(void *data)
{
    worker *w = data;
    if (w->asks && !iso_context_goes_on(w->asks)) atomic_store(&w->b->stopped, true);
    return !atomic_load(&w->b->stopped);
}

/* The samples of what a lane has reached: each stands where its state did. */
static iso_status finish(worker *w, size_t i, const member *m)
{
    const batch *b = w->b;
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
    return job->done == b->rows ? ISO_OK : iso_context_fail(w->ctx, ISO_STOPPED, "", "stopped on request");
}

/* Solves the jobs in groups that can share lanes. False: no memory. */
static bool solve_groups(worker *w, iso_lane_job *jobs[], size_t count)
{
    const iso_batch_options *o = w->b->options;
    const iso_lane_options lanes = {o->tolerance, o->max_steps, going_on, w};
    while (count > 0) {
        size_t alike = 1, others = 0;
        iso_lane_job *other[CHUNK];
        for (size_t i = 1; i < count; i++)
            if (iso_lanes_alike(jobs[0]->model, jobs[i]->model))
                jobs[alike++] = jobs[i];
            else
                other[others++] = jobs[i];
        if (!w->b->code->solve(jobs, alike, &lanes)) return atomic_load(&w->b->stopped);
        memcpy(jobs, other, others * sizeof *jobs);
        count = others;
    }
    return true;
}

static bool solve_chunk(worker *w, member members[], size_t first, size_t count)
{
    const batch *b = w->b;
    iso_lane_job *jobs[CHUNK];
    bool in_lanes[CHUNK] = {false};
    size_t waiting = 0;
    for (size_t i = 0; i < count && going_on(w); i++) {
        member *m = &members[i];
        iso_status status = prepare(w, first + i, m);
        in_lanes[i] = status == ISO_OK && is_for_lanes(m);
        if (status == ISO_OK && !in_lanes[i]) status = solve_alone(w, first + i);
        note(w, first + i, status);
        if (!in_lanes[i]) continue;
        iso_lane_job *job = &m->job;
        job->model = &m->orbit.model;
        job->unit = m->orbit.unit_clock[b->options->clock];
        job->rows = b->rows;
        job->time = b->times;
        job->states = (double *)&b->samples[(first + i) * b->rows];
        job->stride = sizeof(iso_sample) / sizeof(double);
        job->done = 0;
        job->error = NULL;
        jobs[waiting++] = job;
    }
    const bool memory = solve_groups(w, jobs, waiting);
    for (size_t i = 0; i < count; i++)
        if (in_lanes[i]) note(w, first + i, finish(w, first + i, &members[i]));
    return memory;
}

static void *work(void *data)
{
    worker *w = data;
    batch *b = w->b;
    member *members = calloc(b->chunk, sizeof *members);
    bool memory = members != NULL;
    while (memory && going_on(w)) {
        const size_t first = atomic_fetch_add(&b->next, b->chunk);
        if (first >= b->count) break;
        memory = solve_chunk(w, members, first, b->count - first < b->chunk ? b->count - first : b->chunk);
    }
    free(members);
    return memory ? NULL : w;
}

/* --- all -------------------------------------------------------------------------------------------------------- */

static iso_status check(iso_context *ctx, const iso_batch_options *o, const iso_lane_code *code, const double times[],
                        size_t rows)
{
    if (o->backend == ISO_BACKEND_EXACT)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "backend",
                                "a batch integrates: backend exact is for single orbits, which share nothing");
    if (iso_tolerance_check(ctx, o->tolerance) != ISO_OK) return ISO_BAD_ARGUMENT;
    if (o->threads < 0 || o->threads > MOST_THREADS)
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

/* Waits for a thread, and meanwhile asks the caller's monitor. */
static void *await(worker *asking, pthread_t thread)
{
    enum { SLICE = 20000000 }; /* nanoseconds */
    void *result = NULL;
    struct timespec until;
    do {
        going_on(asking);
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += SLICE;
        if (until.tv_nsec >= 1000000000) until.tv_sec++, until.tv_nsec -= 1000000000;
    } while (pthread_timedjoin_np(thread, &result, &until) == ETIMEDOUT);
    return result;
}

/* Starts threads beside this one, as many as can be had, and works with them. False: no memory. */
static bool work_together(worker workers[], size_t count)
{
    size_t started = 1;
    while (started < count && pthread_create(&workers[started].thread, NULL, work, &workers[started]) == 0) started++;
    bool memory = work(&workers[0]) == NULL;
    for (size_t i = 1; i < started; i++) memory = await(&workers[0], workers[i].thread) == NULL && memory;
    return memory;
}

static iso_status run(iso_context *ctx, batch *b, worker workers[], size_t threads)
{
    const worker *first = &workers[0];
    for (size_t i = 0; i < threads; i++) {
        workers[i] = (worker){.b = b, .ctx = iso_context_create(), .asks = i == 0 ? ctx : NULL, .failed = b->count};
        if (!workers[i].ctx)
            threads = i;
        else
            iso_context_set_monitor(workers[i].ctx, going_on, &workers[i]);
    }
    const bool memory = threads > 0 && work_together(workers, threads);
    for (size_t i = 0; i < threads; i++) {
        iso_context_free(workers[i].ctx);
        if (workers[i].failed < first->failed) first = &workers[i];
    }
    if (!memory) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for %zu orbits", b->count);
    if (atomic_load(&b->stopped)) return iso_context_fail(ctx, ISO_STOPPED, "", "stopped on request");
    if (first->failed == b->count) return ISO_OK;
    return iso_context_fail(ctx, b->status[first->failed], first->about, "orbit %zu: %s", first->failed,
                            first->message);
}

/* Those this process may run on. */
static size_t processors(void)
{
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) == 0 ? (size_t)CPU_COUNT(&set) : 1;
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
    const size_t most = count / (size_t)code->lanes + 1; /* more would have no work */
    const size_t asked = own.threads > 0 ? (size_t)own.threads : processors(), wanted = asked < most ? asked : most;
    batch b = {.orbits = orbits,
               .count = count,
               .rows = rows,
               .options = &own,
               .times = times,
               .samples = samples,
               .code = code,
               .chunk = CHUNK};
    if (count / wanted < CHUNK) b.chunk = count / wanted + 1;
    worker *workers = calloc(wanted, sizeof *workers);
    b.status = status ? status : malloc((count + 1) * sizeof *b.status);
    for (size_t i = 0; b.status && i < count; i++) b.status[i] = ISO_STOPPED;
    if (workers && b.status)
        checked = run(ctx, &b, workers, wanted);
    else
        checked = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a batch");
    free(workers);
    if (!status) free(b.status);
    return checked;
}
