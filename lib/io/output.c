/* output.c - writes files: FILE.part beside FILE, which takes its place when it is complete. */
#include "io/output_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

struct iso_output {
    FILE *file;
    char *target; /* the name it is to have, links followed; NULL: standard output  */
    char *part;   /* the name until then; NULL: it is written as it is              */
    bool resumes; /* its part outlives failures and signals                         */
    bool fresh;   /* a file that has the name by then is not replaced               */
    int error;    /* errno of the first failed write: a later one may say less      */
};

iso_status iso_file_trouble(iso_context *ctx, const char *what, const char *path)
{
    enum { SHOWN = 400 }; /* its end: the reason must have room behind it */
    const size_t length = strlen(path);
    return iso_context_fail(ctx, errno == EPIPE ? ISO_CLOSED_PIPE : ISO_FILE_TROUBLE, "", "cannot %s '%s%s': %s",
                            what, length > SHOWN ? "..." : "", length > SHOWN ? path + length - SHOWN : path,
                            strerror(errno));
}

/* --- names ------------------------------------------------------------------------------------------------------ */

/* The first characters of `a`, then `b`. NULL with errno set: no memory. */
static char *join(const char *a, size_t length, const char *b)
{
    char *text = malloc(length + strlen(b) + 1);
    if (text) strcpy((char *)memcpy(text, a, length) + length, b);
    return text;
}

static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash + 1 - path) : 0;
}

/* Whether it is another name of a stream that is already open: /dev/stdout, /dev/fd/3. */
static bool is_stream(const char *path)
{
    return strncmp(path, "/dev/std", 8) == 0 || strncmp(path, "/dev/fd/", 8) == 0 || strncmp(path, "/proc/", 6) == 0;
}

char *iso_file_follow(const char *path)
{
    enum { MOST_LINKS = 40 }; /* as Linux follows */
    char *at = join(path, strlen(path), ""), end[PATH_MAX + 1];
    for (int links = 0; at && !is_stream(at); links++) {
        const ssize_t length = readlink(at, end, PATH_MAX);
        if (length < 0 && (errno == EINVAL || errno == ENOENT)) return at; /* no link */
        const int error = length < 0 ? errno : length == PATH_MAX ? ENAMETOOLONG : links == MOST_LINKS ? ELOOP : 0;
        end[length < 0 ? 0 : length] = '\0';
        char *next = error ? NULL : join(at, *end == '/' ? 0 : folder_length(at), end); /* seen from its folder */
        free(at);
        if (error) errno = error;
        at = next;
    }
    return at;
}

/* FILE.part. Where that would be too long a name, FILE loses its end. */
static char *part_of(const char *target)
{
    enum { MOST = NAME_MAX - 5 };
    const size_t folder = folder_length(target), own = strlen(target) - folder;
    return join(target, folder + (own < MOST ? own : MOST), ".part");
}

char *iso_file_part(const char *path)
{
    char *target = iso_file_follow(path), *name = target ? part_of(target) : NULL;
    free(target);
    return name;
}

/* --- what a signal unlinks -------------------------------------------------------------------------------------- */

static _Atomic(const char *) parts[64];

static void exchange(const char *from, const char *to)
{
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (atomic_compare_exchange_strong(&parts[i], &(const char *){from}, to)) return;
}

void iso_output_unlink_all(void)
{
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const char *name = atomic_exchange(&parts[i], NULL);
        if (name) unlink(name);
    }
}

/* --- opening ---------------------------------------------------------------------------------------------------- */

/* Opens a file for reading and writing, or makes it, and locks it; it is not followed if it is a link. -1 with errno
 * set: EWOULDBLOCK, another program has it. Who had the lock may have renamed or removed its file in between: then the
 * name is opened again. */
static int open_locked(const char *name)
{
    for (;;) {
        struct stat file, named;
        const int fd = open(name, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
        if (fd < 0) return -1;
        const bool held = flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; /* no locks here: goes on */
        if (!held && fstat(fd, &file) == 0 && stat(name, &named) == 0 && file.st_dev == named.st_dev &&
            file.st_ino == named.st_ino)
            return fd;
        close(fd);
        if (held) return errno = EWOULDBLOCK, -1;
    }
}

/* The part, empty unless it is resumed, with the permissions of the old file. -1: errno says why. */
static int open_part(const iso_output *out, const struct stat *old)
{
    struct stat s = {.st_mode = S_IFREG};
    if (old && access(out->target, W_OK) != 0) return -1;
    const int fd = open_locked(out->part);
    if (fd >= 0 && fstat(fd, &s) == 0 && S_ISREG(s.st_mode) && (out->resumes || ftruncate(fd, 0) == 0)) {
        if (old) (void)!fchmod(fd, old->st_mode & 07777);
        if (!out->resumes) exchange(NULL, out->part);
        return fd;
    }
    const int error = fd >= 0 && !S_ISREG(s.st_mode) ? EEXIST : errno;
    if (fd >= 0) close(fd), errno = error;
    return -1;
}

/* The reason is in errno. */
static iso_status fail_to_open(iso_context *ctx, const iso_output *out, const char *path)
{
    struct stat s;
    const int error = errno;
    const char *name = !out->part ? path : lstat(out->part, &s) == 0 ? out->part : out->target;
    errno = error;
    if (error != EWOULDBLOCK || !out->part) return iso_file_trouble(ctx, "write", name);
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s' is in use: another program writes '%s'", name,
                            out->target);
}

/* regular: what is no regular file is refused; else it is written as it is, as are other names of open streams. */
static iso_status open_file(iso_context *ctx, const char *path, bool regular, iso_output *out)
{
    struct stat old;
    const bool exists = stat(path, &old) == 0, special = exists && !S_ISREG(old.st_mode);
    if (regular && special)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot write '%s': it is not a regular file", path);
    out->target = iso_file_follow(path);
    int fd = -1;
    if (!regular && (special || (out->target && is_stream(out->target)))) {
        free(out->target);
        out->target = strdup(path);
        if (out->target) fd = open(path, O_WRONLY | O_APPEND | O_CLOEXEC);
    } else if (out->target) {
        out->part = part_of(out->target);
        if (out->part) fd = open_part(out, exists ? &old : NULL);
    }
    if (fd >= 0) out->file = fdopen(fd, out->part ? "w" : "a");
    if (out->file) return ISO_OK;
    const iso_status status = fail_to_open(ctx, out, path);
    if (fd < 0) return status;
    if (out->part && !out->resumes) exchange(out->part, NULL), unlink(out->part);
    close(fd);
    return status;
}

static void release(iso_output *out)
{
    free(out->target);
    free(out->part);
    free(out);
}

static iso_status open_output(iso_context *ctx, const char *path, bool regular, bool resumes, iso_output **answer)
{
    iso_output *out = *answer = calloc(1, sizeof *out);
    if (!out) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write a file");
    out->resumes = resumes;
    if (strcmp(path, "-") == 0) return out->file = stdout, ISO_OK;
    const iso_status status = open_file(ctx, path, regular, out);
    if (status != ISO_OK) release(out), *answer = NULL;
    return status;
}

iso_status iso_output_open(iso_context *ctx, const char *path, iso_output **out)
{
    return open_output(ctx, path, false, false, out);
}

iso_status iso_output_open_regular(iso_context *ctx, const char *path, bool resumes, iso_output **out)
{
    return open_output(ctx, path, true, resumes, out);
}

/* --- writing ---------------------------------------------------------------------------------------------------- */

FILE *iso_output_stream(iso_output *out)
{
    return out->file;
}

const char *iso_output_name(const iso_output *out)
{
    return out->resumes ? out->part : out->target ? out->target : "<stdout>";
}

const char *iso_output_part(const iso_output *out)
{
    return out->part;
}

void iso_output_keep_others(iso_output *out)
{
    out->fresh = true;
}

static iso_status trouble(iso_context *ctx, const iso_output *out)
{
    return iso_file_trouble(ctx, "write", iso_output_name(out));
}

iso_status iso_output_check(iso_context *ctx, iso_output *out)
{
    if (!ferror(out->file)) return ISO_OK;
    if (out->error == 0) out->error = errno;
    errno = out->error;
    return trouble(ctx, out);
}

iso_status iso_output_copy(iso_context *ctx, iso_output *out, FILE *from)
{
    char block[1 << 14];
    if (fflush(from) == EOF || fseek(from, 0, SEEK_SET) != 0)
        return iso_file_trouble(ctx, "write", "a temporary file");
    for (size_t length; (length = fread(block, 1, sizeof block, from)) > 0;)
        if (fwrite(block, 1, length, out->file) < length) break;
    return ferror(from) ? iso_file_trouble(ctx, "read", "a temporary file") : iso_output_check(ctx, out);
}

iso_status iso_output_cut(iso_context *ctx, iso_output *out, size_t length)
{
    if (ftruncate(fileno(out->file), (off_t)length) == 0 && fseek(out->file, 0, SEEK_END) == 0) return ISO_OK;
    return trouble(ctx, out);
}

/* --- closing ---------------------------------------------------------------------------------------------------- */

static iso_status rename_part(iso_context *ctx, const iso_output *out)
{
    struct stat s;
    if (fsync(fileno(out->file)) != 0) return iso_file_trouble(ctx, "write", out->target);
    if (out->fresh && lstat(out->target, &s) == 0)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s' has appeared: it is not overwritten", out->target);
    if (rename(out->part, out->target) != 0) return iso_file_trouble(ctx, "rename", out->target);
    out->target[folder_length(out->target)] = '\0'; /* the name is on the disk only when its folder is */
    const int folder = open(*out->target ? out->target : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return ISO_OK;
    (void)!fsync(folder);
    close(folder);
    return ISO_OK;
}

iso_status iso_output_close(iso_context *ctx, iso_output *out, bool keep)
{
    if (!out) return ISO_OK;
    iso_status status = keep || !out->part ? iso_output_check(ctx, out) : ISO_OK;
    if ((keep || !out->part) && status == ISO_OK && fflush(out->file) != 0) status = trouble(ctx, out);
    if (out->part && !out->resumes) exchange(out->part, NULL); /* once renamed, it may be another program's */
    if (out->part && keep && status == ISO_OK) status = rename_part(ctx, out);
    if (out->part && !out->resumes && (!keep || status != ISO_OK)) unlink(out->part);
    if (out->file != stdout && fclose(out->file) != 0 && !out->part && status == ISO_OK) status = trouble(ctx, out);
    release(out);
    return status;
}
