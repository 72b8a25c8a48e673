/* From point problems to balls (iso_analogue): the ball, integrated as a ball and carried to the point, solves the
 * problem it was made for. That is integrated here, from its potential as stated, with nothing of the library. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "numbers.h"
#include "studies.h"
#include "task/analogue.h"

static iso_random *rng;

/* --- the problem, as stated ---------------------------------------------------------------------------------- */

static double V_of(const iso_analogue_problem *p, const double gamma[3])
{
    if (p->neumann) return dot_diag(gamma, p->c, gamma) / 2;
    return -p->eps * pow(dot_diag(gamma, p->J, gamma), -1 / p->k);
}

/* M' = gamma x dV/dgamma, gamma' = gamma x M */
static int point_equations(double s, const double y[], double dy[], void *data)
{
    const iso_analogue_problem *p = data;
    const double *gamma = y + 3, q = dot_diag(gamma, p->J, gamma);
    double dV[3];
    (void)s;
    for (int i = 0; i < 3; i++)
        dV[i] = p->neumann ? p->c[i] * gamma[i] : 2 * p->eps / p->k * pow(q, -1 / p->k - 1) * p->J[i] * gamma[i];
    cross(gamma, dV, dy);
    cross(gamma, y, dy + 3);
    return GSL_SUCCESS;
}

static void solve_point(const iso_analogue_problem *p, double s, double y[ISO_STATE])
{
    iso_analogue_problem copy_of = *p;
    gsl_odeiv2_system system = {point_equations, NULL, ISO_STATE, &copy_of};
    gsl_odeiv2_driver *d =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, copysign(1e-4, s), 1e-14, 1e-14);
    double from = 0;
    if (gsl_odeiv2_driver_apply(d, &from, s, y) != GSL_SUCCESS) y[0] = NAN;
    gsl_odeiv2_driver_free(d);
}

/* --- one problem --------------------------------------------------------------------------------------------- */

enum { PATH, POTENTIAL, START, BODY, LAWS };

typedef struct worst {
    laws_worst of[LAWS];
} worst;

/* V less that of the ball's twin is the constant `shift`, everywhere on the sphere, and the level is what remains. */
static void check_potential(const iso_analogue *a, const iso_analogue_ball *b, worst *w)
{
    const iso_params *p = &b->params;
    const double k2 = p->k * p->k, det = p->J[0] * p->J[1] * p->J[2];
    const double size = fmax(fabs(a->problem.energy), fmax(fabs(a->lowest), fabs(a->highest))) +
                        fabs(b->eps) * fmax(pow(max3(p->J), -1 / p->k), pow(min3(p->J), -1 / p->k));
    const double allowed = 1e-13 * (1 + 1 / fabs(p->k)) * size; /* k of a body has the rounding of its radii */
    for (int i = 0; i < 8; i++) {
        double gamma[3];
        iso_random_direction(rng, gamma);
        const double twin = -b->eps * pow(dot_diag(gamma, p->J, gamma), -1 / p->k), V = V_of(&a->problem, gamma);
        laws_note(&w->of[POTENTIAL], fabs(V - twin - a->shift), allowed, p, "V");
        laws_note(&w->of[POTENTIAL], fmax(a->lowest - V, V - a->highest), 1e-14 * size, p, "range");
    }
    laws_note(&w->of[POTENTIAL], fabs(b->level * det / k2 - (a->problem.energy - a->shift)), allowed, p, "level");
    laws_note(&w->of[POTENTIAL], fabs(b->h * det / k2 - b->eps), 1e-14 * fabs(b->eps), p, "h");
}

/* The ball itself, (9) with its level, is looked at along the clock s of its twin. */
static void check_path(const iso_analogue *a, const iso_analogue_ball *b, const double start[ISO_STATE], double turns,
                       worst *w)
{
    iso_scene scene;
    iso_orbit *orbit;
    iso_sample sample;
    must(iso_analogue_scene(ctx, b, start, turns, &scene), "a scene");
    gsl_test(scene.effects.on[ISO_LEVEL] != (b->level != 0) || LEVEL_C(&scene.effects) != b->level,
             "the scene's level");
    iso_orbit_options o = iso_orbit_defaults(&scene.start);
    o.backend = ISO_BACKEND_BALL;
    o.effects = &scene.effects;
    o.tolerance = 1e-14;
    o.clock = ISO_CLOCK_S;
    o.shown = ISO_SHOW_BOTH;
    o.with_clock[ISO_CLOCK_T] = true;
    must(iso_orbit_create(ctx, &scene.params, &scene.start, &o, &orbit), "an orbit");
    double y[ISO_STATE];
    copy(start, y, ISO_STATE);
    const double speed = sqrt(2 * (a->problem.energy - a->lowest)) + DBL_MIN;
    for (int i = 0; i <= 6; i++) {
        must(iso_orbit_at(orbit, turns * i / 6, &sample), "the ball");
        if (i > 0) solve_point(&a->problem, turns / 6, y);
        laws_note(&w->of[PATH], laws_distance(sample.point, y) / speed, 1e-10, &b->params,
                  i ? "M" : "M at the start");
        laws_note(&w->of[PATH], laws_distance(sample.point + 3, y + 3), 1e-10, &b->params, i ? "gamma" : "start");
    }
    laws_note(&w->of[START], fabs(sample.clock[ISO_CLOCK_T] - scene.end), 1e-10 * fabs(scene.end), &b->params, "end");
    iso_orbit_free(orbit);
}

/* A body is there exactly if J1 + J2 > J3, and it is one. */
static void check_body(const iso_analogue *a, double mass, double radius, worst *w)
{
    const double *J = a->reduced.params.J, sum = J[0] + J[1] + J[2];
    const bool exists = sum > 2 * max3(J);
    gsl_test(a->has_body != exists, "a body of J = %g %g %g", J[0], J[1], J[2]);
    gsl_test(a->has_body != (*a->no_body == '\0'), "a reason: %s", a->no_body);
    gsl_test(!exists && !strstr(a->no_body, "triangle inequality"), "the reason: %s", a->no_body);
    if (!a->has_body) return;
    const iso_params *p = &a->body.params;
    const iso_body *b = &p->body;
    const double *I = b->inertia;
    iso_params again;
    gsl_test(iso_params_physical(ctx, b, &again) != ISO_OK || memcmp(&again, p, sizeof again) != 0, "a body again");
    gsl_test(b->mass != mass || b->radius != radius, "mass and radius");
    for (int i = 0; i < 3; i++) {
        laws_note(&w->of[BODY], fabs(p->J[i] - a->scale * J[i]), 1e-14 * a->scale * max3(J), p, "J scaled");
        /* in the middle: the triangle inequality is short of equality by D at least */
        const double spare = I[(i + 1) % 3] + I[(i + 2) % 3] - I[i], D = mass * radius * radius;
        gsl_test(!(I[i] > 0) || !(spare > 0.999 * D), "triangle inequality: I = %g %g %g", I[0], I[1], I[2]);
    }
    laws_note(&w->of[BODY], fabs(p->k / a->reduced.params.k - 1), 1e-13, p, "k");
    const double k = a->reduced.params.k;
    const iso_surface expected = k < 0 ? ISO_SHELL : k < 1 ? ISO_OUTSIDE : k == 1 ? ISO_PLANE : ISO_INSIDE;
    gsl_test_int((int)b->surface, (int)expected, "surface of k = %g", k);
}

static iso_analogue check_problem(const iso_analogue_problem *p, bool free, worst *w)
{
    iso_analogue a;
    double point[ISO_STATE];
    const double mass = iso_random_uniform(rng, 0.1, 5), radius = iso_random_uniform(rng, 0.05, 2);
    must(iso_analogue_find(ctx, p, mass, radius, &a), "an analogue");
    gsl_test((a.reduced.level == 0) != free, "E = %g, V in [%g, %g]: c = %g", p->energy, a.lowest, a.highest,
             a.reduced.level);
    gsl_test((a.reduced.level == 0) != (*a.not_free == '\0'), "why it is not free: %s", a.not_free);
    const double turns = 0.3 * iso_analogue_start(&a, point);
    const double E = dot(point, point) / 2 + V_of(p, point + 3), size = fabs(a.lowest) + fabs(a.highest) + fabs(E);
    laws_note(&w->of[START], fabs(E - p->energy), 1e-14 * size, &a.reduced.params, "energy of the start");
    laws_note(&w->of[START], fabs(dot(point, point + 3)), 1e-15 * norm(point), &a.reduced.params, "M.gamma");
    gsl_test(p->energy > a.lowest + 1e-9 && !(dot(point, point) >= 0.99 * (p->energy - a.lowest)), "it moves");
    check_body(&a, mass, radius, w);
    check_potential(&a, &a.reduced, w);
    check_path(&a, &a.reduced, point, turns, w);
    if (a.has_body) {
        check_potential(&a, &a.body, w);
        check_path(&a, &a.body, point, -turns, w);
    }
    return a;
}

static void report(const worst *w, const char *branch)
{
    static const char *const what[] = {"path", "potential", "start and end", "body"};
    char name[128];
    for (int i = 0; i < LAWS; i++) {
        snprintf(name, sizeof name, "%s: %s", branch, what[i]);
        laws_report(&w->of[i], name);
    }
}

/* --- the branches -------------------------------------------------------------------------------------------- */

enum { CASES = 12 };

static void vector(double low, double high, double x[3])
{
    for (int i = 0; i < 3; i++) x[i] = iso_random_uniform(rng, low, high);
}

/* V takes values up to half the largest c. */
static void neumann(void)
{
    worst free = {0}, level = {0}, asked = {0}, low = {0};
    iso_analogue a = {0};
    for (int i = 0; i < CASES; i++) {
        iso_analogue_problem p = {.neumann = true};
        vector(-3, 3, p.c);
        const double bottom = min3(p.c) / 2, top = max3(p.c) / 2;
        p.energy = top + iso_random_uniform(rng, 0.1, 3);
        a = check_problem(&p, true, &free);
        gsl_test(a.choice != ISO_ANALOGUE_FREE || a.reduced.params.k != -1, "Neumann: a free shell");
        p.level = true;
        a = check_problem(&p, false, &asked);
        gsl_test(a.choice != ISO_ANALOGUE_SHIFTED || !a.has_body, "Neumann: the level that was asked for has a body");
        p.level = false;
        p.energy = bottom + iso_random_uniform(rng, 0.1, 0.9) * (top - bottom);
        a = check_problem(&p, false, &level);
        gsl_test(a.choice != ISO_ANALOGUE_SHIFTED || !a.has_body, "Neumann: a level's ball has a body");
        laws_note(&level.of[POTENTIAL], max3(a.reduced.params.J) / min3(a.reduced.params.J) - 1.5, 1e-12,
                  &a.reduced.params, "conditioning");
        p.energy = bottom + 1e-6 * (top - bottom);
        check_problem(&p, false, &low);
    }
    report(&free, "Neumann above the top, free");
    report(&asked, "Neumann above the top, --level");
    report(&level, "Neumann below the top");
    report(&low, "Neumann near the bottom");
}

static const double general_k[] = {1, 0.5, 0.3, 0.9, 2, 7, -0.4, -2.5};
enum { GENERAL_K = sizeof general_k / sizeof *general_k };

static void general(void)
{
    worst zero = {0}, above = {0}, below = {0}, negative = {0};
    for (int i = 0; i < 2 * GENERAL_K; i++) {
        iso_analogue_problem p = {.k = general_k[i / 2], .eps = iso_random_uniform(rng, 0.2, 4)};
        vector(i % 2 ? 0.5 : 1.5, 3, p.J);
        check_problem(&p, true, &zero);
        const double one = V_of(&p, (double[]){1, 0, 0}), two = V_of(&p, (double[]){0, 1, 0});
        p.energy = iso_random_uniform(rng, 0.2, 2);
        check_problem(&p, false, &above);
        p.energy = 0.4 * one + 0.6 * two;
        check_problem(&p, false, &below);
        p.eps = -p.eps;
        p.energy = -0.3 * one - 0.7 * two;
        const iso_analogue a = check_problem(&p, false, &negative);
        gsl_test(!(a.reduced.h < 0) || a.choice != ISO_ANALOGUE_STATED, "eps < 0: h = %g", a.reduced.h);
    }
    report(&zero, "general k, E = 0");
    report(&above, "general k, E > 0");
    report(&below, "general k, E < 0");
    report(&negative, "general k, eps < 0");
}

/* k = -1 stated by J and eps: the level as it is, the free ball of the shifted J, and a body by a shift. */
static void shell(void)
{
    worst zero = {0}, free = {0}, level = {0}, negative = {0}, flat = {0};
    iso_analogue a;
    for (int i = 0; i < CASES; i++) {
        iso_analogue_problem p = {.k = -1, .eps = iso_random_uniform(rng, 0.2, 4)};
        vector(1.6, 3, p.J); /* J1 + J2 > J3 */
        a = check_problem(&p, true, &zero);
        gsl_test(a.choice != ISO_ANALOGUE_STATED || memcmp(a.reduced.params.J, p.J, sizeof p.J) != 0,
                 "shell: J as stated");
        p.level = true;
        check_problem(&p, true, &zero); /* E = 0 with a body: there is no level to be had */
        p.level = false;
        p.energy = iso_random_uniform(rng, -0.9, 2) * p.eps * min3(p.J);
        a = check_problem(&p, true, &free);
        gsl_test(a.choice != ISO_ANALOGUE_FREE || a.reduced.eps != p.eps, "shell: the shift of J leaves eps");
        p.energy = -p.eps * iso_random_uniform(rng, 1.01 * min3(p.J), 0.99 * max3(p.J));
        a = check_problem(&p, false, &level);
        gsl_test(a.choice != ISO_ANALOGUE_STATED || !a.has_body, "shell: the stated J with a level");
        p.eps = -p.eps;
        p.energy = fabs(p.energy);
        a = check_problem(&p, false, &negative);
        gsl_test(!(a.reduced.h < 0), "shell, eps < 0: h = %g", a.reduced.h);
        p.energy = -p.eps * max3(p.J) * iso_random_uniform(rng, 1.1, 3);
        a = check_problem(&p, true, &negative);
        gsl_test(!(a.reduced.h > 0), "shell, eps < 0: free by a shift of J");
        p.eps = -p.eps;
        vector(0.5, 0.9, p.J);
        p.J[i % 3] = 2 + 0.5 * i; /* of no body */
        p.energy = i % 2 ? 0 : -1.1 * p.eps * min3(p.J);
        p.level = i % 2;
        a = check_problem(&p, false, &flat);
        gsl_test(a.choice != ISO_ANALOGUE_SHIFTED || !a.has_body, "shell: a level gives a body to what has none");
    }
    report(&zero, "shell, E = 0");
    report(&free, "shell, free by a shift of J");
    report(&level, "shell, level");
    report(&negative, "shell, eps < 0");
    report(&flat, "shell, body by a shift of J");
}

static void constant(void)
{
    worst w = {0};
    iso_analogue a;
    for (int i = 0; i < GENERAL_K; i++) {
        const double over = iso_random_uniform(rng, 0.1, 3), c = iso_random_uniform(rng, -2, 2);
        iso_analogue_problem p = {.neumann = true, .c = {c, c, c}, .energy = c / 2 + over};
        check_problem(&p, true, &w);
        p = (iso_analogue_problem){.k = general_k[i], .J = {1.7, 1.7, 1.7}, .eps = c};
        p.energy = -c * pow(1.7, -1 / p.k) + over;
        a = check_problem(&p, true, &w);
        gsl_test(a.reduced.params.J[0] != 1.7, "equal moments stay");
        p = (iso_analogue_problem){.k = general_k[i], .J = {1, 2, 5}, .eps = 0, .energy = over};
        a = check_problem(&p, true, &w);
        gsl_test(a.choice != ISO_ANALOGUE_CONSTANT || !a.has_body, "eps = 0: a ball of equal moments");
    }
    report(&w, "constant potentials");
}

/* At the least V the point rests, and so does the ball. */
static void at_rest(void)
{
    iso_analogue a;
    iso_scene scene;
    double point[ISO_STATE];
    const iso_analogue_problem rest[] = {{.neumann = true, .c = {3, -0.1, 2}, .energy = -0.05},
                                         {.k = 0.7, .J = {1.4, 2.1, 3}, .eps = 1, .energy = -pow(1.4, -1 / 0.7)}};
    for (int i = 0; i < 2; i++) {
        must(iso_analogue_find(ctx, &rest[i], 1, 1, &a), "rest");
        const double end = iso_analogue_start(&a, point);
        must(iso_analogue_scene(ctx, &a.body, point, end, &scene), "a scene at rest");
        const double *n = scene.start.y + 3;
        gsl_test(largest(scene.start.y) != 0 || n[i == 0] != 1 || n[i != 0] != 0 || n[2] != 0 || !(scene.end > 0),
                 "a ball at rest");
    }
}

static const struct refusal {
    iso_analogue_problem problem;
    iso_status status;
    const char *field, *words;
} refusal[] = {
#define GENERAL(K, E, EPS, ...)                                                                                      \
    {                                                                                                                \
        .k = K, .energy = E, .eps = EPS, .J = { __VA_ARGS__ }                                                        \
    }
#define NEUMANN(E, ...)                                                                                              \
    {                                                                                                                \
        .neumann = true, .energy = E, .c = { __VA_ARGS__ }                                                           \
    }
    {GENERAL(2, -0.846, 1, 1.4, 2.1, 3), ISO_NOT_MAPPED, "energy", "V is between -0.8451"}, /* -1.4^(-1/2) */
    {GENERAL(2, 0, -1, 1.4, 2.1, 3), ISO_NOT_MAPPED, "energy", "eps = -1 is negative, and so is h"},
    {GENERAL(2, 0, 0, 1.4, 2.1, 3), ISO_NOT_MAPPED, "energy", "V = 0 is constant"},
    {NEUMANN(0.499, 1, 2, 3), ISO_NOT_MAPPED, "energy", "V is between 0.5 and 1.5"},
    {NEUMANN(0.5, 1, 1, 1), ISO_NOT_MAPPED, "energy", "the point rests wherever it is"},
    {NEUMANN(0.4, 1, 1, 1), ISO_NOT_MAPPED, "energy", "there is no motion"},
    {GENERAL(0, 0, 1, 1.4, 2.1, 3), ISO_BAD_INPUT, "k", "k = 0"},
    {GENERAL(2, 0, 1, 1.4, -1, 3), ISO_BAD_INPUT, "J", "J2 = -1"},
    {GENERAL(2, 0, INFINITY, 1.4, 2.1, 3), ISO_BAD_INPUT, "eps", "finite"},
    {GENERAL(2, NAN, 1, 1.4, 2.1, 3), ISO_BAD_INPUT, "energy", "finite"},
    {NEUMANN(1, 1, 2, NAN), ISO_BAD_INPUT, "c", "c3"},
    {GENERAL(1e-4, 0, 1, 1.4, 2.1, 3), ISO_NUMERICAL, "k", "range of doubles"},
    {GENERAL(2, 0, 1, 1e150, 1e150, 1.1e150), ISO_NUMERICAL, "", "does not fit"},
};

static void refusals(void)
{
    iso_analogue a;
    for (size_t i = 0; i < sizeof refusal / sizeof *refusal; i++) {
        const struct refusal *r = &refusal[i];
        const iso_status status = iso_analogue_find(ctx, &r->problem, 1, 1, &a);
        gsl_test(status != r->status || strcmp(iso_context_about(ctx), r->field) != 0 ||
                     !strstr(iso_context_message(ctx), r->words),
                 "refused (%s: %s): %s", r->field, r->words, iso_context_message(ctx));
    }
}

int main(void)
{
    gsl_set_error_handler_off();
    ctx = iso_context_create();
    rng = iso_random_create(20);
    neumann();
    general();
    shell();
    constant();
    at_rest();
    refusals();
    iso_random_free(rng);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
