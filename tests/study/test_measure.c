/* The invariant measure: the flow keeps the right measure; wrong measures and resistance are detected. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "laws.h"
#include "length.h"
#include "map/section_impl.h"
#include "study/section/measure.h"

static iso_context *ctx;

typedef iso_status test_of(iso_context *, const iso_scene *, const iso_measure_options *, iso_measure *);

/* A scene of a ball that turns at about one radian per unit of time */
static iso_scene scene_of(double k, double J1, double J2, double J3)
{
    iso_scene scene = iso_scene_default();
    const double J[3] = {J1, J2, J3}, w[3] = {0.8, 0.5, -0.6}, n[3] = {0.6, 0, 0.8};
    scene.params = laws_params(k, J);
    if (iso_start_ball(ctx, w, n, ISO_SPIN_REMOVE, &scene.start) != ISO_OK) exit(1);
    return scene;
}

static void with(iso_scene *scene, const char *effect, const char *name, int count, const double values[])
{
    if (iso_effects_set(ctx, &scene->effects, effect, name, count, values) != ISO_OK) exit(1);
}

/* Runs a test; false: it failed to run, which is reported. */
static bool run(test_of *test, const iso_scene *scene, const iso_measure_options *o, iso_measure *m)
{
    const iso_status status = test(ctx, scene, o, m);
    if (status != ISO_OK) gsl_test(1, "the measure, k = %g: %s", scene->params.k, iso_context_message(ctx));
    return status == ISO_OK;
}

static const char *kind(test_of *test)
{
    return test == iso_measure_flow ? "flow" : "returns";
}

static iso_measure_options options_of(size_t count)
{
    iso_measure_options o = iso_measure_defaults();
    o.count = count;
    return o;
}

/* The right measure is kept. p < 1e-4 by chance once in 10000 runs. */
static void kept(test_of *test, const iso_scene *scene, const iso_measure_options *o)
{
    iso_measure m;
    if (!run(test, scene, o, &m)) return;
    const iso_measure_entry *worst = &m.line[m.worst];
    gsl_test(!m.kept || m.p < o->significance, "%s in %s, k = %g, %zu orbits: p = %.2g (%s, %.3g), resolution %.2g",
             kind(test), iso_clock_name(o->clock), scene->params.k, m.count, m.p, worst->name, worst->deviation,
             m.resolution);
}

/* The right exponent is kept, a wrong one is found out, and `resolution` says before that it will be. */
static void found_out(test_of *test, const iso_scene *scene, iso_measure_options o, double wrong)
{
    iso_measure m;
    if (!run(test, scene, &o, &m)) return;
    gsl_test(!(m.resolution < wrong) || !m.kept, "%s, k = %g, %zu orbits: p = %.2g, resolution %.2g", kind(test),
             scene->params.k, m.count, m.p, m.resolution);
    for (int sign = wrong < 0.05 ? 1 : -1; sign <= 1; sign += 2) { /* long clouds: one sign */
        o.exponent = 1 + sign * wrong;
        if (!run(test, scene, &o, &m)) return;
        gsl_test(m.kept, "%s, k = %g, exponent %g: p = %.2g (%s, %.3g)", kind(test), scene->params.k, o.exponent, m.p,
                 m.line[m.worst].name, m.line[m.worst].deviation);
    }
}

/* --- exact means ------------------------------------------------------------------------------------------------ */

static const iso_measure_entry *line_of(const iso_measure *m, const char *name)
{
    for (int i = 0; i < m->lines; i++)
        if (strcmp(m->line[i].name, name) == 0) return &m->line[i];
    gsl_test(1, "there is a line %s", name);
    exit(gsl_test_summary());
}

/* The expected means against another quadrature, of g^power over latitudes and longitudes of n, power = 1/(2k) - 1/2
 * in t, 1/k - 3/2 in tau, -3/2 in s: midpoints and the trapezoidal rule, Richardson's extrapolation to 1e-9. */
static void sphere_means(const iso_params *p, double power, int rings, double mean[3])
{
    double sum[4] = {0};
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < 400; j++) {
            const double z = -1 + (2 * i + 1.0) / rings, r = sqrt(1 - z * z), f = 2 * M_PI * j / 400;
            const double n[3] = {r * cos(f), r * sin(f), z}, g = dot_diag(n, p->inv_J, n), weight = pow(g, power);
            sum[3] += weight;
            sum[0] += weight * log(g);
            sum[1] += weight * n[0] * n[0];
            sum[2] += weight * n[1] * n[1];
        }
    for (int i = 0; i < 3; i++) mean[i] = sum[i] / sum[3];
}

static void expectations(double k, iso_clock clock, double power)
{
    const iso_scene scene = scene_of(k, 2, 5, 1);
    iso_measure_options o = options_of(ISO_MEASURE_LEAST);
    iso_measure m;
    o.clock = clock;
    o.end = 1e-9;
    if (!run(iso_measure_flow, &scene, &o, &m)) return;
    double coarse[3], fine[3];
    sphere_means(&scene.params, power, 500, coarse);
    sphere_means(&scene.params, power, 1000, fine);
    const char *const name[3] = {"ln g", "n1^2", "n2^2"};
    for (int i = 0; i < 3; i++)
        gsl_test_abs(line_of(&m, name[i])->expected, (4 * fine[i] - coarse[i]) / 3, 1e-9, "mean of %s, k = %g, in %s",
                     name[i], k, iso_clock_name(clock));
}

/* The same on the section: the trapezoidal rule over the turn of l. */
static void expectations_of_returns(double k)
{
    const iso_scene scene = scene_of(k, 2, 5, 1);
    const iso_measure_options o = options_of(ISO_MEASURE_LEAST);
    iso_measure m;
    if (!run(iso_measure_returns, &scene, &o, &m)) return;
    double sum[3] = {0};
    for (int i = 0; i < 1000; i++) {
        const double l = 2 * M_PI * i / 1000, G = iso_section_momentum(iso_free_point(&scene.params, 0.5), m.axis, l);
        sum[0] += G;
        sum[1] += G * log(G);
        sum[2] += G * cos(2 * l);
    }
    gsl_test_abs(line_of(&m, "ln G")->expected, sum[1] / sum[0], 1e-12, "mean of ln G, k = %g", k);
    gsl_test_abs(line_of(&m, "cos 2l")->expected, sum[2] / sum[0], 1e-12, "mean of cos 2l, k = %g", k);
}

/* --- what is kept and what is not ------------------------------------------------------------------------------- */

static void right_measures(void)
{
    const double k[] = {0.5, 1, -1, -0.4, 4};
    for (size_t i = 0; i < sizeof k / sizeof *k; i++) {
        const iso_scene scene = scene_of(k[i], 1.4, 2.1, 3);
        iso_measure_options o = options_of((size_t)tests_length(4000, 20000));
        for (iso_clock clock = ISO_CLOCK_T; clock < ISO_CLOCKS; clock++) {
            o.clock = clock;
            kept(iso_measure_flow, &scene, &o);
        }
        kept(iso_measure_returns, &scene, &o);
    }
    const iso_scene round = scene_of(0.5, 2, 2, 2), symmetric = scene_of(0.5, 3, 2, 2),
                    wide = scene_of(0.3, 1000, 1, 30);
    const iso_measure_options o = options_of((size_t)tests_length(2000, 20000));
    kept(iso_measure_flow, &round, &o);
    kept(iso_measure_flow, &symmetric, &o);
    kept(iso_measure_flow, &wide, &o);
    kept(iso_measure_returns, &wide, &o);
}

static void wrong_exponents(void)
{
    const iso_scene scene = scene_of(0.5, 1, 2, 5);
    found_out(iso_measure_flow, &scene, options_of(10000), 0.1);
    found_out(iso_measure_returns, &scene, options_of(10000), 0.2);
    if (tests_length(0, 1) == 0) return;
    found_out(iso_measure_flow, &scene, options_of(250000), 0.01);
    found_out(iso_measure_returns, &scene, options_of(100000), 0.1);
}

/* Its energy falls; a strong one is told by the directions as well. */
static void resistance(test_of *test)
{
    for (int strong = 0; strong < 2; strong++) {
        iso_scene scene = scene_of(0.5, 1, 2, 5);
        with(&scene, "rolling_resistance", "coefficient", 1,
             (const double[]){strong ? (test == iso_measure_flow ? 0.03 : 0.004) : 1e-5});
        const iso_measure_options o = options_of(strong ? 4096 : 1024);
        iso_measure m;
        if (!run(test, &scene, &o, &m)) return;
        gsl_test(m.kept || strcmp(m.line[m.worst].name, "h") != 0, "%s with resistance: p = %.2g (%s)", kind(test),
                 m.p, m.line[m.worst].name);
        double least = 1;
        for (int i = 0; i < m.lines; i++)
            if (strcmp(m.line[i].name, "h") != 0) least = fmin(least, m.line[i].p * m.lines);
        if (strong) gsl_test(!(least < 1e-4), "%s with resistance, without h: p = %.2g", kind(test), least);
    }
}

/* A ball that comes to rest does not return. */
static void lost(void)
{
    iso_scene scene = scene_of(0.5, 1, 2, 5);
    with(&scene, "rolling_resistance", "coefficient", 1, (const double[]){1});
    const iso_measure_options o = options_of(512);
    iso_measure m;
    if (!run(iso_measure_returns, &scene, &o, &m)) return;
    gsl_test(m.kept || m.lost == 0 || m.p != 0 || m.lines != 1, "%zu of %zu balls do not return", m.lost, m.count);
}

/* A potential of n alone keeps the measure. */
static void potentials(void)
{
    iso_scene scene = scene_of(0.5, 1, 2, 5);
    with(&scene, "field", "linear", 3, (const double[]){0.2, 0, -0.1});
    found_out(iso_measure_flow, &scene, options_of((size_t)tests_length(1024, 20000)), tests_length(5, 1) / 10.);
}

/* Equal seeds give equal results on any number of threads, others give others. */
static void seeds(test_of *test)
{
    const iso_scene scene = scene_of(0.5, 1, 2, 5);
    static iso_measure m[3];
    for (int i = 0; i < 3; i++) {
        iso_measure_options o = options_of(2048);
        o.threads = i == 0 ? 1 : 2;
        o.seed = i < 2 ? 5 : 6;
        if (!run(test, &scene, &o, &m[i])) return;
    }
    bool equal = true;
    for (int i = 0; i < m[0].lines; i++) equal = equal && m[0].line[i].mean == m[1].line[i].mean;
    gsl_test(!equal || m[0].p != m[1].p, "%s: equal seeds on one and two threads", kind(test));
    gsl_test(m[0].line[5].mean == m[2].line[5].mean, "%s: another seed", kind(test));
}

/* p is what it says: of `runs` seeds about runs/100 have p < 0.01, no more; bounds of 1e-4 by Poisson's law. */
static void calibration(test_of *test)
{
    const iso_scene scene = scene_of(-0.5, 1, 2, 5);
    const int runs = tests_length(20, 60), most = tests_length(3, 6);
    int low = 0;
    for (int i = 0; i < runs; i++) {
        iso_measure_options o = options_of(1024);
        iso_measure m;
        o.seed = 100 + (unsigned long)i;
        o.turns = 1;
        if (!run(test, &scene, &o, &m)) return;
        low += m.p < 0.01;
    }
    gsl_test(low > most, "%s: p < 0.01 for %d of %d seeds", kind(test), low, runs);
}

/* --- refusals --------------------------------------------------------------------------------------------------- */

static void refused(test_of *test, const iso_scene *scene, const iso_measure_options *o, iso_status status,
                    const char *about)
{
    iso_measure m;
    const iso_status answer = test(ctx, scene, o, &m);
    gsl_test(answer != status || strcmp(iso_context_about(ctx), about) != 0, "%s: refused about '%s', not '%s': %s",
             kind(test), about, iso_context_about(ctx), iso_context_message(ctx));
}

static bool never(void *data)
{
    (void)data;
    return false;
}

static void refusals(void)
{
    iso_scene scene = scene_of(0.5, 1, 2, 5), pulled = scene, low = scene, heavy = scene, rest = scene;
    iso_measure_options few = options_of(100), wrong = options_of(2000), now = wrong, once = wrong, axis = wrong,
                        sure = wrong;
    const iso_measure_options o = options_of(2000);
    wrong.exponent = NAN;
    now.turns = 0;
    once.returns = 7;
    axis.axis = 3;
    sure.significance = 0;
    refused(iso_measure_flow, &scene, &few, ISO_BAD_ARGUMENT, "count");
    refused(iso_measure_flow, &scene, &wrong, ISO_BAD_ARGUMENT, "exponent");
    refused(iso_measure_flow, &scene, &now, ISO_BAD_ARGUMENT, "turns");
    refused(iso_measure_flow, &scene, &sure, ISO_BAD_ARGUMENT, "significance");
    refused(iso_measure_returns, &scene, &once, ISO_BAD_ARGUMENT, "returns");
    refused(iso_measure_returns, &scene, &axis, ISO_BAD_ARGUMENT, "axis");
    with(&pulled, "field", "linear", 3, (const double[]){0.2, 0, -0.1});
    refused(iso_measure_returns, &pulled, &o, ISO_BAD_INPUT, "effects");
    with(&low, "field", "linear", 3, (const double[]){0, 0, -20});
    refused(iso_measure_flow, &low, &o, ISO_BAD_INPUT, "energy");
    with(&heavy, "gravity", "mgb", 1, (const double[]){1});
    with(&heavy, "gravity", "up", 3, (const double[]){0, 1, 0});
    refused(iso_measure_flow, &heavy, &o, ISO_BAD_INPUT, "gravity");
    for (int i = 0; i < 3; i++) rest.start.y[i] = 0;
    refused(iso_measure_flow, &rest, &o, ISO_BAD_INPUT, "angular_velocity");
    iso_context_set_monitor(ctx, never, NULL);
    refused(iso_measure_flow, &scene, &o, ISO_STOPPED, "");
    iso_context_set_monitor(ctx, NULL, NULL);
}

int main(void)
{
    gsl_test_verbose(1);
    ctx = iso_context_create();
    test_of *const both[] = {iso_measure_flow, iso_measure_returns};
    for (size_t i = 0; i < 2; i++) {
        const double k = i == 0 ? 0.5 : -0.4;
        expectations(k, ISO_CLOCK_T, 1 / (2 * k) - 0.5);
        expectations(k, ISO_CLOCK_TAU, 1 / k - 1.5);
        expectations(k, ISO_CLOCK_S, -1.5);
        expectations_of_returns(k);
    }
    right_measures();
    wrong_exponents();
    potentials();
    for (int i = 0; i < 2; i++) {
        resistance(both[i]);
        seeds(both[i]);
        calibration(both[i]);
    }
    lost();
    refusals();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
