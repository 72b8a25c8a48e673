/* csv_row.c - reads the fields, the numbers or the cells of one line of text. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/number_impl.h"
#include "io/csv/csv_impl.h"
#include "io/text_impl.h"

/* --- fields ----------------------------------------------------------------------------------------------------- */

iso_csv_field iso_csv_trim(char *text, size_t length)
{
    while (length > 0 && iso_is_blank(*text)) text++, length--;
    while (length > 0 && iso_is_blank(text[length - 1])) length--;
    return (iso_csv_field){text, length};
}

iso_csv_field iso_csv_next_field(const char *separators, char **rest)
{
    char *start = *rest;
    const bool blanks = *separators == ' ';
    if (blanks) start += strspn(start, separators);
    const size_t length = strcspn(start, separators);
    char *next = start + length;
    if (blanks) next += strspn(next, separators);
    *rest = *next ? next + !blanks : NULL;
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

/* Reads a finite number at *at, before `end`, and moves *at behind it. False: there is none. */
static bool read_number(char **at, const char *end, double *value)
{
    const char *after = iso_number_scan(*at, end, value);
    if (after && (*after | 0x20) == 'd') after = read_fortran(*at, end, value);
    if (!after || isalnum((unsigned char)*after) || *after == '.') return false;
    *at += after - *at;
    return true;
}

static iso_status fail_count(const iso_csv *c, const char *at, size_t found)
{
    return iso_csv_fail(c, at ? at : c->line + strlen(c->line),
                        "expected %zu numbers, one for each column, found %s%zu", c->fields, at ? "more than " : "",
                        found);
}

static iso_status fail_number(const iso_csv *c, char *start, size_t i)
{
    char quoted[ISO_QUOTE_SIZE], *rest = start;
    const iso_csv_field f = iso_csv_next_field(c->separators, &rest);
    const bool comma = *c->separators != ',' && memchr(f.text, ',', f.length);
    return iso_csv_fail(c, f.text, "expected a finite number for %s%s, not '%s'",
                        i + 1 == c->orbit ? ISO_ORBIT_COLUMN : iso_record_name(c->r->header, (size_t)c->column[i]),
                        comma ? ", with a decimal point" : "", iso_text_quote(quoted, f.text, f.length));
}

iso_status iso_csv_read_numbers(const iso_csv *c, double row[])
{
    char *at = c->line;
    const char *const end = c->line + c->length;
    const bool blanks = *c->separators == ' ';
    for (size_t i = 0;; i++) {
        while (iso_is_blank(*at)) at++;
        if (blanks && !*at) return i == c->fields ? ISO_OK : fail_count(c, NULL, i);
        if (i == c->fields) return fail_count(c, at, i);
        char *const start = at;
        const char quote = (*at == '"' || *at == '\'') && strchr(at + 1, *at) ? *at : '\0'; /* which also ends it */
        at += quote != '\0';
        if (c->column[i] < 0) {
            if (quote) at = strchr(at, quote);
            at += strcspn(at, c->separators);
        } else if (!read_number(&at, end, &row[c->column[i]]) || (quote && *at++ != quote)) {
            return fail_number(c, start, i);
        }
        const char *number_end = at;
        while (iso_is_blank(*at)) at++;
        if (blanks ? at == number_end && *at : *at != *c->separators && *at) return fail_number(c, start, i);
        if (blanks) continue;
        if (!*at) return i + 1 == c->fields ? ISO_OK : fail_count(c, NULL, i + 1);
        at++;
    }
}

/* --- cells of other tables -------------------------------------------------------------------------------------- */

/* Reads a quoted cell; "" in it is one quote. A closing quote stands before a comma or the end. */
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

/* Reads a cell as a number: finite, nan, inf, or empty, which is nan. */
static bool read_cell(char *cell, double *value)
{
    const bool minus = *cell == '-';
    char *end = cell;
    *value = !*cell || strcmp(cell + minus, "nan") == 0 ? (double)NAN : minus ? -INFINITY : INFINITY;
    return isnan(*value) || strcmp(cell + minus, "inf") == 0 ||
           (read_number(&end, cell + strlen(cell), value) && !*end);
}

/* A cell of an older table. The first one that is not empty says whether its column has words. A damaged number there
 * is taken for a word only if it does not begin as a number, and is found out by the next number. */
static iso_status guess_words(iso_csv *c, size_t column, char *cell, char *at)
{
    iso_record *const r = c->r->header;
    const iso_csv_field f = {cell, strlen(cell)};
    char quoted[ISO_QUOTE_SIZE];
    double number;
    if (f.length == 0) return ISO_OK;
    if (!c->typed[column]) iso_record_set_words(r, column, !iso_csv_begins_as_number(f));
    c->typed[column] = true;
    if (!iso_record_has_words(r, column) || !read_cell(cell, &number)) return ISO_OK;
    return iso_csv_fail(c, at, "expected a word for %s, as in the rows before, not the number %s",
                        iso_record_name(r, column), iso_text_quote(quoted, cell, f.length));
}

iso_status iso_csv_read_cells(iso_csv *c, double row[])
{
    iso_record *const r = c->r->header;
    char *rest = c->line, quoted[ISO_QUOTE_SIZE];
    for (size_t i = 0; i < c->fields; i++) {
        char *const at = rest ? rest : c->line + c->length;
        if (!rest) return iso_csv_fail(c, at, "expected more cells, one for each column");
        char *const cell = iso_csv_next_cell(&rest);
        if (!cell) return iso_csv_fail(c, at, "expected a closing quote");
        if (c->guesses) ISO_TRY(guess_words(c, i, cell, at));
        const bool words = iso_record_has_words(r, i) && c->typed[i];
        ISO_TRY(words ? iso_record_intern(c->ctx, r, cell, &row[i]) : ISO_OK);
        if (!words && !read_cell(cell, &row[i]))
            return iso_csv_fail(c, at, "expected a number for %s, not %s", iso_record_name(r, i),
                                iso_text_quote(quoted, cell, strlen(cell)));
    }
    return rest ? iso_csv_fail(c, rest, "expected one cell for each column, found more") : ISO_OK;
}

void iso_csv_settle_words(const iso_csv *c)
{
    iso_record *const r = c->r->header;
    for (size_t i = 0; i < c->fields; i++) {
        if (!c->r->any) iso_record_set_words(r, i, false);
        for (size_t row = 0; iso_record_has_words(r, i) && row < iso_record_rows(r); row++)
            if (isnan(iso_record_row(r, row)[i])) iso_record_row(r, row)[i] = 0;
    }
}
