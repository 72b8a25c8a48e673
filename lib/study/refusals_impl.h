/* refusals_impl.h - what studies refuse: one situation has one status and one sentence, whatever the study.
 *
 * Each call is ISO_OK, or ISO_BAD_INPUT with the sentence. `what` is the study's own part of it. A wrong number of an
 * axis is refused by iso_crossings_check_axis, because sections without a study have axes as well.
 */
#ifndef ISO_STUDY_REFUSALS_IMPL_H
#define ISO_STUDY_REFUSALS_IMPL_H

#include "orbit/orbit.h"

/* About an effect that acts, other than a level. what: as in "periodic orbits are sought". */
iso_status iso_refuse_beyond_level(iso_context *ctx, const iso_effects *effects, const char *what);

/* About "level", where the coupling eps is not above 0: a ball in the potential of a level can have so little energy
 * that its point is driven off, not held. what: as above. */
iso_status iso_refuse_coupling(iso_context *ctx, const iso_orbit *orbit, const char *what);

/* About an effect that takes energy from the ball of this orbit. what: as in "has no frequencies". */
iso_status iso_refuse_losses(iso_context *ctx, const iso_orbit *orbit, const char *what);

/* Losses, and effects that let the ball roll away. */
iso_status iso_refuse_unbound(iso_context *ctx, const iso_orbit *orbit, const char *what);

/* About "angular_velocity" or "M", at rest where no potential is. what: as in "has no frequencies". */
iso_status iso_refuse_rest(iso_context *ctx, const iso_start *start, const iso_effects *effects, const char *what);

/* Whether other starts can be given on the section n_axis = 0 of this orbit: `count` of them at (l, x), and spread ones
 * anywhere. About an effect with which the section has no chart; about "at" or "starts", where the start is outside of
 * the chart, or where the level closes it. */
iso_status iso_refuse_starts(iso_context *ctx, const iso_orbit *orbit, const iso_effects *effects, int axis,
                             const double (*at)[2], size_t count, bool spread);

#endif
