/* arithmetic.c - sets the default rules of floating-point arithmetic, and puts the host's back (arithmetic_impl.h).
 */
#include "base/arithmetic_impl.h"

#if defined(__x86_64__) && defined(__GLIBC__)
#include <fpu_control.h>
#include <xmmintrin.h>

/* Asking the control words costs a hundredth of setting them. */
static bool is_default(void)
{
    enum {
        FLAGS = 0x3F,
        NO_TRAPS_TO_NEAREST = 0x1F80
    }; /* of MXCSR: what has happened; flush-to-zero is in its rest */
    fpu_control_t x87;
    _FPU_GETCW(x87);
    return x87 == _FPU_DEFAULT && (_mm_getcsr() & ~(unsigned)FLAGS) == NO_TRAPS_TO_NEAREST;
}
#else
static bool is_default(void)
{
    return false;
}
#endif

void iso_arithmetic_enter(iso_arithmetic *a)
{
    a->changed = !is_default() && fegetenv(&a->host) == 0;
    if (a->changed) fesetenv(FE_DFL_ENV);
}

void iso_arithmetic_leave(iso_arithmetic *a)
{
    if (a->changed) fesetenv(&a->host);
}
