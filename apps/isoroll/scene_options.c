/* scene_options.c - a scene with the options of the command line in it, and its orbit (see scene_options.h). */
#include "scene_options.h"

#include <math.h>
#include <string.h>

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
    ISO_TRY(iso_scene_read(ctx, o->file, scene));
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
    return finish(ctx, iso_scene_blame(ctx, scene, iso_text_name(o->file), status));
}

iso_status check_json_alone(iso_context *ctx, const char *name, const char *output, bool json)
{
    if (!json || !output || strcmp(output, "-") != 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "output",
                            "%s: -o - and --json both write to standard output: choose one", name);
}

/* --- effects ---------------------------------------------------------------------------------------------------- */

/* The numbers of an effect, on a line of their own or not; none that a scene alone states. */
static void print_numbers(const iso_effects *effects, iso_effect_id id, const char *begin)
{
    for (const iso_effect_number *n = iso_effect_list[id]->numbers; n && n->name; n++) {
        if (n->scene_only) continue;
        const double *x = iso_effect_values(effects, id, n);
        printf("%s  %s =", begin, n->name);
        for (int i = 0; i < n->count; i++) printf(" %.10g", x[i]);
        begin = "";
    }
}

void print_effects(const iso_effects *effects, bool docs)
{
    char line[32];
    int shown = 0;
    snprintf(line, sizeof line, "\n  %-18s", "");
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        if (!effects->on[e]) continue;
        printf("%s  %-18s", shown++ ? "" : "effects\n", iso_effect_list[e]->name);
        if (docs) printf(" %s", iso_effect_list[e]->doc);
        print_numbers(effects, e, docs ? line : "");
        printf("\n");
    }
    if (shown) printf("\n");
}
