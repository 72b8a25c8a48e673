/* level.h - the level of the point's energy as one number without a unit.
 *
 *     level = (H/eps) J2^(1/k),       J2: the middle one of the three moments
 *
 * Units of mass, length and time do not change it, nor does the factor by which the ball turns faster. With k and
 * J1:J2:J3 it fixes all motions, up to their clocks. 0 is the free ball.
 */
#ifndef ISO_MAP_LEVEL_H
#define ISO_MAP_LEVEL_H

#include "../base/api.h"
#include "../model/params.h"

ISO_C_BEGIN

/* H for eps = 1 in the units of J, and back. */
ISO_API double iso_level_energy(const iso_params *p, double level);
ISO_API double iso_level_of(const iso_params *p, double energy);

ISO_C_END

#endif
