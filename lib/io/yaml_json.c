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

static void print(output *o, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++, o->used++)
        if (o->used + 1 < o->room) o->text[o->used] = text[i];
}

static void print_quoted(output *o, const char *text, size_t length)
{
    print(o, "\"", 1);
    for (size_t i = 0; i < length; i++) {
        char code[8];
        const bool special = text[i] == '"' || text[i] == '\\' || (unsigned char)text[i] < 0x20;
        if (special) snprintf(code, sizeof code, "\\u%04x", (unsigned)text[i]);
        print(o, special ? code : text + i, special ? 6 : 1);
    }
    print(o, "\"", 1);
}

/* A number, true, false and nothing are written without quotes; all other texts have them in JSON. */
static void print_scalar(output *o, const yaml_node_t *n)
{
    const char *text = (const char *)n->data.scalar.value;
    const size_t length = n->data.scalar.length;
    const bool plain = n->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    char number[ISO_NUMBER_SIZE];
    double x;
    if (plain && length == 0) {
        print(o, "null", 4);
    } else if (plain && iso_number_read(text, length, &x)) {
        print(o, number, (size_t)iso_number_print(number, x));
        if (strcmp(number, "-0") == 0) print(o, ".0", 2); /* the whole number -0 has no sign in many languages */
    } else if (plain && (iso_yaml_is(n, "true") || iso_yaml_is(n, "false"))) {
        print(o, text, length);
    } else {
        print_quoted(o, text, length);
    }
}

static iso_status print_node(output *o, const yaml_node_t *n)
{
    if (n->type == YAML_SCALAR_NODE) return print_scalar(o, n), ISO_OK;
    const bool list = n->type == YAML_SEQUENCE_NODE;
    const yaml_node_item_t *item = n->data.sequence.items.start;
    const yaml_node_pair_t *pair = n->data.mapping.pairs.start;
    const long count = list ? n->data.sequence.items.top - item : n->data.mapping.pairs.top - pair;
    print(o, list ? "[" : "{", 1);
    for (long i = 0; i < count; i++) {
        const yaml_node_t *key = list ? NULL : iso_yaml_node(&o->yaml, pair[i].key);
        if (key && key->type != YAML_SCALAR_NODE)
            return iso_yaml_fail(&o->yaml, key->start_mark, "a key should be a name, not a list or a mapping");
        if (i > 0) print(o, ", ", 2);
        if (key) print_quoted(o, (const char *)key->data.scalar.value, key->data.scalar.length);
        if (key) print(o, ": ", 2);
        ISO_TRY(print_node(o, iso_yaml_node(&o->yaml, list ? item[i] : pair[i].value)));
    }
    print(o, list ? "]" : "}", 1);
    return ISO_OK;
}

iso_status iso_yaml_to_json(iso_context *ctx, const char *name, const char *text, size_t bytes, char json[],
                            size_t room, size_t *length)
{
    ISO_DEFAULT_ARITHMETIC;
    output o = {.yaml = {.ctx = ctx, .name = name}, .text = json, .room = room};
    ISO_TRY(iso_yaml_load(&o.yaml, text, bytes));
    const iso_status status = print_node(&o, yaml_document_get_root_node(&o.yaml.document));
    if (room > 0) json[o.used < room ? o.used : room - 1] = '\0';
    *length = o.used;
    iso_yaml_free(&o.yaml);
    return status;
}
