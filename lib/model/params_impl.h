/* params_impl.h - units, and whether powers q^(1/k) fit doubles. */
#ifndef ISO_MODEL_PARAMS_IMPL_H
#define ISO_MODEL_PARAMS_IMPL_H

#include "model/params.h"

/* The sign of the ball's radius b: -1 inside a sphere and of a shell, else 1. */
int iso_params_sign_of_radius(const iso_params *params);

/* of the ball's energy h = (w,Jw)/2 and of the point's coupling eps = h det J/k^2 */
extern const iso_dimension iso_dimension_h, iso_dimension_eps;

/* Own units for motions of angular speed about `speed` (1/time; 0 allowed). */
void iso_units_choose(const iso_params *params, double speed, iso_units *units);

/* Whether q^(1/k) fits a double, over its value at another q, for all q from the least moment to the largest. */
bool iso_params_powers_fit(const iso_params *p);

/* ISO_BAD_INPUT about "k" where they do not. */
iso_status iso_params_check_powers(iso_context *ctx, const iso_params *p);

#endif
