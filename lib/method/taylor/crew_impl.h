/* crew_impl.h - solves the jobs of lanes_impl.h, LANES side by side. A lane whose job ends takes the next one. */
#include "base/finite_impl.h"
#include "method/integrator_impl.h"
#include "method/taylor/lanes_impl.h"
#include "method/taylor/restore_impl.h"

typedef struct crew {
    iso_lane_job *job[LANES]; /* NULL: the lane has no job; it goes on with its last orbit, and nothing is stored */
    iso_instant left[LANES];  /* the time at the step's left end */
    double row[LANES];        /* the time of the next row */
    real direction;
    iso_lane_job *const *next; /* jobs still to be taken */
    size_t waiting;
    const iso_lane_options *options;
    form T; /* last: solve() clears all before it, set_shape() this */
} crew;

static void next_row(crew *c, int lane)
{
    const iso_lane_job *job = c->job[lane];
    if (job->done < job->rows) c->row[lane] = job->time[job->done] / job->unit;
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
    LANE(c->direction, lane) = job->time[job->rows - 1] < 0 ? -1 : 1;
    next_row(c, lane);
    start_orbit(&c->T, lane, job->model, job->start);
}

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
static void output(crew *c, real length, real dt)
{
    form *T = &c->T;
    state s;
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
        find_state(T, solve_for_time(T, target, length * (target / dt)), &s);
        for (int i = 0; i < LANES; i++) {
            if (!due[i]) continue;
            iso_lane_job *job = c->job[i];
            double *row = job->states + job->done * job->stride;
            store(T, i, &s, row);
            if (all_finite(row, T->shape.dim))
                job->done++;
            else
                job->error = "the series diverges";
            if (!job->error) next_row(c, i);
        }
    }
}

/* 0 in a lane whose state is finite, else NaN. */
static real check(const state *s)
{
    real sum = zero;
    for (int i = 0; i < 3; i++) sum += s->n[i] + s->w[i];
    for (int i = 0; i < ISO_MOST_EFFECT_STATES; i++) sum += s->own[i];
    for (int i = 0; i < ISO_CLOCKS; i++) sum += s->clock[i];
    return sum - sum;
}

static void end_step(crew *c, int lane, double dt)
{
    iso_lane_job *job = c->job[lane];
    if (!job) return;
    const double before = c->left[lane].head;
    c->left[lane] = iso_instant_later(c->left[lane], dt);
    job->last = isfinite(dt) && !job->error ? c->left[lane].head : before;
    job->steps++;
    if (job->done < job->rows && !job->error) {
        if (!isfinite(dt))
            job->error = "the series diverges";
        else if (fabs(dt) <= 64 * DBL_EPSILON * fabs(before))
            job->error = "steps shrink to nothing";
        else if (c->options->max_steps > 0 && job->steps >= c->options->max_steps)
            job->error = "more steps than allowed";
    }
    if (job->done == job->rows || job->error) start_next(c, lane);
}

static bool busy(const crew *c)
{
    for (int i = 0; i < LANES; i++)
        if (c->job[i]) return true;
    return false;
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
    c->next = jobs;
    c->waiting = count;
    for (int i = 0; i < LANES; i++) start_next(c, i);
    while (busy(c) && going_on) {
        begin(&c->T);
        expand(&c->T.S);
        real gained[ISO_CLOCKS];
        const real length = choose_step(&c->T, c->direction, gained), dt = gained[c->T.shape.clock];
        output(c, length, dt);
        find_state(&c->T, length, &c->T.now);
        const real step = dt + check(&c->T.now);
        for (int i = 0; i < LANES; i++) end_step(c, i, (double)LANE(step, i));
        going_on = !options->go_on || options->go_on(options->data);
    }
    free(c);
    return going_on;
}
