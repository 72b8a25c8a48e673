/* Moments of inertia: nearly equal, very different, flat and needle-like bodies. Units are in test_hard_units.c. */
#include "hard.h"

static iso_context *ctx;
enum { K = 5 };
static const double ks[K] = {1, -1, 0.5, 0.75, -0.4};

/* --- scenes ----------------------------------------------------------------------------------------------------- */

typedef struct scene {
    iso_params p;
    iso_start start;
    iso_clock clock;
    double time;
    iso_sample expected; /* in 128 bits (in long double where there are none) */
    double condition;    /* of the state asked by s: what a relative change of s makes of n, at least 1 */
} scene;

enum { MOST = 128 };
static scene scenes[MOST];
static int count;

static iso_sample solve_finely(const scene *s, iso_backend backend)
{
    const iso_method *quad = iso_method_find("taylor_quad");
    const hard_road road = {backend, quad ? quad : iso_method_find("taylor_extended"), 1e-15};
    iso_sample at;
    const iso_status status = hard_solve(ctx, &road, &s->p, &s->start, NULL, true, s->clock, s->time, &at);
    gsl_test(status != ISO_OK, "a reference: %s", status == ISO_OK ? "" : iso_context_message(ctx));
    return at;
}

/* w = J^(-1/2) x with x in the plane across gamma, of energy 1/2: every axis has a share in it. The start is from a
 * generic n, or from a generic gamma, which is n near the heavy axis and w near the light one. `turns` are of the
 * start's speed. */
static void add_scene(const iso_params *p, bool from_gamma, double turns, bool in_s)
{
    scene *s = &scenes[count++];
    double n[3] = {0.36, 0.48, 0.8}, g[3], x[3] = {0.9, -0.3, 0.5}, w[3];
    *s = (scene){.p = *p, .condition = 1};
    for (int i = 0; from_gamma && i < 3; i++) n[i] *= p->root_J[i];
    make_unit(n);
    for (int i = 0; i < 3; i++) g[i] = n[i] / p->root_J[i];
    make_unit(g);
    remove_along(x, g);
    make_unit(x);
    for (int i = 0; i < 3; i++) w[i] = x[i] / p->root_J[i];
    gsl_test(iso_start_ball(ctx, w, n, ISO_SPIN_REMOVE, &s->start) != ISO_OK, "a start");
    s->time = turns * 2 * M_PI / (fabs(p->k) * norm(s->start.y));
    s->clock = ISO_CLOCK_T;
    s->expected = solve_finely(s, ISO_BACKEND_POINT);
    if (!in_s) return;
    s->time = s->expected.clock[ISO_CLOCK_S];
    s->clock = ISO_CLOCK_S;
    s->expected = solve_finely(s, ISO_BACKEND_BALL);
    const double rate =
        iso_clock_rate(p, ISO_CLOCK_S, 1 / dot_diag(s->expected.ball + 3, p->inv_J, s->expected.ball + 3), NULL);
    s->condition = fmax(1, fabs(p->k) * norm(s->expected.ball) / rate * s->time);
}

static iso_params reduced(double k, const double J[3])
{
    iso_params p = {0};
    gsl_test(iso_params_reduced(ctx, k, J, &p) != ISO_OK, "a body");
    return p;
}

/* --- errors by every way ---------------------------------------------------------------------------------------- */

typedef struct worst {
    double error;
    int refused;
    bool lost; /* refused where a double tells the time */
    char words[256];
} worst;

/* Of the energy alone, or of the state over its condition. */
static double error_of(const scene *s, const iso_sample *at, bool energy_alone)
{
    const double *J = s->p.J, *expected = s->expected.ball;
    if (energy_alone) return fabs(dot_diag(at->ball, J, at->ball) / dot_diag(expected, J, expected) - 1);
    return hard_error(at->ball, expected) / s->condition;
}

static worst measure(const hard_road *way, bool energy_alone)
{
    worst w = {0};
    for (int i = 0; i < count; i++) {
        const scene *s = &scenes[i];
        iso_sample at;
        if (hard_solve(ctx, way, &s->p, &s->start, NULL, true, s->clock, s->time, &at) != ISO_OK) {
            w.refused++;
            w.lost = w.lost || s->condition < 1e12;
            snprintf(w.words, sizeof w.words, "%s", iso_context_message(ctx));
            continue;
        }
        const double error = error_of(s, &at, energy_alone);
        if (!(error <= w.error)) w.error = error;
    }
    return w;
}

/* Taylor series and the closed solution: rounding, times the condition. Others: a tolerance a step, of which there
 * are some hundreds, times the condition; or, of methods of several steps, which carry each on, 3e4 tolerances in a
 * few turns. What cannot be projected promises its energy alone, to a thousandth or 1e4 tolerances (orbit.c), in such
 * bodies. */
static double bound_of(const hard_road *way, double rounding, double ratio)
{
    if (!way->method || strncmp(way->method->name, "taylor", 6) == 0) return rounding;
    if (ratio > 1 && !way->method->projects) return 2 * fmax(1e-3, 1e4 * way->tolerance);
    return rounding + fmax(3e4, 1e3 * sqrt(ratio)) * way->tolerance;
}

static void hold_all(double rounding, double ratio)
{
    for (int i = 0; i < hard_ways; i++) {
        const iso_method *m = hard_way[i].method;
        const worst w = measure(&hard_way[i], ratio > 1 && m && !m->projects);
        if (w.refused < count) hard_hold(&hard_way[i], w.error, bound_of(&hard_way[i], rounding, ratio));
        const bool may = !m || !m->projects || !w.lost;
        if (w.refused > 0) hard_refused(&hard_way[i], may, w.words);
    }
    count = 0;
}

/* --- nearly equal ----------------------------------------------------------------------------------------------- */

static double ulps(double x, int n)
{
    while (n-- > 0) x = nextafter(x, INFINITY);
    return x;
}

/* One pair, about each axis, or all three. */
static void nearly_equal(int pair, int apart, double J[3])
{
    J[0] = 2.1, J[1] = ulps(2.1, apart), J[2] = ulps(J[1], apart);
    if (pair == 3) return;
    const double middle[3] = {2.1, ulps(2.1, apart), pair == 1 ? 1.4 : 3.0};
    for (int i = 0; i < 3; i++) J[(pair + 1 + i) % 3] = middle[i];
}

static void test_nearly_equal(void)
{
    static const int apart[] = {0, 1, 4};
    for (int a = 0; a < 3; a++) {
        char name[64];
        double J[3], square[3];
        snprintf(name, sizeof name, "two or all J equal to %d ulp", apart[a]);
        hard_case(name, "(omega, n) after 3 turns, by t and by s; five k",
                  "sphero-conical coordinates have no place for equal moments; what is equal to 4 ulp is served as "
                  "symmetric");
        for (int pair = 0; pair < 4; pair++)
            for (int k = pair % 2; k < K; k += 2) {
                nearly_equal(pair, apart[a], J);
                const iso_params p = reduced(ks[k], J);
                add_scene(&p, false, 3, pair < 2);
            }
        hold_all(1e-12, 1); /* 20 radians, a condition of 100 (k = -0.4), and the 8 ulp that the moments differ by */
        hard_naive_squares(J, (const double[3]){0.36, 0.48, 0.8}, square);
        hard_naive("n3^2 from lam and mu by (13)", fabs(square[2] - 0.64), 1e-13);
    }
}

/* --- very different --------------------------------------------------------------------------------------------- */

/* With k < 0 gamma winds sqrt(max J/min J) times in a turn of w: some windings are followed. */
static void test_very_different(double ratio, const char *name)
{
    hard_case(name,
              "(omega, n) after 0.3 turns (k < 0: some windings of gamma), from a generic n and from a generic "
              "gamma, by t, and by s over its condition",
              "(9): J w x w and lambda n are max J/min J times larger than their sum; n and gamma are each other's "
              "components times sqrt(max J/min J)");
    const double bodies[2][3] = {{1, 1.3, ratio}, {sqrt(ratio), ratio, 1}};
    for (int k = 0; k < K; k++) {
        const iso_params p = reduced(ks[k], bodies[k % 2]);
        if (ks[k] > 0) add_scene(&p, false, 0.3, k == 0 && ratio < 1e12); /* there an ulp of s is a turn */
        add_scene(&p, true, ks[k] < 0 ? 3 / sqrt(ratio) : 0.3, k > 1 && (ratio < 1e12 || ks[k] < 0));
    }
    hold_all(100 * DBL_EPSILON * sqrt(ratio), ratio);
}

/* --- flat and needle-like bodies -------------------------------------------------------------------------------- */

static iso_params body(iso_surface surface, double mass, const double inertia[3])
{
    const double A[] = {[ISO_PLANE] = 1, [ISO_OUTSIDE] = 3, [ISO_INSIDE] = 3, [ISO_SHELL] = 0.5};
    const iso_body b = {mass, 1, {inertia[0], inertia[1], inertia[2]}, surface, A[surface]};
    iso_params p = {0};
    gsl_test(iso_params_physical(ctx, &b, &p) != ISO_OK, "a body: %s", iso_context_message(ctx));
    return p;
}

static void test_flat_and_needles(void)
{
    static const double flat[2][3] = {{1, 2, 3}, {0.1, 0.7, 0.8}}; /* 0.1 + 0.7 < 0.8 in doubles */
    hard_case("flat bodies, I3 = I1 + I2", "(omega, n) after 2 turns",
              "the triangle inequality holds but for rounding");
    for (iso_surface surface = ISO_PLANE; surface <= ISO_SHELL; surface++)
        for (int b = 0; b < 2; b++) {
            const iso_params p = body(surface, 1e-3, flat[b]);
            add_scene(&p, b == 1, 2, (int)surface % 2 == b);
        }
    hold_all(1e-12, 1);
    hard_naive("refused by I3 <= I1 + I2", flat[1][2] <= flat[1][0] + flat[1][1] ? 0 : NAN, 1e-12);
    hard_case("needles, I1 and D = 1e-12", "(omega, n) after 1/10 turn",
              "J1 -> 0: J1 = I1 + D is of two small numbers");
    for (iso_surface surface = ISO_PLANE; surface <= ISO_SHELL; surface += 3) {
        const iso_params p = body(surface, 1e-12, (const double[]){1e-12, 1, 1});
        add_scene(&p, surface == ISO_SHELL, surface == ISO_SHELL ? 3e-6 : 0.1, surface == ISO_PLANE);
    }
    hold_all(100 * DBL_EPSILON * 1e6, 1e12);
}

int main(void)
{
    ctx = iso_context_create();
    hard_topic("2. Moments of inertia and units");
    test_nearly_equal();
    test_very_different(1e6, "J of ratio 1e6");
    test_very_different(1e12, "J of ratio 1e12");
    test_flat_and_needles();
    iso_context_free(ctx);
    return hard_summary();
}
