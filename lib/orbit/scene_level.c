/* scene_level.c - puts a scene on a level of the point's energy, given as one number (study/level.h). It stands above
 * orbits, scene.c below them. */
#include <math.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "map/section_impl.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

static iso_status refuse_place(iso_context *ctx, const iso_point_motion m, double level, double q, const char *name)
{
    return ISO_FAIL_INPUT(ctx, "level",
                          "level %.10g is not reached at this %s: the potential there is %.10g, counted like the "
                          "level, and the level must be above it",
                          level, name, -iso_level_of(m.p, pow(q, -1 / m.p->k)));
}

/* Keeps eps, gamma and the direction of M. */
static iso_status move_point(iso_context *ctx, const iso_orbit *orbit, double level, iso_start *start)
{
    iso_point_motion m = iso_orbit_motion(orbit);
    const double q = dot_diag(start->y + 3, m.p->J, start->y + 3), size = largest(start->y);
    m.energy = m.eps * iso_level_energy(m.p, level);
    const double M = iso_section_momentum_at(m.p->k, m.eps, m.energy, q);
    if (!(m.eps > 0)) return ISO_FAIL_INPUT(ctx, "eps", "a level is counted in units of eps, which must be above 0");
    if (size == 0) return ISO_FAIL_INPUT(ctx, "M", "M is 0 and has no direction: a level sets only the length of M");
    if (!(M > 0 && isfinite(M))) return refuse_place(ctx, m, level, q, "gamma");
    scale(start->y, 1 / size);
    scale(start->y, M / norm(start->y) * orbit->unit_M);
    if (isnan(start->eps)) start->eps = iso_orbit_coupling(orbit);
    return ISO_OK;
}

/* Keeps omega and n, and finds c: with eta = level J2^(-1/k) the energy is h = T - c g^(-1/k), c = eta h, so
 * h = T/(1 + eta g^(-1/k)). */
static iso_status move_ball(iso_context *ctx, const iso_orbit *orbit, double level, iso_scene *scene)
{
    const iso_point_motion m = iso_orbit_motion(orbit);
    const double *n = scene->start.y + 3, q = 1 / dot_diag(n, m.p->inv_J, n);
    const double T = iso_energy(m.p, m.eps), eta = iso_level_energy(m.p, level);
    const double h = T / (1 + eta * pow(q, 1 / m.p->k));
    if (!(T > 0)) return ISO_FAIL_INPUT(ctx, "angular_velocity", "a ball at rest cannot be put on a level");
    if (!(h > 0 && isfinite(h))) return refuse_place(ctx, m, level, q, "normal");
    iso_effects_set_level(&scene->effects, level != 0,
                          eta * h * iso_unit(iso_orbit_units(orbit), iso_level_dimension()));
    return ISO_OK;
}

iso_status iso_scene_on_level(iso_context *ctx, iso_scene *scene, double level)
{
    iso_effects acting = iso_scene_acting(scene);
    const iso_effect *effect = iso_effects_beyond_level(&acting);
    const bool ball = scene->start.model == ISO_BALL;
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    iso_orbit *orbit;
    if (effect)
        return ISO_FAIL_INPUT(ctx, effect->name, "a level needs a motion on which nothing else acts: remove '%s'",
                              effect->name);
    if (!isfinite(level)) return ISO_FAIL_INPUT(ctx, "level", "%s is no level", ISO_SHORT(level));
    if (ball) iso_effects_set_level(&acting, false, 0);
    o.effects = &acting;
    ISO_TRY(iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit));
    if (!ball) iso_effects_set_level(&scene->effects, false, 0);
    iso_status status = ball ? move_ball(ctx, orbit, level, scene) : move_point(ctx, orbit, level, &scene->start);
    iso_orbit_free(orbit);
    return status;
}
