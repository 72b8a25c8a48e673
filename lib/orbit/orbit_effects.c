/* orbit_effects.c - what effects add to the samples of an orbit: own units to the caller's, and back. */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

/* One own unit of a group of columns in the caller's. */
static double unit_of(const iso_orbit *o, const iso_effect_column *group)
{
    double unit = iso_unit(&o->units, group->dimension);
    for (int power = group->length; power > 0; power--) unit *= o->length;
    for (int power = group->length; power < 0; power++) unit /= o->length;
    return unit;
}

/* Fills the columns of one effect, which begin at `to`. False: one of them does not fit a double. */
static bool show_effect(const iso_orbit *o, const iso_effect *effect, const double y[], double to[])
{
    double own[ISO_EFFECT_COLUMNS];
    bool fits = true;
    int i = 0;
    effect->show(&o->model.problem, y, own);
    for (const iso_effect_column *group = effect->columns; group && group->name; group++) {
        const double unit = unit_of(o, group);
        for (const int end = i + group->count; i < end; i++) {
            to[i] = own[i] * unit;
            fits = fits && isfinite(to[i]);
        }
    }
    return fits;
}

static iso_status out_of_range(const iso_orbit *o, const iso_sample *s, int column)
{
    while (isfinite(s->effect[column])) column++;
    return ISO_FAIL_NUMERICAL(
        o->ctx, "%s is out of the range of doubles in these units: use other units of mass, length or time",
        iso_effect_column_name(column, NULL, NULL, NULL));
}

iso_status iso_orbit_sample_effects(const iso_orbit *o, const double y[], iso_sample *s)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        if (!o->model.problem.effects.on[e] || !effect->show) continue;
        const int first = iso_effect_first_column(e);
        if (!show_effect(o, effect, y, s->effect + first)) return out_of_range(o, s, first);
    }
    return ISO_OK;
}

/* The states of one effect, from its columns that begin at `from`. */
static void recall_effect(const iso_orbit *o, const iso_effect *effect, const double from[], double y[])
{
    double own[ISO_EFFECT_COLUMNS];
    int i = 0;
    for (const iso_effect_column *group = effect->columns; group && group->name; group++) {
        const double unit = unit_of(o, group);
        for (const int end = i + group->count; i < end; i++) own[i] = from[i] / unit;
    }
    effect->recall(&o->model.problem, own, y);
}

static bool is_derived(const iso_effect *effect)
{
    bool derived = false;
    for (const iso_effect_state *s = effect->states; s && s->name; s++)
        derived = derived || s->kind == ISO_STATE_DERIVED;
    return derived;
}

void iso_orbit_state_of(const iso_orbit *o, const iso_system *system, const iso_sample *s, double y[])
{
    const iso_problem *f = &o->model.problem;
    const bool ball = system == &iso_system_ball;
    copy(ball ? s->ball : s->point, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= ball ? o->units.w : o->unit_M;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        if (f->at[e] == 0) continue;
        if (is_derived(effect)) effect->begin(f, y);
        if (effect->recall) recall_effect(o, effect, s->effect + iso_effect_first_column(e), y);
    }
}
