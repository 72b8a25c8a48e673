/* resources_impl.h - memory that is left, processor time that was used. */
#ifndef ISO_BASE_RESOURCES_IMPL_H
#define ISO_BASE_RESOURCES_IMPL_H

#include <stdbool.h>
#include <time.h>

/* Whether 64 kB can be had: more than SUNDIALS or GSL takes at once, to be set up or for a step.
 *
 * SUNDIALS 6.4.1 and GSL 2.7.1 crash when a malloc of their own fails (in N_VClone, SUNMatClone,
 * gsl_odeiv2_control_init, gsl_linalg_LU_decomp, ...). So the library asks first, and answers ISO_NO_MEMORY. It asks
 * where they are set up, and where a call of the library takes the first step of an implicit method of GSL; never in
 * every step. This cannot help where another thread takes the memory in between: then the process ends. */
bool iso_room(void);

/* Processor time of this thread, to say how long something took. (The clock of the whole process counts in milliseconds
 * where a limit of time has been set by ulimit -t or ITIMER_PROF.) */
static inline double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
