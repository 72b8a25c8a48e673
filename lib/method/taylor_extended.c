/* taylor_extended.c - Taylor series in long double: on x86 64 bits of mantissa, a reference for the others. */
#define NUMBER long double
#define ROOT sqrtl
#define POW powl
#define FMA fmal
#define EPSILON LDBL_EPSILON
#define FINER 1e-4 /* the tolerance is that of doubles: terms are kept to what is beyond them */
#define FINEST_ORDER 34
#define NODES 12
#define LANES 1

#include "method/taylor_single_impl.h"

const iso_taylor_code iso_taylor_extended = {create, start, step, within};
