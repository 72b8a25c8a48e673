/* hdf5.c - what the reader and the writer of trajectories as HDF5 share. */
#include "io/hdf5/hdf5_impl.h"
#include "model/model_impl.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const iso_hdf5_part own_parts[] = {
    {"clock", "t", ISO_CLOCK_T, 1},
    {"clock", "tau", ISO_CLOCK_TAU, 1},
    {"clock", "s", ISO_CLOCK_S, 1},
    {"ball", "omega", ISO_COLUMN_BALL, 3},
    {"ball", "n", ISO_COLUMN_BALL + 3, 3},
    {"point", "M", ISO_COLUMN_POINT, 3},
    {"point", "gamma", ISO_COLUMN_POINT + 3, 3},
};

int iso_hdf5_parts(iso_hdf5_part parts[ISO_HDF5_PARTS])
{
    int count = (int)(sizeof own_parts / sizeof *own_parts), column = ISO_COLUMN_EFFECTS;
    const int end = iso_columns_count();
    memcpy(parts, own_parts, sizeof own_parts);
    while (column < end) {
        const iso_effect_column *group;
        iso_effect_column_name(column - ISO_COLUMN_EFFECTS, NULL, &group, NULL);
        parts[count++] = (iso_hdf5_part){"ball", group->name, column, group->count};
        column += group->count;
    }
    return count;
}

iso_status iso_hdf5_trouble(iso_context *ctx, const char *what, const char *name)
{
    static const int reasons[] = {ENOSPC, EDQUOT, EFBIG, EIO, EROFS}; /* other values may be older than the failure */
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++)
        if (errno == reasons[i]) return iso_file_trouble(ctx, what, name);
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot %s '%s': the HDF5 library gives no reason", what,
                            name);
}

/* HDF5 would close at exit what it could not close before, a file on a full disk, and crash on it (1.10). */
iso_hdf5_store *iso_hdf5_store_create(void)
{
    H5dont_atexit();
    iso_hdf5_store *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->file = -1;
    s->descriptor = -1;
    return s;
}

bool iso_hdf5_store_room(iso_hdf5_store *s, size_t columns)
{
    s->columns = columns;
    s->block = malloc(ISO_HDF5_BLOCK * (columns + 1) * sizeof *s->block);
    s->packed = malloc(ISO_HDF5_BLOCK * (columns + 1) * sizeof *s->packed); /* at most all columns in one dataset */
    return s->block && s->packed;
}

bool iso_hdf5_store_free(iso_hdf5_store *s)
{
    bool good = true;
    if (!s) return true;
    for (int i = 0; i < s->sets; i++) good = H5Dclose(s->set[i].id) >= 0 && good;
    if (s->file >= 0) good = H5Fclose(s->file) >= 0 && good;
    free(s->block);
    free(s->packed);
    free(s);
    return good;
}

/* Without HDF5's own lock: on some network file systems it would meet the one that a replacement holds. */
hid_t iso_hdf5_create(const char *path)
{
    const hid_t plan = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_file_locking(plan, false, true);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, plan);
    H5Pclose(plan);
    return file;
}

hid_t iso_hdf5_access(void)
{
    const hid_t plan = H5Pcreate(H5P_DATASET_ACCESS);
    H5Pset_chunk_cache(plan, 1, 4 * ISO_HDF5_BLOCK * sizeof(double), 1);
    return plan;
}

/* One dataset's part, in s->packed. */
static bool transfer_set(const iso_hdf5_store *s, const iso_hdf5_set *d, hsize_t first, bool write)
{
    const hsize_t start[2] = {first, 0}, size[2] = {s->filled, (hsize_t)d->count};
    const hsize_t end[2] = {first + s->filled, size[1]};
    if (write && H5Dset_extent(d->id, end) < 0) return false;
    const hid_t there = H5Dget_space(d->id), here = H5Screate_simple(d->count > 1 ? 2 : 1, size, NULL);
    bool good = H5Sselect_hyperslab(there, H5S_SELECT_SET, start, NULL, size, NULL) >= 0;
    if (good && write) good = H5Dwrite(d->id, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, s->packed) >= 0;
    if (good && !write) good = H5Dread(d->id, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, s->packed) >= 0;
    H5Sclose(here);
    H5Sclose(there);
    return good;
}

bool iso_hdf5_transfer(iso_hdf5_store *s, hsize_t first, bool write)
{
    for (int i = 0; i < s->sets && s->filled > 0; i++) {
        const iso_hdf5_set *d = &s->set[i];
        const size_t width = (size_t)d->count;
        for (size_t row = 0; write && row < s->filled; row++)
            memcpy(s->packed + row * width, s->block + row * s->columns + d->first, width * sizeof *s->packed);
        if (!transfer_set(s, d, first, write)) return false;
        for (size_t row = 0; !write && row < s->filled; row++)
            memcpy(s->block + row * s->columns + d->first, s->packed + row * width, width * sizeof *s->packed);
    }
    return true;
}

static bool write_attribute(hid_t at, const char *key, hid_t type, hid_t space, const void *value)
{
    const hid_t attribute = H5Acreate2(at, key, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool written = attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
    if (attribute >= 0) H5Aclose(attribute);
    return written;
}

/* Text of variable length, since Python reads that as text and not as bytes. */
bool iso_hdf5_write_text(hid_t at, const char *key, const char *value)
{
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    const bool written = write_attribute(at, key, type, space, &value);
    H5Tclose(type);
    H5Sclose(space);
    return written;
}

bool iso_hdf5_write_numbers(hid_t at, const char *key, int count, const double numbers[])
{
    const hsize_t size = (hsize_t)count;
    const hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    const bool written = write_attribute(at, key, H5T_NATIVE_DOUBLE, space, numbers);
    H5Sclose(space);
    return written;
}
