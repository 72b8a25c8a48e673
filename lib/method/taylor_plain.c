/* taylor_plain.c - Taylor series in double precision, for any processor. */
#include "method/taylor_double_impl.h"

#define LANES 1
#define PACKED

#include "method/taylor_single_impl.h"

const iso_taylor_code iso_taylor_plain = {create, start, step, within};
