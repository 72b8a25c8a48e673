/* hill_wide_impl.h - Hill's equation of the rotations in numbers of 128 bits. */
#ifndef ISO_STUDY_HILL_WIDE_IMPL_H
#define ISO_STUDY_HILL_WIDE_IMPL_H

#include "method/wide_impl.h"

/* The matrix of (gamma_i, dgamma_i/dphi) over half a turn about `axis`, on the level H = energy with eps = 1. Where the
 * compiler has no numbers of 128 bits, it has 64 bits. */
void iso_hill_matrix_wide(double k, const double J[3], double energy, int axis, iso_wide y[2][2]);

#endif
