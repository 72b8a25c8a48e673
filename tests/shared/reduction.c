/* reduction.c - energy, force and momenta of the ball in sphero-conical coordinates, (14)-(17) (reduction.h). */
#include "reduction.h"

#include <math.h>

#include "base/vec3_impl.h"

/* A(z_r), from the distances that iso_conical carries */
static double A(const iso_conical *c, int r)
{
    return -c->above[r][0] * c->above[r][1] * c->above[r][2];
}

/* a and b of T = a lam'^2 + b mu'^2 */
static void inertia(const iso_params *p, const iso_conical *c, double coefficient[2])
{
    const double lam = c->z[0], mu = c->z[1], common = (mu - lam) / (8 * p->k * p->k);
    coefficient[0] = -common * mu / A(c, 0);
    coefficient[1] = common * lam / A(c, 1);
}

void reduction_coordinates(const iso_params *p, const double ball[ISO_STATE], iso_conical *c)
{
    double velocity[3];
    cross(ball + 3, ball, velocity);
    scale(velocity, p->k);
    iso_conical_from_vector(p->J, ball + 3, velocity, c);
}

/* omega = n' x n/k */
void reduction_ball(const iso_params *p, const iso_conical *c, double ball[ISO_STATE])
{
    double velocity[3];
    iso_conical_to_vector(p->J, c, ball + 3, velocity);
    cross(velocity, ball + 3, ball);
    scale(ball, 1 / p->k);
}

double reduction_energy(const iso_params *p, const iso_conical *c)
{
    double m[2];
    inertia(p, c, m);
    return m[0] * c->rate[0] * c->rate[0] + m[1] * c->rate[1] * c->rate[1];
}

double reduction_force(const iso_params *p, const iso_conical *c)
{
    const double k = p->k;
    return (2 * k - 1) / (8 * k * k * k) * (c->z[0] - c->z[1]) * (c->rate[0] / A(c, 0) + c->rate[1] / A(c, 1));
}

double reduction_multiplier(const iso_params *p, const iso_conical *c)
{
    return pow(c->z[0] * c->z[1] / p->det_J, -1 + 1 / (2 * p->k));
}

void reduction_momenta(const iso_params *p, const iso_conical *c, double momenta[2])
{
    const double N = reduction_multiplier(p, c);
    inertia(p, c, momenta);
    for (int r = 0; r < 2; r++) momenta[r] *= 2 * N * c->rate[r];
}

void reduction_angle_momenta(const iso_params *p, const iso_conical *c, double momenta[2])
{
    const double N = reduction_multiplier(p, c);
    for (int r = 0; r < 2; r++) momenta[r] = N * c->z[1 - r] * c->length[r] * c->speed[r] / (p->k * p->k);
}

double reduction_hamiltonian(const iso_params *p, const iso_conical *c, const double momenta[2])
{
    const double N = reduction_multiplier(p, c);
    double m[2], H = 0;
    inertia(p, c, m);
    for (int r = 0; r < 2; r++) H += momenta[r] * momenta[r] / (4 * m[r] * N * N);
    return H;
}
