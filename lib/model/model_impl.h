/* model_impl.h - what the rest of the library asks of parameters, clocks, effects and models. */
#ifndef ISO_MODEL_MODEL_IMPL_H
#define ISO_MODEL_MODEL_IMPL_H

#include "model/effects_impl.h"
#include "model/model.h"

/* --- parameters and units --------------------------------------------------------------------------------------- */

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

/* --- clocks, and the point in the time of the ball -------------------------------------------------------------- */

iso_dimension iso_clock_dimension(iso_clock clock);

/* Rate d clock / dt > 0 where q = (gamma, J gamma) = 1/(n, J^-1 n), and its exponent e in rate ~ q^e:
 *     t: 1,   tau: N = q^(1 - 1/(2k)),   s: G N = (k^2/det J) q^(1 + 1/(2k)). */
double iso_clock_rate(const iso_params *p, iso_clock clock, double q, double *exponent);

/* The point on H = 0 again, y = (J^(1/2) omega, gamma) in the ball's time, free of powers of q: for extreme k
 * (point_t.c). Not in the registry. */
extern const iso_system iso_system_point_t;

/* Its states and those of the point, (M, gamma) with M = NN p (18). The two may be one array. */
void iso_point_to_point_t(const iso_params *p, const double point[ISO_STATE], double y[ISO_STATE]);
void iso_point_t_to_point(const iso_params *p, const double y[ISO_STATE], double point[ISO_STATE]);

/* Whether powers q^(1/k) may range over more than ten decades along an orbit: series of (24) then overflow, and its
 * steps shrink. */
bool iso_params_steep(const iso_params *p);

/* --- models ----------------------------------------------------------------------------------------------------- */

/* Why the model cannot be simulated: more effects than there is room for; NULL: it can. */
const char *iso_model_too_large(const iso_model *m);

/* The first of its effects whose equations are no formula: only methods that need nothing but y' can take it. NULL:
 * none. */
const iso_effect *iso_model_without_formula(const iso_model *m);

/* Restores the constraints of system and effects, and the energy where it is conserved; gives the relative size of
 * the correction. */
double iso_model_project(const iso_model *m, double y[]);

/* The size of each component for error control: of the vector of R^3 it belongs to; of the clock, and of its
 * progress in one unit of the independent variable. Errors of a step are measured in units of tolerance * size. */
void iso_model_size(const iso_model *m, const double y[], double size[]);

/* Whether its equations stand in series/recurrences_impl.h, of which slopes and series are made. */
bool iso_system_has_recurrences(const iso_system *system);

/* The Jacobian in the system's own clock, moving x moving, row-major: that of the formulas,
 * iso_model_without_formula() must be NULL. */
void iso_model_slopes(const iso_model *m, const double y[], double jac[]);

#endif
