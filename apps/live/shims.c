/* shims.c - what the C library of emscripten lacks. Without threads pthread_create fails, and a pool works alone. */
#define _GNU_SOURCE
#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <sys/file.h>
#include <unistd.h>

int sched_getaffinity(pid_t pid, size_t size, cpu_set_t *set)
{
    (void)pid, (void)size, (void)set;
    return -1; /* one processor */
}

int pthread_timedjoin_np(pthread_t thread, void **result, const struct timespec *until)
{
    (void)thread, (void)result, (void)until;
    return EINVAL; /* there is no thread */
}

int __sched_cpucount(size_t size, const cpu_set_t *set)
{
    (void)size, (void)set;
    return 1;
}

int flock(int fd, int operation)
{
    (void)fd, (void)operation;
    return 0; /* nobody else is there */
}
