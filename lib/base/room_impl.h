/* room_impl.h - SUNDIALS 6.4.1 and GSL 2.7.1 crash when a malloc of their own fails (in N_VClone, SUNMatClone,
 * gsl_odeiv2_control_init, gsl_linalg_LU_decomp, ...): they are only called where there is room for what they take.
 */
#ifndef ISO_BASE_ROOM_IMPL_H
#define ISO_BASE_ROOM_IMPL_H

#include <stdbool.h>

/* Whether 64 kB can be had: more than either takes at once, to be set up or for a step. */
bool iso_room(void);

#endif
