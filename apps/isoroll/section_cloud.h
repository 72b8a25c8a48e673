/* section_cloud.h - `isoroll section --cloud N`: is the invariant measure kept? */
#ifndef ISOROLL_SECTION_CLOUD_H
#define ISOROLL_SECTION_CLOUD_H

#include "scene_options.h"
#include "study/section/section.h"

/* Carries clouds of `count` states: by the flow in t, by the flow in s if the ball has a twin, and by returns to the
 * section of how->axis. Prints whether they are still distributed by the measure. Gives the exit status:
 * EXIT_SOME_FAILED if the measure is not kept. */
int section_cloud(iso_context *ctx, const scene_options *o, const iso_scene *scene, const iso_section_options *how,
                  double count);

#endif
