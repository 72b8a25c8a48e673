/* Writing trajectory files, whole and then renamed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "io/output.h"
#include "io/trajectory_impl.h"

struct iso_trajectory_writer {
    iso_output *out;
    char **names; /* of the columns, after the header */
    size_t columns, rows;
};

iso_status iso_trajectory_check_format(iso_context *ctx, const char *path)
{
    const size_t length = strlen(path);
    if (length < 3 || strcmp(path + length - 3, ".h5") != 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "'%s': this build has no HDF5 (.h5), use CSV, a name in .csv",
                            path);
}

static iso_status no_memory(iso_context *ctx)
{
    return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write a trajectory");
}

static void release(iso_trajectory_writer *w)
{
    for (size_t i = 0; w->names && i < w->columns; i++) free(w->names[i]);
    free(w->names);
    free(w);
}

iso_status iso_trajectory_open(iso_context *ctx, const char *path, iso_trajectory_writer **writer)
{
    *writer = NULL;
    iso_status status = iso_trajectory_check_format(ctx, path);
    if (status != ISO_OK) return status;
    iso_trajectory_writer *w = calloc(1, sizeof *w);
    if (!w) return no_memory(ctx);
    status = iso_output_open(ctx, path, &w->out);
    if (status == ISO_OK)
        *writer = w;
    else
        release(w);
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

static bool copy_names(iso_trajectory_writer *w, const iso_record *header)
{
    const size_t columns = iso_record_columns(header);
    w->names = calloc(columns + 1, sizeof *w->names);
    if (!w->names) return false;
    for (w->columns = 0; w->columns < columns; w->columns++)
        if (!(w->names[w->columns] = strdup(iso_record_name(header, w->columns)))) return false;
    return true;
}

iso_status iso_trajectory_write_header(iso_context *ctx, iso_trajectory_writer *w, const iso_record *header)
{
    const char *key, *value;
    FILE *file = iso_output_stream(w->out);
    if (w->names) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a trajectory has one header");
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++)
        if (!is_line(key, value))
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "key '%s' is not one line of text 'key: value'", key);
    if (!copy_names(w, header)) return no_memory(ctx);
    fputs(ISO_TRAJECTORY_MAGIC ISO_TRAJECTORY_VERSION "\n", file);
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++)
        fprintf(file, *value ? "# %s: %s\n" : "# %s:\n", key, value);
    for (size_t i = 0; i < w->columns; i++) fprintf(file, i ? ",%s" : "%s", w->names[i]);
    fputc('\n', file);
    return iso_output_check(ctx, w->out);
}

iso_status iso_trajectory_write_row(iso_context *ctx, iso_trajectory_writer *w, const double *row, size_t count)
{
    char text[ISO_NUMBER_SIZE];
    FILE *file = iso_output_stream(w->out);
    if (!w->names || count != w->columns)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a row of %zu numbers under %zu columns", count,
                                w->columns);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(row[i]))
            return iso_context_fail(ctx, ISO_NUMERICAL, w->names[i], "row %zu of '%s': %s is not finite", w->rows + 1,
                                    iso_output_name(w->out), w->names[i]);
    for (size_t i = 0; i < count; i++) {
        const int length = iso_number_print(text, row[i]);
        fwrite(text, 1, (size_t)length, file);
        fputc(i + 1 < count ? ',' : '\n', file);
    }
    w->rows++;
    return iso_output_check(ctx, w->out);
}

iso_status iso_trajectory_close(iso_context *ctx, iso_trajectory_writer *w, bool keep)
{
    if (!w) return ISO_OK;
    const iso_status status = iso_output_close(ctx, w->out, keep);
    release(w);
    return status;
}

iso_status iso_trajectory_write(iso_context *ctx, const char *path, const iso_record *record)
{
    iso_trajectory_writer *w;
    iso_status status = iso_trajectory_open(ctx, path, &w);
    if (status != ISO_OK) return status;
    status = iso_trajectory_write_header(ctx, w, record);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(record); i++)
        status = iso_trajectory_write_row(ctx, w, iso_record_const_row(record, i), iso_record_columns(record));
    const iso_status closed = iso_trajectory_close(ctx, w, status == ISO_OK);
    return status != ISO_OK ? status : closed;
}
