/* replacement.c - writes a file beside the one it replaces, and renames it when it is complete. */
#define _GNU_SOURCE /* asprintf */
#include "io/replacement_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
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

static void release(iso_replacement *r)
{
    free(r->target);
    free(r->temporary);
    *r = (iso_replacement){0};
}

/* A name in the folder of `target` that was not there, and its descriptor; -1 with errno set. */
static int create_beside(const char *target, char **name)
{
    const char *slash = strrchr(target, '/');
    const int folder = slash ? (int)(slash - target) + 1 : 0;
    for (int i = 0; i < 1000; i++) {
        if (asprintf(name, "%.*s.isoroll-%ld-%d.tmp", folder, target, (long)getpid(), i) < 0) {
            *name = NULL;
            errno = ENOMEM;
            return -1;
        }
        const int fd = open(*name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0) return fd;
        free(*name);
        *name = NULL;
        if (errno != EEXIST) return -1;
    }
    return -1;
}

iso_status iso_replacement_open(iso_context *ctx, const char *path, iso_replacement *r, int *descriptor)
{
    struct stat old;
    const bool exists = stat(path, &old) == 0;
    *r = (iso_replacement){.target = exists ? realpath(path, NULL) : strdup(path)};
    *descriptor = -1;
    if (r->target && (!exists || access(r->target, W_OK) == 0)) *descriptor = create_beside(r->target, &r->temporary);
    if (*descriptor >= 0) {
        if (exists) (void)!fchmod(*descriptor, old.st_mode & 07777);
        return ISO_OK;
    }
    const iso_status status = iso_file_trouble(ctx, "write", path);
    release(r);
    return status;
}

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

static iso_status give_name(iso_context *ctx, const iso_replacement *r)
{
    if ((r->fresh ? name_fresh : rename)(r->temporary, r->target) == 0) return ISO_OK;
    if (r->fresh && errno == EEXIST)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s' has appeared: it is not overwritten", r->target);
    return iso_file_trouble(ctx, "rename", r->target);
}

iso_status iso_replacement_close(iso_context *ctx, iso_replacement *r, int descriptor, bool keep)
{
    iso_status status = ISO_OK;
    if (keep && fsync(descriptor) != 0) status = iso_file_trouble(ctx, "write", r->target);
    if (keep && status == ISO_OK) status = give_name(ctx, r);
    if (keep && status == ISO_OK)
        sync_folder(r->target);
    else
        unlink(r->temporary);
    release(r);
    return status;
}
