/* csv_table.c - what only tables of isoroll have: cells with nan and words, perhaps in quotes; texts in lines of
 * #. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/csv/csv_impl.h"
#include "io/table_impl.h"

/* Takes a cell in quotes, in which two quotes are one. A quote that no comma follows is none of the two. */
static char *take_quoted(char **rest)
{
    char *const text = *rest + 1, *to = text;
    for (const char *at = text; *at; at++) {
        if (*at == '"' && (at[1] == ',' || !at[1])) {
            *rest = at[1] ? *rest + (at + 2 - *rest) : NULL;
            *to = '\0';
            return text;
        }
        at += at[0] == '"' && at[1] == '"';
        *to++ = *at;
    }
    return NULL;
}

char *iso_csv_next_cell(char **rest)
{
    char *const text = *rest, *const end = strchr(text, ',');
    if (*text == '"') return take_quoted(rest);
    if (end) *end = '\0';
    *rest = end ? end + 1 : NULL;
    return text;
}

bool iso_csv_read_cell(locale_t plain, char *cell, double *value)
{
    const bool minus = *cell == '-';
    char *end = cell;
    *value = !*cell || strcmp(cell + minus, "nan") == 0 ? (double)NAN : minus ? -INFINITY : INFINITY;
    return isnan(*value) || strcmp(cell + minus, "inf") == 0 || (iso_csv_read_number(plain, &end, value) && !*end);
}

/* --- texts ------------------------------------------------------------------------------------------------------ */

const char *iso_csv_text_line(const char *line, char key[ISO_TEXT_KEY])
{
    const char *begin = line + 1 + (line[1] == ' ');
    const size_t length = strcspn(begin, " \t:|");
    const char *bar = begin + length + (length > 0 && begin[length] == ' ');
    if (*bar != '|' || length >= ISO_TEXT_KEY || (bar[1] && bar[1] != ' ')) return NULL;
    snprintf(key, ISO_TEXT_KEY, "%.*s", length ? (int)length : ISO_TEXT_KEY, length ? begin : ISO_TABLE_TEXT);
    return bar + 1 + (bar[1] == ' ');
}
