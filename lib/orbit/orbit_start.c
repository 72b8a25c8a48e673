/* orbit_start.c - where an orbit starts: in the ball's own units, in the model that is integrated; or why it cannot. */
#include <math.h>

#include "base/vec3_impl.h"
#include "map/state.h"
#include "orbit/orbit_impl.h"

static bool all_finite(const double x[], int count)
{
    for (int i = 0; i < count; i++)
        if (!isfinite(x[i])) return false;
    return true;
}

static void set_units(iso_orbit *o, const iso_params *p, double speed)
{
    iso_units_choose(p, speed, &o->units);
    o->unit_M = iso_unit(&o->units, iso_system_point.fast_dimension);
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) o->unit_clock[c] = iso_unit(&o->units, iso_clock_dimension(c));
}

/* What the numbers of an orbit are measured with must fit a double, and not lose digits. */
static iso_status check_units(const iso_orbit *o, const iso_start *start)
{
    const iso_orbit_options *opt = &o->options;
    bool fits = (opt->show == ISO_BALL && start->model == ISO_BALL) || isnormal(o->unit_M);
    for (int c = 0; c < ISO_CLOCKS; c++)
        fits = fits && ((c != (int)opt->clock && !opt->carry[c]) || isnormal(o->unit_clock[c]));
    if (fits) return ISO_OK;
    return iso_context_fail(o->ctx, ISO_NUMERICAL, "",
                            "M (about %g) or a clock (s about %g) does not fit a double in these units: use other "
                            "units of mass, length or time, or ask for the ball in its time t alone",
                            o->unit_M, o->unit_clock[ISO_CLOCK_S]);
}

/* Everything but the ball in its own time has powers of q up to 1 + 1/|k|, times k^2/det J. They must fit a double
 * wherever the orbit may go: q lies between the least and the largest moment of inertia. */
static iso_status check_powers(const iso_orbit *o)
{
    const iso_params *p = &o->units.own;
    const double reach = fmax(fabs(log2(min3(p->J))), fabs(log2(max3(p->J)))), k = fabs(p->k);
    if (reach * (1 + 1 / k) + fabs(2 * log2(k) - log2(p->det_J)) < 960) return ISO_OK;
    return iso_context_fail(
        o->ctx, ISO_NUMERICAL, "k",
        "k = %g is too extreme for the point and the clocks tau and s of a ball with max J/min J = "
        "%.3g: q^(1/k) leaves the range of doubles; the ball in its time t can be had",
        p->k, max3(p->J) / min3(p->J));
}

/* A ball's start in y; every ball that moves has a point. */
static void start_ball(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE])
{
    set_units(o, p, largest(start->y));
    copy(start->y, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= o->units.w;
    o->h = iso_ball_energy(&o->units.own, y);
    o->eps = iso_coupling(&o->units.own, o->h);
}

/* The speed of the ball whose M has the size that M reaches on this potential: w^2 = (k^2/(det J J)) times the larger of
 * q^(1/k) M^2 and 2 eps. By logarithms, since the powers of J need not fit a double in the caller's units. */
static double point_speed(const iso_params *p, const iso_start *start)
{
    const double q = dot_diag(start->y + 3, p->J, start->y + 3);
    const double log_J = (log2(p->J[0]) + log2(p->J[1]) + log2(p->J[2])) / 3;
    const double moving = log2(largest(start->y)) + log2(q) / (2 * p->k);
    const double falling = (1 + log2(fabs(start->eps))) / 2; /* NAN on the level H = 0 */
    return exp2(fmin(fmax(moving, falling) + log2(fabs(p->k)) - 2 * log_J, 1000));
}

/* A point's start in y; gives the level H it lives on, 0 if it is that to 1e-9, and the size of the terms of H. */
static double start_point(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE],
                          double *size)
{
    set_units(o, p, point_speed(p, start));
    copy(start->y, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= o->unit_M;
    iso_field field = {.p = o->units.own, .eps = start->eps / iso_unit(&o->units, iso_dimension_eps)};
    if (isnan(start->eps)) field.eps = iso_coupling(&field.p, iso_point_energy(&field.p, y));
    o->eps = field.eps;
    o->h = iso_energy(&field.p, field.eps);
    const double H = iso_system_point.integrals[0].value(&field, y, size);
    if (fabs(H) > 1e-9 * *size) return H;
    iso_system_point.project(&field, y);
    return 0;
}

static iso_status refuse_level(iso_context *ctx, double H, double size)
{
    return iso_context_fail(
        ctx, ISO_NOT_MAPPED, "M",
        "this point has energy H = %.6g of M^2/2 + |V|, and only on the level H = 0 is it the twin "
        "of a free ball: change M or eps, or leave eps out to have the one that fits; or stay with "
        "the point (backend point, as point)",
        H / size);
}

/* What an orbit is asked for decides what must exist: the ball, the point, powers of q. */
typedef struct needs {
    bool ball, point, powers;
} needs;

static needs what_is_needed(const iso_orbit_options *opt, const iso_start *start)
{
    const bool other_clocks = opt->carry[ISO_CLOCK_TAU] || opt->carry[ISO_CLOCK_S];
    const bool point = opt->backend == ISO_POINT || opt->show != ISO_BALL;
    return (needs){
        .ball = opt->backend == ISO_BALL || opt->show != ISO_POINT || opt->clock != ISO_CLOCK_S ||
                opt->carry[ISO_CLOCK_T] || opt->carry[ISO_CLOCK_TAU],
        .point = point,
        .powers = point || start->model == ISO_POINT || opt->clock != ISO_CLOCK_T || other_clocks,
    };
}

iso_status iso_orbit_find_start(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE],
                                double *energy)
{
    const iso_picture backend = o->options.backend;
    const needs need = what_is_needed(&o->options, start);
    double level = 0, size = 0;
    if (!all_finite(start->y, ISO_STATE) || (start->model == ISO_POINT && isinf(start->eps)))
        return iso_context_fail(o->ctx, ISO_BAD_ARGUMENT, "", "the start is not finite");
    set_units(o, p, 0);
    iso_status status = need.powers ? check_powers(o) : ISO_OK;
    if (status != ISO_OK) return status;
    if (start->model == ISO_BALL)
        start_ball(o, p, start, y);
    else
        level = start_point(o, p, start, y, &size);
    if (start->model == ISO_BALL && o->h == 0 && need.point)
        return iso_context_fail(o->ctx, ISO_NOT_MAPPED, "angular_velocity",
                                "a ball at rest (h = 0) has no twin: the point's potential would vanish");
    if (level != 0 && need.ball) return refuse_level(o->ctx, level, size);
    status = check_units(o, start);
    if (status != ISO_OK) return status;
    if (backend == ISO_POINT && start->model == ISO_BALL) iso_ball_to_point(&o->units.own, y, y);
    if (backend == ISO_BALL && start->model == ISO_POINT) iso_point_to_ball(&o->units.own, y, y);
    *energy = backend == ISO_BALL ? o->h : level;
    if (all_finite(y, ISO_STATE) && isfinite(o->h) && (!need.point || isfinite(o->eps))) return ISO_OK;
    return iso_context_fail(o->ctx, ISO_NUMERICAL, "",
                            "the start is out of the range of doubles in the ball's own units");
}
