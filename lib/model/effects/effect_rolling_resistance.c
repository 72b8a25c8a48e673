/* effect_rolling_resistance.c - torque -c_r w against the rolling: dh/dt = -c_r (w,w). */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/formula/formula_impl.h"

static double coefficient(const iso_problem *f)
{
    return f->effects.number[ISO_ROLLING_RESISTANCE][0];
}

static void motion(iso_formula *F, const iso_problem *f)
{
    add_torque(F, constant(F, -coefficient(f)), formula_omega(F));
}

/* (J w)' = -c_r w + ... */
static double stiffness(const iso_problem *f)
{
    return coefficient(f) / min3(f->p.J);
}

/* The slowest direction has the largest moment. */
static double time_to_rest(const iso_problem *f)
{
    return -log(ISO_REST) * max3(f->p.J) / coefficient(f) * fmax(1, fabs(f->p.k));
}

static const iso_effect_number numbers[] = {
    {.name = "coefficient", .count = 1, .dimension = {1, 0, 1}, .kind = ISO_NUMBER_POSITIVE, .required = true},
    {0},
};

const iso_effect iso_effect_rolling_resistance = {
    .name = "rolling_resistance",
    .doc = "torque -c_r omega against the rolling",
    .breaks = "energy is lost, and an orbit of the point keeps its own",
    .work = iso_work_lost,
    .numbers = numbers,
    .motion = motion,
    .stiffness = stiffness,
    .time_to_rest = time_to_rest,
};
