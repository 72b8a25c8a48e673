/* hdf5_section.c - reads a section file that is HDF5 into a record (lib/doc/formats.md, section 5). */
#include "io/section_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/hdf5/hdf5_library_impl.h"
#include "orbit/scene.h"

enum { MOST_COLUMNS = 64, MOST_NUMBERS = 16, TEXT = 1024 };
/* Of rows times columns. Unwritten rows take no room in a file: a small file can promise more than memory holds. */
#define MOST_VALUES 1e8

/* A dataset: rows x columns, columns 1, 3 or 4. */
typedef struct dataset {
    hid_t id;
    char name[ISO_NAME_SIZE];
    size_t rows, columns;
} dataset;

typedef struct reading {
    iso_context *ctx;
    hid_t file;
    dataset set[MOST_COLUMNS];
    size_t sets, columns; /* columns: of all datasets, also of those without a place in `set` */
    iso_record *record;
} reading;

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* The text of an attribute, of fixed or variable length; false: it is no text. */
static bool read_text(hid_t attribute, char text[TEXT])
{
    const hid_t type = H5Aget_type(attribute);
    const bool is_text = H5Tget_class(type) == H5T_STRING, varies = is_text && H5Tis_variable_str(type) > 0;
    char *variable = NULL;
    bool good = false;
    memset(text, 0, TEXT);
    if (varies) {
        good = H5Aread(attribute, type, &variable) >= 0 && variable;
        if (good) snprintf(text, TEXT, "%s", variable);
        if (variable) H5free_memory(variable);
    } else if (is_text && H5Tget_size(type) < TEXT)
        good = H5Aread(attribute, type, text) >= 0;
    text[strcspn(text, "\r\n")] = '\0';
    H5Tclose(type);
    return good;
}

static iso_status read_attribute(const reading *r, hid_t attribute, const char *key)
{
    double numbers[MOST_NUMBERS];
    char text[TEXT];
    if (read_text(attribute, text)) return iso_record_set(r->ctx, r->record, key, text);
    const hid_t space = H5Aget_space(attribute);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    H5Sclose(space);
    if (count < 1 || count > MOST_NUMBERS || H5Aread(attribute, H5T_NATIVE_DOUBLE, numbers) < 0) return ISO_OK;
    return iso_record_set_numbers(r->ctx, r->record, key, (size_t)count, numbers);
}

static iso_status read_attributes(const reading *r)
{
    H5O_info1_t info;
    char key[256];
    iso_status status = ISO_OK;
    if (H5Oget_info2(r->file, &info, H5O_INFO_NUM_ATTRS) < 0) return ISO_OK;
    for (hsize_t i = 0; status == ISO_OK && i < info.num_attrs; i++) {
        const hid_t a = H5Aopen_by_idx(r->file, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT);
        if (H5Aget_name(a, sizeof key, key) > 0 && strcmp(key, "format") != 0) status = read_attribute(r, a, key);
        H5Aclose(a);
    }
    return status;
}

/* --- datasets --------------------------------------------------------------------------------------------------- */

/* Notes a dataset of numbers; others are passed over. */
static void add_set(reading *r, hid_t group, const char *name)
{
    hsize_t size[2] = {0, 1};
    const hid_t id = H5Dopen2(group, name, H5P_DEFAULT);
    if (id < 0) return;
    const hid_t space = H5Dget_space(id);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space, size, NULL);
    H5Sclose(space);
    const bool fits = size[0] > 0 && size[1] > 0 && size[1] <= 4 && strlen(name) + 2 <= ISO_NAME_SIZE;
    if (fits) r->columns += (size_t)size[1];
    if (!fits || r->columns > MOST_COLUMNS) {
        H5Dclose(id);
        return;
    }
    dataset *d = &r->set[r->sets++];
    *d = (dataset){.id = id, .rows = (size_t)size[0], .columns = (size_t)size[1]};
    memcpy(d->name, name, strlen(name) + 1);
}

static void find_sets(reading *r)
{
    static const char *const groups[] = {"section", "clock", "ball", "point"};
    char name[64];
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
        H5G_info_t info;
        const hid_t group = H5Gopen2(r->file, groups[g], H5P_DEFAULT);
        if (group < 0) continue;
        for (hsize_t i = 0; H5Gget_info(group, &info) >= 0 && i < info.nlinks; i++)
            if (H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT) > 0)
                add_set(r, group, name);
        H5Gclose(group);
    }
}

/* The names of all columns: omega1 ... of a vector, q0 ... of a quaternion. */
static iso_status name_columns(reading *r)
{
    char text[MOST_COLUMNS][ISO_NAME_SIZE + 4];
    const char *names[MOST_COLUMNS];
    size_t count = 0;
    for (size_t i = 0; i < r->sets; i++)
        for (size_t j = 0; j < r->set[i].columns; j++, count++) {
            const dataset *d = &r->set[i];
            if (d->columns == 1)
                snprintf(text[count], sizeof text[count], "%s", d->name);
            else
                snprintf(text[count], sizeof text[count], "%s%zu", d->name, j + (d->columns == 3));
            names[count] = text[count];
        }
    return iso_record_create(r->ctx, count, names, &r->record);
}

static iso_status read_rows(const reading *r)
{
    const size_t rows = r->set[0].rows;
    iso_status status = ISO_OK;
    double *row;
    for (size_t i = 0; status == ISO_OK && i < rows; i++) status = iso_record_append(r->ctx, r->record, &row);
    for (size_t s = 0, first = 0; status == ISO_OK && s < r->sets; first += r->set[s++].columns) {
        const dataset *d = &r->set[s];
        double *numbers = d->rows == rows ? malloc(rows * d->columns * sizeof *numbers) : NULL;
        if (!numbers || H5Dread(d->id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers) < 0)
            status = iso_context_fail(r->ctx, ISO_BAD_INPUT, "", "the dataset '%s' cannot be read", d->name);
        for (size_t i = 0; status == ISO_OK && i < rows * d->columns; i++)
            iso_record_row(r->record, i / d->columns)[first + i % d->columns] = numbers[i];
        free(numbers);
    }
    return status;
}

/* --- the file --------------------------------------------------------------------------------------------------- */

/* Whether the datasets are few and short enough for a record. */
static iso_status check_sizes(const reading *r)
{
    if (r->columns > MOST_COLUMNS)
        return iso_context_fail(r->ctx, ISO_BAD_INPUT, "", "more than %d columns", MOST_COLUMNS);
    if (r->sets == 0) return iso_context_fail(r->ctx, ISO_BAD_INPUT, "", "no dataset of a section");
    if ((double)r->set[0].rows * (double)r->columns > MOST_VALUES)
        return iso_context_fail(r->ctx, ISO_BAD_INPUT, "", "%zu rows of %zu columns are more than %g numbers",
                                r->set[0].rows, r->columns, MOST_VALUES);
    return ISO_OK;
}

static iso_status read_file(reading *r)
{
    find_sets(r);
    iso_status status = check_sizes(r);
    if (status == ISO_OK) status = name_columns(r);
    if (status == ISO_OK) status = read_attributes(r);
    if (status == ISO_OK) status = read_rows(r);
    for (size_t i = 0; i < r->sets; i++) H5Dclose(r->set[i].id);
    return status;
}

bool iso_section_file_is_hdf5(const char *path)
{
    char text[TEXT] = "";
    if (!iso_hdf5_is_there()) return false;
    H5dont_atexit();
    H5E_BEGIN_TRY
    {
        const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT), a = file < 0 ? -1 : H5Aopen(file, "format", 0);
        if (a >= 0) read_text(a, text);
        if (a >= 0) H5Aclose(a);
        if (file >= 0) H5Fclose(file);
    }
    H5E_END_TRY
    return strncmp(text, "isoroll section ", 16) == 0;
}

iso_status iso_section_file_read_hdf5(iso_context *ctx, const char *path, iso_record **record)
{
    reading r = {.ctx = ctx};
    iso_status status = iso_hdf5_load(ctx);
    *record = NULL;
    if (status != ISO_OK) return status;
    H5E_BEGIN_TRY
    {
        r.file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
        status = r.file < 0 ? iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot open it") : read_file(&r);
        if (r.file >= 0) H5Fclose(r.file);
    }
    H5E_END_TRY
    *record = r.record;
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(r.record);
    *record = NULL;
    return status;
}
