/* description_scene.c - the # lines of a table: the scene that it is of (see description.h). */
#include "base/arithmetic_impl.h"
#include "base/version.h"
#include "orbit/orbit_impl.h"

iso_status iso_record_describe_start(iso_context *ctx, iso_record *r, const iso_start *start)
{
    const bool ball = start->model == ISO_BALL;
    const iso_status status =
        iso_record_set_numbers(ctx, r, ball ? "initial.normal" : "initial.gamma", 3, start->y + 3);
    if (status != ISO_OK) return status;
    return iso_record_set_numbers(ctx, r, ball ? "initial.angular_velocity" : "initial.M", 3, start->y);
}

/* The scene's orbit, which knows h and eps. NULL: this orbit cannot be computed; the table may be of others. */
static iso_orbit *open_orbit(iso_context *ctx, const iso_scene *scene)
{
    iso_orbit *orbit = NULL;
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    o.effects = &scene->effects;
    return iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit) == ISO_OK ? orbit : NULL;
}

iso_status iso_record_describe_scene(iso_context *ctx, iso_record *r, const iso_scene *scene)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_orbit *orbit = open_orbit(ctx, scene);
    const char *model = iso_model_kind_name((int)scene->start.model);
    iso_status status = iso_record_describe(ctx, r, model, &scene->params, orbit);
    if (status == ISO_OK && !orbit) status = iso_record_describe_effects(ctx, r, &scene->effects);
    iso_orbit_free(orbit);
    if (status == ISO_OK) status = iso_record_describe_start(ctx, r, &scene->start);
    return status == ISO_OK ? iso_record_set(ctx, r, "isoroll", ISO_VERSION) : status;
}
