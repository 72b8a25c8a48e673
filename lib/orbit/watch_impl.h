/* watch_impl.h - what is watched along an orbit: how far its integrals drift, and how far it is from another orbit of
 * the same motion. lib/doc/methods.md, section 3, defines both numbers. */
#ifndef ISO_ORBIT_WATCH_IMPL_H
#define ISO_ORBIT_WATCH_IMPL_H

#include <math.h>

#include "orbit/orbit_impl.h"

/* The larger of `worst` and |x|; a NaN counts as infinite. */
static inline double iso_larger(double worst, double x)
{
    return fabs(x) <= worst ? worst : isnan(x) ? INFINITY : fabs(x);
}

/* Lists the integrals of a system that hold for the orbit, at most `most`, and returns how many. A constraint should
 * have its exact value; the energy `energy`, in own units (NaN: its first value); all others their first value. */
int iso_watch_begin(const iso_orbit *orbit, const iso_system *system, double energy, const iso_sample *first,
                    iso_drift list[], int most);

/* Sets `now` and `worst` of all that are listed. */
void iso_watch_follow(const iso_orbit *orbit, const iso_sample *sample, iso_drift list[], int count);

/* The distance of two states of one motion, balls or points: that of the vector which differs more, relative to the
 * longer one (relative_difference). NaN where one is not known. */
double iso_distance(const double a[ISO_STATE], const double b[ISO_STATE]);

#endif
