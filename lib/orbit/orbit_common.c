/* orbit_common.c - what every other file of an orbit needs: the numbers of a sample, and what an orbit is made of. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

/* --- the numbers of a sample ------------------------------------------------------------------------------------ */

_Static_assert(sizeof(iso_sample) == ISO_TRAJECTORY_COLUMNS * sizeof(double),
               "a number for each column, in their order");

double iso_sample_column(const iso_sample *sample, int column)
{
    double value;
    memcpy(&value, (const char *)sample + (size_t)column * sizeof value, sizeof value);
    return value;
}

double iso_sample_get(const iso_sample *sample, const char *name)
{
    const int column = iso_column_find(name);
    return column < 0 ? NAN : iso_sample_column(sample, column);
}

void iso_sample_set_column(iso_sample *sample, int column, double value)
{
    memcpy((char *)sample + (size_t)column * sizeof value, &value, sizeof value);
}

void iso_sample_blank(iso_sample *s)
{
    for (int c = 0; c < ISO_TRAJECTORY_COLUMNS; c++) iso_sample_set_column(s, c, NAN);
}

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

void iso_orbit_clear(iso_orbit *o)
{
    iso_problem *f = &o->model.problem;
    char *const behind_effects = (char *)(&o->effects + 1), *const behind = (char *)(f + 1);
    memset(o, 0, offsetof(iso_orbit, effects) + offsetof(iso_effects, written));
    memset(behind_effects, 0, (size_t)((char *)&f->effects - behind_effects));
    memset(f->at, 0, sizeof f->at);
    memset(&f->motion, 0, offsetof(iso_formula, late_line));
    memset(&f->energy_formula, 0, offsetof(iso_formula, late_line));
    memset(behind, 0, (size_t)((char *)(o + 1) - behind));
}

bool iso_point_is_better(const iso_params *p)
{
    return fabs(p->k) >= 0.125;
}

iso_way iso_way_first(const iso_params *p, iso_backend asked, iso_backend last, bool all_clocks)
{
    const bool point = asked == ISO_BACKEND_AUTO && iso_point_is_better(p);
    return (iso_way){point ? ISO_BACKEND_POINT : last, last, all_clocks, all_clocks};
}

bool iso_way_next(iso_way *way, iso_status status)
{
    if (status == ISO_OK || status == ISO_NO_MEMORY) return false;
    if (status == ISO_NUMERICAL && way->clocks) return way->clocks = false, true;
    if (way->backend == way->last) return false;
    way->backend = way->last;
    way->clocks = way->all_clocks;
    return true;
}

/* --- a message -------------------------------------------------------------------------------------------------- */

iso_status iso_orbit_too_extreme(const iso_orbit *o, const char *what, const char *way_out)
{
    const iso_params *p = &o->units.own;
    return iso_context_fail(
        o->ctx, ISO_NUMERICAL, "k",
        "k = %s is too extreme for %s with max J/min J = %.3g: powers q^(1/k) leave the range of doubles; %s",
        ISO_SHORT(p->k), what, max3(p->J) / min3(p->J), way_out);
}
