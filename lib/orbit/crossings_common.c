/* crossings_common.c - what orbits in lanes and orbits alone have in common: how they are prepared, the bounds
 * between their crossings, the numbers of a crossing, and failures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "map/section_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"

/* --- the orbit -------------------------------------------------------------------------------------------------- */

iso_attempt iso_crossings_attempt(const iso_crossings *c, size_t i)
{
    const iso_backend asked = c->options.backend, last = asked == ISO_BACKEND_AUTO ? ISO_BACKEND_BALL : asked;
    const iso_batch_orbit *of = &c->orbits[i];
    iso_effects effects = of->effects ? *of->effects : iso_effects_default();
    iso_start_settle(of->params, of->start, &effects);
    return iso_attempt_first(of->params, asked, last, !iso_effects_breaking(&effects));
}

iso_orbit_options iso_crossings_orbit_options(const iso_crossings *c, size_t i, iso_attempt attempt)
{
    const iso_crossings_options *o = &c->options;
    const iso_batch_orbit *of = &c->orbits[i];
    iso_orbit_options how = iso_orbit_defaults(of->start);
    how.effects = of->effects;
    how.backend = attempt.backend;
    how.tolerance = o->tolerance;
    how.memory = 0; /* it only goes on */
    how.clock = attempt.backend == ISO_BACKEND_POINT ? ISO_CLOCK_S : ISO_CLOCK_T;
    if (o->kind == ISO_SECTION_CLOCK) how.clock = o->clock;
    for (iso_clock k = 0; k < ISO_CLOCKS; k++) how.with_clock[k] = attempt.clocks;
    /* the states of a model are needed because it is integrated, because samples show it, or for the column */
    const bool of_point = o->column >= ISO_COLUMN_POINT && o->column < ISO_COLUMN_EFFECTS;
    const iso_models of_column = of_point ? ISO_SHOW_POINT : ISO_SHOW_BALL;
    how.shown = o->shown;
    if (how.shown != (iso_models)attempt.backend || (o->kind == ISO_SECTION_COLUMN && how.shown != of_column))
        how.shown = ISO_SHOW_BOTH;
    return how;
}

/* --- bounds ----------------------------------------------------------------------------------------------------- */

/* Messages count axes from 1, as files and options do. */
iso_status iso_crossings_check_axis(iso_context *ctx, int axis)
{
    if (axis == ISO_AXIS_AUTO || (axis >= 0 && axis <= 2)) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "axis", "axis %lld is not 1, 2 or 3", axis + 1LL);
}

/* The number of parts in a unit of the variable of the series, so that gamma_a has at most one zero in each. A zero
 * shows by the signs of n_a at the ends of a part. In s, a part of length x is short enough if W x <= pi, by Sturm.
 * In t, let r = ds/dt ~ q^(1+1/(2k)) and Omega = W r. Lyapunov's inequality 4 < (s2 - s1) int W^2 ds between two
 * zeros gives
 *
 *     4 < int r dt int (Omega^2/r) dt <= Omega_max^2 x^2 (rho + 1)^2/(4 rho),    rho = r_max/r_min in the part
 *
 * q changes at a rate of |q_t/q| <= B = (J_max - J_min) (2 h k^2/det J)^(1/2), on a level E with the largest
 * h + E k^2/det J q^(1/k), which is (det J/(2 k^2)) |gamma_t|^2/q^2, in the place of h. So rho <= e if
 * x B |1 + 1/(2k)| <= 1. Then two zeros are more than 1.77/Omega_max apart. Omega_max is the largest of
 *
 *     Omega^2 = (k^4/det J^2) [ 2 E q^(2+1/k) + (2 eps/k) q (J_a - (1-k) q) ],    q between min J and max J,
 *
 * as the largest of the first term plus the largest of the second. */
double iso_crossings_zeros(iso_point_motion m, int axis, iso_clock variable)
{
    const iso_params *p = m.p;
    double W[2];
    iso_section_bounds(m, axis, W);
    if (variable == ISO_CLOCK_S) return W[1] / ISO_PI;
    const double k = p->k, least = min3(p->J), most = max3(p->J), top = p->J[axis] / (2 * (1 - k));
    const double q[3] = {least, most, top > least && top < most ? top : most};
    double square = 0, of_level = 0, h = m.energy == 0 ? iso_energy(p, m.eps) : 0;
    for (int i = 0; i < 3; i++) {
        square = fmax(square, 2 * m.eps / p->det_J * (k * k * k / p->det_J) * q[i] * (p->J[axis] - (1 - k) * q[i]));
        if (m.energy > 0) of_level = fmax(of_level, 2 * m.energy * pow(q[i], 2 + 1 / k) * pow(k * k / p->det_J, 2));
        if (m.energy != 0) h = fmax(h, iso_energy(p, m.eps + m.energy * pow(p->J[i], 1 / k)));
    }
    const double turn = sqrt(2 * h * k * k / p->det_J) * (most - least);
    return fmax(turn * fabs(1 + 1 / (2 * k)), sqrt(square + of_level) / 1.77);
}

bool iso_crossings_apart(const double bound[2], bool least, double apart, double s, double tolerance)
{
    const double part = 1e-9 + 100 * tolerance, rounding = 1e-14 * fabs(s);
    if (isnan(bound[0]) || isnan(bound[1]) || isnan(apart)) return true;
    if (apart > bound[1] * (1 + part) + rounding) return false;
    return !least || apart >= bound[0] * (1 - part) - rounding;
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

/* The directions of (M, gamma) at a state; the lengths differ. The chart needs no more. M has the direction of
 * J^(1/2) omega (for k < 0 the opposite one), and gamma that of J^(-1/2) n (18). So a ball without a twin has a chart
 * as well. point and y may be one array. */
static void to_point(const iso_params *p, iso_model_kind model, const double y[ISO_STATE], double point[ISO_STATE])
{
    copy(y, point, ISO_STATE);
    for (int i = 0; i < 3 && model == ISO_BALL; i++) {
        point[i] *= copysign(p->root_J[i], p->k);
        point[3 + i] /= p->root_J[i];
    }
}

/* A start is on the section where n_a is 0 up to 1e-8 radians of its oscillation: it is no crossing, and an event there
 * is not counted. Without this margin ball and point, or lanes and single orbits, would disagree if n_a is 0 up to
 * rounding. */
#define ON_SECTION 1e-8

/* Only where nothing acts but a level, orbits obey gamma_a'' = -W^2 gamma_a, which bounds the distance of crossings.
 * The place of the start is found by the directions of M and gamma, also of a ball: so both models agree about it.
 * gamma_a oscillates at the rate of about |M|. So gamma_a'/|M| has the size of gamma_a. If it falls at the start, the
 * first crossing comes after half an oscillation. An orbit in the plane n_a = 0 stays in it, unless a potential beyond
 * the level moves it. */
iso_status iso_crossings_begin(iso_context *ctx, const iso_crossings *c, const iso_params *p, const iso_orbit *orbit,
                               const double y[ISO_STATE], iso_crossing_orbit *o)
{
    const iso_point_motion motion = iso_orbit_motion(orbit);
    const bool is_free = iso_effects_are_free(&orbit->effects), moved = iso_effects_pull(&orbit->effects) && !is_free;
    double point[ISO_STATE], W[2];
    o->bound[0] = o->bound[1] = NAN;
    o->axis = -1;
    if (c->options.kind != ISO_SECTION_AXIS) return ISO_OK;
    const int a = c->options.axis == ISO_AXIS_AUTO ? iso_section_axis(motion) : c->options.axis;
    o->axis = a;
    if (is_free && iso_orbit_has_twin(orbit)) {
        iso_section_bounds(motion, a, W);
        o->bound[0] = 2 * ISO_PI / W[1];
        o->bound[1] = 2 * ISO_PI / W[0];
    }
    for (int i = 0; i < 3; i++) point[i] = y[i] / largest(y), point[3 + i] = y[3 + i];
    to_point(p, iso_crossings_model(orbit), point, point);
    const double *M = point, *gamma = point + 3, pace = norm(M);
    const double rise = gamma[(a + 1) % 3] * M[(a + 2) % 3] - gamma[(a + 2) % 3] * M[(a + 1) % 3];
    o->upwards = rise >= 0;
    o->begins_on_it = fabs(pace * gamma[a]) <= ON_SECTION * hypot(pace * gamma[a], rise);
    if (!iso_section_is_rotation(y, a) || moved) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "axis", "this orbit is " ISO_NEVER_CROSSES, a + 1, a + 1);
}

/* The bounds are by Sturm's comparison. A larger distance means a skipped crossing, a smaller one a crossing found
 * twice. A start on the section is on it up to ON_SECTION. */
iso_status iso_crossings_add(iso_context *ctx, const iso_crossings *c, const iso_orbit *orbit,
                             const double clock[ISO_CLOCKS], double s, const double y[ISO_STATE],
                             iso_crossing_orbit *o, iso_crossing *to)
{
    const bool least = o->count > 0 || (o->begins_on_it && o->upwards), twin = iso_orbit_has_twin(orbit);
    const double loose = o->count == 0 ? ON_SECTION : 0, unit = orbit->unit_clock[ISO_CLOCK_S];
    const double bound[2] = {(1 - loose) * o->bound[0], (1 + loose) * o->bound[1]};
    double point[ISO_STATE];
    if (!iso_crossings_apart(bound, least, s - o->s, s, c->options.tolerance))
        return ISO_FAIL_NUMERICAL(ctx,
                                  "crossings %zu and %zu of n_%d = 0 are %.10g apart in s, not between %.10g and "
                                  "%.10g: the computation is wrong there; take a smaller tolerance",
                                  o->count, o->count + 1, o->axis + 1, (s - o->s) * unit, bound[0] * unit,
                                  bound[1] * unit);
    iso_crossing_blank(to);
    for (int k = 0; k < ISO_CLOCKS; k++) to->clock[k] = k == ISO_CLOCK_T || twin ? clock[k] : NAN;
    if (o->axis >= 0) {
        to_point(&orbit->units.own, iso_crossings_model(orbit), y, point);
        iso_section_chart(o->axis, point, &to->l, &to->x);
    }
    o->s = s;
    o->count++;
    return ISO_OK;
}

void iso_crossing_blank(iso_crossing *crossing)
{
    double *number = (double *)crossing;
    for (size_t i = 0; i < sizeof *crossing / sizeof *number; i++) number[i] = NAN;
}

void iso_crossings_hide(const iso_crossings *c, iso_sample *s)
{
    for (int i = 0; i < ISO_STATE && c->options.shown == ISO_SHOW_BALL; i++) s->point[i] = NAN;
    for (int i = 0; i < ISO_STATE && c->options.shown == ISO_SHOW_POINT; i++) s->ball[i] = NAN;
    for (int i = 0; i < ISO_EFFECT_COLUMNS && c->options.shown == ISO_SHOW_POINT; i++) s->effect[i] = NAN;
}

/* The start is made in own units, in which powers of q fit a double. */
iso_start iso_section_start(const iso_orbit *orbit, iso_model_kind model, int axis, double l, double x)
{
    const double eps = iso_orbit_coupling(orbit);
    iso_start start = {.model = model, .eps = isnormal(eps) ? eps : (double)NAN};
    const bool ball = model == ISO_BALL;
    iso_section_point(iso_orbit_motion(orbit), axis, l, x, start.y);
    if (ball) iso_point_to_ball(&orbit->units.own, start.y, start.y);
    scale(start.y, ball ? orbit->units.w : orbit->unit_M);
    return start;
}

void iso_crossings_keep(iso_crossings *c, const iso_crossings_task *t, const iso_context *ctx, size_t i,
                        iso_status status)
{
    iso_crossing_orbit *o = &c->orbit[i];
    t->status[i] = status;
    if (status == ISO_OK || status == ISO_STOPPED) return;
    o->status = status;
    o->why = strdup(iso_context_message(ctx));
    snprintf(o->about, sizeof o->about, "%s", iso_context_about(ctx));
}
