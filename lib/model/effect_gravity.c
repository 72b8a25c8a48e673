/* effect_gravity.c - weight: the vertical is one more vector that the ball sees turning.
 *
 *     MQ = mgb e x n,     e' = e x w,     |e| = 1
 *
 * The weight -m g e acts at the centre, b n above the contact. With the signed radius b this holds on all surfaces, and
 * the potential energy is m g (a+b)(n,e) = mgb/(1-k) (n,e). On a plane (k = 1) it is the height of the centre, m g (E,x),
 * with the vertical E in space and the way x, which only `attitude` knows.
 */
#include "base/vec3_impl.h"
#include "model/attitude_impl.h"
#include "model/effects_impl.h"

static const double *vertical(const iso_field *f, const double y[])
{
    return y + f->at[ISO_GRAVITY];
}

static int states(const iso_field *f)
{
    (void)f;
    return 3;
}

static void begin(const iso_field *f, double y[])
{
    copy(f->effects.up, y + f->at[ISO_GRAVITY], 3);
}

static void rates(const iso_field *f, const double y[], double dy[])
{
    cross(vertical(f, y), y, dy + f->at[ISO_GRAVITY]);
}

static void rates_slope(const iso_field *f, const double y[], const double dy[], int dim, double jac[])
{
    (void)dy;
    const int at = f->at[ISO_GRAVITY];
    for (int j = 0; j < 3; j++) {
        const double unit[3] = {j == 0, j == 1, j == 2};
        double e_unit[3], unit_w[3];
        cross(vertical(f, y), unit, e_unit);
        cross(unit, y, unit_w);
        for (int i = 0; i < 3; i++) {
            jac[dim * (at + i) + j] = e_unit[i];
            jac[dim * (at + i) + at + j] = unit_w[i];
        }
    }
}

static void size(const iso_field *f, const double y[], double size[])
{
    (void)y;
    for (int i = 0; i < 3; i++) size[f->at[ISO_GRAVITY] + i] = 1;
}

static double restore(const iso_field *f, double y[])
{
    return fabs(make_unit(y + f->at[ISO_GRAVITY]) - 1);
}

static void torque(const iso_field *f, const double y[], double T[3])
{
    double e_n[3];
    cross(vertical(f, y), y + 3, e_n);
    add_scaled(T, f->effects.mgb, e_n);
}

static void torque_slope(const iso_field *f, const double y[], int dim, double slope[])
{
    for (int j = 0; j < 3; j++) {
        const double unit[3] = {j == 0, j == 1, j == 2};
        double e_unit[3], unit_n[3];
        cross(vertical(f, y), unit, e_unit);
        cross(unit, y + 3, unit_n);
        add_column(slope, dim, 3 + j, f->effects.mgb, e_unit);
        add_column(slope, dim, f->at[ISO_GRAVITY] + j, f->effects.mgb, unit_n);
    }
}

static double potential(const iso_field *f, const double y[])
{
    if (f->p.k != 1) return f->effects.mgb / (1 - f->p.k) * dot(y + 3, vertical(f, y));
    if (f->at[ISO_ATTITUDE] == 0) return 0;
    double up[3];
    iso_turn_to_space(y + f->at[ISO_ATTITUDE], vertical(f, y), up);
    return f->effects.mgb * dot(up, iso_way(f, y));
}

static double strength(const iso_field *f, const double y[])
{
    (void)y;
    return fabs(f->effects.mgb);
}

/* next to k = 1 the potential is a large constant, and its changes are lost in it */
static double range(const iso_field *f, const double y[])
{
    (void)y;
    return f->p.k == 1 ? fabs(f->effects.mgb) : fabs(f->effects.mgb / (1 - f->p.k));
}

static double vertical_length(const iso_field *f, const double y[], double *value_size)
{
    *value_size = 1;
    return norm(vertical(f, y));
}

static double slope_of_plane(const iso_field *f, const double y[], double *value_size)
{
    *value_size = 1;
    return dot(vertical(f, y), y + 3);
}

static bool on_plane(const iso_field *f)
{
    return f->p.k == 1;
}

static const char *const state_names[] = {"e1", "e2", "e3"};

static const iso_effect_number numbers[] = {
    {"mgb", offsetof(iso_effects, mgb), 1, {1, 0, 2}},
    {"up", offsetof(iso_effects, up), 3, {0, 0, 0}},
    {0},
};

static const iso_integral integrals[] = {
    {.name = "|e|", .known = ISO_ONE, .doc = "unit vertical: 1", .value = vertical_length},
    {.name = "e.n", .doc = "(e,n), the slope of a plane", .holds = on_plane, .value = slope_of_plane},
    {0},
};

const iso_effect iso_effect_gravity = {
    .name = "gravity",
    .doc = "weight: torque mgb e x n, potential m g (a+b)(n,e)",
    .breaks = "its torque depends on the vertical, which turns in the body: it is no potential of n",
    .numbers = numbers,
    .state = state_names,
    .states_doc = "vertical in body axes, e' = e x omega, for the torque of the weight",
    .states = states,
    .begin = begin,
    .rates = rates,
    .rates_slope = rates_slope,
    .size = size,
    .restore = restore,
    .torque = torque,
    .torque_slope = torque_slope,
    .potential = potential,
    .strength = strength,
    .range = range,
    .integrals = integrals,
};
