/* level.c - the level of a scene (study_impl.h). */

#include "map/section_impl.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

/* The orbit of a scene; its effects are settled, and allowed. */
static iso_status open_orbit(iso_context *ctx, const iso_scene *scene, const iso_effects *effects, iso_orbit **orbit)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    o.effects = effects;
    o.gamma_alone = true; /* M need not fit a double */
    return iso_orbit_create(ctx, &scene->params, &scene->start, &o, orbit);
}

iso_status iso_level_problem(iso_context *ctx, const iso_scene *scene, const char *what, iso_problem *problem)
{
    const iso_effects effects = iso_scene_acting(scene);
    iso_orbit *orbit;
    ISO_TRY(iso_refuse_off_chart(ctx, &effects, what));
    ISO_TRY(open_orbit(ctx, scene, &effects, &orbit));
    const iso_point_motion m = iso_orbit_motion(orbit);
    *problem = (iso_problem){*m.p, m.eps, m.energy, .effects = iso_orbit_model(orbit)->problem.effects};
    iso_orbit_free(orbit);
    return ISO_OK;
}

iso_status iso_level_find(iso_context *ctx, const iso_scene *scene, const char *what, iso_motion_level *on)
{
    const iso_effects effects = iso_scene_acting(scene);
    iso_orbit *orbit;
    ISO_TRY(iso_refuse_beyond_level(ctx, &effects, what));
    ISO_TRY(open_orbit(ctx, scene, &effects, &orbit));
    const iso_effects acting = iso_orbit_effects(orbit);
    const iso_point_motion m = iso_orbit_motion(orbit);
    iso_status status = iso_refuse_coupling(ctx, orbit, what);
    on->units = *iso_orbit_units(orbit);
    on->h = iso_orbit_energy(orbit) / iso_unit(&on->units, iso_dimension_h);
    on->energy = m.energy == 0 ? 0 : m.energy / m.eps;
    on->H = iso_effects_have_level(&acting) ? iso_coupling(&scene->params, iso_effects_level(&acting)) : 0;
    iso_orbit_free(orbit);
    return status;
}

iso_status iso_level_of_scene(iso_context *ctx, const iso_scene *scene, const char *what, double *level)
{
    iso_motion_level on;
    const iso_effects effects = iso_scene_acting(scene);
    const bool plain = scene->start.model == ISO_BALL && !iso_effects_have_level(&effects);
    *level = 0;
    const iso_status status =
        plain ? iso_refuse_beyond_level(ctx, &effects, what) : iso_level_find(ctx, scene, what, &on);
    if (status == ISO_OK && !plain) *level = iso_level_of(&on.units.own, on.energy);
    return status;
}
