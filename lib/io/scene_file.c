/* scene_file.c - reads a scene: parses the text, checks what must hold between keys, and lets the library check the
 * physics. A failure is reported at its line and column. */
#include "io/scene_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "io/scene_draft_impl.h"
#include "io/text_impl.h"
#include "orbit/orbit_impl.h"

/* ---- What must hold between keys ---- */

/* The key and value of mapping -> section (-> name if not NULL). */
static bool find_key(iso_draft *d, const yaml_node_t *mapping, const char *section, const char *name,
                     const yaml_node_t **key, const yaml_node_t **value)
{
    if (!name) return iso_yaml_find(&d->yaml, mapping, section, key, value);
    return iso_yaml_find(&d->yaml, mapping, section, NULL, &mapping) &&
           iso_yaml_find(&d->yaml, mapping, name, key, value);
}

/* Exactly one of ball (with surface), reduced and point. */
static iso_status check_sections(iso_draft *d, const char **model)
{
    static const char *const models[] = {"ball", "reduced", "point"};
    const yaml_node_t *key, *surface, *last = NULL;
    *model = NULL;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        if (!find_key(d, d->root, models[i], NULL, &key, NULL)) continue;
        if (*model)
            return ISO_FAIL_AT(d, key->start_mark.index > last->start_mark.index ? key : last,
                               "'%s' and '%s' both: a scene has one of 'ball', 'reduced' and 'point'", *model,
                               models[i]);
        *model = models[i];
        last = key;
    }
    const bool has_surface = find_key(d, d->root, "surface", NULL, &surface, NULL);
    if (has_surface && !*model) return ISO_FAIL_AT(d, surface, "'surface' needs a 'ball' that rolls on it");
    if (!*model) return ISO_FAIL_AT(d, d->root, "missing 'ball' and 'surface' (or 'reduced', or 'point')");
    const bool ball = strcmp(*model, "ball") == 0;
    if (ball && !has_surface)
        return ISO_FAIL_AT(d, last, "'ball' needs a 'surface', such as 'surface: {kind: plane}'");
    if (!ball && has_surface)
        return ISO_FAIL_AT(d, surface, "'surface' goes with 'ball'; '%s' has its k instead", *model);
    return ISO_OK;
}

static iso_status check_surface(iso_draft *d)
{
    const yaml_node_t *surface, *radius;
    if (!find_key(d, d->root, "surface", NULL, &surface, NULL)) return ISO_OK;
    const bool has_radius = find_key(d, d->root, "surface", "radius", &radius, NULL), plane = d->surface == ISO_PLANE;
    if (plane && has_radius) return ISO_FAIL_AT(d, radius, "a plane has no 'radius': take it out");
    if (!plane && !has_radius)
        return ISO_FAIL_AT(d, surface, "missing 'radius' in 'surface': that of the fixed sphere");
    return ISO_OK;
}

/* `initial` states the start of the scene's model and nothing of the other's. */
static iso_status check_initial(iso_draft *d, iso_model_kind model)
{
    static const char *const keys[2][2] = {[ISO_BALL] = {"normal", "angular_velocity"}, [ISO_POINT] = {"gamma", "M"}};
    const yaml_node_t *initial, *key;
    find_key(d, d->root, "initial", NULL, &initial, NULL);
    for (int i = 0; i < 4; i++) {
        const iso_model_kind whose = i < 2 ? ISO_BALL : ISO_POINT;
        const char *name = keys[whose][i % 2], *what = model == ISO_BALL
                                                           ? "a ball starts from 'normal' and 'angular_velocity'"
                                                           : "a point starts from 'gamma' and 'M'";
        const bool present = find_key(d, d->root, "initial", name, &key, NULL);
        if (whose == model && !present) return ISO_FAIL_AT(d, initial, "missing '%s' in 'initial': %s", name, what);
        if (whose != model && present) return ISO_FAIL_AT(d, key, "'%s' does not belong here: %s", name, what);
    }
    return ISO_OK;
}

/* ---- Physics: the checks are the library's, the places are the file's ---- */

/* Repeats the last failure at the value it is about, or at the section's key when that value is not written. */
static iso_status fail_at_field(iso_draft *d, iso_status status, const char *section)
{
    const char *about = iso_context_about(d->yaml.ctx);
    const yaml_node_t *place = d->root;
    if (status != ISO_BAD_INPUT) return status;
    if (strcmp(about, "surface_radius") == 0) section = "surface", about = "radius";
    if (strcmp(about, "eps") == 0) section = "point";
    if (!find_key(d, d->root, section, about, NULL, &place)) find_key(d, d->root, section, NULL, &place, NULL);
    return ISO_FAIL_AT(d, place, "%s", iso_context_message(d->yaml.ctx));
}

static iso_status make_params(iso_draft *d, const char *model)
{
    iso_context *ctx = d->yaml.ctx;
    iso_params *p = &d->scene.params;
    d->body.surface = (iso_surface)d->surface;
    iso_status status =
        strcmp(model, "ball") == 0 ? iso_params_physical(ctx, &d->body, p) : iso_params_reduced(ctx, d->k, d->J, p);
    if (status != ISO_OK) return fail_at_field(d, status, model);
    if (!isnan(d->D)) /* it is written: of a reduced ball, as a ball has its own */
        status = p->D > 0 ? ISO_FAIL_INPUT(ctx, "D", "this ball's D = m b^2 is known: take it out")
                          : iso_params_set_D(ctx, d->D, p);
    return iso_scene_blame(ctx, &d->scene, d->yaml.name, status);
}

/* The section of one effect, for its row's questions. */
typedef struct effect_section {
    iso_draft *d;
    const yaml_node_t *effects;
    const char *name;
} effect_section;

static bool effect_has_key(const void *scene, const char *key)
{
    const effect_section *s = scene;
    return find_key(s->d, s->effects, s->name, key, NULL, NULL);
}

/* What an effect says of the ball in the scene's words becomes its numbers. A failure is put at the key it is about, or
 * at that of the effect where it is about a key that is not there. */
static iso_status make_effects(iso_draft *d, iso_model_kind model)
{
    const yaml_node_t *effects, *key;
    if (!find_key(d, d->root, "effects", NULL, NULL, &effects)) return ISO_OK;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        if (!d->scene.effects.on[e]) continue;
        const effect_section section = {d, effects, effect->name};
        const iso_status status = !effect->complete
                                      ? ISO_OK
                                      : effect->complete(d->yaml.ctx, &d->scene.params, model == ISO_POINT,
                                                         d->scene.effects.number[e], effect_has_key, &section);
        if (status == ISO_BAD_INPUT) {
            if (!find_key(d, effects, effect->name, iso_context_about(d->yaml.ctx), &key, NULL))
                find_key(d, effects, effect->name, NULL, &key, NULL);
            return ISO_FAIL_AT(d, key, "%s", iso_context_message(d->yaml.ctx));
        }
        ISO_TRY(status);
        if (effect->expressions) ISO_TRY(iso_draft_check_expressions(d, e, effects));
    }
    return ISO_OK;
}

static iso_status make_start(iso_draft *d, iso_model_kind model)
{
    iso_scene *s = &d->scene;
    const iso_spin spin = d->project                       ? ISO_SPIN_REMOVE
                          : iso_effects_twist(&s->effects) ? ISO_SPIN_KEEP
                                                           : ISO_SPIN_REFUSE;
    const double *eps = find_key(d, d->root, "point", "eps", NULL, NULL) ? &d->eps : NULL;
    const iso_status status = model == ISO_BALL
                                  ? iso_start_ball(d->yaml.ctx, d->angular_velocity, d->normal, spin, &s->start)
                                  : iso_start_point(d->yaml.ctx, d->M, d->gamma, eps, d->project, &s->start);
    if (status == ISO_OK) return status;
    return fail_at_field(d, status, "initial");
}

iso_status iso_draft_make(iso_draft *d)
{
    const char *name;
    const yaml_node_t *step;
    iso_scene *s = &d->scene;
    ISO_TRY(check_sections(d, &name));
    const iso_model_kind model = strcmp(name, "point") == 0 ? ISO_POINT : ISO_BALL;
    ISO_TRY(check_surface(d));
    ISO_TRY(check_initial(d, model));
    if (find_key(d, d->root, "time", "step", NULL, &step) && !(fabs(s->end) / s->step <= ISO_MOST_ROWS))
        return ISO_FAIL_AT(d, step, "a step of %s to the end %s is more than %s rows: give a larger 'step'",
                           ISO_SHORT(s->step), ISO_SHORT(s->end), ISO_SHORT(ISO_MOST_ROWS));
    ISO_TRY(make_params(d, name));
    ISO_TRY(make_effects(d, model));
    ISO_TRY(make_start(d, model));
    s->backend = (iso_backend)d->backend;
    s->as = (iso_models)d->as;
    return iso_scene_blame(d->yaml.ctx, s, d->yaml.name, iso_scene_check_columns(d->yaml.ctx, s));
}

iso_draft iso_draft_empty(iso_context *ctx, const char *name)
{
    iso_draft d = {.yaml = {.ctx = ctx, .name = name}, .backend = ISO_BACKEND_AUTO, .as = ISO_SHOW_START};
    d.scene = iso_scene_default();
    d.D = NAN;
    return d;
}

/* literals: NULL, or gets the numbers as they are written. */
static iso_status parse(iso_context *ctx, const char *name, const char *text, size_t length, iso_scene *scene,
                        iso_literals *literals)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_draft d = iso_draft_empty(ctx, name);
    ISO_TRY(iso_yaml_load(&d.yaml, text, length));
    d.root = yaml_document_get_root_node(&d.yaml.document);
    iso_status status = iso_draft_read_keys(&d);
    if (status == ISO_OK) status = iso_draft_make(&d);
    if (status == ISO_OK && literals) status = iso_draft_literals(&d, literals);
    iso_yaml_free(&d.yaml);
    if (status == ISO_OK) *scene = d.scene;
    return status;
}

iso_status iso_scene_load_text(iso_context *ctx, const char *name, const char *text, size_t length, iso_scene *scene)
{
    return parse(ctx, name, text, length, scene, NULL);
}

iso_status iso_scene_change(iso_context *ctx, const char *text, iso_scene *scene)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_draft d = iso_draft_empty(ctx, "change");
    ISO_TRY(iso_yaml_load(&d.yaml, text, strlen(text)));
    d.root = yaml_document_get_root_node(&d.yaml.document);
    d.scene = *scene;
    d.backend = (int)scene->backend;
    d.as = (int)scene->as;
    iso_status status = iso_draft_read_changes(&d);
    iso_yaml_free(&d.yaml);
    d.scene.backend = (iso_backend)d.backend;
    d.scene.as = (iso_models)d.as;
    d.scene.places = scene->places; /* the change has none in the file */
    if (status == ISO_OK) status = iso_scene_check_columns(ctx, &d.scene);
    if (status == ISO_OK) *scene = d.scene;
    return status;
}

iso_status iso_scene_read_literals(iso_context *ctx, const char *path, iso_scene *scene, iso_literals *literals)
{
    char *text;
    size_t length;
    ISO_TRY(iso_text_load(ctx, path, &text, &length));
    const iso_status status = parse(ctx, iso_text_name(path), text, length, scene, literals);
    free(text);
    return status;
}

iso_status iso_scene_load(iso_context *ctx, const char *path, iso_scene *scene)
{
    return iso_scene_read_literals(ctx, path, scene, NULL);
}
