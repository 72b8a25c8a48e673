/* A million spins of a free ball: what must not drift does not, and phases go wrong no faster than their methods
 * promise.
 *
 * A spin is 1/|omega| at the start, the time in which the ball turns by a radian. At full length (length.h) the
 * fastest methods go a million spins, at short length 1e5; the others go less far.
 */
#include "hard_long.h"
#include "method/integrator_impl.h"

static iso_context *ctx;
static long_run runs[HARD_WAYS];

static const hard_road by_exact = {ISO_BACKEND_EXACT, NULL, 1e-12};

static long_scene scene_of(double k)
{
    long_scene scene = {.p = laws_params(k, (double[]){1.4, 2.1, 3.0})};
    const double omega[3] = {0.9, -0.3, -0.225}, normal[3] = {0.36, 0.48, 0.8};
    laws_stop_if(ctx, iso_start_ball(ctx, omega, normal, ISO_SPIN_REFUSE, &scene.start) != ISO_OK, "a start");
    scene.spin = 1 / norm(scene.start.y);
    return scene;
}

/* --- integrals -------------------------------------------------------------------------------------------------- */

/* Spins of the fastest methods */
static double longest(void)
{
    return tests_length(100000, 1000000);
}

/* At full length a second or two of each at k = -1, a tenth of it for other k. */
static double length_of(const hard_road *way, double k)
{
    static const char *const fast[] = {"taylor", "blanes_moan6"};
    const double part = k == -1 ? 1 : 0.1;
    for (int i = 0; i < 2 && way->method; i++)
        if (strcmp(way->method->name, fast[i]) == 0) return longest() * part;
    if (!way->method) return longest();
    return part * (long_is(way, "splitting") ? longest() / 10 : strcmp(way->method->name, "rk8pd") == 0 ? 1e4 : 500);
}

static void run_all(double k)
{
    const long_scene scene = scene_of(k);
    for (int i = 0; i < hard_ways; i++)
        runs[i] = long_follow(ctx, &scene, &hard_way[i], length_of(&hard_way[i], k), fabs(k) == 1 ? &by_exact : NULL);
}

static void begin_case(const char *what, double k, const char *why)
{
    const double part = k == -1 ? 1 : 0.1, most = longest();
    char name[64], quantity[256];
    snprintf(name, sizeof name, "%s, k = %g", what, k);
    snprintf(quantity, sizeof quantity,
             "%s; spins: exact %g, taylor and blanes_moan6 %g, other splittings %g, rk8pd %g, others %g", what, most,
             most * part, most / 10 * part, 1e4 * part, 500 * part);
    hard_case(name, quantity, why);
}

static void hold_drift(double k, int quantity, const char *what, const char *why)
{
    begin_case(what, k, why);
    for (int i = 0; i < hard_ways; i++) {
        const hard_road *way = &hard_way[i];
        if (runs[i].refused)
            hard_refused(way, way->backend == ISO_BACKEND_EXACT && k == 0.5, runs[i].words);
        else
            hard_hold(way, runs[i].drift[quantity], long_bound(way, &runs[i], quantity));
    }
    for (int i = 0; i < hard_ways; i++) { /* what the projection is for */
        const iso_method *m = hard_way[i].method;
        if (!m || m->projects || hard_way[i].backend != ISO_BACKEND_BALL || long_is(&hard_way[i], "splitting") ||
            quantity == LONG_SECOND)
            continue;
        hard_naive(m->name, runs[i].drift[quantity], LONG_ROUNDED);
    }
}

/* Steps alike, symplectic: the energy's error has no trend. White noise would have one of three standard errors in
 * one of 370 runs. */
static void hold_trend(double k)
{
    begin_case("trend of the energy", k, "errors of one sign at each step would add up");
    for (int i = 0; i < hard_ways; i++)
        if (long_is(&hard_way[i], "splitting")) hard_hold(&hard_way[i], runs[i].trend, 3);
    for (int i = 0; i < hard_ways && k == -1; i++)
        if (hard_way[i].method && hard_way[i].backend == ISO_BACKEND_BALL &&
            strstr(hard_way[i].method->name, "adams"))
            hard_naive(hard_way[i].method->name, runs[i].trend, 3);
}

/* With energy and F the frequencies stay, and phases go wrong linearly: t^1, and t^(3/2) if F went at random. */
static void hold_growth(double k)
{
    begin_case("growth p of the phase error, t^(1+p)", k, "a drift of a frequency makes it t^2");
    for (int i = 0; i < hard_ways; i++)
        if (long_is(&hard_way[i], "splitting") || (hard_way[i].method && !strcmp(hard_way[i].method->name, "taylor")))
            hard_hold(&hard_way[i], runs[i].growth - 1, 0.3);
    for (int i = 0; i < hard_ways && k == -1; i++) /* which keeps energy and constraints, but not F */
        if (hard_way[i].backend == ISO_BACKEND_BALL && hard_way[i].method &&
            !strcmp(hard_way[i].method->name, "rk8pd"))
            hard_naive("rk8pd, F left to drift", runs[i].growth - 1, 0.3);
    begin_case("phase error in tolerances a spin", k, "steps add up");
    for (int i = 0; i < hard_ways; i++)
        if (long_is(&hard_way[i], "splitting") || (hard_way[i].method && !strcmp(hard_way[i].method->name, "taylor")))
            hard_hold(&hard_way[i], runs[i].error / (hard_way[i].tolerance * runs[i].spins), 4);
}

static void integrals_hold(double k)
{
    run_all(k);
    hold_drift(k, LONG_ENERGY, "energy", "restored with a rounding of its own at each step");
    hold_drift(k, LONG_UNITS, "length of n", "off it the equations are others, of a point unstable");
    hold_drift(k, LONG_SPIN, "(omega,n)", "a twist that the contact forbids");
    if (fabs(k) == 1) hold_drift(k, LONG_SECOND, "F", "nothing in the equations holds it");
    hold_trend(k);
    if (fabs(k) == 1) hold_growth(k);
}

/* --- the finest phase ------------------------------------------------------------------------------------------- */

/* The ball's state by exact, and how far a start that differs by `off` in omega gets from it. */
static double sensitivity(const long_scene *scene, double spins, double state[ISO_STATE])
{
    double worst = 0;
    for (int i = -1; i < 3; i++) {
        const double off = i < 0 ? 0 : 1e-10;
        long_scene near = *scene;
        iso_orbit *orbit;
        double *const omega = near.start.y;
        if (i >= 0) omega[i] += off * norm(omega), remove_along(omega, omega + 3);
        laws_stop_if(ctx, long_create(ctx, &near, &by_exact, &orbit) != ISO_OK, "exact");
        const iso_sample s = scene_at(ctx, orbit, spins * scene->spin);
        if (i < 0) copy(s.ball, state, ISO_STATE);
        if (i >= 0) worst = fmax(worst, hard_error(s.ball, state) / off);
        iso_orbit_free(orbit);
    }
    return worst;
}

/* What the rounding of the start (omega, n or M, gamma: six numbers, and J on the way) makes of the phase. */
static void finest_phase(double k)
{
    const double spins = tests_length(30000, 100000);
    const long_scene scene = scene_of(k);
    double right[ISO_STATE];
    char name[64];
    const double rounded = 8 * DBL_EPSILON * sensitivity(&scene, spins, right);
    snprintf(name, sizeof name, "phase, k = %g", k);
    hard_case(name, "state against exact after up to 1e5 spins at tolerance 1e-15",
              "roundings with a bias turn it at every step; F at random makes it t^(3/2)");
    for (int i = 0; i < hard_ways; i++) {
        hard_road way = hard_way[i];
        if (!way.method || strcmp(way.method->name, "taylor") != 0) continue;
        iso_orbit *orbit;
        way.tolerance = 1e-15;
        laws_stop_if(ctx, long_create(ctx, &scene, &way, &orbit) != ISO_OK, "taylor");
        const iso_sample s = scene_at(ctx, orbit, spins * scene.spin);
        hard_hold(&hard_way[i], hard_error(s.ball, right), rounded);
        iso_orbit_free(orbit);
    }
}

/* --- the clock -------------------------------------------------------------------------------------------------- */

/* A random orbit in the system's own clock; gives the time of a radian of the unit vector. */
static double sampled(const iso_system *system, double k, iso_model *model, double y[ISO_STATE])
{
    iso_problem f = {.p = laws_params(k, (double[]){1.4, 2.1, 3.0})};
    iso_random *random = iso_random_create(8);
    double dy[ISO_STATE];
    laws_sample(system, &f, random, y);
    iso_random_free(random);
    *model = iso_model_assemble(system, &f, system->clock, (const bool[]){false, false, false});
    model->rhs(model, y, dy);
    return 1 / norm(dy + 3);
}

static iso_integrator *started(const iso_method *method, const iso_model *model, const iso_method_options *options,
                               const double y[ISO_STATE])
{
    iso_integrator *it;
    laws_stop_if(ctx,
                 iso_integrator_create(ctx, method, model, options, &it) != ISO_OK ||
                     iso_integrator_start(it, y) != ISO_OK,
                 method->name);
    return it;
}

static void clocks(void)
{
    enum { STEPS = 10000 };
    hard_case("clock", "time after 10000 steps of 1/10 radian, in units of it",
              "t += h rounds at each step, for equal steps to one side");
    double h = 0, sum = 0;
    for (int i = 0; i < hard_ways; i++) {
        const hard_road *way = &hard_way[i];
        if (!way->method || !way->method->fixed) continue;
        iso_model model;
        double t, y[ISO_STATE], reached[ISO_STATE];
        h = 0.1 * sampled(way->backend == ISO_BACKEND_BALL ? &iso_system_ball : &iso_system_point, -1, &model, y);
        iso_integrator *it = started(way->method, &model, &(iso_method_options){.fixed_step = h}, y);
        const iso_status status = iso_integrator_at(it, (STEPS - 0.5) * h, reached);
        iso_integrator_last(it, &t, y);
        hard_hold(way, status == ISO_OK ? fabs(t / (STEPS * h) - 1) : NAN, 2 * DBL_EPSILON);
        iso_integrator_free(it);
    }
    for (int i = 0; i < STEPS; i++) sum += h;
    hard_naive("t += h", fabs(sum / (STEPS * h) - 1), 2 * DBL_EPSILON);
}

int main(void)
{
    ctx = iso_context_create();
    hard_topic("5. Long time");
    for (int i = 0; i < 3; i++) integrals_hold((const double[]){-1, 1, 0.5}[i]);
    for (int k = -1; k <= 1; k += 2) finest_phase(k);
    clocks();
    iso_context_free(ctx);
    return hard_summary();
}
