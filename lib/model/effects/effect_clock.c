/* effect_clock.c - the other clocks as columns. A column in a scene asks for one clock, this effect for all. */
#include "model/effects/effects_impl.h"

const iso_effect iso_effect_clock = {
    .name = "clock",
    .doc = "the other clocks as states and columns; a column asks for one of them",
    .observes = true,
};
