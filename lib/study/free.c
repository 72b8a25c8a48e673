/* free.c - refuses motions that are not free (see free_impl.h). */
#include "study/free_impl.h"

#include <string.h>

const iso_effect *iso_study_not_free(const iso_effects *effects)
{
    const iso_effect *effect = iso_effects_beyond_level(effects);
    if (effect || !iso_effects_have_level(effects)) return effect;
    return iso_effect_list[iso_effect_find(iso_level_name())];
}

iso_status iso_study_check_free(iso_context *ctx, const iso_effects *effects, const char *what)
{
    const iso_effect *effect = effects ? iso_study_not_free(effects) : NULL;
    if (!effect) return ISO_OK;
    if (strcmp(effect->name, iso_level_name()) == 0)
        return iso_context_fail(
            ctx, ISO_BAD_INPUT, effect->name,
            "%s only of the free ball and of the point on H = 0; this start has another H (another level)", what);
    return iso_context_fail(ctx, ISO_BAD_INPUT, effect->name,
                            "%s only of the free ball and of the point on H = 0: remove '%s'", what, effect->name);
}

iso_status iso_study_check_free_start(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                                      const char *what)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    iso_orbit *orbit;
    o.effects = effects;
    o.gamma_alone = true; /* M need not fit a double */
    const iso_status status = iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit);
    if (status != ISO_OK) return status;
    const iso_effects found = iso_orbit_effects(orbit);
    iso_orbit_free(orbit);
    return iso_study_check_free(ctx, &found, what);
}

iso_status iso_study_motion(iso_context *ctx, const iso_scene *scene, const char *what, iso_params *own,
                            iso_point_motion *motion)
{
    const iso_effects effects = iso_scene_acting(scene);
    const iso_effect *effect = iso_effects_beyond_level(&effects);
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    iso_orbit *orbit;
    if (effect)
        return iso_context_fail(ctx, ISO_BAD_INPUT, effect->name,
                                "%s only of motions on which nothing acts but a level: remove '%s'", what,
                                effect->name);
    o.effects = &effects;
    o.gamma_alone = true; /* M need not fit a double */
    const iso_status status = iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit);
    if (status != ISO_OK) return status;
    *own = iso_orbit_units(orbit)->own;
    *motion = iso_orbit_motion(orbit);
    motion->p = own;
    iso_orbit_free(orbit);
    return ISO_OK;
}
