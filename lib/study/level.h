/* level.h - the level of a scene's point (map/level.h). */
#ifndef ISO_STUDY_LEVEL_H
#define ISO_STUDY_LEVEL_H

#include "../base/api.h"
#include "../map/level.h"
#include "../orbit/scene.h"

ISO_C_BEGIN

/* The level of a scene. A ball without the effect `level` has 0, whatever its start. what begins the words of a
 * refusal, as "periodic orbits are sought" does. Errors: ISO_BAD_INPUT about an effect that acts, other than `level`,
 * or about "level" where the coupling eps is not above 0; those of iso_orbit_create. */
ISO_API iso_status iso_level_of_scene(iso_context *ctx, const iso_scene *scene, const char *what, double *level);

ISO_C_END

#endif
