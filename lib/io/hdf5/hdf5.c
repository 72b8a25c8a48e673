/* hdf5.c - what the reader and the writer of tables as HDF5 share. */
#include "io/hdf5/hdf5_impl.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "orbit/orbit_impl.h"

int iso_hdf5_part(const char *const names[], size_t count, const char **group, const char **name)
{
    static const struct {
        const char *group, *name;
        int first, count;
    } parts[] = {{"clock", "t", ISO_CLOCK_T, 1},
                 {"clock", "tau", ISO_CLOCK_TAU, 1},
                 {"clock", "s", ISO_CLOCK_S, 1},
                 {"ball", "omega", ISO_COLUMN_BALL, 3},
                 {"ball", "n", ISO_COLUMN_BALL + 3, 3},
                 {"point", "M", ISO_COLUMN_POINT, 3},
                 {"point", "gamma", ISO_COLUMN_POINT + 3, 3}};
    const int at = iso_column_find(names[0]);
    int first = at, columns = 1;
    const char *whole = names[0];
    if (at < 0) return 1;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (parts[i].first <= at && at < parts[i].first + parts[i].count)
            *group = parts[i].group, whole = parts[i].name, first = parts[i].first, columns = parts[i].count;
    if (at >= ISO_COLUMN_EFFECTS) {
        const iso_effect_column *of;
        iso_effect_column_name(at - ISO_COLUMN_EFFECTS, NULL, &of, &first);
        first = at - first;
        *group = "ball", whole = of->name, columns = of->count;
    }
    for (int i = 0; i < columns; i++)
        if (at != first || (size_t)i == count || strcmp(names[i], iso_column_name(first + i)) != 0) return 1;
    *name = whole;
    return columns;
}

iso_status iso_hdf5_trouble(iso_context *ctx, const char *what, const char *name)
{
    static const int reasons[] = {ENOSPC, EDQUOT, EFBIG, EIO, EROFS}; /* other values may be older than the failure */
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++)
        if (errno == reasons[i]) return iso_file_trouble(ctx, what, name);
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot %s '%s': the HDF5 library gives no reason", what,
                            name);
}

iso_hdf5_store *iso_hdf5_store_create(void)
{
    iso_hdf5_store *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    H5dont_atexit(); /* HDF5 would close what it could not close before, as on a full disk, and crash (1.10) */
    s->file = s->failed.reason = -1;
    s->descriptor = -1;
    return s;
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
    if (s->failed.reason >= 0) good = H5Dclose(s->failed.reason) >= 0 && good;
    free(s->set);
    if (s->file >= 0) good = H5Fclose(s->file) >= 0 && good;
    free(s->block);
    free(s->packed);
    free(s);
    return good;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

hid_t iso_hdf5_access(void)
{
    const hid_t plan = H5Pcreate(H5P_DATASET_ACCESS);
    H5Pset_chunk_cache(plan, 1, ISO_HDF5_MOST_CHUNKS, 1);
    return plan;
}

/* Rows `first` to `first` + `rows` of a dataset, which a writer lets grow. */
static bool move(const iso_hdf5_set *d, hid_t type, hid_t how, hsize_t first, hsize_t rows, void *data, bool write)
{
    const hsize_t start[2] = {first, 0}, size[2] = {rows, (hsize_t)d->count}, end[2] = {first + rows, size[1]};
    if (write && d->grows && H5Dset_extent(d->id, end) < 0) return false;
    const hid_t there = H5Dget_space(d->id), here = H5Screate_simple(d->count > 1 ? 2 : 1, size, NULL);
    bool good = H5Sselect_hyperslab(there, H5S_SELECT_SET, start, NULL, size, NULL) >= 0;
    if (good && write) good = H5Dwrite(d->id, type, here, there, how, data) >= 0;
    if (good && !write) good = H5Dread(d->id, type, here, there, how, data) >= 0;
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
    if (!move(d, H5T_NATIVE_DOUBLE, H5P_DEFAULT, first, s->filled, s->packed, write)) return false;
    for (size_t row = 0; !write && row < s->filled; row++)
        memcpy(column + row * s->columns, s->packed + row * width, bytes);
    return true;
}

/* --- words ------------------------------------------------------------------------------------------------------ */

/* Words of one column: texts of variable length, or of the length that the dataset has. */
static bool move_texts(iso_hdf5_store *s, const iso_hdf5_set *d, hsize_t first, size_t count, double *const number[],
                       bool write)
{
    const hid_t type = H5Dget_type(d->id);
    const bool varies = H5Tis_variable_str(type) > 0;
    const size_t size = varies ? sizeof(char *) : H5Tget_size(type);
    size_t left;
    const hid_t how = iso_hdf5_words(&left);
    char *text = calloc(count + 1, size), **texts = (char **)(void *)text;
    bool good = text && (varies || size > 0);
    for (size_t i = 0; good && write && i < count; i++) {
        const char *word = iso_record_word(s->words, *number[i]);
        if (varies)
            memcpy(&texts[i], &word, sizeof word);
        else
            snprintf(text + i * size, size, "%s", word);
    }
    good = good && move(d, type, how, first, count, text, write);
    s->wordy = s->wordy || left == 0;
    for (size_t i = 0; good && !write && i < count; i++) {
        if (!varies) text[(i + 1) * size - 1] = '\0';
        const char *word = varies ? texts[i] : text + i * size;
        good = iso_record_intern(s->ctx, s->interned, word ? word : "", number[i]) == ISO_OK;
    }
    for (size_t i = 0; text && varies && !write && i < count; i++) free(texts[i]);
    free(text);
    H5Pclose(how);
    H5Tclose(type);
    return good;
}

static bool move_words(iso_hdf5_store *s, const iso_hdf5_set *d, hsize_t first, bool write)
{
    double *number[ISO_HDF5_BLOCK];
    for (size_t i = 0; i < s->filled; i++) number[i] = s->block + i * s->columns + d->first;
    return move_texts(s, d, first, s->filled, number, write);
}

/* The reasons of rows of a sweep that have failed. */
static bool read_failures(iso_hdf5_store *s)
{
    iso_hdf5_failures *f = &s->failed;
    const iso_hdf5_set reason = {.id = f->reason, .count = 1};
    double *number[ISO_HDF5_BLOCK];
    size_t count = 0;
    for (size_t i = 0; f->reason >= 0 && i < s->filled; i++) {
        double *const row = s->block + i * s->columns;
        row[f->reason_column] = 0;
        if (row[f->status_column] != 0) number[count++] = &row[f->reason_column];
    }
    if (count == 0) return true;
    f->done += count;
    return move_texts(s, &reason, f->done - count, count, number, false);
}

bool iso_hdf5_transfer(iso_hdf5_store *s, hsize_t first, bool write)
{
    bool good = true;
    for (int i = 0; good && i < s->sets && s->filled > 0; i++) {
        const iso_hdf5_set *d = &s->set[i];
        good = d->words ? move_words(s, d, first, write) : move_numbers(s, d, first, write);
    }
    for (size_t i = 0; s->counts && !write && i < s->filled; i++) s->block[i * s->columns] = (double)(first + i);
    return good && (write || read_failures(s));
}
