/* effect_drag.c - the torque of still air on the turning ball: -c |omega| omega. */
#include "model/effects/effects_impl.h"
#include "model/formula/formula_impl.h"

static double c_of(const iso_problem *f)
{
    return f->effects.number[ISO_DRAG][0];
}

static void motion(iso_formula *F, const iso_problem *f)
{
    const iso_vector omega = formula_omega(F);
    const iso_scalar speed = power_of(F, dot_of(F, omega, omega), constant(F, 0.5));
    add_torque(F, constant(F, -c_of(f)), scale_v(F, speed, omega));
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
    .motion = motion,
};
