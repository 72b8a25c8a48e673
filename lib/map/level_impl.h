/* level_impl.h - the energy H of a point from its level, and back (study/level.h). */
#ifndef ISO_MAP_LEVEL_IMPL_H
#define ISO_MAP_LEVEL_IMPL_H

#include "model/params.h"

/* H for eps = 1 in the units of J, and back. */
double iso_level_energy(const iso_params *p, double level);
double iso_level_of(const iso_params *p, double energy);

#endif
