/* scene_options.c - a scene with the options of the command line in it, and its orbit (see scene_options.h). */
#include "scene_options.h"

#include <math.h>
#include <string.h>

#include "orbit/crossings.h"

/* What an option says does not stand in the file. Of end and step, a wrong one may be due to the other. */
static void forget_places(const scene_options *o, iso_scene *scene)
{
    if (o->method) iso_scene_forget_place(scene, "method");
    if (isnan(o->end) && isnan(o->step)) return;
    iso_scene_forget_place(scene, "end");
    iso_scene_forget_place(scene, "step");
}

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
    forget_places(o, scene);
    return iso_scene_check_times(ctx, scene);
}

int finish_scene(iso_context *ctx, const scene_options *o, const iso_scene *scene, iso_status status)
{
    const char *name = strcmp(o->file, "-") == 0 ? "<stdin>" : o->file;
    return finish(ctx, iso_scene_blame(ctx, scene, name, status));
}

iso_status read_axis(iso_context *ctx, const char *text, int *axis)
{
    *axis = ISO_AXIS_AUTO;
    if (!text || strcmp(text, "auto") == 0) return ISO_OK;
    *axis = text[0] - '1';
    if (strlen(text) == 1 && *axis >= 0 && *axis < 3) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, "", "--axis '%s': an axis is 1, 2 or 3, or auto: the global section",
                            text);
}

iso_status check_json_alone(iso_context *ctx, const char *name, const char *output, bool json)
{
    if (!json || !output || strcmp(output, "-") != 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "output",
                            "%s: -o - and --json both write to standard output: choose one", name);
}

bool not_interrupted(void *unused)
{
    (void)unused;
    return !interrupted();
}
