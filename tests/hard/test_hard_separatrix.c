/* Planes, axes and separatrices: what is in a principal plane stays there, what leaves an unstable rotation does so
 * at the rate of theory, and orbits next to the separatrix are found on the right side of it. */
#include <gsl/gsl_sf_ellint.h>

#include "exact_orbits.h"
#include "hard_loss.h"

typedef long double real;

static iso_context *ctx;
static const double J_three[3] = {1.4, 2.1, 3.0}, W = 1.3;

/* --- theory: the rotation about an axis, linearised ------------------------------------------------------------- */

/* gamma = (cos phi, sin phi, y) with the axis last, phi' = |M|, M^2 = 2 eps q^(-1/k): the component of
 * gamma'' = -M^2 gamma - dV + (gamma,dV) gamma across the plane is, with q = J1 cos^2 + J2 sin^2, J the axis' moment,
 *
 *     d^2y/dphi^2 - (q_phi/(2 k q)) dy/dphi + [1 + (J/q - 1)/k] y = 0,
 *
 * Hill's equation of period pi. Its solutions with y(0) = 1, y' = 0 and the other way round, after half a turn, are
 * the columns of m; det m = 1, and q is even: m[0][0] = m[1][1] = cosh(exponent), up to a sign. */
static void half_turn(double k, const double J[3], real m[2][2])
{
    enum { STEPS = 6000 };
    static const real part[4] = {0, 0.5L, 0.5L, 1}, weight[4] = {1 / 6.0L, 1 / 3.0L, 1 / 3.0L, 1 / 6.0L};
    const real h = acosl(-1) / STEPS;
    for (int column = 0; column < 2; column++) {
        real y[2] = {column == 0, column == 1};
        for (int i = 0; i < STEPS; i++) {
            real sum[2] = {0}, f[2] = {0};
            for (int stage = 0; stage < 4; stage++) {
                const real phi = (i + part[stage]) * h, c = cosl(phi), s = sinl(phi);
                const real at = y[0] + part[stage] * h * f[0], rate = y[1] + part[stage] * h * f[1];
                const real q = J[0] * c * c + J[1] * s * s, slope = 2 * (J[1] - J[0]) * s * c;
                f[0] = rate;
                f[1] = slope / (2 * k * q) * rate - (1 + (J[2] / q - 1) / k) * at;
                for (int j = 0; j < 2; j++) sum[j] += weight[stage] * f[j];
            }
            for (int j = 0; j < 2; j++) y[j] += h * sum[j];
        }
        for (int j = 0; j < 2; j++) m[j][column] = y[j];
    }
}

/* A rotation about an axis of J_three; 0: stable. */
typedef struct rotation {
    double k;
    iso_params p;
    int axis, in[2];  /* the axis, and those of its plane: right-handed, the axis last       */
    double exponent;  /* ln of what y grows by in half a turn                                */
    double direction; /* dy/dphi = direction y of what grows, where gamma is along in[0]     */
    double turn;      /* t of half a turn: n turns at |k| W                                  */
} rotation;

static rotation find_rotation(double k, int axis)
{
    rotation r = {.k = k, .p = laws_params(k, J_three), .axis = axis, .in = {(axis + 1) % 3, (axis + 2) % 3}};
    real m[2][2];
    half_turn(k, (const double[]){J_three[r.in[0]], J_three[r.in[1]], J_three[axis]}, m);
    const real c = fabsl(m[0][0]);
    r.exponent = c > 1 ? (double)acoshl(c) : 0;
    r.direction = c > 1 ? (double)(copysignl(sqrtl(c * c - 1), m[0][0]) / m[0][1]) : 0;
    r.turn = M_PI / (fabs(k) * W);
    return r;
}

/* Found once. */
static rotation rotation_about(double k, int axis)
{
    static rotation known[16];
    static int count;
    for (int i = 0; i < count; i++)
        if (known[i].k == k && known[i].axis == axis) return known[i];
    if (count < 16) return known[count++] = find_rotation(k, axis);
    return find_rotation(k, axis);
}

/* The ball that turns about the axis, y0 beside the plane where it grows by `exponent`. */
static iso_start beside(const rotation *r, double y0)
{
    double point[ISO_STATE] = {0}, ball[ISO_STATE];
    iso_start start;
    point[3 + r->in[0]] = 1, point[3 + r->axis] = y0;
    point[r->in[0]] = y0, point[r->in[1]] = r->direction * y0, point[r->axis] = -1; /* gamma' x gamma */
    iso_point_to_ball(&r->p, point, ball);
    scale(ball, W / fabs(ball[r->axis]));
    if (iso_start_ball(ctx, ball, ball + 3, ISO_SPIN_REFUSE, &start) != ISO_OK)
        gsl_test(1, "a start is refused: %s", iso_context_message(ctx));
    return start;
}

static iso_sample solve(const hard_road *way, const rotation *r, const iso_start *start, double t)
{
    iso_sample s;
    memset(&s, 0xff, sizeof s); /* NaN */
    if (hard_solve(ctx, way, &r->p, start, NULL, true, ISO_CLOCK_T, t, &s) != ISO_OK) memset(&s, 0xff, sizeof s);
    return s;
}

/* --- the exponent ----------------------------------------------------------------------------------------------- */

/* k = -1, J1 < J2 < J3, the axis that of J2: with phi = am(sigma|m), m = 1 - J1/J3, it is Lame's equation
 * y'' = (2 m sn^2 - 2 + J2/J3) y, whose solutions grow by exp(2K Z(alpha)) in half a turn, sn^2 alpha =
 * (J2 - J1)/(J3 - J1), Z Jacobi's zeta function. */
static double zeta_exponent(const double J[3])
{
    const double modulus = sqrt(1 - J[0] / J[2]), alpha = asin(sqrt((J[1] - J[0]) / (J[2] - J[0])));
    const double K = gsl_sf_ellint_Kcomp(modulus, GSL_PREC_DOUBLE), E = gsl_sf_ellint_Ecomp(modulus, GSL_PREC_DOUBLE);
    return 2 * (K * gsl_sf_ellint_E(alpha, modulus, GSL_PREC_DOUBLE) -
                E * gsl_sf_ellint_F(alpha, modulus, GSL_PREC_DOUBLE));
}

static void check_exponent(void)
{
    static const double J[][3] = {{1.4, 2.1, 3.0}, {1, 1.01, 1.02}, {1, 1.001, 9}, {1, 8.9, 9}, {1, 3, 10}};
    double worst = 0;
    hard_case("Lyapunov exponent", "Hill's equation against Jacobi's zeta function, k = -1",
              "the rate at which orbits leave is that of a periodic equation, no mean of the Jacobian's eigenvalues");
    for (int i = 0; i < 5; i++) {
        real m[2][2];
        half_turn(-1, (const double[]){J[i][2], J[i][0], J[i][1]}, m);
        worst = hard_worse(fabs((double)acoshl(fabsl(m[0][0])) / zeta_exponent(J[i]) - 1), worst);
    }
    hard_hold(NULL, worst, 1e-11);
    const rotation r = rotation_about(-1, 1); /* frozen: w' = J^-1 (J w x w), Euler's top */
    const double J2 = J_three[1], euler = sqrt((J2 - J_three[0]) * (J_three[2] - J2) / (J_three[0] * J_three[2]));
    hard_naive("the rate of Euler's free top", fabs(euler * W * r.turn / r.exponent - 1), 1e-9);
}

/* --- in the plane ----------------------------------------------------------------------------------------------- */

/* Largest of the numbers that are 0 in the plane. */
static double off_plane(const rotation *r, const iso_sample *s)
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        const double zero[2] = {i == r->axis ? s->ball[3 + i] : s->ball[i],
                                i == r->axis ? s->point[3 + i] : s->point[i]};
        for (int j = 0; j < 2; j++)
            if (!(fabs(zero[j]) <= most)) most = fabs(zero[j]);
    }
    return most;
}

static const double some_k[] = {-1, 0.5, 1};

static void check_plane(void)
{
    hard_case("in a principal plane",
              "numbers that are 0 there, when rounding errors would have grown to order one; then the error of n",
              "the rotation about the middle axis is unstable: a unit in the last place grows by exp(38)");
    const int geometries = tests_length(2, 3);
    for (int i = 0; i < hard_ways; i++) {
        double most = 0, phase = 0, radians = 0;
        for (int j = 0; j < geometries; j++)
            for (int axis = 0; axis < 3; axis++) {
                const rotation r = rotation_about(some_k[j], axis);
                const int turns = axis == 1 ? (int)(38 / r.exponent) + 1 : 5;
                const iso_start start = beside(&r, 0);
                const iso_sample s = solve(&hard_way[i], &r, &start, turns * r.turn);
                const double aside = fabs(s.ball[3 + r.in[1]]) + fabs(fabs(s.ball[3 + r.in[0]]) - 1);
                most = hard_worse(off_plane(&r, &s), most), radians = fmax(radians, M_PI * turns);
                phase = hard_worse(aside, phase);
            }
        hard_hold(&hard_way[i], most, 0);
        hard_hold(&hard_way[i], phase, hard_loss(&hard_way[i]) * radians * radians);
    }
    double most = 0, square[3]; /* leaves at the time when 1e-8 has grown to order one */
    for (double angle = 0.1; angle < 1.5; angle += 0.1) {
        hard_naive_squares(J_three, (const double[3]){cos(angle), 0, sin(angle)}, square);
        most = fmax(most, sqrt(fabs(square[1])));
    }
    hard_naive("n from z1, z2 by (13)", most, 1e-12);
}

/* --- leaving it ------------------------------------------------------------------------------------------------- */

/* By how much y has grown otherwise than by theory, in the logarithm, over that: the relative error of the rate. */
static double rate_error(const rotation *r, double y0, int turns, double y)
{
    return fabs(log(fabs(y / y0)) / (turns * r->exponent) - 1);
}

static void check_escape(void)
{
    static const double ks[] = {1, -1, -0.4};
    hard_case("leaving an unstable rotation",
              "the rate at which 1e-15 grows to 1e-7, relative to the Lyapunov exponent",
              "it is the last digit of the state; an error of a step of that size is the orbit");
    for (int i = 0; i < hard_ways; i++) {
        double worst = 0, bound = 0;
        const hard_road way = hard_finest(&hard_way[i]);
        for (int j = 0; j < 3; j++) {
            if (way.backend == ISO_BACKEND_EXACT && fabs(ks[j]) != 1) continue; /* it has no such orbit off a plane */
            const rotation r = rotation_about(ks[j], 1);
            const int turns = (int)(log(1e8) / r.exponent);
            const iso_start start = beside(&r, 1e-15);
            const iso_sample s = solve(&way, &r, &start, turns * r.turn);
            worst = hard_worse(rate_error(&r, 1e-15, turns, s.point[3 + r.axis]), worst);
            bound = fmax(bound, hard_loss(&way) * M_PI / r.exponent);
        }
        hard_hold(&hard_way[i], worst, bound);
    }
    iso_sample s;
    const hard_road exact = {ISO_BACKEND_EXACT, NULL, 1e-12};
    const rotation other = rotation_about(-0.4, 1);
    const iso_start from = beside(&other, 1e-15);
    hard_case("leaving it, k = -0.4", "no answer, and the reason", "there is no second integral");
    const iso_status status = hard_solve(ctx, &exact, &other.p, &from, NULL, true, ISO_CLOCK_T, 1, &s);
    hard_refused(&exact, status == ISO_BAD_ARGUMENT, iso_context_message(ctx));
}

/* At loose tolerances the rotation's own series takes steps of a radian or three. */
static void check_loose(void)
{
    static const double ks[] = {1, -1, 0.5, 2.5};
    const double tolerance = 1e-6, y0 = 1e-100;
    hard_case(
        "steps beside a rotation", "the rate at which 1e-100 grows, taylor at 1e-6",
        "the rotation is an entire function of t, what leaves it has poles: no step that is short for the one is "
        "short for the other");
    for (int i = 0; i < hard_ways; i++) {
        hard_road way = hard_way[i];
        double worst = 0;
        if (!hard_is(&way, "taylor")) continue;
        way.tolerance = tolerance;
        for (int j = 0; j < 4; j++) {
            const rotation r = rotation_about(ks[j], 1);
            const iso_start start = beside(&r, y0);
            const iso_sample s = solve(&way, &r, &start, 60 * r.turn);
            worst = hard_worse(rate_error(&r, y0, 60, s.point[3 + r.axis]), worst);
        }
        hard_hold(&hard_way[i], worst, 10 * pow(tolerance, 0.75) * M_PI / 0.24); /* up to 10 steps a radian */
    }
}

/* --- next to the separatrix ------------------------------------------------------------------------------------- */

/* An orbit of this relative distance, k = 1 and -1 in turn, and its reference; errors grow no faster than
 * exp(exponent) each half turn about the axis, where it stays longest. */
typedef struct near_orbit {
    orbit o;
    iso_start start;
    double s, growth, radians;
    iso_sample truth;
} near_orbit;

static near_orbit next_to(double distance, int i, iso_random *random)
{
    near_orbit n = {.growth = 1};
    double g[3];
    do {
        iso_random_direction(random, g);
        n.o = (orbit){.ctx = ctx, .model.system = &iso_system_point};
    } while (!exact_next_to(&n.o, i % 2 ? 1 : -1, J_three, g, distance * (i / 2 % 2 ? 1 : -1), 1));
    const double eps = 1;
    const rotation r = rotation_about(n.o.model.problem.p.k, 1);
    const hard_road quad = {ISO_BACKEND_POINT, iso_method_find("taylor_quad"), 1e-15};
    const double root = sqrt(2 * eps), fast = n.o.model.problem.p.k == 1 ? root / sqrt(1.4) : root * sqrt(3.0);
    n.growth = 1000, n.radians = log(n.growth) / r.exponent * M_PI;
    n.s = n.radians / fast; /* at most so many radians */
    if (iso_start_point(ctx, n.o.y0, n.o.y0 + 3, &eps, true, &n.start) != ISO_OK ||
        hard_solve(ctx, &quad, &n.o.model.problem.p, &n.start, NULL, true, ISO_CLOCK_S, n.s, &n.truth) != ISO_OK)
        gsl_test(1, "no orbit next to the separatrix: %s", iso_context_message(ctx));
    return n;
}

static void check_next_to(void)
{
    enum { ORBITS = 6 };
    static const double distance[ORBITS] = {1e-2, 1e-5, 1e-8, 1e-11, 1e-14, 1e-15};
    near_orbit n[ORBITS];
    iso_random *random = iso_random_create(3);
    hard_case("next to the separatrix", "(M, gamma) against taylor_quad, at 1e-2 to 1e-15 of it",
              "the orbit comes to the unstable rotation and leaves it again; the closed solution's period goes to "
              "infinity");
    for (int i = 0; i < ORBITS; i++) n[i] = next_to(distance[i], i, random);
    for (int i = 0; i < hard_ways; i++) {
        const hard_road way = hard_finest(&hard_way[i]);
        double worst = 0, bound = 0;
        for (int j = 0; j < ORBITS; j++) {
            iso_sample s;
            const iso_status status =
                hard_solve(ctx, &way, &n[j].o.model.problem.p, &n[j].start, NULL, true, ISO_CLOCK_S, n[j].s, &s);
            worst = hard_worse(status == ISO_OK ? hard_error(s.point, n[j].truth.point) : NAN, worst);
            bound = fmax(bound, n[j].growth * hard_loss(&way) * M_PI / rotation_about(-1, 1).exponent);
        }
        hard_hold(&hard_way[i], worst, fmin(bound, 1));
    }
    iso_random_free(random);
}

/* From an umbilic every orbit is on the separatrix: it goes to the rotation, and in the end is that to all digits.
 * Here is one in binary: b2 - b1 = b3 - b2, gamma1 = gamma3. */
static void check_on(void)
{
    const hard_road exact = {ISO_BACKEND_EXACT, NULL, 1e-12},
                    steps = {ISO_BACKEND_POINT, iso_method_find("rk8pd"), 1e-12};
    const double J[2][3] = {{1, 2, 3}, {6, 3, 2}}, M[3] = {0.3, -0.8, -0.3}, gamma[3] = {M_SQRT1_2, 0, M_SQRT1_2};
    double worst = 0, naive = 0;
    hard_case("on the separatrix", "omega and n across the plane at t = 1e6, relative to the rotation",
              "it comes to the unstable rotation, which no steps stay at");
    for (int i = 0; i < 2; i++) {
        const iso_params p = laws_params(i ? 1 : -1, J[i]);
        iso_start start;
        iso_sample s;
        if (iso_start_point(ctx, M, gamma, NULL, false, &start) != ISO_OK) gsl_test(1, "no start");
        iso_status status = hard_solve(ctx, &exact, &p, &start, NULL, true, ISO_CLOCK_T, 1e6, &s);
        const double q = dot_diag(gamma, p.J, gamma),
                     h = dot(M, M) / 2 * pow(q, 1 / p.k) / p.det_J; /* eps k^2/det J */
        const double w = sqrt(2 * h / p.J[1]);
        worst = hard_worse(status == ISO_OK ? fabs(fabs(s.ball[1]) / w - 1) + fabs(s.ball[4]) : NAN, worst);
        for (int j = 1; j <= 40; j += 3) {
            status = hard_solve(ctx, &steps, &p, &start, NULL, true, ISO_CLOCK_T, (40 + 10 * j) / w, &s);
            naive = hard_worse(status == ISO_OK ? fabs(s.ball[4]) : NAN, naive);
        }
    }
    hard_hold(&exact, worst, 2e-15);
    hard_naive("by steps", naive, 1e-3);
}

int main(void)
{
    hard_topic("3. Planes, axes, separatrices");
    ctx = iso_context_create();
    check_exponent();
    check_plane();
    check_escape();
    check_loose();
    check_next_to();
    check_on();
    iso_context_free(ctx);
    return hard_summary();
}
