/* crew_impl.h - solves the jobs of lanes_impl.h, LANES side by side in each of CREWS crews. A lane whose job ends
 * takes the next one. The crews go step by step together: their series are computed in turns (expand_together). */
#include "base/math_impl.h"
#include "method/integrator_impl.h"
#include "method/taylor/crossing_impl.h"
#include "method/taylor/lanes_impl.h"

enum {
    CREWS = CHANNELS > 1 ? 1 : 2, /* the coefficients of two with deviations do not fit the fast memory */
    MOST_PARTS = 4096             /* of a step, in the search for crossings */
};

/* Times are doubles, whatever the numbers of the series. */
typedef double doubles __attribute__((vector_size(LANES * sizeof(double))));
typedef __typeof__((doubles){0} < (doubles){0}) double_mask;

static inline doubles doubles_of(real a)
{
#if LANES == 1
    return (doubles){(double)a};
#else
    return __builtin_convertvector(a, doubles);
#endif
}

static inline doubles size_of(doubles a)
{
    return (doubles)((double_mask)a & ~(double_mask)(-0.0 - (doubles){0}));
}

static inline bool holds_somewhere(double_mask m)
{
#if LANES == 1
    return m[0] != 0;
#else
    return any(m);
#endif
}

/* The jobs that no lane has taken yet. */
typedef struct queue {
    iso_lane_job *const *next;
    size_t waiting;
} queue;

typedef struct crew {
    iso_lane_job *job[LANES]; /* NULL: the lane has no job; it goes on with its last orbit, and nothing is stored */
    doubles head, tail;       /* the time at the step's left end, as iso_instant                           */
    doubles row;              /* the time of the next row, or infinite in the orbit's direction            */
    doubles steps;            /* since the last row                                                        */
    /* Distance of the variable since the last crossing, and the largest possible one; infinite where rows are asked
     * for. */
    doubles since, longest;
    doubles speed, fast; /* |omega|^2; that above which iso_model_speeds_up is asked                      */
    bool fresh[LANES];   /* its first deviations are not set yet                                      */
    long seen[LANES];    /* crossings in this step ...                                                */
    long known[LANES];   /* ... of these, the number that an earlier call has stored                  */
    real direction, zeros;
    bool ended;     /* a lane has stored its last row, or has an error */
    bool claims;    /* of one job: iso_model_has_claim                 */
    bool crossings; /* jobs ask for crossings, of `axis` */
    int axis;
    queue *jobs;
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

static void save(crew *c, int lane)
{
    const iso_lane_job *job = c->job[lane];
    saved_lane *s = job->saved;
    if (!s) return;
    *s = (saved_lane){true, {c->head[lane], c->tail[lane]}, c->seen[lane], c->since[lane], {{0}}, {0}};
    for (int i = 0; i < CHANNELS; i++) {
        const real *now = (const real *)&c->T.channel[i];
        for (size_t j = 0; j < sizeof(state) / sizeof(real); j++) s->now[i][j] = LANE(now[j], lane);
        s->scale[i] = LANE(c->T.scale[i], lane);
    }
}

static bool recall(crew *c, int lane)
{
    const saved_lane *s = c->job[lane]->saved;
    if (!s || !s->there) return false;
    c->head[lane] = s->left.head, c->tail[lane] = s->left.tail;
    c->known[lane] = s->known, c->since[lane] = s->since;
    for (int i = 0; i < CHANNELS; i++) {
        real *now = (real *)&c->T.channel[i];
        for (size_t j = 0; j < sizeof(state) / sizeof(real); j++) LANE(now[j], lane) = s->now[i][j];
        LANE(c->T.scale[i], lane) = s->scale[i];
    }
    return true;
}

/* --- jobs and lanes --------------------------------------------------------------------------------------------- */

static void next_row(crew *c, int lane)
{
    const iso_lane_job *job = c->job[lane];
    const bool wanted = job && job->time && job->done < job->rows && !job->error;
    c->row[lane] = wanted ? job->time[job->done] / job->unit : INFINITY * (double)LANE(c->direction, lane);
}

/* Gives the lane the next job that asks for any rows. */
static void start_next(crew *c, int lane)
{
    c->job[lane] = NULL;
    while (c->jobs->waiting > 0 && !c->job[lane]) {
        iso_lane_job *job = *c->jobs->next++;
        c->jobs->waiting--;
        job->done = 0, job->steps = 0, job->last = 0, job->error = NULL;
        if (job->rows > 0) c->job[lane] = job;
    }
    const iso_lane_job *job = c->job[lane];
    c->T.idle[lane] = !job;
    if (job) {
        c->head[lane] = c->tail[lane] = c->steps[lane] = 0;
        c->since[lane] = 0, c->known[lane] = 0, c->longest[lane] = c->crossings ? 2 * job->longest : INFINITY;
        LANE(c->direction, lane) = job->time && job->time[job->rows - 1] < 0 ? -1 : 1;
        LANE(c->zeros, lane) = job->zeros;
        const double fast = iso_model_fast(job->model, (int)LANE(c->direction, lane), job->start);
        c->fast[lane] = fast * fast;
        start_orbit(&c->T, lane, job->model, job->start);
        c->fresh[lane] = !recall(c, lane);
        c->claims = c->claims || iso_model_has_claim(job->model);
    }
    next_row(c, lane);
}

static void end_job(crew *c, int lane, const char *error)
{
    iso_lane_job *job = c->job[lane];
    job->error = error;
    if (error) store(&c->T, lane, &c->T.now, job->last_y);
    job->steps = (long)c->steps[lane];
    c->ended = true;
}

/* --- what is stored --------------------------------------------------------------------------------------------- */

/* Stores what the lane's job asks for, where the state is s. l: the deviations there, if they are computed. */
static void store_event(crew *c, int lane, const state *s, const look *l)
{
    form *T = &c->T;
    iso_lane_job *job = c->job[lane];
    double y[ISO_MAX_STATE];
    store(T, lane, s, y);
    if (!all_finite(y, T->shape.dim)) {
        job->last = c->head[lane];
        end_job(c, lane, "the series diverges");
        return;
    }
    if (job->states) memcpy(job->states + job->done * job->stride, y, (size_t)T->shape.dim * sizeof *y);
    if (job->event) {
        memcpy(job->event[job->done].y, y, sizeof y);
        if (CHANNELS > 1) store_look(T, lane, s, l, &job->event[job->done]);
    }
    job->done++;
    if (job->event || c->crossings) c->steps[lane] = 0;
    if (job->done == job->rows) end_job(c, lane, NULL);
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
        if (due[i]) c->job[i]->passed[c->job[i]->done] = c->head[i] + (c->tail[i] + (double)LANE(gained[clock], i));
    store_events(c, x, gained, due);
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* Stores all rows within the step. Each pass takes the next row of every lane that has one. */
static void find_rows(crew *c, real length, real dt)
{
    const doubles step = doubles_of(dt), forwards = doubles_of(c->direction);
    for (;;) {
        const doubles ahead = (c->row - c->head) - c->tail; /* from the step's left end to the row */
        const double_mask found = forwards * ahead <= forwards * step;
        if (!holds_somewhere(found)) return;
        bool due[LANES];
        real target = zero;
        for (int i = 0; i < LANES; i++) {
            due[i] = found[i] != 0;
            LANE(target, i) = due[i] ? ahead[i] : 0;
        }
        const real guess = choose(dt == zero, zero, length * (target / dt)); /* dt 0: it ended where it begins */
        store_events(c, solve_for_time(&c->T, target, guess), NULL, due);
        for (int i = 0; i < LANES; i++)
            if (due[i]) next_row(c, i);
    }
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

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
    real parts = broadcast(1); /* of each lane's step, so that n_axis has at most one zero in each */
    int most = 1;
    real a = zero, at_a = T->now.n[c->axis];
    for (int i = 0; i < LANES; i++) {
        const double own = ceil(fabs((double)(LANE(length, i) * LANE(c->zeros, i))));
        if (c->job[i] && own > 1) LANE(parts, i) = own < MOST_PARTS ? own : MOST_PARTS;
        if (LANE(parts, i) > most) most = (int)LANE(parts, i);
        c->seen[i] = 0;
        if (c->job[i] && c->job[i]->on_section && c->head[i] == 0) LANE(at_a, i) = 0;
    }
    for (int part = 1; part <= most; part++) {
        const mask last = parts <= broadcast((NUMBER)part);
        const real b = choose(last, length, length * ((NUMBER)part / parts));
        const real inside = part < most ? component(T, c->axis, b, NULL) : zero;
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

/* Ends the job of a lane that could not take its step of dt in the model's clock and of x in the variable of the
 * series. before: the time at its beginning. */
static void end_failed(crew *c, int lane, double before, double dt, double x)
{
    iso_lane_job *job = c->job[lane];
    if (!job || job->error || job->done == job->rows) return;
    const char *error = NULL;
    if (!isfinite(dt))
        error = "the series diverges";
    else if (fabs(dt) <= 64 * DBL_EPSILON * fabs(before) || is_lost(&c->T, lane, dt))
        error = "steps shrink to nothing";
    else if (c->options->max_steps > 0 && c->steps[lane] >= (double)c->options->max_steps)
        error = "more steps than allowed";
    else if (c->since[lane] > c->longest[lane])
        error = "the orbit lies in the section and does not cross it";
    else if (c->crossings && fabs(x) * job->zeros > MOST_PARTS)
        error = "crossings can lie too close together to be told apart";
    else if (c->speed[lane] > c->fast[lane]) {
        double y[ISO_MAX_STATE];
        store(&c->T, lane, &c->after, y);
        error = iso_model_speeds_up(job->model, (int)LANE(c->direction, lane), job->start, y);
    }
    job->last = isfinite(dt) ? c->head[lane] : before;
    if (error) end_job(c, lane, error);
}

/* Goes to the right end of the step: of dt in the model's clock, NaN where it failed, and of x in the variable of the
 * series. */
static void move_on(crew *c, real dt, real x)
{
    const doubles step = doubles_of(dt), way = doubles_of(x), before = c->head;
    const double most = c->options->max_steps > 0 ? (double)c->options->max_steps : INFINITY;
    const doubles sum = before + step, part = sum - before, lost = (before - (sum - part)) + (step - part);
    const doubles tail = c->tail + lost; /* as iso_instant_later */
    c->head = sum + tail;
    c->tail = tail - (c->head - sum);
    c->since += way;
    c->speed = doubles_of(inner3(c->after.w, c->after.w));
    c->steps += 1;
    for (int i = 0; i < LANES; i++) c->known[i] = 0;
    const double_mask good = (size_of(step) < INFINITY) & (size_of(step) > 64 * DBL_EPSILON * size_of(before)) &
                             (c->steps < most) & (c->since <= c->longest) & (c->speed <= c->fast) &
                             (size_of(way * doubles_of(c->zeros)) <= MOST_PARTS);
    for (int i = 0; holds_somewhere(~good) && i < LANES; i++) end_failed(c, i, before[i], step[i], way[i]);
}

/* The step ends where it is no answer any more, and why[lane] says why: at its beginning if it was moved too far, or
 * where the scene's claim about a torque fails. The first step may start a little off its constraints. */
static void shorten(crew *c, real moved, real *length, real gained[], const char *why[LANES])
{
    const double most = ISO_FALSE_CORRECTION(c->options->tolerance);
    for (int i = 0; i < LANES; i++) {
        if (!c->job[i] || c->head[i] == 0 || !((double)LANE(moved, i) > most)) continue;
        why[i] = ISO_MOVED_TOO_FAR;
        LANE(*length, i) = 0;
    }
    const real whole = *length;
    for (int place = 0; c->claims && place <= ISO_CLAIM_PLACES; place++) {
        const real x = whole * ((NUMBER)place / ISO_CLAIM_PLACES);
        find_state(&c->T, x, NULL, &c->after);
        for (int i = 0; i < LANES; i++) {
            double y[ISO_MAX_STATE];
            char where[ISO_BLAME_SIZE];
            if (!c->job[i] || why[i]) continue;
            store(&c->T, i, &c->after, y);
            why[i] = iso_model_false_claim(c->job[i]->model, y, where);
            if (why[i]) LANE(*length, i) = LANE(x, i);
        }
    }
    integrate_clocks(&c->T, *length, gained);
    find_state(&c->T, *length, gained, &c->after);
}

static void find_fresh_deviations(crew *c)
{
    bool found = false;
    for (int i = 0; i < LANES; i++) found |= c->fresh[i];
    if (CHANNELS == 1 || !found) return;
    start_deviations(&c->T, c->fresh);
    for (int i = 0; i < LANES; i++) {
        for (int d = 1; d < CHANNELS && c->job[i] && c->fresh[i]; d++)
            store_deviation(&c->T, i, &c->T.now, &c->T.channel[d], c->job[i]->first[d - 1]);
        c->fresh[i] = false;
    }
}

/* The step of a crew, when its series are there. */
static void take_step(crew *c)
{
    form *T = &c->T;
    real gained[ISO_CLOCKS], moved, length = choose_near(T, c->direction, gained, &c->after, &moved);
    const char *why[LANES] = {NULL};
    const bool too_far = any(moved > broadcast((NUMBER)ISO_FALSE_CORRECTION(c->options->tolerance)));
    if (c->claims || too_far) shorten(c, moved, &length, gained, why);
    const real dt = gained[T->shape.clock];
    c->crossings ? find_crossings(c, length) : find_rows(c, length, dt);
    for (int i = 0; (c->claims || too_far) && i < LANES; i++) {
        iso_lane_job *job = c->job[i];
        if (!job || !why[i] || job->error || job->done == job->rows) continue;
        end_job(c, i, why[i]);
        store(T, i, &c->after, job->last_y);
        job->last = c->head[i] + (c->tail[i] + (double)LANE(dt, i));
    }
    for (int i = 0; c->ended && i < LANES; i++) /* the next part of an orbit begins with this step */
        if (c->job[i] && c->job[i]->done == c->job[i]->rows) save(c, i);
    real sum = zero; /* sum - sum: 0 in a lane whose state is finite, else NaN */
    for (int i = 0; i < 3; i++) sum += c->after.n[i] + c->after.w[i];
    for (int i = 0; i < T->shape.moving - ISO_STATE; i++) sum += c->after.own[i];
    for (int i = 0; i < T->shape.clocks; i++) sum += c->after.clock[T->shape.clock_of[i]];
    move_on(c, dt + (sum - sum), length);
    if (CHANNELS > 1) end_deviations(T, length, &c->after);
    copy_state(T, &T->now, &c->after);
    for (int i = 0; c->ended && i < LANES; i++) /* new jobs for the lanes whose job has ended */
        if (c->job[i] && (c->job[i]->done == c->job[i]->rows || c->job[i]->error)) start_next(c, i);
    c->ended = false;
}

/* One step of the crews that have jobs. Returns their number. */
static int step_together(crew *const crews[CREWS])
{
    crew *at_work[CREWS];
    series *S[CREWS];
    int count = 0;
    for (int i = 0; i < CREWS; i++) {
        bool busy = false;
        for (int lane = 0; lane < LANES; lane++) busy |= crews[i]->job[lane] != NULL;
        if (busy) at_work[count] = crews[i], S[count++] = &crews[i]->T.S;
    }
    for (int i = 0; i < count; i++) {
        find_fresh_deviations(at_work[i]);
        begin(&at_work[i]->T);
    }
    if (count > 0) expand_together(S, count);
    for (int i = 0; i < count; i++) take_step(at_work[i]);
    return count;
}

static bool solve(iso_lane_job *const jobs[], size_t count, const iso_lane_options *options)
{
    const size_t size = (sizeof(crew) + 63) / 64 * 64;
    iso_inside *inside; /* for all lanes: where their texts differ, they are read again */
    if (!iso_inside_create(&jobs[0]->model->problem, &inside)) return false;
    char *room = aligned_alloc(64, CREWS * size);
    if (!room) return iso_inside_free(inside), false;
    queue waiting = {jobs, count};
    crew *crews[CREWS];
    for (int i = 0; i < CREWS; i++) {
        crew *c = crews[i] = (crew *)(room + (size_t)i * size);
        memset(c, 0, offsetof(crew, T));
        set_shape(&c->T, jobs[0]->model, inside, options->tolerance);
        for (int lane = 0; lane < LANES; lane++) /* a lane without a job needs numbers, too */
            start_orbit(&c->T, lane, jobs[0]->model, jobs[0]->start);
        c->direction = broadcast(1);
        c->options = options, c->jobs = &waiting;
        c->crossings = !jobs[0]->time, c->axis = jobs[0]->axis;
        for (int lane = 0; lane < LANES; lane++) start_next(c, lane);
    }
    bool going_on = true;
    while (going_on && step_together(crews) > 0) going_on = !options->go_on || options->go_on(options->data);
    for (int i = 0; i < CREWS * LANES; i++) { /* stopped between two steps */
        crew *c = crews[i / LANES];
        if (c->job[i % LANES]) c->seen[i % LANES] = 0, save(c, i % LANES);
    }
    free(room);
    iso_inside_free(inside);
    return going_on;
}
