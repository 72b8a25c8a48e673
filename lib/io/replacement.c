/* replacement.c - writes a file that has no name, or one beside the file it replaces, and names it when it is
 * complete.
 *
 * A file without a name is gone when its program is, killed or not. A file needs a name beside its target where the
 * file system has no unnamed files, for HDF5, and for the moment of replacing an older file. Such names are few for
 * each target and machine, and who writes a file holds its lock. So the next program that writes the same target
 * meets what a killed one has left, and knows by the lock that nobody writes it any more. Where files cannot be
 * locked, nothing is removed.
 */
#define _GNU_SOURCE /* asprintf, O_TMPFILE, F_OFD_SETLK, renameat2 */
#include "io/replacement_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/low_discrepancy_impl.h"

enum {
    MOST_NAMES = 1000, /* for programs that write one target at once */
    OLD_NAMES = 8      /* those at which leftovers are looked for    */
};

iso_status iso_file_trouble(iso_context *ctx, const char *what, const char *path)
{
    enum { SHOWN = 400 }; /* its end: the reason must have room behind it */
    const size_t length = strlen(path);
    return iso_context_fail(ctx, errno == EPIPE ? ISO_CLOSED_PIPE : ISO_FILE_TROUBLE, "", "cannot %s '%s%s': %s",
                            what, length > SHOWN ? "..." : "", length > SHOWN ? path + length - SHOWN : path,
                            strerror(errno));
}

static void release(iso_replacement *r)
{
    free(r->target);
    free(r->temporary);
    *r = (iso_replacement){0};
}

/* --- names beside the target ------------------------------------------------------------------------------------ */

/* Where the last part of a path begins. */
static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static uint64_t sum_of(const char *text, uint64_t salt)
{
    for (; *text; text++) salt = iso_scatter(salt ^ (unsigned char)*text);
    return salt;
}

/* Name number i. Other machines have other names: their locks may not be seen here. NULL: no memory. */
static char *name_beside(const char *target, int i)
{
    char machine[256] = "", *name;
    const char *own = last_part(target);
    (void)!gethostname(machine, sizeof machine - 1);
    const uint64_t sum = sum_of(own, sum_of(machine, 0));
    if (asprintf(&name, "%.*s.isoroll-%016" PRIx64 "-%d.tmp", (int)(own - target), target, sum, i) >= 0) return name;
    errno = ENOMEM;
    return NULL;
}

bool iso_file_has_name(int descriptor, const char *name)
{
    struct stat file, named;
    return fstat(descriptor, &file) == 0 && stat(name, &named) == 0 && file.st_dev == named.st_dev &&
           file.st_ino == named.st_ino;
}

/* The lock ends with the program. HDF5 has locks of another kind, which do not count here. */
static bool lock(int descriptor)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    return fcntl(descriptor, F_OFD_SETLK, &whole) == 0;
}

/* Who has the lock of a file with such a name may remove it. */
static void remove_dead(const char *name)
{
    struct stat s;
    const int fd = open(name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return;
    if (fstat(fd, &s) == 0 && S_ISREG(s.st_mode) && lock(fd) && iso_file_has_name(fd, name)) unlink(name);
    close(fd);
}

static void remove_leftovers(const char *target)
{
    for (int i = 0; i < OLD_NAMES; i++) {
        char *name = name_beside(target, i);
        if (name) remove_dead(name);
        free(name);
    }
}

/* A new file, locked. Before it is locked another program may take it for dead: then the name counts as taken. */
static int create_locked(const char *name)
{
    const int fd = open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0) return -1;
    const bool held = !lock(fd) && (errno == EAGAIN || errno == EACCES);
    if (!held && iso_file_has_name(fd, name)) return fd;
    close(fd);
    errno = EEXIST;
    return -1;
}

/* Finds a free name for the file that `unnamed` leads to, or for a new one if it is NULL. Returns the descriptor of a
 * new file; -1 with errno set. */
static int take_name(const char *target, const char *unnamed, char **name)
{
    for (int i = 0; i < MOST_NAMES; i++) {
        *name = name_beside(target, i);
        if (!*name) return -1;
        const int got =
            unnamed ? linkat(AT_FDCWD, unnamed, AT_FDCWD, *name, AT_SYMLINK_FOLLOW) : create_locked(*name);
        if (got >= 0) return got;
        const int error = errno;
        free(*name);
        *name = NULL;
        errno = error;
        if (error != EEXIST) return -1;
    }
    return -1;
}

/* --- opening ---------------------------------------------------------------------------------------------------- */

static char *folder_of(const char *path)
{
    const char *own = last_part(path);
    return own > path ? strndup(path, (size_t)(own - path)) : strdup(".");
}

/* A file without a name in the folder of `target`, and a path by which it can get one; -1: there is none. */
static int create_unnamed(const char *target, char **path)
{
    char *folder = folder_of(target);
    const int fd = folder ? open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666) : -1;
    free(folder);
    if (fd < 0) return -1;
    if (asprintf(path, "/proc/self/fd/%d", fd) < 0)
        *path = NULL;
    else if (access(*path, F_OK) == 0)
        return fd;
    free(*path);
    *path = NULL;
    close(fd);
    return -1;
}

static int create(iso_replacement *r, bool named)
{
    remove_leftovers(r->target);
    const int fd = named ? -1 : create_unnamed(r->target, &r->temporary);
    r->named = fd < 0;
    return r->named ? take_name(r->target, NULL, &r->temporary) : fd;
}

iso_status iso_replacement_open(iso_context *ctx, const char *path, bool named, iso_replacement *r, int *descriptor)
{
    struct stat old;
    const bool exists = stat(path, &old) == 0;
    *r = (iso_replacement){.target = exists ? realpath(path, NULL) : strdup(path)};
    *descriptor = -1;
    if (r->target && (!exists || access(r->target, W_OK) == 0)) *descriptor = create(r, named);
    if (*descriptor >= 0) {
        if (exists) (void)!fchmod(*descriptor, old.st_mode & 07777);
        return ISO_OK;
    }
    const iso_status status = iso_file_trouble(ctx, "write", path);
    release(r);
    return status;
}

/* --- closing ---------------------------------------------------------------------------------------------------- */

/* The name is on the disk only when the folder is; folders that cannot be opened or synchronised are left be. */
static void sync_folder(const char *path)
{
    char *folder = folder_of(path);
    const int fd = folder ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (fd >= 0) {
        (void)!fsync(fd);
        close(fd);
    }
    free(folder);
}

/* Gives the file its name, unless it is taken. In one step where the file system can do that, or by a second name. */
static int name_fresh(const char *temporary, const char *target)
{
    struct stat s;
#ifdef RENAME_NOREPLACE
    if (renameat2(AT_FDCWD, temporary, AT_FDCWD, target, RENAME_NOREPLACE) == 0) return 0;
    if (errno == EEXIST) return -1;
#endif
    if (link(temporary, target) == 0) return unlink(temporary), 0;
    if (errno == EEXIST) return -1;
    if (lstat(target, &s) == 0) return errno = EEXIST, -1;
    return rename(temporary, target);
}

/* A file without a name can get a free name, but not take another's place: for that it needs one of its own first. */
static int name_unnamed(iso_replacement *r, int descriptor)
{
    char *name;
    if (linkat(AT_FDCWD, r->temporary, AT_FDCWD, r->target, AT_SYMLINK_FOLLOW) == 0) return 0;
    if (errno != EEXIST || r->fresh) return -1;
    (void)!lock(descriptor);
    if (take_name(r->target, r->temporary, &name) < 0) return -1;
    free(r->temporary);
    r->temporary = name;
    r->named = true;
    return rename(name, r->target);
}

static iso_status give_name(iso_context *ctx, iso_replacement *r, int descriptor)
{
    const int done = !r->named  ? name_unnamed(r, descriptor)
                     : r->fresh ? name_fresh(r->temporary, r->target)
                                : rename(r->temporary, r->target);
    if (done == 0) return ISO_OK;
    if (r->fresh && errno == EEXIST)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s' has appeared: it is not overwritten", r->target);
    return iso_file_trouble(ctx, "rename", r->target);
}

iso_status iso_replacement_close(iso_context *ctx, iso_replacement *r, int descriptor, bool keep)
{
    iso_status status = ISO_OK;
    if (keep && fsync(descriptor) != 0) status = iso_file_trouble(ctx, "write", r->target);
    if (keep && status == ISO_OK) status = give_name(ctx, r, descriptor);
    if (keep && status == ISO_OK)
        sync_folder(r->target);
    else if (r->named)
        unlink(r->temporary);
    release(r);
    return status;
}
