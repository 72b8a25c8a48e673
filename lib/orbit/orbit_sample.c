/* orbit_sample.c - the numbers of a sample: from the state of an orbit in own units to the caller's, and back. */
#include <float.h>
#include <math.h>

#include "base/vec3_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

_Static_assert(sizeof(iso_sample) == ISO_TRAJECTORY_COLUMNS * sizeof(double),
               "a number for each column, in their order");

double iso_sample_column(const iso_sample *sample, int column)
{
    return ((const double *)sample)[column];
}

double iso_sample_get(const iso_sample *sample, const char *name)
{
    const int column = iso_column_find(name);
    return column < 0 ? NAN : iso_sample_column(sample, column);
}

void iso_sample_set_column(iso_sample *sample, int column, double value)
{
    ((double *)sample)[column] = value;
}

void iso_sample_blank(iso_sample *s)
{
    for (int c = 0; c < ISO_TRAJECTORY_COLUMNS; c++) iso_sample_set_column(s, c, NAN);
}

/* --- from a state to a sample ----------------------------------------------------------------------------------- */

static iso_status out_of_range(const iso_orbit *o, const char *name)
{
    return ISO_FAIL_NUMERICAL(
        o->ctx, "%s is out of the range of doubles in these units: use other units of mass, length or time", name);
}

/* Converts `count` numbers to the caller's units. Fails if one overflows or loses digits. Numbers of a motion that
 * dies away (`vanishes`) may become 0. */
static iso_status to_users_units(const iso_orbit *o, const char *name, double unit, bool vanishes, double x[],
                                 int count)
{
    double before = 0, after = 0;
    bool finite = true;
    for (int i = 0; i < count; i++) {
        before = fmax(before, fabs(x[i]));
        if (x[i] != 0) x[i] *= unit; /* the unit may be infinite */
        after = fmax(after, fabs(x[i]));
        finite = finite && isfinite(x[i]);
    }
    if (finite && (before == 0 || vanishes || fmin(before, after) >= DBL_MIN)) return ISO_OK;
    return out_of_range(o, name);
}

void iso_orbit_as_point(const iso_orbit *o, const double y[], double point[ISO_STATE])
{
    const iso_params *own = &o->units.own;
    if (o->system == &iso_system_ball) iso_ball_to_point(own, y, point);
    if (o->system == &iso_system_point) copy(y, point, ISO_STATE);
    if (o->system == &iso_system_point_in_t) iso_point_in_t_to_point(own, y, point);
}

/* One own unit of a group of columns in the caller's. */
static double unit_of(const iso_orbit *o, const iso_effect_column *group)
{
    double unit = iso_unit(&o->units, group->dimension);
    for (int power = group->length; power > 0; power--) unit *= o->length;
    for (int power = group->length; power < 0; power++) unit /= o->length;
    return unit;
}

static iso_status sample_ball(const iso_orbit *o, const double y[], iso_sample *s)
{
    const iso_params *own = &o->units.own;
    const bool vanishes = iso_effects_stiffness(&o->model.problem) > 0, ball = o->system == &iso_system_ball;
    if (ball) copy(y, s->ball, ISO_STATE);
    if (o->system == &iso_system_point) iso_point_to_ball(own, y, s->ball);
    if (o->system == &iso_system_point_in_t) iso_point_in_t_to_ball(own, y, s->ball);
    ISO_TRY(to_users_units(o, "omega", o->units.w, vanishes, s->ball, 3));
    for (iso_effect_id e = 0; ball && e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        double x[ISO_EFFECT_COLUMNS], *from = x, *to = s->effect + iso_effect_first_column(e);
        if (!o->model.problem.effects.on[e] || !effect->show) continue;
        effect->show(&o->model.problem, y, x);
        for (const iso_effect_column *group = effect->columns; group && group->name; group++) {
            const double unit = unit_of(o, group);
            for (int i = 0; i < group->count; i++, to++)
                if (!isfinite(*to = *from++ * unit))
                    return out_of_range(o, iso_effect_column_name((int)(to - s->effect), NULL, NULL, NULL));
        }
    }
    return ISO_OK;
}

static iso_status sample_point(const iso_orbit *o, const double y[], iso_sample *s)
{
    iso_orbit_as_point(o, y, s->point);
    const bool moves = o->system != &iso_system_point && largest(y) > 0;
    if (o->options.gamma_alone)
        for (int i = 0; i < 3; i++) s->point[i] = NAN;
    else if (moves && !isnormal(largest(s->point)))
        return iso_orbit_too_extreme(o, "M", "ask for omega, n or gamma alone");
    else
        return to_users_units(o, "M", o->unit_M, false, s->point, 3);
    return ISO_OK;
}

/* Where powers q^(1/(2k)) are steep, clocks may leave the range of doubles even in own units. Elsewhere a clock is
 * about as small as the time. */
iso_status iso_orbit_make_sample(const iso_orbit *o, double time, const double y[], iso_sample *s)
{
    iso_sample_blank(s);
    s->clock[o->model.clock] = time;
    for (int i = 0; i < o->model.clocks; i++) {
        const iso_clock c = o->model.clock_of[i];
        const double own = s->clock[c] = y[o->model.moving + i];
        const bool vanishes = fabs(time) < DBL_MIN; /* such a time has no digits itself */
        if (!isnormal(own) && time != 0 && iso_params_steep(&o->units.own))
            return iso_orbit_too_extreme(o, iso_clock_name(c), "ask for t alone");
        ISO_TRY(to_users_units(o, iso_clock_name(c), o->unit_clock[c], vanishes, &s->clock[c], 1));
    }
    if (o->options.shown != ISO_SHOW_POINT) ISO_TRY(sample_ball(o, y, s));
    return o->options.shown == ISO_SHOW_BALL ? ISO_OK : sample_point(o, y, s);
}

/* --- and back --------------------------------------------------------------------------------------------------- */

void iso_orbit_state_of(const iso_orbit *o, const iso_system *system, const iso_sample *s, double y[])
{
    const iso_problem *f = &o->model.problem;
    const bool ball = system == &iso_system_ball;
    copy(ball ? s->ball : s->point, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= ball ? o->units.w : o->unit_M;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        const double *from = s->effect + iso_effect_first_column(e);
        double own[ISO_EFFECT_COLUMNS], *to = own;
        bool derived = false;
        if (f->at[e] == 0) continue;
        for (const iso_effect_state *state = effect->states; state && state->name; state++)
            derived = derived || state->kind == ISO_STATE_DERIVED;
        if (derived) effect->begin(f, y);
        if (!effect->recall) continue;
        for (const iso_effect_column *group = effect->columns; group && group->name; group++) {
            const double unit = unit_of(o, group);
            for (int i = 0; i < group->count; i++) *to++ = *from++ / unit;
        }
        effect->recall(f, own, y);
    }
}

double iso_orbit_integral(const iso_orbit *o, const iso_system *system, const iso_integral *integral,
                          const iso_sample *sample, double *size)
{
    double y[ISO_MAX_STATE];
    iso_orbit_state_of(o, system, sample, y);
    return integral->value(&o->model.problem, y, size);
}
