/* crew_impl.h - solves the jobs of lanes_impl.h, LANES side by side. A lane whose job ends takes the next one. */
#include "base/finite_impl.h"
#include "method/integrator_impl.h"
#include "method/taylor/crossing_impl.h"
#include "method/taylor/lanes_impl.h"

enum { MOST_PARTS = 4096 }; /* of a step, in the search for crossings */

typedef struct crew {
    iso_lane_job *job[LANES]; /* NULL: the lane has no job; it goes on with its last orbit, and nothing is stored */
    iso_instant left[LANES];  /* the time at the step's left end */
    double row[LANES];        /* the time of the next row */
    bool fresh[LANES];        /* its first deviations are not set yet  */
    long seen[LANES];         /* crossings in this step ...                                  */
    long known[LANES];        /* ... of these, the number that an earlier call has stored    */
    double since[LANES];      /* distance of the variable since the last crossing            */
    real direction, zeros;
    bool crossings; /* jobs ask for crossings, of `axis` */
    int axis;
    iso_lane_job *const *next; /* jobs still to be taken */
    size_t waiting;
    const iso_lane_options *options;
    state after; /* at the end of the step */
    form T;      /* last: solve() clears all before it, set_shape() this */
} crew;

/* --- an orbit in parts ------------------------------------------------------------------------------------------ */

/* A lane at the left end of its step. */
typedef struct saved_lane {
    bool there;
    iso_instant left;
    long known;
    double since;
    NUMBER now[CHANNELS][sizeof(state) / sizeof(real)], scale[CHANNELS];
} saved_lane;

static state *channel_now(crew *c, int channel)
{
    return channel == 0 ? &c->T.now : &c->T.deviation[channel];
}

static void save(crew *c, int lane)
{
    const iso_lane_job *job = c->job[lane];
    saved_lane *s = job->saved;
    if (!s) return;
    *s = (saved_lane){true, c->left[lane], c->seen[lane], c->since[lane], {{0}}, {0}};
    for (int i = 0; i < CHANNELS; i++) {
        const real *now = (const real *)channel_now(c, i);
        for (size_t j = 0; j < sizeof(state) / sizeof(real); j++) s->now[i][j] = LANE(now[j], lane);
        s->scale[i] = LANE(c->T.scale[i], lane);
    }
}

static bool recall(crew *c, int lane)
{
    const saved_lane *s = c->job[lane]->saved;
    if (!s || !s->there) return false;
    c->left[lane] = s->left, c->known[lane] = s->known, c->since[lane] = s->since;
    for (int i = 0; i < CHANNELS; i++) {
        real *now = (real *)channel_now(c, i);
        for (size_t j = 0; j < sizeof(state) / sizeof(real); j++) LANE(now[j], lane) = s->now[i][j];
        LANE(c->T.scale[i], lane) = s->scale[i];
    }
    return true;
}

/* --- jobs and lanes --------------------------------------------------------------------------------------------- */

static void next_row(crew *c, int lane)
{
    const iso_lane_job *job = c->job[lane];
    if (job->time && job->done < job->rows) c->row[lane] = job->time[job->done] / job->unit;
}

/* Gives the lane the next job that asks for any rows. */
static void start_next(crew *c, int lane)
{
    c->job[lane] = NULL;
    while (c->waiting > 0 && !c->job[lane]) {
        iso_lane_job *job = *c->next++;
        c->waiting--;
        job->done = 0, job->steps = 0, job->last = 0, job->error = NULL;
        if (job->rows > 0) c->job[lane] = job;
    }
    const iso_lane_job *job = c->job[lane];
    if (!job) return;
    c->left[lane] = (iso_instant){0, 0};
    c->since[lane] = 0, c->known[lane] = 0;
    LANE(c->direction, lane) = job->time && job->time[job->rows - 1] < 0 ? -1 : 1;
    LANE(c->zeros, lane) = job->zeros;
    next_row(c, lane);
    start_orbit(&c->T, lane, job->model, job->start);
    c->fresh[lane] = !recall(c, lane);
}

/* --- what is stored --------------------------------------------------------------------------------------------- */

/* Stores the deviations, their lengths and their angle. */
static void store_look(const form *T, int lane, const state *s, const look *l, iso_lane_event *e)
{
    for (int i = 0; i < ISO_LANE_DEVIATIONS; i++) {
        store_deviation(T, lane, s, &l->deviation[i + 1], e->deviation[i]);
        e->scale[i] = (double)LANE(T->scale[i + 1], lane);
        e->growth[i] = e->scale[i] + 0.5 * log((double)LANE(l->square[i + 1], lane));
    }
    e->sine = (double)LANE(l->sine, lane);
}

/* Stores what the lane's job asks for, where the state is s. l: the deviations there, if they are computed. */
static void store_event(crew *c, int lane, const state *s, const look *l)
{
    form *T = &c->T;
    iso_lane_job *job = c->job[lane];
    double y[ISO_MAX_STATE];
    store(T, lane, s, y);
    if (!all_finite(y, T->shape.dim)) {
        job->error = "the series diverges";
        return;
    }
    if (job->states) memcpy(job->states + job->done * job->stride, y, (size_t)T->shape.dim * sizeof *y);
    if (job->event) {
        memcpy(job->event[job->done].y, y, sizeof y);
        if (CHANNELS > 1) store_look(T, lane, s, l, &job->event[job->done]);
    }
    job->done++;
}

/* Stores the state at x of the series (gained: see state_at) in the lanes that are due. */
static void store_events(crew *c, real x, const real gained[], const bool due[])
{
    state s;
    look l;
    find_state(&c->T, x, gained, &s);
    if (CHANNELS > 1) look_at(&c->T, x, &s, &l);
    for (int i = 0; i < LANES; i++)
        if (due[i]) store_event(c, i, &s, &l);
}

/* The same for crossings, whose times are computed here. */
static void store_crossings(crew *c, real x, const bool due[])
{
    real gained[ISO_CLOCKS];
    const iso_clock clock = c->T.shape.clock;
    integrate_clocks(&c->T, x, gained);
    for (int i = 0; i < LANES; i++)
        if (due[i])
            c->job[i]->passed[c->job[i]->done] = c->left[i].head + (c->left[i].tail + (double)LANE(gained[clock], i));
    store_events(c, x, gained, due);
    for (int i = 0; i < LANES; i++)
        if (due[i]) c->job[i]->steps = 0;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* Whether a lane's next row lies within its step of dt. *target: the time from the step's left end to the row, or
 * 0. */
static bool row_is_due(const crew *c, int lane, double dt, double *target)
{
    const iso_lane_job *job = c->job[lane];
    *target = 0;
    if (!job || job->error || job->done == job->rows) return false;
    const double ahead = iso_instant_since(c->left[lane], c->row[lane]);
    if (!(dt > 0 ? ahead <= dt : ahead >= dt)) return false;
    *target = ahead;
    return true;
}

/* Stores all rows within the step. Each pass takes the next row of every lane that has one. */
static void find_rows(crew *c, real length, real dt)
{
    for (;;) {
        bool due[LANES], found = false;
        real target = zero;
        for (int i = 0; i < LANES; i++) {
            double ahead;
            due[i] = row_is_due(c, i, (double)LANE(dt, i), &ahead);
            LANE(target, i) = ahead;
            found |= due[i];
        }
        if (!found) return;
        store_events(c, solve_for_time(&c->T, target, length * (target / dt)), NULL, due);
        for (int i = 0; i < LANES; i++) {
            if (due[i] && !c->job[i]->error) next_row(c, i);
            if (due[i] && c->job[i]->event) c->job[i]->steps = 0;
        }
    }
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

/* The number of parts of each lane's step, so that n_axis has at most one zero in each part. Gives the largest
 * one. */
static int find_parts(const crew *c, real length, real *parts)
{
    int most = 1;
    *parts = spread(1);
    for (int i = 0; i < LANES; i++) {
        const double own = ceil(fabs((double)(LANE(length, i) * LANE(c->zeros, i))));
        if (c->job[i] && own > 1) LANE(*parts, i) = own < MOST_PARTS ? own : MOST_PARTS;
        if (LANE(*parts, i) > most) most = (int)LANE(*parts, i);
    }
    return most;
}

/* Stores the crossings of lanes in one part of the step, which ends at b. */
static void cross_part(crew *c, real x, const bool crosses[])
{
    bool due[LANES], found = false;
    for (int i = 0; i < LANES; i++) {
        const iso_lane_job *job = c->job[i];
        due[i] = crosses[i] && c->seen[i] >= c->known[i] && !job->error && job->done < job->rows;
        if (crosses[i] && job->done < job->rows) c->seen[i]++;
        found |= due[i];
    }
    if (found) store_crossings(c, x, due);
}

/* Finds all crossings within the step. The signs at its ends are those of the stored states, which two successive
 * steps share. So a zero between two steps is neither missed nor found twice. */
static void find_crossings(crew *c, real length)
{
    const form *T = &c->T;
    real parts;
    const int most = find_parts(c, length, &parts);
    real a = zero, at_a = T->now.n[c->axis];
    for (int i = 0; i < LANES; i++)
        if (c->job[i] && c->job[i]->on_section && c->left[i].head == 0) LANE(at_a, i) = 0;
    for (int part = 1; part <= most; part++) {
        const mask last = parts <= spread((NUMBER)part);
        const real b = choose(last, length, length * ((NUMBER)part / parts));
        const real inside = part < most ? component(T, c->axis, b) : zero;
        const real at_b = choose(last, c->after.n[c->axis], inside);
        const mask passes = both(at_a < zero, at_b >= zero);
        if (any(passes)) {
            bool crosses[LANES];
            const real x = find_crossing(T, c->axis, a, at_a, b, at_b, passes);
            for (int i = 0; i < LANES; i++) crosses[i] = c->job[i] && LANE(passes, i);
            cross_part(c, x, crosses);
            for (int i = 0; i < LANES; i++)
                if (crosses[i]) c->since[i] = -(double)LANE(x, i);
        }
        a = b, at_a = at_b;
    }
}

/* --- steps ------------------------------------------------------------------------------------------------------ */

/* 0 in a lane whose state is finite, else NaN. */
static real check(const state *s)
{
    real sum = zero;
    for (int i = 0; i < 3; i++) sum += s->n[i] + s->w[i];
    for (int i = 0; i < ISO_MOST_EFFECT_STATES; i++) sum += s->own[i];
    for (int i = 0; i < ISO_CLOCKS; i++) sum += s->clock[i];
    return sum - sum;
}

/* Ends the step of a lane, of dt in the model's clock and of x in the variable of the series. */
static void end_step(crew *c, int lane, double dt, double x)
{
    iso_lane_job *job = c->job[lane];
    if (!job) return;
    const double before = c->left[lane].head;
    if (job->done == job->rows) save(c, lane); /* the next part begins with this step */
    c->left[lane] = iso_instant_later(c->left[lane], dt);
    c->since[lane] += x;
    c->known[lane] = 0;
    job->last = isfinite(dt) && !job->error ? c->left[lane].head : before;
    job->steps++;
    if (job->done < job->rows && !job->error) {
        if (!isfinite(dt))
            job->error = "the series diverges";
        else if (fabs(dt) <= 64 * DBL_EPSILON * fabs(before))
            job->error = "steps shrink to nothing";
        else if (c->options->max_steps > 0 && job->steps >= c->options->max_steps)
            job->error = "more steps than allowed";
        else if (c->crossings && c->since[lane] > 2 * job->longest)
            job->error = "the orbit lies in the section and does not cross it";
        else if (c->crossings && fabs(x) * job->zeros > MOST_PARTS)
            job->error = "crossings can lie too close together to be told apart";
    }
}

static bool busy(const crew *c)
{
    for (int i = 0; i < LANES; i++)
        if (c->job[i]) return true;
    return false;
}

static void find_fresh_deviations(crew *c)
{
    bool found = false;
    for (int i = 0; i < LANES; i++) found |= c->fresh[i];
    if (CHANNELS == 1 || !found) return;
    start_deviations(&c->T, c->fresh);
    for (int i = 0; i < LANES; i++) {
        for (int d = 1; d < CHANNELS && c->job[i] && c->fresh[i]; d++)
            store_deviation(&c->T, i, &c->T.now, &c->T.deviation[d], c->job[i]->first[d - 1]);
        c->fresh[i] = false;
    }
}

/* One step in all lanes. A lane whose job is done takes the next job. */
static void step_together(crew *c)
{
    form *T = &c->T;
    find_fresh_deviations(c);
    begin(T);
    expand(&T->S);
    real gained[ISO_CLOCKS];
    const real length = choose_step(T, c->direction, gained), dt = gained[T->shape.clock];
    if (!c->crossings) find_rows(c, length, dt);
    find_state(T, length, gained, &c->after);
    for (int i = 0; i < LANES; i++) c->seen[i] = 0;
    if (c->crossings) find_crossings(c, length);
    const real step = dt + check(&c->after);
    for (int i = 0; i < LANES; i++) end_step(c, i, (double)LANE(step, i), (double)LANE(length, i));
    if (CHANNELS > 1) end_deviations(T, length, &c->after);
    T->now = c->after;
    for (int i = 0; i < LANES; i++)
        if (c->job[i] && (c->job[i]->done == c->job[i]->rows || c->job[i]->error)) start_next(c, i);
}

static bool solve(iso_lane_job *const jobs[], size_t count, const iso_lane_options *options)
{
    crew *c = aligned_alloc(64, (sizeof *c + 63) / 64 * 64);
    if (!c) return false;
    bool going_on = true;
    memset(c, 0, offsetof(crew, T));
    set_shape(&c->T, jobs[0]->model, options->tolerance);
    for (int i = 0; i < LANES; i++)
        start_orbit(&c->T, i, jobs[0]->model, jobs[0]->start); /* a lane without a job needs numbers, too */
    c->direction = spread(1);
    c->options = options;
    c->crossings = !jobs[0]->time;
    c->axis = jobs[0]->axis;
    c->next = jobs;
    c->waiting = count;
    for (int i = 0; i < LANES; i++) start_next(c, i);
    while (busy(c) && going_on) {
        step_together(c);
        going_on = !options->go_on || options->go_on(options->data);
    }
    for (int i = 0; i < LANES; i++)
        if (c->job[i]) c->seen[i] = 0, save(c, i); /* stopped between two steps */
    free(c);
    return going_on;
}
