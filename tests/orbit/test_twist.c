/* A contact that resists twisting with -c (w,n) n: from the classical ball, c = 0, to the rubber ball, c ->
 * infinity. */
#include "scenes.h"

static iso_context *ctx;

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

static laws_worst in_space;
static double least_difference = INFINITY;

/* K = J w - D (w,n) n */
static void momentum_in_space(const rolling *ball, const iso_sample *s, double K[3])
{
    double in_body[3];
    diag(ball->p.J, omega_of(s), in_body);
    add_scaled(in_body, -ball->m * ball->b * ball->b * spin_of(s), normal_of(s));
    to_space(s, in_body, K);
}

/* K in space: nothing turns it. */
static void check_classical(const rolling *ball, double spin, iso_random *random)
{
    iso_effects e = {0};
    iso_start start = scene_start(ball, random), rubber = start;
    add_scaled(start.y, spin, start.y + 3);
    add_twist(0, &e);
    add_attitude(random, &e);
    iso_orbit *orbit = scene_orbit(ctx, ball, &start, &e, NULL);
    const iso_sample begin = scene_at(ctx, orbit, 0);
    double furthest = 0;
    for (int t = -100; t <= 100; t += 5) {
        const iso_sample s = scene_at(ctx, orbit, t);
        double there[3], here[3];
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

/* A start with spin s: at once its contact takes s out by an impulse along n, w -> w - (s/g) J^-1 n, g = (n,J^-1 n).
 * From there it is a rubber ball, and turns about n by lambda/c alone. */
static laws_worst blow, decay;

static void check_blow(const rolling *ball, iso_random *random)
{
    const iso_start rubber = scene_start(ball, random);
    const double g = dot_diag(rubber.y + 3, ball->p.inv_J, rubber.y + 3), c = 1e6;
    iso_start spinning = rubber;
    for (int i = 0; i < 3; i++) spinning.y[i] += 0.9 / g * ball->p.inv_J[i] * rubber.y[3 + i];
    const iso_sample a = state_with(ball, &spinning, &c, 1e-10, 2, NULL);
    const iso_sample b = state_with(ball, &rubber, NULL, 1e-10, 2, NULL);
    laws_note(&blow, apart(&a, &b), 5e-5, &ball->p, ball->name);
    laws_note(&decay, fabs(spin_of(&a)), 1e-5, &ball->p, ball->name);
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *random = iso_random_create(73);
    for (int which = 0; which < ROLLINGS; which++) {
        const rolling ball = rolling_ball(ctx, which);
        check_price(&ball, random);
        check_classical(&ball, 0, random);
        check_classical(&ball, 0.8, random);
        check_blow(&ball, random);
    }
    laws_report(&in_space, "c = 0: K stands still in space");
    gsl_test(!(least_difference > 0.1), "c = 0 is no rubber ball: %.2g away at least", least_difference);
    laws_report(&decay, "a stiff contact takes the spin out");
    laws_report(&blow, "at a blow");
    iso_random_free(random);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
