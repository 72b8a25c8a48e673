/* system_impl.h - rates of the clocks, and the point in the time of the ball. */
#ifndef ISO_MODEL_SYSTEM_IMPL_H
#define ISO_MODEL_SYSTEM_IMPL_H

#include "model/system.h"

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

#endif
