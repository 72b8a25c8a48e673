/* sundials_vector_impl.h - a model as SUNDIALS sees it, for cvode.c and arkode.c. */
#ifndef ISO_METHOD_SUNDIALS_VECTOR_IMPL_H
#define ISO_METHOD_SUNDIALS_VECTOR_IMPL_H

#include <sundials/sundials_nvector.h>

#include "base/sundials_impl.h"
#include "method/integrator_impl.h"

/* y' = f(y); a derivative that is not finite asks for a shorter step. `integrator` is the user data. */
int iso_sundials_rhs(sunrealtype t, N_Vector y, N_Vector dydt, void *integrator);

/* Error weights 1 / (tolerance * iso_model_size()). */
int iso_sundials_weights(N_Vector y, N_Vector weights, void *integrator);

/* iso_integrator_stopped with a name that SUNDIALS allocated; frees it. */
iso_status iso_sundials_stopped(iso_integrator *it, char *flag_name);

#endif
