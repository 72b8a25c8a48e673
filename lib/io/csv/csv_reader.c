/* csv_reader.c - reads tables from text: files of isoroll, and trajectories of other programs. This file knows the
 * header and the messages, csv_lines.c reads lines, csv_row.c what is in them. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/context_impl.h"
#include "base/names_impl.h"
#include "base/number_impl.h"
#include "io/csv/csv_impl.h"
#include "io/table_impl.h"
#include "io/text_impl.h"
#include "orbit/orbit_impl.h"

enum { MOST_KEYS = 4096 };

iso_status iso_csv_fail(const iso_csv *c, const char *at, const char *format, ...)
{
    char message[1024];
    size_t column = 1; /* in characters of UTF-8, as for scenes */
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    if (c->callers) return ISO_FAIL_ARGUMENT(c->ctx, "columns", "columns: %s", message);
    for (const char *x = c->line; at && x < at; x++) column += (*x & 0xC0) != 0x80;
    return iso_context_placed(
        c->ctx, ISO_FAIL_INPUT(c->ctx, "", "%s:%zu:%zu: %s", c->r->name, c->number ? c->number : 1, column, message));
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* The next line, without its end; *more false at the end of the file. */
static iso_status next_line(iso_csv *c, bool *more)
{
    *more = true;
    if (c->again) return c->again = false, ISO_OK;
    char *line;
    size_t length;
    const iso_status status = iso_csv_lines_next(c->ctx, &c->lines, c->longest, &line, &length, more);
    if (status != ISO_OK || !*more) return status;
    c->line = line;
    c->length = length;
    c->number++;
    if (length >= c->longest)
        return iso_csv_fail(c, c->line, "this line is longer than 64 KiB: is this a trajectory file?");
    if (c->number == 1 && strncmp(c->line, "\xEF\xBB\xBF", 3) == 0) c->line += 3, c->length -= 3; /* byte order */
    if (c->number == 1 && strncmp(c->line, "\x89HDF", 4) == 0)
        return iso_csv_fail(c, c->line, "this is an HDF5 file: give its name, it is not read from a pipe");
    if (c->number == 1 && strncmp(c->line, "\x1f\x8b", 2) == 0)
        return iso_csv_fail(c, c->line, "this file is compressed by gzip: gunzip it first");
    const char *nul = memchr(c->line, '\0', c->length);
    if (nul) return iso_csv_fail(c, nul, "a NUL byte: this is not a text file");
    while (c->length > 0 && c->line[c->length - 1] == '\r') c->line[--c->length] = '\0';
    return ISO_OK;
}

/* "# key: value"; without a colon it may be a line of names. Behind rows a key may be said again. */
static iso_status read_key_line(iso_csv *c)
{
    char *colon = strchr(c->line, ':'), quoted[ISO_QUOTE_SIZE];
    const char *last_key, *last_value;
    if (!colon) snprintf(c->comment, sizeof c->comment, "%s", c->line + 1);
    if (!colon) return ISO_OK;
    const iso_csv_field key = iso_csv_trim(c->line + 1, (size_t)(colon - c->line - 1)),
                        value = iso_csv_trim(colon + 1, strlen(colon + 1));
    if (key.length == 0 || (colon[1] && !iso_is_blank(colon[1]))) return ISO_OK;
    key.text[key.length] = value.text[value.length] = '\0';
    if (strcmp(key.text, ISO_WORDS_KEY) == 0 && c->r->trajectory) return ISO_OK; /* its columns are known */
    if (strcmp(key.text, ISO_WORDS_KEY) == 0 && c->fields > 0)
        return iso_csv_fail(c, key.text, "expected the line of words before the names of the columns");
    if (iso_record_get(c->r->header, key.text) && c->fields == 0)
        return iso_csv_fail(c, key.text, "duplicate key %s", iso_text_quote(quoted, key.text, key.length));
    if (iso_record_line(c->r->header, MOST_KEYS - 1, &last_key, &last_value))
        return iso_csv_fail(c, key.text, "more than 4096 lines '# key: value': is this a trajectory file?");
    return iso_record_set(c->ctx, c->r->header, key.text, value.text);
}

/* --- the lines of tables of isoroll ----------------------------------------------------------------------------- */

/* "# isoroll KIND 1" */
static iso_status read_kind(iso_csv *c)
{
    static const char begin[] = "# isoroll ";
    char quoted[ISO_QUOTE_SIZE], kind[32];
    char *const at = c->line + strlen(begin), *version = strrchr(c->line, ' ');
    if (strncmp(c->line, begin, strlen(begin)) != 0 || version < at || version - at >= (ptrdiff_t)sizeof kind)
        return iso_csv_fail(c, NULL, "expected '# isoroll KIND 1', the first line of a table of isoroll");
    *version++ = '\0';
    snprintf(kind, sizeof kind, "%s", at);
    if (strcmp(version, "1") != 0)
        return iso_csv_fail(c, version, "expected version 1 of the %sformat, not %s", c->ours ? "trajectory " : "",
                            iso_text_quote(quoted, version, strlen(version)));
    if (c->r->kind && strcmp(kind, c->r->kind) != 0)
        return iso_csv_fail(c, at, "expected a table of the kind '%.32s', not %s", c->r->kind,
                            iso_text_quote(quoted, at, strlen(at)));
    iso_record_set_kind(c->r->header, kind);
    if (!c->ours) c->longest = ISO_LONGEST_TEXT;
    return ISO_OK;
}

#define CERTIFIED "# isoroll certified "

/* A line of #. Files of other programs have lines of any text. */
static iso_status read_comment(iso_csv *c)
{
    if (c->r->trajectory) {
        const bool magic = strncmp(c->line, ISO_TRAJECTORY_MAGIC, strlen(ISO_TRAJECTORY_MAGIC)) == 0;
        if (c->number == 1 && strncmp(c->line, CERTIFIED, strlen(CERTIFIED)) == 0)
            return iso_csv_fail(
                c, NULL,
                "these rows are enclosures, of 'run --certify': convert takes them from a file, by its "
                "name; others do not take them");
        if (magic && c->fields > 0) return ISO_OK;
        c->ours = c->ours || (magic && c->number == 1);
        return magic && c->number == 1 ? read_kind(c) : read_key_line(c);
    }
    if (c->number == 1) return read_kind(c);
    /* "# KEY | TEXT" is a line of a text */
    char key[32];
    const char *begin = c->line + 1 + (c->line[1] == ' ');
    const size_t length = strcspn(begin, " \t:|");
    const char *bar = begin + length + (length > 0 && begin[length] == ' ');
    snprintf(key, sizeof key, "%.*s", length ? (int)length : (int)sizeof key, length ? begin : ISO_TABLE_TEXT);
    if (*bar == '|' && length < sizeof key && (!bar[1] || bar[1] == ' '))
        return iso_record_add_line(c->ctx, c->r->header, key, bar + 1 + (bar[1] == ' '));
    return strchr(c->line, ':') ? read_key_line(c) : iso_csv_fail(c, NULL, "expected '# key: value'");
}

/* The next line that is neither empty nor of #. */
static iso_status next_data(iso_csv *c, bool *more)
{
    iso_status status;
    while ((status = next_line(c, more)) == ISO_OK && *more) {
        if (*c->line != '#' && iso_csv_trim(c->line, c->length).length > 0) return ISO_OK;
        if (*c->line == '#' && (status = read_comment(c)) != ISO_OK) return status;
    }
    return status;
}

/* --- names ------------------------------------------------------------------------------------------------------ */

static const char *separators_of(const char *line)
{
    return strchr(line, ';') ? ";" : strchr(line, ',') ? "," : " \t";
}

/* A column with an unknown name. In a file of isoroll it is a mistake; in other files it is ignored. */
static iso_status skip_column(iso_csv *c, const iso_csv_field *f, bool named)
{
    char quoted[ISO_QUOTE_SIZE], suggested[ISO_SUGGEST_SIZE];
    iso_text_quote(quoted, f->text, f->length);
    const char *names[ISO_TRAJECTORY_COLUMNS];
    const int columns = iso_column_names(names);
    iso_suggest(suggested, quoted, (size_t)columns, names);
    if (c->ours || named) return iso_csv_fail(c, f->text, "unknown column '%s'; %s", quoted, suggested);
    char *to = c->r->ignored;
    const size_t used = strlen(to), room = sizeof c->r->ignored - used;
    const bool near = iso_nearest(quoted, (size_t)columns, names) != NULL;
    if (f->length > 0 && room > 2 * ISO_QUOTE_SIZE)
        snprintf(to + used, room, "%s'%s'%s%s%s", used ? ", " : "", quoted, near ? " (" : "", near ? suggested : "",
                 near ? ")" : "");
    return ISO_OK;
}

/* Columns from a line of names: the file's, or the caller's (`named`). */
static iso_status read_names(iso_csv *c, char *line, const char *separators, bool named)
{
    const char *names[ISO_TRAJECTORY_COLUMNS];
    size_t count = 0;
    double number;
    iso_status status = ISO_OK;
    for (char *rest = line; rest && status == ISO_OK; c->fields++) {
        const iso_csv_field f = iso_csv_next_field(separators, &rest);
        if (c->fields == ISO_MOST_CSV_FIELDS) return iso_csv_fail(c, f.text, "more than 1024 columns");
        f.text[f.length] = '\0';
        c->column[c->fields] = -1;
        const int known = iso_column_find(f.text);
        if (named && strcmp(f.text, "-") == 0) continue;
        if (c->again && iso_number_read(f.text, f.length, &number))
            return iso_csv_fail(
                c, f.text,
                "expected a line of column names such as t,omega1,omega2,... before the numbers; without "
                "one, --columns t,omega1,... names them");
        if (known < 0) {
            const bool orbit = c->orbit == 0 && strcmp(f.text, ISO_ORBIT_COLUMN) == 0;
            if (orbit) c->orbit = c->fields + 1, c->r->at.orbits = true;
            if (!orbit) status = skip_column(c, &f, named);
            continue;
        }
        for (size_t i = 0; i < count; i++)
            if (strcmp(names[i], f.text) == 0) return iso_csv_fail(c, f.text, "duplicate column %s", f.text);
        c->column[c->fields] = (short)count;
        names[count++] = iso_column_name(known);
    }
    char *first = line;
    const iso_csv_field f = iso_csv_next_field(separators, &first);
    if (status == ISO_OK && count == 0) status = skip_column(c, &f, true);
    return status == ISO_OK ? iso_table_name_columns(c->ctx, c->r, count, names) : status;
}

/* Names of columns: the caller's, else those of the first line of data, else those of the line of # before it. */
static iso_status read_header(iso_csv *c, const char *columns)
{
    bool more;
    ISO_TRY(next_data(c, &more));
    if (!more)
        return iso_csv_fail(c, NULL,
                            "expected a line of column names such as t,omega1,omega2,..., found the end of the file");
    char *const line = c->line, *rest = line, *names = columns ? strdup(columns) : NULL;
    c->separators = separators_of(line);
    const bool numbers = c->again = iso_csv_begins_as_number(iso_csv_next_field(c->separators, &rest));
    if (columns && !names) return iso_context_no_memory(c->ctx, "column names");
    const bool above = !columns && numbers && !c->ours && *c->comment;
    if (columns || above) c->line = columns ? names : c->comment;
    c->callers = columns != NULL;
    const iso_status status = read_names(c, c->line, columns ? "," : separators_of(c->line), columns != NULL);
    c->callers = false;
    free(names);
    c->line = line;
    return status;
}

/* Which columns have words: those that the line "# words: NAME NAME" names. Older tables lack the line, as tables
 * without words do: there a column that is none of a state has words until a cell is a number (guess_words). */
static iso_status set_words(iso_csv *c)
{
    iso_record *const r = c->r->header;
    const char *line = iso_record_get(r, ISO_WORDS_KEY);
    char name[128], quoted[ISO_QUOTE_SIZE];
    c->guesses = !line && !iso_table_is_finite(iso_record_kind(r));
    for (size_t i = 0; i < c->fields; i++) {
        c->typed[i] = !c->guesses || iso_column_find(iso_record_name(r, i)) >= 0;
        iso_record_set_words(r, i, !c->typed[i]);
    }
    for (const char *at = line ? line : ""; *at; at += strcspn(at, " "), at += strspn(at, " ")) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
        const int column = iso_record_find(r, name);
        if (column < 0)
            return iso_csv_fail(c, NULL,
                                "the line '# " ISO_WORDS_KEY ": ...' names the column '%s', which is not here",
                                iso_text_quote(quoted, name, strlen(name)));
        iso_record_set_words(r, (size_t)column, true);
    }
    return iso_record_set(c->ctx, r, ISO_WORDS_KEY, NULL);
}

/* Names of columns of a table of isoroll. */
static iso_status read_header_of_table(iso_csv *c)
{
    const char *names[ISO_MOST_COLUMNS];
    bool more;
    size_t count = 0;
    c->separators = ",";
    ISO_TRY(next_data(c, &more));
    if (!more || c->number == 1)
        return more ? read_kind(c) : iso_csv_fail(c, NULL, "expected a line of column names");
    for (char *rest = c->line, *name; rest; names[count++] = name) {
        if (count == ISO_MOST_COLUMNS) return iso_csv_fail(c, rest, "more than 5000 columns");
        char *const at = rest;
        name = iso_csv_next_cell(&rest);
        if (!name || !*name) return iso_csv_fail(c, at, "expected the name of a column");
    }
    const iso_status status = iso_table_name_columns(c->ctx, c->r, count, names);
    if (status == ISO_BAD_ARGUMENT) return iso_csv_fail(c, NULL, "expected names of columns, all different");
    c->fields = count;
    return status == ISO_OK ? set_words(c) : status;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* Whether every field of the line is nan. */
static bool is_nan_row(const iso_csv *c)
{
    char *rest = c->line;
    size_t fields = 0;
    for (; rest && *rest; fields++) {
        const iso_csv_field f = iso_csv_next_field(c->separators, &rest);
        if (f.length != 3 || strncasecmp(f.text, "nan", 3) != 0) return false;
    }
    return fields == c->fields;
}

static iso_status csv_next(iso_context *ctx, iso_table_reader *r, double row[], bool *more)
{
    iso_csv *c = r->data;
    double numbers[ISO_TRAJECTORY_COLUMNS + 1];
    c->ctx = ctx;
    iso_status status = next_data(c, more);
    for (; status == ISO_OK && *more && r->passes && is_nan_row(c); r->at.passed++) status = next_data(c, more);
    r->at.line = c->number;
    if (status == ISO_OK && !*more && c->guesses) iso_csv_settle_words(c);
    if (status != ISO_OK || !*more) return status;
    if (r->forgets) iso_record_forget_words(r->header);
    if (!r->trajectory) return iso_csv_read_cells(c, row);
    ISO_TRY(iso_csv_read_numbers(c, numbers));
    const size_t columns = iso_record_columns(r->header);
    memcpy(row, numbers, columns * sizeof *row);
    r->at.orbit = c->orbit > 0 ? numbers[columns] : 0;
    return ISO_OK;
}

/* --- opening and closing ---------------------------------------------------------------------------------------- */

static void csv_close(iso_table_reader *r)
{
    iso_csv *c = r->data;
    if (c) iso_csv_lines_close(&c->lines);
    free(c);
}

static iso_status csv_open(iso_context *ctx, iso_table_reader *r, const char *columns)
{
    iso_csv *c = r->data = calloc(1, sizeof *c);
    if (!c) return iso_text_no_memory(ctx, "read", r->name);
    c->ctx = ctx;
    c->r = r;
    c->line = c->comment; /* "" */
    c->longest = ISO_LONGEST_LINE;
    ISO_TRY(iso_csv_lines_open(ctx, r->path, r->name, &c->lines));
    ISO_TRY(iso_record_create(ctx, 0, NULL, &r->header));
    ISO_TRY(r->trajectory ? read_header(c, columns) : read_header_of_table(c));
    if (c->orbit > 0) c->column[c->orbit - 1] = (short)iso_record_columns(r->header);
    return ISO_OK;
}

const iso_table_reading iso_csv_reading = {csv_open, csv_next, csv_close};
