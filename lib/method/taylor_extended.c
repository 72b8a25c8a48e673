/* taylor_extended.c - Taylor series in long double: on x86 64 bits of mantissa, a reference for the others. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "method/taylor_impl.h"

#define REAL          long double
#define ROOT          sqrtl
#define LOG           logl
#define EXP           expl
#define FMA           fmal
#define FABS          fabsl
#define EPSILON       LDBL_EPSILON
#define TAYLOR_FINER  1e-4 /* the tolerance is that of doubles: terms are kept to what is beyond them */
#define NAME(x)       extended_##x

enum { TAYLOR_MOST = 36 };

#include "method/taylor_kernel_impl.h"
#include "method/taylor_method_impl.h"

const iso_taylor_code iso_taylor_extended = {extended_create, extended_start, extended_step, extended_within};
