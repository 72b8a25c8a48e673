/* taylor_plain.c - Taylor series in double precision, for any processor. */
#define NUMBER double
#define ROOT sqrt
#define LOG log
#define EXP exp
#define FMA fma
#define EPSILON DBL_EPSILON
#define FINER 1
#define FINEST_ORDER 32
#define NODES 8
#define LANES 1
#define PACKED

#include "method/taylor_single_impl.h"

const iso_taylor_code iso_taylor_plain = {create, start, step, within};
