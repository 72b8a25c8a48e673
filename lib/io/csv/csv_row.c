/* csv_row.c - reads the fields, the numbers or the cells of one line of text. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/number_impl.h"
#include "io/csv/csv_impl.h"
#include "io/table_impl.h"

/* --- fields ----------------------------------------------------------------------------------------------------- */

iso_csv_field iso_csv_trim(char *text, size_t length)
{
    while (length > 0 && iso_is_blank(*text)) text++, length--;
    while (length > 0 && iso_is_blank(text[length - 1])) length--;
    return (iso_csv_field){text, length};
}

iso_csv_field iso_csv_next_field(char separator, char **rest)
{
    char *start = *rest;
    if (separator == ' ') start += strspn(start, " \t");
    const size_t length = strcspn(start, separator == ' ' ? " \t" : (char[]){separator, '\0'});
    char *next = start + length;
    if (separator == ' ') next += strspn(next, " \t");
    *rest = *next ? next + (separator != ' ') : NULL;
    iso_csv_field f = iso_csv_trim(start, length);
    if (f.length > 1 && strchr("\"'", f.text[0]) && f.text[f.length - 1] == f.text[0]) f.text++, f.length -= 2;
    return f;
}

bool iso_csv_begins_as_number(iso_csv_field f)
{
    char copy[16];
    double value;
    snprintf(copy, sizeof copy, "%.*s", (int)f.length, f.text);
    const char *word = copy + (*copy == '-' || *copy == '+');
    return iso_number_scan(f.text, f.text + f.length, &value) || strcasecmp(word, "nan") == 0 ||
           strcasecmp(word, "inf") == 0 || strcasecmp(word, "infinity") == 0;
}

/* --- rows of trajectories --------------------------------------------------------------------------------------- */

/* Reads a decimal number whose exponent has the letter D, as Fortran writes it. */
static const char *read_fortran(char *at, const char *end, double *value)
{
    const size_t length = strspn(at, "+-.0123456789");
    const char letter = at[length];
    if ((letter | 0x20) != 'd') return NULL;
    at[length] = 'e';
    const char *after = iso_number_scan(at, end, value);
    at[length] = letter; /* messages show the file's text */
    return after;
}

bool iso_csv_read_number(char **at, const char *end, double *value)
{
    const char *after = iso_number_scan(*at, end, value);
    if (after && (*after | 0x20) == 'd') after = read_fortran(*at, end, value);
    if (!after || isalnum((unsigned char)*after) || *after == '.') return false;
    *at += after - *at;
    return true;
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

iso_csv_wrong iso_csv_read_row(const iso_csv_format *c, char *line, size_t length, double row[], iso_csv_mistake *m)
{
    char *at = line;
    const char *const end = line + length;
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
        } else if (!iso_csv_read_number(&at, end, &row[c->column[i]]) || (quote && *at++ != quote)) {
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

bool iso_csv_read_cell(char *cell, double *value)
{
    const bool minus = *cell == '-';
    char *end = cell;
    *value = !*cell || strcmp(cell + minus, "nan") == 0 ? (double)NAN : minus ? -INFINITY : INFINITY;
    return isnan(*value) || strcmp(cell + minus, "inf") == 0 ||
           (iso_csv_read_number(&end, cell + strlen(cell), value) && !*end);
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
