/* yaml_impl.h - strict reading of one YAML document: libyaml's nodes, and every mistake with its line and column.
 *
 * What libyaml lets through and a scene must not have is refused here: anchors and aliases, tags, a second
 * document, deep nesting, numbers that are quoted or not finite.
 */
#ifndef ISO_IO_YAML_IMPL_H
#define ISO_IO_YAML_IMPL_H

#include <stdbool.h>
#include <yaml.h>

#include "base/context.h"

typedef struct iso_yaml {
    iso_context *ctx;
    const char *name; /* of the file, for messages */
    yaml_document_t document;
} iso_yaml;

/* Parses text; y->ctx and y->name are given, y->document is to be freed by iso_yaml_free if the answer is ISO_OK.
 * Errors: ISO_BAD_INPUT, ISO_NO_MEMORY. */
iso_status iso_yaml_load(iso_yaml *y, const char *text, size_t length);
void iso_yaml_free(iso_yaml *y);

/* Records "name:line:column: ..." and returns ISO_BAD_INPUT. */
iso_status iso_yaml_fail(const iso_yaml *y, yaml_mark_t at, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/* The node of index `id`, as in pairs of a mapping and items of a list. */
const yaml_node_t *iso_yaml_node(iso_yaml *y, int id);

/* The key and the value (either may be NULL) of `name` in a mapping; false if it is not there. */
bool iso_yaml_find(iso_yaml *y, const yaml_node_t *mapping, const char *name, const yaml_node_t **key,
                   const yaml_node_t **value);

/* Whether the node is the text `text`, quoted or not. */
bool iso_yaml_is(const yaml_node_t *node, const char *text);

/* Records that `what` should be `expected`, and what it is. */
iso_status iso_yaml_expected(const iso_yaml *y, const yaml_node_t *node, const char *what, const char *expected);

/* Records that the text of `node`, a `what` ("key", "method"), is none of the names, and the nearest one. */
iso_status iso_yaml_unknown(const iso_yaml *y, const yaml_node_t *node, const char *what, size_t count,
                            const char *const names[]);

/* Whether `key`, which is `name`, is the first of this name in its mapping. Errors: ISO_BAD_INPUT. */
iso_status iso_yaml_once(iso_yaml *y, const yaml_node_t *mapping, const yaml_node_t *key, const char *name);

/* Which of the names a key of the mapping is, in *i; unknown: what messages call it ("key"). Errors: ISO_BAD_INPUT,
 * also for a key that is there twice. */
iso_status iso_yaml_key(iso_yaml *y, const yaml_node_t *mapping, const yaml_node_t *key, const char *unknown,
                        size_t count, const char *const names[], size_t *i);

/* The value of `what` as one of the words of an enum (word(0), word(1), ...), those whose bit is set in `allowed`. */
iso_status iso_yaml_word(const iso_yaml *y, const yaml_node_t *n, const char *what, const char *(*word)(int),
                         unsigned allowed, int *value);

/* The value of `what` as a finite number, a list of `count` numbers (9: three rows of three), true or false. A number
 * can be a fraction such as 1/3; only the message of iso_yaml_ratio says so. */
iso_status iso_yaml_number(const iso_yaml *y, const yaml_node_t *node, const char *what, double *value);
iso_status iso_yaml_ratio(const iso_yaml *y, const yaml_node_t *node, const char *what, double *value);
iso_status iso_yaml_numbers(iso_yaml *y, const yaml_node_t *node, const char *what, int count, double values[]);
iso_status iso_yaml_flag(const iso_yaml *y, const yaml_node_t *node, const char *what, bool *value);

/* The document as JSON, in which numbers read back to the same doubles. As much as there is room for goes to json[],
 * with an end mark; *length is that of all of it. Errors: those of iso_yaml_load; ISO_BAD_INPUT: a key is no text. */
iso_status iso_yaml_to_json(iso_context *ctx, const char *name, const char *text, size_t bytes, char json[],
                            size_t room, size_t *length);

#endif
