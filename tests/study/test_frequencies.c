/* Frequencies: the closed solution's against those estimated from stepped orbits, its actions against loop integrals
 * and Euler's law, its rotation number against sections; what is regular, chaotic or refused. */
#include "exact/coordinates_impl.h"
#include "instrument/frequencies/frequencies.h"
#include "instrument/frequencies/frequencies_impl.h"
#include "map/state.h"
#include "numbers.h"
#include "studies.h"

/* --- scenes ----------------------------------------------------------------------------------------------------- */

static iso_scene scene_from(double k, const double J[3], const double w[3], const double n[3])
{
    iso_scene scene = iso_scene_default();
    scene.params = laws_params(k, J);
    double unit[3];
    copy(n, unit, 3);
    make_unit(unit);
    must(iso_start_ball(ctx, w, unit, ISO_SPIN_REMOVE, &scene.start), "a start");
    return scene;
}

/* A random ball of k = 1 (odd i) or -1, in units far from 1; every third with one large moment. */
static iso_scene random_scene(int i, iso_random *random)
{
    const double unit = i % 2 == 0 ? 0.03 : 20;
    double J[3], w[3], n[3];
    for (int j = 0; j < 3; j++) J[j] = unit * iso_random_uniform(random, 1, 2);
    if (i % 3 == 0) J[i % 9 / 3] = 9 * unit;
    for (int j = 0; j < 3; j++) w[j] = iso_random_normal(random);
    iso_random_direction(random, n);
    return scene_from(i % 2 == 0 ? -1 : 1, J, w, n);
}

static bool is_near_separatrix(const iso_frequencies *f)
{
    bool near = false;
    for (int i = 0; i < f->separatrices; i++) near = near || fabs(f->separatrix[i].distance) < 0.01;
    return near;
}

/* --- the closed solution ---------------------------------------------------------------------------------------- */

/* f = |m a + n b| with the smallest integers. */
static bool combine(double f, const double a[2], int *m, int *n)
{
    for (int size = 1; size < 8; size++)
        for (int i = -size; i <= size; i++)
            for (int sign = -1; sign <= 1; sign += 2) {
                *m = i;
                *n = sign * (size - abs(i));
                if (fabs(f - fabs(*m * a[0] + *n * a[1])) < 1e-10 * f) return true;
            }
    return false;
}

/* Both are bases of the same frequencies, in all clocks, by the same integers. */
static void check_estimate(const iso_params *p, const iso_frequencies *closed, const iso_frequencies *estimated,
                           laws_worst *worst)
{
    int m[ISO_CLOCKS][2], n[ISO_CLOCKS][2];
    for (int c = 0; c < ISO_CLOCKS; c++) {
        const double a[2] = {closed->angle[0].frequency[c], closed->angle[1].frequency[c]};
        for (int i = 0; i < 2; i++) {
            const double f = estimated->angle[i].frequency[c];
            if (!combine(f, a, &m[c][i], &n[c][i]) || m[c][i] != m[0][i] || n[c][i] != n[0][i]) {
                laws_note(worst, NAN, 1, p, closed->motion);
                return;
            }
            laws_note(worst, fabs(f - fabs(m[c][i] * a[0] + n[c][i] * a[1])) / f, 1e-10, p, closed->motion);
            laws_note(worst, fabs(f - fabs(m[c][i] * a[0] + n[c][i] * a[1])),
                      fmax(10 * estimated->angle[i].error[c], 1e-12 * f), p, "its own error");
        }
    }
    laws_note(worst, abs(abs(m[0][0] * n[0][1] - m[0][1] * n[0][0]) - 1), 0.5, p, "no basis");
}

/* A(z), and R(z) + c of theory's separation on H = 0. */
typedef struct separated {
    double b[3], c, eps;
    int k;
} separated;

/* (1/2 pi) of twice the integral of p dz between two turning points, by z = middle - half cos x, which smooths the
 * ends */
static double loop(const separated *s, double low, double high)
{
    enum { PARTS = 4000 };
    const double *b = s->b;
    double sum = 0;
    for (int i = 0; i < PARTS; i++) {
        const double x = M_PI * (i + 0.5) / PARTS, half = (high - low) / 2, z = low + half * (1 - cos(x));
        const double A = (b[0] - z) * (b[1] - z) * (b[2] - z);
        const double R = s->k == -1 ? s->eps * z * (b[0] + b[1] + b[2] - z) : -s->eps * b[0] * b[1] * b[2] / z;
        sum += sqrt(fmax((R + s->c) / (2 * A), 0)) * half * sin(x);
    }
    return sum / PARTS;
}

/* Turning points from c; a swing through a plane, or a turn, is two of its coordinate. */
static void check_actions(const iso_scene *scene, const iso_frequencies *f, laws_worst *worst)
{
    iso_momentum m;
    iso_momentum_make(&scene->params, 0, &m);
    separated s = {.b = {m.b[0], m.b[1], m.b[2]}, .c = f->c, .eps = f->eps, .k = m.k};
    const double S = s.b[0] + s.b[1] + s.b[2], half = sqrt(fmax(S * S / 4 + s.c / s.eps, 0));
    const double al = m.k == 1 ? s.eps * s.b[0] * s.b[1] * s.b[2] / s.c : S / 2 - half;
    const double be = m.k == 1 ? INFINITY : S / 2 + half;
    const double u = loop(&s, s.b[0], fmin(al, s.b[1])), v = loop(&s, fmax(al, s.b[1]), fmin(be, s.b[2]));
    laws_note(worst, fabs(f->angle[0].action / (2 * u) - 1), 1e-6, &scene->params, "u");
    laws_note(worst, fabs(f->angle[1].action / ((be < s.b[2] ? 1 : 2) * v) - 1), 1e-6, &scene->params, "v");
}

/* --- sections of stepped orbits --------------------------------------------------------------------------------- */

static double along(const iso_sample *s, const void *axis)
{
    return s->ball[3 + *(const int *)axis];
}

/* Turns about an axis from one passage through the plane across it to the next, in the mean; the mean is weighted by
 * a smooth bump, which makes it exact much faster than 1/passages (Das, Saiki, Sander, Yorke 2017). */
static double section(const iso_scene *scene, int axis, double expected, double period)
{
    enum { PASSAGES = 600 };
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    iso_orbit *orbit;
    iso_sample s = {.clock = {0}};
    double before = NAN, sum = 0, weights = 0, from = 0;
    bool found;
    o.tolerance = 1e-14;
    must(iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit), "an orbit");
    for (int i = -1; i < PASSAGES; i++) {
        must(iso_orbit_event(orbit, along, &axis, 1, from, from + 2 * period, &found, &s), "a passage");
        if (!found) break;
        from = s.clock[ISO_CLOCK_T];
        const double angle = atan2(s.ball[3 + (axis + 2) % 3], s.ball[3 + (axis + 1) % 3]) / (2 * M_PI);
        const double x = (i + 0.5) / PASSAGES, weight = exp(-1 / (x * (1 - x))), turned = fabs(expected);
        const double sense = s.ball[axis] * scene->params.k < 0 ? 1 : -1, step = sense * (angle - before);
        if (i >= 0) sum += weight * (step + round(turned - step)), weights += weight;
        before = angle;
    }
    iso_orbit_free(orbit);
    return sum / weights;
}

static void check_closed(void)
{
    const int scenes = tests_length(8, 12);
    laws_worst estimates = {0}, actions = {0}, euler = {0}, sections = {0};
    iso_random *random = iso_random_create(5);
    const iso_frequencies_options o = {.turns = 1000, .end = NAN, .samples = NAN};
    static iso_frequencies f, g;
    int one_sided = 0, regular = 0, compared = 0;
    for (int i = 0; i < scenes; i++) {
        const iso_scene scene = random_scene(i, random);
        iso_momentum m;
        must(iso_frequencies_find(ctx, &scene, &o, &f), "frequencies");
        if (f.estimated || is_near_separatrix(&f)) continue;
        iso_momentum_make(&scene.params, 0, &m);
        const iso_momentum_part part = iso_momentum_find(&m, f.h, f.F);
        const int turning = part == ISO_TURNS_ABOUT_1 ? 1 : 0, axis = m.axis[2 * (1 - turning)];
        check_actions(&scene, &f, &actions);
        double sum = 0; /* in tau h is the Hamiltonian, of second degree in the actions */
        for (int j = 0; j < 2; j++) sum += f.angle[j].action * f.angle[j].frequency[ISO_CLOCK_TAU];
        laws_note(&euler, fabs(sum / (2 * f.h) - 1), 1e-12, &scene.params, f.motion);
        must(iso_frequencies_estimate(ctx, &scene, &o, &g), "an estimate");
        compared++;
        regular += g.estimate.verdict == ISO_REGULAR;
        if (g.estimate.verdict == ISO_REGULAR) check_estimate(&scene.params, &f, &g, &estimates);
        one_sided += part == ISO_ON_ONE_SIDE;
        if (part == ISO_ON_ONE_SIDE || sections.cases >= 3) continue;
        const double expected = f.angle[turning].frequency[ISO_CLOCK_T] / f.angle[1 - turning].frequency[ISO_CLOCK_T];
        const double measured = section(&scene, axis, expected, f.angle[1 - turning].period[ISO_CLOCK_T]);
        laws_note(&sections, fabs(measured - expected), 1e-8, &scene.params, f.motion);
    }
    iso_random_free(random);
    gsl_test(compared < scenes * 2 / 3, "%d of %d random balls have a closed solution", compared, scenes);
    gsl_test(one_sided == 0 || one_sided == compared, "%d of them stay on one side of a plane", one_sided);
    gsl_test(regular < compared * 3 / 4 || sections.cases < 3, "%d of them are found regular", regular);
    laws_report(&estimates, "estimated frequencies are those of the closed solution");
    laws_report(&actions, "actions are loop integrals");
    laws_report(&euler, "sum of action x frequency in tau = 2 h");
    laws_report(&sections, "rotation numbers are those of sections of stepped orbits");
}

/* --- estimates -------------------------------------------------------------------------------------------------- */

static void check_regular(void)
{
    static iso_frequencies f;
    const iso_frequencies_options o = iso_frequencies_defaults();
    const iso_scene scene =
        scene_from(0.6, (double[]){1.4, 2.1, 3}, (double[]){0.2, 0.3, 1}, (double[]){0.7, 0.6, 0.3});
    must(iso_frequencies_find(ctx, &scene, &o, &f), "an estimate");
    gsl_test(!f.estimated || f.estimate.verdict != ISO_REGULAR || f.angles != 2, "k = 0.6: %s; %s", f.motion, f.why);
    gsl_test(!(f.estimate.drift < 1e-10 && f.estimate.unexplained < 1e-6), "its drift: %.1e", f.estimate.drift);
    const double measured = section(&scene, f.estimate.axis, 1 / f.ratio, f.angle[0].period[ISO_CLOCK_T]);
    gsl_test(!(fabs(measured * f.ratio - 1) < 1e-8), "its rotation number by a section: %.1e",
             measured * f.ratio - 1);
}

static void check_chaotic(void)
{
    static iso_frequencies f;
    const iso_frequencies_options o = iso_frequencies_defaults();
    const iso_scene scene = scene_from(0.3, (double[]){1, 2, 6}, (double[]){0.3, 1, 0.2}, (double[]){0.6, 0, 0.8});
    must(iso_frequencies_find(ctx, &scene, &o, &f), "an estimate");
    gsl_test(f.estimate.verdict != ISO_CHAOTIC || f.resonances != 0 || !isnan(f.ratio),
             "k = 0.3, next to an unstable rotation: %s, drift %.1e", f.motion, f.estimate.drift);
}

/* Where k = -1, next to the separatrix, the frequencies of a short orbit wander as well; but that is no chaos. */
static void check_integrable(void)
{
    enum { STARTS = 6 };
    static iso_frequencies f;
    const iso_frequencies_options o = {.turns = 100, .end = NAN, .samples = NAN};
    int unsettled = 0;
    for (int i = 1; i <= STARTS; i++) {
        const iso_scene scene =
            scene_from(-1, (double[]){1, 2, 6}, (double[]){1e-7 * i, 1, 0}, (double[]){0.6, 0, 0.8});
        must(iso_frequencies_estimate(ctx, &scene, &o, &f), "an estimate");
        gsl_test(f.estimate.verdict != ISO_REGULAR && f.estimate.verdict != ISO_INTEGRABLE, "k = -1: %s, drift %.1e",
                 f.motion, f.estimate.drift);
        unsettled += f.estimate.verdict == ISO_INTEGRABLE;
    }
    gsl_test(unsettled == 0, "%d of %d not settled", unsettled, STARTS);
}

/* Turns about an axis: one frequency, |k w| in t, for every k. */
static void check_rotation(void)
{
    static iso_frequencies f;
    const iso_frequencies_options o = {.turns = 50, .end = NAN, .samples = NAN};
    const iso_scene scene = scene_from(0.4, (double[]){1, 2, 3}, (double[]){0, 0, -1.7}, (double[]){0.6, 0.8, 0});
    must(iso_frequencies_estimate(ctx, &scene, &o, &f), "an estimate");
    gsl_test_int(f.angles, 1, "a rotation has one angle");
    gsl_test_rel(f.angle[0].frequency[ISO_CLOCK_T], 0.4 * 1.7, 1e-13, "its frequency");
}

static void refuses(const iso_scene *scene, const iso_frequencies_options *o, iso_status expected, const char *field)
{
    static iso_frequencies f;
    const iso_status status = iso_frequencies_find(ctx, scene, o, &f);
    gsl_test(status != expected || strcmp(iso_context_about(ctx), field) != 0, "refused: %s",
             iso_context_message(ctx));
}

/* What others refuse as well: foreign/test_refusals.c. */
static void check_refusals(void)
{
    iso_frequencies_options o = iso_frequencies_defaults();
    const double J[3] = {1, 2, 3}, w[3] = {1, 0, 0};
    iso_scene scene = scene_from(0.5, J, w, (double[]){0, 0.6, 0.8});
    o.samples = -1;
    refuses(&scene, &o, ISO_BAD_ARGUMENT, "");
    scene = scene_from(0.5, J, w, (double[]){0.3, 0.6, 0.7});
    o.samples = 2000;
    refuses(&scene, &o, ISO_BAD_ARGUMENT, "samples");
    o = (iso_frequencies_options){.turns = 19.9, .end = NAN, .samples = NAN};
    refuses(&scene, &o, ISO_BAD_ARGUMENT, "turns");
    o = (iso_frequencies_options){.turns = 1000, .end = 1, .samples = NAN};
    refuses(&scene, &o, ISO_BAD_ARGUMENT, "end");
}

/* The number that a refusal about `field` advises is accepted: the monitor stops it at once. */
static void take_advice(const iso_scene *scene, iso_frequencies_options *o, const char *field, double *number)
{
    iso_frequencies f;
    refuses(scene, o, ISO_BAD_ARGUMENT, field);
    const char *advice = strstr(iso_context_message(ctx), "take ");
    gsl_test(!advice || sscanf(advice, "take %lf", number) != 1, "k = %g: %s are advised", scene->params.k, field);
    iso_context_set_monitor(ctx, never, NULL);
    gsl_test_int((int)iso_frequencies_find(ctx, scene, o, &f), ISO_STOPPED, "k = %g: %g %s are accepted",
                 scene->params.k, *number, field);
    iso_context_set_monitor(ctx, NULL, NULL);
}

static void check_advice(void)
{
    static const double k[] = {0.5, 3, -0.02};
    const double w[3] = {0.8, 0.3, -0.6}, n[3] = {0.6, 0, 0.8};
    for (int i = 0; i < 3; i++) {
        const iso_scene scene = scene_from(k[i], (const double[]){1.4, 2.1, 3}, w, n);
        iso_frequencies_options o = iso_frequencies_defaults();
        o.turns = 1e6;
        take_advice(&scene, &o, "turns", &o.turns);
        o.samples = 512;
        take_advice(&scene, &o, "samples", &o.samples);
    }
}

/* --- the image of the momentum map ------------------------------------------------------------------------------ */

static void check_rotations(int k, laws_worst *worst)
{
    const double J[3] = {2, 7, 1.5};
    const iso_params p = laws_params(k, J);
    iso_momentum m;
    iso_momentum_make(&p, 0, &m);
    for (int i = 0; i < 3; i++) {
        double y[ISO_STATE] = {0}, size;
        const iso_problem problem = {.p = p};
        y[m.axis[i]] = 1.3;
        y[3 + (m.axis[i] + 1) % 3] = 0.6, y[3 + (m.axis[i] + 2) % 3] = -0.8;
        const double h = iso_ball_energy(&p, y);
        const double F = laws_integral(&iso_system_ball, m.F)->value(&problem, y, &size);
        laws_note(worst, fabs(F - iso_momentum_rotation(&m, h, i)), 1e-14 * size, &p, "rotation");
    }
}

/* The library's list of bifurcations says the same in c. */
static void check_list(double H, laws_worst *worst)
{
    const iso_problem problem = {.p = laws_params(-1, (double[]){2, 7, 1.5}), .eps = 3, .energy = H};
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    iso_momentum m;
    iso_momentum_make(&problem.p, H, &m);
    const int count = iso_bifurcations(&problem, list);
    laws_note(worst, count < 3 ? NAN : 0, 1, &problem.p, "bifurcations");
    for (int i = 0; i < count; i++) {
        double nearest = INFINITY;
        for (int j = 0; j < ISO_MOMENTUM_LINES; j++) {
            const double F = iso_momentum_rotation(&m, iso_energy(&problem.p, problem.eps), j);
            nearest = fmin(nearest, fabs(F * problem.p.det_J / -2 / list[i].c - 1));
        }
        laws_note(worst, nearest, 1e-13, &problem.p, "bifurcation");
    }
}

/* Random motions, off the level as well, lie in the image, in the part where the constant of separation has them. */
static void check_image(int i, iso_random *random, laws_worst *worst)
{
    const double J[3] = {1.4, i % 3 == 0 ? 5 : 2.1, 1.1};
    iso_problem problem = {.p = laws_params(i % 2 == 0 ? -1 : 1, J)};
    double y[ISO_STATE], size, low, high, size_h;
    laws_sample(&iso_system_ball, &problem, random, y);
    if (i % 4 == 0) {
        problem.effects.on[ISO_LEVEL] = true;
        LEVEL_C(&problem.effects) = iso_random_uniform(random, -6, 0.3) * problem.energy;
    }
    iso_momentum m;
    const double h = iso_system_ball.energy(&problem, y, &size_h);
    if (!(h > 0) || !iso_momentum_make(&problem.p, iso_coupling(&problem.p, LEVEL_C(&problem.effects)), &m)) return;
    const double F = laws_integral(&iso_system_ball, m.F)->value(&problem, y, &size);
    const iso_momentum_part part = iso_momentum_find(&m, h, F);
    const bool some = iso_momentum_interval(&m, h, part, &low, &high);
    double point[ISO_STATE], excess[3];
    iso_conical at;
    problem.eps = iso_coupling(&problem.p, h);
    problem.energy = m.H;
    iso_ball_to_point(&problem.p, y, point);
    iso_separation_coordinates(&problem.p, point, &at);
    iso_separation_constant(&problem, &at, excess);
    const iso_momentum_part expected = excess[1] > 0   ? excess[2] > 0 ? ISO_TURNS_ABOUT_1 : ISO_SWINGS_ABOUT_3
                                       : excess[2] > 0 ? ISO_TURNS_ABOUT_3
                                                       : ISO_ON_ONE_SIDE;
    laws_note(worst, part != expected, 0.5, &problem.p, "part");
    laws_note(worst, some ? fmax(fmax(low - F, F - high), 0) : NAN, 1e-13 * size, &problem.p, "inside");
}

static void check_momentum(void)
{
    laws_worst rotations = {0}, image = {0};
    iso_random *random = iso_random_create(3);
    check_rotations(1, &rotations);
    check_rotations(-1, &rotations);
    check_list(0, &rotations);
    check_list(-4, &rotations);
    for (int i = 0; i < 400; i++) check_image(i, random, &image);
    iso_random_free(random);
    laws_report(&rotations, "rotations are where the map says");
    laws_report(&image, "motions lie in the image of the map");
    iso_momentum m;
    const iso_params p = laws_params(0.5, (double[]){1, 2, 3});
    gsl_test(iso_momentum_make(&p, 0, &m), "k = 0.5 has no map");
}

int main(void)
{
    ctx = iso_context_create();
    check_momentum();
    check_regular();
    check_chaotic();
    check_integrable();
    check_rotation();
    check_refusals();
    check_advice();
    check_closed();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
