/* replacement.c - writes FILE.part beside FILE, which takes its place when it is complete. */
#include "io/replacement_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

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

char *iso_file_follow(const char *path)
{
    enum { MOST_LINKS = 40 }; /* as Linux follows */
    char *at = join(path, strlen(path), ""), end[PATH_MAX + 1];
    for (int links = 0; at && !iso_file_is_stream(at); links++) {
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

bool iso_file_is_stream(const char *path)
{
    return strncmp(path, "/dev/std", 8) == 0 || strncmp(path, "/dev/fd/", 8) == 0 || strncmp(path, "/proc/", 6) == 0;
}

/* FILE.part. Where that would be too long a name, FILE loses its end. */
static char *part_of(const char *target)
{
    enum { MOST = NAME_MAX - 5 };
    const size_t folder = folder_length(target), own = strlen(target) - folder;
    return join(target, folder + (own < MOST ? own : MOST), ".part");
}

char *iso_replacement_name(const char *path)
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

void iso_replacement_unlink_all(void)
{
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const char *name = atomic_exchange(&parts[i], NULL);
        if (name) unlink(name);
    }
}

/* --- the file --------------------------------------------------------------------------------------------------- */

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

static void release(iso_replacement *r)
{
    free(r->target);
    free(r->temporary);
    *r = (iso_replacement){0};
}

/* Empty, if it does not stay, with the permissions of the old file. -1: errno says why. */
static int create(const iso_replacement *r, const struct stat *old)
{
    struct stat s = {.st_mode = S_IFREG};
    if (old && access(r->target, W_OK) != 0) return -1;
    const int fd = open_locked(r->temporary);
    if (fd >= 0 && fstat(fd, &s) == 0 && S_ISREG(s.st_mode) && (r->stays || ftruncate(fd, 0) == 0)) {
        if (old) (void)!fchmod(fd, old->st_mode & 07777);
        if (!r->stays) exchange(NULL, r->temporary);
        return fd;
    }
    const int error = fd >= 0 && !S_ISREG(s.st_mode) ? EEXIST : errno;
    if (fd >= 0) close(fd), errno = error;
    return -1;
}

iso_status iso_replacement_open(iso_context *ctx, const char *path, bool stays, iso_replacement *r, int *descriptor)
{
    struct stat old;
    const bool exists = stat(path, &old) == 0;
    *descriptor = -1;
    *r = (iso_replacement){.stays = stays};
    if (exists && !S_ISREG(old.st_mode))
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot write '%s': it is not a regular file", path);
    r->target = iso_file_follow(path);
    r->temporary = r->target ? part_of(r->target) : NULL;
    if (r->temporary) *descriptor = create(r, exists ? &old : NULL);
    if (*descriptor >= 0) return ISO_OK;
    const int error = errno;
    const char *name = !r->temporary ? path : lstat(r->temporary, &old) == 0 ? r->temporary : r->target;
    errno = error;
    const iso_status status = error == EWOULDBLOCK
                                  ? iso_context_fail(ctx, ISO_FILE_TROUBLE, "",
                                                     "'%s' is in use: another program writes '%s'", name, r->target)
                                  : iso_file_trouble(ctx, "write", name);
    release(r);
    return status;
}

static iso_status give_name(iso_context *ctx, const iso_replacement *r, int descriptor)
{
    struct stat s;
    if (fsync(descriptor) != 0) return iso_file_trouble(ctx, "write", r->target);
    if (r->fresh && lstat(r->target, &s) == 0)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s' has appeared: it is not overwritten", r->target);
    if (rename(r->temporary, r->target) != 0) return iso_file_trouble(ctx, "rename", r->target);
    r->target[folder_length(r->target)] = '\0'; /* the name is on the disk only when its folder is */
    const int folder = open(*r->target ? r->target : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return ISO_OK;
    (void)!fsync(folder);
    close(folder);
    return ISO_OK;
}

iso_status iso_replacement_close(iso_context *ctx, iso_replacement *r, int descriptor, bool keep)
{
    if (!r->stays) exchange(r->temporary, NULL); /* from the renaming on, the name may be another program's */
    const iso_status status = keep ? give_name(ctx, r, descriptor) : ISO_OK;
    if (!r->stays && (!keep || status != ISO_OK)) unlink(r->temporary);
    release(r);
    return status;
}
