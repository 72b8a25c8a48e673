/* sweep_file.c - reads a sweep's text: its scene, what is measured, and for how long. sweep_vary.c reads what varies.
 * A failure is reported at its line and column. */
#define _GNU_SOURCE /* asprintf */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/fold_impl.h"
#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/version.h"
#include "io/text_impl.h"
#include "sweep/sweep_draft_impl.h"
#include "sweep/sweep_impl.h"

enum { MOST_QUANTITIES = 32 };

/* --- settings --------------------------------------------------------------------------------------------------- */

/* The keys of a mapping must be among `names`, each once. Errors: ISO_BAD_INPUT. */
static iso_status check_keys(iso_yaml *y, const yaml_node_t *mapping, const char *what, size_t count,
                             const char *const names[])
{
    if (mapping->type != YAML_MAPPING_NODE) return iso_yaml_expected(y, mapping, what, "a mapping");
    size_t i;
    for (const yaml_node_pair_t *p = mapping->data.mapping.pairs.start; p < mapping->data.mapping.pairs.top; p++)
        ISO_TRY(iso_yaml_key(y, mapping, iso_yaml_node(y, p->key), "key", count, names, &i));
    return ISO_OK;
}

static iso_status read_setting(iso_yaml *y, const yaml_node_t *node, const iso_sweep_setting *s, double *value)
{
    bool flag = false;
    int word;
    if (s->word) {
        ISO_TRY(iso_yaml_word(y, node, s->name, s->word, ~0u, &word));
        return *value = word, ISO_OK;
    }
    const iso_status status =
        s->flag ? iso_yaml_flag(y, node, s->name, &flag) : iso_yaml_number(y, node, s->name, value);
    if (s->flag) *value = flag;
    const bool fits = s->least == s->most || (*value >= s->least && *value <= s->most);
    if (status != ISO_OK || (fits && (!s->whole || *value == floor(*value)))) return status;
    return iso_yaml_fail(y, node->start_mark, "'%s' is %s, it must be %sfrom %s to %s", s->name, ISO_SHORT(*value),
                         s->whole ? "a whole number " : "", ISO_SHORT(s->least), ISO_SHORT(s->most));
}

/* Reads those of its keys that are settings. */
static iso_status read_settings(iso_yaml *y, const yaml_node_t *mapping, const iso_sweep_setting settings[],
                                double value[])
{
    iso_status status = ISO_OK;
    for (const iso_sweep_setting *s = settings; s && s->name && status == ISO_OK; s++, value++) {
        const yaml_node_t *node;
        *value = s->usual;
        if (iso_yaml_find(y, mapping, s->name, NULL, &node))
            status = read_setting(y, node, s, value);
        else if (s->missing)
            status = iso_yaml_fail(y, mapping->start_mark, "missing '%s' in %s", s->name, s->missing);
    }
    return status;
}

iso_status iso_sweep_read_mapping(iso_yaml *y, const yaml_node_t *mapping, const char *what,
                                  const iso_sweep_setting settings[], double value[])
{
    const char *names[ISO_SWEEP_SETTINGS];
    size_t count = 0;
    for (const iso_sweep_setting *s = settings; s && s->name; s++) names[count++] = s->name;
    ISO_TRY(check_keys(y, mapping, what, count, names));
    return read_settings(y, mapping, settings, value);
}

/* --- the scene -------------------------------------------------------------------------------------------------- */

static iso_status load_scene_file(iso_context *ctx, iso_sweep_file *f, const yaml_node_t *node)
{
    const char *path = (const char *)node->data.scalar.value, *slash = strrchr(f->name, '/');
    const int folder = slash && *path != '/' ? (int)(slash - f->name) + 1 : 0; /* beside the sweep's file */
    size_t length;
    if (asprintf(&f->scene_name, "%.*s%s", folder, f->name, path) < 0)
        return f->scene_name = NULL, iso_context_no_memory(ctx, "a sweep");
    const iso_status status = iso_text_load(ctx, f->scene_name, &f->scene_text, &length);
    if (status == ISO_FILE_TROUBLE) return ISO_FAIL_AT(f, node, "%s", iso_context_message(ctx));
    if (status != ISO_OK) return status;
    f->draft = iso_draft_empty(ctx, f->scene_name);
    ISO_TRY(iso_yaml_load(&f->draft.yaml, f->scene_text, length));
    f->draft.root = yaml_document_get_root_node(&f->draft.yaml.document);
    return ISO_OK;
}

static iso_status read_scene(iso_context *ctx, iso_sweep_file *f, const yaml_node_t *node)
{
    const char *path = node->type == YAML_SCALAR_NODE ? (const char *)node->data.scalar.value : "";
    if (node->type == YAML_MAPPING_NODE) {
        f->draft = iso_draft_empty(ctx, f->name);
        f->draft.yaml = f->yaml;
        f->draft.root = node;
    } else if (node->type != YAML_SCALAR_NODE || !*path || strcmp(path, "-") == 0) {
        return iso_yaml_expected(&f->yaml, node, "scene", "the name of a file, or a scene");
    } else {
        ISO_TRY(load_scene_file(ctx, f, node));
    }
    ISO_TRY(iso_draft_read_keys(&f->draft));
    iso_draft whole = f->draft; /* the draft itself keeps its numbers as they were read */
    const iso_status status = iso_draft_make(&whole);
    f->base = whole.scene;
    return status;
}

/* --- what is measured ------------------------------------------------------------------------------------------- */

/* The text of an option: a number or a word as it stands, numbers of a list with commas between. NULL: it is none. */
static char *option_text(iso_yaml *y, const yaml_node_t *n)
{
    iso_memory memory;
    bool good = n->type == YAML_SCALAR_NODE || n->type == YAML_SEQUENCE_NODE;
    FILE *to = good ? iso_memory_open(&memory) : NULL;
    if (!to) return NULL;
    if (n->type == YAML_SCALAR_NODE) fputs((const char *)n->data.scalar.value, to);
    for (yaml_node_item_t *i = n->data.sequence.items.start;
         n->type == YAML_SEQUENCE_NODE && i < n->data.sequence.items.top; i++) {
        const yaml_node_t *item = iso_yaml_node(y, *i);
        good = good && item->type == YAML_SCALAR_NODE;
        if (good)
            fprintf(to, "%s%s", i > n->data.sequence.items.start ? "," : "", (const char *)item->data.scalar.value);
    }
    char *text = iso_memory_close(to, &memory);
    if (good && text && !strchr(text, '\n')) return text;
    free(text);
    return NULL;
}

/* Options are called as the command calls them, or with "_" for "-". A flag that is false is not there. */
static iso_status read_option(iso_sweep_file *f, const iso_study *study, const yaml_node_pair_t *p, void *options,
                              FILE *to)
{
    char name[2 * ISO_NAME_SIZE] = "";
    const yaml_node_t *key = iso_yaml_node(&f->yaml, p->key), *value = iso_yaml_node(&f->yaml, p->value);
    if (key->type == YAML_SCALAR_NODE) snprintf(name, sizeof name, "%s", (const char *)key->data.scalar.value);
    for (char *c = name; *c; c++) *c = *c == '_' ? '-' : *c;
    const iso_option *o = iso_study_option_find(study, name, strlen(name));
    if (o && o->aside) return ISO_FAIL_AT(f, key, "'%s' changes no number", name);
    char *text = option_text(&f->yaml, value);
    if (!text) return iso_yaml_expected(&f->yaml, value, name, "a number, a word or a list of numbers");
    iso_status status = ISO_OK;
    if (!o || o->argument || strcmp(text, "false") != 0) {
        status = iso_study_set(f->yaml.ctx, study, name, text, options);
        fprintf(to, "%s=%s\n", name, text);
    }
    if (status != ISO_OK) status = ISO_FAIL_AT(f, o ? value : key, "%s", iso_context_message(f->yaml.ctx));
    free(text);
    return status;
}

/* Reads the options of a quantity as text for its study, which is asked whether they are right. */
static iso_status read_options(iso_sweep_file *f, const iso_study *study, const yaml_node_t *mapping,
                               iso_sweep_request *request)
{
    iso_memory memory;
    iso_status status = ISO_OK;
    if (mapping->type != YAML_MAPPING_NODE) return iso_yaml_expected(&f->yaml, mapping, study->name, "a mapping");
    void *options = malloc(study->size);
    FILE *to = iso_memory_open(&memory);
    if (options) study->begin(options);
    const yaml_node_pair_t *first = mapping->data.mapping.pairs.start, *end = mapping->data.mapping.pairs.top;
    for (const yaml_node_pair_t *p = first; to && options && p < end && status == ISO_OK; p++) {
        const yaml_node_t *key = iso_yaml_node(&f->yaml, p->key);
        if (key->type == YAML_SCALAR_NODE)
            status = iso_yaml_once(&f->yaml, mapping, key, (const char *)key->data.scalar.value);
        if (status == ISO_OK) status = read_option(f, study, p, options, to);
    }
    request->options = iso_memory_close(to, &memory);
    if (!request->options || !options) status = iso_context_no_memory(f->yaml.ctx, "a sweep");
    free(options);
    return status;
}

static iso_status read_measure(iso_sweep_file *f, const yaml_node_t *measure)
{
    const char *names[MOST_QUANTITIES];
    iso_sweep_quantity q;
    size_t count = 0;
    iso_yaml *y = &f->yaml;
    for (; count < MOST_QUANTITIES && iso_sweep_quantity_at((int)count, &q); count++) names[count] = q.name;
    iso_status status = check_keys(y, measure, "measure", count, names);
    if (status != ISO_OK) return status;
    const yaml_node_pair_t *end = measure->data.mapping.pairs.top;
    for (const yaml_node_pair_t *p = measure->data.mapping.pairs.start; p < end && status == ISO_OK; p++) {
        const yaml_node_t *key = iso_yaml_node(y, p->key);
        iso_sweep_request *request = &f->plan.request[f->plan.requests];
        if (f->plan.requests++ == ISO_SWEEP_REQUESTS)
            return iso_yaml_fail(y, key->start_mark, "more than %d things to measure", ISO_SWEEP_REQUESTS);
        for (size_t i = 0; i < count; i++)
            if (iso_yaml_is(key, names[i])) request->name = names[i];
        snprintf(request->place.key, sizeof request->place.key, "%s", request->name);
        request->place.line = (int)key->start_mark.line + 1;
        request->place.column = (int)key->start_mark.column + 1;
        status = read_options(f, iso_sweep_study(request->name), iso_yaml_node(y, p->value), request);
    }
    if (status == ISO_OK && f->plan.requests == 0)
        return iso_yaml_fail(y, measure->start_mark, "nothing is to be measured: write chaos: {}, for example");
    return status;
}

/* --- for how long ----------------------------------------------------------------------------------------------- */

static iso_status read_until(iso_sweep_file *f, const yaml_node_t *until)
{
    static const iso_sweep_setting settings[] = {
        {.name = "turns", .usual = NAN, .least = 1, .most = 1e12, .whole = true},
        {.name = "time", .usual = NAN},
        {.name = NULL},
    };
    double value[2];
    ISO_TRY(iso_sweep_read_mapping(&f->yaml, until, "until", settings, value));
    f->plan.turns = value[0];
    f->plan.time = value[1];
    if (isnan(value[0]) == isnan(value[1])) return ISO_FAIL_AT(f, until, "'until' has one of 'turns' and 'time'");
    const bool turns = !isnan(value[0]);
    bool used = false;
    for (int i = 0; i < f->plan.requests;
         i++) { /* what goes on to a time only has no turns, and the other way round */
        const iso_study *study = iso_sweep_study(f->plan.request[i].name);
        const bool by_turns = iso_study_option_find(study, "turns", 5),
                   by_time = iso_study_option_find(study, "t-end", 5);
        used = used || (turns ? by_turns : by_time);
        if (by_turns != by_time && by_turns != turns)
            return ISO_FAIL_AT(f, until, "'%s' needs 'until: {%s: ...}'", f->plan.request[i].name,
                               turns ? "time" : "turns");
    }
    if (used) return ISO_OK;
    return ISO_FAIL_AT(f, until, "no quantity in 'measure' uses %s", turns ? "turns" : "a time");
}

/* Refuses numbers that vary but are not used: `until` replaces the scene's end, and a quantity's own option replaces
 * that of the scene. */
static iso_status check_used(iso_sweep_file *f, const yaml_node_t *vary)
{
    const iso_sweep_plan *p = &f->plan;
    for (int i = 0; i < f->axes; i++) {
        const char *name = f->axis[i].name, *option = strcmp(name, "end") == 0 ? "t-end" : name;
        if (strcmp(name, "end") == 0 && !(isnan(p->turns) && isnan(p->time)))
            return ISO_FAIL_AT(f, vary, "'end' varies, but 'until' replaces it");
        if (strcmp(name, "tolerance") == 0) option = "tol";
        for (int w = 0; w < p->requests; w++)
            if (iso_sweep_option(p->request[w].options, option) || iso_sweep_option(p->request[w].options, name))
                return ISO_FAIL_AT(f, vary, "'%s' varies, but '%s' sets its own", name, p->request[w].name);
    }
    return ISO_OK;
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

static ISO_NAMES(kind_of_vectors, int, "avx512", "avx2", "plain")

    static iso_status read_root(iso_context *ctx, iso_sweep_file *f)
{
    static const char *const names[] = {"scene", "vary", "measure", "until", "samples", "chunk", "vectors"};
    static const iso_sweep_setting settings[] = {
        {.name = "chunk", .least = 1, .most = 4096, .whole = true},
        {.name = "vectors", .word = kind_of_vectors, .usual = NAN},
        {.name = NULL},
    };
    const yaml_node_t *root = yaml_document_get_root_node(&f->yaml.document), *node[5] = {NULL};
    double value[2];
    if (root->type != YAML_MAPPING_NODE)
        return iso_yaml_expected(&f->yaml, root, "sweep", "a mapping with scene, vary and measure");
    ISO_TRY(check_keys(&f->yaml, root, "sweep", sizeof names / sizeof *names, names));
    for (int i = 0; i < 5; i++)
        if (!iso_yaml_find(&f->yaml, root, names[i], NULL, &node[i]) && i < 3)
            return ISO_FAIL_AT(f, root, "missing '%s' in the sweep", names[i]);
    ISO_TRY(read_scene(ctx, f, node[0]));
    ISO_TRY(iso_sweep_read_vary(f, node[1], node[4]));
    ISO_TRY(read_measure(f, node[2]));
    if (node[3]) ISO_TRY(read_until(f, node[3]));
    ISO_TRY(check_used(f, node[1]));
    ISO_TRY(read_settings(&f->yaml, root, settings, value));
    f->plan.chunk = (size_t)value[0];
    if (!isnan(value[1])) strcpy(f->plan.vectors, kind_of_vectors((int)value[1]));
    /* The reason of a point that fails is part of the result, whose bytes do not depend on the folder or on the path
     * that was typed. From here on messages about the scene name it as the sweep's text does. */
    f->draft.yaml.name = node[0]->type == YAML_MAPPING_NODE ? "<sweep>" : (const char *)node[0]->data.scalar.value;
    return ISO_OK;
}

iso_status iso_sweep_parse(iso_context *ctx, const char *name, const char *text, size_t length, iso_sweep_file **file)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_sweep_file *f = *file = calloc(1, sizeof *f);
    if (f) f->name = strdup(name);
    if (f) f->text = malloc(length + 1);
    iso_status status = f && f->name && f->text ? ISO_OK : iso_context_no_memory(ctx, "a sweep");
    if (status == ISO_OK) {
        memcpy(f->text, text, length);
        f->text[length] = '\0';
        f->yaml = (iso_yaml){.ctx = ctx, .name = f->name};
        f->plan.turns = f->plan.time = NAN;
        status = iso_yaml_load(&f->yaml, f->text, length);
    }
    if (status == ISO_OK) status = read_root(ctx, f);
    if (status != ISO_OK) return iso_sweep_file_free(f), *file = NULL, status;
    iso_sweep_plan *p = &f->plan;
    iso_sweep_hash_texts(p->hash, ISO_VERSION, f->text, f->scene_text);
    p->text = f->text;
    p->scene = f->scene_text;
    p->family.name = (const char(*)[ISO_NAME_SIZE])f->column;
    p->family.scene = iso_sweep_point;
    p->family.data = f;
    p->family.base = &f->base;
    return ISO_OK;
}

iso_status iso_sweep_read(iso_context *ctx, const char *path, iso_sweep_file **file)
{
    char *text;
    size_t length;
    *file = NULL;
    ISO_TRY(iso_text_load(ctx, path, &text, &length));
    const iso_status status = iso_sweep_parse(ctx, iso_text_name(path), text, length, file);
    free(text);
    return status;
}

void iso_sweep_file_free(iso_sweep_file *f)
{
    if (!f) return;
    if (f->scene_name) iso_yaml_free(&f->draft.yaml); /* else it is that of the sweep */
    iso_yaml_free(&f->yaml);
    for (int i = 0; i < f->axes; i++) free(f->axis[i].list);
    for (int i = 0; i < ISO_SWEEP_REQUESTS; i++) free((void *)f->plan.request[i].options);
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

void iso_sweep_print_axes(const iso_sweep_file *f, FILE *to)
{
    for (const iso_sweep_axis *a = f->axis; a < f->axis + f->axes; a++) {
        const char *drawn = a->values != ISO_FROM_DRAWING ? "" : f->random ? " drawn at random" : " drawn evenly";
        fprintf(to, "  %s: %zu ", a->name, *drawn ? f->samples : a->count);
        switch (a->values) {
        case ISO_FROM_LIST: fputs(a->count == 1 ? "value" : "values", to); break;
        case ISO_FROM_RANGE:
        case ISO_FROM_DRAWING:
            fprintf(to, "values%s from %s to %s%s", drawn, ISO_SHORT(a->from), ISO_SHORT(a->to),
                    a->logarithmic ? ", logarithmic" : "");
            break;
        case ISO_FROM_TRIANGLE: fputs("values of a triangle", to); break;
        case ISO_FROM_SPREAD: fputs("starts spread over the section", to); break;
        }
        fputc('\n', to);
    }
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
