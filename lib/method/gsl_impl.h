/* gsl_impl.h - GSL's evolution loop over a model: shared by the methods of gsl.c and by leap.c. */
#ifndef ISO_METHOD_GSL_IMPL_H
#define ISO_METHOD_GSL_IMPL_H

#include <gsl/gsl_odeiv2.h>

#include "method/integrator_impl.h"

/* An implicit method sees y_i/unit_i, of order one: its LU decomposition picks pivots by size, and loses the digits of
 * a small component beside a large one. Units are powers of two, and round nothing. */
typedef struct iso_gsl {
    iso_integrator *it;
    bool implicit;
    double unit[ISO_MAX_STATE];
    gsl_odeiv2_system system;
    gsl_odeiv2_driver *driver; /* step, control and evolve; msadams and msbdf insist on a driver */
    double h;                  /* proposed next step                                             */
    double t;                  /* GSL's own clock                                                */
} iso_gsl;

/* Fills g for `type` with error control in units of iso_model_size(). Errors: ISO_NO_MEMORY. */
iso_status iso_gsl_open(iso_integrator *it, const gsl_odeiv2_step_type *type, iso_gsl *g);
void iso_gsl_close(iso_gsl *g);

/* Begins anew at y with a proposed first step. */
void iso_gsl_start(iso_gsl *g, const double y[], double first_step);

/* One accepted step of y towards `limit` (GSL's clock, not beyond it), its length in *h. */
iso_status iso_gsl_step(iso_integrator *it, iso_gsl *g, double limit, double y[], double *h);

#endif
