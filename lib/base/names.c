/* names.c - the name that a wrong word is nearest to (names_impl.h). */
#include "base/names_impl.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST = 64, MOST_WORDS = 256 };

/* Letters to insert, drop, change or swap with their neighbour, capitals being equal to small ones. */
static size_t distance(const char *a, size_t la, const char *b, size_t lb)
{
    size_t rows[3][LONGEST], *before = rows[0], *last = rows[1], *now = rows[2];
    for (size_t j = 0; j <= lb; j++) last[j] = j;
    for (size_t i = 1; i <= la; i++) {
        now[0] = i;
        for (size_t j = 1; j <= lb; j++) {
            const int x = tolower((unsigned char)a[i - 1]), y = tolower((unsigned char)b[j - 1]);
            now[j] = last[j - 1] + (x != y);
            if (last[j] + 1 < now[j]) now[j] = last[j] + 1;
            if (now[j - 1] + 1 < now[j]) now[j] = now[j - 1] + 1;
            const bool swapped =
                i > 1 && j > 1 && x == tolower((unsigned char)b[j - 2]) && y == tolower((unsigned char)a[i - 2]);
            if (swapped && before[j - 2] + 1 < now[j]) now[j] = before[j - 2] + 1;
        }
        size_t *const oldest = before;
        before = last, last = now, now = oldest;
    }
    return last[lb];
}

const char *iso_nearest(const char *wrong, size_t count, const char *const names[])
{
    const char *best = NULL;
    const size_t length = strlen(wrong);
    size_t least = LONGEST;
    for (size_t i = 0; i < count && length < LONGEST; i++) {
        const size_t other = strlen(names[i]), longer = length > other ? length : other;
        if (other >= LONGEST) continue;
        const size_t d = distance(wrong, length, names[i], other);
        if (2 * d >= longer || d >= least) continue;
        least = d;
        best = names[i];
    }
    return best;
}

const char *iso_suggest(char out[ISO_SUGGEST_SIZE], const char *wrong, size_t count, const char *const names[])
{
    enum { ROOM_FOR_DOTS = 6 };
    const char *best = iso_nearest(wrong, count, names);
    if (best) return snprintf(out, ISO_SUGGEST_SIZE, "did you mean '%s'?", best), out;
    size_t used = (size_t)snprintf(out, ISO_SUGGEST_SIZE, "valid %s", count == 1 ? "is" : "are");
    for (size_t i = 0; i < count; i++) {
        if (used + strlen(names[i]) + 2 + ROOM_FOR_DOTS >= ISO_SUGGEST_SIZE) return strcpy(out + used, ", ..."), out;
        used += (size_t)sprintf(out + used, "%s %s", i ? "," : "", names[i]);
    }
    return out;
}

static size_t list_of(const char *(*word)(int i), const char *names[MOST_WORDS])
{
    size_t count = 0;
    while (word && count < MOST_WORDS && word((int)count)) names[count] = word((int)count), count++;
    return count;
}

const char *iso_nearest_word(const char *wrong, const char *(*word)(int i))
{
    const char *names[MOST_WORDS];
    return iso_nearest(wrong, list_of(word, names), names);
}

const char *iso_suggest_word(char out[ISO_SUGGEST_SIZE], const char *wrong, const char *(*word)(int i))
{
    const char *names[MOST_WORDS];
    return iso_suggest(out, wrong, list_of(word, names), names);
}
