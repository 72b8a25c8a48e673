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
#include "io/trajectory_impl.h"

struct iso_trajectory_writer {
    FILE *file;
    char *target;    /* what messages call it, and the name it is to have            */
    char *temporary; /* the name it has till then; NULL: written under its own name  */
    char **names;    /* of the columns, after the header                             */
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

static iso_status fail_file(iso_context *ctx, const char *what, const char *path)
{
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, errno == EPIPE ? "pipe" : "", "cannot %s '%s': %s", what, path,
                            strerror(errno));
}

static iso_status no_memory(iso_context *ctx)
{
    return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write a trajectory");
}

static void release(iso_trajectory_writer *w)
{
    for (size_t i = 0; w->names && i < w->columns; i++) free(w->names[i]);
    free(w->names);
    free(w->target);
    free(w->temporary);
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

/* A name in the folder of `target` that was not there, and its descriptor; -1 with errno set. */
static int create_beside(const char *target, mode_t mode, char **name)
{
    const char *slash = strrchr(target, '/');
    const int folder = slash ? (int)(slash - target) + 1 : 0;
    for (int i = 0; i < 1000; i++) {
        if (asprintf(name, "%.*s.isoroll-%ld-%d.tmp", folder, target, (long)getpid(), i) < 0) {
            *name = NULL;
            errno = ENOMEM;
            return -1;
        }
        const int fd = open(*name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (fd >= 0) return fd;
        free(*name);
        *name = NULL;
        if (errno != EEXIST) return -1;
    }
    return -1;
}

/* Behind a link it is the file that is replaced, not the link; a file keeps its permissions. */
static iso_status open_regular(iso_context *ctx, iso_trajectory_writer *w, const char *path, const struct stat *old)
{
    w->target = old ? realpath(path, NULL) : strdup(path);
    if (!w->target) return fail_file(ctx, "write", path);
    if (old && access(w->target, W_OK) != 0) return fail_file(ctx, "write", path);
    const int fd = create_beside(w->target, 0666, &w->temporary);
    if (fd < 0) return fail_file(ctx, "write", path);
    if (old) (void)!fchmod(fd, old->st_mode & 07777);
    w->file = fdopen(fd, "w");
    if (w->file) return ISO_OK;
    close(fd);
    unlink(w->temporary);
    return fail_file(ctx, "write", path);
}

static iso_status open_direct(iso_context *ctx, iso_trajectory_writer *w, const char *path)
{
    w->target = strdup(path);
    if (!w->target) return no_memory(ctx);
    const int fd = open(path, O_WRONLY | O_APPEND | O_CLOEXEC);
    if (fd >= 0 && (w->file = fdopen(fd, "a"))) return ISO_OK;
    const iso_status status = fail_file(ctx, "write", path);
    if (fd >= 0) close(fd);
    return status;
}

static iso_status open_stdout(iso_context *ctx, iso_trajectory_writer *w)
{
    w->file = stdout;
    w->target = strdup("<stdout>");
    return w->target ? ISO_OK : no_memory(ctx);
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
        status = open_stdout(ctx, w);
    else
        status = is_direct(path, known) ? open_direct(ctx, w, path) : open_regular(ctx, w, path, known);
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
    return fail_file(ctx, "write", w->target);
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
                                    w->target, w->names[i]);
    for (size_t i = 0; i < count; i++) {
        const int length = iso_number_print(text, row[i]);
        fwrite(text, 1, (size_t)length, w->file);
        fputc(i + 1 < count ? ',' : '\n', w->file);
    }
    w->rows++;
    return check_written(ctx, w);
}

/* ---- Closing ---- */

/* The name is on the disk only when the folder is; folders that cannot be opened or synchronised are left be. */
static void sync_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    const int fd = folder ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (fd >= 0) {
        (void)!fsync(fd);
        close(fd);
    }
    free(folder);
}

static iso_status flush(iso_context *ctx, iso_trajectory_writer *w)
{
    const iso_status status = check_written(ctx, w);
    if (status != ISO_OK) return status;
    return fflush(w->file) == 0 ? ISO_OK : fail_file(ctx, "write", w->target);
}

static iso_status close_regular(iso_context *ctx, iso_trajectory_writer *w, bool keep)
{
    iso_status status = keep ? flush(ctx, w) : ISO_OK;
    if (keep && status == ISO_OK && fsync(fileno(w->file)) != 0) status = fail_file(ctx, "write", w->target);
    if (fclose(w->file) != 0 && keep && status == ISO_OK) status = fail_file(ctx, "write", w->target);
    if (keep && status == ISO_OK && rename(w->temporary, w->target) != 0)
        status = fail_file(ctx, "rename", w->target);
    if (keep && status == ISO_OK)
        sync_folder(w->target);
    else
        unlink(w->temporary);
    return status;
}

static iso_status close_direct(iso_context *ctx, iso_trajectory_writer *w)
{
    const iso_status status = flush(ctx, w);
    if (w->file == stdout || fclose(w->file) == 0 || status != ISO_OK) return status;
    return fail_file(ctx, "write", w->target);
}

iso_status iso_trajectory_close(iso_context *ctx, iso_trajectory_writer *w, bool keep)
{
    if (!w) return ISO_OK;
    const iso_status status = w->temporary ? close_regular(ctx, w, keep) : close_direct(ctx, w);
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
