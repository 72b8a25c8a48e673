/* csv_row.c - reads the numbers or the cells of one line of text. It has no memory of other lines: several threads
 * read rows at the same time. */
#define _GNU_SOURCE /* strtod_l */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/csv/csv_impl.h"
#include "io/table_impl.h"

enum { DECIMAL = 1, HEXADECIMAL = 2 };
static const unsigned char digit[256] = {
    ['0'] = 3, ['1'] = 3, ['2'] = 3, ['3'] = 3, ['4'] = 3, ['5'] = 3, ['6'] = 3, ['7'] = 3, ['8'] = 3, ['9'] = 3,
    ['+'] = 3, ['-'] = 3, ['.'] = 3, ['e'] = 3, ['E'] = 3, ['d'] = 3, ['D'] = 3, ['a'] = 2, ['b'] = 2, ['c'] = 2,
    ['f'] = 2, ['A'] = 2, ['B'] = 2, ['C'] = 2, ['F'] = 2, ['x'] = 2, ['X'] = 2, ['p'] = 2, ['P'] = 2};

/* An exponent may have the letter D, as Fortran writes it. strtod would also take "nan" and "infinity"; their letters
 * are not in the table above. */
bool iso_csv_read_number(locale_t plain, char **at, double *value)
{
    char *const start = *at, *end = start, *seen;
    const char *first = start + (*start == '-' || *start == '+');
    const unsigned char kind = first[0] == '0' && (first[1] == 'x' || first[1] == 'X') ? HEXADECIMAL : DECIMAL;
    for (; digit[(unsigned char)*end] & kind; end++)
        if (kind == DECIMAL && (*end | 0x20) == 'd') *end = 'e';
    *at = end;
    *value = strtod_l(start, &seen, plain);
    return end > start && seen == end && isfinite(*value);
}

/* The quote that a field begins with, and ends. */
static char quote_of(const char *at)
{
    return (*at == '"' || *at == '\'') && strchr(at + 1, *at) ? *at : '\0';
}

static iso_csv_wrong mistake(iso_csv_wrong wrong, char *at, size_t found, iso_csv_mistake *m)
{
    *m = (iso_csv_mistake){at, found};
    return wrong;
}

iso_csv_wrong iso_csv_read_row(const iso_csv_format *c, char *line, double row[], iso_csv_mistake *m)
{
    char *at = line;
    const char separator = c->separator;
    for (size_t i = 0;; i++) {
        while (iso_is_blank(*at)) at++;
        if (separator == ' ' && !*at) return i == c->fields ? ISO_CSV_GOOD : mistake(ISO_CSV_FEW, at, i, m);
        if (i == c->fields) return mistake(ISO_CSV_MANY, at, i, m);
        char *const start = at;
        const char quote = quote_of(at);
        at += quote != '\0';
        if (c->column[i] < 0) {
            if (quote) at = strchr(at, quote);
            at += strcspn(at, separator == ' ' ? " \t" : (char[]){separator, '\0'});
        } else if (!iso_csv_read_number(c->plain, &at, &row[c->column[i]]) || (quote && *at++ != quote)) {
            return mistake(ISO_CSV_NO_NUMBER, start, i, m);
        }
        const char *number_end = at;
        while (iso_is_blank(*at)) at++;
        if (separator == ' ' ? at == number_end && *at : *at != separator && *at)
            return mistake(ISO_CSV_NO_NUMBER, start, i, m);
        if (separator == ' ') continue;
        if (!*at) return i + 1 == c->fields ? ISO_CSV_GOOD : mistake(ISO_CSV_FEW, at, i + 1, m);
        at++;
    }
}

/* --- cells of other tables -------------------------------------------------------------------------------------- */

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
