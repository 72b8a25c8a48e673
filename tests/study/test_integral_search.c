/* The search for first integrals (instrument/integrals/integrals.h): it finds those that are known, and no others;
 * what is doubtful is called undecided; values depend on k and the ratio of the moments alone; what is refused. */
#include "io/scene_file.h"
#include "orbit/orbit_impl.h"
#include "searches.h"

/* The energy in every even degree and in no odd one, to rounding. */
static void energy(const iso_integral_search *r, const char *what)
{
    bool even = true, odd = true;
    for (int d = 1; d <= r->degrees; d++) {
        if (d % 2 == 0) even = even && r->at[d].found == 1 && r->at[d].largest < 1e-13;
        if (d % 2 == 1) odd = odd && r->at[d].found == 0;
    }
    gsl_test(!even, "%s: the energy is the one integral of even degree", what);
    gsl_test(!odd, "%s: no integral of odd degree", what);
    gsl_test(!(r->energy < 1e-13), "%s: the samples keep the energy (%.1e)", what, r->energy);
}

/* --- what is known is found ------------------------------------------------------------------------------------- */

/* Quadratic integrals at k = 1 and -1: with 1, F in V_2; with 1, F, F^2 in V_4; the gap is clear. */
static void quadratic(double k)
{
    iso_random *random = iso_random_create(4);
    const int count = tests_length(6, 20);
    int right = 0;
    double worst = 0, largest = 0, smallest = INFINITY;
    for (int i = 0; i < count; i++) {
        double J[3];
        draw_moments(random, 1.2, 0.1, J);
        const iso_integral_search r = look(k, J, 4);
        right += r.verdict == ISO_INTEGRALS_FOUND && r.independent == 1 && r.known_count == 1 &&
                 r.known[0].degree == 2 && r.at[1].found == 0 && r.at[2].found == 2 && r.at[2].further == 1 &&
                 r.at[3].found == 0 && r.at[4].found == 3 && r.at[4].further == 1;
        worst = fmax(worst, r.known[0].residual);
        largest = fmax(largest, fmax(r.at[2].largest, r.at[4].largest));
        smallest = fmin(smallest, fmin(r.at[2].smallest, r.at[4].smallest));
    }
    gsl_test_int(right, count, "k = %g: F and no more, for random moments", k);
    gsl_test(!(worst < 1e-10), "k = %g: what is found is the F that is known (%.1e)", k, worst);
    gsl_test(!(largest < 1e-12 && smallest > 1e-4), "k = %g: the gap, from %.1e to %.1e", k, largest, smallest);
    iso_random_free(random);
}

/* Linear ones of bodies with two equal moments, at any k. */
static void linear(void)
{
    static const double k[] = {0.6, -0.35, 2.5};
    for (int axis = 0; axis < 3; axis++) {
        double J[3] = {1.7, 1.7, 1.7};
        char name[16];
        J[axis] = axis == 1 ? 0.8 : 2.6;
        snprintf(name, sizeof name, "F_axis%d", axis + 1);
        const iso_integral_search r = look(k[axis], J, 3);
        gsl_test_int((int)r.verdict, ISO_INTEGRALS_FOUND, "%s: found", name);
        gsl_test_int(r.independent, 1, "%s: one", name);
        gsl_test_int((int)r.at[1].found, 1, "%s: it is linear", name);
        gsl_test_int((int)r.at[2].found, 2, "%s: its square and the energy", name);
        gsl_test_int((int)r.at[3].found, 2, "%s: its cube, and it times the energy", name);
        gsl_test(r.known_count != 1 || strcmp(r.known[0].name, name) || !(r.known[0].residual < 1e-10),
                 "%s: by its name", name);
        gsl_test_int((int)r.at[1].value[0].parity, 1 << axis, "%s: its parity", name);
    }
    const iso_integral_search r = look(0.6, (double[]){2, 2, 2}, 2);
    gsl_test_int((int)r.at[1].found, 3, "three equal moments: M");
    gsl_test_int((int)r.at[2].found, 6, "three equal moments: products of M, M^2 is the energy");
    gsl_test_int(r.independent, 2, "three equal moments: two are independent of the energy");
}

/* --- and nothing else ------------------------------------------------------------------------------------------- */

static void none(double k, int degree)
{
    const iso_integral_search r = look(k, searched_J, degree);
    double smallest = INFINITY;
    char what[32];
    snprintf(what, sizeof what, "k = %g", k);
    for (int d = 1; d <= degree; d++) smallest = fmin(smallest, r.at[d].smallest);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_NONE, "%s: none up to degree %d", what, degree);
    gsl_test(!(smallest > 1e-5), "%s: far from it (%.1e)", what, smallest);
    gsl_test_int(r.independent, 0, "%s: no number of integrals", what);
    energy(&r, what);
}

static void none_at_random(void)
{
    iso_random *random = iso_random_create(5);
    const int count = tests_length(6, 20);
    int right = 0;
    for (int i = 0; i < count; i++) {
        double J[3];
        draw_moments(random, 1.2, 0.1, J);
        const double size = i % 2 ? iso_random_uniform(random, 0.15, 0.85) : iso_random_uniform(random, 1.2, 3);
        const iso_integral_search r = look(i % 3 ? size : -size, J, 3);
        right += r.verdict == ISO_INTEGRALS_NONE && r.at[2].found == 1;
    }
    gsl_test_int(right, count, "none for random k and J");
    iso_random_free(random);
}

/* F needs coefficients of degree 2 in gamma. */
static void too_small_a_space(void)
{
    const iso_scene scene = scene_of(1, searched_J);
    iso_integral_search_options o = options(2);
    o.coefficients = 1;
    const iso_integral_search r = search(&scene, &o);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_NONE, "F is not in a space without its coefficients");
    gsl_test_int(r.known[0].degree, 0, "and is told not to be");
}

/* M c(gamma), c polynomials of degree E, are the tangent fields of the sphere made of gradients of harmonics of degree
 * E + 1 or less and their rotations by a right angle of degree E or less: 2 E^2 + 6 E + 3. */
static void dimension(void)
{
    const iso_scene scene = scene_of(0.5, searched_J);
    iso_integral_search_options o = options(1);
    for (int E = 0; E <= ISO_INTEGRAL_DEGREE; E++) {
        o.coefficients = E;
        const iso_integral_search r = search(&scene, &o);
        gsl_test_int((int)r.at[1].functions, 2 * E * E + 6 * E + 3, "E = %d: dimension of V_1", E);
    }
}

/* --- what is doubtful ------------------------------------------------------------------------------------------- */

static void doubtful(void)
{
    iso_integral_search r = look(1 + 1e-8, searched_J, 2);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_UNDECIDED, "k = 1 + 1e-8: constant within 1e-10 is not constant");
    gsl_test_int((int)r.at[2].doubtful, 1, "one value is doubtful");
    r = look(1 + 1e-13, searched_J, 2);
    gsl_test(r.verdict != ISO_INTEGRALS_UNDECIDED || !r.near, "k = 1 + 1e-13: the neighbour's F");
    r = look(0.5, (double[]){1, 1.0000001, 1.0000002}, 2);
    gsl_test(r.verdict != ISO_INTEGRALS_UNDECIDED || !r.near, "moments 1e-7 apart");
    r = look(0.5, (double[]){1, 1.001, 1.002}, 4);
    gsl_test(r.verdict != ISO_INTEGRALS_UNDECIDED || !r.near || r.at[2].found != 1,
             "moments 1e-3 apart: values of growing degree fall to rounding");
    r = look(1, (double[]){1, 1.001, 1.002}, 4);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_FOUND, "moments 1e-3 apart, k = 1: F is there");
    r = look(1, (double[]){1, 1.0000001, 1.0000002}, 2);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_FOUND, "moments 1e-7 apart, k = 1: F is there");
    const iso_scene scene = scene_of(1, searched_J);
    iso_integral_search_options o = options(2);
    o.tolerance = 1e-6;
    r = search(&scene, &o);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_UNDECIDED, "rough integration decides nothing at k = 1");
    o.within = 1e-6;
    r = search(&scene, &o);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_FOUND, "but finds F within 1e-6");
}

/* The error that is told covers the value of an integral, for every tolerance. */
static void errors(void)
{
    static const double tolerances[] = {1e-15, 1e-13, 1e-11, 1e-9, 1e-7};
    double worst = 0;
    for (int i = 0; i < 10; i++) {
        const iso_scene scene = scene_of(i % 2 ? 1 : -1, (double[]){1, 2, 5});
        iso_integral_search_options o = options(2);
        o.tolerance = tolerances[i / 2];
        o.turns = i % 4 < 2 ? 50 : 500;
        o.seed = (uint64_t)i;
        const iso_integral_search r = search(&scene, &o);
        for (int v = 0; v < 2; v++) worst = fmax(worst, r.at[2].value[v].value / r.at[2].value[v].error);
    }
    gsl_test(!(worst < 1), "errors cover values (%.2g of them)", worst);
}

static void dependence(void)
{
    const iso_scene scene = scene_of(-0.5, searched_J);
    iso_integral_search_options o = options(3);
    const iso_integral_search first = search(&scene, &o);
    iso_scene other = scene_of(-0.5, searched_J);
    other.start.y[0] *= 3;
    other.start.y[1] = -2;
    other.start.y[2] *= 3;
    iso_integral_search r = search(&other, &o);
    gsl_test(!(apart(&first, &r) == 0), "the start does not matter");
    o.threads = 1;
    r = search(&scene, &o);
    gsl_test(!(apart(&first, &r) == 0), "threads do not matter");
    other = scene_of(-0.5, (double[]){1.4 * 7, 2.1 * 7, 3 * 7.0});
    r = search(&other, &o);
    gsl_test(!(apart(&first, &r) < 1e-3), "the unit of moments does not matter (%.1e)", apart(&first, &r));
    o.seed = 3;
    r = search(&scene, &o);
    gsl_test(!(apart(&first, &r) > 1e-6), "another seed, other orbits");
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_NONE, "and the same verdict");
}

/* --- every level of the energy ---------------------------------------------------------------------------------- */

/* The scene of a start, on a level drawn above the potential there; by the point, or by its ball. */
static iso_scene on_level(iso_random *random, double k, bool ball)
{
    double J[3];
    iso_scene scene;
    do {
        draw_moments(random, 1.2, 0.1, J);
        scene = scene_of(k, J);
    } while (iso_scene_on_level(ctx, &scene, iso_random_uniform(random, -0.5, 3)) != ISO_OK);
    if (ball) return scene;
    iso_orbit *orbit;
    iso_sample start;
    iso_orbit_options o = iso_orbit_defaults(&scene.start);
    o.effects = &scene.effects;
    o.shown = ISO_SHOW_BOTH;
    gsl_test(iso_orbit_create(ctx, &scene.params, &scene.start, &o, &orbit) != ISO_OK ||
                 iso_orbit_at(orbit, 0, &start) != ISO_OK,
             "the point of a ball on a level");
    scene.start = (iso_start){.model = ISO_POINT, .eps = iso_orbit_coupling(orbit)};
    for (int i = 0; i < ISO_STATE; i++) scene.start.y[i] = start.point[i];
    iso_orbit_free(orbit);
    iso_effects_set_level(&scene.effects, false, NAN);
    return scene;
}

/* k = 1 and -1 have their second integral on every level, other k have none; the ball's scene and the point's are one
 * motion. */
static void levels(void)
{
    static const double k[] = {1, -1, 0.5, -0.5, 2};
    iso_random *random = iso_random_create(29);
    iso_integral_search_options o = options(2);
    o.turns = 10;
    for (int i = 0; i < 5 * tests_length(3, 10); i++) {
        const iso_scene scene = on_level(random, k[i % 5], i % 2 == 0);
        const iso_integral_search r = search(&scene, &o);
        const bool integrable = fabs(k[i % 5]) == 1;
        gsl_test(r.level == 0, "k = %g: a level (%g)", k[i % 5], r.level);
        gsl_test_int((int)r.verdict, integrable ? ISO_INTEGRALS_FOUND : ISO_INTEGRALS_NONE,
                     "k = %g, level %g: integrals", k[i % 5], r.level);
        gsl_test_int(r.independent, integrable ? 1 : 0, "k = %g, level %g: how many", k[i % 5], r.level);
        gsl_test_int(r.known_count, integrable ? 1 : 0, "k = %g, level %g: known", k[i % 5], r.level);
        if (integrable)
            gsl_test(!(r.known[0].residual < 1e-9), "k = %g, level %g: %s is what is found (%.1e)", k[i % 5], r.level,
                     r.known[0].name, r.known[0].residual);
        gsl_test(!(r.energy < 1e-12), "k = %g, level %g: the samples keep the energy (%.1e)", k[i % 5], r.level,
                 r.energy);
    }
    iso_random_free(random);
}

/* --- what is refused -------------------------------------------------------------------------------------------- */

static void refuse(const iso_scene *scene, const iso_integral_search_options *o, iso_status status, const char *about)
{
    iso_integral_search r;
    gsl_test_int((int)iso_integral_search_run(ctx, scene, o, &r), (int)status, "refused: %s", about);
    gsl_test_str(iso_context_about(ctx), about, "about it");
}

static void refusals(void)
{
    iso_scene scene = scene_of(0.5, searched_J);
    for (int i = 0; i < 7; i++) {
        static const char *const about[] = {"degree", "degree", "coefficients", "orbits",
                                            "turns",  "within", "tolerance"};
        iso_integral_search_options o = options(2);
        if (i < 2) o.degree = i == 0 ? 0 : ISO_INTEGRAL_DEGREE + 1;
        if (i == 2) o.coefficients = ISO_INTEGRAL_DEGREE + 1;
        if (i == 3) o.orbits = 2;
        if (i == 4) o.turns = NAN;
        if (i == 5) o.within = 0;
        if (i == 6) o.tolerance = -1;
        refuse(&scene, &o, ISO_BAD_ARGUMENT, about[i]);
    }
    const iso_integral_search_options o = options(1);
    iso_effects_set(ctx, &scene.effects, "rolling_resistance", "coefficient", 1, (double[]){0.1});
    refuse(&scene, &o, ISO_BAD_INPUT, "rolling_resistance");
    iso_context_set_monitor(ctx, never, NULL);
    scene = scene_of(0.5, searched_J);
    iso_integral_search r;
    gsl_test_int((int)iso_integral_search_run(ctx, &scene, &o, &r), ISO_STOPPED, "stopped");
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_UNDECIDED, "stopped: undecided");
    iso_context_set_monitor(ctx, NULL, NULL);
    iso_scene turning = scene;
    set_rotor(&turning, (double[]){0, 0, 1});
    turning.start.y[0] = turning.start.y[1] = turning.start.y[2] = 0;
    refuse(&turning, &o, ISO_BAD_INPUT, "M");
    scene.start.y[0] = scene.start.y[1] = scene.start.y[2] = 0;
    r = search(&scene, &o);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_NONE, "a ball at rest: the energy does not matter");
}

int main(void)
{
    ctx = iso_context_create();
    quadratic(1);
    quadratic(-1);
    linear();
    none(0.5, 4);
    none(0.75, 4);
    none(-0.5, 4);
    none_at_random();
    too_small_a_space();
    dimension();
    doubtful();
    errors();
    dependence();
    levels();
    refusals();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
