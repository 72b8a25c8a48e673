/* no_unnamed.c - a library for LD_PRELOAD, for hard_faults.sh:
 *
 *     ISO_UNNAMED=no     this file system has no files without names (O_TMPFILE)
 *     ISO_RENAME=kill    the program is killed where it would rename a file
 */
#define _GNU_SOURCE /* O_TMPFILE, RTLD_NEXT */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool is_set(const char *name, const char *value)
{
    const char *now = getenv(name);
    return now && strcmp(now, value) == 0;
}

int open(const char *path, int flags, ...)
{
    int (*real)(const char *, int, ...);
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t); /* not used where there is none */
    va_end(rest);
    *(void **)&real = dlsym(RTLD_NEXT, "open");
    if ((flags & O_TMPFILE) == O_TMPFILE && is_set("ISO_UNNAMED", "no")) return errno = EOPNOTSUPP, -1;
    return real(path, flags, mode);
}

int rename(const char *from, const char *to)
{
    int (*real)(const char *, const char *);
    *(void **)&real = dlsym(RTLD_NEXT, "rename");
    if (is_set("ISO_RENAME", "kill")) kill(getpid(), SIGKILL);
    return real(from, to);
}
