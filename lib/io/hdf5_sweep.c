/* hdf5_sweep.c - results of sweeps as HDF5.
 *
 *     /              attributes: format, isoroll, hash, points, chunk, vectors, columns, sweep; of a part: part
 *     /vary/NAME     the numbers that vary                       points
 *     /QUANTITY/NAME what was measured                           points
 *     /point         of a part only: the numbers of its points   points of the part
 *     /status        0, or why a point has failed (iso_status)   points
 *     /failed/point, /failed/reason                              points that have failed
 *
 * The bytes of the file depend on nothing but what is in it: datasets have no time stamps, and are written by growing
 * number of the point in blocks of fixed length.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/version.h"
#include "io/hdf5_impl.h"
#include "io/sweep_store_impl.h"

enum { BLOCK = ISO_HDF5_BLOCK, FAILURES = 1024 };

typedef struct sweep_file {
    hid_t file, *set, status, point, failed_point, failed_reason;
    int columns;
    hsize_t done, points; /* rows in the file so far; all */
    size_t filled;        /* rows of the block */
    double *block;        /* column after column: BLOCK numbers each */
    int *block_status;
    int64_t *block_point;
    hsize_t failures; /* in the file so far, or all of a file that is read */
    size_t noted;     /* failures that wait, or the one that is read next  */
    int64_t *failure;
    char (*reason)[ISO_REASON_SIZE];
    bool part;
    iso_replacement replacement;
    int descriptor;
    char *name;
} sweep_file;

static sweep_file *create_file(int columns)
{
    H5dont_atexit();
    sweep_file *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    f->file = f->status = f->point = f->failed_point = f->failed_reason = f->descriptor = -1;
    f->columns = columns;
    f->set = malloc(((size_t)columns + 1) * sizeof *f->set);
    f->block = malloc(((size_t)columns + 1) * BLOCK * sizeof *f->block);
    f->block_status = malloc(BLOCK * sizeof *f->block_status);
    f->block_point = malloc(BLOCK * sizeof *f->block_point);
    f->failure = malloc(FAILURES * sizeof *f->failure);
    f->reason = calloc(FAILURES, sizeof *f->reason);
    for (int i = 0; f->set && i < columns; i++) f->set[i] = -1;
    return f;
}

static bool has_room(const sweep_file *f)
{
    return f->set && f->block && f->block_status && f->block_point && f->failure && f->reason;
}

static bool close_set(hid_t set)
{
    return set < 0 || H5Dclose(set) >= 0;
}

static bool release(sweep_file *f)
{
    bool good = close_set(f->status);
    good = close_set(f->point) && good;
    good = close_set(f->failed_point) && good;
    good = close_set(f->failed_reason) && good;
    for (int i = 0; f->set && i < f->columns; i++) good = close_set(f->set[i]) && good;
    if (f->file >= 0) good = H5Fclose(f->file) >= 0 && good;
    free(f->set);
    free(f->block);
    free(f->block_status);
    free(f->block_point);
    free(f->failure);
    free(f->reason);
    free(f->name);
    free(f);
    return good;
}

/* --- writing ---------------------------------------------------------------------------------------------------- */

static hid_t reason_type(void)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, ISO_REASON_SIZE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

/* grows: its length is not known. */
static hid_t create_set(hid_t file, const char *path, hid_t type, hsize_t length, bool grows)
{
    const hsize_t ever = H5S_UNLIMITED, chunk = FAILURES;
    const hid_t space = H5Screate_simple(1, &length, grows ? &ever : NULL), plan = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t link = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_obj_track_times(plan, 0);
    H5Pset_fill_time(plan, grows ? H5D_FILL_TIME_ALLOC : H5D_FILL_TIME_NEVER);
    if (grows)
        H5Pset_chunk(plan, 1, &chunk);
    else
        H5Pset_alloc_time(plan, H5D_ALLOC_TIME_EARLY);
    H5Pset_create_intermediate_group(link, 1);
    const hid_t set = H5Dcreate2(file, path, type, space, link, plan, H5P_DEFAULT);
    H5Pclose(link);
    H5Pclose(plan);
    H5Sclose(space);
    return set;
}

static bool create_sets(sweep_file *f, const iso_sweep_head *head)
{
    const hid_t text = reason_type();
    bool good = true;
    for (int i = 0; i < f->columns && good; i++) {
        char path[3 * ISO_NAME_SIZE];
        snprintf(path, sizeof path, "/%s/%s", head->column[i].group, head->column[i].name);
        good = (f->set[i] = create_set(f->file, path, H5T_NATIVE_DOUBLE, f->points, false)) >= 0;
    }
    if (good) good = (f->status = create_set(f->file, "/status", H5T_NATIVE_INT, f->points, false)) >= 0;
    if (good && f->part) good = (f->point = create_set(f->file, "/point", H5T_NATIVE_INT64, f->points, false)) >= 0;
    if (good) good = (f->failed_point = create_set(f->file, "/failed/point", H5T_NATIVE_INT64, 0, true)) >= 0;
    if (good) good = (f->failed_reason = create_set(f->file, "/failed/reason", text, 0, true)) >= 0;
    H5Tclose(text);
    return good;
}

static bool write_head(const sweep_file *f, const iso_sweep_head *head, iso_sweep_share share)
{
    char hash[ISO_HASH_SIZE], *columns = iso_sweep_columns_print(head);
    const double part[2] = {(double)share.index + 1, (double)share.count},
                 sizes[] = {(double)head->count, (double)head->chunk};
    iso_sweep_hash_print(hash, head->hash);
    bool good = columns && iso_hdf5_write_text(f->file, "format", f->part ? ISO_SWEEP_PART_FORMAT : ISO_SWEEP_FORMAT);
    good = good && iso_hdf5_write_text(f->file, "isoroll", ISO_VERSION);
    good = good && iso_hdf5_write_text(f->file, "hash", hash);
    good = good && iso_hdf5_write_numbers(f->file, "points", 1, &sizes[0]);
    good = good && iso_hdf5_write_numbers(f->file, "chunk", 1, &sizes[1]);
    good = good && iso_hdf5_write_text(f->file, "vectors", head->vectors);
    good = good && iso_hdf5_write_text(f->file, "columns", columns);
    good = good && iso_hdf5_write_text(f->file, "sweep", head->text);
    good = good && (!f->part || iso_hdf5_write_numbers(f->file, "part", 2, part));
    free(columns);
    return good;
}

static iso_status open_target(iso_context *ctx, sweep_file *f, const char *path)
{
    const iso_status status = iso_replacement_open(ctx, path, &f->replacement, &f->descriptor);
    if (status != ISO_OK) return status;
    f->name = strdup(f->replacement.target);
    H5E_BEGIN_TRY
    {
        f->file = H5Fcreate(f->replacement.temporary, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    }
    H5E_END_TRY
    return f->file >= 0 && f->name ? ISO_OK : iso_hdf5_trouble(ctx, "write", path);
}

static iso_status abandon(iso_context *ctx, sweep_file *f, iso_status status)
{
    iso_replacement replacement = f->replacement;
    const int descriptor = f->descriptor;
    H5E_BEGIN_TRY
    {
        release(f);
    }
    H5E_END_TRY
    if (descriptor < 0) return status;
    iso_replacement_close(ctx, &replacement, descriptor, false);
    close(descriptor);
    return status;
}

static iso_status hdf5_create(iso_context *ctx, const char *path, const iso_sweep_head *head, iso_sweep_share share,
                              void **file)
{
    sweep_file *f = create_file(head->columns);
    if (!f) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write '%s'", path);
    if (!has_room(f))
        return abandon(ctx, f, iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write '%s'", path));
    f->points = iso_sweep_share_points(head, share);
    f->part = !iso_sweep_share_is_all(share);
    const iso_status status = open_target(ctx, f, path);
    if (status != ISO_OK) return abandon(ctx, f, status);
    bool good;
    H5E_BEGIN_TRY
    {
        good = create_sets(f, head) && write_head(f, head, share);
    }
    H5E_END_TRY
    if (!good) return abandon(ctx, f, iso_hdf5_trouble(ctx, "write", path));
    *file = f;
    return ISO_OK;
}

/* `count` elements at `first`. */
static bool move_set(hid_t set, hid_t type, hsize_t first, hsize_t count, void *data, bool write)
{
    const hid_t there = H5Dget_space(set), here = H5Screate_simple(1, &count, NULL);
    bool good = H5Sselect_hyperslab(there, H5S_SELECT_SET, &first, NULL, &count, NULL) >= 0;
    if (good && write) good = H5Dwrite(set, type, here, there, H5P_DEFAULT, data) >= 0;
    if (good && !write) good = H5Dread(set, type, here, there, H5P_DEFAULT, data) >= 0;
    H5Sclose(here);
    H5Sclose(there);
    return good;
}

static bool flush_failures(sweep_file *f)
{
    const hsize_t end = f->failures + f->noted;
    if (f->noted == 0) return true;
    const hid_t text = reason_type();
    const bool good = H5Dset_extent(f->failed_point, &end) >= 0 && H5Dset_extent(f->failed_reason, &end) >= 0 &&
                      move_set(f->failed_point, H5T_NATIVE_INT64, f->failures, f->noted, f->failure, true) &&
                      move_set(f->failed_reason, text, f->failures, f->noted, f->reason, true);
    H5Tclose(text);
    f->failures = end;
    f->noted = 0;
    memset(f->reason, 0, FAILURES * sizeof *f->reason);
    return good;
}

static bool flush_block(sweep_file *f)
{
    bool good = true;
    const hsize_t count = f->filled;
    if (count == 0) return true;
    for (int c = 0; c < f->columns && good; c++)
        good = move_set(f->set[c], H5T_NATIVE_DOUBLE, f->done, count, f->block + (size_t)c * BLOCK, true);
    good = good && move_set(f->status, H5T_NATIVE_INT, f->done, count, f->block_status, true);
    if (f->part) good = good && move_set(f->point, H5T_NATIVE_INT64, f->done, count, f->block_point, true);
    f->done += count;
    f->filled = 0;
    return good;
}

static bool write_row(sweep_file *f, const iso_sweep_rows *rows, size_t i)
{
    const double *row = rows->number + i * (size_t)rows->columns;
    for (int c = 0; c < f->columns; c++)
        f->block[(size_t)c * BLOCK + f->filled] = isnan(row[c]) ? (double)NAN : row[c];
    f->block_status[f->filled] = (int)rows->status[i];
    f->block_point[f->filled] = (int64_t)(rows->first + i);
    bool good = ++f->filled < BLOCK || flush_block(f);
    if (rows->status[i] == ISO_OK) return good;
    f->failure[f->noted] = (int64_t)(rows->first + i);
    snprintf(f->reason[f->noted], ISO_REASON_SIZE, "%s", rows->reason[i]);
    return (++f->noted < FAILURES || flush_failures(f)) && good;
}

static iso_status hdf5_rows(iso_context *ctx, void *file, const iso_sweep_rows *rows)
{
    sweep_file *f = file;
    bool good = true;
    H5E_BEGIN_TRY
    {
        for (size_t i = 0; i < rows->count && good; i++) good = write_row(f, rows, i);
    }
    H5E_END_TRY
    return good ? ISO_OK : iso_hdf5_trouble(ctx, "write", f->name);
}

static iso_status hdf5_close(iso_context *ctx, void *file, bool keep)
{
    sweep_file *f = file;
    iso_replacement replacement = f->replacement;
    const int descriptor = f->descriptor;
    bool good = true, closed;
    H5E_BEGIN_TRY
    {
        if (keep) good = flush_block(f) && flush_failures(f);
        closed = release(f);
    }
    H5E_END_TRY
    iso_status status = ISO_OK;
    if (keep && !(good && closed)) status = iso_hdf5_trouble(ctx, "write", replacement.target);
    const iso_status renamed = iso_replacement_close(ctx, &replacement, descriptor, keep && status == ISO_OK);
    close(descriptor);
    return status == ISO_OK ? renamed : status;
}

const iso_sweep_writing iso_sweep_hdf5_writing = {hdf5_create, hdf5_rows, hdf5_close};

/* --- reading ---------------------------------------------------------------------------------------------------- */

/* The text of an attribute, to be freed by the caller; NULL: there is none. */
static char *read_text(hid_t file, const char *key)
{
    char *text = NULL, *copy;
    const hid_t at = H5Aopen(file, key, H5P_DEFAULT);
    if (at < 0) return NULL;
    const hid_t type = H5Aget_type(at), memory = H5Tcopy(H5T_C_S1);
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5T_CSET_UTF8);
    if (H5Tis_variable_str(type) <= 0 || H5Aread(at, memory, &text) < 0) text = NULL;
    copy = text ? strdup(text) : NULL;
    if (text) H5free_memory(text);
    H5Tclose(memory);
    H5Tclose(type);
    H5Aclose(at);
    return copy;
}

static bool read_numbers(hid_t file, const char *key, int count, double numbers[])
{
    const hid_t at = H5Aopen(file, key, H5P_DEFAULT);
    if (at < 0) return false;
    const hid_t space = H5Aget_space(at);
    const bool good = H5Sget_simple_extent_npoints(space) == count && H5Aread(at, H5T_NATIVE_DOUBLE, numbers) >= 0;
    H5Sclose(space);
    H5Aclose(at);
    return good;
}

/* A number of points, or of parts. */
static bool is_size(double x)
{
    return x >= 1 && x <= 0x1p53;
}

static bool read_head(hid_t file, iso_sweep_begin *b)
{
    double points = 0, chunk = 0, part[2] = {1, 1};
    char *format = read_text(file, "format"), *hash = read_text(file, "hash"), *vectors = read_text(file, "vectors"),
         *columns = read_text(file, "columns");
    const bool is_part = format && strcmp(format, ISO_SWEEP_PART_FORMAT) == 0;
    bool good = format && hash && vectors && columns && (is_part || strcmp(format, ISO_SWEEP_FORMAT) == 0);
    good = good && iso_sweep_hash_scan(hash, b->head.hash) && read_numbers(file, "points", 1, &points) &&
           read_numbers(file, "chunk", 1, &chunk) && (!is_part || read_numbers(file, "part", 2, part)) &&
           is_size(points) && is_size(chunk) && is_size(part[0]) && is_size(part[1]);
    if (good) {
        b->head.count = (size_t)points;
        b->head.chunk = (size_t)chunk;
        b->share = (iso_sweep_share){(size_t)part[0] - 1, (size_t)part[1]};
        snprintf(b->head.vectors, sizeof b->head.vectors, "%s", vectors);
        b->column = iso_sweep_columns_scan(columns, &b->head.columns);
        b->text = read_text(file, "sweep");
        good = b->column && b->text;
    }
    free(format);
    free(hash);
    free(vectors);
    free(columns);
    return good;
}

static bool has_length(hid_t set, hsize_t length)
{
    if (set < 0) return false;
    const hid_t space = H5Dget_space(set);
    const bool good = H5Sget_simple_extent_npoints(space) == (hssize_t)length;
    H5Sclose(space);
    return good;
}

static bool open_sets(sweep_file *f, const iso_sweep_begin *b)
{
    bool good = true;
    f->points = iso_sweep_share_points(&b->head, b->share);
    for (int i = 0; i < f->columns && good; i++) {
        char path[3 * ISO_NAME_SIZE];
        snprintf(path, sizeof path, "/%s/%s", b->column[i].group, b->column[i].name);
        good = has_length(f->set[i] = H5Dopen2(f->file, path, H5P_DEFAULT), f->points);
    }
    good = good && has_length(f->status = H5Dopen2(f->file, "/status", H5P_DEFAULT), f->points);
    f->failed_reason = H5Dopen2(f->file, "/failed/reason", H5P_DEFAULT);
    if (!good || f->failed_reason < 0) return false;
    const hid_t space = H5Dget_space(f->failed_reason);
    f->failures = (hsize_t)H5Sget_simple_extent_npoints(space);
    H5Sclose(space);
    return true;
}

static bool open_file(iso_sweep_begin *begin, const char *path, sweep_file **file)
{
    bool good = false;
    const hid_t id = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (id < 0) return false;
    if (!read_head(id, begin) || begin->share.index >= begin->share.count) return H5Fclose(id), false;
    sweep_file *f = create_file(begin->head.columns);
    if (!f) return H5Fclose(id), false;
    f->file = id;
    good = has_room(f) && open_sets(f, begin) && (f->name = strdup(path)) != NULL;
    if (good)
        *file = f;
    else
        release(f);
    return good;
}

static iso_status hdf5_open(iso_context *ctx, const char *path, iso_sweep_begin *begin, void **file)
{
    sweep_file *f = NULL;
    bool good;
    H5E_BEGIN_TRY
    {
        good = open_file(begin, path, &f);
    }
    H5E_END_TRY
    *file = f;
    return good ? ISO_OK : iso_sweep_damaged(ctx, path, "it is no result of a sweep");
}

/* The next block of rows. The first `filled` rows of it have been given away. */
static bool fill_block(sweep_file *f)
{
    const hsize_t left = f->points - f->done, count = left < BLOCK ? left : BLOCK;
    bool good = true;
    for (int c = 0; c < f->columns && good; c++)
        good = move_set(f->set[c], H5T_NATIVE_DOUBLE, f->done, count, f->block + (size_t)c * BLOCK, false);
    f->filled = 0;
    return good && move_set(f->status, H5T_NATIVE_INT, f->done, count, f->block_status, false);
}

static bool next_reason(sweep_file *f, char reason[ISO_REASON_SIZE])
{
    const hid_t text = reason_type();
    const bool good = f->noted < f->failures && move_set(f->failed_reason, text, f->noted, 1, reason, false);
    H5Tclose(text);
    reason[ISO_REASON_SIZE - 1] = '\0';
    f->noted++;
    return good;
}

static bool read_row(sweep_file *f, iso_sweep_rows *rows, size_t i)
{
    if (f->done % BLOCK == 0 && !fill_block(f)) return false;
    const size_t at = f->filled++;
    for (int c = 0; c < f->columns; c++)
        rows->number[i * (size_t)rows->columns + (size_t)c] = f->block[(size_t)c * BLOCK + at];
    rows->status[i] = (iso_status)f->block_status[at];
    rows->reason[i][0] = '\0';
    f->done++;
    return rows->status[i] == ISO_OK || next_reason(f, rows->reason[i]);
}

static iso_status hdf5_next(iso_context *ctx, void *file, size_t count, iso_sweep_rows *rows)
{
    sweep_file *f = file;
    bool good = true;
    H5E_BEGIN_TRY
    {
        for (size_t i = 0; i < count && good; i++) good = read_row(f, rows, i);
    }
    H5E_END_TRY
    return good ? ISO_OK : iso_sweep_damaged(ctx, f->name, "a row is missing or damaged");
}

static void hdf5_end(void *file)
{
    H5E_BEGIN_TRY
    {
        release(file);
    }
    H5E_END_TRY
}

const iso_sweep_reading iso_sweep_hdf5_reading = {hdf5_open, hdf5_next, hdf5_end};
