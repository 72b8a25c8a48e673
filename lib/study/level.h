/* level.h - the level of a scene's point: its energy as one number without a unit.
 *
 *     level = (H/eps) J2^(1/k),       J2: the middle one of the three moments
 *
 * Units of mass, length and time do not change it, nor does the factor by which the ball turns faster. With k and
 * J1:J2:J3 it fixes all motions, up to their clocks. 0 is the free ball.
 */
#ifndef ISO_STUDY_LEVEL_H
#define ISO_STUDY_LEVEL_H

#include "orbit/scene.h"

/* The level of a scene. A ball without the effect `level` has 0, whatever its start. what begins the words of a
 * refusal, as "periodic orbits are sought" does. Errors: ISO_BAD_INPUT about an effect that acts, other than `level`,
 * or about "level" where the coupling eps is not above 0; those of iso_orbit_create. */
iso_status iso_level_of_scene(iso_context *ctx, const iso_scene *scene, const char *what, double *level);

#endif
