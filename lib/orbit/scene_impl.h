/* scene_impl.h - what a scene's effects, level and columns mean. */
#ifndef ISO_ORBIT_SCENE_IMPL_H
#define ISO_ORBIT_SCENE_IMPL_H

#include "orbit/scene.h"

/* The normal n at a start: that of the ball, or of the ball's image of the point. */
void iso_start_normal(const iso_params *params, const iso_start *start, double n[3]);

/* Finds the effects that are idle from this start on (iso_effects_settle). */
void iso_start_settle(const iso_params *params, const iso_start *start, iso_effects *effects);

/* The effects of a scene, settled. */
iso_effects iso_scene_effects(const iso_scene *scene);

/* Puts the scene on a level of the point's energy, (H/eps) J2^(1/k) (study/level.h); 0 is the free motion. A point keeps
 * eps, gamma and the direction of M. A ball keeps omega and n, and gets the effect `level`, or loses it.
 * Errors: ISO_BAD_INPUT: about "level", where the point cannot be at this gamma on this level; about "M" or
 * "angular_velocity" at rest; about "eps", not above 0; about an effect that acts. Those of iso_orbit_create. */
iso_status iso_scene_on_level(iso_context *ctx, iso_scene *scene, double level);

/* All names, for lists of them; gives their number. */
int iso_column_names(const char *names[ISO_TRAJECTORY_COLUMNS]);

/* The effect that a column needs; ISO_EFFECTS: none. */
iso_effect_id iso_column_effect(int column);

/* Errors: ISO_BAD_INPUT about "columns" when one of the scene's needs an effect that the scene has not. */
iso_status iso_scene_check_columns(iso_context *ctx, const iso_scene *scene);

#endif
