/* scene_written.c - the effects that a scene writes: reads their expressions and parameters, and finds the place in the
 * file of what is wrong with an expression. */
#include <stdio.h>
#include <string.h>

#include "io/scene_draft_impl.h"
#include "io/text_impl.h"
#include "model/expression/written_impl.h"
#include "orbit/orbit_impl.h"

static iso_status read_expression(iso_draft *d, iso_effect_id id, int which, const yaml_node_t *value)
{
    const iso_effect *effect = iso_effect_list[id];
    const char *name = effect->expressions[which];
    if (value->type != YAML_SCALAR_NODE || value->data.scalar.length == 0)
        return iso_yaml_expected(&d->yaml, value, name, "an expression in quotes");
    const char *text = (const char *)value->data.scalar.value;
    if (strlen(text) != value->data.scalar.length) return ISO_FAIL_AT(d, value, "%s has a zero byte in it", name);
    const iso_status status = iso_effects_write(d->yaml.ctx, &d->scene.effects, effect->name, name, text);
    return status == ISO_OK ? status : ISO_FAIL_AT(d, value, "%s", iso_context_message(d->yaml.ctx));
}

static iso_status read_expressions(iso_draft *d, iso_effect_id id, const yaml_node_t *value)
{
    const iso_effect *effect = iso_effect_list[id];
    const bool list = value->type == YAML_SEQUENCE_NODE;
    const yaml_node_item_t *items = list ? value->data.sequence.items.start : NULL;
    const long found = list ? (long)(value->data.sequence.items.top - items) : 0;
    int count = 0;
    while (effect->expressions[count]) count++;
    if (found != count)
        return iso_yaml_expected(&d->yaml, value, effect->expressions_key,
                                 "a list of 3 expressions in quotes, [\"...\", \"...\", \"...\"]");
    for (int i = 0; i < count; i++) ISO_TRY(read_expression(d, id, i, iso_yaml_node(&d->yaml, items[i])));
    return ISO_OK;
}

static iso_status read_parameters(iso_draft *d, iso_effect_id id, const yaml_node_t *mapping)
{
    const iso_effect *effect = iso_effect_list[id];
    char quoted[ISO_QUOTE_SIZE];
    double x;
    if (mapping->type != YAML_MAPPING_NODE)
        return iso_yaml_expected(&d->yaml, mapping, "parameters", "a mapping {NAME: NUMBER, ...}");
    const yaml_node_pair_t *end = mapping->data.mapping.pairs.top;
    for (const yaml_node_pair_t *p = mapping->data.mapping.pairs.start; p < end; p++) {
        const yaml_node_t *key = iso_yaml_node(&d->yaml, p->key);
        if (key->type != YAML_SCALAR_NODE) return ISO_FAIL_AT(d, key, "a parameter should be NAME: NUMBER");
        const char *name = (const char *)key->data.scalar.value, *bad = iso_effect_bad_parameter(effect, name);
        if (bad)
            return ISO_FAIL_AT(d, key, "'%s' cannot be a parameter: %s",
                               iso_text_quote(quoted, name, key->data.scalar.length), bad);
        ISO_TRY(iso_yaml_once(&d->yaml, mapping, key, name));
        ISO_TRY(iso_yaml_number(&d->yaml, iso_yaml_node(&d->yaml, p->value), name, &x));
        if (iso_effects_set(d->yaml.ctx, &d->scene.effects, effect->name, name, 1, &x) != ISO_OK)
            return ISO_FAIL_AT(d, key, "%s", iso_context_message(d->yaml.ctx));
    }
    return ISO_OK;
}

const char *iso_draft_text_key(iso_effect_id id, int i)
{
    const iso_effect *effect = iso_effect_list[id];
    int keys = 1;
    if (!effect->expressions) return NULL;
    while (!effect->expressions_key && effect->expressions[keys]) keys++;
    if (i >= keys) return i == keys ? "parameters" : NULL;
    return effect->expressions_key ? effect->expressions_key : effect->expressions[i];
}

iso_status iso_draft_text(iso_draft *d, iso_effect_id id, int i, const yaml_node_t *value)
{
    if (strcmp(iso_draft_text_key(id, i), "parameters") == 0) return read_parameters(d, id, value);
    return iso_effect_list[id]->expressions_key ? read_expressions(d, id, value) : read_expression(d, id, i, value);
}

/* The place of character `at` of an expression. In a text of several lines, or with escapes, it is not known: then only
 * that of the text is, and the message says which character. */
static iso_status fail_in_text(iso_draft *d, const yaml_node_t *node, const char *name, const iso_expression *e)
{
    yaml_mark_t mark = node->start_mark;
    const size_t quotes = node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE ? 0 : 2;
    const bool plain =
        node->end_mark.line == mark.line && node->end_mark.column == mark.column + node->data.scalar.length + quotes;
    if (!plain) return ISO_FAIL_AT(d, node, "%s, character %d: %s", name, e->at + 1, e->wrong);
    mark.column += quotes / 2 + (size_t)e->at;
    return iso_yaml_fail(&d->yaml, mark, "%s: %s", name, e->wrong);
}

iso_status iso_draft_check_expressions(iso_draft *d, iso_effect_id id, const yaml_node_t *effects)
{
    const iso_effect *effect = iso_effect_list[id];
    const iso_scene *scene = &d->scene;
    const yaml_node_t *section;
    iso_expression e;
    if (!iso_yaml_find(&d->yaml, effects, effect->name, NULL, &section)) return ISO_OK;
    for (int i = 0; effect->expressions[i]; i++) {
        if (!iso_written_has(&scene->effects, id, i) ||
            (iso_written_read(&scene->effects, id, i, &e) &&
             iso_written_decided(&scene->params, &scene->effects, id, &e)))
            continue;
        const char *list = effect->expressions_key; /* of all expressions; NULL: each has a key */
        const yaml_node_t *node = section;
        const bool found = iso_yaml_find(&d->yaml, section, list ? list : effect->expressions[i], NULL, &node);
        if (found && list) node = iso_yaml_node(&d->yaml, node->data.sequence.items.start[i]);
        return fail_in_text(d, node, effect->expressions[i], &e);
    }
    return ISO_OK;
}
