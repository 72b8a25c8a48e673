/* Turning points off the zero level, where M and omega are 0, and coordinate planes and umbilics, where sphero-
 * conical coordinates meet: orbits start there and pass there. (The coordinates: model/conical, exact/coordinates.) */
#include "exact_orbits.h"
#include "hard_loss.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;
static const double J_three[3] = {1.4, 2.1, 3.0};

/* --- problems --------------------------------------------------------------------------------------------------- */

/* A start, and where it is at `time` of a clock, in both models. Errors may grow by `growth`. */
typedef struct problem {
    iso_params p;
    iso_start start;
    iso_effects effects; /* of a ball's start */
    iso_clock clock;
    double time, radians, growth, fast[2]; /* largest omega and M on the way, about */
    iso_sample truth;
} problem;

static iso_status solve(const hard_road *way, const problem *b, iso_clock clock, double time, iso_sample *s)
{
    memset(s, 0xff, sizeof *s); /* NaN */
    return hard_solve(ctx, way, &b->p, &b->start, b->start.model == ISO_BALL ? &b->effects : NULL, true, clock, time,
                      s);
}

/* Errors of unit vectors, of omega and M in units of what the potential makes of them, and of clocks. */
static double error_of(const iso_sample *s, const problem *b)
{
    double worst = laws_distance(s->ball, b->truth.ball) / b->fast[0];
    worst = hard_worse(laws_distance(s->point, b->truth.point) / b->fast[1], worst);
    worst = hard_worse(laws_distance(s->ball + 3, b->truth.ball + 3), worst);
    worst = hard_worse(laws_distance(s->point + 3, b->truth.point + 3), worst);
    for (int c = 0; c < ISO_CLOCKS; c++) worst = hard_worse(fabs(s->clock[c] / b->truth.clock[c] - 1), worst);
    return worst;
}

/* To s on the clock, by the point's other backend in 128 bits; the point's potential has eps 1.7. */
static problem make(double k, const double J[3], const double M[3], const double gamma[3], iso_clock clock, double s,
                    bool as_ball)
{
    problem b = {.p = laws_params(k, J), .clock = clock, .growth = 1};
    const hard_road quad = {as_ball ? ISO_BACKEND_POINT : ISO_BACKEND_BALL, iso_method_find("taylor_quad"), 1e-15};
    const double eps = 1.7, depth = eps * pow(dot_diag(gamma, J, gamma), -1 / k);
    const double deep = eps * fmax(pow(max3(J), -1 / k), pow(min3(J), -1 / k));
    double point[ISO_STATE], ball[ISO_STATE];
    copy(M, point, 3), copy(gamma, point + 3, 3);
    make_unit(point + 3);
    iso_point_to_ball(&b.p, point, ball);
    iso_status status = as_ball ? iso_start_ball(ctx, ball, ball + 3, ISO_SPIN_REMOVE, &b.start)
                                : iso_start_point(ctx, M, point + 3, &eps, true, &b.start);
    if (as_ball) {
        b.effects.on[ISO_LEVEL] = true;
        LEVEL_C(&b.effects) = (dot(M, M) / 2 - depth) * k * k / b.p.det_J;
    }
    if (status == ISO_OK) status = solve(&quad, &b, ISO_CLOCK_S, s, &b.truth);
    b.time = b.truth.clock[clock];
    if (status == ISO_OK && clock != ISO_CLOCK_S) status = solve(&quad, &b, clock, b.time, &b.truth);
    if (status != ISO_OK) gsl_test(1, "no reference: %s", iso_context_message(ctx));
    b.fast[0] = sqrt(2 * deep * k * k / b.p.det_J / min3(J));
    b.fast[1] = sqrt(2 * deep);
    b.radians = s * b.fast[1];
    return b;
}

/* Every way on every problem that it is for. */
static void hold_all(const problem b[], int count)
{
    for (int i = 0; i < hard_ways; i++) {
        const hard_road way = hard_finest(&hard_way[i]);
        double worst = 0, bound = 0;
        for (int j = 0; j < count; j++) {
            iso_sample s;
            const double *J = b[j].p.J;
            if (way.backend == ISO_BACKEND_EXACT && b[j].p.k != -1 && J[0] != J[1] && J[1] != J[2]) continue;
            solve(&way, &b[j], b[j].clock, b[j].time, &s); /* NaN where it fails */
            worst = hard_worse(error_of(&s, &b[j]), worst);
            bound = fmax(bound, b[j].growth * b[j].radians * hard_loss(&way));
        }
        hard_hold(&hard_way[i], worst, bound);
    }
}

/* --- at rest ---------------------------------------------------------------------------------------------------- */

static const double gamma_any[3] = {0.36, 0.48, 0.8}, no_M[3] = {0, 0, 0};

/* M/|M| of gamma' = gamma x M, from the level: |M| = sqrt(2 (H - V)); gives the relative error of |M| at s = 1e-8. */
static double speed_of_level(const problem *b)
{
    const hard_road quad = {ISO_BACKEND_POINT, iso_method_find("taylor_quad"), 1e-15};
    iso_sample s;
    solve(&quad, b, ISO_CLOCK_S, 1e-8, &s);
    const double H = -1.7 * pow(dot_diag(gamma_any, b->p.J, gamma_any), -1 / b->p.k);
    const double V = -1.7 * pow(dot_diag(s.point + 3, b->p.J, s.point + 3), -1 / b->p.k);
    return fabs(sqrt(fmax(0, 2 * (H - V))) / norm(s.point) - 1);
}

static void check_rest(void)
{
    enum { MOST = 8 };
    static const double ks[] = {-1, 1, 0.5, -0.4};
    problem b[MOST];
    int count = 0;
    hard_case(
        "from rest", "both models and the clocks against taylor_quad by the other backend, M = 0, omega = 0",
        "the level gives |M| as a difference of nothing; no size to measure a step by; a projection divides by 0");
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) b[count++] = make(-1, J_three, no_M, gamma_any, c, 4, false);
    for (int i = 1; i < 4; i++) b[count++] = make(ks[i], J_three, no_M, gamma_any, (iso_clock)(i - 1), 4, false);
    b[count++] = make(-1, J_three, no_M, gamma_any, ISO_CLOCK_T, 4, true);
    b[count++] = make(0.5, J_three, no_M, gamma_any, ISO_CLOCK_S, 4, true);
    hold_all(b, count);
    hard_naive("|M| from the level H", speed_of_level(&b[0]), 1e-6);
    iso_sample s;
    const hard_road exact = {ISO_BACKEND_EXACT, NULL, 1e-12};
    hard_case("from rest, k = 1", "no answer, and the reason", "off H = 0 the problem of k = 1 does not separate");
    const iso_status status = solve(&exact, &b[3], b[3].clock, b[3].time, &s);
    hard_refused(&exact, status == ISO_BAD_ARGUMENT, iso_context_message(ctx));
}

/* M of this length, along the same direction */
static problem nearly(double k, const double J[3], double length, iso_clock clock)
{
    double M[3] = {0.8, -0.6, 0.35}, gamma[3] = {gamma_any[0], gamma_any[1], gamma_any[2]};
    make_unit(gamma);
    for (int pass = 0; pass < 2; pass++) remove_along(M, gamma);
    scale(M, length / norm(M));
    return make(k, J, M, gamma, clock, 4, false);
}

static void check_nearly(void)
{
    static const double round_J[3] = {2.7, 2.44, 2.44};
    const problem b[] = {
        nearly(-1, J_three, 1e-8, ISO_CLOCK_T),    nearly(-1, J_three, 1e-20, ISO_CLOCK_S),
        nearly(0.5, J_three, 1e-180, ISO_CLOCK_T), nearly(-3, round_J, 1e-8, ISO_CLOCK_S),
        nearly(-3, round_J, 1e-12, ISO_CLOCK_T),   nearly(-3, round_J, 1e-300, ISO_CLOCK_TAU),
    };
    hard_case("nearly at rest", "the same, |M| = 1e-8 to 1e-300, and with two equal moments over the pole",
              "M is less than the rounding of its next value, and is the distance at which gamma passes the pole");
    hold_all(b, 6);
    const double a = 1 - 1e-24; /* what is left of 1 - a, M_x^2/m(a), at |M| = 1e-12 */
    hard_naive("1 - a of the turning point a", fabs((1 - a) / 1e-24 - 1), 1e-6);
}

/* A plane pendulum from rest: every k has the closed solution. */
static void check_pendulum(void)
{
    static const double ks[] = {-1, 1, 0.5, -0.4, 3};
    const hard_road exact = {ISO_BACKEND_EXACT, NULL, 1e-12};
    double worst = 0, bound = 0;
    hard_case("a pendulum from rest", "the closed solution against taylor_quad, all planes, 1e-9 to 1.5 from an axis",
              "the start is a root of the polynomial whose zeros bound the swing");
    for (int i = 0; i < 5; i++)
        for (int axis = 0; axis < 3; axis++)
            for (int j = 0; j < 4; j++) {
                static const double angle[] = {0.5, 1.1, 1e-9, M_PI_2 - 1e-3};
                double gamma[3] = {0};
                iso_sample s;
                gamma[(axis + 1) % 3] = cos(angle[j]), gamma[(axis + 2) % 3] = sin(angle[j]);
                const problem b = make(ks[i], J_three, no_M, gamma, ISO_CLOCK_S, 2, false);
                solve(&exact, &b, b.clock, b.time, &s);
                worst = hard_worse(error_of(&s, &b), worst);
                bound = fmax(bound, 10 * b.radians * hard_loss(&exact)); /* next to the upper rest it grows */
            }
    hard_hold(&exact, worst, bound);
}

/* Zeros stay zeros where there is no force, stable or not. */
static void check_equilibria(void)
{
    hard_case("at rest in equilibrium", "how far it has gone after s = 20", "unstable ones amplify any rounding");
    for (int i = 0; i < hard_ways; i++) {
        double worst = 0;
        for (int axis = 0; axis < 3; axis++)
            for (int j = 0; j < 3; j++) {
                static const double ks[] = {-1, 1, 0.5};
                const double gamma[3] = {axis == 0, axis == 1, axis == 2}, eps = 1.7;
                problem b = {.p = laws_params(ks[j], J_three)};
                iso_sample s;
                if (iso_start_point(ctx, no_M, gamma, &eps, false, &b.start) != ISO_OK) gsl_test(1, "no start");
                solve(&hard_way[i], &b, ISO_CLOCK_S, 20, &s);
                worst = hard_worse(laws_distance(s.point + 3, gamma) + norm(s.point) + norm(s.ball), worst);
            }
        hard_hold(&hard_way[i], worst, 0);
    }
}

/* --- through rest ----------------------------------------------------------------------------------------------- */

/* The state that comes to rest after s, and its way there and back: where it began, M turned round. */
static problem through_rest(double k, double s, iso_clock clock, bool as_ball)
{
    const problem from = make(k, J_three, no_M, gamma_any, ISO_CLOCK_S, s, false);
    const double back[3] = {-from.truth.point[0], -from.truth.point[1], -from.truth.point[2]};
    return make(k, J_three, back, from.truth.point + 3, clock, 2 * s, as_ball);
}

static void check_through(void)
{
    const problem b[] = {
        through_rest(-1, 3, ISO_CLOCK_S, false),
        through_rest(1, 3, ISO_CLOCK_T, false),
        through_rest(0.5, 3, ISO_CLOCK_TAU, false),
        through_rest(-0.4, 3, ISO_CLOCK_T, true),
    };
    hard_case("through rest", "the same; the orbit comes to rest half way and turns back",
              "M passes through 0, its direction with it, and the level says nothing of it");
    hold_all(b, 4);
    double there_and_back = 0; /* what time reversal says */
    for (int i = 0; i < 4; i++) {
        const double *M = b[i].start.model == ISO_POINT ? b[i].start.y : NULL;
        for (int j = 0; M && j < 3; j++)
            there_and_back = hard_worse(fabs(b[i].truth.point[j] + M[j]) / b[i].fast[1], there_and_back);
    }
    hard_hold(NULL, there_and_back, 1e-13);
}

/* --- an umbilic -------------------------------------------------------------------------------------------------- */

/* On its way through an umbilic, s later: the state from which it comes there. */
static problem through_umbilic(double k, double s, const double M[3])
{
    const iso_params p = laws_params(k, J_three);
    const double *b = k == 1 ? p.inv_J : p.J, x = sqrt((b[1] - b[0]) / (b[2] - b[0]));
    const double gamma[3] = {x, 0, sqrt((b[2] - b[1]) / (b[2] - b[0]))};
    problem from = {.p = p, .fast = {1, 1}};
    const hard_road quad = {ISO_BACKEND_POINT, iso_method_find("taylor_quad"), 1e-15};
    if (iso_start_point(ctx, M, gamma, NULL, true, &from.start) != ISO_OK ||
        solve(&quad, &from, ISO_CLOCK_S, -s, &from.truth) != ISO_OK)
        gsl_test(1, "no orbit through an umbilic: %s", iso_context_message(ctx));
    problem to = from;
    to.clock = ISO_CLOCK_T;
    if (iso_start_point(ctx, from.truth.point, from.truth.point + 3, NULL, true, &to.start) != ISO_OK ||
        solve(&quad, &to, ISO_CLOCK_S, 2 * s, &to.truth) != ISO_OK)
        gsl_test(1, "no orbit through an umbilic: %s", iso_context_message(ctx));
    to.time = to.truth.clock[ISO_CLOCK_T];
    to.fast[0] = norm(to.truth.ball), to.fast[1] = norm(to.truth.point);
    to.radians = 4 * s * norm(M);
    to.growth = 30; /* on the separatrix: exp(0.59) each half turn of a turn or two */
    return to;
}

static void check_umbilic(void)
{
    const problem b[] = {through_umbilic(-1, 2, (const double[]){0.5, 1.0, -0.2}),
                         through_umbilic(1, 3, (const double[]){0.2, -0.8, 0.1}),
                         through_umbilic(-1, 1.5, (const double[]){0, 1.3, 0})};
    hard_case("through an umbilic", "both models and the clocks against taylor_quad",
              "the coordinates meet, their momenta vanish; every such orbit is on the separatrix");
    hold_all(b, 3);
}

int main(void)
{
    hard_topic("4. Turning points and coordinates");
    ctx = iso_context_create();
    check_rest();
    check_nearly();
    check_pendulum();
    check_equilibria();
    check_through();
    check_umbilic();
    iso_context_free(ctx);
    return hard_summary();
}
