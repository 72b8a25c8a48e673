/* hdf5_reader.c - trajectories from HDF5, ours and others' of the same layout, block by block. */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/place_impl.h"
#include "io/hdf5/hdf5_impl.h"

static iso_status bad_file(iso_context *ctx, const iso_table_reader *r, const char *what, const char *name)
{
    return iso_context_placed(ctx, iso_context_fail(ctx, ISO_BAD_INPUT, "", "%s: %s%s", r->name, what, name));
}

/* Makes one attribute a line of the header. */
static iso_status read_attribute(iso_context *ctx, iso_table_reader *r, hid_t file, const char *key)
{
    double numbers[ISO_HDF5_NUMBERS];
    char text[1024] = "";
    iso_status status = ISO_OK;
    const hid_t a = H5Aopen(file, key, H5P_DEFAULT), type = H5Aget_type(a), space = H5Aget_space(a);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const H5T_class_t class = H5Tget_class(type);
    if ((class == H5T_FLOAT || class == H5T_INTEGER) && count >= 1 && count <= ISO_HDF5_NUMBERS) {
        if (H5Aread(a, H5T_NATIVE_DOUBLE, numbers) >= 0)
            status = iso_record_set_numbers(ctx, r->header, key, (size_t)count, numbers);
    } else if (class == H5T_STRING && count == 1) {
        char *variable = NULL;
        if (H5Tis_variable_str(type) > 0) {
            const hid_t memory = H5Tcopy(H5T_C_S1);
            H5Tset_size(memory, H5T_VARIABLE);
            H5Tset_cset(memory, H5Tget_cset(type));
            if (H5Aread(a, memory, &variable) >= 0 && variable) snprintf(text, sizeof text, "%s", variable);
            if (variable) H5free_memory(variable);
            H5Tclose(memory);
        } else if (H5Tget_size(type) < sizeof text) {
            H5Aread(a, type, text);
        }
        text[strcspn(text, "\r\n")] = '\0';
        if (strcmp(key, "format") != 0)
            status = iso_record_set(ctx, r->header, key, text);
        else if (strcmp(text, ISO_HDF5_FORMAT) != 0 && strcmp(text, "isoroll section 1") != 0)
            status =
                bad_file(ctx, r, "expected the format 'isoroll trajectory 1' or 'isoroll section 1', not ", text);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(a);
    return status;
}

static iso_status read_attributes(iso_context *ctx, iso_table_reader *r, hid_t file)
{
    char key[256];
    iso_status status = ISO_OK;
    H5O_info1_t info;
    if (H5Oget_info2(file, &info, H5O_INFO_NUM_ATTRS) < 0) return iso_hdf5_trouble(ctx, "read", r->name);
    for (hsize_t i = 0; status == ISO_OK && i < info.num_attrs; i++) {
        const ssize_t length =
            H5Aget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, i, key, sizeof key, H5P_DEFAULT);
        if (length > 0 && (size_t)length < sizeof key) status = read_attribute(ctx, r, file, key);
    }
    return status;
}

/* Opens /group/name, or /name. */
static hid_t open_set(hid_t file, const char *group, const char *name)
{
    char path[64];
    snprintf(path, sizeof path, "/%s/%s", group, name);
    const bool grouped = H5Lexists(file, group, H5P_DEFAULT) > 0 && H5Lexists(file, path, H5P_DEFAULT) > 0;
    if (!grouped && H5Lexists(file, name, H5P_DEFAULT) <= 0) return -1;
    const hid_t access = iso_hdf5_access(), id = H5Dopen2(file, grouped ? path : name, access);
    H5Pclose(access);
    return id;
}

/* Adds a dataset of `count` columns (id < 0: there is none). It must have as many rows as the others. */
static iso_status add_set(iso_context *ctx, iso_table_reader *r, hid_t id, const char *name, int first,
                          int count, const char *names[], size_t *columns)
{
    iso_hdf5_store *s = r->data;
    hsize_t size[2] = {0, 1};
    if (id < 0) return ISO_OK;
    const hid_t space = H5Dget_space(id);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space, size, NULL);
    H5Sclose(space);
    s->set[s->sets++] = (iso_hdf5_set){id, (int)*columns, count};
    if (rank != (count > 1 ? 2 : 1) || size[1] != (hsize_t)count)
        return bad_file(ctx, r, "expected a dataset of rows x components: ", name);
    if (s->sets > 1 && size[0] != s->rows)
        return bad_file(ctx, r, "this dataset has another number of rows than the others: ", name);
    s->rows = size[0];
    for (int i = 0; i < count; i++) names[(*columns)++] = iso_column_name(first + i);
    return ISO_OK;
}

/* The datasets that only sections have. Of these the numbers of the orbits are read, behind the others of a row. */
static iso_status find_orbit(iso_context *ctx, iso_table_reader *r, const char *names[], size_t *columns)
{
    static const char *const group = "section", *const sets[] = {ISO_ORBIT_COLUMN, "crossing", "l", "x"};
    const iso_hdf5_store *s = r->data;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        char path[32];
        const size_t used = strlen(r->ignored);
        snprintf(path, sizeof path, "/%s/%s", group, sets[i]);
        if (H5Lexists(s->file, group, H5P_DEFAULT) <= 0 || H5Lexists(s->file, path, H5P_DEFAULT) <= 0) continue;
        snprintf(r->ignored + used, sizeof r->ignored - used, "%s'%s'", used ? ", " : "", sets[i]);
    }
    return add_set(ctx, r, open_set(s->file, group, ISO_ORBIT_COLUMN), ISO_ORBIT_COLUMN, 0, 1, names, columns);
}

static iso_status find_sets(iso_context *ctx, iso_table_reader *r)
{
    iso_hdf5_store *s = r->data;
    const char *names[ISO_TRAJECTORY_COLUMNS + 1];
    size_t columns = 0;
    iso_hdf5_part parts[ISO_HDF5_PARTS];
    iso_status status = ISO_OK;
    const int count = iso_hdf5_parts(parts);
    for (int p = 0; status == ISO_OK && p < count; p++) {
        const iso_hdf5_part *part = &parts[p];
        const hid_t whole = open_set(s->file, part->group, part->name);
        status = add_set(ctx, r, whole, part->name, part->first, part->count, names, &columns);
        for (int i = 0; status == ISO_OK && whole < 0 && part->count > 1 && i < part->count; i++) {
            const char *name = iso_column_name(part->first + i);
            status = add_set(ctx, r, open_set(s->file, part->group, name), name, part->first + i, 1, names, &columns);
        }
    }
    if (status == ISO_OK && columns == 0)
        status = bad_file(ctx, r, "no dataset of a trajectory, such as /clock/t or /ball/omega", "");
    size_t numbers = columns;
    if (status == ISO_OK) status = find_orbit(ctx, r, names, &numbers);
    if (status != ISO_OK) return status;
    status = iso_table_name_columns(ctx, r, columns, names);
    if (status == ISO_OK && !iso_hdf5_store_room(s, numbers))
        status = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", r->name);
    return status;
}

static iso_status hdf5_open(iso_context *ctx, iso_table_reader *r, const char *columns)
{
    iso_status status = iso_hdf5_load(ctx);
    if (status != ISO_OK) return status;
    iso_hdf5_store *s = r->data = iso_hdf5_store_create();
    if (!s) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", r->name);
    if (columns)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "columns",
                                "--columns is for text: in HDF5 the datasets have names");
    status = iso_record_create(ctx, 0, NULL, &r->header);
    if (status != ISO_OK) return status;
    if (access(r->path, R_OK) != 0)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot open '%s': %s", r->path, strerror(errno));
    H5E_BEGIN_TRY
    {
        s->file = H5Fopen(r->path, H5F_ACC_RDONLY, H5P_DEFAULT);
        if (s->file < 0)
            status = bad_file(ctx, r, "this is not an HDF5 file, or it is damaged", "");
        else
            status = read_attributes(ctx, r, s->file);
        if (status == ISO_OK) status = find_sets(ctx, r);
    }
    H5E_END_TRY
    return status;
}

static iso_status read_block(iso_context *ctx, iso_table_reader *r)
{
    iso_hdf5_store *s = r->data;
    const hsize_t left = s->rows - s->begun;
    bool good;
    s->filled = left < ISO_HDF5_BLOCK ? (size_t)left : ISO_HDF5_BLOCK;
    s->next = 0;
    H5E_BEGIN_TRY
    {
        good = iso_hdf5_transfer(s, s->begun, false);
    }
    H5E_END_TRY
    s->begun += s->filled;
    return good ? ISO_OK : iso_hdf5_trouble(ctx, "read", r->name);
}

/* The next row as it stands. */
static iso_status take_row(iso_context *ctx, iso_table_reader *r, double row[], bool *more)
{
    iso_hdf5_store *s = r->data;
    const iso_status status = s->next == s->filled ? read_block(ctx, r) : ISO_OK;
    const size_t columns = iso_record_columns(r->header);
    *more = status == ISO_OK && s->next < s->filled;
    if (!*more) return status;
    const double *numbers = s->block + s->next++ * s->columns;
    memcpy(row, numbers, columns * sizeof *row);
    r->orbit = s->columns > columns ? numbers[columns] : 0;
    r->line++;
    return ISO_OK;
}

static bool is_nan_row(const double row[], size_t columns)
{
    for (size_t i = 0; i < columns; i++)
        if (!isnan(row[i])) return false;
    return true;
}

static iso_status hdf5_next(iso_context *ctx, iso_table_reader *r, double row[], bool *more)
{
    const size_t columns = iso_record_columns(r->header);
    iso_status status = take_row(ctx, r, row, more);
    for (; *more && r->passes && is_nan_row(row, columns); r->passed++) status = take_row(ctx, r, row, more);
    if (!*more) return status;
    for (size_t i = 0; i < columns; i++)
        if (!isfinite(row[i]))
            return iso_context_placed(ctx, iso_context_fail(ctx, ISO_BAD_INPUT, "",
                                                            "%s:%zu: expected a finite number for %s", r->name,
                                                            r->line, iso_record_name(r->header, i)));
    return ISO_OK;
}

static void hdf5_close(iso_table_reader *r)
{
    if (!r->data) return;
    H5E_BEGIN_TRY
    {
        iso_hdf5_store_free(r->data);
    }
    H5E_END_TRY
}

const iso_table_reading iso_hdf5_reading = {hdf5_open, hdf5_next, hdf5_close};
