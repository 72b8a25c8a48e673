/* scene.c - scenes behind a pointer: read, copied, changed key by key, and asked for their numbers and words. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/nearest.h"
#include "base/number.h"
#include "foreign/foreign_impl.h"
#include "io/scene_file.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"

static iso_status create(iso_context *ctx, const char *name, iso_foreign_scene **scene)
{
    iso_foreign_scene *s = calloc(1, sizeof *s);
    *scene = NULL;
    if (s) s->name = strdup(name);
    if (!s || !s->name) return free(s), iso_context_no_memory(ctx, "a scene");
    *scene = s;
    return ISO_OK;
}

void iso_foreign_scene_free(iso_foreign_scene *scene)
{
    if (!scene) return;
    free(scene->name);
    free(scene);
}

/* Gives the scene away, or releases it. */
static iso_status give(iso_status status, iso_foreign_scene **scene)
{
    if (status == ISO_OK) return status;
    iso_foreign_scene_free(*scene);
    *scene = NULL;
    return status;
}

iso_status iso_foreign_scene_read(iso_context *ctx, const char *path, iso_foreign_scene **scene)
{
    const iso_status status = create(ctx, strcmp(path, "-") == 0 ? "<stdin>" : path, scene);
    return status == ISO_OK ? give(iso_scene_read(ctx, path, &(*scene)->scene), scene) : status;
}

iso_status iso_foreign_scene_parse(iso_context *ctx, const char *name, const char *text, size_t length,
                                   iso_foreign_scene **scene)
{
    const iso_status status = create(ctx, name, scene);
    return status == ISO_OK ? give(iso_scene_parse(ctx, name, text, length, &(*scene)->scene), scene) : status;
}

iso_status iso_foreign_scene_copy(iso_context *ctx, const iso_foreign_scene *from, iso_foreign_scene **scene)
{
    const iso_status status = create(ctx, from->name, scene);
    if (status == ISO_OK) (*scene)->scene = from->scene;
    return status;
}

iso_status iso_foreign_blame(iso_context *ctx, const iso_foreign_scene *scene, iso_status status)
{
    return iso_scene_blame(ctx, &scene->scene, scene->name, status);
}

/* --- changes ---------------------------------------------------------------------------------------------------- */

static iso_status set_word(iso_context *ctx, iso_scene *scene, const char *key, const char *value)
{
    const bool backend = strcmp(key, "backend") == 0;
    int number;
    const iso_status status = iso_foreign_word(ctx, key, backend ? iso_backend_name : iso_shown_name, value, &number);
    if (status != ISO_OK) return status;
    if (backend)
        scene->backend = (iso_backend)number;
    else
        scene->as = (iso_models)number, scene->columns = 0;
    return ISO_OK;
}

static iso_status set_method(iso_context *ctx, iso_scene *scene, const char *value)
{
    const iso_status status = iso_method_check(ctx, value);
    if (status == ISO_OK) snprintf(scene->method, sizeof scene->method, "%s", value);
    return status;
}

static iso_status set_number(iso_context *ctx, iso_scene *scene, const char *key, const char *value)
{
    double x;
    if (!iso_number_read(value, strlen(value), &x))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, key, "%s is '%s', it must be a finite number", key, value);
    if (strcmp(key, "tolerance") == 0) {
        const iso_status status = iso_tolerance_check(ctx, x);
        if (status == ISO_OK) scene->tolerance = x;
        return status;
    }
    if (strcmp(key, "step") == 0 && x <= 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, key, "step is %g, it must be above 0", x);
    if (strcmp(key, "end") == 0)
        scene->end = x;
    else
        scene->step = x;
    iso_scene_forget_place(scene, "end"); /* of end and step, a wrong one may be due to the other */
    iso_scene_forget_place(scene, "step");
    return ISO_OK; /* the two together are checked by a run: they are set one after the other */
}

static iso_status set_columns(iso_context *ctx, iso_scene *scene, const char *value)
{
    if (!*value) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "columns", "there are no columns in the list");
    scene->columns = 0;
    for (const char *at = value; *at; at += *at == ',') {
        const size_t length = strcspn(at, ",");
        char name[ISO_NAME_SIZE] = "", suggested[ISO_SUGGEST_SIZE];
        if (length < sizeof name) memcpy(name, at, length);
        if (iso_column_find(name) < 0)
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "columns", "there is no column '%.*s'; %s",
                                    length < 100 ? (int)length : 100, at,
                                    iso_suggest_word(suggested, name, iso_column_name));
        for (size_t i = 0; i < scene->columns; i++)
            if (strcmp(scene->column[i], name) == 0)
                return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "columns", "column '%s' appears twice", name);
        if (scene->columns == ISO_MAX_COLUMNS)
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "columns", "there are more than %d", ISO_MAX_COLUMNS);
        memcpy(scene->column[scene->columns++], name, sizeof name);
        at += length;
    }
    return iso_scene_check_columns(ctx, scene);
}

iso_status iso_foreign_scene_set(iso_context *ctx, iso_foreign_scene *scene, const char *key, const char *value)
{
    iso_scene changed = scene->scene;
    iso_status status = ISO_OK;
    iso_scene_forget_place(&changed, key);
    if (strcmp(key, "backend") == 0 || strcmp(key, "as") == 0)
        status = set_word(ctx, &changed, key, value);
    else if (strcmp(key, "method") == 0)
        status = set_method(ctx, &changed, value);
    else if (strcmp(key, "tolerance") == 0 || strcmp(key, "end") == 0 || strcmp(key, "step") == 0)
        status = set_number(ctx, &changed, key, value);
    else if (strcmp(key, "columns") == 0)
        status = set_columns(ctx, &changed, value);
    else
        status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, key,
                                  "'%s' is no key that can be changed: backend, method, tolerance, end, step, as, "
                                  "columns",
                                  key);
    if (status == ISO_OK) scene->scene = changed;
    return status == ISO_BAD_INPUT ? ISO_BAD_ARGUMENT : status; /* it is the call that is wrong, no file */
}

/* --- questions -------------------------------------------------------------------------------------------------- */

int iso_foreign_scene_numbers(const iso_foreign_scene *scene, const char *key, double values[6])
{
    const iso_scene *s = &scene->scene;
    const double eps = s->start.model == ISO_POINT ? s->start.eps : NAN;
    const struct {
        const char *key;
        int count;
        const double *from;
    } rows[] = {
        {"k", 1, &s->params.k}, {"J", 3, s->params.J}, {"D", 1, &s->params.D}, {"start", 6, s->start.y},
        {"eps", 1, &eps},       {"end", 1, &s->end},   {"step", 1, &s->step},  {"tolerance", 1, &s->tolerance}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(rows[i].key, key) == 0) {
            memcpy(values, rows[i].from, (size_t)rows[i].count * sizeof *values);
            return rows[i].count;
        }
    return 0;
}

const char *iso_foreign_scene_word(const iso_foreign_scene *scene, const char *key)
{
    const iso_scene *s = &scene->scene;
    if (strcmp(key, "model") == 0) return iso_model_kind_name((int)s->start.model);
    if (strcmp(key, "backend") == 0) return iso_backend_name((int)s->backend);
    if (strcmp(key, "method") == 0) return s->method;
    if (strcmp(key, "as") == 0) return iso_shown_name((int)s->as);
    return strcmp(key, "name") == 0 ? scene->name : NULL;
}

int iso_foreign_scene_columns(const iso_foreign_scene *scene, int columns[])
{
    return iso_scene_columns(&scene->scene, columns);
}
