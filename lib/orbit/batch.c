/* batch.c - many orbits at once: threads take orbits in chunks, and solve a chunk in the lanes of vectors. Samples go
 * to the caller, or their columns to a table. */
#include "orbit/batch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "method/integrator_impl.h"
#include "orbit/lane_groups_impl.h"
#include "orbit/orbit_impl.h"

/* Orbits that a thread takes at a time: enough to keep its lanes busy to the end. For a table a thread has room for
 * the samples of its chunk, which should stay in the cache; fewer orbits than LEAST would leave lanes empty. */
enum { CHUNK = 256, LEAST = 64, ROOM = 1 << 22 };

/* The status of an orbit that no thread has taken. */
static const iso_status UNTOUCHED = (iso_status)-1;

/* What all threads share. */
typedef struct batch {
    const iso_batch_orbit *orbits; /* NULL: those of the scenes */
    size_t count, rows;
    iso_batch_options options;
    const double *times;
    iso_sample *samples; /* NULL: they are only on the way to the table */
    iso_status *status;
    const iso_lane_build *code;
    const iso_scene *const *scene;
    size_t scenes;
    const double *k, *J, *start; /* in place of the scenes'; NULL: theirs */
    double *table;
    int columns[ISO_MAX_COLUMNS], width;
} batch;

/* An orbit of a chunk: prepared, then solved by one of its lanes. */
typedef struct member {
    iso_batch_orbit given;
    iso_params params; /* of a scene's orbit */
    iso_start start;
    iso_sample *sample; /* its rows */
    iso_orbit orbit;
    iso_lane_job job;
} member;

_Static_assert((int)ISO_MAX_STATE <= (int)ISO_TRAJECTORY_COLUMNS, "a sample has room for a state");

const char *iso_batch_vectors(int i, int *lanes)
{
    for (const iso_lane_build *const *code = iso_lane_builds; *code; code++) {
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

static const iso_scene *scene_of(const batch *b, size_t i)
{
    return b->scene[b->scenes == 1 ? 0 : i];
}

static iso_orbit_options options_of(const batch *b, const member *m, iso_backend backend)
{
    const iso_batch_options *o = &b->options;
    return (iso_orbit_options){.effects = m->given.effects,
                               .backend = backend,
                               .tolerance = o->tolerance,
                               .max_steps = o->max_steps,
                               .clock = o->clock,
                               .shown = o->shown,
                               .with_clock = {o->with_clock[0], o->with_clock[1], o->with_clock[2]}};
}

/* Prepares orbit i for the lanes. One that they cannot hold (iso_lanes_suit) is followed at once, alone. */
static iso_status begin(iso_pool_worker *w, const batch *b, size_t i, member *m, bool *in_lanes)
{
    const double *k = b->k ? b->k + i : NULL, *J = b->J ? b->J + 3 * i : NULL,
                 *start = b->start ? b->start + 6 * i : NULL;
    *in_lanes = false;
    if (b->orbits) {
        m->given = b->orbits[i];
    } else {
        m->given = (iso_batch_orbit){&m->params, &m->start, &scene_of(b, i)->effects};
        ISO_TRY(iso_scene_replaced(w->ctx, scene_of(b, i), k, J, start, &m->params, &m->start));
    }
    const iso_batch_orbit *of = &m->given;
    const iso_backend asked = b->options.backend;
    iso_attempt attempt = iso_attempt_first(of->params, asked, asked, false);
    iso_orbit_options options;
    iso_status status;
    do {
        options = options_of(b, m, attempt.backend);
        status = iso_orbit_prepare(&m->orbit, w->ctx, &options, of->params, of->start, m->job.start);
    } while (iso_attempt_next(&attempt, status));
    if (status == ISO_OK && b->rows > 0) status = iso_orbit_check_time(&m->orbit, b->times[b->rows - 1]);
    *in_lanes = status == ISO_OK && iso_lanes_suit(&m->orbit);
    if (status != ISO_OK || *in_lanes) return status;
    iso_orbit *orbit;
    options = options_of(b, m, asked);
    status = iso_orbit_create(w->ctx, of->params, of->start, &options, &orbit);
    for (size_t j = 0; j < b->rows && status == ISO_OK; j++) {
        status = iso_orbit_at(orbit, b->times[j], &m->sample[j]);
        if (status != ISO_OK) iso_sample_blank(&m->sample[j]);
    }
    iso_orbit_free(orbit);
    return status;
}

/* --- a chunk of them -------------------------------------------------------------------------------------------- */

/* The samples of what a lane has reached: each stands where its state did. */
static iso_status finish(iso_pool_worker *w, const batch *b, const member *m)
{
    const iso_lane_job *job = &m->job;
    if (job->error) iso_sample_blank(&m->sample[job->done]);
    for (size_t j = 0; j < job->done; j++) {
        double y[ISO_MAX_STATE];
        memcpy(y, &m->sample[j], (size_t)m->orbit.model.dim * sizeof *y);
        const iso_status status = iso_orbit_make_sample(&m->orbit, b->times[j], y, &m->sample[j]);
        for (; status != ISO_OK && j < job->done; j++) iso_sample_blank(&m->sample[j]);
        if (status != ISO_OK) return status;
    }
    if (job->error) return iso_lanes_failed(w->ctx, job, true);
    return job->done == b->rows ? ISO_OK : iso_context_stopped(w->ctx);
}

static bool solve_chunk(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    const batch *b = data;
    iso_lane_job *jobs[CHUNK];
    size_t waiting = 0, place[CHUNK];
    member *members = malloc(count * sizeof *members);
    if (b->table && !w->room) w->room = malloc(w->all->chunk * b->rows * sizeof(iso_sample) + 1);
    iso_sample *samples = b->table ? w->room : b->samples + first * b->rows;
    bool memory = members && (samples || !b->table), in_lanes;
    for (size_t i = 0; memory && i < count * b->rows; i++) iso_sample_blank(&samples[i]);
    for (size_t i = 0; memory && i < count && iso_pool_goes_on(w); i++) {
        member *m = &members[i];
        m->sample = samples + i * b->rows;
        m->job = (iso_lane_job){.model = &m->orbit.model,
                                .rows = b->rows,
                                .time = b->times,
                                .states = (double *)m->sample,
                                .stride = sizeof(iso_sample) / sizeof(double)};
        note(w, b, first + i, begin(w, b, first + i, m, &in_lanes));
        if (!in_lanes) continue;
        m->job.unit = m->orbit.unit_clock[b->options.clock];
        place[waiting] = i;
        jobs[waiting++] = &m->job;
    }
    memory = memory && iso_lanes_in_groups(w, b->code, b->options.tolerance, b->options.max_steps, jobs, waiting);
    for (size_t j = 0; memory && j < waiting; j++) note(w, b, first + place[j], finish(w, b, &members[place[j]]));
    double *to = b->table ? b->table + first * b->rows * (size_t)b->width : NULL;
    for (size_t i = 0; memory && to && i < count * b->rows; i++)
        for (int c = 0; c < b->width; c++) *to++ = iso_sample_column(&samples[i], b->columns[c]);
    for (size_t i = first; !memory && i < first + count; i++) b->status[i] = UNTOUCHED;
    free(members);
    return memory;
}

/* --- all -------------------------------------------------------------------------------------------------------- */

/* Checks the options, then solves all. An orbit that no thread has taken has no rows, and the status of the call. */
static iso_status run(iso_context *ctx, batch *b, const iso_batch_options *options, iso_status status[])
{
    const iso_batch_options *o = &b->options;
    const size_t fits = ROOM / ((b->rows + 1) * sizeof(iso_sample)), width = b->rows * (size_t)b->width;
    const size_t chunk = !b->table || fits > CHUNK ? CHUNK : fits < LEAST ? LEAST : fits;
    b->options = options ? *options : iso_batch_defaults();
    b->code = iso_lane_build_find(o->vectors, false);
    if (o->backend == ISO_BACKEND_EXACT)
        return ISO_FAIL_ARGUMENT(ctx, "backend",
                                 "a batch integrates: backend exact is for single orbits, which share nothing");
    ISO_TRY(iso_tolerance_check(ctx, o->tolerance));
    ISO_TRY(iso_lanes_check(ctx, o->threads, o->vectors, b->code != NULL));
    for (size_t j = 0; j < b->rows; j++) {
        const double time = b->times[j], before = j > 0 ? b->times[j - 1] : 0;
        const bool back = b->times[b->rows - 1] < 0;
        if (!isfinite(time) || (back ? time > before || time > 0 : time < before))
            return ISO_FAIL_ARGUMENT(ctx, "times",
                                     "the times of a batch go away from 0, in one direction: not %s after %s",
                                     ISO_SHORT(time), ISO_SHORT(before));
    }
    iso_pool pool = {.what = "orbit", .count = b->count, .chunk = chunk, .solve = solve_chunk, .data = b};
    b->status = status ? status : malloc((b->count + 1) * sizeof *b->status);
    if (!b->status) return iso_context_no_memory(ctx, "a batch");
    for (size_t i = 0; i < b->count; i++) b->status[i] = UNTOUCHED;
    const iso_status answer =
        iso_pool_run(ctx, &pool, iso_pool_threads(o->threads, b->count, b->code->lanes), b->status);
    for (size_t i = 0; i < b->count; i++) {
        if (b->status[i] != UNTOUCHED) continue;
        b->status[i] = answer;
        for (size_t j = 0; b->table && j < width; j++) b->table[i * width + j] = NAN;
        for (size_t j = 0; !b->table && j < b->rows; j++) iso_sample_blank(&b->samples[i * b->rows + j]);
    }
    if (!status) free(b->status);
    return answer;
}

iso_status iso_batch_run(iso_context *ctx, const iso_batch_orbit orbits[], size_t count,
                         const iso_batch_options *options, const double times[], size_t rows, iso_sample samples[],
                         iso_status status[])
{
    ISO_DEFAULT_ARITHMETIC;
    batch b = {.orbits = orbits, .count = count, .rows = rows, .times = times, .samples = samples};
    return run(ctx, &b, options, status);
}

/* --- scenes ----------------------------------------------------------------------------------------------------- */

static iso_status check_scene(iso_context *ctx, const batch *b, size_t i)
{
    const iso_scene *first = scene_of(b, 0), *scene = scene_of(b, i);
    int columns[ISO_MAX_COLUMNS];
    const bool same = iso_scene_column_list(scene, columns) == b->width &&
                      memcmp(columns, b->columns, (size_t)b->width * sizeof *columns) == 0;
    const char *apart = !same                                      ? "columns"
                        : scene->backend != first->backend         ? "backend"
                        : scene->tolerance != first->tolerance     ? "tolerance"
                        : scene->start.model != first->start.model ? "model of the start"
                                                                   : NULL;
    if (apart) return ISO_FAIL_ARGUMENT(ctx, "scenes", "scene %zu has another %s than scene 0", i, apart);
    if (strcmp(scene->method, "auto") != 0 && strcmp(scene->method, "taylor") != 0)
        return ISO_FAIL_ARGUMENT(ctx, "method", "scene %zu: a batch is by method taylor, not '%s': run it by itself",
                                 i, scene->method);
    if (iso_effects_watch_contact(&scene->effects))
        return ISO_FAIL_ARGUMENT(ctx, "scenes",
                                 "scene %zu: a batch does not see where contact is lost: write 'reactions: "
                                 "{two_sided: true}', or run it by itself",
                                 i);
    return iso_scene_check_columns(ctx, scene);
}

/* Options that all orbits share, from the first scene and its columns. */
static iso_batch_options shared_options(const batch *b, int threads, const char *vectors)
{
    const iso_scene *scene = scene_of(b, 0);
    iso_batch_options o = iso_batch_defaults();
    bool ball = false, point = false;
    for (int i = 0; i < b->width; i++) {
        const int c = b->columns[i];
        if (c < ISO_CLOCKS) o.with_clock[c] = true;
        point = point || (c >= ISO_COLUMN_POINT && c < ISO_COLUMN_EFFECTS);
        ball = ball || (c >= ISO_COLUMN_BALL && c < ISO_COLUMN_POINT) || c >= ISO_COLUMN_EFFECTS;
    }
    o.shown = ball && point ? ISO_SHOW_BOTH
              : ball        ? ISO_SHOW_BALL
              : point       ? ISO_SHOW_POINT
                            : (iso_models)scene->start.model;
    o.clock = scene->start.model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    o.backend = scene->backend;
    o.tolerance = scene->tolerance;
    o.threads = threads;
    o.vectors = vectors;
    return o;
}

iso_status iso_batch_table(iso_context *ctx, const iso_scene *const scene[], size_t scenes, size_t count,
                           const double k[], const double J[], const double start[], const double times[],
                           size_t rows, int threads, const char *vectors, double table[], iso_status status[])
{
    ISO_DEFAULT_ARITHMETIC;
    batch b = {.count = count, .rows = rows, .times = times, .scene = scene, .scenes = scenes};
    b.k = k, b.J = J, b.start = start, b.table = table;
    if (scenes == 0 || (scenes != 1 && scenes != count))
        return ISO_FAIL_ARGUMENT(ctx, "scenes", "%zu scenes for %zu orbits: give one, or one for each", scenes,
                                 count);
    if (count == 0) return ISO_OK;
    b.width = iso_scene_column_list(scene_of(&b, 0), b.columns);
    for (size_t i = 0; i < scenes; i++) ISO_TRY(check_scene(ctx, &b, i));
    const iso_batch_options o = shared_options(&b, threads, vectors);
    return run(ctx, &b, &o, status);
}
