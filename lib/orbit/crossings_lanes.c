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
    bool has_clocks;
    double begin[2][ISO_DEVIATIONS]; /* (dl, dx) of the deviations at the start, one in each column */
    bool has_begin;
    _Alignas(max_align_t) unsigned char saved[]; /* iso_lane_build.saved bytes */
};

typedef struct follower {
    iso_crossings *c;
    const iso_crossings_task *task;
    const iso_lane_build *code;
    bool *taken;
} follower;

/* --- preparing -------------------------------------------------------------------------------------------------- */

/* The bounds of the search for crossings, in the variable of the series. */
static void set_search(struct iso_crossings_lane *lane, const iso_crossing_orbit *o)
{
    const iso_orbit *orbit = &lane->orbit;
    const iso_params *p = &orbit->units.own;
    iso_lane_job *job = &lane->job;
    job->axis = o->axis;
    const iso_clock variable = iso_lane_clock(&orbit->model);
    job->zeros = iso_crossings_zeros(iso_orbit_motion(orbit), o->axis, variable);
    job->longest = o->bound[1];
    if (variable == ISO_CLOCK_S) return;
    job->longest /=
        fmin(iso_clock_rate(p, ISO_CLOCK_S, min3(p->J), NULL), iso_clock_rate(p, ISO_CLOCK_S, max3(p->J), NULL));
}

static iso_status prepare(iso_pool_worker *w, const iso_crossings *c, size_t i, struct iso_crossings_lane *lane)
{
    const iso_batch_orbit *of = &c->orbits[i];
    iso_orbit *orbit = &lane->orbit;
    iso_way way = iso_crossings_way(c, i);
    iso_status status;
    do {
        iso_orbit_clear(orbit);
        orbit->ctx = w->ctx;
        orbit->options = iso_crossings_orbit_options(c, i, way);
        if (c->options.kind == ISO_SECTION_AXIS) orbit->options.clock = ISO_CLOCK_T; /* its series are the shortest */
        lane->has_clocks = way.clocks;
        status = iso_orbit_prepare(orbit, of->params, of->start, lane->job.start);
    } while (iso_way_next(&way, status));
    return status;
}

/* Whether lanes can follow the orbit: on a global section, or in equal steps of a clock. */
static bool suits(const iso_crossings *c, const struct iso_crossings_lane *lane, const iso_crossing_orbit *o)
{
    if (!iso_lanes_suit(&lane->orbit) || c->options.kind == ISO_SECTION_COLUMN) return false;
    if (c->options.kind == ISO_SECTION_CLOCK) return true;
    return lane->has_clocks && isfinite(o->bound[0]) && isfinite(o->bound[1]);
}

static bool starts_on_section(const iso_orbit *orbit, const double y[], int axis, bool *upwards)
{
    const iso_params *own = &orbit->units.own;
    double point[ISO_STATE];
    if (orbit->system != &iso_system_point_in_t)
        return iso_crossings_on_section(own, iso_crossings_model(orbit), y, axis, upwards);
    iso_point_in_t_to_point(own, y, point); /* for k < 0 the signs of M and y differ */
    return iso_crossings_on_section(own, ISO_POINT, point, axis, upwards);
}

/* Prepares orbit i if lanes can follow it; else o->lane stays NULL. */
static iso_status begin(iso_pool_worker *w, const follower *f, size_t i)
{
    iso_crossings *c = f->c;
    iso_crossing_orbit *o = &c->orbit[i];
    struct iso_crossings_lane *lane = calloc(1, sizeof *lane + f->code->saved);
    if (!lane) return iso_context_no_memory(w->ctx, "an orbit");
    iso_status status = prepare(w, c, i, lane);
    if (status == ISO_OK) iso_crossings_find_section(c, &lane->orbit, o);
    if (status != ISO_OK || !suits(c, lane, o)) {
        free(lane);
        return status;
    }
    if (c->options.kind == ISO_SECTION_AXIS) {
        o->begins_on_it = starts_on_section(&lane->orbit, lane->job.start, o->axis, &o->upwards);
        status = iso_crossings_check_plane(w->ctx, &lane->orbit, lane->job.start, o->axis);
        set_search(lane, o);
    }
    lane->job.model = &lane->orbit.model;
    lane->job.unit = lane->orbit.unit_clock[lane->orbit.options.clock];
    lane->job.saved = lane->saved;
    lane->job.on_section = o->begins_on_it;
    o->lane = lane;
    return status;
}

/* --- numbers of a crossing -------------------------------------------------------------------------------------- */

/* (M, gamma) at a state y, and its deviation that belongs to d. */
static void to_point(const iso_orbit *orbit, const double y[], const double d[], double point[], double deviation[])
{
    const iso_params *p = &orbit->units.own;
    const bool ball = orbit->system == &iso_system_ball;
    double factor = 1, slope = 0;
    if (ball) iso_ball_to_point(p, y, point);
    if (orbit->system == &iso_system_point_in_t) iso_point_in_t_to_point(p, y, point);
    if (orbit->system == &iso_system_point) copy(y, point, ISO_STATE);
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

/* A B^-1 */
static void divide(double A[2][2], double B[2][2], double quotient[2][2])
{
    const double det = B[0][0] * B[1][1] - B[0][1] * B[1][0];
    for (int i = 0; i < 2; i++) {
        quotient[i][0] = (A[i][0] * B[1][1] - A[i][1] * B[1][0]) / det;
        quotient[i][1] = (A[i][1] * B[0][0] - A[i][0] * B[0][1]) / det;
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

static void tell_deviations(struct iso_crossings_lane *lane, const iso_crossing_orbit *o, iso_lane_event *e,
                            iso_crossing *to)
{
    const iso_orbit *orbit = &lane->orbit;
    double slopes[2][ISO_DEVIATIONS];
    for (int i = 0; i < ISO_DEVIATIONS; i++) to->growth[i] = e->growth[i];
    to->area = e->sine;
    if (!iso_effects_twist(&orbit->effects))
        to->determinant = area_across(orbit, e->y, e->deviation) /
                          area_across(orbit, lane->job.start, lane->job.first) * exp(e->scale[0] + e->scale[1]);
    if (o->axis < 0 || !o->begins_on_it) return;
    if (!lane->has_begin) find_slopes(orbit, o->axis, lane->job.start, lane->job.first, (double[2]){0}, lane->begin);
    lane->has_begin = true;
    find_slopes(orbit, o->axis, e->y, e->deviation, e->scale, slopes);
    divide(slopes, lane->begin, to->slope);
}

static double clock_of(const iso_orbit *orbit, iso_clock clock, const double y[], double time)
{
    const iso_model *m = &orbit->model;
    if (clock == m->clock) return time;
    for (int i = 0; i < m->clocks; i++)
        if (m->clock_of[i] == clock) return y[m->moving + i];
    return NAN;
}

/* One crossing, at state y and time `time` of the model's clock, own units. */
static iso_status tell(iso_pool_worker *w, const iso_crossings *c, size_t i, const double y[], double time,
                       iso_lane_event *e, iso_crossing *to, iso_sample *sample)
{
    iso_crossing_orbit *o = &c->orbit[i];
    struct iso_crossings_lane *lane = o->lane;
    const iso_orbit *orbit = &lane->orbit;
    const iso_params *own = &orbit->units.own;
    double point[ISO_STATE];
    const double s = clock_of(orbit, ISO_CLOCK_S, y, time);
    ISO_TRY(iso_crossings_hold(w->ctx, c, o, orbit, s));
    iso_crossing_blank(to);
    for (iso_clock k = 0; k < ISO_CLOCKS; k++) to->clock[k] = clock_of(orbit, k, y, time) * orbit->unit_clock[k];
    if (o->axis >= 0) {
        orbit->system == &iso_system_point_in_t ? iso_point_in_t_to_point(own, y, point)
                                                : iso_crossings_point(own, iso_crossings_model(orbit), y, point);
        iso_section_chart(o->axis, point, &to->l, &to->x);
    }
    if (e) tell_deviations(lane, o, e, to);
    o->s = s;
    o->count++;
    if (!sample) return ISO_OK;
    iso_sample here;
    iso_status status = iso_orbit_make_sample(orbit, time * lane->job.unit, y, &here);
    if (status == ISO_OK) iso_crossings_give(c, &here, sample);
    return status;
}

/* --- following -------------------------------------------------------------------------------------------------- */

/* Room for what lanes store: for each orbit of a chunk, at most `rows` crossings at a time. */
typedef struct room {
    size_t rows;
    double *states, *times;
    iso_lane_event *events;
} room;

static void free_room(room *r)
{
    free(r->states);
    free(r->times);
    free(r->events);
}

static bool make_room(const follower *f, size_t orbits, room *r)
{
    const size_t bytes = f->c->options.deviations ? sizeof(iso_lane_event) : (ISO_MAX_STATE + 1) * sizeof(double);
    const size_t most = BYTES / (orbits * bytes);
    r->rows = f->task->each < most ? f->task->each : most;
    r->events = f->c->options.deviations ? malloc(orbits * r->rows * sizeof *r->events) : NULL;
    r->states = f->c->options.deviations ? NULL : malloc(orbits * r->rows * ISO_MAX_STATE * sizeof *r->states);
    r->times = malloc(orbits * r->rows * sizeof *r->times);
    if (r->times && (r->events || r->states)) return true;
    free_room(r);
    return false;
}

/* The job of orbit i for its next rows. `at`: its place in the chunk. */
static iso_lane_job *set_job(const follower *f, size_t i, size_t at, const room *r, size_t rows)
{
    const iso_crossings_options *o = &f->c->options;
    iso_crossing_orbit *orbit = &f->c->orbit[i];
    iso_lane_job *job = &orbit->lane->job;
    double *times = r->times + at * r->rows;
    job->rows = rows;
    job->done = 0;
    job->error = NULL;
    job->event = r->events ? r->events + at * r->rows : NULL;
    job->states = r->states ? r->states + at * r->rows * ISO_MAX_STATE : NULL;
    job->stride = ISO_MAX_STATE;
    job->time = o->kind == ISO_SECTION_CLOCK ? times : NULL;
    job->passed = times;
    for (size_t j = 0; j < rows && job->time; j++) times[j] = (double)(orbit->count + j + 1) * o->value;
    return job;
}

/* Turns what the lanes have found into crossings. */
static iso_status finish(iso_pool_worker *w, const follower *f, size_t i)
{
    const iso_crossings_task *t = f->task;
    const struct iso_crossings_lane *lane = f->c->orbit[i].lane;
    const iso_lane_job *job = &lane->job;
    size_t *done = &t->done[i];
    for (size_t j = 0; j < job->done; j++) {
        const size_t to = t->stride * i + *done;
        const double *y = job->event ? job->event[j].y : job->states + j * job->stride;
        const double time = job->time ? job->time[j] / job->unit : job->passed[j];
        const iso_status status = tell(w, f->c, i, y, time, job->event ? &job->event[j] : NULL, &t->crossing[to],
                                       t->sample ? &t->sample[to] : NULL);
        if (status != ISO_OK) return status;
        ++*done;
    }
    if (job->error) return iso_lanes_failed(w->ctx, job, false);
    return job->done == job->rows ? ISO_OK : iso_context_stopped(w->ctx);
}

/* One pass over the orbits of a chunk that still lack crossings. *waiting: how many they are. */
static bool pass(iso_pool_worker *w, const follower *f, size_t first, size_t count, const room *r, size_t *waiting)
{
    const iso_crossings_options *o = &f->c->options;
    const iso_crossings_task *t = f->task;
    iso_lane_job *jobs[CHUNK];
    size_t orbit[CHUNK];
    *waiting = 0;
    for (size_t i = first; i < first + count; i++) {
        const size_t left = t->each - t->done[i];
        if (!f->taken[i] || t->status[i] != ISO_OK || left == 0) continue;
        jobs[*waiting] = set_job(f, i, i - first, r, left < r->rows ? left : r->rows);
        f->c->orbit[i].lane->orbit.ctx = w->ctx; /* an earlier call had other workers */
        orbit[(*waiting)++] = i;
    }
    const size_t solved = *waiting;
    const bool memory = iso_lanes_in_groups(w, f->code, o->tolerance, o->max_steps, jobs, solved);
    for (size_t j = 0; j < solved; j++) {
        const size_t i = orbit[j];
        t->status[i] = finish(w, f, i);
        iso_crossings_keep(f->c, w->ctx, i, t->status[i]);
    }
    return memory;
}

static bool solve_chunk(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    const follower *f = data;
    const iso_crossings_task *t = f->task;
    size_t waiting = 0;
    for (size_t i = first; i < first + count && iso_pool_goes_on(w); i++) {
        iso_crossing_orbit *o = &f->c->orbit[i];
        if ((t->wanted && !t->wanted[i]) || o->status != ISO_OK || o->alone) continue;
        const iso_status status = o->lane ? ISO_OK : begin(w, f, i);
        f->taken[i] = status != ISO_OK || o->lane;
        t->status[i] = status;
        iso_crossings_keep(f->c, w->ctx, i, status);
        waiting += status == ISO_OK && o->lane;
    }
    room r;
    if (waiting == 0) return true;
    if (!make_room(f, count, &r)) return false;
    bool memory = true;
    while (memory && waiting > 0 && iso_pool_goes_on(w)) memory = pass(w, f, first, count, &r, &waiting);
    free_room(&r);
    return memory;
}

iso_status iso_crossings_in_lanes(iso_crossings *c, const iso_crossings_task *task, bool taken[])
{
    follower f = {c, task, iso_lane_build_find(c->options.vectors, c->options.deviations), taken};
    const size_t threads = iso_pool_threads(c->options.threads, c->count, f.code->lanes);
    iso_pool pool = {.what = "orbit", .count = c->count, .chunk = CHUNK, .solve = solve_chunk, .data = &f};
    if (task->each == 0 || c->options.kind == ISO_SECTION_COLUMN) return ISO_OK;
    return iso_pool_run(c->ctx, &pool, threads, NULL);
}

void iso_crossings_free_lane(struct iso_crossings_lane *lane)
{
    free(lane);
}
