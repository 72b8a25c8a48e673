/* hdf5_writer.c - tables into HDF5: block by block into a temporary file, which is then renamed. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/field.h"
#include "base/number_impl.h"
#include "io/hdf5/hdf5_impl.h"
#include "io/text_impl.h"

/* Without HDF5's own lock: on some network file systems it would meet the one that the output holds. */
static hid_t create_file(const char *path)
{
    const hid_t plan = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_file_locking(plan, false, true);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, plan);
    H5Pclose(plan);
    return file;
}

static iso_status hdf5_open(iso_context *ctx, iso_table_writer *w, const char *path)
{
    iso_hdf5_store *s = w->data = iso_hdf5_store_create();
    if (!s) return iso_text_no_memory(ctx, "write", path);
    iso_status status = iso_output_open_regular(ctx, path, false, &s->out);
    if (status == ISO_OK) {
        w->name = iso_output_name(s->out);
        ISO_HDF5_QUIETLY(s->file = create_file(iso_output_part(s->out)));
        if (s->file >= 0) return ISO_OK;
        status = iso_hdf5_trouble(ctx, "write", path);
        iso_output_close(ctx, s->out, false);
    }
    iso_hdf5_store_free(s);
    return status;
}

/* --- attributes ------------------------------------------------------------------------------------------------- */

/* False: it fails. A text has a variable length, since Python reads that as text and not as bytes. */
static bool write_attribute(hid_t at, const char *key, hid_t type, hsize_t count, const void *value)
{
    const hid_t space = count < 2 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, NULL);
    const hid_t attribute = H5Acreate2(at, key, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool written = attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
    if (attribute >= 0) H5Aclose(attribute);
    H5Sclose(space);
    return written;
}

/* Reads a value that is numbers with blanks between, and returns how many; 0: it is text, or has too many numbers. */
static int read_numbers(const char *key, const char *value, double numbers[ISO_HDF5_NUMBERS])
{
    int count = 0;
    if (strcmp(key, "hash") == 0 || strcmp(key, "sum") == 0) return 0; /* of hexadecimal digits: 12e3 is no number */
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
    const int count = read_numbers(key, value, numbers);
    bool written;
    ISO_HDF5_QUIETLY(written = count > 0 ? write_attribute(s->file, key, H5T_NATIVE_DOUBLE, (hsize_t)count, numbers)
                                         : write_attribute(s->file, key, s->text, 1, &value));
    return written ? ISO_OK : iso_hdf5_trouble(ctx, "write", w->name);
}

/* --- datasets --------------------------------------------------------------------------------------------------- */

/* Adds /group/name, which has `count` columns from `first` on. If all rows are known, they get their room now; else
 * it grows in chunks. */
static bool add_set(iso_hdf5_store *s, const char *group, const char *name, bool words, int first, int count,
                    size_t rows)
{
    const hsize_t wide = (hsize_t)count, size[2] = {s->grows ? 0 : rows, wide}, ever[2] = {H5S_UNLIMITED, wide};
    const int rank = count > 1 ? 2 : 1;
    const hid_t space = H5Screate_simple(rank, size, s->grows ? ever : NULL);
    const hid_t link = H5Pcreate(H5P_LINK_CREATE), plan = H5Pcreate(H5P_DATASET_CREATE);
    char path[ISO_HDF5_TEXT];
    snprintf(path, sizeof path, "/%s/%s", group, name);
    H5Pset_create_intermediate_group(link, 1);
    H5Pset_obj_track_times(plan, 0);
    H5Pset_fill_time(plan, words ? H5D_FILL_TIME_ALLOC : H5D_FILL_TIME_NEVER);
    if (s->grows)
        H5Pset_chunk(plan, rank, (hsize_t[]){ISO_HDF5_BLOCK, wide});
    else
        H5Pset_alloc_time(plan, H5D_ALLOC_TIME_EARLY);
    const hid_t id = H5Dcreate2(s->file, path, words ? s->text : H5T_NATIVE_DOUBLE, space, link, plan, s->access);
    H5Pclose(link);
    H5Pclose(plan);
    H5Sclose(space);
    return iso_hdf5_store_add(s, (iso_hdf5_set){id, first, count, words, 0, 0});
}

/* Adds the format, the datasets (a trajectory's in its parts) and, if `named`, the names of all columns. */
static bool add_layout(const iso_table_writer *w, const iso_record *header, bool named)
{
    iso_hdf5_store *s = w->data;
    const size_t columns = iso_record_columns(header);
    const char **names = malloc((columns + 1) * sizeof *names);
    char format[64], *list = malloc(columns * ISO_COLUMN_SIZE + 1), *end = list;
    snprintf(format, sizeof format, "isoroll %s 1", w->kind);
    bool good = names && list && write_attribute(s->file, "format", s->text, 1, &(const char *){format});
    for (size_t c = 0; good && c < columns; c++) {
        names[c] = iso_record_name(header, c);
        end += sprintf(end, c ? ",%s" : "%s", names[c]);
    }
    for (size_t c = 0, taken; good && c < columns; c += taken) {
        const char *group = w->kind, *name = names[c];
        taken = (size_t)iso_hdf5_part(names + c, columns - c, &group, &name);
        good = add_set(s, group, name, iso_record_has_words(header, c), (int)c, (int)taken, w->expected);
    }
    if (named) good = good && write_attribute(s->file, ISO_HDF5_COLUMNS, s->text, 1, &list);
    free(names);
    free(list);
    return good;
}

static iso_status hdf5_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    iso_hdf5_store *s = w->data;
    const char *key, *value;
    const bool named = strcmp(w->kind, ISO_TRAJECTORY_KIND) != 0;
    bool good;
    s->block = malloc(ISO_HDF5_BLOCK * iso_record_columns(header) * sizeof *s->block);
    if (!s->block) return iso_text_no_memory(ctx, "write", w->name);
    s->words = w->words;
    s->grows = w->expected == SIZE_MAX;
    ISO_HDF5_QUIETLY(good = add_layout(w, header, named));
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
    for (int i = 0; i < s->sets; i++) {
        const iso_hdf5_set *d = &s->set[i];
        memcpy(iso_hdf5_cells(s, d, s->filled), row + d->first, (size_t)d->count * sizeof *row);
    }
    w->waits = ++s->filled < ISO_HDF5_BLOCK;
    return w->waits ? ISO_OK : flush_block(ctx, w);
}

static iso_status hdf5_close(iso_context *ctx, iso_table_writer *w, bool keep)
{
    iso_hdf5_store *s = w->data;
    iso_output *const out = s->out;
    iso_status status = keep ? flush_block(ctx, w) : ISO_OK;
    bool closed;
    ISO_HDF5_QUIETLY(closed = iso_hdf5_store_free(s));
    if (status == ISO_OK && keep && !closed) status = iso_hdf5_trouble(ctx, "write", w->name);
    if (w->fresh) iso_output_keep_others(out);
    const iso_status renamed = iso_output_close(ctx, out, keep && status == ISO_OK);
    return status == ISO_OK ? renamed : status;
}

const iso_table_writing iso_hdf5_writing = {hdf5_open, hdf5_header, hdf5_row, hdf5_line, NULL, NULL, hdf5_close};
