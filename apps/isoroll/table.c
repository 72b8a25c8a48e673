/* table.c - writes the beginning of a command's table (see table.h). */
#include "table.h"

#include <math.h>
#include <string.h>

#include "io/table.h"
#include "options.h"

enum { MOST_COLUMNS = 64 };

/* A header without lines, of columns whose names stand in a text with commas between. */
static iso_status create(iso_context *ctx, const char *columns, iso_record **header)
{
    char text[MOST_COLUMNS * ISO_NAME_SIZE], *rest = text;
    const char *names[MOST_COLUMNS];
    size_t count = 0;
    snprintf(text, sizeof text, "%s", columns);
    for (char *name; count < MOST_COLUMNS && (name = strsep(&rest, ","));) names[count++] = name;
    return iso_record_create(ctx, count, names, header);
}

iso_status table_begin(iso_context *ctx, iso_output *to, const char *kind, const iso_scene *scene,
                       const table_line *lines, const char *columns)
{
    iso_record *header = NULL;
    iso_status status = create(ctx, columns, &header);
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
