/* hdf5_writer.c - trajectories into HDF5: block by block into a temporary file, which is then renamed. */
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
static int numbers_of(const char *value, double numbers[ISO_HDF5_NUMBERS])
{
    int count = 0;
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
    const int count = numbers_of(value, numbers);
    bool written;
    H5E_BEGIN_TRY
    {
        written = count > 0 ? iso_hdf5_write_numbers(s->file, key, count, numbers)
                            : iso_hdf5_write_text(s->file, key, value);
    }
    H5E_END_TRY
    return written ? ISO_OK : iso_hdf5_trouble(ctx, "write", w->name);
}

/* An empty dataset of `count` columns that can grow. */
static hid_t create_set(hid_t file, const char *group, const char *name, int count)
{
    const hsize_t none[2] = {0, (hsize_t)count}, ever[2] = {H5S_UNLIMITED, (hsize_t)count};
    const hsize_t chunk[2] = {ISO_HDF5_BLOCK, (hsize_t)count};
    const int rank = count > 1 ? 2 : 1;
    char path[64];
    snprintf(path, sizeof path, "/%s/%s", group, name);
    const hid_t space = H5Screate_simple(rank, none, ever), plan = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t link = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_chunk(plan, rank, chunk);
    H5Pset_fill_time(plan, H5D_FILL_TIME_NEVER);
    H5Pset_create_intermediate_group(link, 1);
    const hid_t access = iso_hdf5_access();
    const hid_t id = H5Dcreate2(file, path, H5T_NATIVE_DOUBLE, space, link, plan, access);
    H5Pclose(access);
    H5Pclose(link);
    H5Pclose(plan);
    H5Sclose(space);
    return id;
}

static bool add_set(iso_hdf5_store *s, hid_t id, int first, int count)
{
    if (id >= 0) s->set[s->sets++] = (iso_hdf5_set){id, first, count};
    return id >= 0;
}

/* One dataset for the whole part if the record has all its columns side by side, else one for each column it has. */
static bool create_part(iso_hdf5_store *s, const iso_hdf5_part *p, const iso_record *header)
{
    int at[ISO_TRAJECTORY_COLUMNS];
    bool whole = true;
    for (int i = 0; i < p->count; i++) {
        at[i] = iso_record_find(header, iso_column_name(p->first + i));
        whole = whole && at[i] >= 0 && at[i] == at[0] + i;
    }
    if (whole) return add_set(s, create_set(s->file, p->group, p->name, p->count), at[0], p->count);
    for (int i = 0; i < p->count; i++)
        if (at[i] >= 0 && !add_set(s, create_set(s->file, p->group, iso_column_name(p->first + i), 1), at[i], 1))
            return false;
    return true;
}

/* Columns that no trajectory has: those of a section. */
static bool create_others(iso_hdf5_store *s, const iso_record *header)
{
    bool good = true;
    for (size_t c = 0; good && c < iso_record_columns(header); c++)
        if (iso_column_find(iso_record_name(header, c)) < 0)
            good = add_set(s, create_set(s->file, "section", iso_record_name(header, c), 1), (int)c, 1);
    return good;
}

static iso_status hdf5_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    iso_hdf5_store *s = w->data;
    const char *key, *value;
    char format[64];
    iso_hdf5_part parts[ISO_HDF5_PARTS];
    const int count = iso_hdf5_parts(parts);
    if (!iso_hdf5_store_room(s, iso_record_columns(header)))
        return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write '%s'", w->name);
    bool good = true;
    H5E_BEGIN_TRY
    {
        snprintf(format, sizeof format, "isoroll %s " ISO_TRAJECTORY_VERSION, w->kind);
        good = iso_hdf5_write_text(s->file, "format", format);
        for (int p = 0; good && p < count; p++) good = create_part(s, &parts[p], header);
        good = good && create_others(s, header);
    }
    H5E_END_TRY
    iso_status status = good ? ISO_OK : iso_hdf5_trouble(ctx, "write", w->name);
    for (size_t i = 0; status == ISO_OK && iso_record_line(header, i, &key, &value); i++)
        if (strcmp(key, "format") != 0) status = hdf5_line(ctx, w, key, value);
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
    return ++s->filled == ISO_HDF5_BLOCK ? flush_block(ctx, w) : ISO_OK;
}

static iso_status hdf5_finish(iso_context *ctx, iso_table_writer *w, bool keep)
{
    iso_hdf5_store *s = w->data;
    iso_replacement replacement = s->replacement;
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
