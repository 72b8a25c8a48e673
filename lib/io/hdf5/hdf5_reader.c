/* hdf5_reader.c - tables from HDF5, ours and others' trajectories of the same layout, block by block. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/place_impl.h"
#include "io/hdf5/hdf5_impl.h"
#include "io/text_impl.h"

static iso_status bad_file(iso_context *ctx, const iso_table_reader *r, const char *what, const char *name)
{
    return iso_context_placed(ctx, iso_context_fail(ctx, ISO_BAD_INPUT, "", "%s: %s%s", r->name, what, name));
}

/* The text of an attribute, to be freed by the caller; NULL: there is none. */
static char *read_text(hid_t a, hid_t type)
{
    char *text = NULL, *variable = NULL;
    if (H5Tis_variable_str(type) > 0) {
        const hid_t memory = H5Tcopy(H5T_C_S1);
        H5Tset_size(memory, H5T_VARIABLE);
        H5Tset_cset(memory, H5Tget_cset(type));
        if (H5Aread(a, memory, &variable) >= 0 && variable) text = strdup(variable);
        if (variable) H5free_memory(variable);
        H5Tclose(memory);
    } else if ((text = calloc(1, H5Tget_size(type) + 1))) {
        H5Aread(a, type, text);
    }
    return text;
}

/* "isoroll KIND 1" */
static iso_status read_format(iso_context *ctx, const iso_table_reader *r, const char *text)
{
    char kind[32] = "", version[8] = "", quoted[ISO_QUOTE_SIZE];
    const bool one = sscanf(text, "isoroll %31[^0-9]%7s", kind, version) == 2 && strcmp(version, "1") == 0;
    const size_t length = strlen(kind);
    if (one && length > 1) kind[length - 1] = '\0'; /* the blank before the version */
    iso_text_quote(quoted, text, strlen(text));
    if (r->trajectory && (!one || (strcmp(kind, ISO_TRAJECTORY_KIND) != 0 && strcmp(kind, "section") != 0)))
        return bad_file(ctx, r, "expected the format 'isoroll trajectory 1' or 'isoroll section 1', not ", quoted);
    if (!one) return bad_file(ctx, r, "expected the format 'isoroll KIND 1', not ", quoted);
    if (!r->trajectory && r->kind && strcmp(kind, r->kind) != 0)
        return bad_file(ctx, r, "this is a table of another kind: ", kind);
    iso_record_set_kind(r->header, kind);
    return ISO_OK;
}

/* Makes one attribute a line of the header. */
static iso_status read_attribute(iso_context *ctx, iso_table_reader *r, hid_t file, const char *key)
{
    double numbers[ISO_HDF5_NUMBERS];
    char *text = NULL;
    iso_status status = ISO_OK;
    const hid_t a = H5Aopen(file, key, H5P_DEFAULT), type = H5Aget_type(a), space = H5Aget_space(a);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const H5T_class_t class = H5Tget_class(type);
    if ((class == H5T_FLOAT || class == H5T_INTEGER) && count >= 1 && count <= ISO_HDF5_NUMBERS) {
        if (H5Aread(a, H5T_NATIVE_DOUBLE, numbers) >= 0)
            status = iso_record_set_numbers(ctx, r->header, key, (size_t)count, numbers);
    } else if (class == H5T_STRING && count == 1 && (text = read_text(a, type))) {
        if (r->trajectory) text[strcspn(text, "\r\n")] = '\0';
        status = strcmp(key, "format") == 0 ? read_format(ctx, r, text) : iso_record_set(ctx, r->header, key, text);
    }
    free(text);
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
    if (status == ISO_OK && !r->trajectory && !*iso_record_kind(r->header))
        status = bad_file(ctx, r, "expected the attribute 'format', 'isoroll KIND 1'", "");
    return status;
}

/* Opens /group/name, or /name. */
static hid_t open_set(hid_t file, const char *group, const char *name)
{
    char path[200];
    snprintf(path, sizeof path, "/%s/%s", group, name);
    const bool grouped = *group && H5Lexists(file, group, H5P_DEFAULT) > 0 && H5Lexists(file, path, H5P_DEFAULT) > 0;
    if (!grouped && H5Lexists(file, name, H5P_DEFAULT) <= 0) return -1;
    const hid_t access = iso_hdf5_access(), id = H5Dopen2(file, grouped ? path : name, access);
    H5Pclose(access);
    return id;
}

/* --- columns ---------------------------------------------------------------------------------------------------- */

/* The columns found so far, and those that the file names, if it does. */
typedef struct finding {
    iso_context *ctx;
    iso_table_reader *r;
    size_t count;
    const char *name[ISO_MOST_COLUMNS + 4];
    bool words[ISO_MOST_COLUMNS + 4];
} finding;

/* Adds a dataset of `count` columns (id < 0: there is none). It must have as many rows as the others. */
static iso_status add_set(finding *c, hid_t id, const char *name, const char *const names[], int count)
{
    iso_hdf5_store *s = c->r->data;
    hsize_t size[2] = {0, 1};
    if (id < 0) return ISO_OK;
    const hid_t space = H5Dget_space(id), type = H5Dget_type(id);
    const int rank = H5Sget_simple_extent_ndims(space);
    const bool words = H5Tget_class(type) == H5T_STRING, first = s->sets == 0;
    if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space, size, NULL);
    H5Tclose(type);
    H5Sclose(space);
    if (!iso_hdf5_store_add(s, (iso_hdf5_set){.id = id, .first = (int)c->count, .count = count, .words = words}))
        return iso_context_fail(c->ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", c->r->name);
    if (rank != (count > 1 ? 2 : 1) || size[1] != (hsize_t)count || (words && (count > 1 || c->r->trajectory)))
        return bad_file(c->ctx, c->r, "expected a dataset of rows x components: ", name);
    if (!first && size[0] != s->rows)
        return bad_file(c->ctx, c->r, "this dataset has another number of rows than the others: ", name);
    s->rows = size[0];
    if (c->count + (size_t)count > ISO_MOST_COLUMNS) return bad_file(c->ctx, c->r, "more than 5000 columns", "");
    for (int i = 0; i < count; i++, c->count++) {
        c->name[c->count] = names[i];
        c->words[c->count] = words;
    }
    return ISO_OK;
}

/* Those of a trajectory. */
static iso_status find_parts(finding *c)
{
    const iso_hdf5_store *s = c->r->data;
    iso_hdf5_part parts[ISO_HDF5_PARTS];
    iso_status status = ISO_OK;
    const int count = iso_hdf5_parts(parts);
    for (int p = 0; status == ISO_OK && p < count; p++) {
        const iso_hdf5_part *part = &parts[p];
        const char *names[ISO_TRAJECTORY_COLUMNS];
        for (int i = 0; i < part->count; i++) names[i] = iso_column_name(part->first + i);
        const hid_t whole = open_set(s->file, part->group, part->name);
        status = add_set(c, whole, part->name, names, part->count);
        for (int i = 0; status == ISO_OK && whole < 0 && part->count > 1 && i < part->count; i++)
            status = add_set(c, open_set(s->file, part->group, names[i]), names[i], &names[i], 1);
    }
    return status;
}

/* The datasets that only sections have. Of a trajectory's reader they are passed over, but for the numbers of the
 * orbits, which it reads behind the others of a row. */
static iso_status find_section(finding *c)
{
    static const char *const group = "section", *const sets[] = {ISO_ORBIT_COLUMN, "crossing", "l", "x"};
    iso_table_reader *r = c->r;
    const iso_hdf5_store *s = r->data;
    iso_status status = ISO_OK;
    for (size_t i = 0; status == ISO_OK && i < sizeof sets / sizeof *sets; i++) {
        char path[32];
        const size_t used = strlen(r->ignored);
        snprintf(path, sizeof path, "/%s/%s", group, sets[i]);
        const bool there = H5Lexists(s->file, group, H5P_DEFAULT) > 0 && H5Lexists(s->file, path, H5P_DEFAULT) > 0;
        if (there) snprintf(r->ignored + used, sizeof r->ignored - used, "%s'%s'", used ? ", " : "", sets[i]);
        if (i == 0 || (there && !r->trajectory))
            status = add_set(c, open_set(s->file, group, sets[i]), sets[i], &sets[i], 1);
    }
    return status;
}

/* The columns that the file names, those of no trajectory in the group of its kind. They get the order of the names. */
static iso_status find_named(finding *c, char *list)
{
    iso_hdf5_store *s = c->r->data;
    const char *ordered[ISO_MOST_COLUMNS];
    size_t count = 0;
    iso_status status = ISO_OK;
    for (char *name; status == ISO_OK && (name = strsep(&list, ","));) {
        if (count == ISO_MOST_COLUMNS) return bad_file(c->ctx, c->r, "more than 5000 columns", "");
        ordered[count++] = name;
        if (iso_column_find(name) >= 0) continue;
        const hid_t id = open_set(s->file, iso_record_kind(c->r->header), name);
        status = add_set(c, id, name, &ordered[count - 1], 1);
    }
    bool words[ISO_MOST_COLUMNS] = {false};
    for (int i = 0; status == ISO_OK && i < s->sets; i++) {
        size_t at = 0;
        const size_t from = (size_t)s->set[i].first;
        while (at < count && strcmp(ordered[at], c->name[from]) != 0) at++;
        if (at + (size_t)s->set[i].count > count || count != c->count)
            return bad_file(c->ctx, c->r, "the attribute 'columns' does not name the datasets", "");
        words[at] = c->words[from];
        s->set[i].first = (int)at;
    }
    if (status != ISO_OK) return status;
    memcpy(c->name, ordered, count * sizeof *ordered);
    memcpy(c->words, words, count * sizeof *words);
    return ISO_OK;
}

/* Columns and lines into the header. */
static iso_status name_columns(finding *c, size_t count, size_t numbers)
{
    iso_table_reader *r = c->r;
    iso_hdf5_store *s = r->data;
    iso_status status = iso_table_name_columns(c->ctx, r, count, c->name);
    for (size_t i = 0; status == ISO_OK && i < count; i++)
        if (c->words[i]) iso_record_set_words(r->header, i);
    if (status == ISO_OK && !iso_hdf5_store_room(s, numbers))
        status = iso_context_fail(c->ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", r->name);
    s->interned = r->header;
    r->rows = (size_t)s->rows;
    return status;
}

static iso_status find_trajectory(finding *c)
{
    const bool section = strcmp(iso_record_kind(c->r->header), "section") == 0;
    iso_status status = find_parts(c);
    if (section) iso_record_set(c->ctx, c->r->header, ISO_HDF5_COLUMNS, NULL);
    if (status == ISO_OK && c->count == 0)
        status = bad_file(c->ctx, c->r, "no dataset of a trajectory, such as /clock/t or /ball/omega", "");
    const size_t count = c->count;
    if (status == ISO_OK) status = find_section(c);
    return status == ISO_OK ? name_columns(c, count, c->count) : status;
}

static iso_status find_table(finding *c)
{
    const char *named = iso_record_get(c->r->header, ISO_HDF5_COLUMNS);
    char *list = named ? strdup(named) : NULL;
    if (named && !list) return iso_context_fail(c->ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", c->r->name);
    iso_status status = list ? ISO_OK : find_section(c);
    iso_record_set(c->ctx, c->r->header, ISO_HDF5_COLUMNS, NULL);
    if (status == ISO_OK) status = find_parts(c);
    if (status == ISO_OK && list) status = find_named(c, list);
    if (status == ISO_OK && c->count == 0) status = bad_file(c->ctx, c->r, "no dataset of a table", "");
    if (status == ISO_OK) status = name_columns(c, c->count, c->count);
    free(list);
    return status;
}

/* The columns of a sweep (hdf5_impl.h). Those that "columns" calls vary/NAME are NAME, others GROUP_NAME. */
static iso_status find_sweep(finding *c)
{
    static const char *const point = "point", *const last[] = {"status", "reason"};
    iso_hdf5_store *s = c->r->data;
    const char *text = iso_record_get(c->r->header, ISO_HDF5_COLUMNS);
    char *list = text ? strdup(text) : NULL, *rest = list, *path;
    iso_status status =
        list ? ISO_OK : bad_file(c->ctx, c->r, "the result of a sweep without the line 'columns'", "");
    s->counts = strcmp(iso_record_kind(c->r->header), "sweep") == 0;
    if (s->counts) c->name[c->count++] = point;
    if (status == ISO_OK && !s->counts) status = add_set(c, open_set(s->file, "", point), point, &point, 1);
    while (status == ISO_OK && (path = strsep(&rest, " "))) {
        const hid_t id = open_set(s->file, "", path);
        char *const slash = strchr(path, '/');
        if (slash) *slash = '_';
        const char *name = strncmp(path, "vary_", 5) == 0 ? path + 5 : path;
        status = id < 0 ? bad_file(c->ctx, c->r, "there is no dataset for the column ", path)
                        : add_set(c, id, path, &name, 1);
    }
    if (status == ISO_OK) status = add_set(c, open_set(s->file, "", last[0]), last[0], &last[0], 1);
    s->failed = (iso_hdf5_failures){.point = -1, .status_column = (int)c->count - 1, .reason_column = (int)c->count};
    s->failed.reason = open_set(s->file, "failed", "reason");
    if (status == ISO_OK && s->failed.reason < 0)
        status = bad_file(c->ctx, c->r, "there is no dataset for reasons", "");
    c->name[c->count] = last[1];
    c->words[c->count++] = true;
    if (status == ISO_OK) status = name_columns(c, c->count, c->count);
    free(list);
    return status;
}

static iso_status find_sets(iso_context *ctx, iso_table_reader *r)
{
    finding *c = calloc(1, sizeof *c);
    if (!c) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to read '%s'", r->name);
    c->ctx = ctx;
    c->r = r;
    const bool sweep = !r->trajectory && iso_hdf5_is_sweep(iso_record_kind(r->header));
    const iso_status status = r->trajectory ? find_trajectory(c) : sweep ? find_sweep(c) : find_table(c);
    free(c);
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
    s->ctx = ctx;
    if (r->forgets) iso_record_forget_words(r->header);
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
    if (!r->trajectory) return status;
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
