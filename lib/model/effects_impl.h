/* effects_impl.h - the rows of the effect table, and what several of them use. */
#ifndef ISO_MODEL_EFFECTS_IMPL_H
#define ISO_MODEL_EFFECTS_IMPL_H

#include <string.h>

#include "model/effect.h"

extern const iso_effect iso_effect_gravity, iso_effect_field, iso_effect_level, iso_effect_twist,
    iso_effect_free_twist, iso_effect_stiff_twist, iso_effect_rolling_resistance, iso_effect_attitude,
    iso_effect_reactions, iso_effect_clock;

/* Whether there are none: the free ball asks at each step, and should not look through the table. */
static inline bool iso_effects_none(const iso_effects *effects)
{
    static const bool off[ISO_EFFECTS] = {false};
    return memcmp(effects->on, off, sizeof off) == 0;
}

/* The row of an effect here: its own, or that of a contact that twists freely (the classical ball) or is stiff. */
const iso_effect *iso_effect_row(const iso_field *f, iso_effect_id id);

/* Adds column j, the derivative by y[j], of a torque to its slope. */
static inline void add_column(double slope[], int dim, int j, double factor, const double column[3])
{
    for (int i = 0; i < 3; i++) slope[dim * i + j] += factor * column[i];
}

#endif
