/* The closed solution for k = 1, -1 against long double, on random bodies, with equal moments among them, and against
 * reference states. */
#include "exact/exact_impl.h"
#include "orbits.h"
#include "reference.h"

static iso_context *ctx;
static const bool all_clocks[ISO_CLOCKS] = {true, true, true};

/* A random point on H = 0, speeds of order one; two moments of every fifth body are equal. */
static orbit random_point(int i, iso_random *random)
{
    double J[3];
    for (int j = 0; j < 3; j++) J[j] = iso_random_uniform(random, 1, i % 4 < 2 ? 2 : 7);
    if (i % 5 == 4) J[i % 2] = J[i % 2 + 1];
    return orbit_sample(ctx, &iso_system_point, i % 2 == 0 ? -1 : 1, J, 100 + (unsigned long)i);
}

/* States and clocks at a time of each clock, forwards and backwards; energy and constraints of what comes back. */
static void check_orbit(int i, const orbit *point, double *worst, double *worst_clock, double *worst_energy,
                        int *refused)
{
    static const double turns[3] = {0.3, 20, -7};
    const iso_clock clock = (iso_clock)(i % ISO_CLOCKS);
    orbit o = *point;
    iso_exact *exact;
    if (iso_exact_create(ctx, &o.model.problem, o.y0, all_clocks, &exact) != ISO_OK) {
        ++*refused;
        return;
    }
    orbit_clocks(&o, clock, clock != ISO_CLOCK_T, clock != ISO_CLOCK_TAU, clock != ISO_CLOCK_S);
    iso_integrator *it =
        orbit_start(&o, iso_method_find("taylor_extended"), &(iso_method_options){.tolerance = 1e-15});
    for (int j = 0; j < 3; j++) {
        const double time = turns[j] * 2 * M_PI * o.unit;
        double expected[ISO_MAX_STATE], y[ISO_MAX_STATE], clocks[ISO_CLOCKS], size;
        iso_exact_at(ctx, exact, clock, time, y, clocks);
        if (iso_integrator_at(it, time, expected) != ISO_OK) expected[0] = NAN;
        copy(expected + ISO_STATE, y + ISO_STATE, o.model.clocks);
        *worst = fmax(*worst, isfinite(y[0]) ? orbit_error(&o, y, expected) : INFINITY);
        for (int c = 0; c < o.model.clocks; c++) {
            const double error = fabs(clocks[o.model.clock_of[c]] / expected[ISO_STATE + c] - 1);
            *worst_clock = fmax(*worst_clock, error);
        }
        const double H = iso_system_point.energy(&o.model.problem, y, &size);
        *worst_energy = fmax(*worst_energy, fmax(fabs(H) / size, fabs(norm(y + 3) - 1)));
    }
    iso_integrator_free(it);
    iso_exact_free(exact);
}

/* The rows with k = 1, -1 of states in quadruple precision, to t = 1000. */
static void check_reference(void)
{
    static reference rows[REFERENCE_ROWS];
    const int count = reference_read(ctx, rows);
    double worst = 0;
    int solved = 0;
    for (int i = 0; i < count; i++) {
        const reference *r = &rows[i];
        iso_problem f = {.p = r->p};
        double point[ISO_STATE], ball[ISO_STATE], clocks[ISO_CLOCKS];
        iso_exact *exact;
        if (fabs(r->p.k) != 1) continue;
        f.eps = iso_coupling(&f.p, iso_ball_energy(&f.p, r->start.y));
        iso_ball_to_point(&f.p, r->start.y, point);
        if (iso_exact_create(ctx, &f, point, all_clocks, &exact) != ISO_OK) continue;
        iso_exact_at(ctx, exact, ISO_CLOCK_T, r->t, point, clocks);
        iso_point_to_ball(&f.p, point, ball);
        for (int j = 0; j < ISO_STATE; j++) worst = fmax(worst, fabs(ball[j] - r->ball[j]));
        worst = fmax(worst, fabs(clocks[ISO_CLOCK_S] / r->s - 1));
        solved++;
        iso_exact_free(exact);
    }
    gsl_test(!(solved == 10 && worst < 1e-12), "%d of 10 reference states, and their s: %.1e", solved, worst);
}

/* From an umbilic of J = (1, 2, 3): always on the separatrix, away from a rotation about axis 2 and back to it.
 * There is no linear growth of errors to compare by: the stepped orbit itself loses the separatrix. */
static void check_homoclinic(void)
{
    static const double J[3] = {1, 2, 3}, times[] = {0, 0.3, -2, 5, -9, 14};
    const double r = sqrt(0.5);
    double worst = 0, away = 0, energy = 0;
    int kinds = 0;
    for (int i = 0; i < 2; i++) {
        const double angle = 0.4 + 2 * i, speed = sqrt(2 * 2.0);
        orbit o = {.ctx = ctx, .model.system = &iso_system_point, .model.problem.p = laws_params(-1, J)};
        o.model.problem.eps = 1;
        const double y0[ISO_STATE] = {r * speed * cos(angle), speed * sin(angle), -r * speed * cos(angle), r, 0, r};
        copy(y0, o.y0, ISO_STATE);
        orbit_clocks(&o, ISO_CLOCK_T, false, false, false);
        iso_exact *exact;
        if (iso_exact_create(ctx, &o.model.problem, o.y0, all_clocks, &exact) != ISO_OK) continue;
        kinds += iso_exact_describe(exact).kind == ISO_EXACT_SEPARATRIX;
        iso_integrator *it =
            orbit_start(&o, iso_method_find("taylor_extended"), &(iso_method_options){.tolerance = 1e-15});
        double expected[ISO_MAX_STATE], y[ISO_STATE], clocks[ISO_CLOCKS], size;
        for (int j = 0; j < 6; j++) {
            iso_exact_at(ctx, exact, ISO_CLOCK_T, times[j], y, clocks);
            if (iso_integrator_at(it, times[j], expected) != ISO_OK) expected[0] = NAN;
            worst = fmax(worst, orbit_error(&o, y, expected));
        }
        for (int j = 0; j < 4; j++) {
            iso_exact_at(ctx, exact, ISO_CLOCK_T, (j % 2 ? -1 : 1) * pow(10, 3 + 3 * j), y, clocks);
            away = fmax(away, fmax(fabs(y[4]), fmax(fabs(y[0]), fabs(y[2]))));
            energy = fmax(energy, fabs(iso_system_point.energy(&o.model.problem, y, &size)) / size);
        }
        iso_integrator_free(it);
        iso_exact_free(exact);
    }
    gsl_test(kinds != 2, "%d of 2 orbits from an umbilic are on the separatrix", kinds);
    gsl_test(!(worst < 3e-13), "they are what steps say: %.1e", worst);
    gsl_test(!(away == 0 && energy < 1e-14), "and end as a rotation: off it by %.1e, energy %.1e", away, energy);
}

/* Small oscillations of Neumann's point about its stable equilibrium, which M and gamma tell of and H does not. */
static void check_small_oscillations(void)
{
    static const double J[3] = {1, 1.5, 2};
    double worst = 0;
    for (double size = 1e-5; size > 1e-13; size /= 10) {
        orbit o = {.ctx = ctx, .model.system = &iso_system_point, .model.problem.p = laws_params(-1, J)};
        const double y0[ISO_STATE] = {size, -size, 0, size, size, sqrt(1 - 2 * size * size)};
        copy(y0, o.y0, ISO_STATE);
        o.model.problem.eps = 0.5;
        o.model.problem.energy = size * size - 0.5 * (2 - 1.5 * size * size);
        orbit_clocks(&o, ISO_CLOCK_S, false, false, false);
        iso_exact *exact;
        double expected[ISO_MAX_STATE], y[ISO_STATE], clocks[ISO_CLOCKS] = {NAN};
        if (iso_exact_create(ctx, &o.model.problem, o.y0, all_clocks, &exact) != ISO_OK) worst = INFINITY;
        iso_exact_at(ctx, exact, ISO_CLOCK_S, 10, y, clocks);
        iso_integrator *it =
            orbit_start(&o, iso_method_find("taylor_extended"), &(iso_method_options){.tolerance = 1e-15});
        if (iso_integrator_at(it, 10, expected) != ISO_OK) expected[0] = NAN;
        for (int i = 0; i < 5; i++)
            if (i != 2) worst = fmax(worst, fabs(y[i] - expected[i]) / size);
        if (isnan(clocks[ISO_CLOCK_T]) || isnan(clocks[ISO_CLOCK_TAU])) worst = INFINITY;
        iso_integrator_free(it);
        iso_exact_free(exact);
    }
    gsl_test(!(worst < 1e-13), "small oscillations of 1e-5 ... 1e-12, to their own size: %.1e", worst);
}

static void check_nearly_round(void)
{
    enum { ORBITS = 24 };
    double worst = 0, clock = 0, energy = 0;
    int refused = 0;
    for (int i = 0; i < ORBITS; i++) {
        const double part = pow(10, -3 - i / 2), J[3] = {2, 2 * (1 + part), 2 * (1 + 2.3 * part)};
        const orbit point = orbit_sample(ctx, &iso_system_point, i % 2 == 0 ? -1 : 1, J, 300 + (unsigned long)i);
        check_orbit(i, &point, &worst, &clock, &energy, &refused);
    }
    gsl_test(!(worst < 3e-14 && clock < 1e-14 && energy < 1e-14) || refused > 0,
             "%d bodies that are nearly round, %d refused: %.1e, clocks %.1e, energy %.1e", ORBITS, refused, worst,
             clock, energy);
}

int main(void)
{
    enum { ORBITS = 120 };
    double worst = 0, clock = 0, energy = 0;
    int refused = 0;
    ctx = iso_context_create();
    iso_random *random = iso_random_create(9);
    for (int i = 0; i < ORBITS; i++) {
        const orbit point = random_point(i, random);
        check_orbit(i, &point, &worst, &clock, &energy, &refused);
    }
    gsl_test(!(worst < 2e-12), "states of %d orbits within 20 turns: %.1e", ORBITS, worst);
    gsl_test(!(clock < 1e-13), "their clocks: %.1e", clock);
    gsl_test(!(energy < 1e-14), "their energy and |gamma| - 1: %.1e", energy);
    gsl_test(refused > ORBITS / 40, "%d refused, too close to the separatrix", refused);
    check_reference();
    check_homoclinic();
    check_small_oscillations();
    check_nearly_round();
    iso_random_free(random);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
