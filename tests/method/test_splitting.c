/* The compositions of lib/method/symplectic.c: their orders, what they keep, the way back, times between steps. */
#include "orbits.h"

static iso_context *ctx;

static const char *const names[] = {"strang", "blanes_moan4", "blanes_moan6", "kahan_li8", "sofroniou_spaletta10"};
enum { METHODS = sizeof names / sizeof *names };

/* An orbit of the point that carries t and tau. */
static orbit sample(double k, unsigned long seed)
{
    orbit o = orbit_sample(ctx, &iso_system_point, k, orbit_J, seed);
    orbit_clocks(&o, ISO_CLOCK_S, true, true, false);
    return o;
}

/* --- order ------------------------------------------------------------------------------------------------------ */

enum { STATES = 12, ARC = 40, FINE = 1600 };

typedef struct bundle {
    orbit orbits[STATES];
    double reference[STATES][ISO_MAX_STATE];
} bundle;

static bundle make_bundle(double k)
{
    bundle b;
    for (int i = 0; i < STATES; i++) {
        orbit *const o = &b.orbits[i];
        *o = sample(k, 31 + (unsigned long)i);
        orbit_solve(o, iso_method_find("sofroniou_spaletta10"),
                    &(iso_method_options){.fixed_step = ARC * o->unit / FINE}, ARC * o->unit, b.reference[i]);
    }
    return b;
}

/* Root mean square over the orbits of the error of M and gamma (error[0]) and of the clocks (error[1]). */
static void mean_errors(const bundle *b, const iso_method *m, double steps, double error[2])
{
    error[0] = error[1] = 0;
    for (int i = 0; i < STATES; i++) {
        const orbit *const o = &b->orbits[i];
        const double s = ARC * o->unit, *const r = b->reference[i];
        double y[ISO_MAX_STATE], size[ISO_MAX_STATE], worst[2] = {0, 0};
        orbit_solve(o, m, &(iso_method_options){.fixed_step = s / steps}, s, y);
        iso_model_size(&o->model, r, size);
        for (int j = 0; j < o->model.dim; j++)
            worst[j >= ISO_STATE] = fmax(worst[j >= ISO_STATE], fabs(y[j] - r[j]) / size[j]);
        for (int part = 0; part < 2; part++) error[part] += worst[part] * worst[part] / STATES;
    }
    for (int part = 0; part < 2; part++) error[part] = sqrt(error[part]);
}

/* The slope over the last octave of steps whose errors stand clear of rounding. Before it the error falls faster than
 * any power; order 10 shows no other part of its fall in doubles, and only the least it must be can be asked of it.
 * */
static void check_order(const bundle *b, const iso_method *m)
{
    enum { OCTAVE = 2, POINTS = 14 }; /* half octaves */
    static const char *const parts[] = {"state", "clocks"};
    static const double rounding[] = {4e-13, 1e-14};
    double error[POINTS][2], order[2] = {NAN, NAN}, steps = ARC;
    for (int n = 0; n < POINTS; n++, steps *= M_SQRT2) {
        mean_errors(b, m, round(steps), error[n]);
        for (int part = 0; part < 2; part++)
            if (n >= OCTAVE && error[n][part] > rounding[part])
                order[part] = log2(error[n - OCTAVE][part] / error[n][part]);
    }
    for (int part = 0; part < 2; part++) {
        const double most = m->order == 10 ? INFINITY : m->order + 0.2;
        gsl_test(!(order[part] >= m->order - 0.2 && order[part] <= most), "%s, k = %g: order %d, %s measured %.2f",
                 m->name, b->orbits->model.problem.p.k, m->order, parts[part], order[part]);
    }
}

/* --- long runs -------------------------------------------------------------------------------------------------- */

static int steps_of_long_runs(void)
{
    return tests_length(100000, 1000000);
}

/* A million steps and back. */
static void check_reversal(const char *name, double k, double step, double bound)
{
    orbit o = sample(k, 3);
    const double s = steps_of_long_runs() * step * o.unit;
    const iso_method_options options = {.fixed_step = step * o.unit};
    double there[ISO_MAX_STATE], back[ISO_MAX_STATE];
    orbit_solve(&o, iso_method_find(name), &options, s, there);
    orbit end = o;
    copy(there, end.y0, o.model.dim);
    orbit_solve(&end, iso_method_find(name), &options, -s, back);
    const double error = orbit_error(&o, back, o.y0);
    gsl_test(!(error < bound), "%s, k = %g, step %g: 1e6 steps and back %.1e, allowed %.0e", name, k, step, error,
             bound);
}

/* --- effects and times ------------------------------------------------------------------------------------------ */

/* A body-fixed field, and a start off the level H = 0 */
static orbit with_effects(double k, bool field, double stretch)
{
    static const double quadratic[9] = {0.3, 0.1, 0, 0.1, -0.2, 0.05, 0, 0.05, 0.1}, linear[3] = {0.1, -0.2, 0.15};
    orbit o = sample(k, 5);
    iso_problem *const f = &o.model.problem;
    double size;
    f->effects.on[ISO_FIELD] = field;
    copy(quadratic, FIELD_QUADRATIC(&f->effects), 9);
    copy(linear, FIELD_LINEAR(&f->effects), 3);
    for (int i = 0; i < 3; i++) o.y0[i] *= stretch;
    f->energy = iso_system_point.energy(f, o.y0, &size);
    orbit_clocks(&o, ISO_CLOCK_S, true, true, false);
    return o;
}

static void check_effects(const iso_method *m)
{
    const double tolerance = m->order == 2 ? 1e-7 : 1e-10;
    double worst = 0;
    for (int i = 0; i < 4 * ORBIT_K; i++)
        for (int direction = -1; direction <= 1; direction += 2) {
            const orbit o = with_effects(orbit_k[i / 4], i % 2, i % 4 < 2 ? 1 : 0.5);
            const double s = direction * 10 / iso_system_point.speed(&o.model.problem, o.y0);
            double y[ISO_MAX_STATE], expected[ISO_MAX_STATE];
            orbit_solve(&o, m, &(iso_method_options){.tolerance = tolerance}, s, y);
            orbit_reference(&o, s, expected);
            worst = fmax(worst, orbit_error(&o, y, expected) / tolerance);
        }
    gsl_test(!(worst < 75), "%s: field and other levels, both ways: %.0f tolerances after 10 radians", m->name,
             worst);
}

/* Times between the steps, in s and in t: as far from the truth as the ends of steps are, and t is met exactly. */
static void check_between(const iso_method *m, iso_clock clock)
{
    orbit o = sample(0.5, 9), in_s = o;
    orbit_clocks(&o, clock, clock != ISO_CLOCK_T, false, clock != ISO_CLOCK_S);
    const iso_method_options options = {.tolerance = m->order == 2 ? 1e-7 : 1e-10};
    iso_integrator *it = orbit_start(&o, m, &options);
    double worst = 0, met = 0;
    for (int i = -50; i <= 50; i++) {
        const double time = 0.1 * i * o.unit;
        double y[ISO_MAX_STATE], expected[ISO_MAX_STATE], same[ISO_MAX_STATE];
        if (iso_integrator_at(it, time, y) != ISO_OK) exit(1);
        orbit_reference(&o, time, expected);
        worst = fmax(worst, orbit_error(&o, y, expected) / options.tolerance);
        if (clock != ISO_CLOCK_T || i == 0) continue;
        orbit_solve(&in_s, m, &options, y[ISO_STATE], same); /* at the s found, t is the time asked for */
        met = fmax(met, fabs(same[ISO_STATE] - time) / o.unit);
    }
    gsl_test(!(worst < 75), "%s: any %s, %.1f tolerances", m->name, iso_clock_name(clock), worst);
    gsl_test(!(met < 1e-14), "%s: the s of a t, to %.1e", m->name, met);
    iso_integrator_free(it);
}

static void check_refusals(const iso_method *m)
{
    orbit o = sample(1, 3);
    iso_integrator *it = (iso_integrator *)&o; /* must become NULL */
    orbit_clocks(&o, ISO_CLOCK_T, false, false, false);
    const iso_status status = iso_integrator_create(ctx, m, &o.model, &(iso_method_options){.fixed_step = 0.1}, &it);
    gsl_test(status != ISO_BAD_ARGUMENT || it || strcmp(iso_context_about(ctx), "method") != 0, "refused: %s",
             iso_context_message(ctx));
}

int main(void)
{
    ctx = iso_context_create();
    for (int k = 0; k < 2; k++) {
        const bundle b = make_bundle(orbit_k[k]);
        for (int i = 0; i < METHODS; i++) check_order(&b, iso_method_find(names[i]));
    }
    for (int k = 0; k < 2; k++) {
        check_reversal("kahan_li8", orbit_k[k], 0.001, 1e-12);
        check_reversal("strang", orbit_k[k], 0.001, 1e-12);
    }
    for (int i = 0; i < METHODS; i++) {
        const iso_method *const m = iso_method_find(names[i]);
        check_effects(m);
        check_between(m, ISO_CLOCK_S);
        check_between(m, ISO_CLOCK_T);
        check_refusals(m);
    }
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
