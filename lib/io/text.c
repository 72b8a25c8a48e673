/* text.c - text of users: opening and loading files, and what a message may show of them. */
#include "io/text_impl.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "io/output_impl.h"

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

iso_status iso_text_load(iso_context *ctx, const char *path, char **text, size_t *length)
{
    size_t room = 0;
    iso_status status = ISO_OK;
    FILE *file = iso_text_open(ctx, path);
    const char *name = iso_text_name(path);
    *text = NULL, *length = 0;
    if (!file) return ISO_FILE_TROUBLE;
    while (status == ISO_OK && !feof(file) && *length <= ISO_LARGEST_TEXT) {
        if (room - *length < 2) {
            char *grown = realloc(*text, room = 2 * room + 4096);
            if (grown) *text = grown;
            if (!grown) status = iso_context_no_memory(ctx, "'%s'", name);
            if (!grown) break;
        }
        *length += fread(*text + *length, 1, room - *length - 1, file);
        if (ferror(file)) status = iso_file_trouble(ctx, "read", name);
    }
    iso_text_close(file);
    if (status == ISO_OK && *length > ISO_LARGEST_TEXT)
        status = iso_context_placed(ctx, ISO_FAIL_INPUT(ctx, "", "%s:1:1: larger than %d MiB: this is no scene", name,
                                                        ISO_LARGEST_TEXT >> 20));
    if (status != ISO_OK) return free(*text), *text = NULL, status;
    (*text)[*length] = '\0';
    return ISO_OK;
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
