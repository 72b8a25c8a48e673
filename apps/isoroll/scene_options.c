/* scene_options.c - failures of commands that read a scene (see scene_options.h). */
#include "scene_options.h"

#include <string.h>

int finish_scene(iso_context *ctx, const char *file, const iso_scene *scene, iso_status status)
{
    return finish(ctx, iso_scene_blame(ctx, scene, iso_text_name(file), status));
}

iso_status check_json_alone(iso_context *ctx, const char *name, const char *output, bool json)
{
    if (!json || !output || strcmp(output, "-") != 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "output",
                            "%s: -o - and --json both write to standard output: choose one", name);
}
