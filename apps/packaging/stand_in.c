/* stand_in.c - two functions for the library and the command of a wheel (wheel.cmake), and for nothing else. */
#include <stdlib.h>

/* GSL calls this if it finds a wrong argument in its own calls of BLAS. Debian's libgslcblas.a has one that cannot be
 * part of a shared library: it was compiled without -fPIC and names stderr. That one ends the program as well. */
void cblas_xerbla(int argument, const char *function, const char *format, ...);
void cblas_xerbla(int argument, const char *function, const char *format, ...)
{
    (void)argument, (void)function, (void)format;
    abort();
}

/* glibc 2.35 gave hypot a new version, and a program linked with it starts nowhere else. It is the only function that
 * needs 2.35; the others need 2.34. So calls of hypot go to its first version (-Wl,--wrap=hypot), which has the same
 * values: the two only set errno in different ways. */
#if defined __x86_64__ && defined __GLIBC__
double iso_first_hypot(double x, double y);
__asm__(".symver iso_first_hypot, hypot@GLIBC_2.2.5");

double __wrap_hypot(double x, double y);
double __wrap_hypot(double x, double y)
{
    return iso_first_hypot(x, y);
}
#endif
