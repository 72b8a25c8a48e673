/* chaos_impl.h - what chaos.c and chaos_walk.c share.
 *
 *     chaos.c        options, refusals, the result
 *     chaos_walk.c   groups of orbits, round by round
 */
#ifndef ISO_STUDY_CHAOS_IMPL_H
#define ISO_STUDY_CHAOS_IMPL_H

#include "map/section.h"
#include "study/chaos/chaos.h"

typedef struct iso_chaos_walk {
    iso_context *ctx;
    const iso_scene *scene;
    iso_chaos_options options;
    iso_effects effects; /* that act on the motion */
    iso_orbit *orbit;    /* the scene's            */
    iso_section_spread spread;
    iso_chaos *out;
} iso_chaos_walk;

/* Follows all orbits. Errors: ISO_NO_MEMORY, ISO_STOPPED, those of iso_crossings_create, and the failure of the
 * scene's own orbit. */
iso_status iso_chaos_follow(iso_chaos_walk *w);

/* Follows the own orbits of free scenes together, in the lanes of the same vectors. They have the same options, the
 * same models, and no trace. The numbers are those that iso_chaos_follow gives, to the bit. Errors: ISO_NO_MEMORY,
 * ISO_STOPPED, those of iso_crossings_create; an orbit that fails says so in its own result. */
iso_status iso_chaos_follow_each(size_t count, iso_chaos_walk *const walk[]);

/* The failure of the scene's own orbit if no model could follow it. */
iso_status iso_chaos_check_own(const iso_chaos_walk *w);

#endif
