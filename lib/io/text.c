/* text.c - text of users: opening and loading files, and what a message may show of them. */
#include "base/context_impl.h"
#include "io/replacement_impl.h"
#include "io/text_impl.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

const char *iso_text_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "<stdin>" : path;
}

iso_status iso_text_no_memory(iso_context *ctx, const char *what, const char *name)
{
    return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to %s '%s'", what, name);
}

FILE *iso_text_open(iso_context *ctx, const char *path)
{
    if (strcmp(path, "-") == 0) return stdin;
    FILE *file = fopen(path, "re");
    if (!file) iso_file_trouble(ctx, "open", path);
    return file;
}

void iso_text_close(FILE *file)
{
    if (file != stdin) fclose(file);
}

/* Grows a buffer until the file ends or is longer than the limit. */
static iso_status load(iso_context *ctx, FILE *file, const char *path, size_t limit, char **text, size_t *length)
{
    size_t room = 0;
    *length = 0;
    while (!feof(file) && *length <= limit) {
        if (room - *length < 2) {
            char *grown = realloc(*text, room = 2 * room + 4096);
            if (!grown) return iso_context_no_memory(ctx, "'%s'", path);
            *text = grown;
        }
        *length += fread(*text + *length, 1, room - *length - 1, file);
        if (ferror(file)) return iso_file_trouble(ctx, "read", path);
    }
    (*text)[*length] = '\0';
    if (*length <= limit) return ISO_OK;
    return iso_context_placed(
        ctx, ISO_FAIL_INPUT(ctx, "", "%s:1:1: larger than %zu MiB: this is no scene", path, limit >> 20));
}

iso_status iso_text_load(iso_context *ctx, const char *path, size_t limit, char **text, size_t *length)
{
    *text = NULL;
    FILE *file = iso_text_open(ctx, path);
    if (!file) return ISO_FILE_TROUBLE;
    const iso_status status = load(ctx, file, iso_text_name(path), limit, text, length);
    iso_text_close(file);
    if (status == ISO_OK) return ISO_OK;
    free(*text);
    *text = NULL;
    return status;
}

/* Bytes of the control characters of ASCII and, two bytes in UTF-8, of U+0080 to U+009F. */
static bool is_control(const char *text, size_t i, size_t length)
{
    const unsigned char c = (unsigned char)text[i];
    const unsigned char before = i > 0 ? (unsigned char)text[i - 1] : 0;
    const unsigned char after = i + 1 < length ? (unsigned char)text[i + 1] : 0;
    if (c == 0xC2) return after >= 0x80 && after < 0xA0;
    return c < 0x20 || c == 0x7f || (before == 0xC2 && c >= 0x80 && c < 0xA0);
}

const char *iso_text_quote(char quoted[ISO_QUOTE_SIZE], const char *text, size_t length)
{
    enum { SHOWN = 48 };
    size_t n = length < SHOWN ? length : SHOWN;
    if (n < length)
        while (n > 0 && (text[n] & 0xC0) == 0x80) n--; /* not in the middle of a character of UTF-8 */
    for (size_t i = 0; i < n; i++) quoted[i] = is_control(text, i, length) ? '?' : text[i];
    strcpy(quoted + n, n < length ? "..." : "");
    return quoted;
}
