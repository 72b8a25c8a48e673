/* csv_reader.c - reads trajectories from text: files of isoroll and of other programs. csv_writer.c writes them.
 * This file knows the header and the messages, csv_lines.c reads lines, csv_row.c the numbers in them. */
#define _GNU_SOURCE /* strtod_l */
#include <ctype.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/nearest.h"
#include "base/number.h"
#include "base/place_impl.h"
#include "io/csv/csv_impl.h"
#include "io/text_impl.h"
#include "io/trajectory_impl.h"
#include "orbit/orbit_impl.h"

enum { MOST_KEYS = 4096 };

typedef struct csv {
    iso_context *ctx;
    iso_trajectory_reader *r;
    iso_csv_lines *lines;
    iso_csv_format format;
    bool ours, again;               /* the file has our first line; the line is to be read once more */
    size_t orbit;                   /* the field of that name, from 1; 0: there is none              */
    bool callers;                   /* `line` is the caller's names of columns, no line of the file  */
    char *line;                     /* without its end                                               */
    size_t length, number;          /* number: of the line, from 1                                   */
    const double *row;              /* the line's numbers, if it was read ahead                      */
    char comment[ISO_LONGEST_LINE]; /* the last line of # that is no key: perhaps names              */
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

/* The next line, without its end; false at the end of the file. */
static iso_status next_line(csv *c, bool *more)
{
    iso_csv_line line;
    *more = true;
    if (c->again) return c->again = false, ISO_OK;
    const iso_status status = iso_csv_lines_next(c->ctx, c->lines, &line, more);
    if (status != ISO_OK || !*more) return status;
    c->line = line.text;
    c->length = line.length;
    c->row = line.row;
    c->number++;
    if (c->row) return ISO_OK;
    if (line.too_long) return fail(c, c->line, "this line is longer than 64 KiB: is this a trajectory file?", "");
    if (c->number == 1 && strncmp(c->line, "\xEF\xBB\xBF", 3) == 0) c->line += 3, c->length -= 3; /* byte order */
    const char *nul = memchr(c->line, '\0', c->length);
    if (nul) return fail(c, nul, "a NUL byte: this is not a text file", "");
    while (c->length > 0 && c->line[c->length - 1] == '\r') c->line[--c->length] = '\0';
    return ISO_OK;
}

static field trim(char *text, size_t length)
{
    while (length > 0 && iso_is_blank(*text)) text++, length--;
    while (length > 0 && iso_is_blank(text[length - 1])) length--;
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
    if (key.length == 0 || (colon[1] && !iso_is_blank(colon[1]))) return ISO_OK;
    key.text[key.length] = value.text[value.length] = '\0';
    if (iso_record_get(c->r->header, key.text) && c->format.fields == 0)
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
        if (c->row) return ISO_OK;
        if (c->line[0] != '#') {
            if (trim(c->line, c->length).length > 0) return ISO_OK;
            continue;
        }
        const bool magic = strncmp(c->line, ISO_TRAJECTORY_MAGIC, strlen(ISO_TRAJECTORY_MAGIC)) == 0;
        if (magic && c->format.fields > 0) continue;
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
    iso_suggest(suggested, quoted, (size_t)columns, names);
    if (c->ours || named) {
        snprintf(detail, sizeof detail, "'%s'; %s", quoted, suggested);
        return fail(c, f->text, "unknown column ", detail);
    }
    char *to = c->r->ignored;
    const size_t used = strlen(to), room = sizeof c->r->ignored - used;
    const bool near = iso_nearest(quoted, (size_t)columns, names) != NULL;
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
    for (char *rest = line; rest && status == ISO_OK; c->format.fields++) {
        const field f = next_field(separator, &rest);
        if (c->format.fields == ISO_MOST_FIELDS) return fail(c, f.text, "more than 1024 columns", "");
        f.text[f.length] = '\0';
        c->format.column[c->format.fields] = -1;
        const int known = iso_column_find(f.text);
        if (named && strcmp(f.text, "-") == 0) continue;
        if (c->again && iso_number_read(f.text, f.length, &number))
            return fail(c, f.text, "expected a line of column names such as t,omega1,omega2,... before the numbers",
                        "; without one, --columns t,omega1,... names them");
        if (known < 0) {
            const bool orbit = !c->ours && c->orbit == 0 && strcmp(f.text, ISO_ORBIT_COLUMN) == 0;
            if (orbit) c->orbit = c->format.fields + 1;
            if (!orbit || !named) status = skip_column(c, &f, named);
            continue;
        }
        for (size_t i = 0; i < count; i++)
            if (strcmp(names[i], f.text) == 0) return fail(c, f.text, "duplicate column ", f.text);
        c->format.column[c->format.fields] = (short)count;
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
    strtod_l(copy, &end, c->format.plain);
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
    c->format.separator = separator_of(line);
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

static iso_status fail_count(const csv *c, const char *at, size_t found)
{
    char detail[64];
    snprintf(detail, sizeof detail, "%zu numbers, one for each column, found %s%zu", c->format.fields,
             at ? "more than " : "", found);
    return fail(c, at ? at : c->line + strlen(c->line), "expected ", detail);
}

static iso_status fail_number(const csv *c, char *start, size_t i)
{
    char quoted[ISO_QUOTE_SIZE], detail[2 * ISO_QUOTE_SIZE], *rest = start;
    const field f = next_field(c->format.separator, &rest);
    const bool comma = c->format.separator != ',' && memchr(f.text, ',', f.length);
    snprintf(detail, sizeof detail, comma ? "%s, with a decimal point, not '%s'" : "%s, not '%s'",
             i + 1 == c->orbit ? ISO_ORBIT_COLUMN : iso_record_name(c->r->header, (size_t)c->format.column[i]),
             iso_text_quote(quoted, f.text, f.length));
    return fail(c, f.text, "expected a finite number for ", detail);
}

static iso_status read_row(const csv *c, double row[])
{
    iso_csv_mistake m;
    switch (iso_csv_read_row(&c->format, c->line, row, &m)) {
    case ISO_CSV_GOOD: break;
    case ISO_CSV_FEW: return fail_count(c, NULL, m.found);
    case ISO_CSV_MANY: return fail_count(c, m.at, m.found);
    case ISO_CSV_NO_NUMBER: return fail_number(c, m.at, m.found);
    }
    return ISO_OK;
}

/* Whether every field of the line is nan. */
static bool is_nan_row(const csv *c)
{
    char *rest = c->line;
    size_t fields = 0;
    for (; rest && *rest; fields++) {
        const field f = next_field(c->format.separator, &rest);
        if (f.length != 3 || strncasecmp(f.text, "nan", 3) != 0) return false;
    }
    return fields == c->format.fields;
}

static iso_status csv_next(iso_context *ctx, iso_trajectory_reader *r, double row[], bool *more)
{
    csv *c = r->data;
    double own[ISO_TRAJECTORY_COLUMNS + 1];
    const double *numbers = own;
    c->ctx = ctx;
    iso_status status = next_data(c, more);
    for (; status == ISO_OK && *more && !c->row && r->passes && is_nan_row(c); r->passed++)
        status = next_data(c, more);
    r->line = c->number;
    if (status != ISO_OK || !*more) return status;
    if (c->row)
        numbers = c->row;
    else
        status = read_row(c, own);
    if (status != ISO_OK) return status;
    const size_t columns = iso_record_columns(r->header);
    memcpy(row, numbers, columns * sizeof *row);
    r->orbit = c->orbit > 0 ? numbers[columns] : 0;
    return ISO_OK;
}

/* --- opening and closing ---------------------------------------------------------------------------------------- */

static void csv_close(iso_trajectory_reader *r)
{
    csv *c = r->data;
    if (!c) return;
    iso_csv_lines_close(c->lines);
    if (c->format.plain) freelocale(c->format.plain);
    free(c);
}

static iso_status csv_open(iso_context *ctx, iso_trajectory_reader *r, const char *columns)
{
    csv *c = r->data = calloc(1, sizeof *c);
    if (c) {
        c->ctx = ctx;
        c->r = r;
        c->line = c->comment; /* "" */
        c->format.plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    }
    if (!c || !c->format.plain) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", r->name);
    iso_status status = iso_csv_lines_open(ctx, r->path, r->name, &c->lines);
    if (status == ISO_OK) status = iso_record_create(ctx, 0, NULL, &r->header);
    if (status == ISO_OK) status = read_header(c, columns);
    if (status != ISO_OK) return status;
    c->format.columns = iso_record_columns(r->header);
    if (c->orbit > 0) c->format.column[c->orbit - 1] = (short)c->format.columns++;
    iso_csv_lines_read_rows(c->lines, &c->format);
    return ISO_OK;
}

const iso_trajectory_reading iso_csv_reading = {csv_open, csv_next, csv_close};
