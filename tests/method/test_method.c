/* The contract of lib/method/method.h, held by every method on both systems and four k. */
#include <gsl/gsl_integration.h>

#include "orbits.h"

/* A clause of the contract: notes what it finds of one method on one orbit. */
typedef void clause(const orbit *o, const iso_method *m, laws_worst *worst);

static iso_context *ctx;

static void hold(const char *name, clause *check)
{
    laws_worst worst = {0};
    for (int i = 0; iso_methods[i]; i++)
        for (int s = 0; iso_systems[s]; s++)
            for (int k = 0; k < ORBIT_K; k++) {
                const orbit o = orbit_sample(ctx, iso_systems[s], orbit_k[k], orbit_J, 5 + (unsigned long)k);
                if (orbit_served(iso_methods[i], iso_systems[s])) check(&o, iso_methods[i], &worst);
            }
    laws_report(&worst, name);
}

/* Low orders get a tolerance they reach within 10^4 steps. */
static iso_method_options options_for(const iso_method *m)
{
    return (iso_method_options){.tolerance = m->order == 2 ? 1e-7 : m->order == 3 ? 1e-8 : 1e-9};
}

enum { TURN = 5 }; /* how far orbits are followed, in units; */

/* and the error they may have then: the C of tests/method/test_order.c for a quarter of its way */
static double allowed(const iso_method *m)
{
    return (m->order ? 75 : 2500) * options_for(m).tolerance;
}

static void note(laws_worst *worst, const orbit *o, const iso_method *m, double error, double bound)
{
    char what[64];
    snprintf(what, sizeof what, "%s %s", m->name, o->model.system->name);
    laws_note(worst, error, bound, &o->model.problem.p, what);
}

/* For what must be so exactly. */
static void note_same(laws_worst *worst, const orbit *o, const iso_method *m, const double a[], const double b[])
{
    note(worst, o, m, memcmp(a, b, (size_t)o->model.dim * sizeof *a) != 0, 0.5);
}

static void note_true(laws_worst *worst, const orbit *o, const iso_method *m, bool good)
{
    note(worst, o, m, !good, 0.5);
}

static iso_integrator *start(const orbit *o, const iso_method *m)
{
    const iso_method_options options = options_for(m);
    return orbit_start(o, m, &options);
}

static void solve(const orbit *o, const iso_method *m, double t, double y[])
{
    const iso_method_options options = options_for(m);
    orbit_solve(o, m, &options, t, y);
}

/* --- the same again ---------------------------------------------------------------------------------------------- */

/* (w, n, t) -> (-w, n, -t) maps every orbit to one, and every step of a method to a step, bit by bit. */
static void reversal(const orbit *o, const iso_method *m, laws_worst *worst)
{
    orbit mirror = *o;
    double past[ISO_MAX_STATE], future[ISO_MAX_STATE];
    scale(mirror.y0, -1);
    solve(o, m, -TURN * o->unit, past);
    solve(&mirror, m, TURN * o->unit, future);
    scale(future, -1);
    note_same(worst, o, m, past, future);
}

static void starting_again(const orbit *o, const iso_method *m, laws_worst *worst)
{
    const orbit other = orbit_sample(ctx, o->model.system, o->model.problem.p.k, orbit_J, 99);
    iso_integrator *it = start(o, m);
    double y[ISO_MAX_STATE], first[ISO_MAX_STATE];
    iso_integrator_at(it, 0, y);
    note_same(worst, o, m, y, o->y0);
    iso_integrator_at(it, o->unit, first);
    iso_integrator_start(it, other.y0);
    iso_integrator_at(it, o->unit, y);
    iso_integrator_start(it, o->y0);
    iso_integrator_at(it, o->unit, y);
    note_same(worst, o, m, y, first);
    iso_integrator_free(it);
}

/* --- what it says of itself ------------------------------------------------------------------------------------- */

static void statistics(const orbit *o, const iso_method *m, laws_worst *worst)
{
    double y[ISO_MAX_STATE], last[ISO_MAX_STATE], t;
    iso_integrator *it = start(o, m);
    iso_statistics s = iso_integrator_statistics(it);
    note_true(worst, o, m, s.steps == 0 && s.rejected == 0 && s.rhs <= 1 && s.jacobians == 0 && s.correction == 0);
    iso_integrator_at(it, TURN * o->unit, y);
    s = iso_integrator_statistics(it);
    note_true(worst, o, m, s.steps >= TURN && s.steps < 100000);
    const long trials = m->system ? 40000 : 0;                                  /* of fixed steps, before the first */
    note_true(worst, o, m, s.rhs >= s.steps && s.rhs < 300 * s.steps + trials); /* bsimp makes 138 in a step */
    note_true(worst, o, m, s.rejected >= 0 && s.rejected < s.steps);
    note_true(worst, o, m, (s.jacobians > 0) == m->implicit && s.jacobians <= s.rhs);
    iso_integrator_last(it, &t, last);
    note_true(worst, o, m, t >= TURN * o->unit && t < (TURN + 3) * o->unit);
    solve(o, m, t, y);
    note(worst, o, m, orbit_error(o, last, y), allowed(m));
    iso_integrator_free(it);
}

/* How far energy, spin and length, the first three integrals of either system, are from where they belong. */
static double defect(const orbit *o, const double y[])
{
    const double proper[3] = {o->model.problem.energy, 0, 1};
    double defects[3];
    for (int i = 0; i < 3; i++) {
        double size;
        const double value = o->model.system->integrals[i].value(&o->model.problem, y, &size);
        defects[i] = (value - proper[i]) / size;
    }
    return laws_max(3, defects);
}

static void projection(const orbit *o, const iso_method *m, laws_worst *worst)
{
    iso_integrator *it = start(o, m);
    for (int i = -10; i <= 10 && m->projects; i++) {
        double y[ISO_MAX_STATE];
        iso_integrator_at(it, i * o->unit / 2, y);
        note(worst, o, m, defect(o, y), 4 * DBL_EPSILON);
    }
    const double correction = iso_integrator_statistics(it).correction;
    note(worst, o, m, correction, m->projects ? allowed(m) : DBL_MIN);
    note_true(worst, o, m, correction > 0 || !m->projects);
    iso_integrator_free(it);
}

/* Without projection, or by methods that do not project, the same defects are visible. */
static void no_projection(const orbit *o, const iso_method *m, laws_worst *worst)
{
    iso_method_options options = options_for(m);
    if (m->reference) return;                                             /* no drift that a double could show */
    if (m->own_equations && o->model.system == &iso_system_point) return; /* of second order, on the sphere alone */
    if (m->own_equations) options.tolerance *= 100;                       /* long double is too good for its own */
    options.no_projection = true;
    iso_integrator *it = orbit_start(o, m, &options);
    double y[ISO_MAX_STATE];
    iso_integrator_at(it, TURN * o->unit, y);
    note_true(worst, o, m, defect(o, y) > 20 * DBL_EPSILON);
    note(worst, o, m, defect(o, y), 4 * allowed(m));
    note_true(worst, o, m, iso_integrator_statistics(it).correction == 0);
    iso_integrator_free(it);
}

/* --- clocks ----------------------------------------------------------------------------------------------------- */

/* The time of `clock` along the orbit from 0 to t, by Gauss and Legendre's rule over states from elsewhere. */
static double quadrature(const orbit *o, iso_clock clock, double t)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(96);
    iso_integrator *it = orbit_start(o, iso_method_find("rk8pd"), &(iso_method_options){.tolerance = 1e-14});
    double sum = 0;
    for (size_t i = 0; i < 96; i++) {
        double x, weight, y[ISO_MAX_STATE];
        gsl_integration_glfixed_point(0, t, i, &x, &weight, rule);
        iso_integrator_at(it, x, y);
        const double q = o->model.system->q(&o->model.problem.p, y, NULL);
        sum += weight * iso_clock_rate(&o->model.problem.p, clock, q, NULL) /
               iso_clock_rate(&o->model.problem.p, o->model.clock, q, NULL);
    }
    iso_integrator_free(it);
    gsl_integration_glfixed_table_free(rule);
    return sum;
}

static void carried_clocks(const orbit *plain, const iso_method *m, laws_worst *worst)
{
    orbit o = *plain;
    double y[ISO_MAX_STATE];
    orbit_clocks(&o, o.model.clock, true, true, true);
    solve(&o, m, -TURN * o.unit, y);
    for (int c = 0; c < o.model.clocks; c++) {
        const double expected = quadrature(plain, o.model.clock_of[c], -TURN * o.unit);
        note(worst, &o, m, fabs(y[ISO_STATE + c] / expected - 1), allowed(m));
    }
    note_true(worst, &o, m, o.model.clocks == 2);
}

/* --- special orbits --------------------------------------------------------------------------------------------- */

static void rest(const orbit *moving, const iso_method *m, laws_worst *worst)
{
    orbit o = *moving;
    double y[ISO_MAX_STATE];
    scale(o.y0, 0);
    o.model.problem.energy = o.model.problem.eps = 0;
    iso_integrator *it = start(&o, m);
    note_true(worst, &o, m, iso_integrator_at(it, 1000, y) == ISO_OK);
    note_true(worst, &o, m, norm(y) == 0);
    note(worst, &o, m, laws_distance(y + 3, o.y0 + 3), 4 * DBL_EPSILON);
    note_true(worst, &o, m, iso_integrator_statistics(it).steps < 1000);
    iso_integrator_free(it);
}

int main(void)
{
    ctx = iso_context_create();
    hold("mirrored in time, bit for bit", reversal);
    hold("starting again", starting_again);
    hold("statistics and the last step", statistics);
    hold("projection restores energy, spin and length", projection);
    hold("without projection they drift", no_projection);
    hold("carried clocks against quadrature", carried_clocks);
    hold("rest", rest);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
