/* Geometry numbers: |k| down to 1e-6, where q^(1/k) spans up to 1e6 decades; up to 1e6, where the normal turns |k|
 * times as fast as the ball; next to 1/2, 1 and -1, where formulas change.
 *
 * References are runs of taylor_quad by the other backend, which is another formulation, or closed forms. Errors are
 * measured in units of the orbit's condition C, by which errors of the start are magnified on the way, and of what
 * the quantity adds to it; what is left is, over the N steps and the angle T of the way,
 *     methods that follow their tolerance:       N tolerance, N up to 1000, of which multistep methods lose 3:
 *     FOLLOWING
 *     taylor and rk8pd at their least tolerance: a few roundings a step and a radian:      ROUNDING
 *     the closed solution:                       the same */
#include "hard.h"

static iso_context *ctx;

static const double bodies[][3] = {{1, 1.2, 1.5}, {1.4, 2.1, 3.0}, {1, 30, 1000}};
enum { BODIES = 3 };

static const double FOLLOWING = 3000, ROUNDING = 256 * DBL_EPSILON;

/* --- one orbit, by one way -------------------------------------------------------------------------------------- */

/* What is asked: of the point gamma alone, or all and the clocks. */
typedef struct question {
    iso_params p;
    iso_start start;
    const iso_effects *effects;
    bool all;
    iso_clock clock;
    double time;
} question;

static question ask(double k, const double J[3], double time)
{
    question q = {.p = laws_params(k, J), .time = time, .clock = ISO_CLOCK_T};
    q.start = (iso_start){.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}, .eps = NAN};
    return q;
}

static iso_status solve(const hard_road *way, const question *q, iso_sample *s)
{
    iso_orbit *orbit;
    iso_orbit_options o = iso_orbit_defaults(&q->start);
    o.effects = q->effects;
    o.backend = way->backend;
    o.method = way->method;
    o.tolerance = way->tolerance;
    o.clock = q->clock;
    o.shown = ISO_SHOW_BOTH;
    o.gamma_alone = !q->all;
    o.max_steps = 1000000;
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = q->all;
    iso_status status = iso_orbit_create(ctx, &q->p, &q->start, &o, &orbit);
    if (status == ISO_OK) status = iso_orbit_at(orbit, q->time, s);
    if (status == ISO_OK) iso_orbit_free(orbit);
    return status;
}

static iso_status solve_quad(iso_backend backend, const question *q, iso_sample *s)
{
    return solve(&(hard_road){backend, iso_method_find("taylor_quad"), 1e-15}, q, s);
}

static double larger(double a, double b)
{
    return !(b <= a) ? b : a;
}

/* Largest relative error of omega, n and gamma, and of all that was asked; M and the clocks have powers q^(1 +
 * 1/(2k)). */
static double error_of(const question *q, const iso_sample *a, const iso_sample *b)
{
    double worst = larger(hard_error(a->ball, b->ball), laws_distance(a->point + 3, b->point + 3)), powers = 0;
    if (!q->all) return worst;
    powers = larger(powers, laws_distance(a->point, b->point) / laws_norm(b->point));
    for (int c = 0; c < ISO_CLOCKS; c++) powers = larger(powers, fabs(a->clock[c] / b->clock[c] - 1));
    return larger(worst, powers / (1 + 1 / fabs(q->p.k)));
}

/* By how much a start turned by 1e-7 in the body moves the state that is asked for, 1 at least. */
static double condition(const question *q, const iso_sample *truth)
{
    const double turn = 1e-7;
    double worst = 1;
    for (int axis = 0; axis < 3; axis++) {
        question other = *q;
        iso_sample s;
        const double e[3] = {axis == 0, axis == 1, axis == 2};
        for (int v = 0; v < ISO_STATE; v += 3) {
            double side[3];
            cross(e, q->start.y + v, side);
            add_scaled(other.start.y + v, turn, side);
        }
        make_unit(other.start.y + 3);
        remove_along(other.start.y, other.start.y + 3);
        if (solve_quad(ISO_BACKEND_BALL, &other, &s) == ISO_OK) worst = fmax(worst, error_of(q, &s, truth) / turn);
    }
    return worst;
}

/* --- all ways over many orbits ---------------------------------------------------------------------------------- */

/* The least tolerance where a method reaches the rounding level, and the bound that goes with it. */
static hard_road finest(const hard_road *way, double *bound)
{
    hard_road r = *way;
    const bool taylor = way->method == iso_method_find("taylor"), exact = way->backend == ISO_BACKEND_EXACT;
    const bool extended = way->method && strcmp(way->method->name, "taylor_extended") == 0;
    if (taylor || extended) r.tolerance = 1e-15;
    if (way->method == iso_method_find("rk8pd")) r.tolerance = 1e-14;
    const double steps = taylor || extended || exact ? 0 : r.tolerance < way->tolerance ? 30 : FOLLOWING;
    *bound = ROUNDING + steps * r.tolerance;
    return r;
}

typedef struct verdict {
    double worst; /* -1: not asked */
    bool refused;
    char words[256];
} verdict;

static verdict book[HARD_WAYS];
static double quads; /* the worst distance between taylor_quad's two backends; -1: none */

static void open_book(void)
{
    quads = -1;
    for (int i = 0; i < hard_ways; i++) book[i] = (verdict){.worst = -1};
}

/* Whether a way may refuse: methods for (24) alone where its powers are steep, the closed solution, and (24) under
 * effects where its powers are no doubles. */
static bool may_refuse(const hard_road *way, const question *q)
{
    const bool bound = way->method && way->method->system;
    if (way->backend == ISO_BACKEND_EXACT) return fabs(q->p.k) != 1 || q->effects;
    return way->backend == ISO_BACKEND_POINT && iso_params_steep(&q->p) &&
           (bound || (q->effects && fabs(q->p.k) < 1e-3));
}

/* Every way's error, in units of the condition times `angle`. */
static void judge(const question *q, const iso_sample *truth, double unit)
{
    for (int i = 0; i < hard_ways; i++) {
        double bound;
        const hard_road way = finest(&hard_way[i], &bound);
        iso_sample s;
        const iso_status status = solve(&way, q, &s);
        if (status != ISO_OK && may_refuse(&way, q)) {
            book[i].refused = true;
            snprintf(book[i].words, sizeof book[i].words, "%s", iso_context_message(ctx));
        } else
            book[i].worst = larger(book[i].worst, status == ISO_OK ? error_of(q, &s, truth) / unit : NAN);
        if (status != ISO_OK && !may_refuse(&way, q))
            printf("k = %g, J = %g %g %g: %s\n", q->p.k, q->p.J[0], q->p.J[1], q->p.J[2], iso_context_message(ctx));
    }
}

static void judge_by_quad(const question *q)
{
    iso_sample ball, point;
    const bool both = solve_quad(ISO_BACKEND_POINT, q, &point) == ISO_OK;
    if (solve_quad(ISO_BACKEND_BALL, q, &ball) != ISO_OK) ball.ball[0] = NAN;
    const double C = condition(q, &ball);
    if (both) quads = larger(quads, error_of(q, &point, &ball) / C);
    judge(q, &ball, C);
}

static void close_book(void)
{
    if (quads != -1) hard_hold(NULL, quads, ROUNDING);
    for (int i = 0; i < hard_ways; i++) {
        double bound;
        finest(&hard_way[i], &bound);
        if (book[i].refused) hard_refused(&hard_way[i], true, book[i].words);
        if (book[i].worst >= 0 || isnan(book[i].worst)) hard_hold(&hard_way[i], book[i].worst, bound);
    }
}

/* --- the cases -------------------------------------------------------------------------------------------------- */

/* At the short length each body turns one way. */
static bool is_taken(int b, int sign)
{
    return tests_length(0, 1) || (b + (sign > 0)) % 2;
}

static void small(void)
{
    hard_case("|k| = 0.1 to 1e-6", "the ball, and gamma, at t = 3, over the condition of the orbit",
              "q^(1/k) spans up to 1e6 decades, and |M| = sqrt(2 eps) q^(-1/(2k)) with it");
    open_book();
    for (int b = 0; b < BODIES; b++)
        for (double k = 0.1; k > 5e-7; k /= 10)
            for (int sign = -1; sign <= 1; sign += 2) {
                const question q = ask(sign * k, bodies[b], 3);
                if (is_taken(b, sign)) judge_by_quad(&q);
            }
    close_book();
}

static void powers(void)
{
    hard_case("M, tau, s", "all columns at t = 3, |k| = 0.1 to 1e-3; at equal s, max J/min J = 1000, |k| = 0.05",
              "M is multiplied by 1e190, s grows by as much");
    open_book();
    for (double k = 0.1; k > 5e-4; k /= 10)
        for (int sign = -1; sign <= 1; sign += 2) {
            question q = ask(sign * k, bodies[1], 3);
            q.all = true;
            judge_by_quad(&q);
        }
    for (int sign = -1; sign <= 1; sign += 2) {
        question q = ask(sign * 0.05, bodies[2], 1);
        iso_sample s;
        q.all = true;
        if (solve_quad(ISO_BACKEND_BALL, &q, &s) != ISO_OK) s.clock[ISO_CLOCK_S] = NAN;
        q.clock = ISO_CLOCK_S, q.time = s.clock[ISO_CLOCK_S];
        judge_by_quad(&q);
    }
    close_book();
    question q = ask(-1e-3, bodies[1], 3);
    const double factor = pow(1 / dot_diag(q.start.y + 3, q.p.inv_J, q.start.y + 3), 1 / q.p.k);
    hard_naive("q^(2/k) on the way to a ratio of order one", fabs(factor * factor * pow(factor, -2) - 1), ROUNDING);
    q = ask(1e-4, bodies[1], 3);
    q.all = true;
    iso_sample s;
    const iso_status status = solve(&hard_way[0], &q, &s);
    hard_refused(NULL, status == ISO_NUMERICAL && strstr(iso_context_message(ctx), "ask for omega"),
                 iso_context_message(ctx));
}

static void under_effects(void)
{
    hard_case("field, level", "all columns at t = 3, |k| = 0.1 and 0.01; the ball at 1e-4",
              "off H = 0 the powers of (24) do not cancel");
    open_book();
    for (double k = 0.1; k > 5e-5; k *= k > 0.05 ? 0.1 : 0.01)
        for (int sign = -1; sign <= 1; sign += 2)
            for (int id = ISO_FIELD; id <= ISO_LEVEL; id++) {
                question q = ask(sign * k, bodies[1], 3);
                if (id == ISO_LEVEL && k < 5e-3) continue; /* c is no double */
                const double g = dot_diag(q.start.y + 3, q.p.inv_J, q.start.y + 3);
                iso_effects e = {
                    .number = {[ISO_FIELD] = {[0] = 0.3, [11] = 0.1}, [ISO_LEVEL] = {0.1 * pow(g, 1 / q.p.k)}}};
                e.on[id] = true;
                q.effects = &e;
                q.all = k > 5e-4;
                judge_by_quad(&q);
            }
    close_book();
}

static void large(void)
{
    hard_case(
        "|k| = 10 to 1e6", "all columns at t = 10/|k|, over the condition of the orbit",
        "the normal turns |k| times as fast as the ball: Taylor coefficients like |k|^n, M like 1/k, s like k^2 t");
    open_book();
    for (int b = 0; b < BODIES; b++)
        for (double k = 10; k < 2e6; k *= sqrt(1e5))
            for (int sign = -1; sign <= 1; sign += 2) {
                question q = ask(sign * k, bodies[b], 10 / k);
                q.all = true;
                if (is_taken(b, sign)) judge_by_quad(&q);
            }
    close_book();
}

/* n = (cos kWt, -sin kWt, 0), omega = W e3: the same orbit for every k, but for its rate. */
static void rotation(void)
{
    hard_case("rotation", "omega and n after 14 radians, against the closed form, |k| = 1e-3 to 1e6",
              "one motion for every k, in time 14/|k|, while M and the clocks have all powers of q");
    open_book();
    for (double k = 1e-3; k < 2e6; k *= 10)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double angle = 14;
            question q = ask(sign * k, bodies[1], angle / k);
            iso_sample truth = {.ball = {0, 0, 1, cos(angle), -sign * sin(angle), 0}};
            double gamma[3];
            copy((const double[]){0, 0, 1, 1, 0, 0}, q.start.y, ISO_STATE);
            for (int i = 0; i < 3; i++) gamma[i] = truth.ball[3 + i] / q.p.root_J[i];
            make_unit(gamma);
            copy(gamma, truth.point + 3, 3);
            judge(&q, &truth, 14);
        }
    close_book();
}

/* States at k, and the same numbers at k0: neighbours differ by rounding alone. */
static void neighbours(void)
{
    static const double at[] = {0.5, 1, -1}, apart[] = {0, DBL_EPSILON, -DBL_EPSILON / 2, 1e-15, -1e-15};
    hard_case("next to 1/2, 1, -1", "all columns at t = 20 for k (1 +- 1e-15), against those for k",
              "at 1/2 tau is t, at 1 and -1 there are additional integrals, closed solutions, other series");
    open_book();
    for (int i = 0; i < 3; i++) {
        question q = ask(at[i], bodies[1], 20);
        iso_sample truth;
        q.all = true;
        if (solve_quad(ISO_BACKEND_BALL, &q, &truth) != ISO_OK) truth.ball[0] = NAN;
        const double C = condition(&q, &truth);
        for (int j = 0; j < 5; j++) {
            q.p = laws_params(at[i] * (1 + apart[j]), bodies[1]);
            judge(&q, &truth, C);
        }
        q.p = laws_params(at[i] * (1 + DBL_EPSILON), bodies[1]);
        iso_sample s;
        const iso_status status = solve(&hard_way[hard_ways - 1], &q, &s);
        gsl_test(status != ISO_BAD_ARGUMENT || (i > 0 && !strstr(iso_context_message(ctx), "1.0000000000000002 ")),
                 "k = %.17g: %s", q.p.k, status == ISO_OK ? "" : iso_context_message(ctx));
    }
    close_book();
    question q = ask(1, bodies[1], 20), near = ask(1 + 1e-6, bodies[1], 20);
    iso_sample a, b;
    const bool ok =
        solve_quad(ISO_BACKEND_BALL, &q, &a) == ISO_OK && solve_quad(ISO_BACKEND_BALL, &near, &b) == ISO_OK;
    hard_naive("k within 1e-6 of 1 taken as 1", ok ? error_of(&q, &a, &b) : 0, ROUNDING);
}

int main(void)
{
    ctx = iso_context_create();
    hard_topic("1. Geometry numbers");
    small();
    powers();
    under_effects();
    large();
    rotation();
    neighbours();
    iso_context_free(ctx);
    return hard_summary();
}
