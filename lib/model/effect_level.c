/* effect_level.c - the potential that gives the twin of a point at any energy (section 5 of theory).
 *
 *     U = -c g^(-1/k),  g = (n, J^-1 n):     MQ = k n x dU/dn = 2 c g^(-1/k - 1) n x J^-1 n
 *
 * On the point U/G = -c det J/k^2 is a constant. No force comes of it: the point's equations are those of the free ball's
 * twin, on the level H = c det J/k^2 in place of 0. That level is the field's `energy`; nothing else is simulated.
 */
#include "base/vec3_impl.h"
#include "model/effects_impl.h"

static void torque(const iso_field *f, const double y[], double T[3])
{
    const double *n = y + 3, g = dot_diag(n, f->p.inv_J, n);
    double u[3], n_u[3];
    diag(f->p.inv_J, n, u);
    cross(n, u, n_u);
    add_scaled(T, 2 * f->effects.level * pow(g, -1 / f->p.k - 1), n_u);
}

static void torque_slope(const iso_field *f, const double y[], int dim, double slope[])
{
    const double *n = y + 3, g = dot_diag(n, f->p.inv_J, n), power = -1 / f->p.k - 1;
    const double factor = 2 * f->effects.level * pow(g, power);
    double u[3], n_u[3];
    diag(f->p.inv_J, n, u);
    cross(n, u, n_u);
    for (int j = 0; j < 3; j++) {
        const double unit[3] = {j == 0, j == 1, j == 2};
        double unit_u[3], n_unit[3];
        cross(unit, u, unit_u);
        cross(n, unit, n_unit);
        add_column(slope, dim, 3 + j, factor * power * 2 * u[j] / g, n_u);
        add_column(slope, dim, 3 + j, factor, unit_u);
        add_column(slope, dim, 3 + j, factor * f->p.inv_J[j], n_unit);
    }
}

static double potential(const iso_field *f, const double y[])
{
    return -f->effects.level * pow(dot_diag(y + 3, f->p.inv_J, y + 3), -1 / f->p.k);
}

static double strength(const iso_field *f, const double y[])
{
    return fabs(potential(f, y));
}

static const iso_effect_number numbers[] = {
    {"c", offsetof(iso_effects, level), 1, {1, -2, 2}},
    {0},
};

const iso_effect iso_effect_level = {
    .name = "level",
    .doc = "potential U = -c (n,J^-1 n)^(-1/k): the ball of a point at the energy H = c det J/k^2",
    .numbers = numbers,
    .torque = torque,
    .torque_slope = torque_slope,
    .potential = potential,
    .strength = strength,
};
