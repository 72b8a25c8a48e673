/* attitude_impl.h - how the ball stands in space: the states of the effect `attitude`, for other effects to read. */
#ifndef ISO_MODEL_ATTITUDE_IMPL_H
#define ISO_MODEL_ATTITUDE_IMPL_H

#include "model/problem.h"

/* The vector v of body axes in space axes, by the quaternion Q (its rotation times |Q|^2). */
void iso_turn_to_space(const double Q[4], const double v[3], double in_space[3]);

/* The same as a formula. */
iso_vector iso_in_space(iso_formula *F, const iso_problem *f, iso_vector v);

#endif
