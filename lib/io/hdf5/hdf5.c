/* hdf5.c - what the reader and the writer of tables as HDF5 share; and the HDF5 library, loaded when it is first needed
 * (hdf5_impl.h). */
#include "io/hdf5/hdf5_impl.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
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
        h5.Dclose(set.id);
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
    for (int i = 0; i < s->sets; i++) good = h5.Dclose(s->set[i].id) >= 0 && good;
    if (s->failed.point >= 0) good = h5.Dclose(s->failed.point) >= 0 && good;
    if (s->failed.reason >= 0) good = h5.Dclose(s->failed.reason) >= 0 && good;
    free(s->set);
    if (s->file >= 0) good = h5.Fclose(s->file) >= 0 && good;
    free(s->block);
    free(s->packed);
    free(s);
    return good;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

hid_t iso_hdf5_access(void)
{
    const hid_t plan = h5.Pcreate(H5P_DATASET_ACCESS);
    h5.Pset_chunk_cache(plan, 1, 4 * ISO_HDF5_BLOCK * sizeof(double), 1);
    return plan;
}

/* Rows `first` to `first` + `rows` of a dataset, which a writer lets grow. */
static bool move(const iso_hdf5_set *d, hid_t type, hsize_t first, hsize_t rows, void *data, bool write)
{
    const hsize_t start[2] = {first, 0}, size[2] = {rows, (hsize_t)d->count}, end[2] = {first + rows, size[1]};
    if (write && d->grows && h5.Dset_extent(d->id, end) < 0) return false;
    const hid_t there = h5.Dget_space(d->id), here = h5.Screate_simple(d->count > 1 ? 2 : 1, size, NULL);
    bool good = h5.Sselect_hyperslab(there, H5S_SELECT_SET, start, NULL, size, NULL) >= 0;
    if (good && write) good = h5.Dwrite(d->id, type, here, there, H5P_DEFAULT, data) >= 0;
    if (good && !write) good = h5.Dread(d->id, type, here, there, H5P_DEFAULT, data) >= 0;
    h5.Sclose(here);
    h5.Sclose(there);
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
    const hid_t type = h5.Dget_type(d->id);
    const bool varies = h5.Tis_variable_str(type) > 0;
    const size_t size = varies ? sizeof(char *) : h5.Tget_size(type);
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
        if (texts[i]) h5.free_memory(texts[i]);
    free(text);
    h5.Tclose(type);
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

/* --- the library ------------------------------------------------------------------------------------------------ */

iso_hdf5_library h5;

static char trouble[512]; /* "": the table is full */

/* Finds the address of a function or a variable of the library. */
static void find(void *library, const char *name, void *pointer)
{
    void *const address = library ? dlsym(library, name) : NULL;
    memcpy(pointer, &address, sizeof address);
    if (address || *trouble) return;
    const char *why = dlerror();
    strncat(trouble, why ? why : name, sizeof trouble - 1);
}

static void load(void)
{
    const char *wanted = getenv("ISOROLL_HDF5"); /* counts only if it is not empty */
    const char *name = wanted && *wanted ? wanted : ISO_HDF5_SONAME;
    void *const library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
#define FIND(name) find(library, "H5" #name, &h5.name);
    ISO_HDF5_NAMES(FIND)
    if (*trouble) return;
    h5.dont_atexit(); /* it would close what it could not close before, as on a full disk, and crash (1.10) */
    h5.open();
}

iso_status iso_hdf5_load(iso_context *ctx)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, load);
    if (!*trouble) return ISO_OK;
    return iso_context_fail(
        ctx, ISO_FILE_TROUBLE, "",
        "no HDF5 library, which files in .h5 need: %s. Install HDF5 1.10 or later (for Python: h5py), or set "
        "ISOROLL_HDF5 to the path of its libhdf5",
        trouble);
}
