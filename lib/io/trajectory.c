/* trajectory.c - trajectory files: tables of isoroll or of other programs, of which the known columns are read. */
#include "io/trajectory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/table_impl.h"
#include "orbit/scene.h"

/* --- reading ---------------------------------------------------------------------------------------------------- */

iso_status iso_trajectory_reader_open(iso_context *ctx, const char *path, const char *columns,
                                      iso_trajectory_reader **reader)
{
    return iso_table_reader_make(ctx, path, columns, &(iso_table_reader){.trajectory = true}, reader);
}

void iso_trajectory_reader_close(iso_trajectory_reader *r)
{
    iso_table_reader_close(r);
}

iso_record *iso_trajectory_header(iso_trajectory_reader *r)
{
    return r->header;
}

iso_status iso_trajectory_next(iso_context *ctx, iso_trajectory_reader *r, double row[], bool *more)
{
    const double before = r->orbit;
    const iso_status status = iso_table_next(ctx, r, row, more);
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
    iso_trajectory_reader *r;
    *record = NULL;
    iso_status status = iso_trajectory_reader_open(ctx, path, columns, &r);
    if (status != ISO_OK) return status;
    r->passes = passed != NULL;
    status = iso_table_read_all(ctx, r, record);
    if (passed) *passed = r->passed;
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

iso_status iso_trajectory_open(iso_context *ctx, const char *path, iso_trajectory_writer **writer)
{
    return iso_table_writer_open(ctx, path, ISO_TRAJECTORY_KIND, writer);
}

void iso_trajectory_set_digits(iso_trajectory_writer *w, int digits)
{
    w->digits = digits;
}

void iso_trajectory_set_kind(iso_trajectory_writer *w, const char *kind)
{
    w->kind = kind;
}

iso_status iso_trajectory_write_header(iso_context *ctx, iso_trajectory_writer *w, const iso_record *header)
{
    if (iso_record_columns(header) > (size_t)iso_columns_count())
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a trajectory has at most %d columns",
                                iso_columns_count());
    return iso_table_write_header(ctx, w, header);
}

iso_status iso_trajectory_write_row(iso_context *ctx, iso_trajectory_writer *w, const double *row, size_t count)
{
    if (!w->header || count != iso_record_columns(w->header))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a row of %zu numbers under %zu columns", count,
                                w->header ? iso_record_columns(w->header) : 0);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(row[i]))
            return iso_context_fail(ctx, ISO_NUMERICAL, iso_record_name(w->header, i),
                                    "row %zu of '%s': %s is not finite", w->rows + 1, w->name,
                                    iso_record_name(w->header, i));
    return iso_table_write_row(ctx, w, row);
}

iso_status iso_trajectory_write_mark(iso_context *ctx, iso_trajectory_writer *w)
{
    double row[ISO_TRAJECTORY_COLUMNS];
    if (!w->header) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "write the header before the rows");
    for (size_t i = 0; i < iso_record_columns(w->header); i++) row[i] = NAN;
    return iso_table_write_row(ctx, w, row);
}

iso_status iso_trajectory_write_line(iso_context *ctx, iso_trajectory_writer *w, const char *key, const char *value)
{
    return iso_table_write_line(ctx, w, key, value);
}

iso_status iso_trajectory_close(iso_context *ctx, iso_trajectory_writer *w, bool keep)
{
    return iso_table_writer_close(ctx, w, keep);
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
