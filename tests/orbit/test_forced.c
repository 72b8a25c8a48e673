/* Balls under forces: the energy that is lost, and motion run backwards; Neumann's problem as a free ball's. */
#include "orbit/orbit_impl.h"
#include "scenes.h"

static iso_context *ctx;

/* --- energy ----------------------------------------------------------------------------------------------------- */

static laws_worst lost, lost_with_twist;

static iso_effects acting; /* on the orbit whose energy is differenced */

static void energy_seen(const rolling *ball, const iso_sample *s, double h[3])
{
    h[0] = energy_of(ball, &acting, s);
    h[1] = h[2] = 0;
}

/* dh/dt = -c_r (w,w) - c (w,n)^2 */
static void check_resistance(const rolling *ball, double twist, iso_random *random, laws_worst *worst)
{
    iso_start start = scene_start(ball, random);
    double up[3];
    iso_random_direction(random, up);
    acting = (iso_effects){.on[ISO_ROLLING_RESISTANCE] = true, .number[ISO_ROLLING_RESISTANCE] = {0.11}};
    add_gravity(ball, 0.5, up, &acting);
    add_attitude(random, &acting);
    add_field(&acting);
    if (twist > 0) add_twist(twist, &acting), add_scaled(start.y, 0.8, start.y + 3);
    iso_orbit *orbit = scene_orbit(ctx, ball, &start, &acting, NULL);
    for (int i = 0; i < 20; i++) {
        const stencil st = stencil_around(ctx, orbit, ball, 0.3 + 0.5 * i);
        const iso_sample *s = middle(&st);
        const double spin = spin_of(s), w_w = dot(omega_of(s), omega_of(s));
        double slope[3];
        first_derivative(ball, &st, energy_seen, slope);
        laws_note(worst, fabs(slope[0] + ROLLING_COEFFICIENT(&acting) * w_w + twist * spin * spin),
                  1e-10 * pace_of(s) * pace_of(s) * pace_of(s), &ball->p, ball->name);
    }
    iso_orbit_free(orbit);
}

static void check_energies(iso_random *random)
{
    for (int which = 0; which < ROLLINGS; which++) {
        const rolling ball = rolling_ball(ctx, which);
        check_resistance(&ball, 0, random, &lost);
        check_resistance(&ball, 0.6, random, &lost_with_twist);
    }
    laws_report(&lost, "rolling resistance: dh/dt = -c_r (w,w)");
    laws_report(&lost_with_twist, "and with twist: dh/dt = -c_r (w,w) - c (w,n)^2");
}

/* --- Neumann's problem another way ------------------------------------------------------------------------------ */

enum { TIMES = 5 };
static const double times[TIMES] = {1, 17, 60, 100, -100};
static const double eps = 0.8;

static laws_worst shifted;

/* k = -1: at the energy E the point is that of a free ball with moments J + E/eps, where these are positive. Its M is
 * `size` times that of the level H = 0. Gives the sign of E, or 0. */
static int check_shift(double size, iso_random *random)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    const iso_params p = laws_params(-1, J);
    iso_start start = {.model = ISO_POINT, .eps = eps};
    double *const M = start.y, *const gamma = start.y + 3;
    iso_random_direction(random, gamma);
    iso_random_direction(random, M);
    remove_along(M, gamma);
    make_unit(M);
    const double q = dot_diag(gamma, J, gamma);
    scale(M, size * sqrt(2 * eps * q));
    const double shift = (dot(M, M) / 2 - eps * q) / eps;
    const double J_shifted[3] = {J[0] + shift, J[1] + shift, J[2] + shift};
    if (!(min3(J_shifted) > 0.1)) return 0;
    const iso_params free_p = laws_params(-1, J_shifted);
    iso_orbit *point = scene_whole(ctx, &p, &start, ISO_BACKEND_POINT, ISO_CLOCK_S);
    start.eps = NAN;
    iso_orbit *ball = scene_whole(ctx, &free_p, &start, ISO_BACKEND_BALL, ISO_CLOCK_S);
    const iso_effects none = iso_orbit_effects(ball);
    laws_note(&shifted, none.on[ISO_LEVEL] ? 1 : 0, 0.5, &free_p, "free");
    laws_note(&shifted, fabs(iso_orbit_coupling(ball) / eps - 1), 1e-13, &free_p, "eps");
    for (int i = 0; i < TIMES; i++) {
        const iso_sample a = scene_at(ctx, point, times[i]), b = scene_at(ctx, ball, times[i]);
        laws_note(&shifted, laws_distance(a.point + 3, b.point + 3), 1e-10, &free_p, "gamma");
    }
    iso_orbit_free(point);
    iso_orbit_free(ball);
    return shift > 0 ? 1 : -1;
}

static void check_shifts(iso_random *random)
{
    int above = 0, below = 0;
    for (double size = 0.4; size < 2; size += 0.1) {
        const int sign = check_shift(size, random);
        above += sign > 0;
        below += sign < 0;
    }
    laws_report(&shifted, "Neumann at energy E is a free ball with J + E/eps");
    gsl_test(above < 3 || below < 3, "%d points with E > 0, %d with E < 0", above, below);
}

/* --- reversal --------------------------------------------------------------------------------------------------- */

static laws_worst reversed, not_reversed;

/* (w, n, t) -> (-w, n, -t): the orbit back and forth. What is seen of n, of the attitude and of the force is the
 * same. */
static void check_reversal(const rolling *ball, const iso_effects *e, double spin, iso_random *random,
                           laws_worst *worst)
{
    iso_start start = scene_start(ball, random), back;
    add_scaled(start.y, spin, start.y + 3);
    back = start;
    scale(back.y, -1);
    iso_orbit *there = scene_orbit(ctx, ball, &start, e, NULL), *again = scene_orbit(ctx, ball, &back, e, NULL);
    for (double t = 1; t <= 10; t += 3) {
        const iso_sample a = scene_at(ctx, there, t), b = scene_at(ctx, again, -t);
        const double turned_w[3] = {-b.ball[0], -b.ball[1], -b.ball[2]};
        const double allowed = 1e-10 * pace_of(&a) * pace_of(&a);
        laws_note(worst, laws_distance(a.ball, turned_w), allowed, &ball->p, "w");
        laws_note(worst, laws_distance(a.ball + 3, b.ball + 3), allowed, &ball->p, "n");
        laws_note(worst, laws_distance(sample_of(&a, "centre"), sample_of(&b, "centre")),
                  allowed * (1 + norm(sample_of(&a, "centre"))), &ball->p, "centre");
        laws_note(worst, laws_distance(sample_of(&a, "N"), sample_of(&b, "N")),
                  allowed * (1 + norm(sample_of(&a, "N"))), &ball->p, "N");
        laws_note(worst, laws_distance(sample_of(&a, "q") + 1, sample_of(&b, "q") + 1), allowed, &ball->p, "Q");
    }
    iso_orbit_free(there);
    iso_orbit_free(again);
}

static void check_reversals(iso_random *random)
{
    for (int which = 0; which < ROLLINGS; which++) {
        const rolling ball = rolling_ball(ctx, which);
        iso_effects e = {.on[ISO_REACTIONS] = true};
        double up[3];
        iso_random_direction(random, up);
        add_gravity(&ball, 0.5, up, &e);
        add_field(&e);
        add_attitude(random, &e);
        e.on[ISO_LEVEL] = true, LEVEL_C(&e) = 0.2 * pow((ball.p.J[0] + ball.p.J[1] + ball.p.J[2]) / 3, -1 / ball.p.k);
        check_reversal(&ball, &e, 0, random, &reversed);
        add_twist(0, &e);
        check_reversal(&ball, &e, 0.7, random, &reversed);
        iso_effects resisted = e;
        resisted.on[ISO_TWIST] = false, resisted.on[ISO_ROLLING_RESISTANCE] = true,
        ROLLING_COEFFICIENT(&resisted) = 0.1;
        laws_worst one = {0};
        check_reversal(&ball, &resisted, 0, random, &one);
        laws_note(&not_reversed, 1 / one.ratio, 1e-6, &ball.p, ball.name);
    }
    laws_report(&reversed, "weight, field, level, twist without resistance: reversible");
    laws_report(&not_reversed, "rolling resistance is not reversible (1/ratio of the bound)");
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *random = iso_random_create(74);
    check_energies(random);
    check_shifts(random);
    check_reversals(random);
    iso_random_free(random);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
