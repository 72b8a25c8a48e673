/* periodics.h - periodic orbits of scenes, as their tests ask for them. */
#ifndef ISO_TESTS_PERIODICS_H
#define ISO_TESTS_PERIODICS_H

#include "instrument/periodic/periodic_impl.h"
#include "studies.h"

/* Ends the test when they are refused. */
static inline iso_periodic *orbits_of(const iso_scene *scene, const iso_periodic_options *o)
{
    iso_periodic *found;
    must(iso_periodic_run(ctx, scene, o, &found), "periodic orbits");
    return found;
}

/* Those with periods up to this one; 0: the rotations alone. */
static inline iso_periodic *orbits_to(const iso_scene *scene, int period)
{
    iso_periodic_options o = iso_periodic_defaults();
    o.rotations_alone = period == 0;
    o.period = period == 0 ? 1 : period;
    return orbits_of(scene, &o);
}

#endif
