/* effect_rolling_resistance.c - torque -c_r w against the rolling: dh/dt = -c_r (w,w). */
#include "base/vec3_impl.h"
#include "model/effects_impl.h"

static void torque(const iso_field *f, const double y[], double T[3])
{
    add_scaled(T, -f->effects.resistance, y);
}

static void torque_slope(const iso_field *f, const double y[], int dim, double slope[])
{
    (void)y;
    for (int j = 0; j < 3; j++) slope[dim * j + j] -= f->effects.resistance;
}

/* (J w)' = -c_r w + ... */
static double stiffness(const iso_field *f)
{
    return f->effects.resistance / min3(f->p.J);
}

static const iso_effect_number numbers[] = {
    {"coefficient", offsetof(iso_effects, resistance), 1, {1, 0, 1}},
    {0},
};

const iso_effect iso_effect_rolling_resistance = {
    .name = "rolling_resistance",
    .doc = "torque -c_r omega against the rolling",
    .breaks = "energy is lost, and an orbit of the point keeps its own",
    .numbers = numbers,
    .torque = torque,
    .torque_slope = torque_slope,
    .stiffness = stiffness,
};
