/* Long runs with forces: fields, gravity on spheres and tilted planes, contacts that twist. Free balls are reversible
 * and, at k = 1 and -1, integrable, which flatters every method (Modin, Verdier, Numer. Math. 145, 2020, 1067); here
 * there is no second integral, and with friction no way back. */
#include <gsl/gsl_errno.h>

#include "hard_long.h"

static iso_context *ctx;
static long_run runs[HARD_WAYS];

static const hard_road by_extended = {ISO_BACKEND_BALL, NULL, 1e-15};

typedef struct forced {
    const char *name;
    double k, gravity; /* mgb */
    bool field, attitude;
    double twist;        /* resistance; NAN: a rigid contact               */
    double fast, others; /* lengths in spins: of taylor, of the others      */
    bool point;          /* has one                                         */
} forced;

static const forced scenes[] = {
    {"field, k = 0.5", 0.5, 0, true, false, NAN, 2e4, 200, true},
    {"gravity and field, shell k = -1", -1, -0.3, true, false, NAN, 2e4, 200, false},
    {"gravity and attitude, inside k = 2", 2, -0.3, false, true, NAN, 1e4, 100, false},
    {"tilted plane, k = 1", 1, 0.3, false, true, NAN, 300, 100, false},
    {"classical contact and gravity, k = -1", -1, -0.3, false, false, 0, 2e4, 200, false},
    {"twist friction and gravity, k = 0.5", 0.5, 0.3, false, false, 1, 2e4, 200, false},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static long_scene scene_of(const forced *f)
{
    long_scene scene = {.p = laws_params(f->k, (double[]){1.4, 2.1, 3.0})};
    iso_effects *const e = &scene.effects;
    const bool twists = !isnan(f->twist);
    const double omega[3] = {0.9, -0.3, twists ? -0.125 : -0.225}, normal[3] = {0.36, 0.48, 0.8};
    laws_stop_if(ctx,
                 iso_params_set_D(ctx, 0.4, &scene.p) != ISO_OK ||
                     iso_start_ball(ctx, omega, normal, twists ? ISO_SPIN_KEEP : ISO_SPIN_REFUSE, &scene.start) !=
                         ISO_OK,
                 f->name);
    if (f->gravity != 0) {
        e->on[ISO_GRAVITY] = true;
        GRAVITY_MGB(e) = f->gravity;
        copy((double[]){0.48, 0.6, 0.64}, GRAVITY_UP(e), 3);
    }
    if (f->field) add_field(e);
    if (twists) add_twist(f->twist, e);
    QUATERNION(e)[0] = 1;
    e->on[ISO_ATTITUDE] = f->attitude;
    scene.spin = 1 / norm(scene.start.y);
    return scene;
}

static bool is_taylor(const hard_road *way)
{
    return strcmp(way->method->name, "taylor") == 0;
}

static double length_of(const forced *f, const hard_road *way)
{
    if (long_is(way, "splitting")) return strcmp(way->method->name, "strang") == 0 ? 1e4 : f->fast;
    return is_taylor(way) ? f->fast : f->others;
}

static void run_all(const forced *f, const long_scene *scene)
{
    for (int i = 0; i < hard_ways; i++) {
        const hard_road *way = &hard_way[i];
        runs[i] = long_follow(ctx, scene, way, way->method ? length_of(f, way) : 1, NULL);
    }
}

static void begin_case(const char *what, const forced *f, const char *why)
{
    char name[128], quantity[256];
    snprintf(name, sizeof name, "%s: %s", f->name, what);
    snprintf(quantity, sizeof quantity, "%s; %g spins: taylor, splittings (strang 1e4); %g: others", what, f->fast,
             f->others);
    hard_case(name, quantity, why);
}

/* Every way by its bound; the point and its closed solution refuse what is the ball's alone. */
static void hold_drift(const forced *f, int quantity, const char *what, const char *why)
{
    begin_case(what, f, why);
    for (int i = 0; i < hard_ways; i++) {
        const hard_road *way = &hard_way[i];
        if (runs[i].refused)
            hard_refused(way, way->backend == ISO_BACKEND_EXACT || (way->backend == ISO_BACKEND_POINT && !f->point),
                         runs[i].words);
        else
            hard_hold(way, runs[i].drift[quantity], long_bound(way, &runs[i], quantity));
    }
    for (int i = 0; i < hard_ways; i++) {
        const iso_method *m = hard_way[i].method;
        if (!m || runs[i].refused || m->projects || long_is(&hard_way[i], "splitting")) continue;
        if (hard_way[i].backend == ISO_BACKEND_BALL) hard_naive(m->name, runs[i].drift[quantity], LONG_ROUNDED);
    }
}

static void hold_trend(const forced *f)
{
    begin_case("trend of the energy", f,
               "an error a step of one sign would be 1e4 times and more as large at the end");
    for (int i = 0; i < hard_ways; i++)
        if (long_is(&hard_way[i], "splitting")) hard_hold(&hard_way[i], runs[i].trend, 3);
    for (int i = 0; i < hard_ways; i++)
        if (hard_way[i].method && strcmp(hard_way[i].method->name, "msadams") == 0 &&
            hard_way[i].backend == ISO_BACKEND_BALL)
            hard_naive("msadams", runs[i].trend, 3);
}

/* --- states against long double --------------------------------------------------------------------------------- */

enum { SHORT = 30 };

static iso_sample state_by(const long_scene *scene, const hard_road *way, double spins, long *steps)
{
    iso_orbit *orbit;
    laws_stop_if(ctx, long_create(ctx, scene, way, &orbit) != ISO_OK, "an orbit is refused");
    const iso_sample s = scene_at(ctx, orbit, spins * scene->spin);
    if (steps) *steps = iso_orbit_statistics(orbit).steps;
    iso_orbit_free(orbit);
    return s;
}

/* How much larger a small difference of omega or n becomes on the way, at most: what each step's error may. */
static double amplified(const long_scene *scene, const hard_road *way, const iso_sample *end)
{
    const double off = 1e-9;
    double worst = 1;
    for (int i = 0; i < 6; i++) {
        long_scene near = *scene;
        double *const omega = near.start.y, *const n = omega + 3;
        (i < 3 ? omega : n)[i % 3] += off * (i < 3 ? norm(omega) : 1);
        make_unit(n);
        if (!near.effects.on[ISO_TWIST]) remove_along(omega, n);
        const iso_sample s = state_by(&near, way, SHORT, NULL);
        worst = fmax(worst, hard_error(s.ball, end->ball) / off);
    }
    return worst;
}

static void hold_states(const forced *f, const long_scene *scene)
{
    hard_road truth = by_extended;
    truth.method = iso_method_find("taylor_extended");
    const iso_sample end = state_by(scene, &truth, SHORT, NULL);
    const double gain = amplified(scene, &truth, &end);
    begin_case("state against taylor_extended after 30 spins, in what its steps may add up to", f,
               "no second integral: small errors grow");
    for (int i = 0; i < hard_ways; i++) {
        const hard_road *way = &hard_way[i];
        long steps = 0;
        if (runs[i].refused || way->method == truth.method) continue;
        const iso_sample s = state_by(scene, way, SHORT, &steps);
        hard_hold(way, hard_error(s.ball, end.ball) / (gain * (double)steps * way->tolerance + LONG_ROUNDED), 1);
    }
}

/* --- friction --------------------------------------------------------------------------------------------------- */

static double energy_at(iso_orbit *orbit, double time, double *size)
{
    const iso_sample s = scene_at(ctx, orbit, time);
    return iso_orbit_integral(orbit, &iso_system_ball, &iso_system_ball.integrals[0], &s, size);
}

/* h' = -c (omega,n)^2: from spin to spin the energy never grows but by the errors of the steps between. */
static void hold_fall(const forced *f, const long_scene *scene)
{
    begin_case("growth of the energy within a spin, 100 spins", f, "nothing restores an energy that falls");
    for (int i = 0; i < hard_ways; i++) {
        const hard_road *way = &hard_way[i];
        iso_orbit *orbit;
        double worst = 0, size, unused;
        if (runs[i].refused) continue;
        laws_stop_if(ctx, long_create(ctx, scene, way, &orbit) != ISO_OK, "friction");
        double before = energy_at(orbit, 0, &size);
        const double begun = before;
        for (int j = 1; j <= 100; j++) {
            const double now = energy_at(orbit, j * scene->spin, &unused);
            worst = fmax(worst, (now - before) / size);
            before = now;
        }
        const double steps = (double)iso_orbit_statistics(orbit).steps;
        hard_hold(way, worst, 2 * steps / 100 * way->tolerance + LONG_ROUNDED);
        if (is_taylor(way)) hard_naive("energy as an integral", (begun - before) / size, LONG_ROUNDED);
        iso_orbit_free(orbit);
    }
}

int main(void)
{
    gsl_set_error_handler_off();
    ctx = iso_context_create();
    hard_topic("5. Long time, forced");
    for (int i = 0; i < SCENES; i++) {
        const forced *f = &scenes[i];
        const long_scene scene = scene_of(f);
        const bool falls = f->twist > 0, twists = !isnan(f->twist);
        run_all(f, &scene);
        if (!falls) hold_drift(f, LONG_ENERGY, "energy", "restored though potentials share in it");
        hold_drift(f, LONG_UNITS, f->attitude ? "lengths of n, e, Q" : "lengths of n, e",
                   "each is carried on by omega alone");
        if (!twists) hold_drift(f, LONG_SPIN, "(omega,n)", "torques push against the constraint");
        if (f->point) hold_trend(f);
        if (falls) hold_fall(f, &scene);
        hold_states(f, &scene);
    }
    iso_context_free(ctx);
    return hard_summary();
}
