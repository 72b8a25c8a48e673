/* csv_writer.c - writes trajectories as text: into a temporary file, which is renamed when it is complete. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "io/output.h"
#include "io/trajectory_impl.h"
#include "orbit/scene.h"

static iso_status csv_open(iso_context *ctx, iso_trajectory_writer *w, const char *path)
{
    iso_output *out = NULL;
    const iso_status status = iso_output_open(ctx, path, &out);
    w->data = out;
    if (status == ISO_OK) w->name = iso_output_name(out);
    return status;
}

/* Whether reading the line back gives the same key and value. */
static bool is_line(const char *key, const char *value)
{
    const size_t k = strlen(key), v = strlen(value);
    if (k == 0 || strpbrk(key, ":\r\n") || strpbrk(value, "\r\n")) return false;
    if (strchr(" \t", key[0]) || strchr(" \t", key[k - 1])) return false;
    return v == 0 || (!strchr(" \t", value[0]) && !strchr(" \t", value[v - 1]));
}

static iso_status csv_line(iso_context *ctx, iso_trajectory_writer *w, const char *key, const char *value)
{
    if (!is_line(key, value))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "'%s' cannot be a line '# key: value': a key has no colon, and both are one line",
                                key);
    fprintf(iso_output_stream(w->data), *value ? "# %s: %s\n" : "# %s:\n", key, value);
    return iso_output_check(ctx, w->data);
}

static iso_status csv_header(iso_context *ctx, iso_trajectory_writer *w, const iso_record *header)
{
    const char *key, *value;
    FILE *file = iso_output_stream(w->data);
    iso_status status = ISO_OK;
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++)
        if (!is_line(key, value)) return csv_line(ctx, w, key, value);
    fprintf(file, "# isoroll %s " ISO_TRAJECTORY_VERSION "\n", w->kind);
    for (size_t i = 0; status == ISO_OK && iso_record_line(header, i, &key, &value); i++)
        status = csv_line(ctx, w, key, value);
    for (size_t i = 0; i < iso_record_columns(header); i++)
        fprintf(file, i ? ",%s" : "%s", iso_record_name(header, i));
    fputc('\n', file);
    return status == ISO_OK ? iso_output_check(ctx, w->data) : status;
}

static iso_status csv_row(iso_context *ctx, iso_trajectory_writer *w, const double row[])
{
    char text[ISO_TRAJECTORY_COLUMNS * ISO_NUMBER_SIZE];
    const size_t columns = iso_record_columns(w->header);
    size_t used = 0;
    for (size_t i = 0; i < columns; i++) {
        if (isnan(row[i]))
            memcpy(text + used, "nan", 3), used += 3;
        else
            used += (size_t)iso_number_print_as(text + used, row[i], w->digits);
        text[used++] = i + 1 < columns ? ',' : '\n';
    }
    fwrite(text, 1, used, iso_output_stream(w->data));
    return iso_output_check(ctx, w->data);
}

static iso_status csv_close(iso_context *ctx, iso_trajectory_writer *w, bool keep)
{
    return iso_output_close(ctx, w->data, keep);
}

const iso_trajectory_writing iso_csv_writing = {csv_open, csv_header, csv_row, csv_line, csv_close};
