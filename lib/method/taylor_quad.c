/* taylor_quad.c - Taylor series in 113 bits of mantissa, where compiler and C library have such numbers: a reference
 * for the references. Software arithmetic: some hundred times slower. */
#include "method/methods_impl.h"
#include "method/taylor_impl.h"

#ifdef ISO_TAYLOR_HAS_QUAD
__extension__ typedef _Float128 quad;

#define NUMBER quad
#define ROOT sqrtf128
#define POW powf128
#define FMA fmaf128
#define EPSILON 0x1p-112
#define FINER 1e-15 /* the tolerance is that of doubles */
#define FINEST_ORDER 52
#define NODES 20
#define LANES 1

#include "method/taylor_single_impl.h"

const iso_taylor_code iso_taylor_quad = {create, start, step, within};
#else
const iso_taylor_code iso_taylor_quad = {NULL, NULL, NULL, NULL};
#endif
