/* yaml_json.c - a YAML document as JSON, for languages that can read JSON and no YAML. */
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "io/yaml_impl.h"

typedef struct output {
    iso_yaml yaml;
    char *text;
    size_t room, used;
} output;

static void put(output *o, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++, o->used++)
        if (o->used + 1 < o->room) o->text[o->used] = text[i];
}

static void put_text(output *o, const yaml_node_t *n)
{
    const char *text = (const char *)n->data.scalar.value;
    put(o, "\"", 1);
    for (size_t i = 0; i < n->data.scalar.length; i++) {
        char code[8];
        const bool special = text[i] == '"' || text[i] == '\\' || (unsigned char)text[i] < 0x20;
        if (special) snprintf(code, sizeof code, "\\u%04x", (unsigned)text[i]);
        put(o, special ? code : text + i, special ? 6 : 1);
    }
    put(o, "\"", 1);
}

/* A number, true, false and nothing are written without quotes; all other texts have them in JSON. */
static void put_scalar(output *o, const yaml_node_t *n)
{
    const char *text = (const char *)n->data.scalar.value;
    const size_t length = n->data.scalar.length;
    char number[ISO_NUMBER_SIZE];
    double x;
    if (n->data.scalar.style != YAML_PLAIN_SCALAR_STYLE) {
        put_text(o, n);
    } else if (length == 0) {
        put(o, "null", 4);
    } else if (iso_number_read(text, length, &x)) {
        put(o, number, (size_t)iso_number_print(number, x));
        if (strcmp(number, "-0") == 0) put(o, ".0", 2); /* the whole number -0 has no sign in many languages */
    } else if (iso_yaml_is(n, "true") || iso_yaml_is(n, "false")) {
        put(o, text, length);
    } else {
        put_text(o, n);
    }
}

static iso_status put_node(output *o, const yaml_node_t *n);

static iso_status put_list(output *o, const yaml_node_t *n)
{
    put(o, "[", 1);
    for (const yaml_node_item_t *i = n->data.sequence.items.start; i < n->data.sequence.items.top; i++) {
        if (i > n->data.sequence.items.start) put(o, ", ", 2);
        ISO_TRY(put_node(o, iso_yaml_node(&o->yaml, *i)));
    }
    put(o, "]", 1);
    return ISO_OK;
}

static iso_status put_mapping(output *o, const yaml_node_t *n)
{
    put(o, "{", 1);
    for (const yaml_node_pair_t *p = n->data.mapping.pairs.start; p < n->data.mapping.pairs.top; p++) {
        const yaml_node_t *key = iso_yaml_node(&o->yaml, p->key);
        if (key->type != YAML_SCALAR_NODE)
            return iso_yaml_fail(&o->yaml, key->start_mark, "a key should be a name, not a list or a mapping");
        if (p > n->data.mapping.pairs.start) put(o, ", ", 2);
        put_text(o, key);
        put(o, ": ", 2);
        ISO_TRY(put_node(o, iso_yaml_node(&o->yaml, p->value)));
    }
    put(o, "}", 1);
    return ISO_OK;
}

static iso_status put_node(output *o, const yaml_node_t *n)
{
    if (n->type == YAML_SEQUENCE_NODE) return put_list(o, n);
    if (n->type == YAML_MAPPING_NODE) return put_mapping(o, n);
    put_scalar(o, n);
    return ISO_OK;
}

iso_status iso_yaml_to_json(iso_context *ctx, const char *name, const char *text, size_t bytes, char json[], size_t room,
                         size_t *length)
{
    ISO_DEFAULT_ARITHMETIC;
    output o = {.yaml = {.ctx = ctx, .name = name}, .text = json, .room = room};
    ISO_TRY(iso_yaml_load(&o.yaml, text, bytes));
    const iso_status status = put_node(&o, yaml_document_get_root_node(&o.yaml.document));
    if (room > 0) json[o.used < room ? o.used : room - 1] = '\0';
    *length = o.used;
    iso_yaml_free(&o.yaml);
    return status;
}
