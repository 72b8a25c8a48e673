/* The closed solution as a backend: every picture and clock against the orbits by steps, events, refusals. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "laws.h"
#include "model/model_impl.h"
#include "numbers.h"
#include "orbit/batch.h"
#include "orbit/orbit_impl.h"
#include "scenes.h"

static iso_context *ctx;

/* The same bits, but for NaNs, which only must be in the same places. */
static bool same(const iso_sample *a, const iso_sample *b)
{
    for (int c = 0; c < ISO_TRAJECTORY_COLUMNS; c++) {
        const double x = iso_sample_column(a, c), y = iso_sample_column(b, c);
        if (!(x == y) && !(isnan(x) && isnan(y))) return false;
    }
    return true;
}

/* --- orbits that have one --------------------------------------------------------------------------------------- */

enum { SEPARATED = 8, PROBLEMS = SEPARATED + 3 };
static const double shapes[SEPARATED / 2][3] = {{1.4, 2.1, 3.0}, {3, 1.4, 2.1}, {0.5, 1, 0.7}, {1, 1.02, 1.1}};

typedef struct problem {
    iso_params p;
    iso_start start;
} problem;

/* Two equal moments, a principal plane, Neumann's problem off the level H = 0. */
static problem make_special(int i)
{
    static const double equal[3] = {1.4, 2.1, 1.4}, J[3] = {1.4, 2.1, 3.0};
    const iso_start ball = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    const iso_start plane = {.model = ISO_BALL, .y = {0, 0, 1.1, 0.6, 0.8, 0}};
    const iso_start point = {.model = ISO_POINT, .y = {0.64, 1, -0.48, 0.6, 0, 0.8}, .eps = 2};
    return (problem[]){
        {laws_params(0.6, equal), ball}, {laws_params(-0.7, J), plane}, {laws_params(-1, J), point}}[i];
}

/* Balls and points, of both k and moments in every kind of order; then the special ones. */
static problem make_problem(int i, iso_random *random)
{
    if (i >= SEPARATED) return make_special(i - SEPARATED);
    problem o = {.p = laws_params(i % 2 ? 1 : -1, shapes[i / 2])};
    const bool ball = i / 2 % 2 == 0;
    iso_problem f = {.p = o.p};
    o.start.model = ball ? ISO_BALL : ISO_POINT;
    laws_sample(ball ? &iso_system_ball : &iso_system_point, &f, random, o.start.y);
    o.start.eps = ball ? 0 : f.eps;
    return o;
}

/* --- against the orbits by steps -------------------------------------------------------------------------------- */

enum { TIMES = 6 };
static const double times[TIMES] = {0.3, 4, 20, -0.7, -9, 60};

/* The orbits by steps are made at tolerance 1e-14, and run to 60 own units. */
static const double ALLOWED = 1e-12;

static void note_difference(laws_worst *worst, const iso_params *p, const iso_sample *a, const iso_sample *b,
                            const char *what)
{
    laws_note(worst, laws_distance(a->ball, b->ball) / laws_norm(b->ball), ALLOWED, p, what);
    laws_note(worst, laws_distance(a->ball + 3, b->ball + 3), ALLOWED, p, what);
    laws_note(worst, laws_distance(a->point, b->point) / laws_norm(b->point), ALLOWED, p, what);
    laws_note(worst, laws_distance(a->point + 3, b->point + 3), ALLOWED, p, what);
    for (int c = 0; c < ISO_CLOCKS; c++) laws_note(worst, fabs(a->clock[c] / b->clock[c] - 1), ALLOWED, p, what);
}

/* What one time of the clock is in the ball's own unit of time, about. */
static double unit_of(const iso_orbit *orbit, iso_clock clock)
{
    const iso_units *u = iso_orbit_units(orbit);
    const double middle = (u->own.J[0] + u->own.J[1] + u->own.J[2]) / 3;
    return iso_unit(u, iso_clock_dimension(clock)) * iso_clock_rate(&u->own, clock, middle, NULL);
}

static void check_against_steps(const problem *o, laws_worst *worst)
{
    for (iso_clock clock = 0; clock < ISO_CLOCKS; clock++) {
        iso_orbit *exact = scene_whole(ctx, &o->p, &o->start, ISO_BACKEND_EXACT, clock);
        for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
            iso_orbit *steps = scene_whole(ctx, &o->p, &o->start, backend, clock);
            const iso_sample begin = scene_at(ctx, steps, 0), begin_exact = scene_at(ctx, exact, 0);
            gsl_test(backend == ISO_BACKEND_POINT && !same(&begin, &begin_exact), "the start is the point's");
            for (int i = 0; i < TIMES; i++) {
                const double time = times[i] * unit_of(exact, clock);
                const iso_sample a = scene_at(ctx, exact, time), b = scene_at(ctx, steps, time);
                note_difference(worst, &o->p, &a, &b, iso_backend_name((int)backend));
            }
            iso_orbit_free(steps);
        }
        iso_orbit_free(exact);
    }
}

/* Asked for less, an orbit shows the same numbers, and no others. */
static void check_shows(const problem *o)
{
    iso_orbit *all = scene_whole(ctx, &o->p, &o->start, ISO_BACKEND_EXACT, ISO_CLOCK_T);
    const iso_sample whole = scene_at(ctx, all, 7);
    for (iso_models shown = ISO_SHOW_BALL; shown <= ISO_SHOW_BOTH; shown++) {
        iso_orbit_options less = scene_all(&o->start, ISO_BACKEND_EXACT, ISO_CLOCK_T);
        less.shown = shown;
        less.with_clock[ISO_CLOCK_TAU] = false;
        iso_orbit *orbit = scene_by(ctx, &o->p, &o->start, &less);
        iso_sample wanted = whole;
        wanted.clock[ISO_CLOCK_TAU] = NAN;
        for (int i = 0; i < ISO_STATE; i++) {
            if (shown == ISO_SHOW_POINT) wanted.ball[i] = NAN;
            if (shown == ISO_SHOW_BALL) wanted.point[i] = NAN;
        }
        const iso_sample s = scene_at(ctx, orbit, 7);
        gsl_test(!same(&s, &wanted), "what is shown of %s", iso_models_name((int)shown));
        iso_orbit_free(orbit);
    }
    iso_orbit_free(all);
}

static double third_of_n(const iso_sample *sample, const void *data)
{
    (void)data;
    return sample->ball[5];
}

static bool next_event(iso_orbit *orbit, int direction, double from, double to, iso_sample *sample)
{
    bool found;
    laws_stop_if(ctx, iso_orbit_event(orbit, third_of_n, NULL, direction, from, to, &found, sample) != ISO_OK,
                 "an event");
    return found;
}

/* --- events ----------------------------------------------------------------------------------------------------- */

/* The same zeros of n3 as along the orbit by steps, one after the other. */
static void check_events(const problem *o, int side, laws_worst *worst)
{
    iso_orbit *exact = scene_whole(ctx, &o->p, &o->start, ISO_BACKEND_EXACT, ISO_CLOCK_T);
    iso_orbit *steps = scene_whole(ctx, &o->p, &o->start, ISO_BACKEND_POINT, ISO_CLOCK_T);
    const double end = side * 30 * unit_of(exact, ISO_CLOCK_T);
    double from = 0;
    for (int direction = -1; direction <= 1; direction++)
        for (int i = 0;; i++) {
            iso_sample a, b;
            if (i == 0) from = 0;
            const bool found = next_event(exact, direction, from, end, &a);
            gsl_test(found != next_event(steps, direction, from, end, &b), "event %d after %g", i, from);
            if (!found) break;
            laws_note(worst, fabs(a.clock[0] - b.clock[0]) / fabs(end), ALLOWED, &o->p, "time");
            laws_note(worst, fabs(a.ball[5]), 1e-14 * 30, &o->p, "n3");
            const iso_sample again = scene_at(ctx, exact, a.clock[0]);
            gsl_test(!same(&a, &again), "the state at the event is that of its time");
            from = a.clock[0];
        }
    iso_orbit_free(exact);
    iso_orbit_free(steps);
}

/* Far away an event is found without the way there. */
static void check_far_events(const problem *o)
{
    iso_orbit *orbit = scene_whole(ctx, &o->p, &o->start, ISO_BACKEND_EXACT, ISO_CLOCK_T);
    const double unit = unit_of(orbit, ISO_CLOCK_T), far[3] = {1e6 * unit, -1e6 * unit, 1e9 * unit};
    iso_sample s;
    for (int i = 0; i < 3 && next_event(orbit, 0, 0, 100 * unit, &s); i++) {
        const double way = copysign(100 * unit, far[i]), close = 64 * DBL_EPSILON * fabs(far[i]);
        const long before = iso_orbit_statistics(orbit).states;
        gsl_test(!next_event(orbit, 0, far[i], far[i] + way, &s), "an event behind t = %g", far[i]);
        gsl_test(iso_orbit_statistics(orbit).states - before > 5000, "found without stepping there: %ld states",
                 iso_orbit_statistics(orbit).states - before);
        iso_sample a = scene_at(ctx, orbit, s.clock[0] - close), b = scene_at(ctx, orbit, s.clock[0] + close);
        gsl_test(!(a.ball[5] * b.ball[5] < 0), "n3 passes 0 at t = %.17g: %g, %g", s.clock[0], a.ball[5], b.ball[5]);
        const bool earlier = next_event(orbit, 0, far[i], s.clock[0] - copysign(close, far[i]), &b);
        gsl_test(earlier, "it is the first");
    }
    iso_orbit_free(orbit);
}

/* --- errors ----------------------------------------------------------------------------------------------------- */

/* Refused, about that, with these words. */
static void refused(const iso_params *p, const iso_start *start, const iso_orbit_options *o, const char *about,
                    const char *words)
{
    iso_orbit *orbit;
    const iso_status status = iso_orbit_create(ctx, p, start, o, &orbit);
    gsl_test(status != ISO_BAD_ARGUMENT || orbit || strcmp(iso_context_about(ctx), about) != 0 ||
                 !strstr(iso_context_message(ctx), words),
             "refused for \"%s\": %s", about, status == ISO_OK ? "done" : iso_context_message(ctx));
    iso_orbit_free(orbit);
}

static void check_effects_refused(const iso_params *p, const iso_start *start)
{
    const struct {
        iso_effect_id effect;
        const char *instead;
    } effects[] = {{ISO_GRAVITY, "backend ball"},  {ISO_FIELD, "backend point"},
                   {ISO_TWIST, "backend ball"},    {ISO_ROLLING_RESISTANCE, "backend ball"},
                   {ISO_ATTITUDE, "backend ball"}, {ISO_REACTIONS, "backend ball"},
                   {ISO_ROTOR, "backend point"}};
    for (size_t i = 0; i < sizeof effects / sizeof *effects; i++) {
        iso_effects e = {.number = {[ISO_GRAVITY] = {0.7, 0, 0.6, 0.8},
                                    [ISO_TWIST] = {10},
                                    [ISO_ROLLING_RESISTANCE] = {0.01},
                                    [ISO_ROTOR] = {0.1, 0.2, 0.3}}};
        iso_orbit_options o = scene_all(start, ISO_BACKEND_EXACT, ISO_CLOCK_T);
        QUATERNION(&e)[0] = 1;
        e.on[effects[i].effect] = true;
        o.effects = &e;
        refused(p, start, &o, iso_effect_list[effects[i].effect]->name, effects[i].instead);
    }
}

static bool never(void *data)
{
    (void)data;
    return false;
}

static void check_times(const problem *o)
{
    iso_orbit *orbit = scene_whole(ctx, &o->p, &o->start, ISO_BACKEND_EXACT, ISO_CLOCK_T);
    const double wrong[] = {NAN, INFINITY, -INFINITY, 1e30};
    iso_sample s;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        gsl_test(iso_orbit_at(orbit, wrong[i], &s) != ISO_BAD_ARGUMENT, "t = %g is refused", wrong[i]);
    iso_context_set_monitor(ctx, never, NULL);
    gsl_test(iso_orbit_at(orbit, 3, &s) != ISO_STOPPED, "stopped on request");
    iso_context_set_monitor(ctx, NULL, NULL);
    gsl_test(iso_orbit_at(orbit, 3, &s) != ISO_OK || iso_orbit_reached(orbit) != 3, "and goes on");
    iso_orbit_free(orbit);
}

static void check_errors(const problem *o)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    const iso_params half = laws_params(0.5, J);
    const iso_start ball = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    iso_start neither = ball;
    neither.model = (iso_model_kind)4;
    iso_orbit_options exact = scene_all(&ball, ISO_BACKEND_EXACT, ISO_CLOCK_T), other = exact;
    refused(&half, &ball, &exact, "k", "take backend point");
    check_effects_refused(&o->p, &ball);
    other.method = iso_method_find("taylor");
    refused(&o->p, &ball, &other, "method", "backend exact does not integrate");
    other = exact, other.shown = (iso_models)4;
    refused(&o->p, &ball, &other, "backend", "shown as ball, point or both");
    refused(&o->p, &neither, &exact, "", "starts as a ball or as a point");
    iso_batch_options batch = iso_batch_defaults();
    const iso_batch_orbit one = {&o->p, &ball, NULL};
    batch.backend = ISO_BACKEND_EXACT;
    iso_sample s;
    gsl_test(iso_batch_run(ctx, &one, 1, &batch, (double[]){1}, 1, &s, NULL) != ISO_BAD_ARGUMENT ||
                 strcmp(iso_context_about(ctx), "backend") != 0,
             "a batch refuses: %s", iso_context_message(ctx));
}

/* What an orbit says of itself. */
static void check_described(const problem *o)
{
    for (int b = 0; b < 4; b++) {
        const iso_backend asked =
            (iso_backend[]){ISO_BACKEND_BALL, ISO_BACKEND_POINT, ISO_BACKEND_EXACT, ISO_BACKEND_AUTO}[b];
        iso_orbit *orbit = scene_whole(ctx, &o->p, &o->start, asked, ISO_CLOCK_T);
        const iso_backend backend = iso_orbit_backend(orbit);
        gsl_test(backend != (asked == ISO_BACKEND_AUTO ? (iso_backend)o->start.model : asked), "backend %s",
                 iso_backend_name((int)asked));
        gsl_test((iso_orbit_exact(orbit) != NULL) != (asked == ISO_BACKEND_EXACT), "whose closed solution");
        scene_at(ctx, orbit, 1);
        const bool walked = iso_orbit_statistics(orbit).steps > 0;
        gsl_test(walked != (asked != ISO_BACKEND_EXACT), "steps, and none");
        iso_orbit_free(orbit);
    }
}

int main(void)
{
    laws_worst steps = {0}, events = {0};
    iso_random *random = iso_random_create(5);
    ctx = iso_context_create();
    for (int i = 0; i < PROBLEMS; i++) {
        const problem o = make_problem(i, random);
        check_against_steps(&o, &steps);
        check_shows(&o);
        check_events(&o, i % 3 ? 1 : -1, &events);
        check_far_events(&o);
        check_times(&o);
        check_described(&o);
        if (i == 0) check_errors(&o);
    }
    laws_report(&steps, "the closed solution against the orbit by steps");
    laws_report(&events, "events against those along the orbit by steps");
    iso_random_free(random);
    iso_context_free(ctx);
    return gsl_test_summary();
}
