#include "map/state.h"

#include <math.h>

#include "base/vec3_impl.h"

/* NN of (18), from gamma in both directions. Were it taken from n one way and from gamma the other way, the rounding
 * of n -> gamma would change it by a fixed factor, and w would drift by that factor at each round trip. */
static double momentum_factor(const iso_params *p, const double gamma[3])
{
    const double q = dot_diag(gamma, p->J, gamma) / dot(gamma, gamma);
    return sqrt(p->det_J) / p->k * pow(q, -1 / (2 * p->k));
}

void iso_ball_to_point(const iso_params *p, const double ball[ISO_STATE], double point[ISO_STATE])
{
    double gamma[3];
    for (int i = 0; i < 3; i++) gamma[i] = ball[3 + i] / p->root_J[i];
    make_unit(gamma);
    const double NN = momentum_factor(p, gamma);
    for (int i = 0; i < 3; i++) {
        point[i] = NN * p->root_J[i] * ball[i];
        point[3 + i] = gamma[i];
    }
}

void iso_point_to_ball(const iso_params *p, const double point[ISO_STATE], double ball[ISO_STATE])
{
    const double NN = momentum_factor(p, point + 3);
    double n[3];
    for (int i = 0; i < 3; i++) n[i] = p->root_J[i] * point[3 + i];
    make_unit(n);
    for (int i = 0; i < 3; i++) {
        ball[i] = point[i] / (NN * p->root_J[i]);
        ball[3 + i] = n[i];
    }
}

double iso_coupling(const iso_params *p, double h)
{
    return h * p->det_J / (p->k * p->k);
}

double iso_energy(const iso_params *p, double eps)
{
    return eps / p->det_J * (p->k * p->k);
}

double iso_ball_energy(const iso_params *p, const double ball[ISO_STATE])
{
    return dot_diag(ball, p->J, ball) / 2;
}

double iso_point_energy(const iso_params *p, const double point[ISO_STATE])
{
    const double q = dot_diag(point + 3, p->J, point + 3);
    return p->k * p->k / p->det_J * pow(q, 1 / p->k) * dot(point, point) / 2;
}
