/* sweep_file.c - reads a sweep's text: its scene, what is measured, and for how long. sweep_vary.c reads what varies.
 * A failure is reported at its line and column. */
#include "sweep/sweep_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/version.h"
#include "io/text_impl.h"
#include "sweep/sweep_draft_impl.h"
#include "sweep/sweep_impl.h"

enum { LARGEST_FILE = 16 << 20, MOST_TOPICS = 32 };

/* --- what keys and values have in common ------------------------------------------------------------------------ */

iso_status iso_sweep_check_keys(iso_yaml *y, const yaml_node_t *mapping, const char *what, size_t count,
                                const char *const names[])
{
    if (mapping->type != YAML_MAPPING_NODE) return iso_yaml_expected(y, mapping, what, "a mapping");
    for (const yaml_node_pair_t *p = mapping->data.mapping.pairs.start; p < mapping->data.mapping.pairs.top; p++) {
        const yaml_node_t *key = iso_yaml_node(y, p->key), *first;
        size_t i = 0;
        if (key->type != YAML_SCALAR_NODE)
            return iso_yaml_fail(y, key->start_mark, "a key should be a name, not a list or a mapping");
        while (i < count && !iso_yaml_is(key, names[i])) i++;
        if (i == count && count > 0) return iso_yaml_unknown(y, key, "key", count, names);
        if (i == count)
            return iso_yaml_fail(y, key->start_mark, "'%s': this has no settings: write {}",
                                 (const char *)key->data.scalar.value);
        iso_yaml_find(y, mapping, names[i], &first, NULL);
        if (first != key)
            return iso_yaml_fail(y, key->start_mark, "duplicate key '%s', first written in line %zu", names[i],
                                 first->start_mark.line + 1);
    }
    return ISO_OK;
}

iso_status iso_sweep_whole(iso_yaml *y, const yaml_node_t *node, const char *what, double least, double most,
                           double *value)
{
    const iso_status status = iso_yaml_number(y, node, what, value);
    if (status != ISO_OK || (*value >= least && *value <= most && *value == floor(*value))) return status;
    return iso_yaml_fail(y, node->start_mark, "'%s' is %g, it must be a whole number from %g to %g", what, *value,
                         least, most);
}

/* --- the scene -------------------------------------------------------------------------------------------------- */

/* The path of the scene's file: beside the sweep's. NULL: no memory. */
static char *beside(const char *name, const char *path)
{
    const char *slash = strrchr(name, '/');
    const size_t folder = slash && *path != '/' ? (size_t)(slash - name) + 1 : 0;
    char *all = malloc(folder + strlen(path) + 1);
    if (!all) return NULL;
    memcpy(all, name, folder);
    strcpy(all + folder, path);
    return all;
}

static iso_status load_scene_file(iso_context *ctx, iso_sweep_file *f, const yaml_node_t *node)
{
    const char *path = (const char *)node->data.scalar.value;
    if (node->data.scalar.length == 0 || strcmp(path, "-") == 0)
        return iso_yaml_expected(&f->yaml, node, "scene", "the name of a file, or a scene");
    f->scene_name = beside(f->name, path);
    if (!f->scene_name) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    iso_status status = iso_text_load(ctx, f->scene_name, LARGEST_FILE, &f->scene_text, &f->scene_length);
    if (status == ISO_FILE_TROUBLE) return iso_yaml_fail(&f->yaml, node->start_mark, "%s", iso_context_message(ctx));
    if (status != ISO_OK) return status;
    f->draft = iso_draft_empty(ctx, f->scene_name);
    status = iso_yaml_load(&f->draft.yaml, f->scene_text, f->scene_length);
    f->scene_loaded = status == ISO_OK;
    if (f->scene_loaded) f->draft.root = yaml_document_get_root_node(&f->draft.yaml.document);
    return status;
}

static iso_status read_scene(iso_context *ctx, iso_sweep_file *f, const yaml_node_t *node)
{
    iso_status status = ISO_OK;
    if (node->type == YAML_SCALAR_NODE) {
        status = load_scene_file(ctx, f, node);
    } else if (node->type == YAML_MAPPING_NODE) {
        f->inside = true;
        f->draft = iso_draft_empty(ctx, f->name);
        f->draft.yaml = f->yaml;
        f->draft.root = node;
    } else {
        return iso_yaml_expected(&f->yaml, node, "scene", "the name of a file, or a scene");
    }
    if (status == ISO_OK) status = iso_draft_read_keys(&f->draft);
    if (status != ISO_OK) return status;
    iso_draft whole = f->draft; /* the draft itself keeps its numbers as they were read */
    status = iso_draft_make(&whole);
    f->base = whole.scene;
    return status;
}

/* --- what is measured ------------------------------------------------------------------------------------------- */

static iso_status read_word(iso_yaml *y, const yaml_node_t *node, const iso_sweep_setting *s, double *value)
{
    const char *names[MOST_TOPICS];
    size_t count = 0;
    for (int i = 0; s->word(i) && count < MOST_TOPICS; i++) {
        if (iso_yaml_is(node, s->word(i))) return *value = i, ISO_OK;
        names[count++] = s->word(i);
    }
    if (node->type != YAML_SCALAR_NODE || node->data.scalar.length == 0)
        return iso_yaml_expected(y, node, s->name, "a name");
    return iso_yaml_unknown(y, node, s->name, count, names);
}

static iso_status read_setting(iso_yaml *y, const yaml_node_t *node, const iso_sweep_setting *s, double *value)
{
    if (s->word) return read_word(y, node, s, value);
    if (s->whole) return iso_sweep_whole(y, node, s->name, s->least, s->most, value);
    const iso_status status = iso_yaml_number(y, node, s->name, value);
    if (status != ISO_OK || (*value >= s->least && *value <= s->most)) return status;
    return iso_yaml_fail(y, node->start_mark, "'%s' is %g, it must be from %g to %g", s->name, *value, s->least,
                         s->most);
}

static iso_status read_wish(iso_yaml *y, const iso_sweep_quantity *topic, const yaml_node_t *settings,
                            iso_sweep_request *wish)
{
    const char *names[ISO_SWEEP_SETTINGS];
    size_t count = 0;
    for (const iso_sweep_setting *s = topic->settings; s && s->name; s++) {
        wish->setting[count] = s->usual;
        names[count++] = s->name;
    }
    iso_status status = iso_sweep_check_keys(y, settings, topic->name, count, names);
    for (size_t i = 0; i < count && status == ISO_OK; i++) {
        const yaml_node_t *value;
        if (iso_yaml_find(y, settings, names[i], NULL, &value))
            status = read_setting(y, value, &topic->settings[i], &wish->setting[i]);
    }
    return status;
}

static iso_status read_measure(iso_sweep_file *f, const yaml_node_t *measure, const iso_sweep_quantity *const topics[])
{
    const char *names[MOST_TOPICS];
    size_t count = 0;
    iso_yaml *y = &f->yaml;
    while (topics[count] && count < MOST_TOPICS) names[count] = topics[count]->name, count++;
    iso_status status = iso_sweep_check_keys(y, measure, "measure", count, names);
    if (status != ISO_OK) return status;
    const yaml_node_pair_t *end = measure->data.mapping.pairs.top;
    for (const yaml_node_pair_t *p = measure->data.mapping.pairs.start; p < end && status == ISO_OK; p++) {
        const yaml_node_t *key = iso_yaml_node(y, p->key);
        iso_sweep_request *wish = &f->plan.wish[f->plan.wishes];
        if (f->plan.wishes++ == ISO_SWEEP_REQUESTS)
            return iso_yaml_fail(y, key->start_mark, "more than %d things to measure", ISO_SWEEP_REQUESTS);
        for (size_t i = 0; i < count; i++)
            if (iso_yaml_is(key, names[i])) wish->topic = (int)i;
        snprintf(wish->place.key, sizeof wish->place.key, "%s", names[wish->topic]);
        wish->place.line = (int)key->start_mark.line + 1;
        wish->place.column = (int)key->start_mark.column + 1;
        status = read_wish(y, topics[wish->topic], iso_yaml_node(y, p->value), wish);
    }
    if (status == ISO_OK && f->plan.wishes == 0)
        return iso_yaml_fail(y, measure->start_mark, "nothing is to be measured: write chaos: {}, for example");
    return status;
}

/* --- for how long ----------------------------------------------------------------------------------------------- */

/* What goes on to a time only cannot be told a number of turns, and the other way round. */
static iso_status check_until(iso_sweep_file *f, const yaml_node_t *until, const iso_sweep_quantity *const topics[])
{
    const bool turns = !isnan(f->plan.turns);
    bool used = false;
    for (int i = 0; i < f->plan.wishes; i++) {
        const iso_sweep_quantity *t = topics[f->plan.wish[i].topic];
        used = used || (turns ? t->turns : t->time);
        if (turns ? t->time && !t->turns : t->turns && !t->time)
            return iso_yaml_fail(&f->yaml, until->start_mark, "'%s' needs 'until: {%s: ...}'", t->name,
                                 turns ? "time" : "turns");
    }
    if (used) return ISO_OK;
    return iso_yaml_fail(&f->yaml, until->start_mark, "no quantity in 'measure' uses %s", turns ? "turns" : "a time");
}

static iso_status read_until(iso_sweep_file *f, const yaml_node_t *until, const iso_sweep_quantity *const topics[])
{
    static const char *const names[] = {"turns", "time"};
    const yaml_node_t *turns = NULL, *time = NULL;
    iso_yaml *y = &f->yaml;
    iso_status status = iso_sweep_check_keys(y, until, "until", 2, names);
    if (status != ISO_OK) return status;
    iso_yaml_find(y, until, "turns", NULL, &turns);
    iso_yaml_find(y, until, "time", NULL, &time);
    if (!turns == !time) return iso_yaml_fail(y, until->start_mark, "'until' has one of 'turns' and 'time'");
    if (turns)
        status = iso_sweep_whole(y, turns, "turns", 1, 1e12, &f->plan.turns);
    else
        status = iso_yaml_number(y, time, "time", &f->plan.time);
    return status == ISO_OK ? check_until(f, until, topics) : status;
}

/* Refuses numbers that vary but are not used: `until` replaces the scene's end, and a quantity's own setting replaces
 * that of the scene. */
static iso_status check_used(iso_sweep_file *f, const yaml_node_t *vary, const iso_sweep_quantity *const topics[])
{
    const iso_sweep_plan *p = &f->plan;
    for (int i = 0; i < f->axes; i++) {
        const char *name = f->axis[i].name;
        if (strcmp(name, "end") == 0 && !(isnan(p->turns) && isnan(p->time)))
            return iso_yaml_fail(&f->yaml, vary->start_mark, "'end' varies, but 'until' replaces it");
        for (int w = 0; w < p->wishes; w++) {
            const iso_sweep_quantity *t = topics[p->wish[w].topic];
            for (int s = 0; t->settings && t->settings[s].name; s++)
                if (strcmp(name, t->settings[s].name) == 0 && !isnan(p->wish[w].setting[s]))
                    return iso_yaml_fail(&f->yaml, vary->start_mark, "'%s' varies, but '%s' sets its own", name,
                                         t->name);
        }
    }
    return ISO_OK;
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

static iso_status read_rest(iso_sweep_file *f, const yaml_node_t *root)
{
    const yaml_node_t *node;
    iso_status status = ISO_OK;
    if (iso_yaml_find(&f->yaml, root, "chunk", NULL, &node)) {
        double chunk = 0;
        status = iso_sweep_whole(&f->yaml, node, "chunk", 1, 4096, &chunk);
        f->plan.chunk = (size_t)chunk;
    }
    if (status == ISO_OK && iso_yaml_find(&f->yaml, root, "vectors", NULL, &node)) {
        static const char *const kinds[] = {"avx512", "avx2", "plain"};
        for (int i = 0; i < 3; i++)
            if (iso_yaml_is(node, kinds[i])) strcpy(f->plan.vectors, kinds[i]);
        if (!*f->plan.vectors)
            status = node->type == YAML_SCALAR_NODE ? iso_yaml_unknown(&f->yaml, node, "vectors", 3, kinds)
                                                    : iso_yaml_expected(&f->yaml, node, "vectors", "a name");
    }
    return status;
}

/* The reason of a point that fails is part of the result, whose bytes do not depend on the folder or on the path that
 * was typed. From here on words about the scene name it as the sweep's text does. */
static void finish_plan(iso_sweep_file *f, const yaml_node_t *scene)
{
    iso_sweep_plan *p = &f->plan;
    f->draft.yaml.name = f->inside ? "<sweep>" : (const char *)scene->data.scalar.value;
    iso_sweep_hash(p->hash, ISO_VERSION, sizeof ISO_VERSION);
    iso_sweep_hash(p->hash, f->text, f->length + 1);
    if (f->scene_text) iso_sweep_hash(p->hash, f->scene_text, f->scene_length);
    p->text = f->text;
    p->scene = f->scene_text;
    p->family.name = (const char(*)[ISO_NAME_SIZE])f->column;
    p->family.scene = iso_sweep_point;
    p->family.data = f;
    p->family.base = &f->base;
}

static iso_status read_root(iso_context *ctx, iso_sweep_file *f, const iso_sweep_quantity *const topics[])
{
    static const char *const names[] = {"scene", "vary", "measure", "until", "samples", "chunk", "vectors"};
    const yaml_node_t *root = yaml_document_get_root_node(&f->yaml.document), *node[5] = {NULL};
    if (root->type != YAML_MAPPING_NODE)
        return iso_yaml_expected(&f->yaml, root, "sweep", "a mapping with scene, vary and measure");
    iso_status status = iso_sweep_check_keys(&f->yaml, root, "sweep", sizeof names / sizeof *names, names);
    for (int i = 0; i < 5 && status == ISO_OK; i++)
        if (!iso_yaml_find(&f->yaml, root, names[i], NULL, &node[i]) && i < 3)
            status = iso_yaml_fail(&f->yaml, root->start_mark, "missing '%s' in the sweep", names[i]);
    if (status == ISO_OK) status = read_scene(ctx, f, node[0]);
    if (status == ISO_OK) status = iso_sweep_read_vary(f, node[1], node[4]);
    if (status == ISO_OK) status = read_measure(f, node[2], topics);
    if (status == ISO_OK && node[3]) status = read_until(f, node[3], topics);
    if (status == ISO_OK) status = check_used(f, node[1], topics);
    if (status == ISO_OK) status = read_rest(f, root);
    if (status == ISO_OK) finish_plan(f, node[0]);
    return status;
}

static iso_status parse(iso_context *ctx, iso_sweep_file *f, const iso_sweep_quantity *const topics[])
{
    f->yaml = (iso_yaml){.ctx = ctx, .name = f->name};
    f->plan.turns = f->plan.time = NAN;
    iso_status status = iso_yaml_load(&f->yaml, f->text, f->length);
    f->loaded = status == ISO_OK;
    return status == ISO_OK ? read_root(ctx, f, topics) : status;
}

iso_status iso_sweep_parse(iso_context *ctx, const char *name, const char *text, size_t length,
                           const iso_sweep_quantity *const topics[], iso_sweep_file **file)
{
    ISO_DEFAULT_ARITHMETIC;
    *file = NULL;
    iso_sweep_file *f = calloc(1, sizeof *f);
    if (f) f->name = strdup(name);
    if (f) f->text = malloc(length + 1);
    iso_status status = ISO_NO_MEMORY;
    if (f && f->name && f->text) {
        memcpy(f->text, text, length);
        f->text[f->length = length] = '\0';
        status = parse(ctx, f, topics);
    } else {
        iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    }
    if (status == ISO_OK)
        *file = f;
    else
        iso_sweep_file_free(f);
    return status;
}

iso_status iso_sweep_read(iso_context *ctx, const char *path, const iso_sweep_quantity *const topics[],
                          iso_sweep_file **file)
{
    char *text;
    size_t length;
    *file = NULL;
    iso_status status = iso_text_load(ctx, path, LARGEST_FILE, &text, &length);
    if (status != ISO_OK) return status;
    status = iso_sweep_parse(ctx, iso_text_name(path), text, length, topics, file);
    free(text);
    return status;
}

void iso_sweep_file_free(iso_sweep_file *f)
{
    if (!f) return;
    if (f->scene_loaded) iso_yaml_free(&f->draft.yaml);
    if (f->loaded) iso_yaml_free(&f->yaml);
    for (int i = 0; i < f->axes; i++) free(f->axis[i].list);
    free(f->column);
    free(f->text);
    free(f->scene_text);
    free(f->name);
    free(f->scene_name);
    free(f);
}

const iso_sweep_plan *iso_sweep_file_plan(const iso_sweep_file *f)
{
    return &f->plan;
}

bool iso_sweep_axis_words(const iso_sweep_file *f, int i, char words[ISO_SWEEP_WORDS])
{
    if (i >= f->axes) return false;
    const iso_sweep_axis *a = &f->axis[i];
    const char *steps = a->logarithmic ? ", logarithmic" : "";
    char what[96] = "";
    switch (a->values) {
    case ISO_FROM_LIST: snprintf(what, sizeof what, "%zu value%s", a->count, a->count == 1 ? "" : "s"); break;
    case ISO_FROM_RANGE:
        snprintf(what, sizeof what, "%zu values from %g to %g%s", a->count, a->from, a->to, steps);
        break;
    case ISO_FROM_DRAWING:
        snprintf(what, sizeof what, "%zu values drawn %s from %g to %g%s", f->samples,
                 f->random ? "at random" : "evenly", a->from, a->to, steps);
        break;
    case ISO_FROM_TRIANGLE: snprintf(what, sizeof what, "%zu values of a triangle", a->count); break;
    case ISO_FROM_SPREAD: snprintf(what, sizeof what, "%zu starts spread over the section", a->count); break;
    }
    snprintf(words, ISO_SWEEP_WORDS, "%s: %s", a->name, what);
    return true;
}

size_t iso_sweep_zeros_of_k(const iso_sweep_file *f)
{
    for (int i = 0; i < f->axes; i++) {
        const iso_sweep_axis *a = &f->axis[i];
        const bool list = a->values == ISO_FROM_LIST;
        size_t zeros = 0;
        if (strcmp(a->name, "k") != 0 || !(list || a->values == ISO_FROM_RANGE)) continue;
        for (size_t j = 0; j < a->count; j++) zeros += (list ? a->list[j] : iso_sweep_in_range(a, j)) == 0;
        return zeros * (f->plan.family.count / a->count);
    }
    return 0;
}

/* Good enough to choose between a scene and a sweep: neither key occurs in the other kind of file. */
bool iso_sweep_is_one(const char *text, size_t length)
{
    iso_context *ctx = iso_context_create();
    iso_yaml y = {.ctx = ctx, .name = ""};
    const bool loaded = ctx && iso_yaml_load(&y, text, length) == ISO_OK;
    const yaml_node_t *root = loaded ? yaml_document_get_root_node(&y.document) : NULL;
    const bool is = root && root->type == YAML_MAPPING_NODE &&
                    (iso_yaml_find(&y, root, "vary", NULL, NULL) || iso_yaml_find(&y, root, "measure", NULL, NULL));
    if (loaded) iso_yaml_free(&y);
    iso_context_free(ctx);
    return is;
}
