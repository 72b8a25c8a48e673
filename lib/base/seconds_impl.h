/* seconds_impl.h - processor time of this thread, to say how long something took. (The clock of the whole process
 * counts in milliseconds where a limit of time has been set by ulimit -t or ITIMER_PROF.) */
#ifndef ISO_BASE_SECONDS_IMPL_H
#define ISO_BASE_SECONDS_IMPL_H

#include <time.h>

static inline double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
