/* scene_options.c - failures of commands that read a scene (see scene_options.h). */
#include "scene_options.h"

int finish_scene(iso_context *ctx, const char *file, const iso_scene *scene, iso_status status)
{
    return finish(ctx, iso_scene_blame(ctx, scene, iso_text_name(file), status));
}
