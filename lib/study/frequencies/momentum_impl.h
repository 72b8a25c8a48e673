/* momentum_impl.h - the rotation numbers of momentum.h. */
#ifndef ISO_STUDY_FREQUENCIES_MOMENTUM_IMPL_H
#define ISO_STUDY_FREQUENCIES_MOMENTUM_IMPL_H

#include "study/frequencies/momentum.h"

/* F of the rotation about axis i = 0, 1, 2; i = 3: where the roots meet (infinite for k = 1). */
double iso_momentum_rotation(const iso_momentum *m, double h, int i);

#endif
