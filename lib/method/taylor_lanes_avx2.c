/* taylor_lanes_avx2.c - four orbits at a time, on x86 processors with AVX2 and FMA. Compiled with the flags of
 * CMakeLists.txt. */
#include "method/lanes_impl.h"

#ifdef ISO_TAYLOR_AVX2
#include "method/taylor_double_impl.h"

#define LANES 4

#include "method/taylor_lanes_impl.h"

static bool runs_here(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

const iso_lane_code iso_lanes_avx2 = {"avx2", LANES, runs_here, solve};
#else
static bool runs_here(void)
{
    return false;
}

const iso_lane_code iso_lanes_avx2 = {"avx2", 0, runs_here, NULL};
#endif
