/* taylor_avx2.c - the same for x86 processors with AVX2 and FMA: vectors of four numbers in one register. Compiled with
 * the flags of CMakeLists.txt, called only where iso_taylor_has_avx2() says so. */
#ifdef ISO_TAYLOR_AVX2
#define NAME(x) avx2_##x
#include "method/taylor_double_impl.h"

const iso_taylor_code iso_taylor_avx2 = {avx2_create, avx2_start, avx2_step, avx2_within};

bool iso_taylor_has_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#else
#include "method/taylor_impl.h"

const iso_taylor_code iso_taylor_avx2 = {NULL};

bool iso_taylor_has_avx2(void)
{
    return false;
}
#endif
