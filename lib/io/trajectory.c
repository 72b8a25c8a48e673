/* Reading trajectory files; writing is in trajectory_writer.c. */
#include "io/trajectory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "io/text_impl.h"
#include "io/trajectory_impl.h"
#include "orbit/scene.h"

enum { LONGEST_LINE = 1 << 16 };

typedef struct reader {
    iso_context *ctx;
    const char *name;
    char *line;         /* LONGEST_LINE + 1 characters              */
    size_t number;      /* of the line, from 1                      */
    iso_record *keys;   /* lines read before the columns are known */
    iso_record *record; /* NULL before the header                  */
} reader;

/* A part of a line without the blanks around it. */
typedef struct field {
    char *text;
    size_t length;
} field;

static iso_status fail(const reader *r, const char *at, const char *message, const char *detail)
{
    size_t column = 1; /* in characters of UTF-8, as for scenes */
    for (const char *c = r->line; at && c < at; c++) column += (*c & 0xC0) != 0x80;
    return iso_context_fail(r->ctx, ISO_BAD_INPUT, "", "%s:%zu:%zu: %s%s", r->name, r->number ? r->number : 1, column,
                            message, detail);
}

static field trim(char *text, size_t length)
{
    while (length > 0 && strchr(" \t", *text)) text++, length--;
    while (length > 0 && strchr(" \t", text[length - 1])) length--;
    return (field){text, length};
}

/* Takes the next field of a line of CSV off *rest (NULL after the last). */
static field next_field(char **rest)
{
    char *start = *rest;
    const size_t length = strcspn(start, ",");
    *rest = start[length] ? start + length + 1 : NULL;
    return trim(start, length);
}

/* "# key: value", or a comment without a colon, which is nobody's. */
static iso_status read_key_line(reader *r)
{
    char *colon = strchr(r->line, ':'), quoted[ISO_QUOTE_SIZE];
    iso_record *record = r->record ? r->record : r->keys;
    if (!colon) return ISO_OK;
    const field key = trim(r->line + 1, (size_t)(colon - r->line - 1)), value = trim(colon + 1, strlen(colon + 1));
    if (key.length == 0 || (colon[1] && !strchr(" \t", colon[1]))) return ISO_OK;
    key.text[key.length] = value.text[value.length] = '\0';
    if (iso_record_get(record, key.text))
        return fail(r, key.text, "duplicate key ", iso_text_quote(quoted, key.text, key.length));
    return iso_record_set(r->ctx, record, key.text, value.text);
}

static iso_status read_magic(reader *r)
{
    const char *version = r->line + strlen(ISO_TRAJECTORY_MAGIC);
    char quoted[ISO_QUOTE_SIZE];
    if (strcmp(version, ISO_TRAJECTORY_VERSION) == 0) return ISO_OK;
    return fail(r, version, "expected version " ISO_TRAJECTORY_VERSION " of the trajectory format, not ",
                iso_text_quote(quoted, version, strlen(version)));
}

static iso_status check_column(const reader *r, const field *f, size_t count, const char *const names[])
{
    char quoted[ISO_QUOTE_SIZE], suggested[ISO_SUGGEST_SIZE], detail[ISO_QUOTE_SIZE + ISO_SUGGEST_SIZE + 8];
    double value;
    bool known = false;
    if (iso_number_read(f->text, f->length, &value))
        return fail(r, f->text, "expected a line of column names such as t,omega1,omega2,... before the numbers", "");
    for (size_t i = 0; i < ISO_TRAJECTORY_COLUMNS; i++) known = known || !strcmp(f->text, iso_trajectory_columns[i]);
    for (size_t i = 0; i < count; i++)
        if (strcmp(names[i], f->text) == 0) return fail(r, f->text, "duplicate column ", f->text);
    if (known) return ISO_OK;
    iso_text_quote(quoted, f->text, f->length);
    iso_text_suggest(suggested, quoted, ISO_TRAJECTORY_COLUMNS, iso_trajectory_columns);
    snprintf(detail, sizeof detail, "'%s'; %s", quoted, suggested);
    return fail(r, f->text, "unknown column ", detail);
}

/* Carries the keys over to the record that has columns. */
static iso_status create_record(reader *r, size_t count, const char *const names[])
{
    const char *key, *value;
    iso_status status = iso_record_create(r->ctx, count, names, &r->record);
    for (size_t i = 0; status == ISO_OK && iso_record_line(r->keys, i, &key, &value); i++)
        status = iso_record_set(r->ctx, r->record, key, value);
    return status;
}

static iso_status read_columns(reader *r)
{
    const char *names[ISO_TRAJECTORY_COLUMNS]; /* all different and known: no more than there are */
    size_t count = 0;
    for (char *rest = r->line; rest;) {
        const field f = next_field(&rest);
        f.text[f.length] = '\0';
        const iso_status status = check_column(r, &f, count, names);
        if (status != ISO_OK) return status;
        names[count++] = f.text;
    }
    return create_record(r, count, names);
}

static iso_status fail_count(const reader *r, const char *at, size_t found)
{
    char detail[64];
    snprintf(detail, sizeof detail, "%zu numbers, one for each column, found %s%zu", iso_record_columns(r->record),
             at ? "more than " : "", found);
    return fail(r, at ? at : r->line + strlen(r->line), "expected ", detail);
}

static iso_status read_row(reader *r)
{
    const size_t columns = iso_record_columns(r->record);
    char quoted[ISO_QUOTE_SIZE], detail[2 * ISO_QUOTE_SIZE];
    double *row;
    size_t i = 0;
    iso_status status = iso_record_append(r->ctx, r->record, &row);
    for (char *rest = r->line; rest && status == ISO_OK; i++) {
        const field f = next_field(&rest);
        if (i == columns) return fail_count(r, f.text, columns);
        if (iso_number_read(f.text, f.length, &row[i])) continue;
        snprintf(detail, sizeof detail, "%s, not '%s'", iso_record_name(r->record, i),
                 iso_text_quote(quoted, f.text, f.length));
        status = fail(r, f.text, "expected a finite number for ", detail);
    }
    return status == ISO_OK && i < columns ? fail_count(r, NULL, i) : status;
}

static iso_status read_line(reader *r, size_t length)
{
    if (r->number == 1 && strncmp(r->line, "\xEF\xBB\xBF", 3) == 0) /* a byte order mark */
        memmove(r->line, r->line + 3, (length -= 3) + 1);
    if (strlen(r->line) < length) return fail(r, r->line + strlen(r->line), "a NUL byte: this is no text file", "");
    while (length > 0 && strchr("\r\n", r->line[length - 1])) r->line[--length] = '\0';
    if (strncmp(r->line, ISO_TRAJECTORY_MAGIC, strlen(ISO_TRAJECTORY_MAGIC)) == 0 && r->number == 1)
        return read_magic(r);
    if (r->line[0] == '#') return read_key_line(r);
    if (trim(r->line, length).length == 0) return ISO_OK;
    return r->record ? read_row(r) : read_columns(r);
}

/* The next line with its end, which may hold NUL bytes; 0 at the end of the file, LONGEST_LINE if it is too long. */
static size_t next_line(reader *r, FILE *file)
{
    size_t length = 0;
    int c = 0;
    while (length < LONGEST_LINE && c != '\n' && (c = getc(file)) != EOF) r->line[length++] = (char)c;
    r->line[length] = '\0';
    return length;
}

static iso_status read_lines(reader *r, FILE *file)
{
    iso_status status = ISO_OK;
    size_t length;
    while (status == ISO_OK && (length = next_line(r, file)) > 0) {
        r->number++;
        status = length < LONGEST_LINE ? read_line(r, length)
                                       : fail(r, r->line, "this line is too long: is it a trajectory file?", "");
    }
    if (status != ISO_OK) return status;
    if (ferror(file))
        return iso_context_fail(r->ctx, ISO_FILE_TROUBLE, "", "cannot read '%s': %s", r->name, strerror(errno));
    if (r->record) return ISO_OK;
    return fail(r, NULL, "expected a line of column names such as t,omega1,omega2,..., found the end of the file",
                "");
}

iso_status iso_trajectory_read(iso_context *ctx, const char *path, iso_record **record)
{
    reader r = {.ctx = ctx, .name = iso_text_name(path), .line = malloc(LONGEST_LINE + 1)};
    *record = NULL;
    FILE *file = NULL;
    iso_status status = iso_trajectory_check_format(ctx, path);
    if (status == ISO_OK && !(file = iso_text_open(ctx, path))) status = ISO_FILE_TROUBLE;
    if (status == ISO_OK && !r.line)
        status = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", r.name);
    if (status == ISO_OK) status = iso_record_create(ctx, 0, NULL, &r.keys);
    if (status == ISO_OK) status = read_lines(&r, file);
    if (file) iso_text_close(file);
    free(r.line);
    iso_record_free(r.keys);
    if (status != ISO_OK) iso_record_free(r.record);
    if (status == ISO_OK) *record = r.record;
    return status;
}
