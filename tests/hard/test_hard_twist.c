/* A contact that resists twisting with -c (w,n) n, from the classical ball, c = 0, to the rubber ball, c =
 * infinity; and backwards in time, where it drives the ball. */
#include "hard_effects.h"

static iso_context *ctx;
static iso_params ball;

static iso_effects twist(double c)
{
    iso_effects e = {.number[ISO_TWIST] = {c}};
    e.on[ISO_TWIST] = true;
    return e;
}

static iso_start spinning(void)
{
    iso_start start = he_start();
    add_scaled(start.y, 0.5, start.y + 3);
    return start;
}

/* --- c = 0 and small -------------------------------------------------------------------------------------------- */

static void integrals(const double y[ISO_STATE], double value[2])
{
    double K[3];
    diag(ball.J, y, K);
    add_scaled(K, -ball.D * dot(y, y + 3), y + 3);
    value[0] = dot(K, K);
    value[1] = dot(K, y) / 2;
}

static double integrals_off(const double y[ISO_STATE], const double y0[ISO_STATE])
{
    double now[2], then[2];
    integrals(y, now);
    integrals(y0, then);
    return fmax(fabs(now[0] / then[0] - 1), fabs(now[1] / then[1] - 1));
}

/* As if the no-twist constraint had never been: a heavy top's K = Jw, without the mass under the contact. */
static double naive_classical(const double y[ISO_STATE], const double y0[ISO_STATE])
{
    double Jw[3], Jw0[3];
    diag(ball.J, y, Jw);
    diag(ball.J, y0, Jw0);
    return fabs(dot(Jw, Jw) / dot(Jw0, Jw0) - 1);
}

static void classical(void)
{
    const iso_start start = spinning();
    const iso_effects e = twist(0);
    double naive = 0;
    hard_case("c = 0", "(K,K) and (K,w)/2 at t = 20", "no constraint and no torque: nothing is projected");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, 20);
        hard_hold(way, a.status == ISO_OK ? integrals_off(a.at.ball, start.y) : NAN, he_bound(way, a.steps));
        naive = fmax(naive, naive_classical(a.at.ball, start.y));
    }
    he_refusals(ctx, &ball, &start, &e, 20);
    hard_naive("(Jw,Jw)", naive, 1e-3);
}

/* w and n at t = 5 against taylor_quad, which has no state lambda. */
static void against_quad(const char *name, const char *why, double c, double time)
{
    const iso_start start = spinning();
    const iso_effects e = twist(c);
    const iso_sample expected = he_reference(ctx, &ball, &start, &e, time);
    hard_case(name, "(w,n) against taylor_quad", why);
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, time);
        he_hold(way, &a, &expected);
    }
}

/* --- c large ---------------------------------------------------------------------------------------------------- */

/* Implicit methods reach the rubber ball; the distance is about 1/c (theory), and lambda that of (9), but for 1e4
 * steps' errors: in a fast variable they are of lower order (order reduction), and do not add up. Explicit ones say
 * that they would crawl. */
static void large(const char *name, double c)
{
    const iso_start start = he_start();
    iso_effects rubber = {.number[ISO_REACTIONS] = {true}}, e = twist(c);
    rubber.on[ISO_REACTIONS] = e.on[ISO_REACTIONS] = true;
    const iso_sample expected = he_reference(ctx, &ball, &start, &rubber, 5);
    hard_case(name, "(w,n) and lambda at t = 5 against the rubber ball",
              "the spin dies away in 1/c, lambda = -c 1/c");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, 5);
        if (!way->method->implicit) {
            he_refuses(ctx, way, a.status, "this model is stiff");
            continue;
        }
        hard_hold(way, a.status == ISO_OK ? hard_error(a.at.ball, expected.ball) : NAN,
                  3 / c + he_bound(way, a.steps));
        const double lambda = 3 / c + 1e4 * way->tolerance, spin = dot(a.at.ball, a.at.ball + 3);
        hard_hold(way, fabs(iso_sample_get(&a.at, "lambda") / iso_sample_get(&expected, "lambda") - 1), lambda);
        if (c >= 1e12 && way->method == iso_method_find("bsimp")) /* c times a rounding error of w */
            hard_naive("lambda = -c (w,n)", fabs(-c * spin / iso_sample_get(&expected, "lambda") - 1), lambda);
    }
}

/* The distance falls like 1/c: at ten times c a tenth, but for terms of order 1/c and the tolerance. */
static void falls(void)
{
    const hard_road bsimp = {ISO_BACKEND_BALL, iso_method_find("bsimp"), 1e-14};
    const iso_start start = he_start();
    const iso_effects none = {0};
    const iso_sample rubber = he_reference(ctx, &ball, &start, &none, 5);
    double before = 0, rigid = 0;
    hard_case("c = 1e3 ... 1e8", "10 x distance(10 c)/distance(c) - 1, the rubber ball's distance",
              "an error of 1/c must not drown in that of the method");
    for (double c = 1e3; c < 2e8; c *= 10) {
        const iso_effects e = twist(c);
        const he_answer a = he_solve(ctx, &bsimp, &ball, &start, &e, 5);
        const double distance = a.status == ISO_OK ? hard_error(a.at.ball, rubber.ball) : NAN;
        /* of a distance of about 1/c: next terms c^-2, errors of 200 steps */
        if (before > 0) hard_hold(&bsimp, fabs(10 * distance / before - 1), 100 / c + 200 * 1e-14 * c);
        before = distance;
        rigid = hard_error(start.y, rubber.ball);
    }
    hard_naive("the ball that stands still", rigid, 1e-3);
}

/* Spin grows like exp(c g/(1 - D g) |t|), g = (n,J^-1 n) of 1/3 at least: at c = 10, t = -5 by e^17, and more than a
 * million turns lie on the way. */
static void backwards(const char *name, double c)
{
    const iso_start start = spinning();
    const iso_effects e = twist(c);
    hard_case(name, "a clear end", "resistance drives a ball backwards in time: growth without bound");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const he_answer a = he_solve(ctx, way, &ball, &start, &e, -5);
        he_refuses(ctx, way, a.status, "backwards in time resistance drives the ball");
    }
    const double g = 1 / max3(ball.J);
    hard_naive("steps of a run without end, one a radian", exp(fmin(700, 5 * c * g / (1 - ball.D * g))), 1e6);
}

int main(void)
{
    ctx = iso_context_create();
    ball = he_ball(ctx, -1);
    hard_topic("6a. Effects at their limits: twist");
    classical();
    against_quad("c = 1e-8", "a torque next to rounding", 1e-8, 5);
    against_quad("c = 1", "motion and spin take as long", 1, 5);
    against_quad("c below the switch", "stiffness 50 (1 - 1e-9): lambda follows from w", 50 * (1 - 1e-9), 5);
    against_quad("c above the switch", "stiffness 50 (1 + 1e-9): lambda is a state", 50 * (1 + 1e-9), 5);
    large("c = 1e8", 1e8);
    large("c = 1e12", 1e12);
    falls();
    against_quad("c = 1, t = -2", "spin grows backwards, by e^1.3", 1, -2);
    backwards("c = 10, t = -5", 10);
    backwards("c = 1e12, t = -5", 1e12);
    iso_context_free(ctx);
    exit(hard_summary());
}
