/* room_impl.h - is there memory for what SUNDIALS or GSL will take?
 *
 * SUNDIALS 6.4.1 and GSL 2.7.1 crash when a malloc of their own fails (in N_VClone, SUNMatClone,
 * gsl_odeiv2_control_init, gsl_linalg_LU_decomp, ...). So the library asks first, and answers ISO_NO_MEMORY. It asks
 * where they are set up, and where a call of the library takes the first step of an implicit method of GSL; never in
 * every step. This cannot help where another thread takes the memory in between: then the process ends.
 */
#ifndef ISO_BASE_ROOM_IMPL_H
#define ISO_BASE_ROOM_IMPL_H

#include <stdbool.h>

/* Whether 64 kB can be had: more than either takes at once, to be set up or for a step. */
bool iso_room(void);

#endif
