/* taylor_avx2.c - the same for x86 processors with AVX2 and FMA: vectors of four numbers in one register. Compiled
 * with the flags of CMakeLists.txt, called only where iso_taylor_has_avx2() says so. */
#include "method/taylor_impl.h"

#ifdef ISO_TAYLOR_AVX2
#include "method/taylor_double_impl.h"

#define LANES 1
#define PACKED

#include "method/taylor_single_impl.h"

const iso_taylor_code iso_taylor_avx2 = {create, start, step, within};

bool iso_taylor_has_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#else
const iso_taylor_code iso_taylor_avx2 = {NULL, NULL, NULL, NULL};

bool iso_taylor_has_avx2(void)
{
    return false;
}
#endif
