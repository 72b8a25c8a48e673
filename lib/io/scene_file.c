#include "io/scene_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "io/scene_draft_impl.h"
#include "io/text_impl.h"

enum { LARGEST_FILE = 16 << 20 };

/* ---- What must hold between keys ---- */

/* The key and value of root -> section (-> name if not NULL). */
static bool find(iso_draft *d, const char *section, const char *name, const yaml_node_t **key,
                 const yaml_node_t **value)
{
    const yaml_node_t *mapping;
    if (!name) return iso_yaml_find(&d->yaml, d->root, section, key, value);
    return iso_yaml_find(&d->yaml, d->root, section, NULL, &mapping) &&
           iso_yaml_find(&d->yaml, mapping, name, key, value);
}

/* The key of effects -> effect -> name. */
static bool find_effect_key(iso_draft *d, const yaml_node_t *effects, const char *effect, const char *name,
                            const yaml_node_t **key)
{
    const yaml_node_t *mapping;
    return iso_yaml_find(&d->yaml, effects, effect, NULL, &mapping) &&
           iso_yaml_find(&d->yaml, mapping, name, key, NULL);
}

/* Exactly one of ball (with surface), reduced and point. */
static iso_status check_sections(iso_draft *d, const char **model)
{
    static const char *const models[] = {"ball", "reduced", "point"};
    const yaml_node_t *key, *surface, *last = NULL;
    *model = NULL;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        if (!find(d, models[i], NULL, &key, NULL)) continue;
        if (*model)
            return iso_yaml_fail(
                &d->yaml, key->start_mark.index > last->start_mark.index ? key->start_mark : last->start_mark,
                "'%s' and '%s' both: a scene has one of 'ball', 'reduced' and 'point'", *model, models[i]);
        *model = models[i];
        last = key;
    }
    const bool has_surface = find(d, "surface", NULL, &surface, NULL);
    if (has_surface && !*model)
        return iso_yaml_fail(&d->yaml, surface->start_mark, "'surface' needs a 'ball' that rolls on it");
    if (!*model)
        return iso_yaml_fail(&d->yaml, d->root->start_mark,
                             "missing 'ball' and 'surface' (or 'reduced', or 'point')");
    const bool ball = strcmp(*model, "ball") == 0;
    if (ball && !has_surface)
        return iso_yaml_fail(&d->yaml, last->start_mark,
                             "'ball' needs a 'surface', such as 'surface: {kind: plane}'");
    if (!ball && has_surface)
        return iso_yaml_fail(&d->yaml, surface->start_mark, "'surface' goes with 'ball'; '%s' has its k instead",
                             *model);
    return ISO_OK;
}

static iso_status check_surface(iso_draft *d)
{
    const yaml_node_t *surface, *radius;
    if (!find(d, "surface", NULL, &surface, NULL)) return ISO_OK;
    const bool has_radius = find(d, "surface", "radius", &radius, NULL), plane = d->surface == ISO_PLANE;
    if (plane && has_radius)
        return iso_yaml_fail(&d->yaml, radius->start_mark, "a plane has no 'radius': take it out");
    if (!plane && !has_radius)
        return iso_yaml_fail(&d->yaml, surface->start_mark,
                             "missing 'radius' in 'surface': that of the fixed sphere");
    return ISO_OK;
}

/* `initial` states the start of the scene's model and nothing of the other's. */
static iso_status check_initial(iso_draft *d, iso_picture model)
{
    const yaml_node_t *initial, *key;
    const char *what = model == ISO_BALL ? "a ball starts from 'normal' and 'angular_velocity'"
                                         : "a point starts from 'gamma' and 'M'";
    const char *name;
    iso_picture whose;
    find(d, "initial", NULL, &initial, NULL);
    for (int i = 0; iso_draft_initial_key(i, &name, &whose); i++) {
        const bool present = find(d, "initial", name, &key, NULL);
        if (whose == model && !present)
            return iso_yaml_fail(&d->yaml, initial->start_mark, "missing '%s' in 'initial': %s", name, what);
        if (whose != model && whose != ISO_BOTH && present)
            return iso_yaml_fail(&d->yaml, key->start_mark, "'%s' does not belong here: %s", name, what);
    }
    return ISO_OK;
}

static iso_status check_time(iso_draft *d)
{
    const yaml_node_t *step;
    if (!find(d, "time", "step", NULL, &step) || fabs(d->scene.end) / d->scene.step <= ISO_MOST_ROWS) return ISO_OK;
    return iso_yaml_fail(&d->yaml, step->start_mark,
                         "a step of %g to the end %g is more than %g rows: give a larger 'step'", d->scene.step,
                         d->scene.end, ISO_MOST_ROWS);
}

/* ---- Physics: the checks are the library's, the places are the file's ---- */

/* Values that a failure calls otherwise than the scene, or that stand in another section than the rest. */
static const struct {
    const char *field, *section, *key;
} elsewhere[] = {{"surface_radius", "surface", "radius"}, {"eps", "point", "eps"}};

/* Repeats the last failure at the value it is about, or at the section's key when that value is not written. */
static iso_status fail_at_field(iso_draft *d, iso_status status, const char *section)
{
    const char *field = iso_context_field(d->yaml.ctx);
    const yaml_node_t *place = d->root;
    if (status != ISO_BAD_INPUT) return status;
    for (size_t i = 0; i < sizeof elsewhere / sizeof *elsewhere; i++)
        if (strcmp(field, elsewhere[i].field) == 0) section = elsewhere[i].section, field = elsewhere[i].key;
    if (!find(d, section, field, NULL, &place)) find(d, section, NULL, &place, NULL);
    return iso_yaml_fail(&d->yaml, place->start_mark, "%s", iso_context_message(d->yaml.ctx));
}

static iso_status make_params(iso_draft *d, const char *model)
{
    d->body.surface = (iso_surface)d->surface;
    const iso_status status = strcmp(model, "ball") == 0
                                  ? iso_params_physical(d->yaml.ctx, &d->body, &d->scene.params)
                                  : iso_params_reduced(d->yaml.ctx, d->k, d->J, &d->scene.params);
    return status == ISO_OK ? status : fail_at_field(d, status, model);
}

/* D of a reduced ball, where it is written; a ball has its own. */
static iso_status make_D(iso_draft *d)
{
    if (isnan(d->D)) return ISO_OK;
    iso_status status;
    if (d->scene.params.D > 0)
        status = iso_context_fail(d->yaml.ctx, ISO_BAD_INPUT, "D", "this ball's D = m b^2 is known: take it out");
    else
        status = iso_params_set_D(d->yaml.ctx, d->D, &d->scene.params);
    return iso_scene_blame(d->yaml.ctx, &d->scene, d->yaml.name, status);
}

/* What effects say in words of the ball: g of a body, mgb of a reduced one; c that a point's energy gives. */
static iso_status make_effects(iso_draft *d, iso_picture model)
{
    iso_effects *e = &d->scene.effects;
    const iso_params *p = &d->scene.params;
    const bool body = p->body.surface != ISO_REDUCED;
    const yaml_node_t *effects, *key;
    if (!find(d, "effects", NULL, NULL, &effects)) return ISO_OK;
    if (e->on[ISO_GRAVITY]) {
        const double b = iso_params_sign_of_radius(p) * p->body.radius;
        const char *wanted = body ? "g" : "mgb", *other = body ? "mgb" : "g";
        if (find_effect_key(d, effects, "gravity", other, &key))
            return iso_yaml_fail(&d->yaml, key->start_mark, "'%s' does not belong here: %s, give '%s'", other,
                                 body ? "the ball's mass and radius are known" : "k and J know no mass", wanted);
        if (!find_effect_key(d, effects, "gravity", wanted, &key)) {
            iso_yaml_find(&d->yaml, effects, "gravity", &key, NULL);
            return iso_yaml_fail(&d->yaml, key->start_mark, "missing '%s' in 'gravity'", wanted);
        }
        if (body) e->mgb = p->body.mass * d->g * b;
        if (!isfinite(e->mgb))
            return iso_yaml_fail(&d->yaml, key->start_mark,
                                 "the weight m g times the radius b does not fit a double");
    }
    if (e->on[ISO_FIELD] && !find_effect_key(d, effects, "field", "quadratic", NULL) &&
        !find_effect_key(d, effects, "field", "linear", NULL)) {
        iso_yaml_find(&d->yaml, effects, "field", &key, NULL);
        return iso_yaml_fail(&d->yaml, key->start_mark, "missing 'quadratic' or 'linear' in 'field'");
    }
    if (e->on[ISO_LEVEL] && model == ISO_BALL && isnan(e->level)) {
        iso_yaml_find(&d->yaml, effects, "level", &key, NULL);
        return iso_yaml_fail(&d->yaml, key->start_mark, "missing 'c' in 'level': a ball's energy does not tell it");
    }
    return ISO_OK;
}

static iso_status make_start(iso_draft *d, iso_picture model)
{
    iso_scene *s = &d->scene;
    const iso_spin spin = s->effects.on[ISO_TWIST] && !d->project ? ISO_SPIN_KEEP
                          : d->project                            ? ISO_SPIN_REMOVE
                                                                  : ISO_SPIN_REFUSE;
    const double *eps = find(d, "point", "eps", NULL, NULL) ? &d->eps : NULL;
    const iso_status status = model == ISO_BALL
                                  ? iso_start_ball(d->yaml.ctx, d->angular_velocity, d->normal, spin, &s->start)
                                  : iso_start_point(d->yaml.ctx, d->M, d->gamma, eps, d->project, &s->start);
    if (status == ISO_OK) return status;
    return fail_at_field(d, status, "initial");
}

static iso_status make_scene(iso_draft *d)
{
    const char *name;
    iso_status status = iso_draft_read_keys(d);
    if (status == ISO_OK) status = check_sections(d, &name);
    if (status != ISO_OK) return status;
    const iso_picture model = strcmp(name, "point") == 0 ? ISO_POINT : ISO_BALL;
    if ((status = check_surface(d)) != ISO_OK) return status;
    if ((status = check_initial(d, model)) != ISO_OK) return status;
    if ((status = check_time(d)) != ISO_OK) return status;
    if ((status = make_params(d, name)) != ISO_OK) return status;
    if ((status = make_D(d)) != ISO_OK) return status;
    if ((status = make_effects(d, model)) != ISO_OK) return status;
    if ((status = make_start(d, model)) != ISO_OK) return status;
    d->scene.backend = (iso_picture)d->backend;
    d->scene.as = (iso_picture)d->as;
    return iso_scene_blame(d->yaml.ctx, &d->scene, d->yaml.name, iso_scene_check_columns(d->yaml.ctx, &d->scene));
}

iso_status iso_scene_parse(iso_context *ctx, const char *name, const char *text, size_t length, iso_scene *scene)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_draft d = {.yaml = {.ctx = ctx, .name = name}, .backend = ISO_AUTO, .as = ISO_AUTO};
    d.scene = iso_scene_default();
    d.scene.effects.level = d.D = d.g = NAN;
    d.scene.effects.quaternion[0] = 1;
    iso_status status = iso_yaml_load(&d.yaml, text, length);
    if (status != ISO_OK) return status;
    d.root = yaml_document_get_root_node(&d.yaml.document);
    status = make_scene(&d);
    iso_yaml_free(&d.yaml);
    if (status == ISO_OK) *scene = d.scene;
    return status;
}

iso_status iso_scene_read(iso_context *ctx, const char *path, iso_scene *scene)
{
    char *text;
    size_t length;
    iso_status status = iso_text_load(ctx, path, LARGEST_FILE, &text, &length);
    if (status != ISO_OK) return status;
    status = iso_scene_parse(ctx, iso_text_name(path), text, length, scene);
    free(text);
    return status;
}
