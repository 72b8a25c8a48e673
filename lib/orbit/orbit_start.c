/* orbit_start.c - where an orbit starts: in the ball's own units, in the model that is integrated; or why it
 * cannot. */
#include <float.h>
#include <math.h>

#include "base/math_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

/* Whether q^(exponent), times k^2/det J, is a double for all these q. */
static bool powers_fit(const iso_params *p, double least, double most, double exponent)
{
    const double reach = fmax(fabs(log2(least)), fabs(log2(most)));
    return reach * exponent + fabs(2 * log2(fabs(p->k)) - log2(p->det_J)) < 960;
}

/* M and the clocks tau and s have powers up to 1 + 1/(2|k|), the coupling of a point 1/k. Where an orbit starts they
 * must be doubles; further on that is seen at its samples. */
static iso_status check_powers(const iso_orbit *o, const iso_start *start)
{
    const iso_params *p = &o->units.own;
    const bool point = start->model == ISO_POINT;
    const double *n = start->y + 3;
    const double q = point ? dot_diag(n, p->J, n) : 1 / dot_diag(n, p->inv_J, n);
    if (powers_fit(p, q, q, 1 + (point ? 1 : 0.5) / fabs(p->k))) return ISO_OK;
    return iso_orbit_too_extreme(o, "M and the clocks tau and s",
                                 point ? "start from a ball" : "ask for omega, n or gamma, and t, alone");
}

/* Chooses the own units, for a ball that moves as fast as at the start, or as the potentials can make it. y: the start
 * in them. Returns the problem in own units, as far as it is known yet: in its place, since it is too large to copy for
 * each orbit. */
static iso_problem *to_own_units(iso_orbit *o, const iso_params *p, const iso_start *start, double speed,
                                 double y[ISO_STATE])
{
    iso_problem *problem = &o->model.problem;
    double still[ISO_STATE] = {0}, falling = 0;
    copy(start->y, y, ISO_STATE);
    copy(y + 3, still + 3, 3);
    problem->p = *p;
    iso_effects_copy(&o->effects, &problem->effects);
    if (!iso_effects_none(&o->effects)) falling = sqrt(2 * iso_effects_strength(problem, still) / max3(p->J));
    speed = fmax(speed, isfinite(falling) ? falling : 0);
    iso_units_choose(p, speed * fmax(1, fabs(p->k)), &o->units); /* the normal turns |k| times as fast */
    o->unit_M = iso_unit(&o->units, iso_system_point.fast_dimension);
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) o->unit_clock[c] = iso_unit(&o->units, iso_clock_dimension(c));
    iso_effects_scale(&o->effects, &o->units, -1);
    for (int i = 0; i < 3; i++) y[i] /= start->model == ISO_BALL ? o->units.w : o->unit_M;
    problem->p = o->units.own;
    iso_effects_copy(&o->effects, &problem->effects);
    return problem;
}

/* The level stated, in units of the coupling; 0: none is. */
static double stated_level(const iso_params *p, const iso_effects *effects)
{
    return iso_effects_have_level(effects) ? iso_coupling(p, iso_effects_level(effects)) : 0;
}

/* A ball's start in y; every ball that moves or is moved has a point, at the energy that `level` says. A potential that
 * breaks the isomorphism is not part of the h that a twin has. It may also need states that do not exist yet. */
static void start_ball(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE])
{
    double size;
    iso_problem *problem = to_own_units(o, p, start, largest(start->y), y);
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (iso_effect_list[e]->potential && iso_effect_why_broken(iso_effect_list[e]))
            problem->effects.on[e] = false;
    o->h = iso_system_ball.energy(problem, y, &size);
    o->eps = iso_coupling(&o->units.own, o->h);
    o->level = stated_level(&o->units.own, &o->effects);
}

/* The speed of the ball whose M has the size that M reaches on this potential: w^2 = (k^2/(det J J)) times the larger
 * of q^(1/k) M^2 and 2 eps. By logarithms, since the powers of J need not fit a double in the caller's units. */
static double point_speed(const iso_params *p, const iso_start *start)
{
    const double q = dot_diag(start->y + 3, p->J, start->y + 3);
    const double log_J = (log2(p->J[0]) + log2(p->J[1]) + log2(p->J[2])) / 3;
    const double moving = log2(largest(start->y)) + log2(q) / (2 * p->k);
    const double falling = (1 + log2(fabs(start->eps))) / 2; /* NAN on the level H = 0 */
    return exp2(fmin(fmax(moving, falling) + log2(fabs(p->k)) - 2 * log_J, 1000));
}

/* Finds the point's coupling and its level H. A coupling that is not stated is the one for which H is the stated
 * level (or 0). A stated level is kept if H agrees with it to 1e-9 of its terms. False: it does not agree. */
static bool find_level(iso_orbit *o, const iso_start *start, iso_problem *problem, double y[ISO_STATE])
{
    const bool stated = iso_effects_have_level(&o->effects);
    const double level = stated_level(&problem->p, &o->effects);
    double size;
    o->level = level;
    problem->energy = level;
    if (isnan(start->eps)) {
        problem->eps = 0;
        const double rest = iso_system_point.energy(problem, y, &size) - level; /* M^2/2 + V of the effects */
        problem->eps = rest * pow(dot_diag(y + 3, problem->p.J, y + 3), 1 / problem->p.k);
        return true;
    }
    problem->eps = start->eps / iso_unit(&o->units, iso_dimension_eps);
    const double H = iso_system_point.energy(problem, y, &size);
    if (fabs(H - level) <= 1e-9 * fmax(size, fabs(level))) return iso_system_point.project(problem, y), true;
    o->level = H;
    return !stated;
}

/* A point's start in y. Off the level H = 0 its ball lives in the potential of `level`. */
static iso_status start_point(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE])
{
    iso_problem *problem = to_own_units(o, p, start, point_speed(p, start), y);
    const double stated = iso_effects_level(&o->effects);
    const bool agrees = find_level(o, start, problem, y);
    o->eps = problem->eps;
    o->h = iso_energy(&problem->p, problem->eps);
    iso_effects_set_level(&o->effects, o->level != 0, iso_energy(&problem->p, o->level));
    if (agrees) return ISO_OK;
    const double unit = iso_unit(&o->units, iso_level_dimension());
    return ISO_FAIL_INPUT(o->ctx, "c",
                          "level: this point has the energy of c = %s, not of c = %s: leave c out, or eps",
                          ISO_SHORT(iso_effects_level(&o->effects) * unit), ISO_SHORT(stated * unit));
}

/* --- what effects allow ----------------------------------------------------------------------------------------- */

iso_status iso_orbit_no_point(iso_context *ctx, const iso_effect *breaking)
{
    return iso_context_fail(ctx, ISO_NOT_MAPPED, breaking->name,
                            "'%s' breaks the isomorphism: %s. There is no such point; the ball alone can be had",
                            breaking->name, iso_effect_why_broken(breaking));
}

static iso_status check_effects(iso_orbit *o, const iso_params *p, const iso_start *start)
{
    double ball[ISO_STATE] = {0}; /* no effect that a point can have asks for its omega */
    iso_effects *e = &o->effects;
    const iso_effect *breaking = iso_effects_breaking(e), *only_ball = iso_effects_ball_only(e);
    const bool by_point = o->options.backend != ISO_BACKEND_BALL;
    const bool point = by_point || o->options.shown != ISO_SHOW_BALL || start->model == ISO_POINT;
    if (start->model == ISO_POINT && isnan(iso_effects_level(e)))
        iso_effects_set_level(e, false, NAN); /* as it comes */
    const iso_effect *beyond = o->options.backend == ISO_BACKEND_EXACT ? iso_effects_beyond_rotor(e) : NULL;
    if (beyond)
        return ISO_FAIL_ARGUMENT(
            o->ctx, beyond->name,
            "the closed solution is for a ball on which nothing acts but '%s' and a rotor, not for "
            "one with '%s': take backend %s",
            iso_level_name(), beyond->name, iso_effect_why_broken(beyond) ? "ball" : "point");
    if (breaking && point) return iso_orbit_no_point(o->ctx, breaking);
    if (only_ball && by_point)
        return ISO_FAIL_ARGUMENT(o->ctx, only_ball->name, "'%s' is the ball's: take backend ball", only_ball->name);
    if (start->model == ISO_BALL) copy(start->y, ball, 3);
    iso_start_normal(p, start, ball + 3);
    return iso_effects_check(o->ctx, p, ball, e);
}

/* The potential of the point is that of the ball and of its energy, over powers of q: a constant in both is lost in the
 * difference, with as many of its last digits. y: the start in own units, as the model of `start` has it. */
static iso_status check_constant(const iso_orbit *o, const iso_start *start, const double y[ISO_STATE])
{
    const iso_problem *problem = &o->model.problem;
    double ball[ISO_MAX_STATE] = {0};
    if (o->options.backend == ISO_BACKEND_BALL || !iso_effects_pull(&o->effects)) return ISO_OK;
    copy(y, ball, ISO_STATE);
    if (start->model == ISO_POINT) iso_point_to_ball(&problem->p, ball, ball);
    const double U = iso_effects_potential(problem, ball);
    const double changes = iso_ball_energy(&problem->p, ball) + iso_effects_strength(problem, ball);
    const iso_method *method = o->options.method;
    const double rounding = method && method->digits > ISO_DOUBLE_DIGITS ? pow(10, -method->digits) : DBL_EPSILON;
    if (!(rounding * fabs(U) > 10 * fmax(o->options.tolerance, 64 * rounding) * changes)) return ISO_OK;
    return ISO_FAIL_NUMERICAL(
        o->ctx,
        "the potential at the start is %.2g times what can change of the energy: the point loses "
        "so many digits of it; take backend ball, or leave a constant out of the potential",
        fabs(U) / changes);
}

/* (24), or on H = 0 the form without powers of q where they are steep: no method for (24) alone has a use for it. (24)
 * has q^(1 + 1/|k|) wherever the orbit may go: q lies between the least and the largest moment of inertia. */
static iso_status choose_system(iso_orbit *o)
{
    const iso_params *p = &o->units.own;
    const iso_method *method = o->options.method;
    const bool bound = o->options.backend == ISO_BACKEND_EXACT || (method && method->system);
    const bool steep = iso_params_steep(p) && !bound && o->level == 0 && !iso_effects_have_image(&o->effects);
    o->system = o->options.backend == ISO_BACKEND_BALL ? &iso_system_ball
                : steep && p->k != -1                  ? &iso_system_point_in_t
                                                       : &iso_system_point;
    if (o->system != &iso_system_point || powers_fit(p, min3(p->J), max3(p->J), 1 + 1 / fabs(p->k))) return ISO_OK;
    return iso_orbit_too_extreme(o, "the form (24) of the point", "take backend ball");
}

static void to_system(const iso_orbit *o, iso_model_kind model, double y[ISO_STATE])
{
    const iso_params *own = &o->units.own;
    const bool ball = model == ISO_BALL;
    if (o->system == &iso_system_ball && !ball) iso_point_to_ball(own, y, y);
    if (o->system == &iso_system_point && ball) iso_ball_to_point(own, y, y);
    if (o->system == &iso_system_point_in_t) (ball ? iso_ball_to_point_in_t : iso_point_to_point_in_t)(own, y, y);
}

/* Refuses what does not fit a double: of a start in own units, and of its numbers in the caller's. `twin`: the point is
 * needed, be it by its states or as what is integrated. */
static iso_status check_range(iso_orbit *o, const iso_start *start, bool twin, const double y[ISO_STATE])
{
    const iso_orbit_options *opt = &o->options;
    const bool ball = start->model == ISO_BALL, level = iso_effects_have_level(&o->effects);
    const bool M = !ball || (opt->shown != ISO_SHOW_BALL && !opt->gamma_alone);
    /* where the normal is to turn once in a unit of time, h goes like k^-2 and eps like k^-4 */
    const bool still = ball && o->h == 0 && !iso_orbit_has_twin(o);
    const bool lost = ball && o->h != 0 && !(isnormal(o->h) && isnormal(o->eps));
    if (twin && (still ? largest(y) > 0 : lost))
        return iso_orbit_too_extreme(o, "the point", "take backend ball, and no more than omega and n");
    if (twin && still)
        return iso_context_fail(o->ctx, ISO_NOT_MAPPED, "angular_velocity",
                                "a ball at rest (h = 0) has no twin: the point's potential would vanish");
    bool fits = !M || isnormal(o->unit_M); /* what numbers are measured with; they must not lose digits either */
    for (int c = 0; c < ISO_CLOCKS; c++)
        fits = fits && ((c != (int)opt->clock && !opt->with_clock[c]) || isnormal(o->unit_clock[c]));
    if (!fits)
        return ISO_FAIL_NUMERICAL(
            o->ctx,
            "M (about %g) or a clock (s about %g) does not fit a double in these units: use other "
            "units of mass, length or time, or ask for the ball in its time t alone",
            o->unit_M, o->unit_clock[ISO_CLOCK_S]);
    ISO_TRY(check_constant(o, start, y));
    if (ball && level && iso_effects_level(&o->effects) == 0)
        return iso_context_fail(o->ctx, ISO_NUMERICAL, "c",
                                "level: c is out of the range of doubles in the ball's own units");
    return ISO_OK;
}

/* What is asked for decides what must exist: the ball, the point (twin), powers of q. */
iso_status iso_orbit_find_start(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE])
{
    const iso_orbit_options *opt = &o->options;
    const bool from_ball = start->model == ISO_BALL, to_ball = opt->backend == ISO_BACKEND_BALL;
    const bool twin = !to_ball || opt->shown != ISO_SHOW_BALL, M = opt->shown != ISO_SHOW_BALL && !opt->gamma_alone;
    const bool ball = from_ball || to_ball || opt->shown != ISO_SHOW_POINT || opt->clock != ISO_CLOCK_S ||
                      opt->with_clock[ISO_CLOCK_T] || opt->with_clock[ISO_CLOCK_TAU];
    const bool powers = M || !from_ball || opt->clock != ISO_CLOCK_T || opt->with_clock[ISO_CLOCK_TAU] ||
                        opt->with_clock[ISO_CLOCK_S];
    if (start->model != ISO_BALL && start->model != ISO_POINT)
        return ISO_FAIL_ARGUMENT(o->ctx, "", "an orbit starts as a ball or as a point");
    if (!all_finite(start->y, ISO_STATE) || (!from_ball && isinf(start->eps)))
        return ISO_FAIL_ARGUMENT(o->ctx, "", "the start is not finite");
    o->length = p->body.radius > 0 ? p->body.radius : 1;
    ISO_TRY(check_effects(o, p, start));
    iso_units_choose(p, 0, &o->units);
    if (powers) ISO_TRY(check_powers(o, start));
    if (from_ball)
        start_ball(o, p, start, y);
    else
        ISO_TRY(start_point(o, p, start, y));
    ISO_TRY(check_range(o, start, twin, y));
    ISO_TRY(choose_system(o));
    to_system(o, start->model, y);
    if (ball && iso_effects_have_level(&o->effects)) {
        const iso_effects in_users_units = iso_orbit_effects(o);
        if (!isnormal(iso_effects_level(&in_users_units)))
            return iso_context_fail(o->ctx, ISO_NUMERICAL, "c",
                                    "level: c of the ball is out of the range of doubles in these units: use other "
                                    "units, or ask for the point in its time s alone");
    }
    if (all_finite(y, ISO_STATE) && isfinite(o->h) && (!twin || isfinite(o->eps))) return ISO_OK;
    return ISO_FAIL_NUMERICAL(o->ctx, "the start is out of the range of doubles in the ball's own units");
}
