/* table.c - files of tables: takes the format from the name of the file, and calls its reader or writer. */
#include "io/table.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/arithmetic_impl.h"
#include "io/table_impl.h"
#include "io/text_impl.h"
#include "orbit/scene.h"

/* Of a record, unless its file is as large: packed numbers in a small file can need more memory than there is. */
#define MOST_NUMBERS 1e8

/* --- formats ---------------------------------------------------------------------------------------------------- */

bool iso_table_is_hdf5(const char *path)
{
    const size_t length = strlen(path);
    return (length > 3 && strcasecmp(path + length - 3, ".h5") == 0) ||
           (length > 5 && strcasecmp(path + length - 5, ".hdf5") == 0);
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
#define HDF5(format) &(format)
#else
#define HDF5(format) NULL
#endif

static iso_status check(iso_context *ctx, const char *path, bool hdf5)
{
    const iso_table_reading *format = HDF5(iso_hdf5_reading);
    if (format || !hdf5) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "", "'%s': this build has no HDF5 (.h5), use CSV, a name in .csv", path);
}

bool iso_table_is_finite(const char *kind)
{
    return strcmp(kind, ISO_TRAJECTORY_KIND) == 0 || strcmp(kind, "section") == 0;
}

iso_status iso_table_check_format(iso_context *ctx, const char *path)
{
    return check(ctx, path, iso_table_is_hdf5(path));
}

/* --- reading ---------------------------------------------------------------------------------------------------- */

/* A reader that fails to open is still there, and knows what it has read so far. */
static iso_status open_reader(iso_context *ctx, const char *path, const char *kind, const char *columns,
                              iso_table_reader **reader)
{
    *reader = NULL;
    const bool hdf5 = begins_as_hdf5(path);
    ISO_TRY(check(ctx, path, hdf5));
    iso_table_reader *r = *reader = calloc(1, sizeof *r);
    if (!r) return iso_text_no_memory(ctx, "read", path);
    r->format = hdf5 ? HDF5(iso_hdf5_reading) : &iso_csv_reading;
    r->path = path;
    r->name = iso_text_name(path);
    r->kind = kind;
    r->trajectory = kind && strcmp(kind, ISO_TRAJECTORY_KIND) == 0;
    const iso_status status = r->format->open(ctx, r, columns);
    if (*r->ignored) r->at.ignored = r->ignored;
    return status;
}

iso_status iso_table_reader_open(iso_context *ctx, const char *path, const char *kind, const char *columns,
                                 iso_table_reader **reader)
{
    const iso_status status = open_reader(ctx, path, kind, columns, reader);
    if (status != ISO_OK) iso_table_reader_close(*reader), *reader = NULL;
    return status;
}

void iso_table_reader_close(iso_table_reader *r)
{
    if (!r) return;
    r->format->close(r);
    iso_record_free(r->header);
    free(r);
}

iso_record *iso_table_header(iso_table_reader *r)
{
    return r->header;
}

void iso_table_pass_nan(iso_table_reader *r)
{
    r->passes = true;
}

const iso_table_place *iso_table_at(const iso_table_reader *r)
{
    return &r->at;
}

iso_status iso_table_next(iso_context *ctx, iso_table_reader *r, double row[], bool *more)
{
    ISO_DEFAULT_ARITHMETIC;
    const double before = r->at.orbit;
    const iso_status status = r->format->next(ctx, r, row, more);
    if (status != ISO_OK || !*more) return status;
    r->at.begins_orbit = r->any && r->at.orbit != before;
    r->any = true;
    return ISO_OK;
}

/* The rows of several orbits, with the number of their orbit in front. */
static iso_status put_orbits(iso_context *ctx, const iso_record *rows, const double orbit[], iso_record **record)
{
    const char *names[1 + ISO_TRAJECTORY_COLUMNS] = {ISO_ORBIT_COLUMN};
    const size_t columns = iso_record_columns(rows);
    double *to;
    for (size_t i = 0; i < columns; i++) names[1 + i] = iso_record_name(rows, i);
    iso_status status = iso_record_create_like(ctx, rows, 1 + columns, names, record);
    for (size_t i = 0; i < iso_record_rows(rows) && status == ISO_OK; i++) {
        status = iso_record_append(ctx, *record, &to);
        if (status != ISO_OK) break;
        *to = orbit[i];
        memcpy(to + 1, iso_record_const_row(rows, i), columns * sizeof *to);
    }
    if (status != ISO_OK) iso_record_free(*record), *record = NULL;
    return status;
}

iso_status iso_table_read_all(iso_context *ctx, iso_table_reader *r, iso_record **record)
{
    const size_t columns = iso_record_columns(r->header);
    const double numbers = (double)r->rows * (double)columns;
    const bool orbits = r->trajectory && r->at.orbits;
    *record = NULL;
    if (numbers > MOST_NUMBERS && numbers * sizeof(double) > r->stored)
        return ISO_FAIL_INPUT(ctx, "", "%s: %zu rows of %zu columns are more than %g numbers", r->name, r->rows,
                              columns, MOST_NUMBERS);
    double *row = malloc((columns + 1) * sizeof *row), *orbit = NULL, *to;
    size_t count = 0, room = 0;
    bool more = true;
    iso_status status = row ? ISO_OK : iso_text_no_memory(ctx, "read", r->name);
    while (status == ISO_OK && (status = iso_table_next(ctx, r, row, &more)) == ISO_OK && more) {
        if (orbits && count == room) {
            double *wider = realloc(orbit, (room = 2 * room + 64) * sizeof *orbit);
            if (!wider) status = iso_text_no_memory(ctx, "read", r->name);
            if (wider) orbit = wider;
        }
        if (status == ISO_OK) status = iso_record_append(ctx, r->header, &to);
        if (status != ISO_OK) break;
        if (orbits) orbit[count++] = r->at.orbit;
        memcpy(to, row, columns * sizeof *to);
    }
    if (status == ISO_OK && orbits) status = put_orbits(ctx, r->header, orbit, record);
    if (status == ISO_OK && !orbits) *record = r->header, r->header = NULL;
    free(orbit);
    free(row);
    return status;
}

iso_status iso_table_read(iso_context *ctx, const char *path, const char *kind, const char *columns,
                          iso_record **record, size_t *passed)
{
    iso_table_reader *r;
    *record = NULL;
    ISO_TRY(iso_table_reader_open(ctx, path, kind, columns, &r));
    r->passes = passed != NULL;
    const iso_status status = iso_table_read_all(ctx, r, record);
    if (passed) *passed = r->at.passed;
    iso_table_reader_close(r);
    return status;
}

void iso_table_kind(const char *path, char kind[ISO_KIND_SIZE])
{
    iso_context *ctx = iso_context_create();
    iso_table_reader *r = NULL;
    struct stat s;
    const bool regular = stat(path, &s) == 0 && S_ISREG(s.st_mode);
    *kind = '\0';
    if (ctx && regular) open_reader(ctx, path, NULL, NULL, &r);
    if (r && r->header) snprintf(kind, ISO_KIND_SIZE, "%s", iso_record_kind(r->header));
    iso_table_reader_close(r);
    iso_context_free(ctx);
}

iso_status iso_table_name_columns(iso_context *ctx, iso_table_reader *r, size_t count, const char *const names[])
{
    iso_record *named;
    ISO_TRY(iso_record_create_like(ctx, r->header, count, names, &named));
    iso_record_free(r->header);
    r->header = named;
    return ISO_OK;
}

/* --- writing ---------------------------------------------------------------------------------------------------- */

iso_status iso_table_writer_open_as(iso_context *ctx, const char *path, const char *kind, bool resumes,
                                    iso_table_writer **writer)
{
    *writer = NULL;
    ISO_TRY(iso_table_check_format(ctx, path));
    iso_table_writer *w = calloc(1, sizeof *w);
    if (!w) return iso_text_no_memory(ctx, "write", path);
    w->format = iso_table_is_hdf5(path) ? HDF5(iso_hdf5_writing) : &iso_csv_writing;
    w->digits = 17;
    w->kind = kind;
    w->finite = iso_table_is_finite(kind);
    w->expected = SIZE_MAX;
    w->resumes = resumes;
    const iso_status status = w->format->open(ctx, w, path);
    if (status != ISO_OK) return free(w), status;
    *writer = w;
    return ISO_OK;
}

iso_status iso_table_writer_open(iso_context *ctx, const char *path, const char *kind, iso_table_writer **writer)
{
    return iso_table_writer_open_as(ctx, path, kind, false, writer);
}

iso_status iso_table_go_on(iso_context *ctx, iso_table_writer *w, const iso_record *header, size_t length)
{
    ISO_TRY(w->format->cut(ctx, w, length));
    return iso_table_write_header(ctx, w, header);
}

iso_status iso_table_flush(iso_context *ctx, iso_table_writer *w)
{
    return w->format->flush ? w->format->flush(ctx, w) : ISO_OK;
}

void iso_table_set_digits(iso_table_writer *w, int digits)
{
    w->digits = digits;
}

/* Reading it back returns the same: a line, or a text of whole lines under a key that is one word. */
static iso_status check_line(iso_context *ctx, const char *key, const char *value)
{
    const size_t k = strlen(key), v = strlen(value);
    if (strcmp(key, ISO_WORDS_KEY) == 0)
        return ISO_FAIL_ARGUMENT(ctx, "", "the line '%s' is made of the columns that have words", key);
    const bool line = k > 0 && !strpbrk(key, ":\r\n") && !strpbrk(value, "\r\n") && !strchr(" \t", key[0]) &&
                      !strchr(" \t", key[k - 1]) &&
                      (v == 0 || (!strchr(" \t", value[0]) && !strchr(" \t", value[v - 1])));
    const bool text = k > 0 && !strpbrk(key, " \t:|\r\n") && v > 0 && value[v - 1] == '\n';
    if (line || text) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "",
                             "'%s' cannot be a line '# key: value': a key has no colon, and both are one line", key);
}

/* Both formats must return the name of a column: CSV takes no comma and no quote, of a column of words no blank; HDF5
 * takes names of datasets. */
static iso_status check_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    const char *key, *value;
    for (size_t i = 0; i < iso_record_columns(header); i++) {
        const char *name = iso_record_name(header, i);
        const bool words = iso_record_has_words(header, i);
        if (words && w->finite)
            return ISO_FAIL_ARGUMENT(ctx, name, "a %s has numbers only: '%s' cannot have words", w->kind, name);
        if (!*name || *name == '#' || strpbrk(name, words ? ", \t\"\r\n" : ",\"\r\n") || strcmp(name, ".") == 0 ||
            strcmp(name, "..") == 0)
            return ISO_FAIL_ARGUMENT(ctx, name,
                                     "a table cannot have a column '%s': a file would not give the name back", name);
        if (words) w->words = header;
    }
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++) ISO_TRY(check_line(ctx, key, value));
    return ISO_OK;
}

iso_status iso_table_write_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    if (w->header) return ISO_FAIL_ARGUMENT(ctx, "", "the header is already written");
    if (iso_record_columns(header) == 0)
        return ISO_FAIL_ARGUMENT(ctx, "", "a table needs columns in a file; this one, '%s', has only lines", w->kind);
    if (w->finite && iso_record_columns(header) > (size_t)iso_columns_count())
        return ISO_FAIL_ARGUMENT(ctx, "", "a trajectory has at most %d columns", iso_columns_count());
    ISO_TRY(check_header(ctx, w, header));
    ISO_TRY(iso_record_create_like(ctx, header, 0, NULL, &w->header));
    return w->format->header(ctx, w, header);
}

iso_status iso_table_write_row(iso_context *ctx, iso_table_writer *w, const double row[])
{
    ISO_DEFAULT_ARITHMETIC;
    double mark[ISO_TRAJECTORY_COLUMNS];
    if (!w->header || (!row && !w->finite)) return ISO_FAIL_ARGUMENT(ctx, "", "no header before the row, or no row");
    const size_t checked = w->finite ? iso_record_columns(w->header) : 0;
    for (size_t i = 0; i < checked; i++) {
        if (!row) mark[i] = NAN;
        if (!row || isfinite(row[i])) continue;
        const char *name = iso_record_name(w->header, i); /* which could not be read back */
        return iso_context_fail(ctx, ISO_NUMERICAL, name, "row %zu of '%s': %s is not finite", w->rows + 1, w->name,
                                name);
    }
    w->rows++;
    return w->format->row(ctx, w, row ? row : mark);
}

iso_status iso_table_write_line(iso_context *ctx, iso_table_writer *w, const char *key, const char *value)
{
    ISO_TRY(check_line(ctx, key, value));
    return w->format->line(ctx, w, key, value);
}

iso_status iso_table_writer_close(iso_context *ctx, iso_table_writer *w, bool keep)
{
    if (!w) return ISO_OK;
    const iso_status status = w->format->close(ctx, w, keep);
    iso_record_free(w->header);
    free(w);
    return status;
}

iso_status iso_table_write_all(iso_context *ctx, iso_table_writer *w, const iso_record *record)
{
    w->expected = iso_record_rows(record);
    iso_status status = iso_table_write_header(ctx, w, record);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(record); i++)
        status = iso_table_write_row(ctx, w, iso_record_const_row(record, i));
    const iso_status closed = iso_table_writer_close(ctx, w, status == ISO_OK);
    return status != ISO_OK ? status : closed;
}

iso_status iso_table_write_as(iso_context *ctx, const char *path, const char *kind, int digits,
                              const iso_record *record)
{
    iso_table_writer *w;
    ISO_TRY(iso_table_writer_open(ctx, path, kind, &w));
    w->digits = digits;
    return iso_table_write_all(ctx, w, record);
}

iso_status iso_table_write(iso_context *ctx, const char *path, const iso_record *record)
{
    const char *kind = iso_record_kind(record);
    return iso_table_write_as(ctx, path, *kind ? kind : ISO_TRAJECTORY_KIND, 17, record);
}
