/* variant.c - the code of the Taylor methods, compiled once for each kind of number and vector.
 *
 * The build (CMakeLists.txt) sets FOR_role and IN_numbers. Of role single is an iso_method for one orbit (method.c).
 * Lanes and tangent are an iso_lane_build, for batches and crossings (lanes.c), with an orbit in each lane of a vector;
 * tangent computes two deviations beside each orbit. tail is an iso_tail_build: tangent's higher coefficients, for
 * numbers of more digits (tail_impl.h). All project and system headers come before the macros of numbers, so that these
 * reach only the series. They end with this file.
 *
 *     numbers               orbits side by side
 *     plain      double     1 or 2   any processor: all have vectors of two doubles, or do without
 *     avx2       double     1 or 4   x86 with AVX2 and FMA; of one orbit three components share a register of four
 *     avx512     double     8        x86 with AVX-512
 *     extended   long double  1      a reference: 64 bits of mantissa on x86
 *     quad       128 bits   1        for references, where compiler and C library have it
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include <float.h>

#include "base/math_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "method/taylor/code_impl.h"
#include "method/taylor/lanes_impl.h"
#include "method/taylor/tail_impl.h"
#include "model/model_impl.h"

#if !defined IN_QUAD || defined ISO_TAYLOR_HAS_QUAD

/* --- the numbers ------------------------------------------------------------------------------------------------ */

#if defined IN_EXTENDED
#define CODE extended
#define WIDTH 1
#define NUMBER long double
#define ROOT sqrtl
#define POW powl
#define FMA fmal
#define ABS fabsl
#define EXP expl
#define LOG logl
#define SIN sinl
#define COS cosl
#define ATAN2 atan2l
#define EPSILON LDBL_EPSILON
#define ROUNDING LDBL_EPSILON /* of one operation on numbers that come and go as two doubles */
#define FINER 1e-4            /* the tolerance is that of doubles: terms are kept to what is beyond them */
#define FINEST_ORDER 34
#define NODES 12
#if LDBL_MANT_DIG == 64
#define SPLIT (0x1p32L + 1) /* see lost_in */
#endif
#elif defined IN_QUAD
#define CODE quad
#define WIDTH 1
__extension__ typedef _Float128 number_of_128_bits;
#define NUMBER number_of_128_bits
#define ROOT sqrtf128
#define POW powf128
#define FMA fmaf128
#define ABS fabsf128
#define EXP expf128
#define LOG logf128
#define SIN sinf128
#define COS cosf128
#define ATAN2 atan2f128
#define EPSILON 0x1p-112
#define ROUNDING 0x1p-106
#define FINER 1e-15
#define FINEST_ORDER 52
#define NODES 20
#else
#include "model/series/double_impl.h"
#if defined IN_AVX512
#define CODE avx512
#define WIDTH 8
#elif defined IN_AVX2
#define CODE avx2
#define WIDTH 4
#else
#define CODE plain
#define WIDTH 2
#endif
#define EPSILON DBL_EPSILON
#define FINER 1
#ifdef FOR_TAIL
#define FINEST_ORDER ISO_TAIL_ORDER
#else
#define FINEST_ORDER 28
#endif
#define NODES 8
#endif

#if defined FOR_SINGLE || defined FOR_TAIL
#define LANES 1
#else
#define LANES WIDTH
#endif

#if defined FOR_TANGENT || defined FOR_TAIL
#define CHANNELS 3
#endif

#if LANES == 1 && !defined IN_EXTENDED && !defined IN_QUAD
#define PACKED
#endif

#ifdef IN_EXTENDED
#define APART
#endif

#if LANES > 2 && defined FOR_LANES
#define WRITTEN
#endif

/* --- the code --------------------------------------------------------------------------------------------------- */

#define JOIN(a, b) a##b
#define NAME(family, code) JOIN(family, code)
#define TEXT(code) #code
#define NAME_OF(code) TEXT(code)

#if defined FOR_SINGLE
#include "method/taylor/single_impl.h"

#if defined IN_PLAIN
#define TAYLOR ISO_TAYLOR_ROW("taylor", "Taylor series by recurrences, order 6-28 from the tolerance"), SINGLE
const iso_method iso_method_taylor = {TAYLOR, .create = iso_taylor_create, .suits = iso_taylor_suits};
const iso_method iso_taylor_plain = {TAYLOR, .create = create};
#elif defined IN_AVX2
const iso_method iso_taylor_avx2 = {ISO_TAYLOR_ROW("taylor", ""), SINGLE, .create = create};
#elif defined IN_EXTENDED
const iso_method iso_method_taylor_extended = {
    ISO_TAYLOR_ROW("taylor_extended", "the same in long double, a reference for the others"), SINGLE,
    .create = create, .digits = 19};
#else
const iso_method iso_method_taylor_quad = {ISO_TAYLOR_ROW("taylor_quad", "the same in numbers of 128 bits, slow"),
                                           SINGLE, .create = create, .digits = 34, .reference = true};
#endif

#elif defined FOR_TAIL
#include "method/taylor/tail_code_impl.h"

const iso_tail_build NAME(iso_tail_, CODE) = {create_tail, expand_tail};

#else
#include "method/taylor/crew_impl.h"

static bool runs_here(void)
{
#if LANES == 8
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma");
#elif LANES == 4
    return iso_taylor_has_avx2();
#else
    return true;
#endif
}

#ifdef FOR_LANES
const iso_lane_build NAME(iso_lanes_, CODE) = {NAME_OF(CODE), LANES, 0, sizeof(saved_lane), runs_here, solve};
#else
const iso_lane_build NAME(iso_tangent_, CODE) = {NAME_OF(CODE),      LANES,     ISO_LANE_DEVIATIONS,
                                                 sizeof(saved_lane), runs_here, solve};
#if LANES == 1
#include "method/taylor/return_impl.h"

const iso_return_build NAME(iso_return_, CODE) = {ROUNDING, go};
#endif
#endif
#endif

#endif
