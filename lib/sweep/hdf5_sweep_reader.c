/* hdf5_sweep_reader.c - reads results of sweeps from HDF5. hdf5_sweep.c tells the layout. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sweep/hdf5_sweep_impl.h"

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
        b->share = (iso_sweep_shard){(size_t)part[0] - 1, (size_t)part[1]};
        snprintf(b->head.vectors, sizeof b->head.vectors, "%s", vectors);
        b->column = iso_sweep_columns_scan(columns, &b->head.columns);
        b->text = read_text(file, "sweep");
        b->scene = read_text(file, "scene"); /* not there if it is in the sweep's text */
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

static bool open_sets(iso_sweep_hdf5 *f, const iso_sweep_begin *b)
{
    bool good = true;
    f->points = iso_sweep_shard_points(&b->head, b->share);
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

static bool open_file(iso_sweep_begin *begin, const char *path, iso_sweep_hdf5 **file)
{
    bool good = false;
    const hid_t id = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (id < 0) return false;
    if (!read_head(id, begin) || begin->share.index >= begin->share.count) return H5Fclose(id), false;
    iso_sweep_hdf5 *f = iso_sweep_hdf5_create(begin->head.columns);
    if (!f) return H5Fclose(id), false;
    f->file = id;
    good = iso_sweep_hdf5_has_room(f) && open_sets(f, begin) && (f->name = strdup(path)) != NULL;
    if (good)
        *file = f;
    else
        iso_sweep_hdf5_free(f);
    return good;
}

static iso_status hdf5_open(iso_context *ctx, const char *path, iso_sweep_begin *begin, void **file)
{
    iso_sweep_hdf5 *f = NULL;
    bool good;
    const iso_status status = iso_hdf5_load(ctx);
    *file = NULL;
    if (status != ISO_OK) return status;
    H5E_BEGIN_TRY
    {
        good = open_file(begin, path, &f);
    }
    H5E_END_TRY
    *file = f;
    return good ? ISO_OK : iso_sweep_damaged(ctx, path, "it is no result of a sweep");
}

/* The next block of rows. The first `filled` rows of it have been given away. */
static bool fill_block(iso_sweep_hdf5 *f)
{
    const hsize_t left = f->points - f->done, count = left < ISO_SWEEP_BLOCK ? left : ISO_SWEEP_BLOCK;
    bool good = true;
    for (int c = 0; c < f->columns && good; c++)
        good = iso_sweep_hdf5_move(f->set[c], H5T_NATIVE_DOUBLE, f->done, count,
                                   f->block + (size_t)c * ISO_SWEEP_BLOCK, false);
    f->filled = 0;
    return good && iso_sweep_hdf5_move(f->status, H5T_NATIVE_INT, f->done, count, f->block_status, false);
}

static bool next_reason(iso_sweep_hdf5 *f, char reason[ISO_REASON_SIZE])
{
    const hid_t text = iso_sweep_hdf5_reason();
    const bool good =
        f->noted < f->failures && iso_sweep_hdf5_move(f->failed_reason, text, f->noted, 1, reason, false);
    H5Tclose(text);
    reason[ISO_REASON_SIZE - 1] = '\0';
    f->noted++;
    return good;
}

static bool read_row(iso_sweep_hdf5 *f, iso_sweep_rows *rows, size_t i)
{
    if (f->done % ISO_SWEEP_BLOCK == 0 && !fill_block(f)) return false;
    const size_t at = f->filled++;
    for (int c = 0; c < f->columns; c++)
        rows->number[i * (size_t)rows->columns + (size_t)c] = f->block[(size_t)c * ISO_SWEEP_BLOCK + at];
    rows->status[i] = (iso_status)f->block_status[at];
    rows->reason[i][0] = '\0';
    f->done++;
    return rows->status[i] == ISO_OK || next_reason(f, rows->reason[i]);
}

static iso_status hdf5_next(iso_context *ctx, void *file, size_t count, iso_sweep_rows *rows)
{
    iso_sweep_hdf5 *f = file;
    bool good = true;
    H5E_BEGIN_TRY
    {
        for (size_t i = 0; i < count && good; i++) good = read_row(f, rows, i);
    }
    H5E_END_TRY
    return good ? ISO_OK : iso_sweep_damaged(ctx, f->name, "a row is missing or damaged");
}

static bool hdf5_sum(void *file, uint64_t *sum)
{
    const iso_sweep_hdf5 *f = file;
    char *text = NULL;
    H5E_BEGIN_TRY
    {
        text = read_text(f->file, "sum");
    }
    H5E_END_TRY
    const bool good = text && strlen(text) == 16 && sscanf(text, "%16" SCNx64, sum) == 1;
    free(text);
    return good;
}

static void hdf5_end(void *file)
{
    H5E_BEGIN_TRY
    {
        iso_sweep_hdf5_free(file);
    }
    H5E_END_TRY
}

const iso_sweep_reading iso_sweep_hdf5_reading = {hdf5_open, hdf5_next, hdf5_sum, hdf5_end};
