/* stand_in.c - functions for the library and the command of a wheel (wheel.cmake), and for nothing else. */
#include <stdio.h>
#include <stdlib.h>

/* GSL calls this if it finds a wrong argument in its own calls of BLAS. Debian's libgslcblas.a has one that cannot be
 * part of a shared library: it was compiled without -fPIC and names stderr. That one ends the program as well. */
void cblas_xerbla(int argument, const char *function, const char *format, ...);
void cblas_xerbla(int argument, const char *function, const char *format, ...)
{
    (void)argument, (void)function, (void)format;
    abort();
}

/* Debian 13's static SUNDIALS 7 was compiled with MPI, which a wheel cannot have. It calls MPI for a communicator
 * alone, and isoroll gives it none (SUN_COMM_NULL in base/sundials_impl.h): none of these is ever called. The three
 * objects are those of Open MPI; only their addresses are compared. */
#define NEVER_CALLED(function)                                                                                       \
    void function(void);                                                                                             \
    void function(void)                                                                                              \
    {                                                                                                                \
        abort();                                                                                                     \
    }
NEVER_CALLED(MPI_Comm_dup)
NEVER_CALLED(MPI_Comm_free)
NEVER_CALLED(MPI_Comm_rank)
NEVER_CALLED(MPI_Comm_size)
NEVER_CALLED(MPI_Op_create)
NEVER_CALLED(MPI_Op_free)
NEVER_CALLED(MPI_Reduce)
NEVER_CALLED(MPI_Type_commit)
NEVER_CALLED(MPI_Type_create_resized)
NEVER_CALLED(MPI_Type_create_struct)
NEVER_CALLED(MPI_Type_free)
NEVER_CALLED(MPI_Type_get_extent)
extern const char ompi_mpi_comm_null, ompi_mpi_double, ompi_mpi_long;
const char ompi_mpi_comm_null = 0, ompi_mpi_double = 0, ompi_mpi_long = 0;

/* Debian 13's static HDF5 can read from a server, by curl and OpenSSL. isoroll opens files alone. */
NEVER_CALLED(curl_easy_cleanup)
NEVER_CALLED(curl_easy_init)
NEVER_CALLED(curl_easy_perform)
NEVER_CALLED(curl_easy_setopt)
NEVER_CALLED(curl_global_cleanup)
NEVER_CALLED(curl_global_init)
NEVER_CALLED(curl_slist_append)
NEVER_CALLED(curl_slist_free_all)
NEVER_CALLED(EVP_sha256)
NEVER_CALLED(HMAC)
NEVER_CALLED(SHA256)

/* The static C++ library has random numbers and exceptions, which need glibc 2.36. The digits that isoroll takes from
 * it (base/digits.cpp) have neither. */
void iso_no_random(void) __asm__("arc4random"); /* by other names: glibc's headers declare the first */
void iso_no_object(void) __asm__("_dl_find_object");
NEVER_CALLED(iso_no_random)
NEVER_CALLED(iso_no_object)

/* Debian's libhdf5.a was compiled without -fPIC as well, and names stderr and stdout: it gets variables of ours
 * (-Wl,--wrap=stderr,--wrap=stdout). */
extern FILE *__real_stderr, *__real_stdout;
extern FILE *__wrap_stderr, *__wrap_stdout;
FILE *__wrap_stderr, *__wrap_stdout;

__attribute__((constructor)) static void find_streams(void)
{
    __wrap_stderr = __real_stderr;
    __wrap_stdout = __real_stdout;
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
