/* table.c - writes the beginning of a command's table (see table.h). */
#include "table.h"

#include <math.h>
#include <string.h>

#include "io/table.h"
#include "options.h"

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
    iso_status status = iso_columns_create(ctx, fields, &header);
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
