/* The search for first integrals of a ball with a rotor (instrument/integrals/integrals.h): it finds those that are
 * known, and nothing else; its functions do not depend on the rotor; units do not matter. */
#include "orbit/orbit_impl.h"
#include "searches.h"

static iso_integral_search with_rotor(double k, const double J[3], const double K[3], int degree)
{
    iso_scene scene = scene_of(k, J);
    const iso_integral_search_options o = options(degree);
    set_rotor(&scene, K);
    return search(&scene, &o);
}

/* F_rotor and no more at k = 1; nothing at k = -1 and elsewhere. */
static void rotors(void)
{
    static const double k[] = {1, -1, 0.6};
    iso_random *random = iso_random_create(31);
    const int count = tests_length(3, 15); /* K in space, in a plane, along an axis */
    for (int which = 0; which < 3; which++) {
        const bool holds = k[which] == 1;
        int right = 0;
        double residual = 0, largest = 0, smallest = INFINITY;
        for (int i = 0; i < count; i++) {
            double J[3], K[3];
            draw_moments(random, 1.2, 0.1, J);
            iso_random_direction(random, K);
            scale(K, iso_random_uniform(random, 0.5, 2));
            for (int j = 0; j < i % 3; j++) K[(i / 3 + j) % 3] = 0;
            const iso_integral_search r = with_rotor(k[which], J, K, 2);
            const iso_integral_verdict verdict = holds ? ISO_INTEGRALS_FOUND : ISO_INTEGRALS_NONE;
            right += r.verdict == verdict && r.independent == holds && r.known_count == holds && r.at[1].found == 1 &&
                     r.at[1].further == 0 && r.at[2].found == (holds ? 2 : 1) && r.at[2].further == holds;
            if (holds) right -= !(strcmp(r.known[0].name, "F_rotor") == 0 && r.known[0].degree == 2);
            if (holds) residual = fmax(residual, r.known[0].residual);
            largest = fmax(largest, r.at[2].largest);
            smallest = fmin(smallest, fmin(r.at[1].smallest, r.at[2].smallest));
        }
        gsl_test_int(right, count, "rotor, k = %g: %s, for random J and K", k[which],
                     holds ? "F_rotor and no more" : "nothing");
        gsl_test(!(residual < 1e-10), "rotor, k = %g: what is found is F_rotor (%.1e)", k[which], residual);
        gsl_test(!(largest < 1e-12 && smallest > 1e-5), "rotor, k = %g: the gap, from %.1e to %.1e", k[which],
                 largest, smallest);
    }
    iso_random_free(random);
}

/* Products of F_rotor at k = 1, nothing at k = -1, up to degree 4. */
static void rotor_of_degree_4(void)
{
    const double K[3] = {0.3, 0.4, 0.5};
    iso_integral_search r = with_rotor(1, searched_J, K, 4);
    for (int d = 1; d <= 4; d++)
        gsl_test_int((int)r.at[d].found, 1 + d / 2, "rotor, k = 1: powers of F_rotor in V_%d", d);
    r = with_rotor(-1, searched_J, K, 4);
    gsl_test_int((int)r.verdict, ISO_INTEGRALS_NONE, "rotor, k = -1: none up to degree 4");
    for (int d = 1; d <= 4; d++)
        gsl_test(!(r.at[d].found == 1 && r.at[d].smallest > 1e-3), "rotor, k = -1: V_%d far from it (%.1e)", d,
                 r.at[d].smallest);
}

/* Linear ones: two equal moments and K along the third axis; three equal moments (Demchenko). On every level. */
static void linear_with_rotor(void)
{
    static const double k[] = {0.6, -1, 2.5};
    for (int axis = 0; axis < 4; axis++) {
        double J[3] = {1.7, 1.7, 1.7}, K[3] = {0, 0, 0};
        char name[16] = "F_round";
        iso_integral_search_options o = options(2);
        if (axis < 3) snprintf(name, sizeof name, "F_rotor%d", axis + 1), J[axis] = axis == 1 ? 0.8 : 2.6;
        if (axis < 3) K[axis] = -0.7;
        if (axis == 3) K[0] = 0.2, K[1] = 0.3, K[2] = -0.6;
        o.coefficients = 4; /* of F_round^2 */
        for (int level = 0; level < 2; level++) {
            if (tests_length(1, 0) && level != axis % 2) continue;
            iso_scene scene = scene_of(k[axis % 3], J);
            if (level) iso_scene_on_level(ctx, &scene, 0.4);
            set_rotor(&scene, K);
            const iso_integral_search r = search(&scene, &o);
            gsl_test((r.level != 0) != level, "%s: a level (%g)", name, r.level);
            gsl_test_int((int)r.verdict, ISO_INTEGRALS_FOUND, "%s: found, level %d", name, level);
            gsl_test_int(r.independent, 1, "%s: one", name);
            gsl_test_int((int)r.at[1].further, 1, "%s: it is linear", name);
            gsl_test_int((int)r.at[2].found, 3, "%s: and its square", name);
            gsl_test(r.known_count != 1 || strcmp(r.known[0].name, name) || !(r.known[0].residual < 1e-10),
                     "%s: by its name", name);
        }
        iso_scene scene = scene_of(k[axis % 3], J);
        K[axis % 3] += 0.2, K[(axis + 1) % 3] += 0.1; /* beside the axis; another one for equal moments */
        set_rotor(&scene, K);
        const iso_integral_search r = search(&scene, &o);
        gsl_test_int(r.independent, axis == 3, "%s: with K beside the axis", name);
    }
}

/* The functions do not depend on K, though it decides in how many parts they are searched. V_1 has M c and
 * v c and c, of dimensions 2 E^2 + 6 E + 3 (test_integral_search.c) and twice (E + 1)^2. */
static void rotor_dimension(void)
{
    for (int E = 0; E <= tests_length(2, 4); E += 2)
        for (int kind = 0; kind < 7; kind++) {
            const double K[3] = {(kind + 1) & 1 ? 0.3 : 0, (kind + 1) & 2 ? 0.5 : 0, (kind + 1) & 4 ? -0.4 : 0};
            iso_scene scene = scene_of(0.6, searched_J);
            iso_integral_search_options o = options(1);
            o.coefficients = E;
            set_rotor(&scene, K);
            const iso_integral_search r = search(&scene, &o);
            gsl_test_int((int)r.at[1].functions, 2 * E * E + 6 * E + 3 + 2 * (E + 1) * (E + 1),
                         "rotor, E = %d, K of kind %d: dimension of V_1", E, kind);
        }
}

/* The units do not matter, the energy does: K is large or small against it. */
static void rotor_dependence(void)
{
    const double K[3] = {0.3, 0.4, 0.5};
    iso_scene scene =
        scene_of(1, searched_J); /* where no orbit is chaotic, which makes differences of rounding large */
    const iso_integral_search_options o = options(2);
    set_rotor(&scene, K);
    const iso_integral_search first = search(&scene, &o);
    iso_scene other = scene_of(1, (double[]){1.4 * 7, 2.1 * 7, 3 * 7.0});
    for (int i = 0; i < 3; i++) other.start.y[i] *= 3;
    iso_integral_search r = search(&other, &o);
    gsl_test(!(apart(&first, &r) > 1e-3), "another K is another motion");
    set_rotor(&other, (double[]){0.3 * 21, 0.4 * 21, 0.5 * 21});
    r = search(&other, &o);
    gsl_test(!(apart(&first, &r) < 1e-6), "rotor: units do not matter (%.1e)", apart(&first, &r));
    const iso_integral_search without = look(1, searched_J, 2);
    r = with_rotor(1, searched_J, (double[]){0, 0, 0}, 2);
    gsl_test(!(apart(&without, &r) < 1e-6), "K = 0 is no rotor (%.1e)", apart(&without, &r));
    r = with_rotor(-1, searched_J, (double[]){0, 1e-12, 0}, 2);
    gsl_test(r.verdict != ISO_INTEGRALS_UNDECIDED || !r.near, "a weak rotor at k = -1: the neighbour's F");
}

int main(void)
{
    ctx = iso_context_create();
    rotors();
    rotor_of_degree_4();
    linear_with_rotor();
    rotor_dimension();
    rotor_dependence();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
