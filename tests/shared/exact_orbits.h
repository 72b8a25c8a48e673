/* exact_orbits.h - orbits that have a closed solution: random ones, and ones next to a change of its form. */
#ifndef ISO_TESTS_EXACT_ORBITS_H
#define ISO_TESTS_EXACT_ORBITS_H

#include "exact/coordinates_impl.h"
#include "exact/exact_impl.h"
#include "orbits.h"

static const bool exact_clocks[ISO_CLOCKS] = {true, true, true};

/* Families of orbits. `delta` is the distance from what the family is next to. */
typedef enum exact_family {
    EXACT_ANY,        /* k = 1 and -1, H = 0; ratios of moments to 7                                  */
    EXACT_WIDE,       /* ratios of moments to 100                                                     */
    EXACT_LEVEL,      /* k = -1 off H = 0                                                             */
    EXACT_AXIS,       /* two equal moments, k from 1/5 to 5 of either sign, off H = 0                 */
    EXACT_IN_PLANE,   /* in a principal plane, such k, off H = 0                                      */
    EXACT_SEPARATRIX, /* |delta| from that of the rotation about the middle axis, sign(delta): side   */
    EXACT_SECOND,     /* from the other of k = -1, b3 > b1 + b2                                       */
    EXACT_NEAR_EQUAL, /* two moments, of every third three, equal but for delta                       */
    EXACT_NEAR_PLANE, /* from a principal plane                                                       */
    EXACT_NEAR_AXIS,  /* two equal moments; from the equator, the pole, or M_x = 0                    */
    EXACT_NEAR_POLE,  /* two moments equal but for delta, by the pole of the third at 0.3 to 1e-6   */
    EXACT_FAMILIES
} exact_family;

static const char *const exact_names[EXACT_FAMILIES] = {"anywhere",
                                                        "wide",
                                                        "off H = 0",
                                                        "two equal moments",
                                                        "in a plane",
                                                        "the separatrix",
                                                        "the second separatrix",
                                                        "nearly equal moments",
                                                        "next to a plane",
                                                        "axis, next to a form",
                                                        "nearly equal moments, next to the pole"};

/* M: the part of `direction` across gamma, with the length that the level H gives. rho in (-1, 1) is H in units of
 * eps q^(-1/k). */
static inline void exact_start(orbit *o, double k, const double J[3], const double gamma[3],
                               const double direction[3], double rho)
{
    iso_problem *const f = &o->model.problem;
    double *const M = o->y0, *const g = o->y0 + 3;
    f->p = laws_params(k, J);
    f->eps = 1;
    copy(gamma, g, 3), copy(direction, M, 3);
    make_unit(g);
    remove_along(M, g), remove_along(M, g);
    const double depth = pow(dot_diag(g, J, g), -1 / k);
    f->energy = rho * depth;
    if (norm(M) > 0) scale(M, sqrt(2 * (f->energy + depth)) / norm(M));
    orbit_clocks(o, ISO_CLOCK_S, true, true, false);
}

/* The excess over the value of bifurcation at b2 or b3 (coordinates.h) of M at an angle about gamma. */
static inline double exact_excess(orbit *o, double k, const double J[3], const double g[3], double angle, int which)
{
    const int flat = fabs(g[0]) < fabs(g[1]) ? 0 : 1;
    double e1[3], e2[3], direction[3], excess[3];
    iso_conical at;
    cross(g, (const double[3]){flat == 0, flat == 1, 0}, e1);
    make_unit(e1);
    cross(g, e1, e2);
    for (int i = 0; i < 3; i++) direction[i] = cos(angle) * e1[i] + sin(angle) * e2[i];
    exact_start(o, k, J, g, direction, 0);
    iso_separation_coordinates(&o->model.problem.p, o->y0, &at);
    iso_separation_constant(&o->model.problem, &at, excess);
    return excess[which];
}

/* Turns M about gamma to the distance delta from the separatrix. False: no M at this gamma is on the separatrix. */
static inline bool exact_next_to(orbit *o, double k, const double J[3], const double g[3], double delta, int which)
{
    enum { PARTS = 32 };
    for (int i = 0; i < PARTS; i++) {
        double low = M_PI * i / PARTS, high = M_PI * (i + 1) / PARTS;
        const bool sign = exact_excess(o, k, J, g, low, which) > 0;
        if ((exact_excess(o, k, J, g, high, which) > 0) == sign) continue;
        for (int j = 0; j < 60; j++) {
            const double middle = (low + high) / 2;
            *((exact_excess(o, k, J, g, middle, which) > 0) == sign ? &low : &high) = middle;
        }
        return exact_excess(o, k, J, g, low + delta, which) != 0;
    }
    return false;
}

static inline double exact_sign(iso_random *random)
{
    return iso_random_uniform(random, -1, 1) < 0 ? -1 : 1;
}

/* The i-th orbit of a family. */
static inline orbit exact_orbit(iso_context *ctx, exact_family family, int i, double delta, iso_random *random)
{
    orbit o = {.ctx = ctx, .model.system = &iso_system_point};
    const int a = (int)iso_random_uniform(random, 0, 3), b = (a + 1) % 3, c = (a + 2) % 3;
    const bool free_k = family == EXACT_AXIS || family == EXACT_IN_PLANE || family == EXACT_NEAR_AXIS;
    double k = i % 2 ? 1 : -1, J[3], g[3], M[3], rho = 0;
    if (free_k) k *= pow(5, iso_random_uniform(random, -1, 1));
    if (free_k || family == EXACT_LEVEL) rho = i % 3 ? iso_random_uniform(random, -0.9, 0.9) : 0;
    if (family == EXACT_LEVEL || family == EXACT_SECOND) k = -1;
    do {
        for (int j = 0; j < 3; j++) J[j] = iso_random_uniform(random, 1, i % 4 < 2 ? 2 : 7);
        if (family == EXACT_WIDE)
            for (int j = 0; j < 3; j++) J[j] = pow(100, iso_random_uniform(random, 0, 1));
        if (family == EXACT_SECOND) J[a] = J[b] + J[c] + iso_random_uniform(random, 0.1, 5);
        if (family == EXACT_AXIS || family == EXACT_NEAR_AXIS) J[b] = J[c];
        if (family == EXACT_NEAR_EQUAL || family == EXACT_NEAR_POLE) J[b] = J[c] * (1 + delta);
        if (family == EXACT_NEAR_EQUAL && i % 6 < 2) J[a] = J[c] * (1 - delta * iso_random_uniform(random, 0, 3));
        iso_random_direction(random, g), iso_random_direction(random, M);
        if (family == EXACT_IN_PLANE) g[a] = M[b] = M[c] = 0;
        if (family == EXACT_NEAR_PLANE) g[a] *= delta, M[b] *= delta, M[c] *= delta;
        if (family == EXACT_NEAR_AXIS && i % 3 == 0) g[a] *= delta, M[b] *= delta, M[c] *= delta;
        if (family == EXACT_NEAR_AXIS && i % 3 == 1) g[b] *= delta, g[c] *= delta;
        if (family == EXACT_NEAR_AXIS && i % 3 == 2) M[a] *= delta;
        if (family == EXACT_NEAR_POLE) {
            const double near = pow(10, -iso_random_uniform(random, 0.5, 6));
            g[a] = exact_sign(random), g[b] *= near, g[c] *= near;
        }
        exact_start(&o, k, J, g, M, rho);
    } while ((family == EXACT_SEPARATRIX && !exact_next_to(&o, k, J, g, delta * exact_sign(random), 1)) ||
             (family == EXACT_SECOND && !exact_next_to(&o, k, J, g, delta * exact_sign(random), 2)));
    return o;
}

/* The same orbit in another clock; the other clocks are carried. */
static inline void exact_in_clock(orbit *o, iso_clock clock)
{
    orbit_clocks(o, clock, clock != ISO_CLOCK_T, clock != ISO_CLOCK_TAU, clock != ISO_CLOCK_S);
}

/* The closed solution of the orbit. Ends the test when it is refused. */
static inline iso_exact *exact_create(const orbit *o)
{
    iso_exact *exact;
    if (iso_exact_create(o->ctx, &o->model.problem, o->y0, exact_clocks, &exact) == ISO_OK) return exact;
    const double *J = o->model.problem.p.J, *y = o->y0;
    gsl_test(1, "k = %.17g J = %.17g %.17g %.17g M = %.17g %.17g %.17g gamma = %.17g %.17g %.17g: %s",
             o->model.problem.p.k, J[0], J[1], J[2], y[0], y[1], y[2], y[3], y[4], y[5], iso_context_message(o->ctx));
    exit(gsl_test_summary());
}

#endif
