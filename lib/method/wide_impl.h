/* wide_impl.h - numbers of 113 bits where the compiler has them, else of 64 bits; and head + tail
 * (return_map_impl.h).
 */
#ifndef ISO_METHOD_WIDE_IMPL_H
#define ISO_METHOD_WIDE_IMPL_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/math_impl.h"
#include "method/methods_impl.h"
#include "method/taylor/return_map_impl.h"

#ifdef ISO_TAYLOR_HAS_QUAD
__extension__ typedef _Float128 iso_wide;
#define WIDE_ROOT sqrtf128
#define WIDE_COS cosf128
#define WIDE_SIN sinf128
#define WIDE_POW powf128
#define WIDE_ABS fabsf128
#define WIDE_ROUND roundf128
#define WIDE_RETURN (&iso_return_quad)
#define WIDE_PI __extension__ 3.14159265358979323846264338327950288419716939937510582097494459Q
#else
typedef long double iso_wide;
#define WIDE_ROOT sqrtl
#define WIDE_COS cosl
#define WIDE_SIN sinl
#define WIDE_POW powl
#define WIDE_ABS fabsl
#define WIDE_ROUND roundl
#define WIDE_RETURN NULL
#define WIDE_PI ISO_PI_LONG
#endif

/* The return map in numbers of 64 bits; `fine`: of 128 bits, NULL where the compiler has none. */
static inline const iso_return_build *iso_return_build_of(bool fine)
{
    return fine ? WIDE_RETURN : &iso_return_extended;
}

static inline iso_fine iso_fine_of(iso_wide x)
{
    const double head = (double)x;
    return (iso_fine){head, (double)(x - (iso_wide)head)};
}

static inline iso_wide iso_wide_of(iso_fine x)
{
    return (iso_wide)x.head + (iso_wide)x.tail;
}

/* angle, less a multiple of period, into [-period/2, period/2]. */
static inline iso_wide iso_wide_wrap(iso_wide angle, iso_wide period)
{
    return angle - WIDE_ROUND(angle / period) * period;
}

/* product = A B. The product is neither A nor B. */
static inline void iso_wide_multiply(const iso_wide A[2][2], const iso_wide B[2][2], iso_wide product[2][2])
{
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) product[i][j] = A[i][0] * B[0][j] + A[i][1] * B[1][j];
}

#endif
