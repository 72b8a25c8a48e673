/* The closed solution of a ball with a rotor: three equal moments with any K, two with K along the third axis, and a
 * principal plane at right angles to K, against long double; what it is without a rotor; its momenta; where there is
 * none. */
#include "exact_orbits.h"

static iso_context *ctx;

typedef enum family { ROUND, ALONG, AXIS, PLANE, FAMILIES } family;
static const char *const family_names[FAMILIES] = {"three equal moments", "three equal moments, M next to K",
                                                   "two equal moments", "a principal plane"};

static void set_rotor(orbit *o, const double K[3])
{
    iso_effects *const e = &o->model.problem.effects;
    e->on[ISO_ROTOR] = true;
    copy(K, ROTOR_MOMENTUM(e), 3);
    orbit_clocks(o, ISO_CLOCK_S, true, true, false);
}

/* The i-th orbit: k = 1, -1, or of either sign from 1/5 to 5; |K| from 1e-3 to 3 times k^2 |M| and a moment; every
 * third one is off the level H = 0. */
static orbit random_orbit(family kind, int i, iso_random *random)
{
    orbit o = {.ctx = ctx, .model.system = &iso_system_point};
    const int a = i % 3, b = (a + 1) % 3, c = (a + 2) % 3;
    const double k = (i % 2 ? 1 : -1) * (i % 5 ? pow(5, iso_random_uniform(random, -1, 1)) : 1);
    const double rho = i % 3 ? 0 : iso_random_uniform(random, -0.9, 0.9), moment = iso_random_uniform(random, 0.5, 4);
    double J[3] = {moment, moment, moment}, g[3], M[3], K[3];
    iso_random_direction(random, g), iso_random_direction(random, M), iso_random_direction(random, K);
    if (kind == AXIS) J[a] *= iso_random_uniform(random, 0.3, 3);
    if (kind == PLANE) J[a] = iso_random_uniform(random, 1, 5), J[b] = iso_random_uniform(random, 1, 5);
    if (kind == PLANE) g[a] = M[b] = M[c] = 0;
    if (kind == ALONG) copy(M, K, 3), add_scaled(K, pow(10, -i % 9), g); /* K next to M */
    if (kind == AXIS || kind == PLANE) K[b] = K[c] = 0, K[a] = exact_sign(random);
    exact_start(&o, k, J, g, M, rho);
    scale(K, k * k * norm(o.y0) * moment * pow(10, iso_random_uniform(random, -3, 0.5)) / norm(K));
    set_rotor(&o, K);
    return o;
}

/* The orbit of the same start for a k and a K that differ by 4 roundings. */
static orbit beside(const orbit *o)
{
    orbit other = *o;
    iso_problem *f = &other.model.problem;
    f->p = laws_params(f->p.k * (1 + 4 * DBL_EPSILON), f->p.J);
    scale(ROTOR_MOMENTUM(&f->effects), 1 + 4 * DBL_EPSILON);
    orbit_clocks(&other, ISO_CLOCK_S, true, true, false);
    return other;
}

/* A state and the clocks at a time of each clock, forwards and backwards: within 1e-13, and what rounding of k
 * and K makes of the orbit. For small |k| taylor_extended has larger errors: with three equal moments the rates of the
 * clocks are constants, from which its clocks differ by 4e-13 at k = 0.28, those of the closed solution by 1e-16. */
static void note(int i, const orbit *point, laws_worst *worst, laws_worst *clock_worst, int *refused)
{
    static const double turns[3] = {0.3, 4, -2};
    const iso_clock clock = (iso_clock)(i % ISO_CLOCKS);
    const iso_params *p = &point->model.problem.p;
    orbit o = *point, rounded = beside(point);
    const double near = 1e-13 * fmax(1, pow(fabs(2 * p->k), -3));
    iso_exact *exact, *moved;
    if (iso_exact_create(ctx, &o.model.problem, o.y0, exact_clocks, &exact) != ISO_OK) {
        ++*refused;
        return;
    }
    moved = exact_create(&rounded);
    exact_in_clock(&o, clock);
    iso_integrator *it =
        orbit_start(&o, iso_method_find("taylor_extended"), &(iso_method_options){.tolerance = 1e-15});
    for (int j = 0; j < 3; j++) {
        const double time = turns[j] * 2 * M_PI * o.unit;
        double expected[ISO_MAX_STATE], y[ISO_MAX_STATE], z[ISO_MAX_STATE], clocks[ISO_CLOCKS], others[ISO_CLOCKS];
        if (iso_exact_at(ctx, exact, clock, time, y, clocks) != ISO_OK) y[0] = NAN;
        if (iso_exact_at(ctx, moved, clock, time, z, others) != ISO_OK) z[0] = NAN;
        if (iso_integrator_at(it, time, expected) != ISO_OK) expected[0] = NAN;
        for (int c = 0; c < o.model.clocks; c++) {
            const double *e = &expected[ISO_STATE + c], now = clocks[o.model.clock_of[c]];
            laws_note(clock_worst, fabs(now / *e - 1), near + fabs(others[o.model.clock_of[c]] / now - 1), p,
                      "clock");
        }
        copy(expected + ISO_STATE, y + ISO_STATE, o.model.clocks);
        copy(expected + ISO_STATE, z + ISO_STATE, o.model.clocks);
        laws_note(worst, orbit_error(&o, y, expected), near + orbit_error(&o, z, y), p, "state");
    }
    iso_integrator_free(it);
    iso_exact_free(exact);
    iso_exact_free(moved);
}

/* |K| from 1e-2 to 1e8 times k^2 |M| max J, and times that are short beside a turn in the field, about one, and many
 * turns, against taylor_quad: each clock within 64 roundings of a power 1/k, whatever K is. M turns with the field: it
 * has 1e-15 for each unit of |K|, for that is what a rounding of gamma changes it by. */
static void check_strong(void)
{
    static const double turns[4] = {0.01, 0.3, 2, -7};
    const iso_method *quad = iso_method_find("taylor_quad");
    laws_worst worst = {0}, clock_worst = {0};
    if (!quad) return; /* a compiler without its numbers */
    iso_random *random = iso_random_create(36);
    for (int i = 0; i < tests_length(40, 150); i++) {
        const double ratio = pow(10, iso_random_uniform(random, -2, 8));
        orbit o = random_orbit((family)(i % FAMILIES), i / FAMILIES, random);
        double *K = ROTOR_MOMENTUM(&o.model.problem.effects);
        const double k = o.model.problem.p.k, allowed = 64 * DBL_EPSILON * (1 + 1 / fabs(k));
        scale(K, k * k * norm(o.y0) * max3(o.model.problem.p.J) * ratio / norm(K));
        set_rotor(&o, K);
        iso_exact *exact = exact_create(&o);
        exact_in_clock(&o, (iso_clock)(i % ISO_CLOCKS));
        iso_integrator *it = orbit_start(&o, quad, &(iso_method_options){.tolerance = 1e-15});
        for (int j = 0; j < 4; j++) {
            const double time = turns[j] * o.unit / fmax(1, ratio);
            double expected[ISO_MAX_STATE], y[ISO_MAX_STATE], clocks[ISO_CLOCKS];
            if (iso_exact_at(ctx, exact, o.model.clock, time, y, clocks) != ISO_OK) y[0] = NAN;
            if (iso_integrator_at(it, time, expected) != ISO_OK) expected[0] = NAN;
            for (int c = 0; c < o.model.clocks; c++)
                laws_note(&clock_worst, fabs(clocks[o.model.clock_of[c]] / expected[ISO_STATE + c] - 1), allowed,
                          &o.model.problem.p, family_names[i % FAMILIES]);
            copy(expected + ISO_STATE, y + ISO_STATE, o.model.clocks);
            laws_note(&worst, orbit_error(&o, y, expected), 1e-12 + 1e-15 * ratio, &o.model.problem.p,
                      family_names[i % FAMILIES]);
        }
        iso_integrator_free(it);
        iso_exact_free(exact);
    }
    laws_report(&worst, "strong rotors");
    laws_report(&clock_worst, "their clocks");
    iso_random_free(random);
}

static void check_random(void)
{
    const int each = tests_length(40, 100);
    for (int kind = 0; kind < FAMILIES; kind++) {
        iso_random *random = iso_random_create(34);
        laws_worst worst = {0}, clocks = {0};
        int refused = 0;
        for (int i = 0; i < each; i++) {
            const orbit o = random_orbit((family)kind, i, random);
            note(i, &o, &worst, &clocks, &refused);
        }
        laws_report(&worst, family_names[kind]);
        laws_report(&clocks, "its clocks");
        gsl_test(refused > each / 100, "%s: %d of %d refused: %s", family_names[kind], refused, each,
                 iso_context_message(ctx));
        iso_random_free(random);
    }
}

/* The state at time 5 in s. */
static void state_of(const orbit *o, double y[ISO_STATE])
{
    double clocks[ISO_CLOCKS];
    iso_exact *exact = exact_create(o);
    if (iso_exact_at(ctx, exact, ISO_CLOCK_S, 5 * o->unit, y, clocks) != ISO_OK) y[0] = NAN;
    iso_exact_free(exact);
}

/* K -> 0 is the free motion: half of K makes half of the difference. */
static void check_limit(iso_random *random)
{
    laws_worst worst = {0};
    for (int i = 0; i < 60; i++) {
        orbit o = random_orbit((family)(i % FAMILIES), i, random), free = o;
        double y[ISO_STATE], z[ISO_STATE];
        free.model.problem.effects.on[ISO_ROTOR] = false;
        state_of(&free, y);
        double *K = ROTOR_MOMENTUM(&o.model.problem.effects), apart[2];
        scale(K, 1e-6 / fmax(norm(K), 1e-6));
        for (int half = 0; half < 2; half++) {
            state_of(&o, z);
            apart[half] = laws_distance(z, y);
            scale(K, 0.5);
        }
        laws_note(&worst, fabs(apart[0] - 2 * apart[1]), 0.1 * apart[0] + 1e-12, &o.model.problem.p, "state");
    }
    laws_report(&worst, "K -> 0");
}

/* With three equal moments the frequency of the first angle is dH/dI, by differences of neighbours of the same momentum
 * about K, in a clock of the point: an independent test of the action. */
static void check_actions(iso_random *random)
{
    laws_worst worst = {0};
    for (int i = 0; i < 40; i++) {
        const double d = 1e-5;
        const orbit o = random_orbit(i % 2 ? ROUND : AXIS, 3 * i, random);
        iso_exact_torus torus[3];
        double H[3];
        for (int n = 0; n < 3; n++) {
            orbit moved = o;
            double *M = moved.y0, e[3], size;
            cross(M + 3, ROTOR_MOMENTUM(&o.model.problem.effects), e); /* M along K stays: K has none of it */
            make_unit(e);
            add_scaled(M, (n - 1) * d * norm(M), e);
            H[n] = moved.model.problem.energy = iso_system_point.energy(&moved.model.problem, moved.y0, &size);
            iso_exact *exact = exact_create(&moved);
            torus[n] = iso_exact_describe(exact);
            iso_exact_free(exact);
        }
        if (torus[0].distance * torus[2].distance < 0) continue; /* a separatrix lies between */
        laws_note(&worst, fabs(torus[2].action[1] - torus[0].action[1]), 1e-12 * norm(o.y0), &o.model.problem.p,
                  "momentum");
        const double slope = (H[2] - H[0]) / (torus[2].action[0] - torus[0].action[0]);
        laws_note(&worst, fabs(slope / torus[1].frequency[ISO_CLOCK_S][0] - 1), 1e-5, &o.model.problem.p,
                  "frequency");
    }
    laws_report(&worst, "a frequency is dH/dI");
}

/* J = 1, k = 1/2 and K = 1: M about K grows by 2 gamma3^2. From the pole, with M = 2 there, it is -2 at the equator:
 * all of M. The equator is an unstable rotation, which the orbit leaves and comes back to. */
static void check_separatrix(void)
{
    orbit o = {.ctx = ctx, .model.system = &iso_system_point};
    double y[ISO_MAX_STATE], expected[ISO_MAX_STATE], clocks[ISO_CLOCKS];
    exact_start(&o, 0.5, (const double[3]){1, 1, 1}, (const double[3]){0, 0, 1}, (const double[3]){1, 0, 0}, 1);
    set_rotor(&o, (const double[3]){0, 0, 1});
    iso_exact *exact = exact_create(&o);
    gsl_test(iso_exact_describe(exact).kind != ISO_EXACT_SEPARATRIX, "a separatrix");
    orbit_clocks(&o, ISO_CLOCK_S, false, false, false);
    for (int sign = -1; sign <= 1; sign += 2) {
        orbit_solve(&o, iso_method_find("taylor_extended"), &(iso_method_options){.tolerance = 1e-15}, 3 * sign,
                    expected);
        iso_exact_at(ctx, exact, ISO_CLOCK_S, 3 * sign, y, clocks);
        gsl_test(!(orbit_error(&o, y, expected) < 1e-11), "next to the start: %.1e", orbit_error(&o, y, expected));
        iso_exact_at(ctx, exact, ISO_CLOCK_S, 60 * sign, y, clocks);
        gsl_test(!(fabs(y[5]) < 1e-14 && fabs(y[2] + 2) < 1e-13), "at the equator in the end: %g %g", y[5], y[2] + 2);
    }
    iso_exact_free(exact);
}

static void refused(const double J[3], const double K[3], const char *words)
{
    orbit o = {.ctx = ctx, .model.system = &iso_system_point};
    iso_exact *exact;
    exact_start(&o, 1, J, (const double[3]){0.36, 0.48, 0.8}, (const double[3]){0.9, -0.3, 0}, 0);
    set_rotor(&o, K);
    const iso_status status = iso_exact_create(ctx, &o.model.problem, o.y0, exact_clocks, &exact);
    gsl_test(status != ISO_BAD_ARGUMENT || strcmp(iso_context_about(ctx), "rotor") != 0 ||
                 !strstr(iso_context_message(ctx), words),
             "refused: %s", status == ISO_OK ? "not" : iso_context_message(ctx));
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *random = iso_random_create(35);
    check_random();
    check_strong();
    check_limit(random);
    check_actions(random);
    check_separatrix();
    refused((const double[3]){1.4, 2.1, 3}, (const double[3]){0, 0, 0.5}, "closed solution only where");
    refused((const double[3]){2, 2, 3}, (const double[3]){0.1, 0, 0.5}, "K is along the third axis");
    iso_random_free(random);
    iso_context_free(ctx);
    return gsl_test_summary();
}
