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
    const char *about = iso_context_about(ctx);
    const bool time = strcmp(about, "end") == 0 || strcmp(about, "step") == 0;
    const bool method = strcmp(about, "method") == 0 && o->method;
    const bool from_option = method || (time && (!isnan(o->end) || !isnan(o->step)));
    const char *name = strcmp(o->file, "-") == 0 ? "<stdin>" : o->file;
    return finish(ctx, from_option ? status : iso_scene_blame(ctx, scene, name, status));
}

bool not_interrupted(void *unused)
{
    (void)unused;
    return !interrupted();
}
