/* hill_trace_impl.h - the trace of a rotation, by Hill's equation (hill.c). */
#ifndef ISO_STUDY_HILL_TRACE_IMPL_H
#define ISO_STUDY_HILL_TRACE_IMPL_H

#include "study/periodic/periodic.h"

/* The half-turn trace of Hill's equation about `axis` (0 to 2) on the level H = energy of the point with eps = 1, by
 * numbers of 64 bits of mantissa, and in *error (NULL: not asked) how far it may be off. NaN for |k| < 1e-4, a moment
 * <= 0, or where there is no such rotation. It is below -2 about the axis of the middle moment, for all k and J and
 * on every level on which this rotation exists. */
double iso_hill_trace(double k, const double J[3], double energy, int axis, double *error);

/* Whether the whole circle gamma_axis = 0 can be reached on this level, energy + q^(-1/k) > 0. If not, there is no
 * rotation, but an oscillation between two places of rest. */
bool iso_hill_has_rotation(double k, const double J[3], double energy, int axis);

#endif
