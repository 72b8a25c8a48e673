/* scene_keys.c - the keys of a scene, in tables, and the functions that read their values into a draft. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/names_impl.h"
#include "base/number_impl.h"
#include "io/scene_draft_impl.h"
#include "io/text_impl.h"
#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"

enum { MAX_KEYS = 32, EFFECT_KEYS = ISO_EFFECT_NUMBERS + ISO_EXPRESSIONS + 3 };
_Static_assert((int)MAX_KEYS >= 2 * (int)ISO_EFFECTS && (int)MAX_KEYS >= (int)EFFECT_KEYS, "room for all names");

/* What a value is. FROM_FUNCTION: what `read` makes of it. */
typedef enum kind { FROM_FUNCTION, NUMBER, VECTOR, RATIO, RATIOS, FLAG, WORD, EFFECT } kind;

/* One key that a mapping may have: what its value is, and where in the draft it goes. */
typedef struct entry {
    const char *name;
    kind kind;
    size_t offset;
    bool required;
    iso_status (*read)(iso_draft *d, const struct entry *e, const yaml_node_t *value); /* NULL: by its kind */
    const struct entry *section;     /* read_section: the keys inside               */
    const char *(*word)(int);        /* WORD: the names of an enum ...              */
    unsigned words;                  /* ... and which of them (1 << value)          */
    iso_effect_id effect;            /* EFFECT, and the values of an effect: whose  */
    const iso_effect_number *number; /* read_effect_number: which one               */
    int which;                       /* read_text: which key of its text            */
} entry;

/* ---- Values ---- */

static void *target(iso_draft *d, const entry *e)
{
    return (char *)d + e->offset;
}

static iso_status read_value(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    void *to = target(d, e);
    if (e->read) return e->read(d, e, value);
    switch (e->kind) {
    case NUMBER: return iso_yaml_number(&d->yaml, value, e->name, to);
    case VECTOR: return iso_yaml_numbers(&d->yaml, value, e->name, 3, to);
    case RATIO: return iso_draft_ratio(d, value, e->name, e->name, to);
    case RATIOS: return iso_draft_ratios(d, value, e->name, to);
    case FLAG: return iso_yaml_flag(&d->yaml, value, e->name, to);
    default: return iso_yaml_word(&d->yaml, value, e->name, e->word, e->words, to);
    }
}

static iso_status read_step(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    const iso_status status = iso_yaml_number(&d->yaml, value, e->name, target(d, e));
    if (status != ISO_OK || d->scene.step > 0) return status;
    return ISO_FAIL_AT(d, value, "'step' is %s, it must be positive (backwards: negative 'end')",
                       ISO_SHORT(d->scene.step));
}

static iso_status read_tolerance(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    const iso_status status = iso_yaml_number(&d->yaml, value, e->name, target(d, e));
    if (status != ISO_OK || iso_tolerance_is_good(d->scene.tolerance)) return status;
    return ISO_FAIL_AT(d, value, "'tolerance' is %s, it must be in " ISO_TOLERANCE_RANGE,
                       ISO_SHORT(d->scene.tolerance));
}

/* Keeps the full name of the method, whichever of its spellings was used. */
static iso_status read_method(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    const char *text = (const char *)value->data.scalar.value;
    char quoted[ISO_QUOTE_SIZE], suggested[ISO_SUGGEST_SIZE];
    if (value->type != YAML_SCALAR_NODE || !iso_yaml_is(value, text) || *text == '\0')
        return iso_yaml_expected(&d->yaml, value, e->name, "the name of a method");
    const iso_method *method = iso_method_find(text);
    if (method || strcmp(text, "auto") == 0) {
        snprintf(target(d, e), ISO_NAME_SIZE, "%s", method ? method->name : "auto");
        return ISO_OK;
    }
    iso_text_quote(quoted, text, value->data.scalar.length);
    return ISO_FAIL_AT(d, value, "unknown method '%s'" ISO_WITHOUT_SUNDIALS "; %s", quoted,
                       iso_suggest_word(suggested, quoted, iso_method_word));
}

static iso_status read_columns(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    iso_scene *s = &d->scene;
    const char *names[ISO_TRAJECTORY_COLUMNS];
    const int columns = iso_column_names(names);
    const yaml_node_item_t *i = value->data.sequence.items.start;
    if (value->type != YAML_SEQUENCE_NODE || i == value->data.sequence.items.top)
        return iso_yaml_expected(&d->yaml, value, e->name, "a list of at least one column name");
    for (; i < value->data.sequence.items.top; i++) {
        const yaml_node_t *item = iso_yaml_node(&d->yaml, *i);
        const char *name = NULL;
        if (item->type != YAML_SCALAR_NODE) return iso_yaml_expected(&d->yaml, item, "columns", "a list of names");
        for (int c = 0; c < columns; c++)
            if (iso_yaml_is(item, names[c])) name = names[c];
        if (!name) return iso_yaml_unknown(&d->yaml, item, "column", (size_t)columns, names);
        for (size_t c = 0; c < s->columns; c++)
            if (strcmp(s->column[c], name) == 0) return ISO_FAIL_AT(d, item, "column '%s' is listed twice", name);
        strcpy(s->column[s->columns++], name);
    }
    return ISO_OK;
}

/* D = m b^2, which `reduced` may have as well as the effects that need it. */
static iso_status read_D(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    const double before = d->D;
    const iso_status status = iso_yaml_number(&d->yaml, value, e->name, target(d, e));
    if (status != ISO_OK || isnan(before) || before == d->D) return status;
    return ISO_FAIL_AT(d, value, "'D' is %s here and %s elsewhere", ISO_SHORT(d->D), ISO_SHORT(before));
}

/* A number of an effect: true or false, a word, one number, a matrix or a list. */
static iso_status read_effect_number(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    const iso_effect_number *n = e->number;
    double *x = iso_effect_values(&d->scene.effects, e->effect, n);
    bool flag = false;
    int word = 0;
    if (n->kind == ISO_NUMBER_FLAG || n->kind == ISO_NUMBER_WORD) {
        const iso_status status = n->kind == ISO_NUMBER_FLAG
                                      ? iso_yaml_flag(&d->yaml, value, e->name, &flag)
                                      : iso_yaml_word(&d->yaml, value, e->name, n->word, ~0u, &word);
        *x = flag + word;
        return status;
    }
    if (n->count == 1) return iso_yaml_number(&d->yaml, value, e->name, x);
    return iso_yaml_numbers(&d->yaml, value, e->name, n->count, x);
}

/* Of an effect that the scene writes. */
static iso_status read_text(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    return iso_draft_text(d, e->effect, e->which, value);
}

/* ---- Sections ---- */

/* Reads a mapping by its table; `owner` is its key, or the mapping itself at the top of the file. */
static iso_status read_mapping(iso_draft *d, const entry *entries, const char *name, const yaml_node_t *owner,
                               const yaml_node_t *mapping)
{
    const char *names[MAX_KEYS], *what = entries->kind == EFFECT ? "effect" : "key";
    size_t count = 0, i;
    for (; entries[count].name; count++) names[count] = entries[count].name;
    const yaml_node_pair_t *end = mapping->data.mapping.pairs.top;
    for (const yaml_node_pair_t *p = mapping->data.mapping.pairs.start; p < end; p++) {
        const yaml_node_t *key = iso_yaml_node(&d->yaml, p->key), *value = iso_yaml_node(&d->yaml, p->value);
        ISO_TRY(iso_yaml_key(&d->yaml, mapping, key, what, count, names, &i));
        iso_scene_note_place(&d->scene, names[i], value->start_mark);
        d->key = key;
        ISO_TRY(read_value(d, &entries[i], value));
    }
    for (i = 0; i < count; i++)
        if (entries[i].required && !iso_yaml_find(&d->yaml, mapping, names[i], NULL, NULL))
            return ISO_FAIL_AT(d, owner, "missing '%s' in %s", names[i], name);
    return ISO_OK;
}

static iso_status read_section(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    char name[ISO_QUOTE_SIZE], expected[256];
    snprintf(name, sizeof name, "'%s'", e->name);
    if (value->type == YAML_MAPPING_NODE) return read_mapping(d, e->section, name, d->key, value);
    int used = snprintf(expected, sizeof expected, e->section->name ? "a mapping {" : "{}");
    for (const entry *in = e->section; in->name && used < (int)sizeof expected; in++)
        used += snprintf(expected + used, sizeof expected - (size_t)used, in[1].name ? "%s: ..., " : "%s: ...}",
                         in->name);
    return iso_yaml_expected(&d->yaml, value, e->name, expected);
}

/* ---- The tables: adding a key is adding its line ---- */

#define AT(member) .offset = offsetof(iso_draft, member)
#define BIT(value) (1u << (value))

static const entry ball_keys[] = {
    {"mass", NUMBER, AT(body.mass), .required = true},
    {"radius", NUMBER, AT(body.radius), .required = true},
    {"inertia", VECTOR, AT(body.inertia), .required = true},
    {0},
};

static const entry surface_keys[] = {
    {"kind", WORD, AT(surface), .required = true, .word = iso_surface_name, .words = ~BIT(ISO_REDUCED)},
    {"radius", NUMBER, AT(body.surface_radius)},
    {0},
};

static const entry reduced_keys[] = {
    {"k", RATIO, AT(k), .required = true},
    {"J", RATIOS, AT(J), .required = true},
    {"D", NUMBER, .read = read_D, AT(D)},
    {0},
};

static const entry point_keys[] = {
    {"k", RATIO, AT(k), .required = true},
    {"J", RATIOS, AT(J), .required = true},
    {"eps", NUMBER, AT(eps)},
    {0},
};

static const entry initial_keys[] = {
    {"normal", VECTOR, AT(normal)}, {"angular_velocity", VECTOR, AT(angular_velocity)},
    {"gamma", VECTOR, AT(gamma)},   {"M", VECTOR, AT(M)},
    {"project", FLAG, AT(project)}, {0},
};

static const entry time_keys[] = {
    {"end", NUMBER, AT(scene.end), .required = true},
    {"step", .read = read_step, AT(scene.step)},
    {0},
};

/* The keys of an effect: its text, its numbers, and D where it is needed. */
static iso_status read_effect(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    const iso_effect *effect = iso_effect_list[e->effect];
    entry keys[EFFECT_KEYS] = {{0}};
    const entry with_keys = {e->name, .section = keys};
    int count = 0;
    for (const char *name; (name = iso_draft_text_key(e->effect, count)); count++)
        keys[count] = (entry){name, .read = read_text, .required = count == 0, .effect = e->effect, .which = count};
    if (strcmp(e->name, effect->name) != 0 && !iso_yaml_find(&d->yaml, d->root, "point", NULL, NULL))
        return ISO_FAIL_AT(d, d->key, "'%s' is for a point: a ball has '%s'", e->name, effect->name);
    if (d->scene.effects.on[e->effect])
        return ISO_FAIL_AT(d, d->key, "'%s' and '%s' are the same effect: give one of them", effect->name,
                           effect->point_name);
    if (strcmp(e->name, effect->name) != 0) iso_scene_note_place(&d->scene, effect->name, value->start_mark);
    for (const iso_effect_number *n = effect->numbers; n && n->name && count < EFFECT_KEYS - 2; n++)
        if (!n->hidden)
            keys[count++] = (entry){n->name, .read = read_effect_number, .required = n->required, .effect = e->effect,
                                    .number = n};
    if (effect->needs_D) keys[count] = (entry){"D", NUMBER, .read = read_D, AT(D)};
    d->scene.effects.on[e->effect] = true;
    return read_section(d, &with_keys, value);
}

/* The i-th name that an effect has in scenes: first those of all effects, then those for a point; NULL past the
 * last. */
static const char *effect_key(int i, iso_effect_id *id)
{
    if (i < ISO_EFFECTS) return *id = (iso_effect_id)i, iso_effect_list[i]->name;
    i -= ISO_EFFECTS;
    for (*id = 0; *id < ISO_EFFECTS; ++*id)
        if (iso_effect_list[*id]->point_name && i-- == 0) return iso_effect_list[*id]->point_name;
    return NULL;
}

static iso_status read_effects(iso_draft *d, const entry *e, const yaml_node_t *value)
{
    entry effects[2 * ISO_EFFECTS + 1] = {{0}};
    const entry with_effects = {e->name, .section = effects};
    iso_effect_id id;
    for (int i = 0; effect_key(i, &id); i++)
        effects[i] = (entry){effect_key(i, &id), EFFECT, .read = read_effect, .effect = id};
    return read_section(d, &with_effects, value);
}

static const entry solver_keys[] = {
    {"backend", WORD, AT(backend), .word = iso_backend_name, .words = ~0u},
    {"method", .read = read_method, AT(scene.method)},
    {"tolerance", NUMBER, .read = read_tolerance, AT(scene.tolerance)},
    {0},
};

static const entry output_keys[] = {
    {"as", WORD, AT(as), .word = iso_models_name, .words = ~BIT(ISO_SHOW_START)},
    {"columns", .read = read_columns},
    {0},
};

static const entry scene_keys[] = {
    {"ball", .read = read_section, .section = ball_keys},
    {"surface", .read = read_section, .section = surface_keys},
    {"reduced", .read = read_section, .section = reduced_keys},
    {"point", .read = read_section, .section = point_keys},
    {"initial", .read = read_section, .section = initial_keys, .required = true},
    {"time", .read = read_section, .section = time_keys, .required = true},
    {"effects", .read = read_effects},
    {"solver", .read = read_section, .section = solver_keys},
    {"output", .read = read_section, .section = output_keys},
    {0},
};

/* Those of a scene that is already read, in one mapping. */
static const entry change_keys[] = {
    {"backend", WORD, AT(backend), .word = iso_backend_name, .words = ~0u},
    {"method", .read = read_method, AT(scene.method)},
    {"tolerance", NUMBER, .read = read_tolerance, AT(scene.tolerance)},
    {"end", NUMBER, AT(scene.end)},
    {"step", .read = read_step, AT(scene.step)},
    {"as", WORD, AT(as), .word = iso_models_name, .words = ~0u},
    {"columns", .read = read_columns},
    {0},
};

iso_status iso_draft_read_changes(iso_draft *d)
{
    if (d->root->type != YAML_MAPPING_NODE) return iso_yaml_expected(&d->yaml, d->root, "change", "a mapping");
    if (iso_yaml_find(&d->yaml, d->root, "as", NULL, NULL) || iso_yaml_find(&d->yaml, d->root, "columns", NULL, NULL))
        d->scene.columns = 0;
    return read_mapping(d, change_keys, "the change", d->root, d->root);
}

iso_status iso_draft_read_keys(iso_draft *d)
{
    if (d->root->type != YAML_MAPPING_NODE)
        return iso_yaml_expected(&d->yaml, d->root, "scene", "a mapping with ball, surface, initial and time");
    return read_mapping(d, scene_keys, "the scene", d->root, d->root);
}

bool iso_scene_key_at(int i, const char **section, const char **key)
{
    for (const entry *e = scene_keys; e->name; e++) {
        int keys = 0;
        iso_effect_id id;
        while (e->section ? e->section[keys].name : effect_key(keys, &id)) keys++;
        *section = e->name;
        if (i < keys) return *key = e->section ? e->section[i].name : effect_key(i, &id), true;
        i -= keys;
    }
    return false;
}

/* --- the numbers of a text, for sweeps --- */

typedef struct listing {
    iso_draft *d;
    int most, count;
    iso_draft_number *list;
} listing;

static void list_one(listing *l, const char *prefix, const char *name, int count, const void *at,
                     const yaml_node_t *mapping)
{
    const yaml_node_t *value;
    if (l->count == l->most || !iso_yaml_find(&l->d->yaml, mapping, name, NULL, &value)) return;
    iso_draft_number *n = &l->list[l->count++];
    *n =
        (iso_draft_number){.count = count, .offset = (size_t)((const char *)at - (const char *)l->d), .value = value};
    snprintf(n->name, sizeof n->name, "%s%s%s", prefix, *prefix ? "." : "", name);
}

/* `name`: its own, or that for a point. */
static void list_effect(listing *l, iso_effect_id id, const char *name, const yaml_node_t *effects)
{
    const yaml_node_t *mapping, *parameters = NULL;
    iso_effect_number n;
    if (!name || !iso_yaml_find(&l->d->yaml, effects, name, NULL, &mapping)) return;
    if (iso_effect_list[id]->expressions) iso_yaml_find(&l->d->yaml, mapping, "parameters", NULL, &parameters);
    for (int i = 0; iso_effect_number_at(&l->d->scene.effects, id, i, &n); i++)
        if (n.kind != ISO_NUMBER_FLAG && n.kind != ISO_NUMBER_WORD)
            list_one(l, name, n.name, n.count, iso_effect_values(&l->d->scene.effects, id, &n),
                     parameters ? parameters : mapping);
}

int iso_draft_numbers(iso_draft *d, int most, iso_draft_number list[])
{
    listing l = {d, most, 0, list};
    const yaml_node_t *effects, *mapping;
    for (const entry *section = scene_keys; section->name; section++) {
        if (!section->section || !iso_yaml_find(&d->yaml, d->root, section->name, NULL, &mapping)) continue;
        for (const entry *e = section->section; e->name; e++) {
            const bool vector = e->kind == VECTOR || e->kind == RATIOS;
            const char *prefix = strcmp(e->name, "radius") == 0 ? section->name : ""; /* of ball, and of surface */
            if (vector || e->kind == NUMBER || e->kind == RATIO)
                list_one(&l, prefix, e->name, vector ? 3 : 1, target(d, e), mapping);
        }
    }
    if (iso_yaml_find(&d->yaml, d->root, "effects", NULL, &effects))
        for (iso_effect_id i = 0; i < ISO_EFFECTS; i++) {
            list_effect(&l, i, iso_effect_list[i]->name, effects);
            list_effect(&l, i, iso_effect_list[i]->point_name, effects);
        }
    return l.count;
}
