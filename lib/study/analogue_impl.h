/* analogue_impl.h - what the parts of analogue.h share. */
#ifndef ISO_STUDY_ANALOGUE_IMPL_H
#define ISO_STUDY_ANALOGUE_IMPL_H

#include "study/analogue.h"

/* Chooses what is NAN of mass and radius. a->room and a->reduced are known and have a body; start: of the point. */
void iso_analogue_choose_units(const iso_analogue *a, const double start[ISO_STATE], double *mass, double *radius);

#endif
