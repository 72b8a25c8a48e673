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
    s->file = -1;
    ISO_HDF5_QUIETLY(iso_hdf5_guard(s));
    s->text = H5Tcopy(H5T_C_S1);
    H5Tset_size(s->text, H5T_VARIABLE);
    H5Tset_cset(s->text, H5T_CSET_UTF8);
    return s;
}

bool iso_hdf5_store_add(iso_hdf5_store *s, iso_hdf5_set set)
{
    iso_hdf5_set *more = set.id < 0 ? NULL : realloc(s->set, ((size_t)s->sets + 1) * sizeof *more);
    if (!more && set.id >= 0) H5Dclose(set.id);
    if (!more) return false;
    s->set = more;
    s->set[s->sets++] = set;
    return true;
}

bool iso_hdf5_store_free(iso_hdf5_store *s)
{
    bool good = true;
    for (int i = 0; i < s->sets; i++) good = H5Dclose(s->set[i].id) >= 0 && good;
    if (s->file >= 0) good = H5Fclose(s->file) >= 0 && good;
    H5Pclose(s->access);
    H5Pclose(s->transfer);
    H5Tclose(s->text);
    free(s->names);
    free(s->set);
    free(s->block);
    free(s);
    return good;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

double *iso_hdf5_cells(const iso_hdf5_store *s, const iso_hdf5_set *d, size_t row)
{
    return s->block + (size_t)d->first * ISO_HDF5_BLOCK + row * (size_t)d->count;
}

/* Rows `first` to `first` + `rows` of a dataset. */
static bool move(const iso_hdf5_store *s, const iso_hdf5_set *d, hid_t type, hsize_t first, hsize_t rows, void *data,
                 bool write)
{
    const hsize_t start[2] = {first, 0}, size[2] = {rows, (hsize_t)d->count}, end[2] = {first + rows, size[1]};
    bool good = !write || !s->grows || H5Dset_extent(d->id, end) >= 0;
    const hid_t there = H5Dget_space(d->id), here = H5Screate_simple(d->count > 1 ? 2 : 1, size, NULL);
    good = good && H5Sselect_hyperslab(there, H5S_SELECT_SET, start, NULL, size, NULL) >= 0;
    if (good && write) good = H5Dwrite(d->id, type, here, there, s->transfer, data) >= 0;
    if (good && !write) good = H5Dread(d->id, type, here, there, s->transfer, data) >= 0;
    H5Sclose(here);
    H5Sclose(there);
    return good;
}

/* Words of one column: texts of variable length, or, in files of others, of the length that the dataset has. The
 * reasons of an older sweep stand one after the other, those of failed rows only. */
static bool move_words(iso_hdf5_store *s, iso_hdf5_set *d, hsize_t first, bool write)
{
    double *number[ISO_HDF5_BLOCK];
    size_t count = 0;
    for (size_t i = 0; i < s->filled; i++) {
        double *const cell = iso_hdf5_cells(s, d, i);
        if (d->failed) *cell = 0;
        if (!d->failed || s->block[(size_t)d->failed * ISO_HDF5_BLOCK + i] != 0) number[count++] = cell;
    }
    if (count == 0) return true;
    if (d->failed) first = d->done;
    d->done += count;

    const hid_t type = H5Dget_type(d->id);
    const bool varies = H5Tis_variable_str(type) > 0;
    const size_t size = varies ? sizeof(char *) : H5Tget_size(type);
    char *text = calloc(count, size), **texts = (char **)(void *)text;
    bool good = text && size > 0;
    for (size_t i = 0; good && write && i < count; i++) {
        const char *word = iso_record_word(s->words, *number[i]);
        memcpy(&texts[i], &word, sizeof word);
    }
    s->word_room = ISO_HDF5_WORDS;
    good = good && move(s, d, type, first, count, text, write);
    for (size_t i = 0; good && !write && i < count; i++) {
        if (!varies) text[(i + 1) * size - 1] = '\0';
        const char *word = varies ? texts[i] : text + i * size;
        good = iso_record_intern(s->ctx, s->header, word ? word : "", number[i]) == ISO_OK;
    }
    for (size_t i = 0; text && varies && !write && i < count; i++) free(texts[i]);
    free(text);
    H5Tclose(type);
    return good;
}

bool iso_hdf5_transfer(iso_hdf5_store *s, hsize_t first, bool write)
{
    bool good = true;
    for (int i = 0; good && i < s->sets && s->filled > 0; i++) {
        iso_hdf5_set *d = &s->set[i];
        good = d->words ? move_words(s, d, first, write)
                        : move(s, d, H5T_NATIVE_DOUBLE, first, s->filled, iso_hdf5_cells(s, d, 0), write);
    }
    return good;
}
