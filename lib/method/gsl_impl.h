/* gsl_impl.h - GSL's loop over the steps of a model (gsl.c), which dense.c uses as well. */
#ifndef ISO_METHOD_GSL_IMPL_H
#define ISO_METHOD_GSL_IMPL_H

#include <gsl/gsl_odeiv2.h>

#include "method/integrator_impl.h"

/* An implicit method sees y_i/unit_i, numbers of order one. Its LU decomposition chooses pivots by size: without
 * units a small component would lose its digits beside a large one. Units are powers of two, so that they cause no
 * rounding. */
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

/* One step of y of the length options.fixed_step, whatever its error. */
iso_status iso_gsl_fixed_step(iso_integrator *it, iso_gsl *g, double y[], double *h);

/* After y was changed (projected): GSL begins its next step with the derivative it has kept, which must be that of
 * y. */
iso_status iso_gsl_renew_slope(iso_integrator *it, iso_gsl *g, const double y[]);

#endif
