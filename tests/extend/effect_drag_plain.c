/* effect_drag.c - the torque of still air on the turning ball: -c |omega| omega. As a plain function, not a
 * formula. */
#include <math.h>

#include "model/effects/effects_impl.h"

static void torque(const iso_problem *f, const double y[], double T[3])
{
    const double c = f->effects.number[ISO_DRAG][0], speed = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    for (int i = 0; i < 3; i++) T[i] -= c * speed * y[i];
}

static const iso_effect_number numbers[] = {
    {.name = "c", .count = 1, .dimension = {1, 0, 0}, .kind = ISO_NUMBER_POSITIVE, .required = true},
    {0},
};

const iso_effect iso_effect_drag = {
    .name = "drag",
    .doc = "drag of still air: torque -c |omega| omega",
    .breaks = "energy is lost, and an orbit of the point keeps its own",
    .work = iso_work_lost,
    .numbers = numbers,
    .torque = torque,
};
