/* csv_head.c - writes the beginning of a table in text (see table.h). */
#include <stdbool.h>
#include <string.h>

#include "io/csv/csv_impl.h"
#include "io/table_impl.h"

/* Whether reading the line back gives the same key and value. */
static bool is_line(const char *key, const char *value)
{
    const size_t k = strlen(key), v = strlen(value);
    if (k == 0 || strpbrk(key, ":\r\n") || strpbrk(value, "\r\n")) return false;
    if (strchr(" \t", key[0]) || strchr(" \t", key[k - 1])) return false;
    return v == 0 || (!strchr(" \t", value[0]) && !strchr(" \t", value[v - 1]));
}

/* A text of whole lines, under a key that is one word. */
static bool is_text(const char *key, const char *value)
{
    const size_t length = strlen(value);
    return *key && !strpbrk(key, " \t:|\r\n") && length > 0 && value[length - 1] == '\n';
}

static iso_status check_line(iso_context *ctx, const char *key, const char *value)
{
    if (is_line(key, value) || is_text(key, value)) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                            "'%s' cannot be a line '# key: value': a key has no colon, and both are one line", key);
}

/* Each line of a text as a comment. */
static void write_text(FILE *to, const char *key, const char *text)
{
    const bool plain = strcmp(key, ISO_TABLE_TEXT) == 0;
    while (*text) {
        const size_t length = strcspn(text, "\r\n");
        fprintf(to, "# %s%s| %.*s\n", plain ? "" : key, plain ? "" : " ", (int)length, text);
        text += length;
        if (*text == '\r') text++;
        if (*text == '\n') text++;
    }
}

iso_status iso_table_line(iso_context *ctx, FILE *to, const char *key, const char *value)
{
    const bool text = is_text(key, value);
    const iso_status status = text ? ISO_OK : check_line(ctx, key, value);
    if (text)
        write_text(to, key, value);
    else if (status == ISO_OK)
        fprintf(to, *value ? "# %s: %s\n" : "# %s:\n", key, value);
    return status;
}

iso_status iso_table_begin(iso_context *ctx, FILE *to, const char *kind, const iso_record *header)
{
    const char *key, *value;
    iso_status status = ISO_OK;
    for (size_t i = 0; status == ISO_OK && iso_record_line(header, i, &key, &value); i++)
        status = check_line(ctx, key, value);
    if (status != ISO_OK) return status;
    fprintf(to, "# isoroll %s 1\n", kind);
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++) iso_table_line(ctx, to, key, value);
    for (size_t i = 0; i < iso_record_columns(header); i++) fprintf(to, i ? ",%s" : "%s", iso_record_name(header, i));
    fputc('\n', to);
    return ISO_OK;
}
