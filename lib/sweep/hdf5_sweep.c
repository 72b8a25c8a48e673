/* hdf5_sweep.c - results of sweeps as HDF5: the layout, and writing.
 *
 *     /              attributes: format, isoroll, hash, points, chunk, vectors, columns, sweep, scene, sum; of a
 * part: part
 *     /vary/NAME     the numbers that vary                       points
 *     /QUANTITY/NAME what was measured                           points
 *     /point         of a part only: the numbers of its points   points of the part
 *     /status        0, or why a point has failed (iso_status)   points
 *     /failed/point, /failed/reason                              points that have failed
 *
 * The bytes of the file depend on nothing but what is in it: datasets have no time stamps, and are written by growing
 * number of the point in blocks of fixed length.
 */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/version.h"
#include "sweep/hdf5_sweep_impl.h"

iso_sweep_hdf5 *iso_sweep_hdf5_create(int columns)
{
    H5dont_atexit();
    iso_sweep_hdf5 *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    f->file = f->status = f->point = f->failed_point = f->failed_reason = f->descriptor = -1;
    f->columns = columns;
    f->set = malloc(((size_t)columns + 1) * sizeof *f->set);
    f->block = malloc(((size_t)columns + 1) * ISO_SWEEP_BLOCK * sizeof *f->block);
    f->block_status = malloc(ISO_SWEEP_BLOCK * sizeof *f->block_status);
    f->block_point = malloc(ISO_SWEEP_BLOCK * sizeof *f->block_point);
    f->failure = malloc(ISO_SWEEP_FAILURES * sizeof *f->failure);
    f->reason = calloc(ISO_SWEEP_FAILURES, sizeof *f->reason);
    for (int i = 0; f->set && i < columns; i++) f->set[i] = -1;
    return f;
}

bool iso_sweep_hdf5_has_room(const iso_sweep_hdf5 *f)
{
    return f->set && f->block && f->block_status && f->block_point && f->failure && f->reason;
}

static bool close_set(hid_t set)
{
    return set < 0 || H5Dclose(set) >= 0;
}

bool iso_sweep_hdf5_free(iso_sweep_hdf5 *f)
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

hid_t iso_sweep_hdf5_reason(void)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, ISO_REASON_SIZE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

/* grows: its length is not known. */
static hid_t create_set(hid_t file, const char *path, hid_t type, hsize_t length, bool grows)
{
    const hsize_t ever = H5S_UNLIMITED, chunk = ISO_SWEEP_FAILURES;
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

static bool create_sets(iso_sweep_hdf5 *f, const iso_sweep_head *head)
{
    const hid_t text = iso_sweep_hdf5_reason();
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

static bool write_head(const iso_sweep_hdf5 *f, const iso_sweep_head *head, iso_sweep_shard share)
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
    good = good && (!head->scene || iso_hdf5_write_text(f->file, "scene", head->scene));
    good = good && (!f->part || iso_hdf5_write_numbers(f->file, "part", 2, part));
    free(columns);
    return good;
}

static iso_status open_target(iso_context *ctx, iso_sweep_hdf5 *f, const char *path)
{
    const iso_status status = iso_replacement_open(ctx, path, true, &f->replacement, &f->descriptor);
    if (status != ISO_OK) return status;
    f->replacement.fresh = true;
    f->name = strdup(f->replacement.target);
    H5E_BEGIN_TRY
    {
        f->file = iso_hdf5_create(f->replacement.temporary);
    }
    H5E_END_TRY
    return f->file >= 0 && f->name ? ISO_OK : iso_hdf5_trouble(ctx, "write", path);
}

static iso_status abandon(iso_context *ctx, iso_sweep_hdf5 *f, iso_status status)
{
    iso_replacement replacement = f->replacement;
    const int descriptor = f->descriptor;
    H5E_BEGIN_TRY
    {
        iso_sweep_hdf5_free(f);
    }
    H5E_END_TRY
    if (descriptor < 0) return status;
    iso_replacement_close(ctx, &replacement, descriptor, false);
    close(descriptor);
    return status;
}

static iso_status hdf5_create(iso_context *ctx, const char *path, const iso_sweep_head *head, iso_sweep_shard share,
                              void **file)
{
    iso_status status = iso_hdf5_load(ctx);
    if (status != ISO_OK) return status;
    iso_sweep_hdf5 *f = iso_sweep_hdf5_create(head->columns);
    if (!f) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write '%s'", path);
    if (!iso_sweep_hdf5_has_room(f))
        return abandon(ctx, f, iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write '%s'", path));
    f->points = iso_sweep_shard_points(head, share);
    f->part = !iso_sweep_shard_is_all(share);
    status = open_target(ctx, f, path);
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
bool iso_sweep_hdf5_move(hid_t set, hid_t type, hsize_t first, hsize_t count, void *data, bool write)
{
    const hid_t there = H5Dget_space(set), here = H5Screate_simple(1, &count, NULL);
    bool good = H5Sselect_hyperslab(there, H5S_SELECT_SET, &first, NULL, &count, NULL) >= 0;
    if (good && write) good = H5Dwrite(set, type, here, there, H5P_DEFAULT, data) >= 0;
    if (good && !write) good = H5Dread(set, type, here, there, H5P_DEFAULT, data) >= 0;
    H5Sclose(here);
    H5Sclose(there);
    return good;
}

static bool flush_failures(iso_sweep_hdf5 *f)
{
    const hsize_t end = f->failures + f->noted;
    if (f->noted == 0) return true;
    const hid_t text = iso_sweep_hdf5_reason();
    const bool good =
        H5Dset_extent(f->failed_point, &end) >= 0 && H5Dset_extent(f->failed_reason, &end) >= 0 &&
        iso_sweep_hdf5_move(f->failed_point, H5T_NATIVE_INT64, f->failures, f->noted, f->failure, true) &&
        iso_sweep_hdf5_move(f->failed_reason, text, f->failures, f->noted, f->reason, true);
    H5Tclose(text);
    f->failures = end;
    f->noted = 0;
    memset(f->reason, 0, ISO_SWEEP_FAILURES * sizeof *f->reason);
    return good;
}

static bool flush_block(iso_sweep_hdf5 *f)
{
    bool good = true;
    const hsize_t count = f->filled;
    if (count == 0) return true;
    for (int c = 0; c < f->columns && good; c++)
        good = iso_sweep_hdf5_move(f->set[c], H5T_NATIVE_DOUBLE, f->done, count,
                                   f->block + (size_t)c * ISO_SWEEP_BLOCK, true);
    good = good && iso_sweep_hdf5_move(f->status, H5T_NATIVE_INT, f->done, count, f->block_status, true);
    if (f->part) good = good && iso_sweep_hdf5_move(f->point, H5T_NATIVE_INT64, f->done, count, f->block_point, true);
    f->done += count;
    f->filled = 0;
    return good;
}

static bool write_row(iso_sweep_hdf5 *f, const iso_sweep_rows *rows, size_t i)
{
    const double *row = rows->number + i * (size_t)rows->columns;
    for (int c = 0; c < f->columns; c++)
        f->block[(size_t)c * ISO_SWEEP_BLOCK + f->filled] = isnan(row[c]) ? (double)NAN : row[c];
    f->block_status[f->filled] = (int)rows->status[i];
    f->block_point[f->filled] = (int64_t)(rows->first + i);
    bool good = ++f->filled < ISO_SWEEP_BLOCK || flush_block(f);
    if (rows->status[i] == ISO_OK) return good;
    f->failure[f->noted] = (int64_t)(rows->first + i);
    snprintf(f->reason[f->noted], ISO_REASON_SIZE, "%s", rows->reason[i]);
    return (++f->noted < ISO_SWEEP_FAILURES || flush_failures(f)) && good;
}

static iso_status hdf5_rows(iso_context *ctx, void *file, const iso_sweep_rows *rows)
{
    iso_sweep_hdf5 *f = file;
    bool good = true;
    H5E_BEGIN_TRY
    {
        for (size_t i = 0; i < rows->count && good; i++) good = write_row(f, rows, i);
    }
    H5E_END_TRY
    return good ? ISO_OK : iso_hdf5_trouble(ctx, "write", f->name);
}

static bool write_sum(const iso_sweep_hdf5 *f, uint64_t sum)
{
    char text[17];
    snprintf(text, sizeof text, "%016" PRIx64, sum);
    return iso_hdf5_write_text(f->file, "sum", text);
}

static iso_status hdf5_close(iso_context *ctx, void *file, const uint64_t *sum)
{
    const bool keep = sum != NULL;
    iso_sweep_hdf5 *f = file;
    iso_replacement replacement = f->replacement;
    const int descriptor = f->descriptor;
    bool good = true, closed;
    H5E_BEGIN_TRY
    {
        if (keep) good = flush_block(f) && flush_failures(f) && write_sum(f, *sum);
        closed = iso_sweep_hdf5_free(f);
    }
    H5E_END_TRY
    iso_status status = ISO_OK;
    if (keep && !(good && closed)) status = iso_hdf5_trouble(ctx, "write", replacement.target);
    const iso_status renamed = iso_replacement_close(ctx, &replacement, descriptor, keep && status == ISO_OK);
    close(descriptor);
    return status == ISO_OK ? renamed : status;
}

const iso_sweep_writing iso_sweep_hdf5_writing = {hdf5_create, hdf5_rows, hdf5_close};
