/* stretch_impl.h - the first turns of a scene's orbit in both models, close enough for smooth curves. */
#ifndef ISO_PICTURE_STRETCH_IMPL_H
#define ISO_PICTURE_STRETCH_IMPL_H

#include "base/record.h"
#include "orbit/orbit.h"

enum { ISO_STRETCH_STATES = 65 };

/* n goes this often around its sphere, by the length of its path. States of different turns stand apart. */
#define ISO_STRETCH_TURNS 1.5

/* Two tables with the columns t, s, n1..3 and gamma1..3, from the start to t = end or for ISO_STRETCH_TURNS turns if
 * these end before. curve: neighbours are about two degrees apart on both spheres. states: ISO_STRETCH_STATES at equal
 * steps of t. t and n are of the backend `ball`; s and gamma, at the same t, of the backend `point`.
 * With the curve behind them the states are what iso_picture_make draws as "compare"; add a line "result" that says
 * how the models agree.
 * Errors: those of iso_orbit_create and iso_orbit_at. The caller frees both, also after an error. */
iso_status iso_picture_stretch(iso_context *ctx, const iso_scene *scene, double end, iso_record **states,
                               iso_record **curve);

#endif
