/* What the forms of the closed solution have in common: grids are single times, forms pass into each other, periods
 * are periods, and errors are told. */
#include "exact_orbits.h"
#include "model/effects/effect.h"

static iso_context *ctx;

static bool state_at(const iso_exact *exact, iso_clock clock, double time, double y[ISO_STATE])
{
    double unused[ISO_CLOCKS];
    return iso_exact_at(ctx, exact, clock, time, y, unused) == ISO_OK;
}

/* Many times that follow each other. */
static bool walk(const iso_exact *exact, iso_clock clock, double start, double step, int count, double points[],
                 double clocks[])
{
    iso_exact_walk w = {0};
    bool good = true;
    for (int i = 0; i < count; i++)
        good = iso_exact_walk_to(ctx, exact, &w, clock, start + i * step, points + ISO_STATE * i,
                                 clocks + ISO_CLOCKS * i) == ISO_OK &&
               good;
    return good;
}

/* --- grids ------------------------------------------------------------------------------------------------------ */

enum { COUNT = 200, GRIDS = EXACT_NEAR_POLE };

/* Newton's method ends within rounding of the time from wherever it begins: `near` is what the state makes of it. */
static void note_grid(const orbit *o, const iso_exact *exact, iso_clock clock, double start, double step, double near,
                      laws_worst *worst)
{
    static double points[ISO_STATE * COUNT], clocks[ISO_CLOCKS * COUNT];
    const iso_params *p = &o->model.problem.p;
    double unused[ISO_STATE], unit[ISO_CLOCKS];
    iso_exact_at(ctx, exact, clock, o->unit, unused, unit);
    if (!walk(exact, clock, start, step, COUNT, points, clocks)) points[0] = NAN;
    for (int i = 0; i < COUNT; i++) {
        const double time = start + i * step, *c = clocks + ISO_CLOCKS * i;
        double y[ISO_STATE], wanted[ISO_CLOCKS];
        if (iso_exact_at(ctx, exact, clock, time, y, wanted) != ISO_OK) y[0] = NAN;
        orbit state = *o;
        state.model.dim = ISO_STATE, state.model.clocks = 0;
        const double allowed = near + 4 * DBL_EPSILON * fabs(time) / o->unit;
        laws_note(worst, orbit_error(&state, points + ISO_STATE * i, y), allowed, p, "state");
        for (int k = 0; k < ISO_CLOCKS; k++)
            laws_note(worst, fabs(c[k] - wanted[k]), 1e-13 * (fabs(wanted[k]) + unit[k]), p, "clock");
    }
}

static void check_grids(void)
{
    iso_random *random = iso_random_create(41);
    laws_worst worst[GRIDS];
    memset(worst, 0, sizeof worst);
    for (int i = 0; i < 12 * GRIDS; i++) {
        const exact_family family = (exact_family)(i % GRIDS);
        const double delta = pow(10, -iso_random_uniform(random, 1, 6));
        orbit o = exact_orbit(ctx, family, i / GRIDS, delta, random);
        const iso_clock clock = (iso_clock)(i / GRIDS % ISO_CLOCKS);
        iso_exact *exact = exact_create(&o);
        exact_in_clock(&o, clock);
        for (int e = -3; e <= 3; e++)
            note_grid(&o, exact, clock, (e - 1) * 3.3 * o.unit, ((i + e) % 2 ? -1 : 1) * pow(10, e) * o.unit,
                      family < EXACT_SEPARATRIX ? 1e-13 : 1e-12, &worst[family]);
        double y[ISO_STATE], single[ISO_STATE], clocks[ISO_CLOCKS];
        gsl_test(!state_at(exact, clock, 3, y) || !walk(exact, clock, 3, 1, 1, single, clocks) ||
                     memcmp(y, single, sizeof y) != 0,
                 "a grid of one time");
        iso_exact_free(exact);
    }
    for (int f = 0; f < GRIDS; f++) {
        char name[96];
        snprintf(name, sizeof name, "grids: %s", exact_names[f]);
        laws_report(&worst[f], name);
    }
    iso_random_free(random);
}

/* --- one form into the other ------------------------------------------------------------------------------------ */

/* Two starts that differ by some rounding errors of moments or state, within 50 units of time. */
static void note_same(const orbit *a, const orbit *b, const char *what, laws_worst *worst)
{
    iso_exact *x = exact_create(a), *y = exact_create(b);
    for (iso_clock clock = 0; clock < ISO_CLOCKS; clock++)
        for (int i = -5; i <= 5; i++) {
            double p[ISO_STATE], q[ISO_STATE];
            orbit o = *a;
            orbit_clocks(&o, clock, false, false, false);
            if (!state_at(x, clock, 10 * i * o.unit, p) || !state_at(y, clock, 10 * i * o.unit, q)) p[0] = NAN;
            laws_note(worst, orbit_error(&o, p, q), 2e-12, &b->model.problem.p,
                      what); /* orbits past the pole: 1e-12 */
        }
    iso_exact_free(x);
    iso_exact_free(y);
}

static void check_nearly_equal(iso_random *random)
{
    laws_worst two = {0}, three = {0};
    for (int i = 0; i < 60; i++) {
        const int a = i % 3;
        double J[3], g[3], M[3];
        orbit o = {.ctx = ctx, .model.system = &iso_system_point}, nearly = o;
        iso_random_direction(random, g), iso_random_direction(random, M);
        for (int j = 0; j < 3; j++) J[j] = iso_random_uniform(random, 1, 3);
        J[(a + 1) % 3] = J[a];
        const bool all = i % 4 == 3;
        if (all) J[(a + 2) % 3] = J[a];
        exact_start(&o, i / 3 % 2 ? 1 : -1, J, g, M, 0);
        J[a] = nextafter(J[a], i % 2 ? 0 : 10);
        if (all) J[(a + 2) % 3] = nextafter(J[(a + 2) % 3], i % 2 ? 10 : 0);
        exact_start(&nearly, i / 3 % 2 ? 1 : -1, J, g, M, 0);
        note_same(&o, &nearly, "", all ? &three : &two);
    }
    laws_report(&two, "two moments equal but for a rounding error");
    laws_report(&three, "three moments equal but for rounding errors");
}

/* Rotations about the shortest and the longest axis are stable (k = -1: where b3 < b1 + b2). */
static void check_nearly_plane(iso_random *random)
{
    laws_worst worst = {0};
    for (int i = 0; i < 60; i++) {
        const double J[3] = {iso_random_uniform(random, 1.5, 1.9), 2, iso_random_uniform(random, 2.1, 3)};
        const int a = i % 2 ? 0 : 2, b = (a + 1) % 3, c = (a + 2) % 3;
        double g[3] = {0}, M[3] = {0};
        orbit o = {.ctx = ctx, .model.system = &iso_system_point}, nearly = o;
        g[b] = cos(i), g[c] = sin(i), M[a] = i % 5 < 2 ? 1 : -1;
        exact_start(&o, i / 2 % 2 ? 1 : -1, J, g, M, 0);
        g[a] = 1e-16, M[b] = 1e-16;
        exact_start(&nearly, i / 2 % 2 ? 1 : -1, J, g, M, 0);
        note_same(&o, &nearly, "", &worst);
    }
    laws_report(&worst, "off a plane by a rounding error");
}

/* --- on the torus ----------------------------------------------------------------------------------------------- */

/* After a period of the first angle a plane's state is back; else gamma along the axis, and its rate. */
static void note_period(const orbit *o, bool plane, laws_worst *worst)
{
    const iso_params *p = &o->model.problem.p;
    int axis = 0;
    while (p->J[(axis + 1) % 3] != p->J[(axis + 2) % 3] && axis < 2) axis++;
    iso_exact *exact = exact_create(o);
    const iso_exact_torus torus = iso_exact_describe(exact);
    gsl_test(torus.kind != (plane ? ISO_EXACT_PLANE : ISO_EXACT_SYMMETRIC) || torus.angles != (plane ? 1 : 2),
             "its kind");
    for (iso_clock clock = 0; clock < ISO_CLOCKS; clock++)
        for (int turns = -2; turns <= 3; turns++) {
            double y[2][ISO_STATE], dy[2][ISO_STATE];
            const double period = 2 * M_PI / torus.frequency[clock][0], at = 0.3 * period;
            for (int i = 0; i < 2; i++) {
                if (!state_at(exact, clock, at + i * turns * period, y[i])) y[i][0] = NAN;
                iso_system_point.rhs(&o->model.problem, y[i], dy[i]);
            }
            const double speed = iso_system_point.speed(&o->model.problem, y[0]);
            const double along = fabs(y[0][3 + axis] - y[1][3 + axis]);
            const double rate = fabs(dy[0][3 + axis] - dy[1][3 + axis]) / speed;
            const double both = laws_distance(y[0] + 3, y[1] + 3) + laws_distance(y[0], y[1]) / speed;
            const double error = plane ? both : along + rate;
            laws_note(worst, error, 1e-13, p, iso_clock_name(clock));
        }
    iso_exact_free(exact);
}

/* Frequencies have one ratio in all clocks. */
static void note_ratios(const orbit *o, laws_worst *worst)
{
    iso_exact *exact = exact_create(o);
    const iso_exact_torus torus = iso_exact_describe(exact);
    for (int c = 1; c < ISO_CLOCKS && torus.angles == 2; c++) {
        const double ratio = torus.frequency[c][0] / torus.frequency[c][1];
        const double in_t = torus.frequency[0][0] / torus.frequency[0][1];
        laws_note(worst, fabs(ratio / in_t - 1), 4 * DBL_EPSILON, &o->model.problem.p, "");
    }
    iso_exact_free(exact);
}

static void check_torus(void)
{
    laws_worst plane = {0}, axis = {0}, ratios = {0};
    iso_random *random = iso_random_create(42);
    for (int i = 0; i < 40; i++) {
        orbit o = exact_orbit(ctx, EXACT_IN_PLANE, i, 0, random);
        note_period(&o, true, &plane);
        o = exact_orbit(ctx, EXACT_AXIS, i, 0, random);
        note_period(&o, false, &axis);
        note_ratios(&o, &ratios);
        o = exact_orbit(ctx, EXACT_ANY, i, 0, random);
        note_ratios(&o, &ratios);
    }
    laws_report(&plane, "a period in a plane");
    laws_report(&axis, "a period of the swing along the axis");
    laws_report(&ratios, "ratios of frequencies");
    check_nearly_equal(random);
    check_nearly_plane(random);
    iso_random_free(random);
}

/* --- errors ----------------------------------------------------------------------------------------------------- */

/* No closed solution, about that. */
static void refused(const orbit *o, const char *about, const char *what)
{
    iso_exact *exact = (iso_exact *)&exact;
    const iso_status status = iso_exact_create(ctx, &o->model.problem, o->y0, exact_clocks, &exact);
    gsl_test(status != ISO_BAD_ARGUMENT || exact || strcmp(iso_context_about(ctx), about) != 0 ||
                 *iso_context_message(ctx) == '\0',
             "%s: %s", what, status == ISO_OK ? "not refused" : iso_context_message(ctx));
    if (status == ISO_OK) iso_exact_free(exact);
}

/* Numbers that are not finite: hard/test_hard_numbers.c. */
static void check_refusals(void)
{
    static const double g[3] = {0.36, 0.48, 0.8}, M[3] = {1, -0.2, 0.4}, equal[3] = {2, 2, 3};
    orbit o = {.ctx = ctx, .model.system = &iso_system_point}, other;
    exact_start(&o, 0.5, orbit_J, g, M, 0);
    refused(&o, "k", "k = 1/2");
    exact_start(&o, nextafter(1, 2), orbit_J, g, M, 0);
    refused(&o, "k", "k next to 1");
    exact_start(&o, 1, orbit_J, g, M, 0.3);
    refused(&o, "level", "k = 1 off H = 0");
    exact_start(&o, -1, orbit_J, g, M, 0);
    for (int i = 0; i < 3; i++) {
        other = o, other.model.problem.eps = (double[]){0, -1, INFINITY}[i];
        refused(&other, "eps", "eps");
    }
    other = o, other.model.problem.eps = NAN;
    refused(&other, "eps", "eps NaN");
    for (int form = 0; form < 2; form++) {
        exact_start(&o, -1, form ? equal : orbit_J, g, M, 0);
        other = o, other.y0[3] = other.y0[4] = other.y0[5] = 0;
        refused(&other, "", "gamma = 0");
        other = o, other.model.problem.energy = -100;
        refused(&other, "level", "a level below the potential");
    }
    exact_start(&o, -1, orbit_J, g, M, 0);
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        other = o, other.model.problem.effects.on[e] = true;
        /* the rotor here has K = 0 */
        if (e != ISO_CLOCK && e != ISO_LEVEL && e != ISO_INTEGRALS && e != ISO_ROTOR)
            refused(&other, iso_effect_list[e]->name, "an effect");
    }
}

static void check_times(void)
{
    static const bool only_t[ISO_CLOCKS] = {true, false, false};
    static const exact_family list[4] = {EXACT_ANY, EXACT_AXIS, EXACT_IN_PLANE, EXACT_NEAR_EQUAL};
    iso_random *random = iso_random_create(43);
    for (int i = 0; i < 4; i++) {
        const orbit o = exact_orbit(ctx, list[i], 0, 1e-15, random); /* the last one: three equal moments, nearly */
        iso_exact *exact;
        double y[ISO_STATE], c[ISO_CLOCKS];
        if (iso_exact_create(ctx, &o.model.problem, o.y0, only_t, &exact) != ISO_OK) exit(1);
        gsl_test(iso_exact_at(ctx, exact, ISO_CLOCK_S, 1, y, c) != ISO_BAD_ARGUMENT ||
                     !strstr(iso_context_message(ctx), "clock s"),
                 "a clock that was not made: %s", iso_context_message(ctx));
        gsl_test(iso_exact_walk_to(ctx, exact, &(iso_exact_walk){0}, ISO_CLOCK_TAU, 0, y, c) != ISO_BAD_ARGUMENT,
                 "nor in a grid");
        gsl_test(iso_exact_at(ctx, exact, ISO_CLOCK_T, 1, y, c) != ISO_OK || c[ISO_CLOCK_T] != 1, "%s: its own clock",
                 exact_names[list[i]]);
        gsl_test(!isnan(c[ISO_CLOCK_TAU]) || !isnan(c[ISO_CLOCK_S]), "%s: clocks that were not made are NaN",
                 exact_names[list[i]]);
        const iso_exact_torus torus = iso_exact_describe(exact);
        gsl_test(!isfinite(torus.frequency[ISO_CLOCK_T][0]) || !isnan(torus.frequency[ISO_CLOCK_S][0]) ||
                     !isnan(torus.frequency[ISO_CLOCK_TAU][0]),
                 "%s: their frequencies as well", exact_names[list[i]]);
        iso_exact_free(exact);
    }
    iso_random_free(random);
    iso_exact_free(NULL);
}

int main(void)
{
    ctx = iso_context_create();
    check_grids();
    check_torus();
    check_times();
    check_refusals();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
