/* hdf5_writer.c - tables into HDF5: block by block into a temporary file, which is then renamed. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/field.h"
#include "base/number_impl.h"
#include "io/hdf5/hdf5_impl.h"
#include "io/text_impl.h"

/* Without HDF5's own lock: on some network file systems it would meet the one that a replacement holds. */
static hid_t create_file(const char *path)
{
    const hid_t plan = h5.Pcreate(H5P_FILE_ACCESS);
    h5.Pset_file_locking(plan, false, true);
    const hid_t file = h5.Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, plan);
    h5.Pclose(plan);
    return file;
}

static iso_status hdf5_create(iso_context *ctx, iso_table_writer *w, const char *path)
{
    ISO_TRY(iso_hdf5_load(ctx));
    iso_hdf5_store *s = w->data = iso_hdf5_store_create();
    if (!s) return iso_text_no_memory(ctx, "write", path);
    iso_status status = iso_replacement_open(ctx, path, true, &s->replacement, &s->descriptor);
    if (status == ISO_OK) {
        w->name = s->replacement.target;
        ISO_HDF5_QUIETLY(s->file = create_file(s->replacement.temporary));
        if (s->file >= 0) return ISO_OK;
        status = iso_hdf5_trouble(ctx, "write", path);
        iso_replacement_close(ctx, &s->replacement, s->descriptor, false);
        close(s->descriptor);
    }
    iso_hdf5_store_free(s);
    return status;
}

/* --- attributes ------------------------------------------------------------------------------------------------- */

/* The type of texts; size H5T_VARIABLE: of any length. The caller closes it. */
static hid_t text_type(size_t size)
{
    const hid_t type = h5.Tcopy(H5T_C_S1);
    h5.Tset_size(type, size);
    h5.Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

/* False: it fails. */
static bool write_attribute(hid_t at, const char *key, hid_t type, hsize_t count, const void *value)
{
    const hid_t space = count < 2 ? h5.Screate(H5S_SCALAR) : h5.Screate_simple(1, &count, NULL);
    const hid_t attribute = h5.Acreate2(at, key, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool written = attribute >= 0 && h5.Awrite(attribute, type, value) >= 0;
    if (attribute >= 0) h5.Aclose(attribute);
    h5.Sclose(space);
    return written;
}

/* Text of variable length, since Python reads that as text and not as bytes. */
static bool write_text(hid_t at, const char *key, const char *value)
{
    const hid_t type = text_type(H5T_VARIABLE);
    const bool written = write_attribute(at, key, type, 1, &value);
    h5.Tclose(type);
    return written;
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
    ISO_HDF5_QUIETLY(written = count > 0 ? write_attribute(s->file, key, H5T_NATIVE_DOUBLE, (hsize_t)count, numbers)
                                         : write_text(s->file, key, value));
    return written ? ISO_OK : iso_hdf5_trouble(ctx, "write", w->name);
}

/* --- datasets --------------------------------------------------------------------------------------------------- */

/* A dataset of `count` columns. rows: all that come, which get their room now; SIZE_MAX: it grows in such chunks. */
static hid_t create_set(hid_t file, const char *path, hid_t type, int count, size_t rows, hsize_t chunk)
{
    const bool grows = rows == SIZE_MAX, numbers = h5.Tget_class(type) != H5T_STRING;
    const hsize_t wide = (hsize_t)count, size[2] = {grows ? 0 : rows, wide}, ever[2] = {H5S_UNLIMITED, wide};
    const int rank = count > 1 ? 2 : 1;
    const hid_t space = h5.Screate_simple(rank, size, grows ? ever : NULL), access = iso_hdf5_access();
    const hid_t link = h5.Pcreate(H5P_LINK_CREATE), plan = h5.Pcreate(H5P_DATASET_CREATE);
    h5.Pset_create_intermediate_group(link, 1);
    h5.Pset_obj_track_times(plan, 0);
    h5.Pset_fill_time(plan, numbers ? H5D_FILL_TIME_NEVER : H5D_FILL_TIME_ALLOC);
    if (grows)
        h5.Pset_chunk(plan, rank, (hsize_t[]){chunk, wide});
    else
        h5.Pset_alloc_time(plan, H5D_ALLOC_TIME_EARLY);
    const hid_t id = h5.Dcreate2(file, path, type, space, link, plan, access);
    h5.Pclose(access);
    h5.Pclose(link);
    h5.Pclose(plan);
    h5.Sclose(space);
    return id;
}

static bool add_set(const iso_table_writer *w, const char *group, const char *name, hid_t type, int first, int count)
{
    iso_hdf5_store *s = w->data;
    char path[ISO_HDF5_TEXT];
    snprintf(path, sizeof path, "/%s%s%s", group, *group ? "/" : "", name);
    const hid_t id = create_set(s->file, path, type, count, w->expected, ISO_HDF5_BLOCK);
    return iso_hdf5_store_add(s, (iso_hdf5_set){.id = id,
                                                .first = first,
                                                .count = count,
                                                .words = h5.Tget_class(type) == H5T_STRING,
                                                .grows = w->expected == SIZE_MAX});
}

static bool create_failures(iso_hdf5_store *s, const iso_record *header)
{
    const hsize_t chunk = 1024;
    const hid_t type = text_type(ISO_HDF5_TEXT);
    s->failed.point = create_set(s->file, "/failed/point", H5T_NATIVE_INT64, 1, SIZE_MAX, chunk);
    s->failed.reason = create_set(s->file, "/failed/reason", type, 1, SIZE_MAX, chunk);
    s->failed.point_column = iso_record_find(header, "point");
    s->failed.status_column = iso_record_find(header, "status");
    s->failed.reason_column = iso_record_find(header, "reason");
    h5.Tclose(type);
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
        good = length > 0 && length < sizeof path && add_set(w, "", path, H5T_NATIVE_DOUBLE, c, 1);
        at += length;
    }
    good = good && at && columns > 2 && add_set(w, "", "status", H5T_NATIVE_INT, columns - 2, 1);
    if (good && strcmp(w->kind, "sweep") != 0) good = add_set(w, "", "point", H5T_NATIVE_INT64, 0, 1);
    return good && create_failures(w->data, header);
}

/* The datasets, those of a trajectory in its parts, and the names of the columns in their order. */
static bool create_table(const iso_table_writer *w, const iso_record *header)
{
    const iso_hdf5_store *s = w->data;
    const size_t columns = iso_record_columns(header);
    const char **names = malloc((columns + 1) * sizeof *names);
    char *list = malloc(columns * ISO_COLUMN_SIZE + 1), *end = list;
    bool good = names && list;
    for (size_t c = 0; good && c < columns; c++) {
        names[c] = iso_record_name(header, c);
        end += sprintf(end, c ? ",%s" : "%s", names[c]);
    }
    const hid_t text = text_type(H5T_VARIABLE);
    for (size_t c = 0, taken; good && c < columns; c += taken) {
        const char *group = w->kind, *name = names[c];
        taken = (size_t)iso_hdf5_part(names + c, columns - c, &group, &name);
        const hid_t type = iso_record_has_words(header, c) ? text : H5T_NATIVE_DOUBLE;
        good = add_set(w, group, name, type, (int)c, (int)taken);
    }
    h5.Tclose(text);
    if (strcmp(w->kind, ISO_TRAJECTORY_KIND) != 0) good = good && write_text(s->file, ISO_HDF5_COLUMNS, list);
    free(names);
    free(list);
    return good;
}

/* What create_sweep and the transfer of failures count on. */
static iso_status check_sweep(iso_context *ctx, const iso_record *header)
{
    static const char *const names[] = {"point", "status", "reason"};
    const int last = (int)iso_record_columns(header) - 1, place[] = {0, last - 1, last};
    for (int i = 0; i < 3; i++)
        if (iso_record_find(header, names[i]) != place[i])
            return ISO_FAIL_ARGUMENT(ctx, names[i],
                                     "a sweep has the columns point, what varies, what is measured, status, reason; "
                                     "'%s' is not in its place",
                                     names[i]);
    if (iso_record_get(header, ISO_HDF5_COLUMNS)) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, ISO_HDF5_COLUMNS, "a sweep has the line '%s'", ISO_HDF5_COLUMNS);
}

static bool create(const iso_table_writer *w, const iso_record *header)
{
    const iso_hdf5_store *s = w->data;
    char format[64];
    snprintf(format, sizeof format, "isoroll %s 1", w->kind);
    return write_text(s->file, "format", format) &&
           (iso_hdf5_is_sweep(w->kind) ? create_sweep(w, header) : create_table(w, header));
}

static iso_status hdf5_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    iso_hdf5_store *s = w->data;
    const char *key, *value;
    const bool named = !iso_hdf5_is_sweep(w->kind) && strcmp(w->kind, ISO_TRAJECTORY_KIND) != 0;
    bool good;
    if (iso_hdf5_is_sweep(w->kind)) ISO_TRY(check_sweep(ctx, header));
    if (!iso_hdf5_store_room(s, iso_record_columns(header))) return iso_text_no_memory(ctx, "write", w->name);
    s->words = w->words;
    ISO_HDF5_QUIETLY(good = create(w, header));
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
    ISO_HDF5_QUIETLY(good = iso_hdf5_transfer(s, s->rows, true));
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
    ISO_HDF5_QUIETLY(closed = iso_hdf5_store_free(s));
    if (status == ISO_OK && keep && !closed) status = iso_hdf5_trouble(ctx, "write", w->name);
    const iso_status renamed = iso_replacement_close(ctx, &replacement, descriptor, keep && status == ISO_OK);
    close(descriptor);
    return status == ISO_OK ? renamed : status;
}

const iso_table_writing iso_hdf5_writing = {hdf5_create, hdf5_header, hdf5_row, hdf5_line, hdf5_finish};
