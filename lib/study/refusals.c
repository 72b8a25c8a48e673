/* refusals.c - what studies refuse (study_impl.h). */
#include "base/number_impl.h"
#include "map/section_impl.h"
#include "model/effects/effects_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "map/section.h"

/* --- effects ---------------------------------------------------------------------------------------------------- */

iso_status iso_refuse_beyond_level(iso_context *ctx, const iso_effects *effects, const char *what)
{
    const iso_effect *effect = iso_effects_beyond_level(effects);
    if (!effect) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, effect->name,
                          "%s only of the free ball and of the point, on every level of its energy: remove '%s'",
                          what, effect->name);
}

iso_status iso_refuse_off_chart(iso_context *ctx, const iso_effects *effects, const char *what)
{
    const iso_effect *effect = iso_effects_off_chart(effects);
    if (!effect) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, effect->name,
                          "%s only of the free ball and of the point, on every level of its energy and in a magnetic "
                          "field: remove '%s'",
                          what, effect->name);
}

iso_status iso_refuse_coupling(iso_context *ctx, const iso_orbit *orbit, const char *what)
{
    const iso_point_motion m = iso_orbit_motion(orbit);
    if (m.eps > 0 || m.energy == 0) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, iso_level_name(),
                          "%s only where the point's coupling eps is above 0; here it is %.6g: the ball's energy in "
                          "the potential of 'level' is not positive",
                          what, iso_orbit_coupling(orbit));
}

iso_status iso_refuse_losses(iso_context *ctx, const iso_orbit *orbit, const char *what)
{
    const iso_effect *taking = iso_effects_taking_energy(&iso_orbit_model(orbit)->problem);
    if (!taking) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, taking->name, "'%s' takes energy from the ball: a motion that comes to rest %s",
                          taking->name, what);
}

iso_status iso_refuse_unbound(iso_context *ctx, const iso_orbit *orbit, const char *what)
{
    const char *why;
    const iso_status status = iso_refuse_losses(ctx, orbit, what);
    const iso_effect *without = iso_effects_without_frequencies(&iso_orbit_model(orbit)->problem, &why);
    if (status != ISO_OK || !without) return status;
    return ISO_FAIL_INPUT(ctx, without->name, "%s: its motion %s", why, what);
}

/* --- the body --------------------------------------------------------------------------------------------------- */

iso_status iso_refuse_equal_moments(iso_context *ctx, const double J[3], const char *what)
{
    for (int i = 0; i < 3; i++)
        if (fabs(J[(i + 1) % 3] - J[(i + 2) % 3]) <= 4 * DBL_EPSILON * min3(J))
            return ISO_FAIL_INPUT(ctx, "J",
                                  "J%d and J%d are equal: a rotation about axis %d carries every orbit along, so %s",
                                  (i + 1) % 3 + 1, (i + 2) % 3 + 1, i + 1, what);
    return ISO_OK;
}

/* --- starts ----------------------------------------------------------------------------------------------------- */

/* A point whose eps is not given has H = 0, where it cannot rest in a potential. */
iso_status iso_refuse_rest(iso_context *ctx, const iso_start *start, const iso_effects *effects, const char *what)
{
    const bool ball = start->model == ISO_BALL;
    if (largest(start->y) > 0 || iso_effects_pull(effects)) return ISO_OK;
    if (!ball && start->eps != 0 && !isnan(start->eps)) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, ball ? "angular_velocity" : "M", "a %s at rest %s",
                          iso_model_kind_name((int)start->model), what);
}

iso_status iso_refuse_start_at_rest(iso_context *ctx, const iso_start *start, const char *what)
{
    return ISO_FAIL_INPUT(ctx, start->model == ISO_BALL ? "angular_velocity" : "M",
                          "the %s starts at rest, where %s: start it a little later",
                          iso_model_kind_name((int)start->model), what);
}

/* Of a closed part of the circle: where gamma is at l the point has not enough energy. */
static iso_status refuse_closed(iso_context *ctx, const iso_orbit *orbit, int axis, const char *about,
                                const char *where)
{
    const iso_point_motion m = iso_orbit_motion(orbit);
    const double unit = iso_unit(iso_orbit_units(orbit), iso_system_point.fast_dimension);
    return ISO_FAIL_INPUT(ctx, about,
                          "n_%d = 0 is closed %s on the level H = %.6g: the potential there is not below H", axis + 1,
                          where, m.energy * unit * unit);
}

static iso_status check_spread(iso_context *ctx, const iso_orbit *orbit, int axis)
{
    const iso_point_motion m = iso_orbit_motion(orbit);
    if (iso_section_is_open(m, axis, 0) || iso_section_is_open(m, axis, ISO_PI / 2)) return ISO_OK;
    return refuse_closed(ctx, orbit, axis, "starts", "everywhere");
}

static iso_status check_at(iso_context *ctx, const iso_orbit *orbit, int axis, const double at[2])
{
    const double l = at[0], x = at[1];
    char where[48];
    if (fabs(x) == 1)
        return ISO_FAIL_INPUT(ctx, "at", "l, x = %s, %s is " ISO_NEVER_CROSSES, ISO_SHORT(l), ISO_SHORT(x), axis + 1,
                              axis + 1);
    if (!isfinite(l) || !(fabs(x) < 1))
        return ISO_FAIL_INPUT(ctx, "at", "l, x = %s, %s is outside the chart: l is any angle, x is between -1 and 1",
                              ISO_SHORT(l), ISO_SHORT(x));
    if (iso_section_is_open(iso_orbit_motion(orbit), axis, l)) return ISO_OK;
    snprintf(where, sizeof where, "at l = %s", ISO_SHORT(l));
    return refuse_closed(ctx, orbit, axis, "at", where);
}

iso_status iso_refuse_starts(iso_context *ctx, const iso_orbit *orbit, const iso_effects *effects, int axis,
                             const double (*at)[2], size_t count, bool spread)
{
    const iso_effect *effect = iso_effects_off_chart(effects);
    if (effect)
        return ISO_FAIL_INPUT(ctx, effect->name,
                              "no other starts can be given here: the section has a chart only where nothing acts "
                              "but a level or a magnetic field, without '%s'",
                              effect->name);
    for (size_t i = 0; i < count; i++)
        if (check_at(ctx, orbit, axis, at[i]) != ISO_OK) return ISO_BAD_INPUT;
    return spread ? check_spread(ctx, orbit, axis) : ISO_OK;
}
