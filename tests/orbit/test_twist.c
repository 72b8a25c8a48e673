/* A contact that resists twisting with -c (w,n) n: from the classical ball, c = 0, to the rubber ball, c ->
 * infinity. */
#include "scenes.h"

static iso_context *ctx;

/* K = J w - D (w,n) n */
static void momentum(const rolling *ball, const iso_sample *s, double K[3])
{
    diag(ball->p.J, omega_of(s), K);
    add_scaled(K, -ball->m * ball->b * ball->b * spin_of(s), normal_of(s));
}

/* Larger of the distances of w and n. */
static double apart(const iso_sample *a, const iso_sample *b)
{
    return fmax(laws_distance(omega_of(a), omega_of(b)), laws_distance(normal_of(a), normal_of(b)));
}

static iso_sample state_with(const rolling *ball, const iso_start *start, const double *c, double tolerance,
                             double time, iso_statistics *statistics)
{
    iso_effects e = {0};
    iso_orbit_options o = iso_orbit_defaults(start);
    o.tolerance = tolerance;
    if (c) add_twist(*c, &e);
    iso_orbit *orbit = scene_orbit(ctx, ball, start, &e, &o);
    const iso_sample s = scene_at(ctx, orbit, time);
    if (statistics) *statistics = iso_orbit_statistics(orbit);
    iso_orbit_free(orbit);
    return s;
}

/* --- towards the rubber ball ------------------------------------------------------------------------------------ */

enum { DECADES = 5 };

/* The slope of the line through (i, y_i) that misses them least. */
static double fitted_slope(const double y[DECADES])
{
    double sum = 0, squares = 0;
    for (int i = 0; i < DECADES; i++) {
        const double x = i - (DECADES - 1) / 2.0;
        sum += x * y[i];
        squares += x * x;
    }
    return sum / squares;
}

/* c in units of J |w|; the start has no spin, as the rubber ball's */
static void check_limit(const rolling *ball, iso_random *random)
{
    const iso_start start = scene_start(ball, random);
    const iso_sample rigid = state_with(ball, &start, NULL, 1e-14, 5, NULL);
    double logarithm[DECADES];
    for (int i = 0; i < DECADES; i++) {
        const double c = pow(10, 2 + i);
        const iso_sample s = state_with(ball, &start, &c, 1e-12, 5, NULL);
        logarithm[i] = log10(apart(&s, &rigid));
    }
    const double slope = fitted_slope(logarithm);
    gsl_test(!(fabs(slope + 1) <= 0.05), "%s: distance from the rubber ball ~ c^%.4f, %.2g at c = 100, %.2g at 1e6",
             ball->name, slope, pow(10, logarithm[0]), pow(10, logarithm[DECADES - 1]));
}

/* --- the price of a stiff contact ------------------------------------------------------------------------------- */

/* Right-hand sides of a run with `outputs` states up to t = 20, and how far from the rubber ball it ends. */
static long price(const rolling *ball, const iso_start *start, double c, int outputs, const iso_sample *rigid,
                  double *distance)
{
    iso_effects e = {0};
    iso_orbit_options o = iso_orbit_defaults(start);
    iso_sample s = {0};
    o.tolerance = 1e-10;
    add_twist(c, &e);
    iso_orbit *orbit = scene_orbit(ctx, ball, start, &e, &o);
    for (int i = 1; i <= outputs; i++) s = scene_at(ctx, orbit, 20.0 * i / outputs);
    *distance = apart(&s, rigid);
    const long rhs = iso_orbit_statistics(orbit).rhs;
    iso_orbit_free(orbit);
    return rhs;
}

static void check_price(const rolling *ball, iso_random *random)
{
    const iso_start start = scene_start(ball, random);
    const iso_sample rigid = state_with(ball, &start, NULL, 1e-14, 20, NULL);
    for (int outputs = 1; outputs <= 100; outputs *= 10) {
        double far, near;
        const long few = price(ball, &start, 1e2, outputs, &rigid, &far);
        const long many = price(ball, &start, 1e8, outputs, &rigid, &near);
        gsl_test(many > 3 * few, "%s, %d outputs: %ld right-hand sides at c = 1e2, %.2f times that at 1e8",
                 ball->name, outputs, few, (double)many / (double)few);
        gsl_test(!(near < 1e-5), "%s: at c = 1e8 the rubber ball, to %.2g", ball->name, near);
    }
}

/* --- the classical ball ----------------------------------------------------------------------------------------- */

static laws_worst classical, in_space;
static double least_difference = INFINITY;

static void momentum_in_space(const rolling *ball, const iso_sample *s, double K[3])
{
    double in_body[3];
    momentum(ball, s, in_body);
    to_space(s, in_body, K);
}

/* (K,K) and (K,w)/2, and K itself in space: nothing turns it. */
static void check_classical(const rolling *ball, double spin, iso_random *random)
{
    iso_effects e = {0};
    iso_start start = scene_start(ball, random), rubber = start;
    add_scaled(start.y, spin, start.y + 3);
    add_twist(0, &e);
    add_attitude(random, &e);
    iso_orbit *orbit = scene_orbit(ctx, ball, &start, &e, NULL);
    const iso_sample begin = scene_at(ctx, orbit, 0);
    double K0[3], K[3], furthest = 0;
    momentum(ball, &begin, K0);
    for (int t = -100; t <= 100; t += 5) {
        const iso_sample s = scene_at(ctx, orbit, t);
        double there[3], here[3];
        momentum(ball, &s, K);
        laws_note(&classical, fabs(dot(K, K) / dot(K0, K0) - 1), 1e-12, &ball->p, "(K,K)");
        laws_note(&classical, fabs(dot(K, omega_of(&s)) / dot(K0, omega_of(&begin)) - 1), 1e-12, &ball->p, "(K,w)");
        momentum_in_space(ball, &s, there);
        momentum_in_space(ball, &begin, here);
        laws_note(&in_space, laws_distance(there, here) / norm(here), 1e-11, &ball->p, ball->name);
        if (spin == 0 && t > 0 && t <= 20) {
            const iso_sample r = state_with(ball, &rubber, NULL, 1e-12, t, NULL);
            furthest = fmax(furthest, apart(&s, &r));
        }
    }
    if (spin == 0) least_difference = fmin(least_difference, furthest);
    iso_orbit_free(orbit);
}

/* --- the shell of twice the radius ------------------------------------------------------------------------------ */

/* Moments of a body, and D, in random axes of size. */
static rolling random_shell(iso_random *random, double k)
{
    double part[3], J[3];
    rolling ball = {.m = iso_random_uniform(random, 0.05, 1), .b = -1, .side = -1, .a = k / (k - 1)};
    for (int i = 0; i < 3; i++) part[i] = exp(iso_random_uniform(random, -1.5, 1));
    for (int i = 0; i < 3; i++) J[i] = part[(i + 1) % 3] + part[(i + 2) % 3] + ball.m;
    snprintf(ball.name, sizeof ball.name, "k = %g", k);
    ball.p = laws_params(k, J);
    if (iso_params_set_D(ctx, ball.m, &ball.p) != ISO_OK) scene_stops("a ball is refused", ctx);
    return ball;
}

/* The largest change of (A K,n) up to t = 10, by the size of A K; A = diag(J2 + J3 - J1, ...) is written out here. */
static double turned_drift(const rolling *ball, iso_random *random)
{
    const double *J = ball->p.J, A[3] = {J[1] + J[2] - J[0], J[2] + J[0] - J[1], J[0] + J[1] - J[2]};
    iso_effects e = {0};
    iso_start start = scene_start(ball, random);
    double K[3], AK[3], first = 0, size = 0, most = 0;
    add_scaled(start.y, iso_random_uniform(random, -1, 1), start.y + 3);
    add_twist(0, &e);
    iso_orbit *orbit = scene_orbit(ctx, ball, &start, &e, NULL);
    for (int t = 0; t <= 10; t++) {
        const iso_sample s = scene_at(ctx, orbit, t);
        momentum(ball, &s, K);
        diag(A, K, AK);
        if (t == 0) first = dot(AK, normal_of(&s)), size = norm(AK);
        most = fmax(most, fabs(dot(AK, normal_of(&s)) - first) / size);
    }
    iso_orbit_free(orbit);
    return most;
}

/* Borisov and Fedorov's case: (A K,n) is constant at k = -1, and not beside it. */
static void check_turned(iso_random *random)
{
    double most = 0, least = INFINITY;
    for (int i = 0; i < 100; i++) {
        const rolling ball = random_shell(random, -1), other = random_shell(random, -0.9);
        most = fmax(most, turned_drift(&ball, random));
        least = fmin(least, turned_drift(&other, random));
    }
    gsl_test(!(most < 1e-13), "c = 0, k = -1: (A K,n) is conserved, to %.2g", most);
    gsl_test(!(least > 1e-4), "c = 0, k = -0.9: it is not: it changes by %.2g at least", least);
}

/* --- what twisting costs ---------------------------------------------------------------------------------------- */

static laws_worst dissipation, decay;

static void energy_seen(const rolling *ball, const iso_sample *s, double h[3])
{
    const iso_effects none = {0};
    h[0] = energy_of(ball, &none, s);
    h[1] = h[2] = 0;
}

/* dh/dt = -c (w,n)^2; and the spin of a stiff contact is soon a thousandth of what it was */
static void check_loss(const rolling *ball, double c, iso_random *random)
{
    iso_effects e = {0};
    iso_start start = scene_start(ball, random);
    add_scaled(start.y, 1, start.y + 3);
    add_twist(c, &e);
    iso_orbit *orbit = scene_orbit(ctx, ball, &start, &e, NULL);
    for (int i = 0; i < 10; i++) {
        const stencil st = stencil_at(ctx, orbit, 0.2 + 0.4 * i, 1 / (60 * (1 + fabs(ball->p.k)) * (1 + c)));
        const double spin = spin_of(middle(&st));
        double slope[3];
        first_derivative(ball, &st, energy_seen, slope);
        laws_note(&dissipation, fabs(slope[0] + c * spin * spin), 1e-10 * (1 + c), &ball->p, ball->name);
    }
    iso_orbit_free(orbit);
    const double stiff = 1e4;
    const iso_sample s = state_with(ball, &start, &stiff, 1e-10, 0.1, NULL);
    laws_note(&decay, fabs(spin_of(&s)), 1e-3, &ball->p, ball->name);
}

/* A start with spin s: at once its contact takes s out by an impulse along n, w -> w - (s/g) J^-1 n, g = (n,J^-1 n).
 * From there it is a rubber ball. */
static laws_worst blow;

static void check_blow(const rolling *ball, iso_random *random)
{
    const iso_start rubber = scene_start(ball, random);
    const double g = dot_diag(rubber.y + 3, ball->p.inv_J, rubber.y + 3), c = 1e6;
    iso_start spinning = rubber;
    for (int i = 0; i < 3; i++) spinning.y[i] += 0.9 / g * ball->p.inv_J[i] * rubber.y[3 + i];
    const iso_sample a = state_with(ball, &spinning, &c, 1e-10, 2, NULL);
    const iso_sample b = state_with(ball, &rubber, NULL, 1e-10, 2, NULL);
    laws_note(&blow, apart(&a, &b), 5e-5, &ball->p, ball->name);
}

int main(void)
{
    gsl_test_verbose(1);
    ctx = iso_context_create();
    iso_random *random = iso_random_create(73);
    for (int which = 0; which < ROLLINGS; which++) {
        const rolling ball = rolling_ball(ctx, which);
        check_limit(&ball, random);
        check_price(&ball, random);
        check_classical(&ball, 0, random);
        check_classical(&ball, 0.8, random);
        check_loss(&ball, 0.3, random);
        check_loss(&ball, 4, random);
        check_blow(&ball, random);
    }
    check_turned(random);
    laws_report(&classical, "c = 0: (K,K) and (K,w)/2 are conserved");
    laws_report(&in_space, "c = 0: K stands still in space");
    gsl_test(!(least_difference > 0.1), "c = 0 is no rubber ball: %.2g away at least", least_difference);
    laws_report(&dissipation, "dh/dt = -c (w,n)^2");
    laws_report(&decay, "a stiff contact takes the spin out");
    laws_report(&blow, "spin that a stiff contact takes out at a blow");
    iso_random_free(random);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
