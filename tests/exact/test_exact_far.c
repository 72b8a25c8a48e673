/* The closed solution far away: against long runs by steps, against the two motions of which the angle is known, on
 * its integrals, and the same from wherever it is started. */
#include "exact_orbits.h"

static iso_context *ctx;

/* A start given in doubles allows an error of the state: a rounding error of its frequencies times the way. For the
 * axis' orbit here it is 1e-15 times its condition, 8e4 at 5e4. So the bound is proportional to the length. The
 * reference: long double without restoring the second integral (test_exact_near.c) and, for much longer, doubles with
 * it. */
static void check_steps(const char *method, bool restored, int count, double units, double allowed)
{
    static const exact_family list[3] = {EXACT_LEVEL, EXACT_ANY, EXACT_AXIS};
    iso_random *random = iso_random_create(31);
    laws_worst worst = {0};
    for (int i = 0; i < count; i++) {
        orbit o = exact_orbit(ctx, list[i], i, 0, random);
        iso_exact *exact = exact_create(&o);
        double y[ISO_MAX_STATE], expected[ISO_MAX_STATE];
        o.model.problem.effects.on[ISO_FIELD] = !restored;
        orbit_clocks(&o, ISO_CLOCK_T, false, false, false);
        const double time = (i % 2 ? -1 : 1) * units * o.unit;
        orbit_solve(&o, iso_method_find(method), &(iso_method_options){.tolerance = 1e-15}, time, expected);
        if (iso_exact_at(ctx, exact, ISO_CLOCK_T, time, y, NULL) != ISO_OK) y[0] = NAN;
        laws_note(&worst, orbit_error(&o, y, expected), allowed, &o.model.problem.p, exact_names[list[i]]);
        iso_exact_free(exact);
    }
    char name[64];
    snprintf(name, sizeof name, "%s over %g", method, units);
    laws_report(&worst, name);
    iso_random_free(random);
}

/* --- against known angles --------------------------------------------------------------------------------------- */

/* The ball's n = (cos a, -sin a, 0), a = k w t, w = (2 h/J3)^(1/2) > 0: in a plane, or any way if J1 = J2 = J3. */
static void check_known(double k, const double J[3], laws_worst *worst)
{
    static const double times[] = {1, -1e3, 1e6, -1e9, 1e12};
    orbit o = {.ctx = ctx, .model.system = &iso_system_point};
    exact_start(&o, k, J, (const double[]){1, 0, 0}, (const double[]){0, 0, k}, 0); /* NN has the sign of k */
    iso_exact *exact = exact_create(&o);
    const long double det = (long double)J[0] * J[1] * J[2], w = sqrtl(2 * (long double)k * k / det / J[2]);
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        double y[ISO_STATE];
        const long double angle = k * w * times[i];
        const double expected[3] = {(double)cosl(angle), (double)-sinl(angle), 0};
        if (iso_exact_at(ctx, exact, ISO_CLOCK_T, times[i], y, NULL) != ISO_OK) y[0] = NAN;
        iso_point_to_ball(&o.model.problem.p, y, y);
        const double allowed = (double)(8 * LDBL_EPSILON * fabsl(angle)) + 8 * DBL_EPSILON;
        laws_note(worst, laws_distance(y + 3, expected), allowed, &o.model.problem.p, "");
    }
    iso_exact_free(exact);
}

static void check_known_angles(void)
{
    static const double k[] = {1, -1, 0.5, -0.4, 3};
    laws_worst plane = {0}, equal = {0};
    for (size_t i = 0; i < sizeof k / sizeof *k; i++) {
        check_known(k[i], orbit_J, &plane);
        check_known(k[i], (const double[]){3, 1.4, 2.1}, &plane);
        check_known(k[i], (const double[]){2, 2, 3}, &plane);
        check_known(k[i], (const double[]){2.3, 2.3, 2.3}, &equal);
    }
    laws_report(&plane, "the angle in a plane, to t = 1e12");
    laws_report(&equal, "the angle on a great circle, to t = 1e12");
}

/* --- integrals and restarts ------------------------------------------------------------------------------------- */

static void note_integrals(const orbit *o, const double y[ISO_STATE], laws_worst *worst)
{
    const iso_problem *f = &o->model.problem;
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const int count = iso_integrals_holding(&iso_system_point, f, list, ISO_MAX_INTEGRALS);
    for (int i = 0; i < count; i++) {
        double size;
        const double change = list[i]->value(f, y, &size) - list[i]->value(f, o->y0, &size);
        laws_note(worst, fabs(change) / size, 1e-13, &f->p, list[i]->name);
    }
    if (iso_params_symmetric(&f->p, 0) || iso_params_symmetric(&f->p, 1) || iso_params_symmetric(&f->p, 2)) return;
    iso_conical at;
    double excess[3], now[3];
    iso_separation_coordinates(&f->p, o->y0, &at);
    iso_separation_constant(f, &at, excess);
    iso_separation_coordinates(&f->p, y, &at);
    iso_separation_constant(f, &at, now);
    for (int j = 0; j < 3 && isfinite(excess[0]); j++)
        laws_note(worst, fabs(now[j] - excess[j]) / laws_max(3, excess), 1e-13, &f->p, "the constant of separation");
}

/* At t1 + t2 as from t1 on for t2. All three have few digits in binary. From t1 on the start is rounded, and its
 * error grows with t2; the angles at t1 and at t1 + t2 are rounded numbers of long double. */
static void note_restart(const orbit *o, const iso_exact *exact, double t1, laws_worst *states, laws_worst *clocks)
{
    static const double t2[] = {0, 8, -64, 1024};
    orbit there = *o;
    const iso_params *p = &o->model.problem.p;
    double c1[ISO_CLOCKS];
    if (iso_exact_at(ctx, exact, ISO_CLOCK_T, t1, there.y0, c1) != ISO_OK) there.y0[0] = NAN;
    iso_exact *again;
    if (iso_exact_create(ctx, &there.model.problem, there.y0, exact_clocks, &again) != ISO_OK) {
        laws_note(states, NAN, 0, p, iso_context_message(ctx));
        return;
    }
    for (size_t i = 0; i < sizeof t2 / sizeof *t2; i++) {
        double y[ISO_STATE], z[ISO_STATE], c[ISO_CLOCKS], c2[ISO_CLOCKS];
        if (iso_exact_at(ctx, exact, ISO_CLOCK_T, t1 + t2[i], y, c) != ISO_OK) y[0] = NAN;
        if (iso_exact_at(ctx, again, ISO_CLOCK_T, t2[i], z, c2) != ISO_OK) z[0] = NAN;
        orbit state = *o;
        state.model.dim = ISO_STATE, state.model.clocks = 0;
        const double allowed = 5e-14 * (1 + fabs(t2[i]) / o->unit) + (double)(16 * LDBL_EPSILON * fabs(t1) / o->unit);
        laws_note(states, orbit_error(&state, y, z), allowed, p, "");
        for (int j = 0; j < ISO_CLOCKS; j++)
            laws_note(clocks, fabs(c[j] - c1[j] - c2[j]), 1e-14 * fabs(c2[j]) + 2 * DBL_EPSILON * fabs(c[j]), p, "");
    }
    iso_exact_free(again);
}

static void check_integrals_and_restarts(void)
{
    enum { ORBITS = 60 };
    static const double far[] = {0x1p10, -0x1p20, 0x1p30, -0x1p40};
    iso_random *random = iso_random_create(32);
    laws_worst integrals = {0}, states = {0}, clocks = {0};
    for (int i = 0; i < ORBITS; i++) {
        orbit o = exact_orbit(ctx, (exact_family)(i % EXACT_SEPARATRIX), i, 0, random);
        iso_exact *exact = exact_create(&o);
        orbit_clocks(&o, ISO_CLOCK_T, false, true, true);
        for (size_t j = 0; j < sizeof far / sizeof *far; j++) {
            double y[ISO_STATE];
            if (iso_exact_at(ctx, exact, ISO_CLOCK_T, far[j], y, NULL) != ISO_OK) y[0] = NAN;
            note_integrals(&o, y, &integrals);
            note_restart(&o, exact, far[j], &states, &clocks);
        }
        iso_exact_free(exact);
    }
    laws_report(&integrals, "integrals to t = 1e12");
    laws_report(&states, "restarted to t = 1e12");
    laws_report(&clocks, "clocks of these");
    iso_random_free(random);
}

int main(void)
{
    ctx = iso_context_create();
    const double units = tests_length(5000, 10000), more = tests_length(100000, 300000);
    check_steps("taylor_extended", false, 3, units, units * 1.6e-15);
    check_steps("taylor", true, 2, more, more * 1e-15);
    check_known_angles();
    check_integrals_and_restarts();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
