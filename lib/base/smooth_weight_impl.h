/* smooth_weight_impl.h - the weight of averages along an orbit. On a quasi-periodic orbit their error is smaller than
 * any power of 1/n (S. Das, Y. Saiki, E. Sander, J. A. Yorke, Nonlinearity 30, 2017). */
#ifndef ISO_BASE_SMOOTH_WEIGHT_IMPL_H
#define ISO_BASE_SMOOTH_WEIGHT_IMPL_H

#include <math.h>

/* exp(-1/(u (1 - u))), 1 at its top; 0 outside of (0, 1) */
static inline double iso_smooth_weight(double u)
{
    return u > 0 && u < 1 ? exp(4 - 1 / (u * (1 - u))) : 0;
}

#endif
