/* level_impl.h - the level of a scene, for the studies that hold on every level of the point's energy. */
#ifndef ISO_STUDY_LEVEL_IMPL_H
#define ISO_STUDY_LEVEL_IMPL_H

#include "map/section.h"
#include "orbit/orbit.h"
#include "study/level.h"

/* A scene's motion with what fixes it. */
typedef struct iso_on_level {
    iso_units units;
    double h;      /* of the ball, own units                */
    double energy; /* H of the point for eps = 1, own units */
    double H;      /* the same level in the scene's units   */
} iso_on_level;

/* The motion of a scene's point: its params in own units (into *own), eps of any sign, and H. eps is 0 for a ball at
 * rest. what: as in "periodic orbits are sought". Errors: those of iso_refuse_beyond_level
 * (refusals_impl.h) and iso_orbit_create. */
iso_status iso_level_motion(iso_context *ctx, const iso_scene *scene, const char *what, iso_params *own,
                            iso_point_motion *motion);

/* Errors: the same, and those of iso_refuse_coupling. */
iso_status iso_level_find(iso_context *ctx, const iso_scene *scene, const char *what, iso_on_level *on);

#endif
