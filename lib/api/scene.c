/* scene.c - scenes behind a pointer: read, copied, changed key by key, and asked for their numbers and words. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/interface_impl.h"
#include "base/arithmetic_impl.h"
#include "io/scene_draft_impl.h"
#include "io/scene_file.h"
#include "io/scene_print_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

/* A scene, with its name behind it. */
static iso_status create(iso_context *ctx, const char *name, iso_scene **scene)
{
    const size_t length = strlen(name) + 1;
    iso_scene *s = *scene = calloc(1, sizeof *s + length);
    if (!s) return iso_context_no_memory(ctx, "a scene");
    s->name = memcpy(s + 1, name, length);
    return ISO_OK;
}

void iso_scene_free(iso_scene *scene)
{
    free(scene);
}

/* Gives the scene its name, which reading has forgotten, or releases it. */
static iso_status finish(iso_status status, iso_scene **scene)
{
    if (status == ISO_OK) return (*scene)->name = (const char *)(*scene + 1), status;
    iso_scene_free(*scene);
    *scene = NULL;
    return status;
}

iso_status iso_scene_read(iso_context *ctx, const char *path, iso_scene **scene)
{
    ISO_TRY(create(ctx, strcmp(path, "-") == 0 ? "<stdin>" : path, scene));
    return finish(iso_scene_load(ctx, path, *scene), scene);
}

iso_status iso_scene_parse(iso_context *ctx, const char *name, const char *text, size_t length, iso_scene **scene)
{
    ISO_TRY(create(ctx, name, scene));
    return finish(iso_scene_load_text(ctx, name, text, length, *scene), scene);
}

iso_status iso_scene_copy(iso_context *ctx, const iso_scene *from, iso_scene **scene)
{
    ISO_TRY(create(ctx, from->name, scene));
    **scene = *from;
    return finish(ISO_OK, scene);
}

iso_status iso_blame_scene(iso_context *ctx, const iso_scene *scene, iso_status status)
{
    return iso_scene_blame(ctx, scene, scene->name, status);
}

/* --- changes ---------------------------------------------------------------------------------------------------- */

iso_status iso_scene_set(iso_context *ctx, iso_scene *scene, const char *key, const char *value)
{
    const size_t room = strlen(key) + strlen(value) + sizeof ": []";
    const bool time = strcmp(key, "end") == 0 || strcmp(key, "step") == 0;
    char *text = malloc(room);
    if (!text) return iso_context_no_memory(ctx, "a scene");
    snprintf(text, room, strcmp(key, "columns") == 0 ? "%s: [%s]" : "%s: %s", key, value);
    const iso_status status = iso_scene_change(ctx, text, scene);
    free(text);
    if (status == ISO_OK) iso_scene_forget_place(scene, time ? "end" : key);
    if (status == ISO_OK && time) iso_scene_forget_place(scene, "step"); /* it may be due to the other */
    if (status != ISO_BAD_INPUT) return status;
    const char *words = strstr(iso_context_message(ctx), ": "); /* behind the place: no file is wrong */
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, key, "%s", words ? words + 2 : iso_context_message(ctx));
}

iso_status iso_scene_replace(iso_context *ctx, iso_scene *scene, const double *k, const double J[3],
                             const double start[6])
{
    ISO_DEFAULT_ARITHMETIC;
    iso_params params;
    iso_start y;
    const iso_status status = iso_scene_replaced(ctx, scene, k, J, start, &params, &y);
    if (status == ISO_OK) scene->params = params, scene->start = y;
    return status;
}

/* --- questions -------------------------------------------------------------------------------------------------- */

int iso_scene_numbers(const iso_scene *scene, const char *key, double values[6])
{
    const double eps = scene->start.model == ISO_POINT ? scene->start.eps : NAN;
    const struct {
        const char *key;
        int count;
        const double *from;
    } rows[] = {{"k", 1, &scene->params.k}, {"J", 3, scene->params.J},
                {"D", 1, &scene->params.D}, {"start", 6, scene->start.y},
                {"eps", 1, &eps},           {"end", 1, &scene->end},
                {"step", 1, &scene->step},  {"tolerance", 1, &scene->tolerance}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(rows[i].key, key) == 0) {
            memcpy(values, rows[i].from, (size_t)rows[i].count * sizeof *values);
            return rows[i].count;
        }
    return 0;
}

const char *iso_scene_word(const iso_scene *scene, const char *key)
{
    if (strcmp(key, "model") == 0) return iso_model_kind_name((int)scene->start.model);
    if (strcmp(key, "backend") == 0) return iso_backend_name((int)scene->backend);
    if (strcmp(key, "method") == 0) return scene->method;
    if (strcmp(key, "as") == 0) return iso_models_name((int)scene->as);
    return strcmp(key, "name") == 0 ? scene->name : NULL;
}

iso_status iso_scene_text(iso_context *ctx, const iso_scene *scene, char text[], size_t room, size_t *length)
{
    iso_memory memory;
    FILE *to = iso_memory_open(&memory);
    if (to) iso_scene_print(scene, to);
    return iso_text_give(ctx, to, &memory, text, room, length);
}

int iso_scene_columns(const iso_scene *scene, int columns[])
{
    return iso_scene_column_list(scene, columns);
}

bool iso_scene_key(int i, const char **section, const char **key)
{
    return iso_scene_key_at(i, section, key);
}

bool iso_column(int i, const char *text[3])
{
    text[0] = iso_column_name(i);
    text[2] = iso_column_doc(i, &text[1]);
    return text[0] != NULL;
}

iso_status iso_yaml_json(iso_context *ctx, const char *name, const char *text, size_t bytes, char json[], size_t room,
                         size_t *length)
{
    return iso_yaml_to_json(ctx, name, text, bytes, json, room, length);
}

/* --- formulas --------------------------------------------------------------------------------------------------- */

void iso_scene_to_point(const iso_scene *scene, const double ball[6], double point[6])
{
    iso_ball_to_point(&scene->params, ball, point);
}

void iso_scene_to_ball(const iso_scene *scene, const double point[6], double ball[6])
{
    iso_point_to_ball(&scene->params, point, ball);
}

void iso_scene_clock_rates(const iso_scene *scene, const double n[3], double rates[2])
{
    double q = 0;
    for (int i = 0; i < 3; i++) q += n[i] * n[i] / scene->params.J[i];
    for (int c = 0; c < 2; c++)
        rates[c] = iso_clock_rate(&scene->params, c ? ISO_CLOCK_S : ISO_CLOCK_TAU, 1 / q, NULL);
}

double iso_scene_energy(const iso_scene *scene, const double ball[6])
{
    return iso_ball_energy(&scene->params, ball);
}
