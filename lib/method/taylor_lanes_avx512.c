/* taylor_lanes_avx512.c - eight orbits at a time, on x86 processors with AVX-512. Compiled with the flags of
 * CMakeLists.txt. */
#include "method/lanes_impl.h"

#ifdef ISO_TAYLOR_AVX512
#include "method/taylor_double_impl.h"

#define LANES 8

#include "method/taylor_lanes_impl.h"

static bool runs_here(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma");
}

const iso_lane_code iso_lanes_avx512 = {"avx512", LANES, runs_here, solve};
#else
static bool runs_here(void)
{
    return false;
}

const iso_lane_code iso_lanes_avx512 = {"avx512", 0, runs_here, NULL};
#endif
