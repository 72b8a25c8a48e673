/* Writing trajectory files, whole and then renamed. */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/number.h"
#include "io/replacement_impl.h"
#include "io/trajectory_impl.h"

struct iso_trajectory_writer {
    FILE *file;
    const char *name;            /* what messages call it                              */
    char *direct;                /* the name of a file that is written as it is, or    */
    iso_replacement replacement; /* the one that takes an older file's place           */
    char **names;                /* of the columns, after the header                   */
    size_t columns, rows;
    int error; /* errno of the first failed write: a later one may say less         */
};

iso_status iso_trajectory_check_format(iso_context *ctx, const char *path)
{
    const size_t length = strlen(path);
    if (length < 3 || strcmp(path + length - 3, ".h5") != 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "'%s': this build has no HDF5 (.h5), use CSV, a name in .csv",
                            path);
}

static iso_status no_memory(iso_context *ctx)
{
    return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write a trajectory");
}

static void release(iso_trajectory_writer *w)
{
    for (size_t i = 0; w->names && i < w->columns; i++) free(w->names[i]);
    free(w->names);
    free(w->direct);
    free(w);
}

/* ---- Opening ---- */

/* Not to be renamed over: what is no regular file, and other names of a stream that is already open. */
static bool is_direct(const char *path, const struct stat *old)
{
    static const char *const open_streams[] = {"/dev/std", "/dev/fd/", "/proc/"};
    for (size_t i = 0; i < sizeof open_streams / sizeof *open_streams; i++)
        if (strncmp(path, open_streams[i], strlen(open_streams[i])) == 0) return true;
    return old && !S_ISREG(old->st_mode);
}

static iso_status open_regular(iso_context *ctx, iso_trajectory_writer *w, const char *path)
{
    int fd;
    iso_status status = iso_replacement_open(ctx, path, &w->replacement, &fd);
    if (status != ISO_OK) return status;
    w->name = w->replacement.target;
    w->file = fdopen(fd, "w");
    if (w->file) return ISO_OK;
    status = iso_file_trouble(ctx, "write", path);
    iso_replacement_close(ctx, &w->replacement, fd, false);
    close(fd);
    return status;
}

static iso_status open_direct(iso_context *ctx, iso_trajectory_writer *w, const char *path)
{
    w->name = w->direct = strdup(path);
    if (!w->name) return no_memory(ctx);
    const int fd = open(path, O_WRONLY | O_APPEND | O_CLOEXEC);
    if (fd >= 0 && (w->file = fdopen(fd, "a"))) return ISO_OK;
    const iso_status status = iso_file_trouble(ctx, "write", path);
    if (fd >= 0) close(fd);
    return status;
}

static void open_stdout(iso_trajectory_writer *w)
{
    w->file = stdout;
    w->name = "<stdout>";
}

iso_status iso_trajectory_open(iso_context *ctx, const char *path, iso_trajectory_writer **writer)
{
    struct stat old;
    *writer = NULL;
    iso_status status = iso_trajectory_check_format(ctx, path);
    if (status != ISO_OK) return status;
    iso_trajectory_writer *w = calloc(1, sizeof *w);
    if (!w) return no_memory(ctx);
    const struct stat *known = stat(path, &old) == 0 ? &old : NULL;
    if (strcmp(path, "-") == 0)
        open_stdout(w);
    else
        status = is_direct(path, known) ? open_direct(ctx, w, path) : open_regular(ctx, w, path);
    if (status == ISO_OK)
        *writer = w;
    else
        release(w);
    return status;
}

/* ---- Writing ---- */

static iso_status check_written(iso_context *ctx, iso_trajectory_writer *w)
{
    if (!ferror(w->file)) return ISO_OK;
    if (w->error == 0) w->error = errno;
    errno = w->error;
    return iso_file_trouble(ctx, "write", w->name);
}

/* Whether reading the line back gives the same key and value. */
static bool is_line(const char *key, const char *value)
{
    const size_t k = strlen(key), v = strlen(value);
    if (k == 0 || strpbrk(key, ":\r\n") || strpbrk(value, "\r\n")) return false;
    if (strchr(" \t", key[0]) || strchr(" \t", key[k - 1])) return false;
    return v == 0 || (!strchr(" \t", value[0]) && !strchr(" \t", value[v - 1]));
}

static bool copy_names(iso_trajectory_writer *w, const iso_record *header)
{
    const size_t columns = iso_record_columns(header);
    w->names = calloc(columns + 1, sizeof *w->names);
    if (!w->names) return false;
    for (w->columns = 0; w->columns < columns; w->columns++)
        if (!(w->names[w->columns] = strdup(iso_record_name(header, w->columns)))) return false;
    return true;
}

iso_status iso_trajectory_write_header(iso_context *ctx, iso_trajectory_writer *w, const iso_record *header)
{
    const char *key, *value;
    if (w->names) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a trajectory has one header");
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++)
        if (!is_line(key, value))
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "key '%s' is not one line of text 'key: value'", key);
    if (!copy_names(w, header)) return no_memory(ctx);
    fputs(ISO_TRAJECTORY_MAGIC ISO_TRAJECTORY_VERSION "\n", w->file);
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++)
        fprintf(w->file, *value ? "# %s: %s\n" : "# %s:\n", key, value);
    for (size_t i = 0; i < w->columns; i++) fprintf(w->file, i ? ",%s" : "%s", w->names[i]);
    fputc('\n', w->file);
    return check_written(ctx, w);
}

iso_status iso_trajectory_write_row(iso_context *ctx, iso_trajectory_writer *w, const double *row, size_t count)
{
    char text[ISO_NUMBER_SIZE];
    if (!w->names || count != w->columns)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a row of %zu numbers under %zu columns", count,
                                w->columns);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(row[i]))
            return iso_context_fail(ctx, ISO_NUMERICAL, w->names[i], "row %zu of '%s': %s is not finite", w->rows + 1,
                                    w->name, w->names[i]);
    for (size_t i = 0; i < count; i++) {
        const int length = iso_number_print(text, row[i]);
        fwrite(text, 1, (size_t)length, w->file);
        fputc(i + 1 < count ? ',' : '\n', w->file);
    }
    w->rows++;
    return check_written(ctx, w);
}

/* ---- Closing ---- */

static iso_status flush(iso_context *ctx, iso_trajectory_writer *w)
{
    const iso_status status = check_written(ctx, w);
    if (status != ISO_OK) return status;
    return fflush(w->file) == 0 ? ISO_OK : iso_file_trouble(ctx, "write", w->name);
}

static iso_status close_regular(iso_context *ctx, iso_trajectory_writer *w, bool keep)
{
    const iso_status flushed = keep ? flush(ctx, w) : ISO_OK;
    const iso_status status = iso_replacement_close(ctx, &w->replacement, fileno(w->file), keep && flushed == ISO_OK);
    fclose(w->file); /* already on the disk, or not wanted */
    return flushed != ISO_OK ? flushed : status;
}

static iso_status close_direct(iso_context *ctx, iso_trajectory_writer *w)
{
    const iso_status status = flush(ctx, w);
    if (w->file == stdout || fclose(w->file) == 0 || status != ISO_OK) return status;
    return iso_file_trouble(ctx, "write", w->name);
}

iso_status iso_trajectory_close(iso_context *ctx, iso_trajectory_writer *w, bool keep)
{
    if (!w) return ISO_OK;
    const iso_status status = w->replacement.temporary ? close_regular(ctx, w, keep) : close_direct(ctx, w);
    release(w);
    return status;
}

iso_status iso_trajectory_write(iso_context *ctx, const char *path, const iso_record *record)
{
    iso_trajectory_writer *w;
    iso_status status = iso_trajectory_open(ctx, path, &w);
    if (status != ISO_OK) return status;
    status = iso_trajectory_write_header(ctx, w, record);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(record); i++)
        status = iso_trajectory_write_row(ctx, w, iso_record_const_row(record, i), iso_record_columns(record));
    const iso_status closed = iso_trajectory_close(ctx, w, status == ISO_OK);
    return status != ISO_OK ? status : closed;
}
