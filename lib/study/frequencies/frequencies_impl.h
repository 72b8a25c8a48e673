/* frequencies_impl.h - what the closed and the estimated frequencies share. */
#ifndef ISO_STUDY_FREQUENCIES_IMPL_H
#define ISO_STUDY_FREQUENCIES_IMPL_H

#include "base/pi_impl.h"
#include "study/frequencies/frequencies.h"

/* Of a motion that is refused (refusals_impl.h). */
#define ISO_NO_FREQUENCIES "has no frequencies"

/* Errors: ISO_BAD_ARGUMENT. */
iso_status iso_frequencies_check(iso_context *ctx, const iso_frequencies_options *options);

/* Nothing known. */
void iso_frequencies_blank(iso_frequencies *f);

/* An orbit of the scene's start with both models where there are both, at its start. The effects that act must stay
 * where they are as long as the orbit lives. Errors: those of iso_refuse_rest, iso_orbit_create and iso_orbit_at. */
iso_status iso_frequencies_open(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                                iso_orbit **orbit, iso_sample *sample);

/* h, eps, H and F from the orbit at its start. */
void iso_frequencies_place(const iso_orbit *orbit, const iso_sample *start, iso_frequencies *f);

/* From the frequencies: periods, rotation number, resonances, period of a closed orbit. */
void iso_frequencies_finish(iso_frequencies *f);

#endif
