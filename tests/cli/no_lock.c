/* no_lock.c - a library for LD_PRELOAD whose flock behaves as ISO_LOCK says, for sweep_files.sh:
 *
 *     none       this file system cannot lock: ENOLCK
 *     NAME       the first time, the file NAME is removed before it is locked, as by a program that finishes just then
 */
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

int flock(int descriptor, int operation)
{
    static int calls;
    int (*real)(int, int);
    const char *how = getenv("ISO_LOCK");
    *(void **)&real = dlsym(RTLD_NEXT, "flock");
    if (how && strcmp(how, "none") == 0) return errno = ENOLCK, -1;
    if (how && calls++ == 0) unlink(how);
    return real(descriptor, operation);
}
