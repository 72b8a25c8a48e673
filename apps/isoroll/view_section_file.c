/* view_section_file.c - reads a section file that is CSV (lib/doc/formats.md, section 5) into a record. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "io/section_file.h"
#include "view_section.h"

enum { MOST_COLUMNS = 64 };

typedef struct reading {
    iso_context *ctx;
    const char *name;
    FILE *file;
    char *line;
    size_t room, number; /* number: of the line, from 1 */
    iso_record *record;  /* NULL until the line of names   */
    iso_record *lines;   /* the lines of # before it       */
} reading;

static iso_status fail(const reading *r, const char *at, const char *words)
{
    const size_t column = at ? (size_t)(at - r->line) + 1 : 1;
    return iso_context_fail(r->ctx, ISO_BAD_INPUT, "", "%s:%zu:%zu: %s", r->name, r->number ? r->number : 1, column,
                            words);
}

/* "# key: value" */
static iso_status read_key(reading *r)
{
    char *colon = strstr(r->line, ": ");
    if (!colon) return ISO_OK;
    *colon = '\0';
    const char *key = r->line + 1;
    return iso_record_set(r->ctx, r->record ? r->record : r->lines, key + strspn(key, " "), colon + 2);
}

static iso_status read_names(reading *r)
{
    const char *names[MOST_COLUMNS];
    size_t count = 0;
    for (char *rest = r->line, *name; (name = strsep(&rest, ",")); names[count++] = name)
        if (count == MOST_COLUMNS) return fail(r, name, "more than 64 columns");
    return iso_record_create_like(r->ctx, r->lines, count, names, &r->record);
}

static iso_status read_row(reading *r)
{
    const size_t columns = iso_record_columns(r->record);
    const char *at = r->line;
    double *row;
    const iso_status status = iso_record_append(r->ctx, r->record, &row);
    if (status != ISO_OK) return status;
    for (size_t i = 0; i < columns; i++) {
        const size_t length = strcspn(at, ",");
        if (!iso_number_read(at, length, &row[i])) return fail(r, at, "expected a finite number");
        if ((at[length] == ',') != (i + 1 < columns))
            return fail(r, at + length, "expected one number for each name of a column");
        at += length + 1;
    }
    return ISO_OK;
}

static iso_status read_line(reading *r)
{
    r->line[strcspn(r->line, "\r\n")] = '\0';
    if (r->line[0] == '#') return read_key(r);
    if (!r->line[0]) return ISO_OK;
    return r->record ? read_row(r) : read_names(r);
}

static iso_status read_lines(reading *r)
{
    iso_status status = iso_record_create(r->ctx, 0, NULL, &r->lines);
    while (status == ISO_OK && getline(&r->line, &r->room, r->file) >= 0) {
        r->number++;
        status = read_line(r);
    }
    if (status == ISO_OK && !feof(r->file))
        status = iso_context_fail(r->ctx, ISO_FILE_TROUBLE, "", "cannot read '%s': %s", r->name, strerror(errno));
    if (status == ISO_OK && (!r->record || iso_record_rows(r->record) == 0))
        status = fail(r, NULL, "expected rows of crossings, found the end of the file");
    return status;
}

iso_status view_section_read(iso_context *ctx, const char *path, iso_record **record)
{
    const bool standard = strcmp(path, "-") == 0;
    if (ends_with(path, ".h5")) {
        const iso_status status = iso_section_file_read_hdf5(ctx, path, record);
        const bool named = status == ISO_OK || status == ISO_BAD_ARGUMENT;
        return named ? status : name_the_file(ctx, path, status);
    }
    reading r = {.ctx = ctx, .name = standard ? "<stdin>" : path, .file = standard ? stdin : fopen(path, "r")};
    *record = NULL;
    if (!r.file) return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot open '%s': %s", path, strerror(errno));
    const iso_status status = read_lines(&r);
    if (!standard) fclose(r.file);
    free(r.line);
    iso_record_free(r.lines);
    if (status == ISO_OK)
        *record = r.record;
    else
        iso_record_free(r.record);
    return status;
}
