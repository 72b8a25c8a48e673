/* What a method promises: the error of fixed steps falls with the method's order, and the error of an adaptive run
 * with its tolerance. */
#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>

#include "orbits.h"

static iso_context *ctx;

/* --- order of convergence --------------------------------------------------------------------------------------- */

enum { SYSTEMS = 2, MOMENTS = 4, STATES = 8, BUNDLES = SYSTEMS * ORBIT_K * MOMENTS };

static const double moments[MOMENTS][3] = {{1.4, 2.1, 3.0}, {3.0, 1.4, 2.1}, {2.0, 1.0, 1.5}, {1.0, 1.5, 2.0}};

/* Orbits whose errors are measured as one, so that a change of sign of one error does not look like convergence. */
typedef struct bundle {
    orbit orbits[STATES];
    double reference[STATES][ISO_MAX_STATE];
    double arc; /* in units of each orbit */
} bundle;

static bundle bundles[BUNDLES];

static void make_bundles(double arc)
{
    bundle *b = bundles;
    for (int s = 0; s < SYSTEMS; s++)
        for (int k = 0; k < ORBIT_K; k++)
            for (int J = 0; J < MOMENTS; J++, b++)
                for (int i = 0; i < STATES; i++) {
                    b->arc = arc;
                    b->orbits[i] = orbit_sample(ctx, iso_systems[s], orbit_k[k], moments[J], 11 + (unsigned long)i);
                    if (J % 2 == 1) orbit_add_rotor(&b->orbits[i]);
                    orbit_reference(&b->orbits[i], arc * b->orbits[i].unit, b->reference[i]);
                }
}

/* bsimp takes a component that passes close to zero for a runaway one, and refuses the step. */
static bool refuses_steps(const iso_method *m)
{
    return m == iso_method_find("bsimp");
}

/* Root mean square; NaN when runs fail. */
static double bundle_error(const bundle *b, const iso_method *m, bool no_projection, double steps)
{
    double sum = 0;
    int runs = 0;
    for (int i = 0; i < STATES; i++) {
        const orbit *o = &b->orbits[i];
        const double t = b->arc * o->unit;
        double y[ISO_MAX_STATE];
        orbit_solve(o, m, &(iso_method_options){.fixed_step = t / steps, .no_projection = no_projection}, t, y);
        const double error = orbit_error(o, y, b->reference[i]);
        if (isnan(error) && refuses_steps(m)) continue;
        sum += error * error;
        runs++;
    }
    return runs > STATES / 2 ? sqrt(sum / runs) : NAN;
}

/* The slope over the last octave of step lengths whose errors stand clear of rounding, where the asymptotic order
 * shows best: before it come the next orders, after it rounding errors. */
static double measured_order(const bundle *b, const iso_method *m, bool no_projection)
{
    enum { OCTAVE = 2, POINTS = 20 }; /* half octaves */
    const double most = m->order == 0 || m->order > 4 ? 800 : 250;
    double error[POINTS], steps[POINTS];
    int z = -1;
    for (double n = 2; n < most && z < POINTS - 1; n *= M_SQRT2) {
        const double e = bundle_error(b, m, no_projection, round(n));
        if (e < 5e-13) break;
        if (isnan(e) && refuses_steps(m)) continue;
        error[++z] = e;
        steps[z] = round(n);
    }
    return z < OCTAVE ? NAN : log(error[z - OCTAVE] / error[z]) / log(steps[z] / steps[z - OCTAVE]);
}

/* The mean over all bundles, with the least and the largest. */
static double mean_order(const iso_method *m, bool no_projection, double *least, double *most)
{
    double order[BUNDLES];
    size_t count = 0;
    for (int i = 0; i < BUNDLES; i++) {
        const double p = measured_order(&bundles[i], m, no_projection);
        if (!isnan(p) || !refuses_steps(m)) order[count++] = p;
    }
    *least = gsl_stats_min(order, 1, count);
    *most = gsl_stats_max(order, 1, count);
    return count > BUNDLES / 2 ? gsl_stats_mean(order, 1, count) : NAN;
}

static void check_order(const iso_method *m, bool no_projection)
{
    double least, most;
    const double mean = mean_order(m, no_projection, &least, &most);
    gsl_test(!(fabs(mean - m->order) <= 0.25), "%s, %s: order %d, measured %.2f (%.2f to %.2f)", m->name,
             no_projection ? "bare" : "projected", m->order, mean, least, most);
}

/* bsimp extrapolates over seven columns, formally of order 13 (measured in 60 digits on a pendulum: 3 for two
 * columns, 5 for three). In doubles its error falls from 1e-6 to rounding while the step is halved: there is room to
 * see that its order is high, not to measure it, so it claims none. */
static void check_extrapolation(void)
{
    const iso_method *bsimp = iso_method_find("bsimp");
    double least, most;
    make_bundles(6);
    const double mean = mean_order(bsimp, true, &least, &most);
    gsl_test(bsimp->order != 0 || !(mean > 8), "bsimp: no order is claimed, that of seven columns is high: %.2f",
             mean);
}

/* Compositions reach rounding before their order shows on these short ways: see test_splitting.c. */
static void check_orders(void)
{
    make_bundles(1.5);
    const bool all = tests_length(0, 1); /* else each method in one way */
    for (int i = 0; iso_methods[i]; i++)
        for (int bare = 0; iso_methods[i]->order > 0 && !iso_methods[i]->system && bare <= 1; bare++)
            if (all || bare == i % 2) check_order(iso_methods[i], bare);
    check_extrapolation();
    for (int i = 0; iso_methods[i]; i++)
        gsl_test(!iso_methods[i]->fixed && iso_methods[i]->order > 0, "%s: what has an order takes fixed steps",
                 iso_methods[i]->name);
}

/* --- error against tolerance ------------------------------------------------------------------------------------ */

enum { ORBITS = SYSTEMS * ORBIT_K, TIGHTEST = 11, LOOSEST = 5 }; /* tolerances 1e-5 ... 1e-11 */

typedef struct sample {
    orbit orbit;
    double t, reference[ISO_MAX_STATE];
} sample;

static void make_samples(sample samples[ORBITS])
{
    for (int i = 0; i < ORBITS; i++) {
        sample *s = &samples[i];
        s->orbit = orbit_sample(ctx, iso_systems[i / ORBIT_K], orbit_k[i % ORBIT_K], orbit_J, 11);
        s->t = 20 * s->orbit.unit;
        orbit_reference(&s->orbit, s->t, s->reference);
    }
}

/* log10 of the geometric mean of the errors, which one orbit cannot dominate; the largest in *worst */
static double sample_error(const sample samples[ORBITS], const iso_method *m, double tolerance, double *worst)
{
    double sum = 0;
    int count = 0;
    *worst = 0;
    for (int i = 0; i < ORBITS; i++) {
        const sample *s = &samples[i];
        if (!orbit_served(m, s->orbit.model.system)) continue;
        double y[ISO_MAX_STATE];
        orbit_solve(&s->orbit, m, &(iso_method_options){.tolerance = tolerance}, s->t, y);
        const double error = orbit_error(&s->orbit, y, s->reference);
        sum += log10(error);
        count++;
        if (!(error <= *worst)) *worst = error;
    }
    return sum / count;
}

/* The error after 20 radians is C times the tolerance, C about the number of steps: up to 300 for one-step methods,
 * up to 10^4 for multistep ones. It falls like the tolerance: slope 1, but 4/5 for rk4, whose step doubling estimates
 * the fifth order of a fourth-order solution, and 5/6 for a BDF of order 5. */
static void check_tolerance(const sample samples[ORBITS], const iso_method *m)
{
    const int tightest = m->order == 2 ? 8 : TIGHTEST; /* 10^5 steps of order 2 */
    const double C = m->fixed ? 500 : 1e4;
    double x[TIGHTEST], y[TIGHTEST], worst_ratio = 0, shift, slope, unused[4];
    size_t count = 0;
    for (int digits = LOOSEST; digits <= tightest; digits++, count++) {
        double worst;
        x[count] = -digits;
        y[count] = sample_error(samples, m, pow(10, -digits), &worst);
        if (!(worst * pow(10, digits) <= worst_ratio)) worst_ratio = worst * pow(10, digits);
    }
    gsl_fit_linear(x, 1, y, 1, count, &shift, &slope, &unused[0], &unused[1], &unused[2], &unused[3]);
    const double expected = m->reference ? 0 : 1; /* what is left is the error it is measured against */
    gsl_test(!(fabs(slope - expected) <= 0.25), "%s: error falls with the tolerance, slope %.2f", m->name, slope);
    gsl_test(!(worst_ratio < C), "%s: error at 20 at most %.0f tolerances, allowed %.0f", m->name, worst_ratio, C);
}

int main(void)
{
    static sample samples[ORBITS];
    ctx = iso_context_create();
    check_orders();
    make_samples(samples);
    for (int i = 0; iso_methods[i]; i++) check_tolerance(samples, iso_methods[i]);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
