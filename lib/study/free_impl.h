/* free_impl.h - what is asked of a free motion alone: the ball on which nothing acts, and the point on H = 0. */
#ifndef ISO_STUDY_FREE_IMPL_H
#define ISO_STUDY_FREE_IMPL_H

#include "orbit/orbit.h"
#include "orbit/scene.h"

/* The effect that makes the motion another one: one that acts on the ball, or the level. NULL: there is none.
 * Observers, which act on nothing, do not matter. */
const iso_effect *iso_study_not_free(const iso_effects *effects);

/* ISO_OK for a free motion, else ISO_BAD_INPUT about the effect. effects NULL: a free motion. what: as in "periodic
 * orbits are sought"; the message goes on: " only of the free ball and of the point on H = 0: remove 'gravity'". */
iso_status iso_study_check_free(iso_context *ctx, const iso_effects *effects, const char *what);

/* The same for a scene's start on which `effects` act. A point off H = 0 has the effect `level`, which its orbit
 * tells. Errors: also those of iso_orbit_create. */
iso_status iso_study_check_free_start(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                                      const char *what);

/* The motion of a scene's point: its params in own units (into *own), eps and H; on H = 0, eps may be 0. Refuses an
 * effect that acts and is no level, with ISO_BAD_INPUT; what: as in "integrals are sought". Errors: also those of
 * iso_orbit_create. */
iso_status iso_study_motion(iso_context *ctx, const iso_scene *scene, const char *what, iso_params *own,
                            iso_point_motion *motion);

#endif
