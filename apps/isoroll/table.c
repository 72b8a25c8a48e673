/* table.c - makes the table of a command, writes it and draws it (see table.h). */
#include "table.h"

#include <math.h>
#include <string.h>

#include "options.h"
#include "plot/plot.h"
#include "report.h"

void table_rename(const iso_field *fields, const char *old, const char *name, iso_field copy[ISO_MOST_FIELDS])
{
    iso_fields_copy(fields, NULL, copy);
    for (iso_field *f = copy; f->name; f++)
        if (strcmp(f->name, old) == 0) f->name = name;
}

iso_status table_create(iso_context *ctx, const char *kind, const iso_scene *scene, const table_line *lines,
                        const iso_field *fields, iso_record **table)
{
    ISO_TRY(iso_columns_create(ctx, fields, table));
    iso_record_set_kind(*table, kind);
    iso_status status = iso_record_describe_scene(ctx, *table, scene);
    if (status == ISO_OK) status = iso_record_set(ctx, *table, "command", options_command());
    for (const table_line *l = lines; status == ISO_OK && l && l->key; l++)
        if (l->text)
            status = iso_record_set(ctx, *table, l->key, l->text);
        else if (!isnan(l->number))
            status = iso_record_set_numbers(ctx, *table, l->key, 1, &l->number);
    return status;
}

iso_status table_write(iso_context *ctx, iso_table_writer *to, iso_status status, const iso_record *table)
{
    if (!to) return status;
    if (status == ISO_OK) return iso_table_write_all(ctx, to, table);
    iso_table_writer_close(ctx, to, false);
    return status;
}

int table_finish(iso_context *ctx, iso_table_writer *to, const char *plot, iso_status status, iso_record *table)
{
    int result = finish(ctx, table_write(ctx, to, status, table));
    if (status == ISO_OK && plot) result = worse(result, finish(ctx, iso_plot_table(ctx, plot, "", table)));
    iso_record_free(table);
    return result;
}
