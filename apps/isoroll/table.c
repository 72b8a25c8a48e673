/* table.c - writes the beginning of a command's table (see table.h). */
#include "table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/table.h"
#include "options.h"

typedef struct columns {
    char name[ISO_MOST_FIELDS][ISO_COLUMN_SIZE];
    size_t count;
} columns;

static void keep_name(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    columns *c = data;
    (void)field;
    (void)value;
    if (c->count < ISO_MOST_FIELDS) snprintf(c->name[c->count++], ISO_COLUMN_SIZE, "%s", name);
}

/* A header without lines. */
static iso_status create(iso_context *ctx, const iso_field *fields, iso_record **header)
{
    columns c = {.count = 0};
    const char *names[ISO_MOST_FIELDS];
    iso_columns_visit(fields, NULL, keep_name, &c);
    for (size_t i = 0; i < c.count; i++) names[i] = c.name[i];
    return iso_record_create(ctx, c.count, names, header);
}

void table_rename(const iso_field *fields, const char *old, const char *name, iso_field copy[ISO_MOST_FIELDS])
{
    iso_fields_copy(fields, NULL, copy);
    for (iso_field *f = copy; f->name; f++)
        if (strcmp(f->name, old) == 0) f->name = name;
}

iso_status table_begin(iso_context *ctx, iso_output *to, const char *kind, const iso_scene *scene,
                       const table_line *lines, const iso_field *fields)
{
    iso_record *header = NULL;
    iso_status status = create(ctx, fields, &header);
    if (status == ISO_OK) status = iso_record_describe_scene(ctx, header, scene);
    if (status == ISO_OK) status = iso_record_set(ctx, header, "command", options_command());
    for (const table_line *l = lines; status == ISO_OK && l && l->key; l++)
        if (l->text)
            status = iso_record_set(ctx, header, l->key, l->text);
        else if (!isnan(l->number))
            status = iso_record_set_numbers(ctx, header, l->key, 1, &l->number);
    if (status == ISO_OK) status = iso_table_begin(ctx, iso_output_stream(to), kind, header);
    iso_record_free(header);
    return status;
}

iso_status table_end(iso_context *ctx, iso_output *to, iso_status status)
{
    const iso_status closed = iso_output_close(ctx, to, status == ISO_OK);
    return status == ISO_OK ? closed : status;
}
