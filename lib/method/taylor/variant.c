/* variant.c - the code of the Taylor methods, compiled once for each kind of number and vector.
 *
 * The build (CMakeLists.txt) sets ISO_TAYLOR_VARIANT to VARIANT_ and one of the names below. The first four are an
 * iso_taylor_build, for the method (method.c). The others are an iso_lane_build, for batches and crossings (lanes.c),
 * with an orbit in each lane of a vector. Those called tangent compute two deviations beside each orbit. All project
 * and system headers come before the macros of numbers, so that these reach only the series. They end with this file.
 *
 *     variant       numbers                  orbits   for
 *     plain         double                   1        any processor
 *     avx2          double                   1        x86 with AVX2 and FMA: three components in one register of four
 *     extended      long double              1        a reference: 64 bits of mantissa on x86
 *     quad          128 bits                 1        for references, where compiler and C library have it
 *     lanes_plain   double                   2        any processor: all have vectors of two doubles, or do without
 *     lanes_avx2    double                   4        x86 with AVX2 and FMA
 *     lanes_avx512  double                   8        x86 with AVX-512
 *     tangent_...   as the three lanes_..., and extended and quad with one orbit, all with deviations
 *     tail_...      plain and avx2 with deviations, for the higher coefficients of extended and quad (tail_impl.h)
 */
#define VARIANT_PLAIN 1
#define VARIANT_AVX2 2
#define VARIANT_EXTENDED 3
#define VARIANT_QUAD 4
#define VARIANT_LANES_PLAIN 5
#define VARIANT_LANES_AVX2 6
#define VARIANT_LANES_AVX512 7
#define VARIANT_TANGENT_PLAIN 8
#define VARIANT_TANGENT_AVX2 9
#define VARIANT_TANGENT_AVX512 10
#define VARIANT_TANGENT_EXTENDED 11
#define VARIANT_TANGENT_QUAD 12
#define VARIANT_TAIL_PLAIN 13
#define VARIANT_TAIL_AVX2 14

#define IS(name) (ISO_TAYLOR_VARIANT == VARIANT_##name)
#define IS_QUAD (IS(QUAD) || IS(TANGENT_QUAD))
#define IS_EXTENDED (IS(EXTENDED) || IS(TANGENT_EXTENDED))
#define IS_TAIL (IS(TAIL_PLAIN) || IS(TAIL_AVX2))
#define IS_TANGENT (ISO_TAYLOR_VARIANT >= VARIANT_TANGENT_PLAIN)

#define _GNU_SOURCE /* functions of _Float128 */
#include <float.h>

#include "base/math_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "method/taylor/code_impl.h"
#include "method/taylor/lanes_impl.h"
#include "method/taylor/tail_impl.h"
#include "model/model_impl.h"

#if !IS_QUAD || defined ISO_TAYLOR_HAS_QUAD

/* --- the numbers ------------------------------------------------------------------------------------------------ */

#if IS_EXTENDED
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
#define FINER 1e-4 /* the tolerance is that of doubles: terms are kept to what is beyond them */
#define FINEST_ORDER 34
#define NODES 12
#if LDBL_MANT_DIG == 64
#define SPLIT (0x1p32L + 1) /* see lost_in */
#endif
#elif IS_QUAD
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
#define FINER 1e-15
#define FINEST_ORDER 52
#define NODES 20
#else
#include "model/series/double_impl.h"
#define EPSILON DBL_EPSILON
#define FINER 1
#if IS_TAIL
#define FINEST_ORDER ISO_TAIL_ORDER
#else
#define FINEST_ORDER 28
#endif
#define NODES 8
#endif

#if IS(LANES_AVX512) || IS(TANGENT_AVX512)
#define LANES 8
#elif IS(LANES_AVX2) || IS(TANGENT_AVX2)
#define LANES 4
#elif IS(LANES_PLAIN) || IS(TANGENT_PLAIN)
#define LANES 2
#else
#define LANES 1
#endif

#if IS_TANGENT
#define CHANNELS 3
#endif

#if IS(PLAIN) || IS(AVX2) || IS_TAIL
#define PACKED
#endif

#if IS_EXTENDED
#define APART
#endif

#if LANES > 2 && !IS_TANGENT
#define WRITTEN
#endif

/* --- the code --------------------------------------------------------------------------------------------------- */

#if IS_TAIL
#include "method/taylor/tail_code_impl.h"
#elif LANES == 1 && !IS_TANGENT
#include "method/taylor/single_impl.h"
#else
#include "method/taylor/crew_impl.h"
#if IS(TANGENT_EXTENDED) || IS(TANGENT_QUAD)
#include "method/taylor/return_impl.h"
#endif

#define LANE_CODE(name)                                                                                              \
    {                                                                                                                \
        name, LANES, IS_TANGENT ? ISO_LANE_DEVIATIONS : 0, sizeof(saved_lane), runs_here, solve                      \
    }

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
#endif

#if IS(PLAIN)
const iso_method iso_taylor_plain = {ISO_TAYLOR_ROW("taylor", ""), SINGLE};
#elif IS(AVX2)
const iso_method iso_taylor_avx2 = {ISO_TAYLOR_ROW("taylor", ""), SINGLE};
#elif IS(EXTENDED)
const iso_method iso_method_taylor_extended = {
    ISO_TAYLOR_ROW("taylor_extended", "the same in long double, a reference for the others"), SINGLE, .digits = 19};
#elif IS(QUAD)
const iso_method iso_method_taylor_quad = {ISO_TAYLOR_ROW("taylor_quad", "the same in numbers of 128 bits, slow"),
                                           SINGLE, .digits = 34, .reference = true};
#elif IS(LANES_PLAIN)
const iso_lane_build iso_lanes_plain = LANE_CODE("plain");
#elif IS(LANES_AVX2)
const iso_lane_build iso_lanes_avx2 = LANE_CODE("avx2");
#elif IS(LANES_AVX512)
const iso_lane_build iso_lanes_avx512 = LANE_CODE("avx512");
#elif IS(TANGENT_PLAIN)
const iso_lane_build iso_tangent_plain = LANE_CODE("plain");
#elif IS(TANGENT_AVX2)
const iso_lane_build iso_tangent_avx2 = LANE_CODE("avx2");
#elif IS(TANGENT_AVX512)
const iso_lane_build iso_tangent_avx512 = LANE_CODE("avx512");
#elif IS(TANGENT_EXTENDED)
const iso_return_build iso_return_extended = {LDBL_EPSILON, go};
const iso_lane_build iso_tangent_extended = LANE_CODE("extended");
#elif IS(TANGENT_QUAD)
const iso_return_build iso_return_quad = {0x1p-106, go};
const iso_lane_build iso_tangent_quad = LANE_CODE("quad");
#elif IS(TAIL_PLAIN)
const iso_tail_build iso_tail_plain = {create_tail, expand_tail};
#elif IS(TAIL_AVX2)
const iso_tail_build iso_tail_avx2 = {create_tail, expand_tail};
#endif

#endif
