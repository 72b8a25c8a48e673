/* scene_options.c - a scene with the options of the command line in it, and its orbit (see scene_options.h). */
#include "scene_options.h"

#include <math.h>
#include <string.h>

iso_status scene_with_options(iso_context *ctx, const scene_options *o, iso_scene *scene)
{
    const iso_status status = iso_scene_read(ctx, o->file, scene);
    if (status != ISO_OK) return status;
    if ((int)o->backend >= 0) scene->backend = o->backend;
    if ((int)o->as >= 0) scene->as = o->as, scene->columns = 0;
    if (o->method) snprintf(scene->method, sizeof scene->method, "%s", o->method);
    if (!isnan(o->tolerance)) scene->tolerance = o->tolerance;
    if (!isnan(o->end)) scene->end = o->end;
    if (!isnan(o->step)) scene->step = o->step;
    return iso_scene_check_times(ctx, scene);
}

int finish_scene(iso_context *ctx, const scene_options *o, const iso_scene *scene, iso_status status)
{
    const char *field = iso_context_field(ctx);
    const bool time = strcmp(field, "end") == 0 || strcmp(field, "step") == 0;
    const bool method = strcmp(field, "method") == 0 && o->method;
    const bool from_option = method || (time && (!isnan(o->end) || !isnan(o->step)));
    const char *name = strcmp(o->file, "-") == 0 ? "<stdin>" : o->file;
    return finish(ctx, from_option ? status : iso_scene_blame(ctx, scene, name, status));
}

iso_orbit_options options_for_columns(const iso_scene *scene, const int columns[], int count, iso_effects *effects)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    bool ball = false, point = false, M = false, attitude = false;
    for (int i = 0; i < count; i++) {
        attitude = attitude || iso_column_effect(columns[i]) == ISO_ATTITUDE;
        if (columns[i] < ISO_CLOCKS) o.carry[columns[i]] = true;
        ball = ball || (columns[i] >= ISO_COLUMN_BALL && columns[i] < ISO_COLUMN_POINT) ||
               columns[i] >= ISO_COLUMN_EFFECTS;
        point = point || (columns[i] >= ISO_COLUMN_POINT && columns[i] < ISO_COLUMN_EFFECTS);
        M = M || (columns[i] >= ISO_COLUMN_POINT && columns[i] < ISO_COLUMN_POINT + 3);
    }
    ball = ball || scene->effects.on[ISO_REACTIONS]; /* the loss of contact is looked for in the ball */
    *effects = scene->effects;                       /* some effects only add columns */
    effects->on[ISO_ATTITUDE] = effects->on[ISO_ATTITUDE] && attitude;
    o.effects = effects;
    o.show = ball && point ? ISO_BOTH : ball ? ISO_BALL : point ? ISO_POINT : scene->start.model;
    o.gamma_alone = point && !M;
    o.backend = scene->backend;
    o.method = iso_method_find(scene->method);
    o.tolerance = scene->tolerance;
    return o;
}

iso_status orbit_for_columns(iso_context *ctx, const iso_scene *scene, const int columns[], int count,
                             iso_orbit **orbit)
{
    iso_effects effects;
    const iso_orbit_options o = options_for_columns(scene, columns, count, &effects);
    return iso_orbit_create(ctx, &scene->params, &scene->start, &o, orbit);
}

bool not_interrupted(void *unused)
{
    (void)unused;
    return !interrupted();
}
