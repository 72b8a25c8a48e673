/* hdf5.c - what the reader and the writer of tables as HDF5 share. */
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
    s->file = s->failed.point = s->failed.reason = -1;
    s->descriptor = -1;
    return s;
}

bool iso_hdf5_is_sweep(const char *kind)
{
    return strcmp(kind, "sweep") == 0 || strcmp(kind, "sweep part") == 0;
}

bool iso_hdf5_store_add(iso_hdf5_store *s, iso_hdf5_set set)
{
    iso_hdf5_set *more = set.id < 0 ? NULL : realloc(s->set, ((size_t)s->sets + 1) * sizeof *more);
    if (more) {
        s->set = more;
        s->set[s->sets++] = set;
    } else if (set.id >= 0) {
        H5Dclose(set.id);
    }
    return more != NULL;
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
    if (s->failed.point >= 0) good = H5Dclose(s->failed.point) >= 0 && good;
    if (s->failed.reason >= 0) good = H5Dclose(s->failed.reason) >= 0 && good;
    free(s->set);
    if (s->file >= 0) good = H5Fclose(s->file) >= 0 && good;
    free(s->block);
    free(s->packed);
    free(s);
    return good;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

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

/* Rows `first` to `first` + `rows` of a dataset, which a writer lets grow. */
static bool move(const iso_hdf5_set *d, hid_t type, hsize_t first, hsize_t rows, void *data, bool write)
{
    const hsize_t start[2] = {first, 0}, size[2] = {rows, (hsize_t)d->count}, end[2] = {first + rows, size[1]};
    if (write && d->grows && H5Dset_extent(d->id, end) < 0) return false;
    const hid_t there = H5Dget_space(d->id), here = H5Screate_simple(d->count > 1 ? 2 : 1, size, NULL);
    bool good = H5Sselect_hyperslab(there, H5S_SELECT_SET, start, NULL, size, NULL) >= 0;
    if (good && write) good = H5Dwrite(d->id, type, here, there, H5P_DEFAULT, data) >= 0;
    if (good && !write) good = H5Dread(d->id, type, here, there, H5P_DEFAULT, data) >= 0;
    H5Sclose(here);
    H5Sclose(there);
    return good;
}

static bool move_numbers(const iso_hdf5_store *s, const iso_hdf5_set *d, hsize_t first, bool write)
{
    const size_t width = (size_t)d->count, bytes = width * sizeof *s->packed;
    double *const column = s->block + d->first;
    for (size_t row = 0; write && row < s->filled; row++)
        memcpy(s->packed + row * width, column + row * s->columns, bytes);
    if (!move(d, H5T_NATIVE_DOUBLE, first, s->filled, s->packed, write)) return false;
    for (size_t row = 0; !write && row < s->filled; row++)
        memcpy(column + row * s->columns, s->packed + row * width, bytes);
    return true;
}

/* --- words ------------------------------------------------------------------------------------------------------ */

/* Words of one column: texts of variable length, or of the length that the dataset has. */
static bool move_texts(const iso_hdf5_store *s, const iso_hdf5_set *d, hsize_t first, size_t count,
                       double *const number[], bool write)
{
    const hid_t type = H5Dget_type(d->id);
    const bool varies = H5Tis_variable_str(type) > 0;
    const size_t size = varies ? sizeof(char *) : H5Tget_size(type);
    char *text = calloc(count + 1, size), **texts = (char **)(void *)text;
    bool good = text && (varies || size > 0);
    for (size_t i = 0; good && write && i < count; i++) {
        const char *word = iso_record_word(s->words, *number[i]);
        if (varies)
            memcpy(&texts[i], &word, sizeof word);
        else
            snprintf(text + i * size, size, "%s", word);
    }
    good = good && move(d, type, first, count, text, write);
    for (size_t i = 0; good && !write && i < count; i++) {
        if (!varies) text[(i + 1) * size - 1] = '\0';
        const char *word = varies ? texts[i] : text + i * size;
        good = iso_record_intern(s->ctx, s->interned, word ? word : "", number[i]) == ISO_OK;
    }
    for (size_t i = 0; text && varies && !write && i < count; i++)
        if (texts[i]) H5free_memory(texts[i]);
    free(text);
    H5Tclose(type);
    return good;
}

static bool move_words(const iso_hdf5_store *s, const iso_hdf5_set *d, hsize_t first, bool write)
{
    double *number[ISO_HDF5_BLOCK];
    for (size_t i = 0; i < s->filled; i++) number[i] = s->block + i * s->columns + d->first;
    return move_texts(s, d, first, s->filled, number, write);
}

/* The reasons of rows of a sweep that have failed. */
static bool move_failures(iso_hdf5_store *s, bool write)
{
    iso_hdf5_failures *f = &s->failed;
    const iso_hdf5_set point = {.id = f->point, .count = 1, .grows = true};
    const iso_hdf5_set reason = {.id = f->reason, .count = 1, .grows = true};
    double *number[ISO_HDF5_BLOCK];
    size_t count = 0;
    for (size_t i = 0; f->reason >= 0 && i < s->filled; i++) {
        double *const row = s->block + i * s->columns;
        if (!write) row[f->reason_column] = 0;
        if (row[f->status_column] == 0) continue;
        s->packed[count] = row[f->point_column];
        number[count++] = &row[f->reason_column];
    }
    if (count == 0) return true;
    const bool good = !write || move(&point, H5T_NATIVE_DOUBLE, f->done, count, s->packed, true);
    f->done += count;
    return good && move_texts(s, &reason, f->done - count, count, number, write);
}

bool iso_hdf5_transfer(iso_hdf5_store *s, hsize_t first, bool write)
{
    bool good = true;
    for (int i = 0; good && i < s->sets && s->filled > 0; i++) {
        const iso_hdf5_set *d = &s->set[i];
        good = d->words ? move_words(s, d, first, write) : move_numbers(s, d, first, write);
    }
    for (size_t i = 0; s->counts && !write && i < s->filled; i++) s->block[i * s->columns] = (double)(first + i);
    return good && move_failures(s, write);
}

/* --- attributes ------------------------------------------------------------------------------------------------- */

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
