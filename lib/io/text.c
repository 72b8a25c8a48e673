/* text.c - text of users: opening and loading files, what a message may show of them, and the name they may have
 * meant. */
#include "base/place_impl.h"
#include "io/text_impl.h"

#include <ctype.h>
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

const char *iso_text_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "<stdin>" : path;
}

FILE *iso_text_open(iso_context *ctx, const char *path)
{
    if (strcmp(path, "-") == 0) return stdin;
    FILE *file = fopen(path, "re");
    if (!file) iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot open '%s': %s", path, strerror(errno));
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
            if (!grown) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for '%s'", path);
            *text = grown;
        }
        *length += fread(*text + *length, 1, room - *length - 1, file);
        if (ferror(file))
            return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot read '%s': %s", path, strerror(errno));
    }
    (*text)[*length] = '\0';
    if (*length <= limit) return ISO_OK;
    return iso_context_placed(
        ctx,
        iso_context_fail(ctx, ISO_BAD_INPUT, "", "%s:1:1: larger than %zu MiB: this is no scene", path, limit >> 20));
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

static size_t smallest(size_t a, size_t b, size_t c)
{
    const size_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}

/* Letters to insert, drop, change or swap with their neighbour, capitals being equal to small ones. */
static size_t distance(const char *a, size_t la, const char *b, size_t lb)
{
    size_t rows[3][ISO_QUOTE_SIZE], *before = rows[0], *last = rows[1], *now = rows[2];
    for (size_t j = 0; j <= lb; j++) last[j] = j;
    for (size_t i = 1; i <= la; i++) {
        now[0] = i;
        for (size_t j = 1; j <= lb; j++) {
            const int x = tolower((unsigned char)a[i - 1]), y = tolower((unsigned char)b[j - 1]);
            now[j] = smallest(last[j] + 1, now[j - 1] + 1, last[j - 1] + (x != y));
            const bool swapped =
                i > 1 && j > 1 && x == tolower((unsigned char)b[j - 2]) && y == tolower((unsigned char)a[i - 2]);
            if (swapped && before[j - 2] + 1 < now[j]) now[j] = before[j - 2] + 1;
        }
        size_t *const oldest = before;
        before = last, last = now, now = oldest;
    }
    return last[lb];
}

const char *iso_text_nearest(const char *wrong, size_t count, const char *const names[])
{
    const char *best = NULL;
    const size_t length = strlen(wrong);
    size_t least = ISO_QUOTE_SIZE;
    for (size_t i = 0; i < count && length < ISO_QUOTE_SIZE; i++) {
        const size_t other = strlen(names[i]), longer = length > other ? length : other;
        if (other >= ISO_QUOTE_SIZE) continue;
        const size_t d = distance(wrong, length, names[i], other);
        if (2 * d >= longer || d >= least) continue;
        least = d;
        best = names[i];
    }
    return best;
}

const char *iso_text_suggest(char out[ISO_SUGGEST_SIZE], const char *wrong, size_t count, const char *const names[])
{
    const char *best = iso_text_nearest(wrong, count, names);
    if (best) {
        snprintf(out, ISO_SUGGEST_SIZE, "did you mean '%s'?", best);
        return out;
    }
    size_t used = (size_t)snprintf(out, ISO_SUGGEST_SIZE, "valid %s", count == 1 ? "is" : "are");
    for (size_t i = 0; i < count && used < ISO_SUGGEST_SIZE; i++)
        used += (size_t)snprintf(out + used, ISO_SUGGEST_SIZE - used, "%s %s", i ? "," : "", names[i]);
    return out;
}
