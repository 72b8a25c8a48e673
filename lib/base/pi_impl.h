/* pi_impl.h - pi, as a double and as a long double. */
#ifndef ISO_BASE_PI_IMPL_H
#define ISO_BASE_PI_IMPL_H

#define ISO_PI_LONG 3.141592653589793238462643383279502884L
#define ISO_PI ((double)ISO_PI_LONG)

#endif
