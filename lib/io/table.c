/* table.c - files of tables: takes the format from the name of the file, and calls its reader or writer. */
#include "io/table.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/arithmetic_impl.h"
#include "io/table_impl.h"
#include "io/text_impl.h"

/* Of a record. Unwritten rows take no room in a file: a small file can promise more than memory holds. */
#define MOST_NUMBERS 1e8

/* --- formats ---------------------------------------------------------------------------------------------------- */

static bool ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), end = strlen(ending);
    return length > end && strcasecmp(path + length - end, ending) == 0;
}

bool iso_table_is_hdf5(const char *path)
{
    return ends_in(path, ".h5") || ends_in(path, ".hdf5");
}

/* Whether a file that is to be read is HDF5. */
static bool begins_as_hdf5(const char *path)
{
    char begin[8] = "";
    struct stat s;
    if (iso_table_is_hdf5(path)) return true;
    FILE *file = stat(path, &s) == 0 && S_ISREG(s.st_mode) ? fopen(path, "re") : NULL;
    const bool read = file && fread(begin, 1, sizeof begin, file) == sizeof begin;
    if (file) fclose(file);
    return read && memcmp(begin, "\x89HDF\r\n\x1a\n", 8) == 0;
}

#ifdef ISO_HDF5
static const bool has_hdf5 = true;
#define HDF5(format) &(format)
#else
static const bool has_hdf5 = false;
#define HDF5(format) NULL
#endif

static iso_status check(iso_context *ctx, const char *path, bool hdf5)
{
    if (has_hdf5 || !hdf5) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "'%s': this build has no HDF5 (.h5), use CSV, a name in .csv",
                            path);
}

iso_status iso_table_check_format(iso_context *ctx, const char *path)
{
    return check(ctx, path, iso_table_is_hdf5(path));
}

bool iso_table_has_words(const char *name)
{
    static const char *const names[] = {"verdict",  "ball_verdict", "point_verdict", "stability",
                                        "symmetry", "line",         "event",         "kind",
                                        "backend",  "method",       "failure",       "reason"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) return true;
    return false;
}

/* --- reading ---------------------------------------------------------------------------------------------------- */

iso_status iso_table_reader_make(iso_context *ctx, const char *path, const char *columns, const iso_table_reader *how,
                                 iso_table_reader **reader)
{
    *reader = NULL;
    const bool hdf5 = how->trajectory ? iso_table_is_hdf5(path) : begins_as_hdf5(path);
    iso_status status = check(ctx, path, hdf5);
    if (status != ISO_OK) return status;
    iso_table_reader *r = malloc(sizeof *r);
    if (!r) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", path);
    *r = *how;
    r->format = hdf5 ? HDF5(iso_hdf5_reading) : &iso_csv_reading;
    r->path = path;
    r->name = iso_text_name(path);
    status = r->format->open(ctx, r, columns);
    if (status == ISO_OK)
        *reader = r;
    else
        iso_table_reader_close(r);
    return status;
}

iso_status iso_table_reader_open(iso_context *ctx, const char *path, const char *kind, iso_table_reader **reader)
{
    return iso_table_reader_make(ctx, path, NULL, &(iso_table_reader){.kind = kind}, reader);
}

void iso_table_reader_close(iso_table_reader *r)
{
    if (!r) return;
    r->format->close(r);
    iso_record_free(r->header);
    free(r);
}

void iso_table_pass_words(iso_table_reader *r)
{
    r->forgets = true;
}

iso_record *iso_table_header(iso_table_reader *r)
{
    return r->header;
}

iso_status iso_table_next(iso_context *ctx, iso_table_reader *r, double row[], bool *more)
{
    ISO_DEFAULT_ARITHMETIC;
    return r->format->next(ctx, r, row, more);
}

iso_status iso_table_read_all(iso_context *ctx, iso_table_reader *r, iso_record **record)
{
    const size_t columns = iso_record_columns(r->header);
    const double numbers = (double)r->rows * (double)columns;
    *record = NULL;
    if (!r->trajectory && numbers > MOST_NUMBERS)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "", "%s: %zu rows of %zu columns are more than %g numbers",
                                r->name, r->rows, columns, MOST_NUMBERS);
    double *row = malloc((columns + 1) * sizeof *row), *to;
    bool more = true;
    if (!row) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", r->name);
    iso_status status;
    while ((status = iso_table_next(ctx, r, row, &more)) == ISO_OK && more) {
        status = iso_record_append(ctx, r->header, &to);
        if (status != ISO_OK) break;
        memcpy(to, row, columns * sizeof *to);
    }
    free(row);
    if (status == ISO_OK) *record = r->header, r->header = NULL;
    return status;
}

iso_status iso_table_read(iso_context *ctx, const char *path, const char *kind, iso_record **record)
{
    iso_table_reader *r;
    *record = NULL;
    iso_status status = iso_table_reader_open(ctx, path, kind, &r);
    if (status == ISO_OK) status = iso_table_read_all(ctx, r, record);
    iso_table_reader_close(r);
    return status;
}

void iso_table_kind(const char *path, char kind[ISO_KIND_SIZE])
{
    iso_context *ctx = iso_context_create();
    iso_table_reader *r = NULL;
    struct stat s;
    *kind = '\0';
    if (ctx && stat(path, &s) == 0 && S_ISREG(s.st_mode) && iso_table_reader_open(ctx, path, NULL, &r) == ISO_OK)
        snprintf(kind, ISO_KIND_SIZE, "%s", iso_record_kind(r->header));
    iso_table_reader_close(r);
    iso_context_free(ctx);
}

iso_status iso_table_name_columns(iso_context *ctx, iso_table_reader *r, size_t count, const char *const names[])
{
    iso_record *named;
    const iso_status status = iso_record_create_like(ctx, r->header, count, names, &named);
    if (status != ISO_OK) return status;
    iso_record_free(r->header);
    r->header = named;
    return ISO_OK;
}

/* --- writing ---------------------------------------------------------------------------------------------------- */

static void release(iso_table_writer *w)
{
    iso_record_free(w->header);
    free(w);
}

iso_status iso_table_writer_open(iso_context *ctx, const char *path, const char *kind, iso_table_writer **writer)
{
    *writer = NULL;
    iso_status status = iso_table_check_format(ctx, path);
    if (status != ISO_OK) return status;
    iso_table_writer *w = calloc(1, sizeof *w);
    if (!w) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write '%s'", path);
    w->format = iso_table_is_hdf5(path) ? HDF5(iso_hdf5_writing) : &iso_csv_writing;
    w->digits = 17;
    w->kind = kind;
    w->expected = SIZE_MAX;
    status = w->format->open(ctx, w, path);
    if (status == ISO_OK)
        *writer = w;
    else
        release(w);
    return status;
}

void iso_table_writer_expect(iso_table_writer *w, size_t rows)
{
    w->expected = rows;
}

void iso_table_writer_keep_others(iso_table_writer *w)
{
    w->fresh = true;
}

bool iso_table_writer_waits(const iso_table_writer *w)
{
    return w->waits;
}

/* Readers of CSV know columns of words by their names. */
static iso_status look_for_words(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    for (size_t i = 0; i < iso_record_columns(header); i++) {
        if (!iso_record_has_words(header, i)) continue;
        w->words = header;
        if (iso_table_has_words(iso_record_name(header, i))) continue;
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "the column '%s' cannot have words",
                                iso_record_name(header, i));
    }
    return ISO_OK;
}

iso_status iso_table_write_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    if (w->header) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "the header is already written");
    iso_status status = look_for_words(ctx, w, header);
    if (status == ISO_OK) status = iso_record_create_like(ctx, header, 0, NULL, &w->header);
    return status == ISO_OK ? w->format->header(ctx, w, header) : status;
}

iso_status iso_table_write_row(iso_context *ctx, iso_table_writer *w, const double row[])
{
    ISO_DEFAULT_ARITHMETIC;
    w->rows++;
    return w->format->row(ctx, w, row);
}

iso_status iso_table_write_line(iso_context *ctx, iso_table_writer *w, const char *key, const char *value)
{
    return w->format->line(ctx, w, key, value);
}

iso_status iso_table_writer_close(iso_context *ctx, iso_table_writer *w, bool keep)
{
    if (!w) return ISO_OK;
    const iso_status status = w->format->close(ctx, w, keep);
    release(w);
    return status;
}

iso_status iso_table_write(iso_context *ctx, const char *path, const iso_record *record)
{
    iso_table_writer *w;
    iso_status status = iso_table_writer_open(ctx, path, iso_record_kind(record), &w);
    if (status != ISO_OK) return status;
    iso_table_writer_expect(w, iso_record_rows(record));
    status = iso_table_write_header(ctx, w, record);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(record); i++)
        status = iso_table_write_row(ctx, w, iso_record_const_row(record, i));
    const iso_status closed = iso_table_writer_close(ctx, w, status == ISO_OK);
    return status != ISO_OK ? status : closed;
}
