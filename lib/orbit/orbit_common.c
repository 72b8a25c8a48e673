/* orbit_common.c - what every other file of an orbit needs: what an orbit is made of, and how it is prepared. */
#include <math.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

/* --- what it is made of ----------------------------------------------------------------------------------------- */

iso_backend iso_orbit_backend(const iso_orbit *o)
{
    return o->options.backend;
}

const iso_model *iso_orbit_model(const iso_orbit *o)
{
    return &o->model;
}

const iso_units *iso_orbit_units(const iso_orbit *o)
{
    return &o->units;
}

const iso_method *iso_orbit_method(const iso_orbit *o)
{
    return o->options.method;
}

bool iso_orbit_has_twin(const iso_orbit *o)
{
    return !iso_effects_breaking(&o->effects) && (o->h > 0 || iso_effects_pull(&o->effects));
}

/* Converts the effects back to the caller's units. */
iso_effects iso_orbit_effects(const iso_orbit *o)
{
    iso_effects effects = o->effects;
    iso_effects_scale(&effects, &o->units, 1);
    return effects;
}

double iso_orbit_energy(const iso_orbit *o)
{
    return o->h == 0 ? 0 : o->h * iso_unit(&o->units, iso_dimension_h);
}

double iso_orbit_coupling(const iso_orbit *o)
{
    return o->eps == 0 ? 0 : o->eps * iso_unit(&o->units, iso_dimension_eps);
}

iso_point_motion iso_orbit_motion(const iso_orbit *o)
{
    return (iso_point_motion){&o->units.own, o->eps, o->level};
}

/* --- how it is prepared ----------------------------------------------------------------------------------------- */

bool iso_point_is_better(const iso_params *p)
{
    return fabs(p->k) >= 0.125;
}

iso_attempt iso_attempt_first(const iso_params *p, iso_backend asked, iso_backend last, bool all_clocks)
{
    const bool point = asked == ISO_BACKEND_AUTO && iso_point_is_better(p);
    return (iso_attempt){point ? ISO_BACKEND_POINT : last, last, all_clocks, all_clocks};
}

bool iso_attempt_next(iso_attempt *attempt, iso_status status)
{
    if (status == ISO_OK || status == ISO_NO_MEMORY) return false;
    if (status == ISO_NUMERICAL && attempt->clocks) return attempt->clocks = false, true;
    if (attempt->backend == attempt->last) return false;
    attempt->backend = attempt->last;
    attempt->clocks = attempt->all_clocks;
    return true;
}

iso_status iso_orbit_too_extreme(const iso_orbit *o, const char *what, const char *advice)
{
    const iso_params *p = &o->units.own;
    return iso_context_fail(
        o->ctx, ISO_NUMERICAL, "k",
        "k = %s is too extreme for %s with max J/min J = %.3g: powers q^(1/k) leave the range of doubles; %s",
        ISO_SHORT(p->k), what, max3(p->J) / min3(p->J), advice);
}
