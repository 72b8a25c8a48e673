/* csv_reader.c - reads trajectories from text: files of isoroll and of other programs. csv_writer.c writes them. */
#include <ctype.h>
#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/number.h"
#include "base/place_impl.h"
#include "io/text_impl.h"
#include "io/trajectory_impl.h"
#include "orbit/scene.h"

enum { LONGEST_LINE = 1 << 16, MOST_FIELDS = 1024, MOST_KEYS = 4096 };

typedef struct csv {
    iso_context *ctx;
    iso_trajectory_reader *r;
    FILE *file;
    char *buffer; /* 2 LONGEST_LINE + 1 characters, of which begin to end - 1 are still to be read */
    size_t begin, end;
    bool ended, ours, again;    /* the file ended; it has our first line; the line is to be read once more */
    bool callers;               /* `line` is the caller's names of columns, no line of the file */
    char *line;                 /* in the buffer, without its end */
    size_t length, number;      /* number: of the line, from 1 */
    char separator;             /* ',', ';', or ' ' for blanks */
    char comment[LONGEST_LINE]; /* the last line of # that is no key: perhaps names */
    size_t fields;
    short column[MOST_FIELDS]; /* of the record, for each field of the file; -1: passed over */
    locale_t plain;
} csv;

/* A part of a line without the blanks around it, and the quotes. */
typedef struct field {
    char *text;
    size_t length;
} field;

static iso_status fail(const csv *c, const char *at, const char *message, const char *detail)
{
    if (c->callers) return iso_context_fail(c->ctx, ISO_BAD_ARGUMENT, "columns", "columns: %s%s", message, detail);
    size_t column = 1; /* in characters of UTF-8, as for scenes */
    for (const char *x = c->line; at && x < at; x++) column += (*x & 0xC0) != 0x80;
    return iso_context_placed(c->ctx, iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "%s:%zu:%zu: %s%s", c->r->name,
                                                       c->number ? c->number : 1, column, message, detail));
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* Reads on behind what is in the buffer, which is moved to its front. */
static iso_status fill(csv *c)
{
    memmove(c->buffer, c->buffer + c->begin, c->end - c->begin);
    c->end -= c->begin;
    c->begin = 0;
    for (;;) {
        const ssize_t got = read(fileno(c->file), c->buffer + c->end, 2 * LONGEST_LINE - c->end);
        if (got > 0) c->end += (size_t)got;
        if (got == 0) c->ended = true;
        if (got >= 0) return ISO_OK;
        if (errno != EINTR)
            return iso_context_fail(c->ctx, ISO_FILE_TROUBLE, "", "cannot read '%s': %s", c->r->name,
                                    strerror(errno));
        if (!iso_context_goes_on(c->ctx)) return iso_context_fail(c->ctx, ISO_STOPPED, "", "stopped on request");
    }
}

/* Reads on to the end of a line of which the buffer holds the beginning. */
static iso_status skip_line(csv *c)
{
    const char *end = NULL;
    iso_status status = ISO_OK;
    while (!c->ended && !end && status == ISO_OK) {
        c->begin = c->end;
        status = fill(c);
        end = memchr(c->buffer, '\n', c->end);
    }
    c->begin = end ? (size_t)(end - c->buffer) + 1 : c->end;
    return status;
}

/* The next line, without its end; false at the end of the file. */
static iso_status next_line(csv *c, bool *more)
{
    char *end;
    *more = true;
    if (c->again) return c->again = false, ISO_OK;
    while (!(end = memchr(c->buffer + c->begin, '\n', c->end - c->begin)) && !c->ended) {
        if (c->end - c->begin >= LONGEST_LINE) break;
        const iso_status status = fill(c);
        if (status != ISO_OK) return status;
    }
    c->line = c->buffer + c->begin;
    c->length = (size_t)((end ? end : c->buffer + c->end) - c->line);
    c->begin += c->length + (end != NULL);
    *more = end || c->length > 0;
    c->line[c->length] = '\0';
    c->number += *more;
    if (c->length >= LONGEST_LINE) {
        const iso_status status = end ? ISO_OK : skip_line(c);
        if (status != ISO_OK) return status;
        return fail(c, c->line, "this line is longer than 64 KiB: is this a trajectory file?", "");
    }
    if (c->number == 1 && strncmp(c->line, "\xEF\xBB\xBF", 3) == 0) c->line += 3, c->length -= 3; /* byte order */
    const char *nul = memchr(c->line, '\0', c->length);
    if (nul) return fail(c, nul, "a NUL byte: this is not a text file", "");
    while (c->length > 0 && c->line[c->length - 1] == '\r') c->line[--c->length] = '\0';
    return ISO_OK;
}

static bool is_blank(char x)
{
    return x == ' ' || x == '\t';
}

static field trim(char *text, size_t length)
{
    while (length > 0 && is_blank(*text)) text++, length--;
    while (length > 0 && is_blank(text[length - 1])) length--;
    return (field){text, length};
}

/* "# key: value"; without a colon it may be a line of names. Behind rows a key may be said again. */
static iso_status read_key_line(csv *c)
{
    char *colon = strchr(c->line, ':'), quoted[ISO_QUOTE_SIZE];
    const char *last_key, *last_value;
    if (!colon) snprintf(c->comment, sizeof c->comment, "%s", c->line + 1);
    if (!colon) return ISO_OK;
    const field key = trim(c->line + 1, (size_t)(colon - c->line - 1)), value = trim(colon + 1, strlen(colon + 1));
    if (key.length == 0 || (colon[1] && !is_blank(colon[1]))) return ISO_OK;
    key.text[key.length] = value.text[value.length] = '\0';
    if (iso_record_get(c->r->header, key.text) && c->fields == 0)
        return fail(c, key.text, "duplicate key ", iso_text_quote(quoted, key.text, key.length));
    if (iso_record_line(c->r->header, MOST_KEYS - 1, &last_key, &last_value))
        return fail(c, key.text, "more than 4096 lines '# key: value': is this a trajectory file?", "");
    return iso_record_set(c->ctx, c->r->header, key.text, value.text);
}

static iso_status read_magic(csv *c)
{
    const char *version = c->line + strlen(ISO_TRAJECTORY_MAGIC);
    char quoted[ISO_QUOTE_SIZE];
    c->ours = true;
    if (strcmp(version, ISO_TRAJECTORY_VERSION) == 0) return ISO_OK;
    return fail(c, version, "expected version " ISO_TRAJECTORY_VERSION " of the trajectory format, not ",
                iso_text_quote(quoted, version, strlen(version)));
}

/* The next line that is neither empty nor of #. */
static iso_status next_data(csv *c, bool *more)
{
    iso_status status;
    while ((status = next_line(c, more)) == ISO_OK && *more) {
        if (c->line[0] != '#') {
            if (trim(c->line, c->length).length > 0) return ISO_OK;
            continue;
        }
        const bool magic = strncmp(c->line, ISO_TRAJECTORY_MAGIC, strlen(ISO_TRAJECTORY_MAGIC)) == 0;
        if (magic && c->fields > 0) continue;
        status = magic && c->number == 1 ? read_magic(c) : read_key_line(c);
        if (status != ISO_OK) return status;
    }
    return status;
}

/* --- names ------------------------------------------------------------------------------------------------------ */

static char separator_of(const char *line)
{
    return strchr(line, ';') ? ';' : strchr(line, ',') ? ',' : ' ';
}

/* The next field of *rest, which then begins behind it (NULL after the last). */
static field next_field(char separator, char **rest)
{
    char *start = *rest;
    if (separator == ' ') start += strspn(start, " \t");
    const size_t length = strcspn(start, separator == ' ' ? " \t" : (char[]){separator, '\0'});
    char *next = start + length;
    if (separator == ' ') next += strspn(next, " \t");
    *rest = *next ? next + (separator != ' ') : NULL;
    field f = trim(start, length);
    if (f.length > 1 && strchr("\"'", f.text[0]) && f.text[f.length - 1] == f.text[0]) f.text++, f.length -= 2;
    return f;
}

/* A column with an unknown name. In a file of isoroll it is a mistake; in other files it is ignored. */
static iso_status skip_column(csv *c, const field *f, bool named)
{
    char quoted[ISO_QUOTE_SIZE], suggested[ISO_SUGGEST_SIZE], detail[ISO_QUOTE_SIZE + ISO_SUGGEST_SIZE + 8];
    iso_text_quote(quoted, f->text, f->length);
    const char *names[ISO_TRAJECTORY_COLUMNS];
    const int columns = iso_column_names(names);
    iso_text_suggest(suggested, quoted, (size_t)columns, names);
    if (c->ours || named) {
        snprintf(detail, sizeof detail, "'%s'; %s", quoted, suggested);
        return fail(c, f->text, "unknown column ", detail);
    }
    char *to = c->r->ignored;
    const size_t used = strlen(to), room = sizeof c->r->ignored - used;
    const bool near = iso_text_nearest(quoted, (size_t)columns, names) != NULL;
    if (f->length > 0 && room > 2 * ISO_QUOTE_SIZE)
        snprintf(to + used, room, "%s'%s'%s%s%s", used ? ", " : "", quoted, near ? " (" : "", near ? suggested : "",
                 near ? ")" : "");
    return ISO_OK;
}

/* Columns from a line of names: the file's, or the caller's (`named`). */
static iso_status read_names(csv *c, char *line, char separator, bool named)
{
    const char *names[ISO_TRAJECTORY_COLUMNS];
    size_t count = 0;
    double number;
    iso_status status = ISO_OK;
    for (char *rest = line; rest && status == ISO_OK; c->fields++) {
        const field f = next_field(separator, &rest);
        if (c->fields == MOST_FIELDS) return fail(c, f.text, "more than 1024 columns", "");
        f.text[f.length] = '\0';
        c->column[c->fields] = -1;
        const int known = iso_column_find(f.text);
        if (named && strcmp(f.text, "-") == 0) continue;
        if (c->again && iso_number_read(f.text, f.length, &number))
            return fail(c, f.text, "expected a line of column names such as t,omega1,omega2,... before the numbers",
                        "");
        if (known < 0) {
            status = skip_column(c, &f, named);
            continue;
        }
        for (size_t i = 0; i < count; i++)
            if (strcmp(names[i], f.text) == 0) return fail(c, f.text, "duplicate column ", f.text);
        c->column[c->fields] = (short)count;
        names[count++] = iso_column_name(known);
    }
    char *first = line;
    const field f = next_field(separator, &first);
    if (status == ISO_OK && count == 0) status = skip_column(c, &f, true);
    return status == ISO_OK ? iso_trajectory_name_columns(c->ctx, c->r, count, names) : status;
}

static bool begins_with_number(csv *c)
{
    char *rest = c->line, *end;
    const field f = next_field(separator_of(c->line), &rest);
    char copy[64] = "";
    if (f.length == 0 || f.length >= sizeof copy) return false;
    memcpy(copy, f.text, f.length);
    strtod_l(copy, &end, c->plain);
    return end > copy && (*end == '\0' || !isalpha((unsigned char)*copy)); /* "nan" is one, "info" none */
}

/* Names of columns: the caller's, else those of the first line of data, else those of the line of # before it. */
static iso_status read_header(csv *c, const char *columns)
{
    bool more;
    iso_status status = next_data(c, &more);
    if (status != ISO_OK) return status;
    if (!more)
        return fail(c, NULL, "expected a line of column names such as t,omega1,omega2,..., found the end of the file",
                    "");
    char *const line = c->line, *names = columns ? strdup(columns) : NULL;
    const bool numbers = c->again = begins_with_number(c);
    c->separator = separator_of(line);
    if (columns && !names) return iso_context_fail(c->ctx, ISO_NO_MEMORY, "", "no memory for column names");
    const bool above = !columns && numbers && !c->ours && *c->comment;
    if (columns || above) c->line = columns ? names : c->comment;
    c->callers = columns != NULL;
    status = read_names(c, c->line, columns ? ',' : separator_of(c->line), columns != NULL);
    c->callers = false;
    free(names);
    c->line = line;
    return status;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

enum { DECIMAL = 1, HEXADECIMAL = 2 };
static const unsigned char digit[256] = {
    ['0'] = 3, ['1'] = 3, ['2'] = 3, ['3'] = 3, ['4'] = 3, ['5'] = 3, ['6'] = 3, ['7'] = 3, ['8'] = 3, ['9'] = 3,
    ['+'] = 3, ['-'] = 3, ['.'] = 3, ['e'] = 3, ['E'] = 3, ['d'] = 3, ['D'] = 3, ['a'] = 2, ['b'] = 2, ['c'] = 2,
    ['f'] = 2, ['A'] = 2, ['B'] = 2, ['C'] = 2, ['F'] = 2, ['x'] = 2, ['X'] = 2, ['p'] = 2, ['P'] = 2};

/* Reads a number at *at and moves *at behind it. False: there is none. An exponent may have the letter D, as Fortran
 * writes it. strtod would also take "nan" and "infinity"; their letters are not in the table above. */
static bool read_number(const csv *c, char **at, double *value)
{
    char *const start = *at, *end = start, *seen;
    const char *first = start + (*start == '-' || *start == '+');
    const unsigned char kind = first[0] == '0' && (first[1] == 'x' || first[1] == 'X') ? HEXADECIMAL : DECIMAL;
    for (; digit[(unsigned char)*end] & kind; end++)
        if (kind == DECIMAL && (*end | 0x20) == 'd') *end = 'e';
    *at = end;
    *value = strtod_l(start, &seen, c->plain);
    return end > start && seen == end && isfinite(*value);
}

static iso_status fail_count(const csv *c, const char *at, size_t found)
{
    char detail[64];
    snprintf(detail, sizeof detail, "%zu numbers, one for each column, found %s%zu", c->fields,
             at ? "more than " : "", found);
    return fail(c, at ? at : c->line + strlen(c->line), "expected ", detail);
}

static iso_status fail_number(const csv *c, char *start, size_t i)
{
    char quoted[ISO_QUOTE_SIZE], detail[2 * ISO_QUOTE_SIZE], *rest = start;
    const field f = next_field(c->separator, &rest);
    const bool comma = c->separator != ',' && memchr(f.text, ',', f.length);
    snprintf(detail, sizeof detail, comma ? "%s, with a decimal point, not '%s'" : "%s, not '%s'",
             iso_record_name(c->r->header, (size_t)c->column[i]), iso_text_quote(quoted, f.text, f.length));
    return fail(c, f.text, "expected a finite number for ", detail);
}

/* The quote that a field begins with, and ends. */
static char quote_of(const char *at)
{
    return (*at == '"' || *at == '\'') && strchr(at + 1, *at) ? *at : '\0';
}

static iso_status read_row(const csv *c, double row[])
{
    char *at = c->line;
    const char separator = c->separator;
    for (size_t i = 0;; i++) {
        while (is_blank(*at)) at++;
        if (separator == ' ' && !*at) return i == c->fields ? ISO_OK : fail_count(c, NULL, i);
        if (i == c->fields) return fail_count(c, at, c->fields);
        char *const start = at;
        const char quote = quote_of(at);
        at += quote != '\0';
        if (c->column[i] < 0) {
            if (quote) at = strchr(at, quote);
            at += strcspn(at, separator == ' ' ? " \t" : (char[]){separator, '\0'});
        } else if (!read_number(c, &at, &row[c->column[i]]) || (quote && *at++ != quote)) {
            return fail_number(c, start, i);
        }
        const char *number_end = at;
        while (is_blank(*at)) at++;
        if (separator == ' ' ? at == number_end && *at : *at != separator && *at) return fail_number(c, start, i);
        if (separator == ' ') continue;
        if (!*at) return i + 1 == c->fields ? ISO_OK : fail_count(c, NULL, i + 1);
        at++;
    }
}

static iso_status csv_next(iso_context *ctx, iso_trajectory_reader *r, double row[], bool *more)
{
    csv *c = r->data;
    c->ctx = ctx;
    const iso_status status = next_data(c, more);
    r->line = c->number;
    return status == ISO_OK && *more ? read_row(c, row) : status;
}

/* --- opening and closing ---------------------------------------------------------------------------------------- */

static void csv_close(iso_trajectory_reader *r)
{
    csv *c = r->data;
    if (!c) return;
    if (c->file) iso_text_close(c->file);
    if (c->plain) freelocale(c->plain);
    free(c->buffer);
    free(c);
}

static iso_status csv_open(iso_context *ctx, iso_trajectory_reader *r, const char *columns)
{
    csv *c = r->data = calloc(1, sizeof *c);
    if (c) {
        c->ctx = ctx;
        c->r = r;
        c->line = c->buffer = malloc(2 * LONGEST_LINE + 1);
        c->plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    }
    if (!c || !c->buffer || !c->plain)
        return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", r->name);
    *c->buffer = '\0';
    c->file = iso_text_open(ctx, r->path);
    if (!c->file) return ISO_FILE_TROUBLE;
    const iso_status status = iso_record_create(ctx, 0, NULL, &r->header);
    return status == ISO_OK ? read_header(c, columns) : status;
}

const iso_trajectory_reading iso_csv_reading = {csv_open, csv_next, csv_close};
