/* effects_impl.h - the rows of the effect table, and what several of them use. */
#ifndef ISO_MODEL_EFFECTS_IMPL_H
#define ISO_MODEL_EFFECTS_IMPL_H

#include <string.h>

#include "model/effect.h"

#define ISO_EFFECT_ROW(ID, name) extern const iso_effect iso_effect_##name;
ISO_EFFECT_LIST(ISO_EFFECT_ROW)
#undef ISO_EFFECT_ROW

/* Whether there are none: the free ball asks at each step, and should not look through the table. */
static inline bool iso_effects_none(const iso_effects *effects)
{
    static const bool off[ISO_EFFECTS] = {false};
    return memcmp(effects->on, off, sizeof off) == 0;
}

/* How many states an effect has here. */
int iso_effect_states(const iso_effect *effect, const iso_problem *f);

/* Whether `begin` gives its states at any time. Such an effect has no other states. */
bool iso_effect_is_derived(const iso_effect *effect);

/* Writes down the equations of all effects: the ball's motion (`series`: derived states are formulas) and energy, or
 * the image on the point. problem->at must be set. What cannot be computed is `overrun` or `wrong`. */
void iso_effects_record_motion(const iso_problem *f, bool series, iso_formula *F);
void iso_effects_record_energy(const iso_problem *f, iso_formula *F);
void iso_effects_record_image(const iso_problem *f, iso_formula *F);

struct iso_model;

/* y' in the system's own clock, from the recurrences: the same as m->own_rhs, by the other statement of the
 * equations. Slower: a test holds the two against each other. */
void iso_model_rhs_of_recurrences(const struct iso_model *m, const double y[], double dy[]);

/* The vertical e of gravity, in axes of the body. */
const double *iso_vertical(const iso_problem *f, const double y[]);

/* For the rows: states that are there on a plane alone, and what many of them answer. */
bool iso_is_plane(const iso_problem *f);
iso_work iso_no_work(const iso_problem *f);
iso_work iso_work_lost(const iso_problem *f);

#endif
