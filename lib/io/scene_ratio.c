/* scene_ratio.c - numbers that a scene may write as fractions, and that are to be known as they are written; and where
 * numbers stand in the file. */
#include <stdio.h>
#include <string.h>

#include "base/rational_impl.h"
#include "io/scene_draft_impl.h"
#include "orbit/orbit_impl.h"

void iso_scene_note_place(iso_scene *s, const char *key, yaml_mark_t at)
{
    if (s->places == ISO_MAX_PLACES) return;
    iso_place *place = &s->place[s->places++];
    snprintf(place->key, sizeof place->key, "%s", key);
    place->line = (int)at.line + 1;
    place->column = (int)at.column + 1;
}

iso_status iso_draft_ratio(iso_draft *d, const yaml_node_t *value, const char *what, const char *key, double *x)
{
    iso_rational written, taken;
    ISO_TRY(iso_yaml_ratio(&d->yaml, value, what, x));
    const char *text = (const char *)value->data.scalar.value;
    if (iso_rational_read(text, value->data.scalar.length, &written) && iso_rational_of(*x, &taken) &&
        iso_rational_same(&written, &taken))
        return ISO_OK;
    char rounded[ISO_NAME_SIZE];
    snprintf(rounded, sizeof rounded, ISO_ROUNDED_KEY "%s", key);
    iso_scene_note_place(&d->scene, rounded, value->start_mark);
    return ISO_OK;
}

iso_status iso_draft_ratios(iso_draft *d, const yaml_node_t *value, const char *key, double x[3])
{
    const yaml_node_item_t *items = value->data.sequence.items.start;
    if (value->type != YAML_SEQUENCE_NODE || value->data.sequence.items.top - items != 3)
        return iso_yaml_numbers(&d->yaml, value, key, 3, x);
    for (int i = 0; i < 3; i++) {
        char what[ISO_NAME_SIZE];
        snprintf(what, sizeof what, "%s[%d]", key, i + 1);
        ISO_TRY(iso_draft_ratio(d, iso_yaml_node(&d->yaml, items[i]), what, key, &x[i]));
    }
    return ISO_OK;
}

iso_status iso_draft_literals(iso_draft *d, iso_literals *literals)
{
    iso_draft_number list[ISO_LITERALS];
    const int count = iso_draft_numbers(d, ISO_LITERALS, list);
    literals->count = 0;
    for (const iso_draft_number *n = list; n < list + count; n++) {
        if (n->count != 1 && n->count != 3) continue;
        iso_literal *literal = &literals->one[literals->count++];
        literal->count = 0;
        memcpy(literal->name, n->name, sizeof n->name);
        for (int i = 0; i < n->count; i++) {
            const yaml_node_t *value =
                n->count == 1 ? n->value : iso_yaml_node(&d->yaml, n->value->data.sequence.items.start[i]);
            char *text = strndup((const char *)value->data.scalar.value, value->data.scalar.length);
            if (!text) return iso_context_no_memory(d->yaml.ctx, "a scene");
            literal->text[literal->count++] = text;
        }
    }
    return ISO_OK;
}
