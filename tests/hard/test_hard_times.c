/* Times: at and next to the start, beyond all turns, in any order, at the ends of steps, in both clocks. */
#include "hard.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;
static iso_params params;
static iso_start start;
static const double J[3] = {1.4, 2.1, 3.0}, omega[3] = {0.9, -0.3, -0.225}, normal[3] = {0.36, 0.48, 0.8};

/* Every vector of the start turns by less than this in a unit of t; dn/dt = n x omega, and omega as fast. */
enum { FASTEST = 2 };

static iso_orbit *open_orbit(const hard_road *way, bool both, iso_clock clock)
{
    iso_orbit *orbit = NULL;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.backend = way->backend, o.method = way->method, o.tolerance = way->tolerance, o.clock = clock;
    if (both) o.shown = ISO_SHOW_BOTH;
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = both;
    const iso_status status = iso_orbit_create(ctx, &params, &start, &o, &orbit);
    gsl_test(status != ISO_OK, "an orbit by %s: %s", way->method ? way->method->name : "exact",
             iso_context_message(ctx));
    return orbit;
}

/* NaN in every column where there is no answer. */
static iso_sample ask(iso_orbit *orbit, double time)
{
    iso_sample sample;
    if (iso_orbit_at(orbit, time, &sample) == ISO_OK) return sample;
    for (int c = 0; c < ISO_TRAJECTORY_COLUMNS; c++) iso_sample_set_column(&sample, c, NAN);
    return sample;
}

static double apart(double a, double b)
{
    return a == b ? 0 : fabs(a - b) / fmax(fabs(a), fabs(b));
}

/* The larger of two; NaN stays. */
static double worse(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

/* The state moves by FASTEST |t| at most, to the 16 roundings of a start that goes through the point and is projected
 * back, magnified by max J/min J. The clocks are their rates at the start times t, up to the change of these. Only
 * bdf interpolates over its step, and is as good as that: to its tolerance. */
static void check_near(void)
{
    static const double times[] = {0, -0.0, DBL_TRUE_MIN, 1e-300, -1e-300, 1e-17, -1e-17, 1e-9, -1e-9};
    enum { TIMES = sizeof times / sizeof *times };
    const double spread = 3.0 / 1.4, rounding = 16 * DBL_EPSILON * spread, g = dot_diag(normal, params.inv_J, normal);
    double rate[ISO_CLOCKS];
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) rate[c] = iso_clock_rate(&params, c, 1 / g, NULL);
    hard_case("next to the start", "the start, moved by a rate times t; tau and s, relative to themselves",
              "a clock that is a difference of numbers of a turn's size has none of its digits left");
    for (int w = 0; w < hard_ways; w++) {
        iso_orbit *orbit = open_orbit(&hard_way[w], true, ISO_CLOCK_T);
        const bool bdf = hard_way[w].method == iso_method_find("bdf");
        double worst = 0;
        for (int i = 0; i < TIMES; i++) {
            const iso_sample s = ask(orbit, times[i]);
            const double allowed = rounding + FASTEST * fabs(times[i]);
            worst = worse(hard_error(s.ball, start.y) / allowed, worst);
            const bool counts = times[i] != 0 && fabs(times[i]) >= DBL_MIN;
            const double lost = bdf ? hard_way[w].tolerance * fabs(iso_orbit_reached(orbit) / times[i]) : 0;
            for (int c = 0; c < ISO_CLOCKS && counts; c++)
                worst = worse(apart(s.clock[c], rate[c] * times[i]) / (allowed + lost), worst);
            if (times[i] == 0) worst = worse(fabs(s.clock[ISO_CLOCK_TAU]) + fabs(s.clock[ISO_CLOCK_S]), worst);
        }
        hard_hold(&hard_way[w], worst, 1);
        iso_orbit_free(orbit);
    }
    const double turn = 5, t = 1e-9; /* what is counted from another place of the orbit */
    hard_naive("a clock as the difference of two", apart((turn + t) - turn, t) / (rounding + FASTEST * t), 1);
}

/* --- too far ---------------------------------------------------------------------------------------------------- */

static double height(const iso_sample *sample, const void *data)
{
    (void)data;
    return sample->ball[5];
}

static void check_far(void)
{
    static const double times[] = {1e300, -1e300, DBL_MAX, INFINITY, -INFINITY, NAN};
    hard_case("beyond 1e15 turns", "refused", "one ulp of the time is more than a turn");
    for (int w = 0; w < hard_ways; w++) {
        iso_orbit *orbit = open_orbit(&hard_way[w], false, ISO_CLOCK_T);
        bool refused = true, found;
        iso_sample sample;
        for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
            refused = refused && iso_orbit_check_time(orbit, times[i]) == ISO_BAD_ARGUMENT;
            refused = refused && iso_orbit_at(orbit, times[i], &sample) == ISO_BAD_ARGUMENT;
            refused = refused && strstr(iso_context_message(ctx), "can be told apart");
            refused = refused && iso_orbit_event(orbit, height, NULL, 0, 0, times[i], &found, &sample) != ISO_OK;
            refused = refused && !found;
        }
        hard_refused(&hard_way[w], refused, "out of range");
        const iso_status event = iso_orbit_event(orbit, height, NULL, 0, 0, 1e-300, &found, &sample);
        gsl_test(event != ISO_OK || found, "no event in the first 1e-300");
        iso_orbit_free(orbit);
    }
    hard_naive("the angle 1e300, reduced to a turn, an ulp of time later",
               fabs(remainder(1e300, 6.283185307179586) - remainder(nextafter(1e300, INFINITY), 6.283185307179586)),
               1e-3);
}

/* --- any order -------------------------------------------------------------------------------------------------- */

/* How many numbers of two samples differ in a bit. */
static int differing(const iso_sample *a, const iso_sample *b)
{
    int count = 0;
    for (int c = ISO_CLOCKS; c < ISO_TRAJECTORY_COLUMNS; c++) {
        const double x = iso_sample_column(a, c), y = iso_sample_column(b, c);
        count += memcmp(&x, &y, sizeof x) != 0;
    }
    return count;
}

/* Sorted away from the start, after it and then before it; with the end of a step, and what is one ulp beside it. */
enum { MANY = 40 };
/* --- ends of steps ---------------------------------------------------------------------------------------------- */

/* The state at the end of a step is the method's, beside it what dense output or a polynomial says from the step's
 * other end: apart by an error of a step each, in each component at most `tolerance` of its size, times max J/min J
 * from model to model; to rounding. */
static double allowed_jump(const hard_road *way)
{
    return 2 * sqrt(3) * 3.0 / 1.4 * way->tolerance + 32 * DBL_EPSILON;
}

/* The jump where the state within a step is a straight line from its beginning. */
static double straight(void)
{
    const hard_road way = {ISO_BACKEND_BALL, iso_method_find("rk8pd"), 1e-12};
    iso_orbit *orbit = open_orbit(&way, false, ISO_CLOCK_T);
    ask(orbit, 1);
    const double begin = iso_orbit_reached(orbit), moment = 1e-6;
    iso_sample a = ask(orbit, begin);
    const iso_sample b = ask(orbit, begin + moment);
    const double end = iso_orbit_reached(orbit);
    const iso_sample there = ask(orbit, end);
    for (int i = 0; i < ISO_STATE; i++) a.ball[i] += (b.ball[i] - a.ball[i]) / moment * (end - begin);
    iso_orbit_free(orbit);
    return hard_error(a.ball, there.ball) / allowed_jump(&way);
}

static void check_ends(void)
{
    hard_case("ends of steps", "the jump of the state over an ulp of time, in tolerances",
              "the end of one step and the beginning of the next are found by different formulas");
    for (int w = 0; w < hard_ways; w++) {
        iso_orbit *orbit = open_orbit(&hard_way[w], false, ISO_CLOCK_T);
        double worst = 0;
        for (int i = 1; i <= 10; i++) {
            const double time = i % 2 == 0 ? 0.9 * i : -0.7 * i;
            ask(orbit, time);
            const double end = iso_orbit_reached(orbit);
            const iso_sample before = ask(orbit, nextafter(end, 0)), at = ask(orbit, end),
                             after = ask(orbit, nextafter(end, 2 * end));
            const double allowed = allowed_jump(&hard_way[w]);
            worst = worse(hard_error(before.ball, at.ball) / allowed, worst);
            worst = worse(hard_error(after.ball, at.ball) / allowed, worst);
        }
        hard_hold(&hard_way[w], worst, 1);
        iso_orbit_free(orbit);
    }
    hard_naive("straight lines to within a step", straight(), 1);
}

/* An orbit in t says where s is; an orbit in s is asked there. Each step of both adds an error of at most the
 * tolerance to state and clock, and errors of the state move the clocks: twice that over these few turns. */
static void check_clocks(void)
{
    static const double times[] = {7, -7, 1e-5, -40};
    hard_case("t and s", "states and clocks of an orbit in t and of the same in s, in steps times tolerances",
              "an error in one clock is an error of the state in the other");
    for (int w = 0; w < hard_ways; w++) {
        iso_orbit *in_t = open_orbit(&hard_way[w], true, ISO_CLOCK_T),
                  *in_s = open_orbit(&hard_way[w], true, ISO_CLOCK_S);
        double worst = 0;
        for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
            const iso_sample a = ask(in_t, times[i]), b = ask(in_s, a.clock[ISO_CLOCK_S]);
            const long steps = iso_orbit_statistics(in_t).steps + iso_orbit_statistics(in_s).steps;
            const double allowed = 2 * (double)(1 + steps) * fmax(hard_way[w].tolerance, 1e-14);
            worst = worse(hard_error(a.ball, b.ball) / allowed, worst);
            worst = worse(hard_error(a.point, b.point) / allowed, worst);
            for (int c = 0; c < ISO_CLOCKS; c++) worst = worse(apart(a.clock[c], b.clock[c]) / allowed, worst);
        }
        hard_hold(&hard_way[w], worst, 1);
        iso_orbit_free(in_t);
        iso_orbit_free(in_s);
    }
}

/* --- ten million ------------------------------------------------------------------------------------------------ */

/* Grid times are products, each rounded once: their error does not grow with their number. */
static void check_grid(void)
{
    iso_scene scene = iso_scene_default();
    scene.end = 1e6, scene.step = 0.1;
    const size_t rows = iso_scene_rows(&scene);
    double worst = 0, sum = 0, drift = 0;
    hard_case("ten million times", "the times of a grid, in ulps",
              "sums of steps lose a digit with each ten times as many");
    gsl_test(rows != 10000001, "%zu rows", rows);
    for (size_t i = 1; i < rows; i++) {
        const long double exact = 0.1L * (long double)i;
        sum += scene.step;
        const double ulp = DBL_EPSILON * (double)exact;
        worst = worse((double)fabsl((long double)iso_scene_time(&scene, i) - exact) / ulp, worst);
        drift = worse((double)fabsl((long double)sum - exact) / ulp, drift);
    }
    hard_hold(NULL, worst, 1);
    hard_naive("t += step", drift, 1);
}

/* A million of them asked of orbits: as many steps as one time takes, and its answer. */
static void check_many(void)
{
    enum { ROWS = 1000000 };
    const double end = 100;
    hard_case("a million rows", "numbers that differ from the last row asked alone, and steps beyond its steps",
              "a step for each row would be 1e6 of them");
    for (int w = 0; w < hard_ways; w++) {
        const iso_method *m = hard_way[w].method;
        if (m && strcmp(m->name, "taylor") != 0) continue; /* others take a step to each row: the same code, slower */
        iso_orbit *orbit = open_orbit(&hard_way[w], false, ISO_CLOCK_T),
                  *alone = open_orbit(&hard_way[w], false, ISO_CLOCK_T);
        iso_sample row = {.clock = {0}};
        for (int i = 1; i <= ROWS; i++) row = ask(orbit, end * i / ROWS);
        const iso_sample last = ask(alone, end);
        const long more = iso_orbit_statistics(orbit).steps - iso_orbit_statistics(alone).steps;
        hard_hold(&hard_way[w], differing(&row, &last) + (double)more, 0);
        iso_orbit_free(orbit);
        iso_orbit_free(alone);
    }
}

int main(void)
{
    ctx = iso_context_create();
    params = laws_params(-1, J);
    if (iso_start_ball(ctx, omega, normal, ISO_SPIN_REFUSE, &start) != ISO_OK) return 1;
    hard_topic("7. Times");
    check_near();
    check_far();
    check_ends();
    check_clocks();
    check_grid();
    check_many();
    iso_context_free(ctx);
    return hard_summary();
}
