/* code_impl.h - what the compilations of the Taylor methods share: there is one for each kind of processor and number
 * (variant.c). */
#ifndef ISO_METHOD_TAYLOR_CODE_IMPL_H
#define ISO_METHOD_TAYLOR_CODE_IMPL_H

#include "method/integrator_impl.h"

#define ISO_TAYLOR_ROW(name_, doc_)                                                                                  \
    .name = name_, .doc = doc_, .family = "isoroll", .own_equations = true, .projects = true, .fixed = true

/* `taylor` for any processor, and for x86 with AVX2 and FMA; iso_taylor_create puts one of them into it->method. */
extern const iso_method iso_taylor_plain, iso_taylor_avx2;
iso_status iso_taylor_create(iso_integrator *it);
iso_suits iso_taylor_suits(const iso_model *model);

#ifdef __x86_64__
static inline bool iso_taylor_has_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#endif

#endif
