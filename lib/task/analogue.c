/* analogue.c - from a problem of a point on a sphere to a ball that realises it (see analogue.h). */
#include "task/analogue.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/math_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

/* The largest ratio of moments of a free ball with J = 2 E - c. The least moment is a difference, and loses as
 * many digits as the ratio has. */
#define MOST_SPREAD 1e8

/* --- the problem ------------------------------------------------------------------------------------------------ */

static double potential(const iso_analogue_problem *p, const double gamma[3])
{
    if (p->neumann) return dot_diag(gamma, p->c, gamma) / 2;
    return -p->eps * pow(dot_diag(gamma, p->J, gamma), -1 / p->k);
}

static iso_status check_numbers(iso_context *ctx, const iso_analogue_problem *p)
{
    iso_params params;
    if (!isfinite(p->energy))
        return ISO_FAIL_INPUT(ctx, "energy", "energy %s: it must be finite", ISO_SHORT(p->energy));
    for (int i = 0; p->neumann && i < 3; i++)
        if (!isfinite(p->c[i]))
            return ISO_FAIL_INPUT(ctx, "c", "c%d = %s: it must be finite", i + 1, ISO_SHORT(p->c[i]));
    if (p->neumann) return ISO_OK;
    if (!isfinite(p->eps))
        return ISO_FAIL_INPUT(ctx, "eps", "eps = %s: the coupling must be finite", ISO_SHORT(p->eps));
    return iso_params_reduced(ctx, p->k, p->J, &params);
}

static bool is_constant(const iso_analogue_problem *p)
{
    const double *x = p->neumann ? p->c : p->J;
    return (x[0] == x[1] && x[1] == x[2]) || (!p->neumann && p->eps == 0);
}

/* Two energies that differ by less are equal up to rounding. */
static double rounding(const iso_analogue *a)
{
    return 4 * DBL_EPSILON * fmax(fabs(a->problem.energy), fmax(fabs(a->lowest), fabs(a->highest)));
}

/* Refuses an energy that no motion has. At the least V, up to rounding, the point rests at the bottom: that is
 * allowed. */
static iso_status check_energy(iso_context *ctx, const iso_analogue *a)
{
    const double E = a->problem.energy;
    const bool fits = isfinite(a->lowest) && isfinite(a->highest) &&
                      (a->problem.neumann || a->problem.eps == 0 || (isnormal(a->lowest) && isnormal(a->highest)));
    if (!fits)
        return iso_context_fail(ctx, ISO_NUMERICAL, "k",
                                "V leaves the range of doubles on the sphere: k is too small, or J too far from 1");
    if (is_constant(&a->problem) && E - a->lowest <= rounding(a))
        return iso_context_fail(ctx, ISO_NOT_MAPPED, "energy",
                                "V = %.10g is constant, so at the energy %.10g %s: a ball at rest has no twin",
                                a->lowest, E,
                                E < a->lowest ? "there is no motion" : "the point rests wherever it is");
    if (E - a->lowest >= -rounding(a)) return ISO_OK;
    if (E == 0 && !a->problem.neumann)
        return iso_context_fail(ctx, ISO_NOT_MAPPED, "energy",
                                "no motion has the energy 0: eps = %.10g is negative, and so is h = eps k^2/det J of "
                                "a free ball. V is at least %.10g, from that energy on there is a ball",
                                a->problem.eps, a->lowest);
    return iso_context_fail(ctx, ISO_NOT_MAPPED, "energy",
                            "no motion has the energy %.10g: V is between %.10g and %.10g on the sphere", E,
                            a->lowest, a->highest);
}

/* --- the reduced ball ------------------------------------------------------------------------------------------- */

/* J1 + J2 - J3 with J sorted. It is positive if there is a body. */
static double triangle_room(const double J[3])
{
    const double least = min3(J), most = max3(J), middle = fmax(fmin(J[0], J[1]), fmin(fmax(J[0], J[1]), J[2]));
    return least - (most - middle);
}

static iso_status make_ball(iso_context *ctx, double k, const double J[3], double eps, double level_energy,
                            iso_analogue_ball *ball)
{
    ISO_TRY(iso_params_reduced(ctx, k, J, &ball->params));
    ball->eps = eps;
    ball->h = iso_energy(&ball->params, eps);
    ball->level = iso_energy(&ball->params, level_energy);
    const bool fits = isnormal(ball->params.det_J) && isfinite(eps) && isfinite(ball->h) && isfinite(ball->level) &&
                      (eps == 0) == (ball->h == 0) && (level_energy == 0) == (ball->level == 0);
    if (fits) return ISO_OK;
    return ISO_FAIL_NUMERICAL(ctx,
                              "the ball of k = %s, J = %s %s %s, eps = %s, E = %s has an h or c that does not fit a "
                              "double: use other units",
                              ISO_SHORT(k), ISO_SHORT(J[0]), ISO_SHORT(J[1]), ISO_SHORT(J[2]), ISO_SHORT(eps),
                              ISO_SHORT(level_energy));
}

/* k = -1: J = d - c, eps = 1/2, on the level E - d/2. A stated eps > 0 is kept: then J is in other units. */
static iso_status make_shifted(iso_context *ctx, iso_analogue *a, const double c[3], double d, double level_energy)
{
    const iso_analogue_problem *p = &a->problem;
    const double unit = !p->neumann && p->eps > 0 ? 2 * p->eps : 1;
    double J[3];
    for (int i = 0; i < 3; i++) J[i] = p->neumann || p->eps < 0 ? d - c[i] : p->J[i] + d / unit;
    a->shift = d / 2;
    return make_ball(ctx, -1, J, unit / 2, level_energy, &a->reduced);
}

/* V is a constant: takes the stated moments if they are equal, else moments that make the ball of order one. */
static iso_status make_constant(iso_context *ctx, iso_analogue *a)
{
    const iso_analogue_problem *p = &a->problem;
    const double k = p->neumann ? -1 : p->k, over = p->energy - a->lowest;
    const double size = p->neumann ? 2 * over : cbrt(p->J[0]) * cbrt(p->J[1]) * cbrt(p->J[2]);
    const bool stated = !p->neumann && p->J[0] == p->J[1] && p->J[1] == p->J[2];
    const double one = stated ? p->J[0] : size, J[3] = {one, one, one};
    a->choice = ISO_ANALOGUE_CONSTANT;
    a->shift = p->energy;
    return make_ball(ctx, k, J, over * pow(one, 1 / k), 0, &a->reduced);
}

/* The free ball, where there is one; else the stated ball, or one that has a body, in the potential of a level. */
static iso_status make_reduced(iso_context *ctx, iso_analogue *a)
{
    const iso_analogue_problem *p = &a->problem;
    const bool shell = p->neumann || p->k == -1;
    double c[3], free[3]; /* c of V = (1/2) sum c_i gamma_i^2 = -eps (gamma, J gamma); J = 2 E - c */
    if (is_constant(p)) return make_constant(ctx, a);
    for (int i = 0; i < 3; i++) {
        c[i] = p->neumann ? p->c[i] : -2 * p->eps * p->J[i];
        free[i] = 2 * p->energy - c[i];
    }
    if (p->level && shell) {
        snprintf(a->not_free, sizeof a->not_free, "a ball in the potential of a level was asked for");
    } else if (!shell && p->energy != 0) {
        snprintf(a->not_free, sizeof a->not_free,
                 "no free ball: for k = %.10g a free ball has E = 0; only for k = -1 can J take up another energy",
                 p->k);
    } else if (p->neumann || p->energy != 0) {
        a->choice = ISO_ANALOGUE_FREE;
        if (min3(free) > 0 && min3(free) * MOST_SPREAD >= max3(free))
            return make_shifted(ctx, a, c, 2 * p->energy, 0);
        snprintf(a->not_free, sizeof a->not_free,
                 "no free ball: 2 E - c = %.6g %.6g %.6g must be positive (and within a factor %s of each other)",
                 free[0], free[1], free[2], ISO_SHORT(MOST_SPREAD));
    }
    a->choice = ISO_ANALOGUE_STATED;
    if (!p->neumann && !(shell && triangle_room(p->J) <= 0))
        return make_ball(ctx, p->k, p->J, p->eps, p->energy, &a->reduced);
    const double d = max3(c) + 2 * (max3(c) - min3(c));
    a->choice = ISO_ANALOGUE_SHIFTED;
    return make_shifted(ctx, a, c, d, p->energy - d / 2);
}

/* --- units ------------------------------------------------------------------------------------------------------ */

/* A problem of a point fixes the ball's J up to a scale s (analogue.h). The angular velocity goes as
 * s^((1/k - 4)/2). With D = m B^2 in the middle of its range, s is 2 D/(J1 + J2 - J3). So there is one D for which
 * the angular velocity is 1. Mass and radius are round numbers with a product m B^2 near this D. */

/* Of the numbers ..., 0.5, 1, 2, 5, 10, ...: the nearest to x > 0, by ratio; or the first that is not less. */
static double round_number(double x, bool up)
{
    static const int digits[] = {1, 2, 5, 10};
    double found = NAN, y;
    x = fmin(fmax(x, 1e-300), 1e300);
    for (int i = 0; i < 4; i++) {
        char text[ISO_NUMBER_SIZE];
        const int length = snprintf(text, sizeof text, "%de%d", digits[i], (int)floor(log10(x)));
        if (!iso_number_read(text, (size_t)length, &y)) continue;
        if (up && y >= x) return y;
        if (!(fabs(log(y / x)) >= fabs(log(found / x)))) found = y;
    }
    return found;
}

double iso_analogue_round_up(double x)
{
    ISO_DEFAULT_ARITHMETIC;
    return x > 1e-300 && x < 1e300 ? round_number(x, true) : x;
}

/* Chooses what is NAN of mass and radius. For k near 1/4 the angular velocity hardly depends on D: then, and where the
 * ball is at rest, D is 1. */
static void choose_units(const iso_analogue *a, double *mass, double *radius)
{
    double start[ISO_STATE], ball[ISO_STATE], D = 1, best = INFINITY;
    const double power = (1 / a->reduced.params.k - 4) / 2, m = *mass, B = *radius;
    iso_analogue_start(a, start);
    iso_point_to_ball(&a->reduced.params, start, ball);
    const double w = norm(ball);
    if (w > 0 && isfinite(w) && fabs(power) > 0.25) D = fmin(fmax(a->room / 2 * pow(w, -1 / power), 1e-9), 1e9);
    if (!isnan(B) && isnan(m)) *mass = round_number(D / B / B, false);
    if (isnan(B) && !isnan(m)) *radius = round_number(sqrt(D / m), false);
    for (int i = -1; i <= 1 && isnan(B) && isnan(m); i++) { /* one of three radii near the cube root of D */
        const double b = round_number(round_number(cbrt(D), false) * pow(2.2, i), false);
        const double one = round_number(D / (b * b), false), off = fabs(log(one * b * b / D));
        if (off < best) best = off, *mass = one, *radius = b;
    }
}

/* --- the body --------------------------------------------------------------------------------------------------- */

/* The body of mass and radius (NAN: chosen) with D = m B^2 in the middle of (0, s room]. */
static void make_body(iso_context *ctx, double mass, double radius, iso_analogue *a)
{
    const iso_analogue_ball *r = &a->reduced;
    iso_params params;
    a->room = triangle_room(r->params.J);
    if (!(a->room > 0)) {
        snprintf(a->no_body, sizeof a->no_body,
                 "triangle inequality: J1 + J2 - J3 = %.6g is not positive (J sorted), so that I = J - D breaks I3 "
                 "<= I1 + I2 for every D = m B^2 > 0",
                 a->room);
        return;
    }
    choose_units(a, &mass, &radius);
    iso_body body = {.mass = mass, .radius = radius}; /* on the surface with A/(A+B), 1, A/(A-B) or -A/(B-A) = k */
    const double k = r->params.k, D = mass * radius * radius, level_energy = iso_coupling(&r->params, r->level);
    a->scale = 2 * (D / a->room);
    for (int i = 0; i < 3; i++) body.inertia[i] = D * (2 * (r->params.J[i] / a->room) - 1);
    body.surface = k == 1 ? ISO_PLANE : k > 1 ? ISO_INSIDE : k > 0 ? ISO_OUTSIDE : ISO_SHELL;
    body.surface_radius = k == 1 ? 0 : k > 1 || k < 0 ? radius * (k / (k - 1)) : radius * (k / (1 - k));
    iso_status status = iso_params_physical(ctx, &body, &params);
    if (status == ISO_OK)
        status = make_ball(ctx, params.k, params.J, r->eps * pow(a->scale, 1 / k), level_energy, &a->body);
    a->has_body = status == ISO_OK;
    if (a->has_body)
        a->body.params = params;
    else
        snprintf(a->no_body, sizeof a->no_body, "%s", iso_context_message(ctx));
}

iso_status iso_analogue_find(iso_context *ctx, const iso_analogue_problem *problem, double mass, double radius,
                             iso_analogue *a)
{
    ISO_DEFAULT_ARITHMETIC;
    memset(a, 0, sizeof *a);
    a->problem = *problem;
    ISO_TRY(check_numbers(ctx, problem));
    a->lowest = INFINITY;
    a->highest = -INFINITY;
    for (int i = 0; i < 3; i++) { /* V is monotonic in one quadratic form: its extremes are on axes */
        const double axis[3] = {i == 0, i == 1, i == 2}, V = potential(problem, axis) + 0.0; /* no -0 */
        if (V < a->lowest) a->lowest = V, a->bottom = i;
        a->highest = fmax(a->highest, V);
    }
    ISO_TRY(check_energy(ctx, a));
    ISO_TRY(make_reduced(ctx, a));
    if (a->reduced.level == 0) a->not_free[0] = '\0';
    make_body(ctx, mass, radius, a);
    return ISO_OK;
}

/* --- starts and scenes ------------------------------------------------------------------------------------------ */

/* Begins in a direction off all planes of symmetry, and goes halfway to the bottom again and again, until half of the
 * energy above the bottom is motion. */
double iso_analogue_start(const iso_analogue *a, double point[ISO_STATE])
{
    static const double off[3] = {0.48, 0.6, 0.64}, along[3] = {0.6, -0.48, 0.64};
    const iso_analogue_problem *p = &a->problem;
    const double over = p->energy - a->lowest, most = fmax(p->energy, a->highest) - a->lowest;
    double *M = point, *gamma = point + 3;
    copy(off, gamma, 3);
    for (int i = 0; i < 30 && potential(p, gamma) - a->lowest > over / 2; i++) {
        gamma[a->bottom] += 1;
        make_unit(gamma);
    }
    if (over <= rounding(a)) /* at rest at the bottom */
        for (int i = 0; i < 3; i++) gamma[i] = i == a->bottom;
    copy(along, M, 3);
    remove_along(M, gamma);
    make_unit(M);
    remove_along(M, gamma); /* the first time left a rounding error */
    scale(M, sqrt(2 * fmax(p->energy - potential(p, gamma), 0)));
    return 20 * ISO_PI / sqrt(2 * most);
}

/* Maps the point to the ball by (18), in own units: there its powers are of order one. */
static iso_status start_ball(iso_context *ctx, const iso_params *p, const double point[ISO_STATE], iso_start *start)
{
    iso_units units;
    double y[ISO_STATE];
    iso_units_choose(p, 0, &units);
    const double unit_M = iso_unit(&units, iso_system_point.fast_dimension);
    copy(point, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= unit_M;
    iso_point_to_ball(&units.own, y, y);
    for (int i = 0; i < 3; i++) y[i] *= units.w;
    if (isfinite(largest(y)) && isfinite(largest(y + 3)))
        return iso_start_ball(ctx, y, y + 3, ISO_SPIN_REMOVE, start);
    return iso_context_fail(ctx, ISO_NUMERICAL, "angular_velocity",
                            "the ball's angular velocity does not fit a double: use other units, or a larger |k|");
}

iso_status iso_analogue_scene(iso_context *ctx, const iso_analogue_ball *ball, const double point[ISO_STATE],
                              double s_end, iso_scene *scene)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_orbit *orbit;
    iso_sample sample;
    iso_scene s = iso_scene_default();
    s.params = ball->params;
    iso_effects_set_level(&s.effects, ball->level != 0, ball->level);
    ISO_TRY(start_ball(ctx, &s.params, point, &s.start));
    for (int i = 0; i < ISO_STATE; i++) s.start.y[i] += 0.0; /* no -0 */
    iso_orbit_options o = iso_orbit_defaults(&s.start);
    o.effects = &s.effects;
    o.clock = ISO_CLOCK_S;
    o.with_clock[ISO_CLOCK_T] = true;
    ISO_TRY(iso_orbit_create(ctx, &s.params, &s.start, &o, &orbit));
    iso_status status = iso_orbit_at(orbit, s_end, &sample);
    s.end = sample.clock[ISO_CLOCK_T];
    iso_orbit_free(orbit);
    if (status == ISO_OK) *scene = s;
    return status;
}
