/* crossings_lanes.c - many orbits from crossing to crossing in the lanes of vectors, on all threads, with deviations
 * beside them if they are asked for.
 */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "map/section_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/lane_groups_impl.h"
#include "orbit/orbit_impl.h"

/* CHUNK: orbits that a thread takes at a time. BYTES: its room for their crossings. */
enum { CHUNK = 64, BYTES = 1 << 24 };

/* An orbit that is followed in lanes. */
struct iso_crossings_lane {
    iso_orbit orbit;
    iso_lane_job job;
    double begin[2][ISO_DEVIATIONS]; /* (dl, dx) of the deviations at the start, one in each column */
    bool has_begin;
    _Alignas(max_align_t) unsigned char saved[]; /* iso_lane_build.saved bytes */
};

typedef struct follower {
    iso_crossings *c;
    const iso_crossings_task *task;
    const iso_lane_build *code;
    size_t rows, bytes; /* crossings of each orbit at a time, and the room that one takes */
} follower;

/* --- preparing -------------------------------------------------------------------------------------------------- */

/* y as (omega, n) or (M, gamma). In point_in_t the signs of M and y differ for k < 0. */
static const double *state_of(const iso_orbit *orbit, const double y[], double point[ISO_STATE])
{
    if (orbit->system == &iso_system_ball) return y;
    return iso_orbit_as_point(orbit, y, point), point;
}

/* The bounds of the search for crossings, in the variable of the series. */
static void set_search(const iso_orbit *orbit, const iso_crossing_orbit *o, iso_lane_job *job)
{
    const iso_params *p = &orbit->units.own;
    const iso_clock variable = iso_lane_clock(&orbit->model);
    job->axis = o->axis;
    job->zeros = iso_crossings_zeros(iso_orbit_motion(orbit), o->axis, variable);
    job->longest = o->bound[1];
    if (variable == ISO_CLOCK_S) return;
    job->longest /=
        fmin(iso_clock_rate(p, ISO_CLOCK_S, min3(p->J), NULL), iso_clock_rate(p, ISO_CLOCK_S, max3(p->J), NULL));
}

/* Prepares orbit i if lanes can follow it: on a global section, or in equal steps of a clock. Else o->lane stays
 * NULL. */
static iso_status begin(iso_pool_worker *w, const follower *f, size_t i)
{
    iso_crossings *c = f->c;
    const bool axis = c->options.kind == ISO_SECTION_AXIS;
    const iso_batch_orbit *of = &c->orbits[i];
    iso_crossing_orbit *o = &c->orbit[i];
    struct iso_crossings_lane *lane = calloc(1, sizeof *lane + f->code->saved);
    if (!lane) return iso_context_no_memory(w->ctx, "an orbit");
    iso_orbit *orbit = &lane->orbit;
    iso_attempt attempt = iso_crossings_attempt(c, i);
    iso_status status;
    do {
        iso_orbit_options how = iso_crossings_orbit_options(c, i, attempt);
        if (axis) how.clock = ISO_CLOCK_T; /* its series are the shortest */
        status = iso_orbit_prepare(orbit, w->ctx, &how, of->params, of->start, lane->job.start);
    } while (iso_attempt_next(&attempt, status));
    const bool suits = status == ISO_OK && iso_lanes_suit(orbit);
    double room[ISO_STATE];
    if (suits)
        status = iso_crossings_begin(w->ctx, c, &orbit->units.own, orbit, state_of(orbit, lane->job.start, room), o);
    if (!suits || status != ISO_OK || (axis && !(attempt.clocks && isfinite(o->bound[0]) && isfinite(o->bound[1])))) {
        free(lane);
        return status;
    }
    if (axis) set_search(orbit, o, &lane->job);
    lane->job.model = &orbit->model;
    lane->job.unit = orbit->unit_clock[orbit->options.clock];
    lane->job.saved = lane->saved;
    lane->job.on_section = o->begins_on_it;
    o->lane = lane;
    return ISO_OK;
}

/* --- numbers of a crossing -------------------------------------------------------------------------------------- */

/* (M, gamma) at a state y, and its deviation that belongs to d. */
static void to_point(const iso_orbit *orbit, const double y[], const double d[], double point[], double deviation[])
{
    const iso_params *p = &orbit->units.own;
    const bool ball = orbit->system == &iso_system_ball;
    double factor = 1, slope = 0;
    iso_orbit_as_point(orbit, y, point);
    const double *gamma = point + 3, q = dot_diag(gamma, p->J, gamma);
    const double NN = sqrt(p->det_J) / p->k * pow(q, -1 / (2 * p->k));
    double dgamma[3];
    for (int i = 0; i < 3; i++) dgamma[i] = ball ? sqrt(q) * d[3 + i] / p->root_J[i] : d[3 + i];
    const double along = dot(gamma, dgamma);
    for (int i = 0; i < 3; i++) deviation[3 + i] = dgamma[i] -= along * gamma[i];
    if (orbit->system != &iso_system_point) factor = NN, slope = -dot_diag(gamma, p->J, dgamma) / (p->k * q);
    for (int i = 0; i < 3; i++) deviation[i] = factor * (ball ? p->root_J[i] : 1) * d[i] + slope * point[i];
}

/* (dl, dx) of both deviations, one in each column. */
static void find_slopes(const iso_orbit *orbit, int axis, const double y[], double d[][ISO_MAX_STATE],
                        const double scale[], double slopes[2][ISO_DEVIATIONS])
{
    double flow[ISO_MAX_STATE], point[ISO_STATE], rate[ISO_STATE];
    orbit->model.own_rhs(&orbit->model, y, flow);
    to_point(orbit, y, flow, point, rate);
    for (int i = 0; i < ISO_DEVIATIONS; i++) {
        double deviation[ISO_STATE], slope[2];
        to_point(orbit, y, d[i], point, deviation);
        iso_section_slope(axis, point, rate, deviation, slope);
        for (int j = 0; j < 2; j++) slopes[j][i] = slope[j] * exp(scale[i]);
    }
}

/* The area of two deviations across the flow, at the state y. Liouville's volume of (M, gamma) is dgamma_u dgamma_v
 * dM_u dM_v, u = M/|M|, v = gamma x u. A free motion keeps it in the time s, and so does a magnetic field. (M, 0)
 * changes H by |M|^2, so on a level of H the volume of three vectors is the determinant of their parts (dgamma_u,
 * dgamma_v, dM_v), divided by |M|. One of the three is the flow, with dgamma_v = |M| in s. A potential of n changes H
 * by a function of gamma alone, so this holds for it as well. */
static double area_across(const iso_orbit *orbit, const double y[], double d[][ISO_MAX_STATE])
{
    double flow[ISO_MAX_STATE], point[ISO_STATE], part[3][3], v[3], along[ISO_STATE];
    orbit->model.own_rhs(&orbit->model, y, flow);
    for (int i = 0; i < 3; i++) {
        to_point(orbit, y, i == 0 ? flow : d[i - 1], point, along);
        cross(point + 3, point, v);
        const double size = norm(v);
        part[i][0] = dot(along + 3, point) / size;
        part[i][1] = dot(along + 3, v) / size;
        part[i][2] = dot(along, v) / size;
    }
    double of_12[3];
    cross(part[1], part[2], of_12);
    return dot(part[0], of_12) / part[0][1];
}

static void add_deviations(struct iso_crossings_lane *lane, const iso_crossing_orbit *o, iso_lane_event *e,
                           iso_crossing *to)
{
    const iso_orbit *orbit = &lane->orbit;
    double slopes[2][ISO_DEVIATIONS], (*const b)[ISO_DEVIATIONS] = lane->begin;
    for (int i = 0; i < ISO_DEVIATIONS; i++) to->growth[i] = e->growth[i];
    to->area = e->sine;
    if (!iso_effects_twist(&orbit->effects))
        to->determinant = area_across(orbit, e->y, e->deviation) /
                          area_across(orbit, lane->job.start, lane->job.first) * exp(e->scale[0] + e->scale[1]);
    if (o->axis < 0 || !o->begins_on_it) return;
    if (!lane->has_begin) find_slopes(orbit, o->axis, lane->job.start, lane->job.first, (double[2]){0}, b);
    lane->has_begin = true;
    find_slopes(orbit, o->axis, e->y, e->deviation, e->scale, slopes);
    const double det = b[0][0] * b[1][1] - b[0][1] * b[1][0];
    for (int i = 0; i < 2; i++) { /* slopes begin^-1 */
        to->slope[i][0] = (slopes[i][0] * b[1][1] - slopes[i][1] * b[1][0]) / det;
        to->slope[i][1] = (slopes[i][1] * b[0][0] - slopes[i][0] * b[0][1]) / det;
    }
}

/* One crossing, at state y and time `time` of the model's clock, own units. */
static iso_status add(iso_pool_worker *w, const iso_crossings *c, iso_crossing_orbit *o, const double y[],
                      double time, iso_lane_event *e, iso_crossing *to, iso_sample *sample)
{
    struct iso_crossings_lane *lane = o->lane;
    const iso_orbit *orbit = &lane->orbit;
    const iso_model *m = &orbit->model;
    double own[ISO_CLOCKS] = {NAN, NAN, NAN}, clock[ISO_CLOCKS], room[ISO_STATE];
    own[m->clock] = time;
    for (int i = 0; i < m->clocks; i++) own[m->clock_of[i]] = y[m->moving + i];
    for (int k = 0; k < ISO_CLOCKS; k++) clock[k] = own[k] * orbit->unit_clock[k];
    ISO_TRY(iso_crossings_add(w->ctx, c, orbit, clock, own[ISO_CLOCK_S], state_of(orbit, y, room), o, to));
    if (e) add_deviations(lane, o, e, to);
    if (!sample) return ISO_OK;
    ISO_TRY(iso_orbit_make_sample(orbit, time * lane->job.unit, y, sample));
    iso_crossings_hide(c, sample);
    return ISO_OK;
}

/* --- following -------------------------------------------------------------------------------------------------- */

/* Turns what the lanes have found into crossings. */
static iso_status finish(iso_pool_worker *w, const follower *f, size_t i)
{
    const iso_crossings_task *t = f->task;
    iso_crossing_orbit *o = &f->c->orbit[i];
    const iso_lane_job *job = &o->lane->job;
    for (size_t j = 0; j < job->done; j++, ++t->done[i]) {
        const size_t to = t->stride * i + t->done[i];
        const double *y = job->event ? job->event[j].y : job->states + j * job->stride;
        const double time = job->time ? job->time[j] / job->unit : job->passed[j];
        ISO_TRY(add(w, f->c, o, y, time, job->event ? &job->event[j] : NULL, &t->crossing[to],
                    t->sample ? &t->sample[to] : NULL));
    }
    if (job->error) return iso_lanes_failed(w->ctx, job, false);
    return job->done == job->rows ? ISO_OK : iso_context_stopped(w->ctx);
}

/* One pass over the orbits of a chunk that still lack crossings. *waiting: how many they are. */
static bool pass(iso_pool_worker *w, const follower *f, size_t first, size_t count, size_t *waiting)
{
    const iso_crossings_options *o = &f->c->options;
    const iso_crossings_task *t = f->task;
    double *const times = w->room, *const states = times + CHUNK * f->rows;
    iso_lane_job *jobs[CHUNK];
    size_t taken[CHUNK];
    *waiting = 0;
    for (size_t i = first; i < first + count; i++) {
        iso_crossing_orbit *orbit = &f->c->orbit[i];
        const size_t left = t->each - t->done[i], at = (i - first) * f->rows;
        if (!orbit->lane || !iso_crossings_wants(f->c, t, i) || left == 0) continue;
        iso_lane_job *job = &orbit->lane->job;
        orbit->lane->orbit.ctx = w->ctx; /* an earlier call had other workers */
        job->rows = left < f->rows ? left : f->rows;
        job->done = 0;
        job->error = NULL;
        job->event = o->deviations ? (iso_lane_event *)(void *)states + at : NULL;
        job->states = o->deviations ? NULL : states + at * ISO_MAX_STATE;
        job->stride = ISO_MAX_STATE;
        job->passed = times + at;
        job->time = o->kind == ISO_SECTION_CLOCK ? times + at : NULL;
        for (size_t j = 0; j < job->rows && job->time; j++) times[at + j] = (double)(orbit->count + j + 1) * o->value;
        taken[*waiting] = i;
        jobs[(*waiting)++] = job;
    }
    const bool memory = iso_lanes_in_groups(w, f->code, o->tolerance, 0, jobs, *waiting);
    for (size_t j = 0; j < *waiting; j++) iso_crossings_keep(f->c, t, w->ctx, taken[j], finish(w, f, taken[j]));
    return memory;
}

static bool solve_chunk(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    const follower *f = data;
    size_t waiting = 0;
    for (size_t i = first; i < first + count && iso_pool_goes_on(w); i++) {
        iso_crossing_orbit *o = &f->c->orbit[i];
        if (!iso_crossings_wants(f->c, f->task, i) || o->alone) continue;
        if (!o->lane) iso_crossings_keep(f->c, f->task, w->ctx, i, begin(w, f, i));
        waiting += o->status == ISO_OK && o->lane;
    }
    if (waiting > 0 && !w->room) w->room = malloc(CHUNK * f->rows * f->bytes + 1);
    bool memory = waiting == 0 || w->room;
    while (memory && waiting > 0 && iso_pool_goes_on(w)) memory = pass(w, f, first, count, &waiting);
    return memory;
}

iso_status iso_crossings_in_lanes(iso_crossings *c, const iso_crossings_task *task)
{
    const iso_lane_build *code = iso_lane_build_find(c->options.vectors, c->options.deviations);
    const size_t state = c->options.deviations ? sizeof(iso_lane_event) : ISO_MAX_STATE * sizeof(double);
    const size_t bytes = sizeof(double) + state, most = BYTES / (CHUNK * bytes);
    follower f = {c, task, code, task->each < most ? task->each : most, bytes};
    iso_pool pool = {.what = "orbit", .count = c->count, .chunk = CHUNK, .solve = solve_chunk, .data = &f};
    if (c->options.kind == ISO_SECTION_COLUMN) return ISO_OK;
    return iso_pool_run(c->ctx, &pool, iso_pool_threads(c->options.threads, c->count, code->lanes), NULL);
}
