/* watch.c - how far integrals drift along an orbit, and how far two orbits of one motion are apart. */
#include <float.h>
#include <math.h>

#include "base/vec3_impl.h"
#include "orbit/watch_impl.h"

/* A number below this part of its terms is 0 within rounding. */
static const double ROUNDING = 16 * DBL_EPSILON;

int iso_watch_begin(const iso_orbit *o, const iso_system *system, double energy, const iso_sample *first,
                    iso_drift list[], int most)
{
    const iso_integral *holds[ISO_MAX_INTEGRALS];
    const int count = iso_integrals_holding(system, &o->model.problem, holds, most);
    for (int i = 0; i < count; i++) {
        double size;
        const double own = iso_orbit_integral(o, system, holds[i], first, &size);
        const bool stated = holds[i]->value == system->energy && !isnan(energy), zero = fabs(own) <= ROUNDING * size;
        list[i] = (iso_drift){.system = system, .integral = holds[i]};
        list[i].start = zero ? 0 : own * iso_unit(&o->units, holds[i]->dimension);
        list[i].expected = holds[i]->known == ISO_ONE ? 1 : holds[i]->known == ISO_ZERO ? 0 : stated ? energy : own;
    }
    return count;
}

void iso_watch_follow(const iso_orbit *o, const iso_sample *sample, iso_drift list[], int count)
{
    double y[ISO_MAX_STATE], size;
    for (int i = 0; i < count; i++) {
        iso_drift *d = &list[i];
        if (i == 0 || d->system != list[i - 1].system) iso_orbit_state_of(o, d->system, sample, y);
        const double off = d->integral->value(&o->model.problem, y, &size) - d->expected;
        d->now = off == 0 ? 0 : off / size;
        d->worst = iso_larger(d->worst, d->now);
    }
}

double iso_distance(const double a[ISO_STATE], const double b[ISO_STATE])
{
    const double fast = relative_difference(a, b), unit = relative_difference(a + 3, b + 3);
    return fast > unit || isnan(fast) ? fast : unit;
}
