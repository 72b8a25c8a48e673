/* yaml.c - reads one YAML document strictly: what a scene must not have is refused with its line and column. */
#include "io/yaml_impl.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/names_impl.h"
#include "base/rational_impl.h"
#include "io/text_impl.h"

/* Scenes need three levels and fewer than a hundred values; libyaml's time grows with the square of the depth, its
 * memory by a hundred bytes for each value. */
enum { MAX_DEPTH = 8, MAX_VALUES = 10000 };

iso_status iso_yaml_fail(const iso_yaml *y, yaml_mark_t at, const char *format, ...)
{
    char message[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    return iso_context_placed(
        y->ctx, ISO_FAIL_INPUT(y->ctx, "", "%s:%zu:%zu: %s", y->name, at.line + 1, at.column + 1, message));
}

/* Line and column (in characters) of a byte: errors of libyaml's reader carry no mark. */
static yaml_mark_t mark_of_byte(const char *text, size_t offset)
{
    yaml_mark_t mark = {.index = offset};
    for (size_t i = 0; i < offset; i++) {
        if (text[i] == '\n' || (text[i] == '\r' && (i + 1 == offset || text[i + 1] != '\n'))) {
            mark.line++;
            mark.column = 0;
        } else if ((text[i] & 0xC0) != 0x80 && text[i] != '\r') {
            mark.column++;
        }
    }
    return mark;
}

static iso_status fail_syntax(const iso_yaml *y, const yaml_parser_t *p, const char *text, size_t length)
{
    const char *problem = p->problem ? p->problem : "unknown problem", *context = p->context;
    if (p->error == YAML_MEMORY_ERROR || p->error == YAML_NO_ERROR) /* it does not always say so */
        return iso_context_no_memory(y->ctx, "a scene");
    if (p->error != YAML_READER_ERROR)
        return iso_yaml_fail(y, p->problem_mark, "not valid YAML: %s%s%s", context ? context : "",
                             context ? ", " : "", problem);
    size_t offset = p->problem_offset < length ? p->problem_offset : length;
    if (strstr(problem, "trailing")) /* back to where the broken character begins */
        while (offset > 0 && (text[--offset] & 0xC0) == 0x80) continue;
    return iso_yaml_fail(y, mark_of_byte(text, offset), "not valid YAML text in UTF-8: %s (byte 0x%02X)", problem,
                         offset < length ? (unsigned char)text[offset] : 0);
}

/* How many there were so far. */
struct seen {
    int documents, depth, values;
};

static const char *anchor_or_tag(const yaml_event_t *e)
{
    const bool scalar = e->type == YAML_SCALAR_EVENT, list = e->type == YAML_SEQUENCE_START_EVENT,
               mapping = e->type == YAML_MAPPING_START_EVENT;
    if (e->type == YAML_ALIAS_EVENT) return "an alias (*name)";
    if ((scalar && e->data.scalar.anchor) || (list && e->data.sequence_start.anchor) ||
        (mapping && e->data.mapping_start.anchor))
        return "an anchor (&name)";
    if ((scalar && e->data.scalar.tag) || (list && e->data.sequence_start.tag) ||
        (mapping && e->data.mapping_start.tag))
        return "a tag (!name)";
    return NULL;
}

/* Refuses an event that a scene must not have: anchors, tags, a second document, deep nesting. */
static iso_status check_event(const iso_yaml *y, const yaml_event_t *e, struct seen *seen)
{
    const char *banned = anchor_or_tag(e);
    if (banned) return iso_yaml_fail(y, e->start_mark, "%s: scenes have none, write the value itself", banned);
    if (++seen->values > MAX_VALUES)
        return iso_yaml_fail(y, e->start_mark, "more than %d values: this is no scene", MAX_VALUES);
    switch (e->type) {
    case YAML_DOCUMENT_START_EVENT:
        if (++seen->documents > 1)
            return iso_yaml_fail(y, e->start_mark,
                                 "a second document: a file holds one scene, put others in files of their own");
        break;
    case YAML_STREAM_END_EVENT:
        if (seen->documents == 0)
            return iso_yaml_fail(y, e->start_mark,
                                 "the file is empty: expected a scene (ball, surface, initial, time)");
        break;
    case YAML_SEQUENCE_START_EVENT:
    case YAML_MAPPING_START_EVENT:
        if (++seen->depth > MAX_DEPTH)
            return iso_yaml_fail(y, e->start_mark, "nested more than %d levels deep", MAX_DEPTH);
        break;
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT: --seen->depth; break;
    default: break;
    }
    return ISO_OK;
}

static bool open_parser(yaml_parser_t *p, const char *text, size_t length)
{
    if (!yaml_parser_initialize(p)) return false;
    yaml_parser_set_encoding(p, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(p, (const unsigned char *)text, length);
    return true;
}

/* A first pass over the events. The second pass makes a document, which no longer shows anchors and tags. */
static iso_status check_events(const iso_yaml *y, const char *text, size_t length)
{
    yaml_parser_t parser;
    iso_status status = ISO_OK;
    struct seen seen = {0};
    bool more = true;
    if (!open_parser(&parser, text, length)) return iso_context_no_memory(y->ctx, "a scene");
    while (more && status == ISO_OK) {
        yaml_event_t event;
        const bool parsed = yaml_parser_parse(&parser, &event);
        status = parsed ? check_event(y, &event, &seen) : fail_syntax(y, &parser, text, length);
        more = parsed && event.type != YAML_STREAM_END_EVENT;
        if (parsed) yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    return status;
}

iso_status iso_yaml_load(iso_yaml *y, const char *text, size_t length)
{
    yaml_parser_t parser;
    if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) text += 3, length -= 3; /* byte order mark */
    ISO_TRY(check_events(y, text, length));
    if (!open_parser(&parser, text, length)) return iso_context_no_memory(y->ctx, "a scene");
    const iso_status status =
        yaml_parser_load(&parser, &y->document) ? ISO_OK : fail_syntax(y, &parser, text, length);
    yaml_parser_delete(&parser);
    return status;
}

void iso_yaml_free(iso_yaml *y)
{
    yaml_document_delete(&y->document);
}

const yaml_node_t *iso_yaml_node(iso_yaml *y, int id)
{
    return yaml_document_get_node(&y->document, id);
}

bool iso_yaml_is(const yaml_node_t *n, const char *text)
{
    return n->type == YAML_SCALAR_NODE && n->data.scalar.length == strlen(text) &&
           memcmp(n->data.scalar.value, text, n->data.scalar.length) == 0;
}

bool iso_yaml_find(iso_yaml *y, const yaml_node_t *mapping, const char *name, const yaml_node_t **key,
                   const yaml_node_t **value)
{
    if (mapping->type != YAML_MAPPING_NODE) return false;
    for (const yaml_node_pair_t *p = mapping->data.mapping.pairs.start; p < mapping->data.mapping.pairs.top; p++) {
        if (!iso_yaml_is(iso_yaml_node(y, p->key), name)) continue;
        if (key) *key = iso_yaml_node(y, p->key);
        if (value) *value = iso_yaml_node(y, p->value);
        return true;
    }
    return false;
}

iso_status iso_yaml_expected(const iso_yaml *y, const yaml_node_t *n, const char *what, const char *expected)
{
    char quoted[ISO_QUOTE_SIZE];
    if (n->type == YAML_MAPPING_NODE || n->type == YAML_SEQUENCE_NODE)
        return iso_yaml_fail(y, n->start_mark, "'%s' should be %s, not %s", what, expected,
                             n->type == YAML_MAPPING_NODE                                 ? "a mapping"
                             : n->data.sequence.items.start == n->data.sequence.items.top ? "an empty list"
                                                                                          : "a list");
    const bool plain = n->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    if (plain && n->data.scalar.length == 0)
        return iso_yaml_fail(y, n->start_mark, "'%s' has no value, it should be %s", what, expected);
    return iso_yaml_fail(y, n->start_mark, "'%s' should be %s, not %s'%s'", what, expected, plain ? "" : "the text ",
                         iso_text_quote(quoted, (const char *)n->data.scalar.value, n->data.scalar.length));
}

iso_status iso_yaml_unknown(const iso_yaml *y, const yaml_node_t *n, const char *what, size_t count,
                            const char *const names[])
{
    char quoted[ISO_QUOTE_SIZE], suggested[ISO_SUGGEST_SIZE];
    iso_text_quote(quoted, (const char *)n->data.scalar.value, n->data.scalar.length);
    return iso_yaml_fail(y, n->start_mark, "unknown %s '%s'; %s", what, quoted,
                         iso_suggest(suggested, quoted, count, names));
}

iso_status iso_yaml_once(iso_yaml *y, const yaml_node_t *mapping, const yaml_node_t *key, const char *name)
{
    const yaml_node_t *first = key;
    iso_yaml_find(y, mapping, name, &first, NULL);
    if (first == key) return ISO_OK;
    return iso_yaml_fail(y, key->start_mark, "duplicate key '%s', first written in line %zu", name,
                         first->start_mark.line + 1);
}

iso_status iso_yaml_key(iso_yaml *y, const yaml_node_t *mapping, const yaml_node_t *key, const char *unknown,
                        size_t count, const char *const names[], size_t *i)
{
    if (key->type != YAML_SCALAR_NODE)
        return iso_yaml_fail(y, key->start_mark, "a key should be a name, not a list or a mapping");
    for (*i = 0; *i < count && !iso_yaml_is(key, names[*i]);) ++*i;
    if (count == 0)
        return iso_yaml_fail(y, key->start_mark, "'%s': this has no settings: write {}",
                             (const char *)key->data.scalar.value);
    if (*i == count) return iso_yaml_unknown(y, key, unknown, count, names);
    return iso_yaml_once(y, mapping, key, names[*i]);
}

iso_status iso_yaml_word(const iso_yaml *y, const yaml_node_t *n, const char *what, const char *(*word)(int),
                         unsigned allowed, int *value)
{
    const char *names[8 * sizeof allowed];
    size_t count = 0;
    for (int i = 0; i < (int)(8 * sizeof allowed) && word(i); i++) {
        if (!(allowed >> i & 1)) continue;
        if (iso_yaml_is(n, word(i))) return *value = i, ISO_OK;
        names[count++] = word(i);
    }
    if (n->type != YAML_SCALAR_NODE || n->data.scalar.length == 0) return iso_yaml_expected(y, n, what, "a name");
    return iso_yaml_unknown(y, n, what, count, names);
}

static bool is_plain(const yaml_node_t *n)
{
    return n->type == YAML_SCALAR_NODE && n->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
}

static bool read_number(const yaml_node_t *n, double *value)
{
    return is_plain(n) && iso_rational_read_double((const char *)n->data.scalar.value, n->data.scalar.length, value);
}

iso_status iso_yaml_number(const iso_yaml *y, const yaml_node_t *n, const char *what, double *value)
{
    return read_number(n, value) ? ISO_OK : iso_yaml_expected(y, n, what, "a finite number");
}

iso_status iso_yaml_ratio(const iso_yaml *y, const yaml_node_t *n, const char *what, double *value)
{
    return read_number(n, value) ? ISO_OK
                                 : iso_yaml_expected(y, n, what, "a finite number or a fraction, such as 1/3");
}

iso_status iso_yaml_numbers(iso_yaml *y, const yaml_node_t *n, const char *what, int count, double values[])
{
    char expected[48] = "three rows of three numbers";
    const bool matrix = count == 9;
    if (!matrix) snprintf(expected, sizeof expected, "a list of %d finite numbers", count);
    if (n->type != YAML_SEQUENCE_NODE) return iso_yaml_expected(y, n, what, expected);
    const yaml_node_item_t *items = n->data.sequence.items.start;
    const long found = (long)(n->data.sequence.items.top - items), rows = matrix ? 3 : count;
    if (found != rows)
        return iso_yaml_fail(y, n->start_mark, "'%s' should be %s, not %s%ld", what, expected, matrix ? "" : "of ",
                             found);
    for (int i = 0; i < rows; i++) {
        const yaml_node_t *item = iso_yaml_node(y, items[i]);
        if (matrix) {
            ISO_TRY(iso_yaml_numbers(y, item, what, 3, values + 3 * i));
        } else if (!read_number(item, &values[i])) {
            snprintf(expected, sizeof expected, "%s[%d]", what, i + 1);
            return iso_yaml_expected(y, item, expected, "a finite number");
        }
    }
    return ISO_OK;
}

iso_status iso_yaml_flag(const iso_yaml *y, const yaml_node_t *n, const char *what, bool *value)
{
    *value = iso_yaml_is(n, "true");
    return is_plain(n) && (*value || iso_yaml_is(n, "false")) ? ISO_OK
                                                              : iso_yaml_expected(y, n, what, "true or false");
}
