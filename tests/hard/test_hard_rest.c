/* Rolling resistance until rest: w falls through the whole range of doubles, then the ball stands still. */
#include "hard_effects.h"
#include "numbers.h"

static iso_context *ctx;

static iso_effects resisting(double c_r)
{
    iso_effects e = {.number[ISO_ROLLING_RESISTANCE] = {c_r}};
    e.on[ISO_ROLLING_RESISTANCE] = true;
    return e;
}

/* Methods without projection lose (w,n) = 0 by their tolerance, and in the end it is all there is: they say so. */
static bool keeps_spin(const hard_road *way)
{
    return way->method->projects;
}

static const char *const lost_spin = "does not keep (omega,n) = 0";

/* --- w as small as doubles are ---------------------------------------------------------------------------------- */

/* hard_error of numbers whose squares are none. */
static double error_of_small(const double a[ISO_STATE], const double b[ISO_STATE])
{
    double p[ISO_STATE], q[ISO_STATE];
    const double size = largest(b);
    copy(a, p, ISO_STATE);
    copy(b, q, ISO_STATE);
    scale(p, 1 / size);
    scale(q, 1 / size);
    return size > 0 ? hard_error(p, q) : NAN;
}

/* To |w| = 1e-170 of what it was: each of the steps has its error, relative to the w that is left. */
static void fading(void)
{
    const iso_params ball = he_ball(ctx, -1);
    const iso_start start = he_start();
    const iso_effects e = resisting(1);
    const iso_sample expected = he_reference(ctx, &ball, &start, &e, 1000);
    hard_case("c_r = 1, t = 1000", "(w,n), |w| = 8e-170, against taylor_quad", "the squares of w are no doubles");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, 1000);
        if (keeps_spin(way))
            hard_hold(way, a.status == ISO_OK ? error_of_small(a.at.ball, expected.ball) : NAN,
                      he_bound(way, a.steps));
        else
            he_refuses(ctx, way, a.status, lost_spin);
    }
    he_refusals(ctx, &ball, &start, &e, 1000);
    const double h = dot_diag(expected.ball, ball.J, expected.ball) / 2; /* underflows */
    hard_naive("|w| from the energy", fabs(sqrt(2 * h) / largest(expected.ball) - 1), 1e-3);
}

/* --- at rest ---------------------------------------------------------------------------------------------------- */

/* What is wrong: w is not 0, or n no unit vector, or another one than where the ball stopped. */
static double unrest(const iso_sample *late, const iso_sample *stopped)
{
    const double moved = laws_distance(late->ball + 3, stopped->ball + 3);
    return fmax(largest(late->ball) > 0 ? INFINITY : 0, fmax(fabs(norm(late->ball + 3) - 1), moved));
}

/* Long after: as many steps as when it came to rest, and one. */
static void resting(const char *name, const char *why, const iso_effects *e)
{
    const iso_params ball = he_ball(ctx, -1);
    const iso_start start = he_start();
    hard_case(name, "at t = 1e4 and 1e14: w is 0, n a unit vector, no step more", why);
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        if (e->on[ISO_TWIST] && !way->method->implicit) continue;
        const he_answer stopped = he_solve(ctx, way, &ball, &start, e, 1e4);
        if (!keeps_spin(way)) {
            he_refuses(ctx, way, stopped.status, lost_spin);
            continue;
        }
        const he_answer late = he_solve(ctx, way, &ball, &start, e, 1e14);
        const bool answered = stopped.status == ISO_OK && late.status == ISO_OK && late.steps <= stopped.steps + 1;
        const double worst = answered ? fmax(unrest(&stopped.at, &stopped.at), unrest(&late.at, &stopped.at)) : NAN;
        hard_hold(way, worst, 4 * DBL_EPSILON);
    }
    hard_naive("steps in all, each as long as the ball moves: t c_r/max J", 1e14 / 3, 1e7);
}

/* Energy of a w that is scaled up: it falls from row to row, to the last of them. */
static void monotone(void)
{
    const iso_params ball = he_ball(ctx, -1);
    const iso_start start = he_start();
    const iso_effects e = resisting(1);
    double naive = 0;
    hard_case("every 20 units to t = 2000", "rows on which |w|_J does not fall, or that are not finite",
              "below its tolerance w would jitter");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        if (!keeps_spin(way)) continue;
        iso_orbit *orbit = he_orbit(ctx, way, &ball, &start, &e);
        double before = INFINITY, wrong = orbit ? 0 : NAN;
        for (int t = 0; orbit && t <= 2000; t += 20) {
            iso_sample s;
            if (iso_orbit_at(orbit, t, &s) != ISO_OK) wrong = NAN;
            const double w = largest(s.ball), h = dot_diag(s.ball, ball.J, s.ball);
            double u[3] = {0, 0, 0};
            for (int j = 0; j < 3 && w > 0; j++) u[j] = s.ball[j] / w;
            const double size = w * sqrt(dot_diag(u, ball.J, u));
            wrong += !(size < before) && !(size == 0 && before == 0);
            naive += w > 0 && h == 0;
            before = size;
        }
        hard_hold(way, wrong, 0);
        iso_orbit_free(orbit);
    }
    hard_naive("rows on which (w,Jw)/2 has fallen to 0 too early", naive, 0);
}

/* In units of time of 1e200 w goes through the subnormal numbers before the ball rests: no matter of other units. */
static void subnormal(void)
{
    const iso_params ball = he_ball(ctx, -1);
    const double unit = 1e-200;
    iso_start start = he_start();
    const iso_effects e = resisting(unit);
    const iso_start usual = start;
    const iso_effects e_usual = resisting(1);
    scale(start.y, unit);
    hard_case("|w| = 1e-200 at t = 0", "w where it is subnormal, in units of 5e-324",
              "what is left of w loses its digits");
    const double t = 660; /* |w| = 1e-112 of what it was: 1e-312 */
    const iso_sample expected = he_reference(ctx, &ball, &usual, &e_usual, t);
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        if (!keeps_spin(way)) continue;
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, t / unit);
        double off = 0, size = largest(expected.ball) * unit / 5e-324;
        for (int j = 0; j < 3; j++) off = fmax(off, fabs(a.at.ball[j] - expected.ball[j] * unit) / 5e-324);
        hard_hold(way, a.status == ISO_OK ? off : NAN, 1 + size * (he_bound(way, a.steps) + 1e-13));
    }
    hard_naive("a |w| below the normal doubles is refused", largest(expected.ball) * unit < DBL_MIN, 0);
}

/* A stiff one stops in place: n moves by k n x W, W = [J w - (Jw,n) n]/c_r the way that is left, but for c_r^-2. No
 * way is too slow: explicit steps are as short as the motion, and it ends. */
static void at_once(void)
{
    const iso_params ball = he_ball(ctx, -1);
    const iso_start start = he_start();
    const double c_r = 1e8;
    const iso_effects e = resisting(c_r);
    double W[3], moved[3], n[3];
    diag(ball.J, start.y, W);
    remove_along(W, start.y + 3);
    cross(start.y + 3, W, moved);
    copy(start.y + 3, n, 3);
    add_scaled(n, ball.k / c_r, moved);
    hard_case("c_r = 1e8, t = 10", "n against n + k n x W at rest", "the ball stops in 1e-8 of a turn");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        if (!keeps_spin(way)) continue;
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, 10);
        const double off = fmax(largest(a.at.ball) > 0 ? INFINITY : 0, laws_distance(a.at.ball + 3, n));
        hard_hold(way, a.status == ISO_OK ? off : NAN, 1e-15 + he_bound(way, fmin(a.steps, 1e4)));
    }
    hard_naive("no motion at all", laws_distance(start.y + 3, n), 1e-9);
}

/* --- with weight ------------------------------------------------------------------------------------------------ */

/* In a bowl, and hanging on the outside of a sphere: e and n against each other where the potential mgb (e,n)/(1-k)
 * is least, (e,n) = -+1; its angle and w are of the size of the tolerance (1e3 of them, for steps that keep on). */
static void lowest(const char *name, double k, double mgb)
{
    const iso_params ball = he_ball(ctx, k);
    const iso_start start = he_start();
    iso_effects e = resisting(0.3);
    e.on[ISO_GRAVITY] = true;
    GRAVITY_MGB(&e) = mgb;
    copy((const double[]){0, 0.6, 0.8}, GRAVITY_UP(&e), 3);
    const double least = mgb / (1 - k) > 0 ? -1 : 1;
    double naive = 0;
    hard_case(name, "angle from the lowest place, and |w|, at t = 2000",
              "rest is where two torques end, not a state of 0");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, 2000);
        double away[3];
        for (int j = 0; j < 3; j++) away[j] = sample_of(&a.at, "e")[j] - least * a.at.ball[3 + j];
        hard_hold(way, a.status == ISO_OK ? fmax(norm(away), norm(a.at.ball)) : NAN, 1e3 * he_tolerance(way));
        naive = fmax(naive, laws_distance(start.y + 3, a.at.ball + 3));
    }
    hard_naive("rest where the motion began", naive, 1e-3);
}

static void backwards(void)
{
    const iso_params ball = he_ball(ctx, -1);
    const iso_start start = he_start();
    const iso_effects e = resisting(100);
    hard_case("c_r = 100, t = -100", "a clear end", "backwards in time w grows like e^(c_r |t|/J)");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, -100);
        he_refuses(ctx, way, a.status, "backwards in time resistance drives the ball");
    }
    hard_naive("turns on the way", exp(fmin(700, 1e4 / max3(ball.J))), 1e6);
}

int main(void)
{
    ctx = iso_context_create();
    hard_topic("6b. Effects at their limits: rest");
    fading();
    const iso_effects rolling = resisting(1);
    iso_effects stiff = resisting(1);
    stiff.on[ISO_TWIST] = true;
    TWIST_RESISTANCE(&stiff) = 1e8;
    resting("c_r = 1", "w is 0 after 1800 units of 1e14", &rolling);
    resting("c_r = 1, c = 1e8", "a stiff contact with nothing left to do", &stiff);
    monotone();
    subnormal();
    at_once();
    lowest("in a bowl", 2, -1);
    lowest("under a sphere", 0.5, 1);
    backwards();
    iso_context_free(ctx);
    exit(hard_summary());
}
