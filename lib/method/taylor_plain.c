/* taylor_plain.c - Taylor series in double precision, for any processor. */
#define NAME(x) plain_##x
#include "method/taylor_double_impl.h"

const iso_taylor_code iso_taylor_plain = {plain_create, plain_start, plain_step, plain_within};
