/* section_impl.h - what the files of the section's chart share, and those of crossings. */
#ifndef ISO_MAP_SECTION_IMPL_H
#define ISO_MAP_SECTION_IMPL_H

#include "map/section.h"

/* |M| where (gamma, J gamma) = q; 0 where the point cannot be */
double iso_section_momentum_at(double k, double eps, double energy, double q);

/* The least and the largest q where the point can be: E + eps q^(-1/k) >= 0. */
void iso_section_range(iso_point_motion m, double q[2]);

#endif
