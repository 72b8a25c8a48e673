/* sundials_vector.c - what cvode.c and arkode.c share: right-hand side, error weights and failures of SUNDIALS. */
#include "method/sundials_vector_impl.h"
#include "model/model_impl.h"

#include <stdlib.h>

int iso_sundials_rhs(sunrealtype t, N_Vector y, N_Vector dydt, void *integrator)
{
    (void)t;
    return iso_integrator_rhs(integrator, N_VGetArrayPointer(y), N_VGetArrayPointer(dydt)) ? 0 : 1;
}

int iso_sundials_weights(N_Vector y, N_Vector weights, void *integrator)
{
    const iso_integrator *it = integrator;
    double *w = N_VGetArrayPointer(weights);
    iso_model_size(&it->model, N_VGetArrayPointer(y), w);
    for (int i = 0; i < it->model.dim; i++) w[i] = 1 / (it->options.tolerance * w[i]);
    return 0;
}

iso_status iso_sundials_stopped(iso_integrator *it, char *flag_name)
{
    const iso_status status = iso_integrator_stopped(it, flag_name ? flag_name : "unknown reason");
    free(flag_name);
    return status;
}
