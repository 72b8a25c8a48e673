/* hdf5_reader.c - tables from HDF5, ours and others' trajectories of the same layout, block by block. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/context_impl.h"
#include "io/hdf5/hdf5_impl.h"
#include "io/text_impl.h"
#include "orbit/orbit_impl.h"

/* What is being opened: the columns found so far. The names of those that may come next stand behind them. */
typedef struct finding {
    iso_context *ctx;
    iso_table_reader *r;
    iso_status status; /* of the attributes */
    size_t count;
    const char *name[ISO_MOST_COLUMNS + ISO_TRAJECTORY_COLUMNS];
} finding;

static iso_status bad_file(iso_context *ctx, const iso_table_reader *r, const char *what, const char *name)
{
    return iso_context_placed(ctx, ISO_FAIL_INPUT(ctx, "", "%s: %s%s", r->name, what, name));
}

/* --- attributes ------------------------------------------------------------------------------------------------- */

/* A text is a line of the header, or, of a table, many; the format, "isoroll KIND 1", says the kind. NULL: it cannot be
 * read. */
static iso_status take_text(iso_context *ctx, iso_table_reader *r, const char *key, char *text)
{
    char kind[32] = "", version[8] = "", quoted[ISO_QUOTE_SIZE];
    size_t length = text ? strlen(text) : 0;
    if (!text) return ISO_OK;
    while (r->trajectory && length > 0 && strchr("\r\n", text[length - 1])) text[--length] = '\0';
    if (r->trajectory && text[strcspn(text, "\r\n")])
        return bad_file(ctx, r, "expected one line in the attribute ", key);
    if (strcmp(key, "format") != 0) return iso_record_set(ctx, r->header, key, text);
    const bool one = sscanf(text, "isoroll %31[^0-9]%7s", kind, version) == 2 && strcmp(version, "1") == 0;
    length = strlen(kind);
    if (one && length > 1) kind[length - 1] = '\0'; /* the blank before the version */
    iso_text_quote(quoted, text, strlen(text));
    if (r->trajectory && !(one && (iso_table_is_finite(kind) || strcmp(kind, ISO_ORBITS_KIND) == 0)))
        return bad_file(ctx, r, "expected the format 'isoroll trajectory 1' or 'isoroll section 1', not ", quoted);
    if (!one) return bad_file(ctx, r, "expected the format 'isoroll KIND 1', not ", quoted);
    if (!r->trajectory && r->kind && strcmp(kind, r->kind) != 0)
        return bad_file(ctx, r, "this is a table of another kind: ", kind);
    iso_record_set_kind(r->header, kind);
    return ISO_OK;
}

/* Makes one attribute a line of the header. HDF5 calls it for each; -1: no more are wanted. */
static herr_t read_attribute(hid_t file, const char *key, const H5A_info_t *info, void *data)
{
    finding *c = data;
    double numbers[ISO_HDF5_NUMBERS];
    char *text = NULL;
    const hid_t a = H5Aopen(file, key, H5P_DEFAULT), type = H5Aget_type(a), space = H5Aget_space(a);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const H5T_class_t class = H5Tget_class(type);
    (void)info;
    if ((class == H5T_FLOAT || class == H5T_INTEGER) && count >= 1 && count <= ISO_HDF5_NUMBERS) {
        if (H5Aread(a, H5T_NATIVE_DOUBLE, numbers) >= 0)
            c->status = iso_record_set_numbers(c->ctx, c->r->header, key, (size_t)count, numbers);
    } else if (class == H5T_STRING && H5Tget_size(type) > ISO_LARGEST_TEXT) {
        c->status = bad_file(c->ctx, c->r, "more than 16 MiB for the attribute ", key);
    } else if (class == H5T_STRING && count == 1 && H5Tis_variable_str(type) > 0) {
        const hid_t memory = H5Tcopy(H5T_C_S1);
        H5Tset_size(memory, H5T_VARIABLE);
        H5Tset_cset(memory, H5Tget_cset(type));
        if (H5Aread(a, memory, &text) >= 0) c->status = take_text(c->ctx, c->r, key, text);
        H5free_memory(text);
        H5Tclose(memory);
    } else if (class == H5T_STRING && count == 1) {
        text = calloc(1, H5Tget_size(type) + 1);
        if (text) H5Aread(a, type, text);
        c->status = take_text(c->ctx, c->r, key, text);
        free(text);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(a);
    return c->status == ISO_OK ? 0 : -1;
}

/* --- columns ---------------------------------------------------------------------------------------------------- */

/* Whether there is a link to an object, or, with a group that is not "", to /group/name, which *path then is. */
static bool is_there(const finding *c, const char *group, const char *name, char path[ISO_HDF5_TEXT])
{
    const iso_hdf5_store *s = c->r->data;
    if (*group) snprintf(path, ISO_HDF5_TEXT, "/%s/%s", group, name);
    return (!*group || H5Lexists(s->file, group, s->access) > 0) &&
           H5Lexists(s->file, *group ? path : name, s->access) > 0;
}

/* Adds the dataset /group/name, or /name, of `count` columns, which has as many rows as the others; *found false:
 * there is none. failed: see iso_hdf5_set. */
static iso_status add_set(finding *c, const char *group, const char *name, int count, int failed, bool *found)
{
    iso_hdf5_store *s = c->r->data;
    char path[ISO_HDF5_TEXT];
    const bool grouped = *group && is_there(c, group, name, path), plain = is_there(c, "", name, NULL);
    const char *full = grouped ? path : name, *trouble = NULL;
    hsize_t size[2] = {0, 1};
    *found = grouped || plain || s->elsewhere;
    if (!*found) return ISO_OK;
    const hid_t id = s->elsewhere ? -1 : H5Dopen2(s->file, full, s->access);
    const hid_t space = H5Dget_space(id), type = H5Dget_type(id);
    const int rank = H5Sget_simple_extent_ndims(space);
    const bool words = H5Tget_class(type) == H5T_STRING, first = s->sets == 0;
    if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space, size, NULL);
    if (grouped && plain)
        trouble = "it stands in a group and outside of it: ";
    else if (s->elsewhere)
        trouble = "an external link, which leads to another file: ";
    else if (id < 0)
        trouble = "this is no dataset, or it is damaged, or its link leads nowhere: ";
    else
        trouble = iso_hdf5_trouble_of_set(s, id, type, size);
    H5Tclose(type);
    H5Sclose(space);
    if (!trouble &&
        (rank != (count > 1 ? 2 : 1) || size[1] != (hsize_t)count || (words && (count > 1 || c->r->trajectory))))
        trouble = "expected a dataset of rows x components: ";
    if (!trouble && !first && !failed && size[0] != s->rows)
        trouble = "this dataset has another number of rows than the others: ";
    if (!trouble && !iso_hdf5_store_add(s, (iso_hdf5_set){id, (int)c->count, count, words, failed, 0}))
        return iso_text_no_memory(c->ctx, "read", c->r->name);
    if (trouble && id >= 0) H5Dclose(id);
    if (trouble) return bad_file(c->ctx, c->r, trouble, full);
    if (!failed) s->rows = size[0];
    c->count += (size_t)count;
    return c->count <= ISO_MOST_COLUMNS ? ISO_OK : bad_file(c->ctx, c->r, "more than 5000 columns", "");
}

/* Adds the datasets of these columns, in their order. A column without one is passed over. */
static iso_status find_columns(finding *c, const char *group, const char *const names[], size_t count)
{
    iso_status status = ISO_OK;
    for (size_t i = 0; status == ISO_OK && i < count;) {
        const char *in = group, *name = names[i];
        bool found;
        int taken = iso_hdf5_part(names + i, count - i, &in, &name);
        memcpy(c->name + c->count, names + i, (size_t)taken * sizeof *names);
        status = add_set(c, in, name, taken, 0, &found);
        if (!found && taken > 1) taken = 1, status = add_set(c, in, names[i], taken, 0, &found);
        i += (size_t)taken;
    }
    return status;
}

/* The first `count` columns into the header, and room for all. Datasets may be packed, and links may give one many
 * names: the numbers can take more room than the file. */
static iso_status name_columns(finding *c, size_t count)
{
    iso_table_reader *r = c->r;
    iso_hdf5_store *s = r->data;
    const double bytes = (double)s->rows * (double)c->count * sizeof(double);
    hsize_t stored = 0;
    if (H5Fget_filesize(s->file, &stored) < 0) return iso_hdf5_trouble(c->ctx, "read", r->name);
    r->stored = (double)stored;
    r->rows = (size_t)s->rows;
    if (bytes > ISO_HDF5_EXPANSION * r->stored)
        return iso_context_placed(
            c->ctx,
            ISO_FAIL_INPUT(c->ctx, "", "%s: %zu rows of %zu columns take more than %d times the room of the file",
                           r->name, r->rows, c->count, ISO_HDF5_EXPANSION));
    ISO_TRY(iso_table_name_columns(c->ctx, r, count, c->name));
    for (int i = 0; i < s->sets; i++)
        if (s->set[i].words) iso_record_set_words(r->header, (size_t)s->set[i].first, true);
    s->header = r->header;
    s->block = malloc(ISO_HDF5_BLOCK * c->count * sizeof *s->block);
    return s->block ? ISO_OK : iso_text_no_memory(c->ctx, "read", r->name);
}

/* The numbers of the states, and behind them the number of the orbit. Other columns of a section and of periodic orbits
 * are passed over. */
static iso_status find_trajectory(finding *c)
{
    iso_record *const header = c->r->header;
    const char *names[ISO_TRAJECTORY_COLUMNS], *kind = iso_record_kind(header);
    const char *named = iso_record_get(header, ISO_HDF5_COLUMNS);
    char name[ISO_HDF5_TEXT], path[ISO_HDF5_TEXT], *ignored = c->r->ignored;
    const bool orbits = strcmp(kind, ISO_ORBITS_KIND) == 0;
    const char *group = orbits ? kind : "section";
    ISO_TRY(find_columns(c, "", names, (size_t)iso_column_names(names)));
    const size_t count = c->count;
    if (count == 0) return bad_file(c->ctx, c->r, "no dataset of a trajectory, such as /clock/t or /ball/omega", "");
    for (const char *at = orbits && named ? named : "crossing,l,x"; *at; at += strcspn(at, ","), at += *at == ',') {
        const size_t used = strlen(ignored), room = sizeof c->r->ignored - used;
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, ","), at);
        if (iso_column_find(name) < 0 && strcmp(name, ISO_ORBIT_COLUMN) != 0 && is_there(c, group, name, path) &&
            strlen(name) + 5 < room)
            snprintf(ignored + used, room, "%s'%s'", *ignored ? ", " : "", name);
    }
    if (strcmp(kind, ISO_TRAJECTORY_KIND) != 0) iso_record_set(c->ctx, header, ISO_HDF5_COLUMNS, NULL);
    if (is_there(c, ISO_TRAJECTORY_KIND, ISO_ORBIT_COLUMN, path)) group = ISO_TRAJECTORY_KIND;
    ISO_TRY(find_columns(c, group, (const char *[]){ISO_ORBIT_COLUMN}, 1));
    c->r->at.orbits = c->count > count;
    return name_columns(c, count);
}

/* The line "columns", to be cut into names; the store frees it. */
static iso_status copy_columns(finding *c)
{
    iso_hdf5_store *s = c->r->data;
    const char *named = iso_record_get(c->r->header, ISO_HDF5_COLUMNS);
    if (named) s->names = strdup(named);
    return named && !s->names ? iso_text_no_memory(c->ctx, "read", c->r->name) : ISO_OK;
}

/* The columns that the file names; of a trajectory or a section of version 0.1, which names none, those it can
 * have. */
static iso_status find_table(finding *c)
{
    static const char *const of_section[] = {ISO_ORBIT_COLUMN, "crossing", "l", "x"};
    iso_hdf5_store *s = c->r->data;
    const char *names[ISO_MOST_COLUMNS], *kind = iso_record_kind(c->r->header);
    size_t count = 0;
    ISO_TRY(copy_columns(c));
    ISO_TRY(iso_record_set(c->ctx, c->r->header, ISO_HDF5_COLUMNS, NULL));
    for (char *rest = s->names; rest; names[count++] = strsep(&rest, ","))
        if (count == ISO_MOST_COLUMNS) return bad_file(c->ctx, c->r, "more than 5000 columns", "");
    if (!s->names) {
        ISO_TRY(find_columns(c, "section", of_section, sizeof of_section / sizeof *of_section));
        count = (size_t)iso_column_names(names);
    }
    ISO_TRY(find_columns(c, kind, names, count));
    if (s->names && c->count != count)
        return bad_file(c->ctx, c->r, "the attribute 'columns' does not name the datasets", "");
    if (c->count == 0) return bad_file(c->ctx, c->r, "no dataset of a table", "");
    return name_columns(c, c->count);
}

/* Adds the dataset of one column that must be there, and names the column. */
static iso_status add_needed(finding *c, const char *path, const char *name)
{
    bool found;
    c->name[c->count] = name;
    ISO_TRY(add_set(c, "", path, 1, 0, &found));
    return found ? ISO_OK : bad_file(c->ctx, c->r, "there is no dataset for the column ", path);
}

/* The columns of an older sweep (hdf5_impl.h). Those that "columns" calls vary/NAME are NAME, others GROUP_NAME. */
static iso_status find_sweep(finding *c)
{
    iso_hdf5_store *s = c->r->data;
    bool found;
    ISO_TRY(copy_columns(c));
    s->counts = strcmp(iso_record_kind(c->r->header), "sweep") == 0;
    if (s->counts)
        c->name[c->count++] = "point";
    else
        ISO_TRY(add_needed(c, "point", "point"));
    for (char *rest = s->names, *path; (path = strsep(&rest, " "));) {
        char *const slash = strchr(path, '/');
        ISO_TRY(add_needed(c, path, strncmp(path, "vary/", 5) == 0 ? path + 5 : path));
        if (slash) *slash = '_';
    }
    ISO_TRY(add_needed(c, "status", "status"));
    c->name[c->count] = "reason";
    ISO_TRY(add_set(c, "failed", "reason", 1, (int)c->count - 1, &found));
    return found ? name_columns(c, c->count) : bad_file(c->ctx, c->r, "there is no dataset for reasons", "");
}

static iso_status read_header(iso_context *ctx, iso_table_reader *r)
{
    iso_hdf5_store *s = r->data;
    finding c = {.ctx = ctx, .r = r};
    s->file = H5Fopen(r->path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (s->file < 0) return bad_file(ctx, r, "this is not an HDF5 file, or it is damaged", "");
    const bool read = H5Aiterate2(s->file, H5_INDEX_NAME, H5_ITER_INC, NULL, read_attribute, &c) >= 0;
    if (c.status != ISO_OK || !read) return c.status != ISO_OK ? c.status : iso_hdf5_trouble(ctx, "read", r->name);
    if (r->trajectory) return find_trajectory(&c);
    const char *kind = iso_record_kind(r->header), *named = iso_record_get(r->header, ISO_HDF5_COLUMNS);
    if (!*kind) return bad_file(ctx, r, "expected the attribute 'format', 'isoroll KIND 1'", "");
    const bool sweep = strcmp(kind, "sweep") == 0 || strcmp(kind, "sweep part") == 0;
    return sweep && named && strncmp(named, "point,", 6) != 0 ? find_sweep(&c) : find_table(&c);
}

static iso_status hdf5_open(iso_context *ctx, iso_table_reader *r, const char *columns)
{
    iso_status status;
    iso_hdf5_store *s = r->data = iso_hdf5_store_create();
    if (!s) return iso_text_no_memory(ctx, "read", r->name);
    if (columns) return ISO_FAIL_ARGUMENT(ctx, "columns", "--columns is for text: in HDF5 the datasets have names");
    ISO_TRY(iso_record_create(ctx, 0, NULL, &r->header));
    if (access(r->path, R_OK) != 0) return iso_file_trouble(ctx, "open", r->path);
    ISO_HDF5_QUIETLY(status = read_header(ctx, r));
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
    ISO_HDF5_QUIETLY(good = iso_hdf5_transfer(s, s->begun, false));
    s->begun += s->filled;
    if (s->word_room == 0) return bad_file(ctx, r, "the words of 4096 rows take more than 64 MiB", "");
    return good ? ISO_OK : iso_hdf5_trouble(ctx, "read", r->name);
}

static iso_status hdf5_next(iso_context *ctx, iso_table_reader *r, double row[], bool *more)
{
    iso_hdf5_store *s = r->data;
    const size_t columns = iso_record_columns(r->header);
    for (;; r->at.passed++) {
        *more = false;
        if (s->next == s->filled) ISO_TRY(read_block(ctx, r));
        *more = s->next < s->filled;
        if (!*more) return ISO_OK;
        for (int i = 0; i < s->sets; i++) {
            const iso_hdf5_set *d = &s->set[i];
            const double *cells = iso_hdf5_cells(s, d, s->next);
            if ((size_t)d->first < columns)
                memcpy(row + d->first, cells, (size_t)d->count * sizeof *row);
            else
                r->at.orbit = *cells;
        }
        if (s->counts) row[0] = (double)r->at.line;
        s->next++;
        r->at.line++;
        if (!r->trajectory) return ISO_OK;
        size_t bad = columns, nans = 0;
        for (size_t i = columns; i-- > 0; nans += isnan(row[i]) != 0)
            if (!isfinite(row[i])) bad = i;
        if (bad == columns) return ISO_OK;
        if (!r->passes || nans < columns)
            return iso_context_placed(ctx, ISO_FAIL_INPUT(ctx, "", "%s:%zu: expected a finite number for %s", r->name,
                                                          r->at.line, iso_record_name(r->header, bad)));
    }
}

static void hdf5_close(iso_table_reader *r)
{
    if (!r->data) return;
    ISO_HDF5_QUIETLY(iso_hdf5_store_free(r->data));
}

const iso_table_reading iso_hdf5_reading = {hdf5_open, hdf5_next, hdf5_close};
