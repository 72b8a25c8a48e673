/* trajectory.c - trajectory files: takes the format from the name of the file, and calls its reader or writer. */
#include "io/trajectory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "io/text_impl.h"
#include "io/trajectory_impl.h"
#include "orbit/scene.h"

static bool is_hdf5(const char *path)
{
    const size_t length = strlen(path);
    return length > 3 && strcmp(path + length - 3, ".h5") == 0;
}

#ifdef ISO_HDF5
static const bool has_hdf5 = true;
#define HDF5(format) &(format)
#else
static const bool has_hdf5 = false;
#define HDF5(format) NULL
#endif

static iso_status check_format(iso_context *ctx, const char *path)
{
    if (has_hdf5 || !is_hdf5(path)) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "'%s': this build has no HDF5 (.h5), use CSV, a name in .csv",
                            path);
}

/* --- reading ---------------------------------------------------------------------------------------------------- */

iso_status iso_trajectory_reader_open(iso_context *ctx, const char *path, const char *columns,
                                      iso_trajectory_reader **reader)
{
    *reader = NULL;
    iso_status status = check_format(ctx, path);
    if (status != ISO_OK) return status;
    iso_trajectory_reader *r = calloc(1, sizeof *r);
    if (!r) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", path);
    r->format = is_hdf5(path) ? HDF5(iso_hdf5_reading) : &iso_csv_reading;
    r->path = path;
    r->name = iso_text_name(path);
    status = r->format->open(ctx, r, columns);
    if (status == ISO_OK)
        *reader = r;
    else
        iso_trajectory_reader_close(r);
    return status;
}

void iso_trajectory_reader_close(iso_trajectory_reader *r)
{
    if (!r) return;
    r->format->close(r);
    iso_record_free(r->header);
    free(r);
}

iso_record *iso_trajectory_header(iso_trajectory_reader *r)
{
    return r->header;
}

iso_status iso_trajectory_next(iso_context *ctx, iso_trajectory_reader *r, double row[], bool *more)
{
    ISO_DEFAULT_ARITHMETIC;
    const double before = r->orbit;
    const iso_status status = r->format->next(ctx, r, row, more);
    if (status != ISO_OK || !*more) return status;
    r->begins = r->any && r->orbit != before;
    r->any = true;
    return ISO_OK;
}

bool iso_trajectory_begins_orbit(const iso_trajectory_reader *r)
{
    return r->begins;
}

size_t iso_trajectory_line(const iso_trajectory_reader *r)
{
    return r->line;
}

void iso_trajectory_pass_nan(iso_trajectory_reader *r)
{
    r->passes = true;
}

size_t iso_trajectory_passed(const iso_trajectory_reader *r)
{
    return r->passed;
}

const char *iso_trajectory_ignored(const iso_trajectory_reader *r)
{
    return *r->ignored ? r->ignored : NULL;
}

/* passed NULL: rows of nan are refused. */
static iso_status read_whole(iso_context *ctx, const char *path, const char *columns, iso_record **record,
                             size_t *passed)
{
    double row[ISO_TRAJECTORY_COLUMNS], *to;
    iso_trajectory_reader *r;
    bool more = true;
    *record = NULL;
    iso_status status = iso_trajectory_reader_open(ctx, path, columns, &r);
    if (status != ISO_OK) return status;
    r->passes = passed != NULL;
    while ((status = iso_trajectory_next(ctx, r, row, &more)) == ISO_OK && more) {
        status = iso_record_append(ctx, r->header, &to);
        if (status != ISO_OK) break;
        memcpy(to, row, iso_record_columns(r->header) * sizeof *to);
    }
    if (passed) *passed = r->passed;
    if (status == ISO_OK) *record = r->header, r->header = NULL;
    iso_trajectory_reader_close(r);
    return status;
}

iso_status iso_trajectory_read(iso_context *ctx, const char *path, const char *columns, iso_record **record)
{
    return read_whole(ctx, path, columns, record, NULL);
}

iso_status iso_trajectory_read_good(iso_context *ctx, const char *path, const char *columns, iso_record **record,
                                    size_t *passed)
{
    return read_whole(ctx, path, columns, record, passed);
}

/* --- writing ---------------------------------------------------------------------------------------------------- */

static void release(iso_trajectory_writer *w)
{
    iso_record_free(w->header);
    free(w);
}

iso_status iso_trajectory_open(iso_context *ctx, const char *path, iso_trajectory_writer **writer)
{
    *writer = NULL;
    iso_status status = check_format(ctx, path);
    if (status != ISO_OK) return status;
    iso_trajectory_writer *w = calloc(1, sizeof *w);
    if (!w) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write a trajectory");
    w->format = is_hdf5(path) ? HDF5(iso_hdf5_writing) : &iso_csv_writing;
    w->digits = 17;
    w->kind = ISO_TRAJECTORY_KIND;
    status = w->format->open(ctx, w, path);
    if (status == ISO_OK)
        *writer = w;
    else
        release(w);
    return status;
}

void iso_trajectory_set_digits(iso_trajectory_writer *w, int digits)
{
    w->digits = digits;
}

void iso_trajectory_set_kind(iso_trajectory_writer *w, const char *kind)
{
    w->kind = kind;
}

/* The header's columns, without rows. */
static iso_status keep_columns(iso_context *ctx, iso_trajectory_writer *w, const iso_record *header)
{
    const char *names[ISO_TRAJECTORY_COLUMNS];
    const size_t columns = iso_record_columns(header);
    if (columns > (size_t)iso_columns_count())
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a trajectory has at most %d columns",
                                iso_columns_count());
    for (size_t i = 0; i < columns; i++) names[i] = iso_record_name(header, i);
    return iso_record_create(ctx, columns, names, &w->header);
}

iso_status iso_trajectory_write_header(iso_context *ctx, iso_trajectory_writer *w, const iso_record *header)
{
    if (w->header) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "the header is already written");
    const iso_status status = keep_columns(ctx, w, header);
    return status == ISO_OK ? w->format->header(ctx, w, header) : status;
}

iso_status iso_trajectory_write_row(iso_context *ctx, iso_trajectory_writer *w, const double *row, size_t count)
{
    ISO_DEFAULT_ARITHMETIC;
    if (!w->header || count != iso_record_columns(w->header))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a row of %zu numbers under %zu columns", count,
                                w->header ? iso_record_columns(w->header) : 0);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(row[i]))
            return iso_context_fail(ctx, ISO_NUMERICAL, iso_record_name(w->header, i),
                                    "row %zu of '%s': %s is not finite", w->rows + 1, w->name,
                                    iso_record_name(w->header, i));
    w->rows++;
    return w->format->row(ctx, w, row);
}

iso_status iso_trajectory_write_mark(iso_context *ctx, iso_trajectory_writer *w)
{
    double row[ISO_TRAJECTORY_COLUMNS];
    if (!w->header) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "write the header before the rows");
    for (size_t i = 0; i < iso_record_columns(w->header); i++) row[i] = NAN;
    w->rows++;
    return w->format->row(ctx, w, row);
}

iso_status iso_trajectory_write_line(iso_context *ctx, iso_trajectory_writer *w, const char *key, const char *value)
{
    return w->format->line(ctx, w, key, value);
}

iso_status iso_trajectory_close(iso_context *ctx, iso_trajectory_writer *w, bool keep)
{
    if (!w) return ISO_OK;
    const iso_status status = w->format->close(ctx, w, keep);
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
