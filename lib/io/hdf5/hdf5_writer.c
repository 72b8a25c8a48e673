/* hdf5_writer.c - tables into HDF5: block by block into a temporary file, which is then renamed. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/number.h"
#include "io/hdf5/hdf5_impl.h"

static iso_status hdf5_create(iso_context *ctx, iso_table_writer *w, const char *path)
{
    iso_status status = iso_hdf5_load(ctx);
    if (status != ISO_OK) return status;
    iso_hdf5_store *s = w->data = iso_hdf5_store_create();
    if (!s) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write '%s'", path);
    status = iso_replacement_open(ctx, path, true, &s->replacement, &s->descriptor);
    if (status == ISO_OK) {
        w->name = s->replacement.target;
        H5E_BEGIN_TRY
        {
            s->file = iso_hdf5_create(s->replacement.temporary);
        }
        H5E_END_TRY
        if (s->file >= 0) return ISO_OK;
        status = iso_hdf5_trouble(ctx, "write", path);
        iso_replacement_close(ctx, &s->replacement, s->descriptor, false);
        close(s->descriptor);
    }
    iso_hdf5_store_free(s);
    return status;
}

/* Reads a value as numbers with blanks between, and returns how many; 0: it is text. */
static int numbers_of(const char *key, const char *value, double numbers[ISO_HDF5_NUMBERS])
{
    int count = 0;
    if (strcmp(key, "hash") == 0 || strcmp(key, "sum") == 0) return 0; /* digits that are no number */
    for (const char *c = value; *c && count < ISO_HDF5_NUMBERS; count++) {
        const size_t length = strcspn(c, " ");
        if (!iso_number_read(c, length, &numbers[count])) return 0;
        c += length;
        c += strspn(c, " ");
        if (!*c) return count + 1;
    }
    return 0;
}

static iso_status hdf5_line(iso_context *ctx, iso_table_writer *w, const char *key, const char *value)
{
    const iso_hdf5_store *s = w->data;
    double numbers[ISO_HDF5_NUMBERS];
    const int count = numbers_of(key, value, numbers);
    bool written;
    H5E_BEGIN_TRY
    {
        written = count > 0 ? iso_hdf5_write_numbers(s->file, key, count, numbers)
                            : iso_hdf5_write_text(s->file, key, value);
    }
    H5E_END_TRY
    return written ? ISO_OK : iso_hdf5_trouble(ctx, "write", w->name);
}

/* How a dataset is stored: with room for all rows, if their number is known, or in chunks as they come. */
static hid_t storage_of(bool grows, int rank, int count, bool numbers, hsize_t rows)
{
    const hsize_t chunk[2] = {rows, (hsize_t)count};
    const hid_t plan = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(plan, 0);
    H5Pset_fill_time(plan, numbers ? H5D_FILL_TIME_NEVER : H5D_FILL_TIME_ALLOC);
    if (grows)
        H5Pset_chunk(plan, rank, chunk);
    else
        H5Pset_alloc_time(plan, H5D_ALLOC_TIME_EARLY);
    return plan;
}

/* A dataset of `count` columns. rows: all that come, SIZE_MAX: it grows in chunks of so many. */
static hid_t create_set(hid_t file, const char *path, hid_t type, int count, size_t rows, hsize_t chunk)
{
    const bool grows = rows == SIZE_MAX, numbers = H5Tget_class(type) != H5T_STRING;
    const hsize_t size[2] = {grows ? 0 : rows, (hsize_t)count}, ever[2] = {H5S_UNLIMITED, (hsize_t)count};
    const int rank = count > 1 ? 2 : 1;
    const hid_t space = H5Screate_simple(rank, size, grows ? ever : NULL), link = H5Pcreate(H5P_LINK_CREATE);
    const hid_t plan = storage_of(grows, rank, count, numbers, chunk), access = iso_hdf5_access();
    H5Pset_create_intermediate_group(link, 1);
    const hid_t id = H5Dcreate2(file, path, type, space, link, plan, access);
    H5Pclose(access);
    H5Pclose(link);
    H5Pclose(plan);
    H5Sclose(space);
    return id;
}

/* The type of texts; size H5T_VARIABLE: of any length. The caller closes it. */
static hid_t text_type(size_t size)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, size);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

static bool add_set(const iso_table_writer *w, const char *group, const char *name, hid_t type, int first, int count)
{
    iso_hdf5_store *s = w->data;
    char path[200];
    snprintf(path, sizeof path, "/%s%s%s", group, *group ? "/" : "", name);
    const hid_t id = create_set(s->file, path, type, count, w->expected, ISO_HDF5_BLOCK);
    return iso_hdf5_store_add(s, (iso_hdf5_set){.id = id,
                                                .first = first,
                                                .count = count,
                                                .words = H5Tget_class(type) == H5T_STRING,
                                                .grows = w->expected == SIZE_MAX});
}

static bool add_numbers(const iso_table_writer *w, const char *group, const char *name, int first, int count)
{
    return add_set(w, group, name, H5T_NATIVE_DOUBLE, first, count);
}

static bool add_words(const iso_table_writer *w, const char *group, const char *name, int column)
{
    const hid_t type = text_type(H5T_VARIABLE);
    const bool good = add_set(w, group, name, type, column, 1);
    H5Tclose(type);
    return good;
}

/* One dataset for the whole part if the record has all its columns side by side, else one for each column it has. */
static bool create_part(const iso_table_writer *w, const iso_hdf5_part *p, const iso_record *header)
{
    int at[ISO_TRAJECTORY_COLUMNS];
    bool whole = true;
    for (int i = 0; i < p->count; i++) {
        at[i] = iso_record_find(header, iso_column_name(p->first + i));
        whole = whole && at[i] >= 0 && at[i] == at[0] + i;
    }
    if (whole) return add_numbers(w, p->group, p->name, at[0], p->count);
    for (int i = 0; i < p->count; i++)
        if (at[i] >= 0 && !add_numbers(w, p->group, iso_column_name(p->first + i), at[i], 1)) return false;
    return true;
}

/* Columns that no trajectory has. */
static bool create_others(const iso_table_writer *w, const iso_record *header)
{
    bool good = true;
    for (size_t c = 0; good && c < iso_record_columns(header); c++) {
        const char *name = iso_record_name(header, c);
        if (iso_record_has_words(header, c))
            good = add_words(w, w->kind, name, (int)c);
        else if (iso_column_find(name) < 0)
            good = add_numbers(w, w->kind, name, (int)c, 1);
    }
    return good;
}

static bool create_failures(iso_hdf5_store *s, const iso_record *header)
{
    const hsize_t chunk = 1024;
    const hid_t type = text_type(ISO_HDF5_REASON);
    s->failed.point = create_set(s->file, "/failed/point", H5T_NATIVE_INT64, 1, SIZE_MAX, chunk);
    s->failed.reason = create_set(s->file, "/failed/reason", type, 1, SIZE_MAX, chunk);
    s->failed.point_column = iso_record_find(header, "point");
    s->failed.status_column = iso_record_find(header, "status");
    s->failed.reason_column = iso_record_find(header, "reason");
    H5Tclose(type);
    return s->failed.point >= 0 && s->failed.reason >= 0;
}

/* The columns of a sweep: the point, those that the line "columns" names, the status and the reason. */
static bool create_sweep(const iso_table_writer *w, const iso_record *header)
{
    const int columns = (int)iso_record_columns(header);
    const char *at = iso_record_get(header, "columns");
    bool good = true;
    for (int c = 1; good && at && c < columns - 2; c++, at += strspn(at, " ")) {
        char path[160];
        const size_t length = strcspn(at, " ");
        snprintf(path, sizeof path, "%.*s", (int)length, at);
        good = length > 0 && length < sizeof path && add_numbers(w, "", path, c, 1);
        at += length;
    }
    good = good && at && columns > 2 && add_set(w, "", "status", H5T_NATIVE_INT, columns - 2, 1);
    if (good && strcmp(w->kind, "sweep") != 0) good = add_set(w, "", "point", H5T_NATIVE_INT64, 0, 1);
    return good && create_failures(w->data, header);
}

static bool create_table(const iso_table_writer *w, const iso_record *header)
{
    iso_hdf5_part parts[ISO_HDF5_PARTS];
    const int count = iso_hdf5_parts(parts);
    bool good = true;
    for (int p = 0; good && p < count; p++) good = create_part(w, &parts[p], header);
    return good && create_others(w, header);
}

/* The names of the columns in their order, which datasets do not have. */
static bool write_columns(const iso_table_writer *w, const iso_record *header)
{
    const iso_hdf5_store *s = w->data;
    const size_t columns = iso_record_columns(header);
    size_t room = 1;
    for (size_t c = 0; c < columns; c++) room += strlen(iso_record_name(header, c)) + 1;
    char *text = malloc(room), *at = text;
    for (size_t c = 0; text && c < columns; c++) at += sprintf(at, c ? ",%s" : "%s", iso_record_name(header, c));
    const bool good = text && iso_hdf5_write_text(s->file, ISO_HDF5_COLUMNS, text);
    free(text);
    return good;
}

static iso_status hdf5_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    iso_hdf5_store *s = w->data;
    const char *key, *value;
    char format[64];
    if (!iso_hdf5_store_room(s, iso_record_columns(header)))
        return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write '%s'", w->name);
    const bool sweep = iso_hdf5_is_sweep(w->kind), named = !sweep && strcmp(w->kind, ISO_TRAJECTORY_KIND) != 0;
    bool good;
    s->words = w->words;
    H5E_BEGIN_TRY
    {
        snprintf(format, sizeof format, "isoroll %s " ISO_TRAJECTORY_VERSION, w->kind);
        good = iso_hdf5_write_text(s->file, "format", format);
        good = good && (sweep ? create_sweep(w, header) : create_table(w, header));
        good = good && (!named || write_columns(w, header));
    }
    H5E_END_TRY
    iso_status status = good ? ISO_OK : iso_hdf5_trouble(ctx, "write", w->name);
    for (size_t i = 0; status == ISO_OK && iso_record_line(header, i, &key, &value); i++)
        if (strcmp(key, "format") != 0 && (!named || strcmp(key, ISO_HDF5_COLUMNS) != 0))
            status = hdf5_line(ctx, w, key, value);
    return status;
}

static iso_status flush_block(iso_context *ctx, iso_table_writer *w)
{
    iso_hdf5_store *s = w->data;
    bool good;
    H5E_BEGIN_TRY
    {
        good = iso_hdf5_transfer(s, s->rows, true);
    }
    H5E_END_TRY
    s->rows += s->filled;
    s->filled = 0;
    return good ? ISO_OK : iso_hdf5_trouble(ctx, "write", w->name);
}

static iso_status hdf5_row(iso_context *ctx, iso_table_writer *w, const double row[])
{
    iso_hdf5_store *s = w->data;
    memcpy(s->block + s->filled * s->columns, row, s->columns * sizeof *row);
    w->waits = ++s->filled < ISO_HDF5_BLOCK;
    return w->waits ? ISO_OK : flush_block(ctx, w);
}

static iso_status hdf5_finish(iso_context *ctx, iso_table_writer *w, bool keep)
{
    iso_hdf5_store *s = w->data;
    iso_replacement replacement = s->replacement;
    replacement.fresh = w->fresh;
    const int descriptor = s->descriptor;
    iso_status status = keep ? flush_block(ctx, w) : ISO_OK;
    bool closed;
    H5E_BEGIN_TRY
    {
        closed = iso_hdf5_store_free(s);
    }
    H5E_END_TRY
    if (status == ISO_OK && keep && !closed) status = iso_hdf5_trouble(ctx, "write", w->name);
    const iso_status renamed = iso_replacement_close(ctx, &replacement, descriptor, keep && status == ISO_OK);
    close(descriptor);
    return status == ISO_OK ? renamed : status;
}

const iso_table_writing iso_hdf5_writing = {hdf5_create, hdf5_header, hdf5_row, hdf5_line, hdf5_finish};
