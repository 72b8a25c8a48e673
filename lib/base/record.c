/* record.c - a table in memory: named columns, rows, words, and "# key: value" lines (record.h). */
#include "base/record_impl.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"

enum { NAME_SIZE = 64, KIND_SIZE = 32 };

typedef struct line {
    char *key, *value;
    size_t length, room; /* of a value that grows; else 0 */
} line;

struct iso_record {
    size_t columns, rows, room;
    struct {
        char name[NAME_SIZE];
        bool words;
        iso_column_format format;
    } * column;
    double *data;
    size_t lines;
    line *line;
    double row_tolerance;
    char kind[KIND_SIZE];
    size_t words, buckets; /* buckets: 0, or a power of 2 above twice the words */
    char **word;           /* by its number, from 1 on */
    char *text;            /* what a study prints; NULL: nothing */
    size_t *bucket;        /* the number of a word whose hash leads here; 0: none */
};

static iso_status no_memory(iso_context *ctx)
{
    return iso_context_no_memory(ctx, "a table");
}

iso_status iso_record_create(iso_context *ctx, size_t columns, const char *const names[], iso_record **record)
{
    *record = NULL;
    for (size_t i = 0; i < columns; i++) {
        if (strlen(names[i]) >= NAME_SIZE)
            return ISO_FAIL_ARGUMENT(ctx, "", "column name '%s' is longer than %d characters", names[i],
                                     NAME_SIZE - 1);
        for (size_t j = 0; j < i; j++)
            if (strcmp(names[i], names[j]) == 0)
                return ISO_FAIL_ARGUMENT(ctx, "", "column '%s' appears twice", names[i]);
    }
    iso_record *r = calloc(1, sizeof *r);
    if (!r) return no_memory(ctx);
    r->columns = columns;
    r->row_tolerance = ISO_ROW_TOLERANCE;
    r->column = calloc(columns + 1, sizeof *r->column);
    if (!r->column) return iso_record_free(r), no_memory(ctx);
    for (size_t i = 0; i < columns; i++) memcpy(r->column[i].name, names[i], strlen(names[i]) + 1);
    *record = r;
    return ISO_OK;
}

void iso_record_free(iso_record *r)
{
    if (!r) return;
    for (size_t i = 0; i < r->lines; i++) {
        free(r->line[i].key);
        free(r->line[i].value);
    }
    for (size_t i = 1; i <= r->words; i++) free(r->word[i]);
    free(r->word);
    free(r->text);
    free(r->bucket);
    free(r->line);
    free(r->column);
    free(r->data);
    free(r);
}

iso_status iso_record_create_like(iso_context *ctx, const iso_record *other, size_t columns,
                                  const char *const names[], iso_record **record)
{
    const size_t count = names ? columns : other->columns;
    const char **name = calloc(count + 1, sizeof *name);
    *record = NULL;
    for (size_t i = 0; name && i < count; i++) name[i] = names ? names[i] : other->column[i].name;
    iso_status status = name ? iso_record_create(ctx, count, name, record) : no_memory(ctx);
    free(name);
    if (status != ISO_OK) return status;
    (*record)->row_tolerance = other->row_tolerance;
    iso_record_set_kind(*record, other->kind);
    if (!names) memcpy((*record)->column, other->column, count * sizeof *other->column);
    for (size_t i = 0; status == ISO_OK && i < other->lines; i++)
        status = iso_record_set(ctx, *record, other->line[i].key, other->line[i].value);
    if (status != ISO_OK) iso_record_free(*record), *record = NULL;
    return status;
}

const char *iso_record_kind(const iso_record *r)
{
    return r->kind;
}

void iso_record_set_kind(iso_record *r, const char *kind)
{
    char copy[KIND_SIZE];
    snprintf(copy, sizeof copy, "%s", kind);
    memcpy(r->kind, copy, sizeof copy);
}

size_t iso_record_columns(const iso_record *r)
{
    return r->columns;
}

void iso_record_set_row_tolerance(iso_record *r, double tolerance)
{
    r->row_tolerance = tolerance;
}

double iso_record_row_tolerance(const iso_record *r)
{
    return r->row_tolerance;
}

size_t iso_record_rows(const iso_record *r)
{
    return r->rows;
}

const char *iso_record_name(const iso_record *r, size_t column)
{
    return r->column[column].name;
}

int iso_record_find(const iso_record *r, const char *name)
{
    for (size_t i = 0; i < r->columns; i++)
        if (strcmp(r->column[i].name, name) == 0) return (int)i;
    return -1;
}

bool iso_record_find_all(const iso_record *r, size_t count, const char *const names[], int columns[],
                         const char **missing)
{
    for (size_t i = 0; i < count; i++) {
        columns[i] = iso_record_find(r, names[i]);
        if (columns[i] >= 0) continue;
        if (missing) *missing = names[i];
        return false;
    }
    return true;
}

double *iso_record_row(iso_record *r, size_t row)
{
    return r->data + row * r->columns;
}

const double *iso_record_const_row(const iso_record *r, size_t row)
{
    return r->data + row * r->columns;
}

iso_status iso_record_append(iso_context *ctx, iso_record *r, double **row)
{
    if (r->rows == r->room) {
        const size_t room = r->room ? 2 * r->room : 64;
        double *data = realloc(r->data, room * (r->columns ? r->columns : 1) * sizeof *data);
        if (!data) return no_memory(ctx);
        r->data = data;
        r->room = room;
    }
    *row = iso_record_row(r, r->rows++);
    memset(*row, 0, r->columns * sizeof **row);
    return ISO_OK;
}

iso_status iso_record_add(iso_context *ctx, iso_record *r, size_t count, const double rows[])
{
    iso_status status = ISO_OK;
    double *row;
    for (size_t i = 0; status == ISO_OK && i < count; i++) {
        status = iso_record_append(ctx, r, &row);
        if (status == ISO_OK && r->columns > 0) memcpy(row, rows + i * r->columns, r->columns * sizeof *row);
    }
    return status;
}

/* --- words ------------------------------------------------------------------------------------------------------ */

void iso_record_set_words(iso_record *r, size_t column, bool words)
{
    r->column[column].words = words;
}

bool iso_record_has_words(const iso_record *r, size_t column)
{
    return r->column[column].words;
}

iso_column_format *iso_record_format(const iso_record *r, size_t column)
{
    return &r->column[column].format;
}

/* Where the word is, or would be. */
static size_t *find_word(const iso_record *r, const char *word)
{
    uint64_t hash = 0xcbf29ce484222325; /* FNV-1a */
    for (const char *c = word; *c; c++) hash = (hash ^ (unsigned char)*c) * 0x100000001b3;
    size_t at = (size_t)(hash ^ hash >> 32);
    while (r->bucket[at &= r->buckets - 1] > 0 && strcmp(r->word[r->bucket[at]], word) != 0) at++;
    return &r->bucket[at];
}

/* Room for one more word. */
static bool grow_words(iso_record *r)
{
    if (2 * (r->words + 1) < r->buckets) return true;
    const size_t buckets = r->buckets ? 2 * r->buckets : 16;
    char **word = realloc(r->word, (buckets / 2 + 1) * sizeof *word);
    if (word) r->word = word;
    size_t *bucket = word ? calloc(buckets, sizeof *bucket) : NULL;
    if (!bucket) return false;
    free(r->bucket);
    r->bucket = bucket;
    r->buckets = buckets;
    for (size_t i = 1; i <= r->words; i++) *find_word(r, r->word[i]) = i;
    return true;
}

iso_status iso_record_intern(iso_context *ctx, iso_record *r, const char *word, double *number)
{
    *number = 0;
    if (!*word) return ISO_OK;
    if (!grow_words(r)) return no_memory(ctx);
    size_t *const at = find_word(r, word);
    if (*at == 0) {
        if (!(r->word[r->words + 1] = strdup(word))) return no_memory(ctx);
        *at = ++r->words;
    }
    *number = (double)*at;
    return ISO_OK;
}

void iso_record_forget_words(iso_record *r)
{
    for (; r->words > 0; r->words--) {
        *find_word(r, r->word[r->words]) = 0; /* the last one of its hash: no other is sought beyond it */
        free(r->word[r->words]);
    }
}

const char *iso_record_word(const iso_record *r, double number)
{
    return number >= 1 && number <= (double)r->words ? r->word[(size_t)number] : "";
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

static line *find_line(const iso_record *r, const char *key)
{
    for (size_t i = 0; i < r->lines; i++)
        if (strcmp(r->line[i].key, key) == 0) return &r->line[i];
    return NULL;
}

const char *iso_record_get(const iso_record *r, const char *key)
{
    const line *l = find_line(r, key);
    return l ? l->value : NULL;
}

static void remove_line(iso_record *r, line *l)
{
    if (!l) return;
    free(l->key);
    free(l->value);
    memmove(l, l + 1, (size_t)(r->line + --r->lines - l) * sizeof *l);
}

iso_status iso_record_set(iso_context *ctx, iso_record *r, const char *key, const char *value)
{
    if (!value) return remove_line(r, find_line(r, key)), ISO_OK;
    char *copy = strdup(value);
    if (!copy) return no_memory(ctx);
    line *l = find_line(r, key), *grown = l ? r->line : realloc(r->line, (r->lines + 1) * sizeof *grown);
    if (grown) r->line = grown;
    char *name = l ? l->key : grown ? strdup(key) : NULL;
    if (!name) return free(copy), no_memory(ctx);
    if (l) free(l->value);
    if (!l) l = &r->line[r->lines++];
    *l = (line){.key = name, .value = copy};
    return ISO_OK;
}

void iso_record_forget_lines(iso_record *r)
{
    while (r->lines > 0) remove_line(r, &r->line[r->lines - 1]);
}

iso_status iso_record_add_line(iso_context *ctx, iso_record *r, const char *key, const char *text)
{
    const size_t length = strlen(text);
    ISO_TRY(find_line(r, key) ? ISO_OK : iso_record_set(ctx, r, key, ""));
    line *l = find_line(r, key);
    if (l->room == 0) l->length = strlen(l->value);
    const size_t room = l->length + length + 2;
    char *value = room > l->room ? realloc(l->value, 2 * room) : l->value;
    if (!value) return no_memory(ctx);
    if (room > l->room) l->room = 2 * room;
    l->value = value;
    memcpy(value + l->length, text, length);
    memcpy(value + l->length + length, "\n", 2);
    l->length += length + 1;
    return ISO_OK;
}

iso_status iso_record_set_numbers(iso_context *ctx, iso_record *r, const char *key, size_t count,
                                  const double values[])
{
    char *text = malloc(count * ISO_NUMBER_SIZE + 1), *end = text;
    if (!text) return no_memory(ctx);
    *text = '\0';
    for (size_t i = 0; i < count; i++) {
        if (i > 0) *end++ = ' ';
        end += strlen(iso_number_short(end, values[i]));
    }
    const iso_status status = iso_record_set(ctx, r, key, text);
    free(text);
    return status;
}

bool iso_record_line(const iso_record *r, size_t i, const char **key, const char **value)
{
    if (i >= r->lines) return false;
    *key = r->line[i].key;
    *value = r->line[i].value;
    return true;
}

bool iso_record_get_numbers(iso_context *ctx, const iso_record *r, const char *key, size_t count, double values[],
                            iso_status *status)
{
    const char *text = iso_record_get(r, key), *at = text;
    size_t found = 0, length;
    *status = ISO_OK;
    if (!text) return false;
    for (; (length = strcspn(at += strspn(at, " \t,"), " \t,")) > 0; at += length, found++)
        if (found == count || !iso_number_read(at, length, &values[found])) break;
    if (found == count && length == 0) return true;
    *status =
        ISO_FAIL_INPUT(ctx, key, "'%s: %s' should be %zu finite number%s", key, text, count, count == 1 ? "" : "s");
    return false;
}

void iso_record_keep_text(iso_record *r, char *text)
{
    free(r->text);
    r->text = text;
}

const char *iso_record_text(const iso_record *r)
{
    return r->text;
}
