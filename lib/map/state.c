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

void iso_ball_to_point_t(const iso_params *p, const double ball[ISO_STATE], double y[ISO_STATE])
{
    for (int i = 0; i < 3; i++) {
        y[i] = p->root_J[i] * ball[i];
        y[3 + i] = ball[3 + i] / p->root_J[i];
    }
    make_unit(y + 3);
}

void iso_point_t_to_ball(const iso_params *p, const double y[ISO_STATE], double ball[ISO_STATE])
{
    for (int i = 0; i < 3; i++) {
        ball[i] = y[i] / p->root_J[i];
        ball[3 + i] = p->root_J[i] * y[3 + i];
    }
    make_unit(ball + 3);
}

void iso_point_to_point_t(const iso_params *p, const double point[ISO_STATE], double y[ISO_STATE])
{
    const double NN = momentum_factor(p, point + 3);
    for (int i = 0; i < 3; i++) {
        y[i] = point[i] / NN;
        y[3 + i] = point[3 + i];
    }
}

void iso_point_t_to_point(const iso_params *p, const double y[ISO_STATE], double point[ISO_STATE])
{
    const double NN = momentum_factor(p, y + 3);
    for (int i = 0; i < 3; i++) {
        point[i] = NN * y[i];
        point[3 + i] = y[3 + i];
    }
}

void iso_ball_to_point(const iso_params *p, const double ball[ISO_STATE], double point[ISO_STATE])
{
    iso_ball_to_point_t(p, ball, point);
    iso_point_t_to_point(p, point, point);
}

void iso_point_to_ball(const iso_params *p, const double point[ISO_STATE], double ball[ISO_STATE])
{
    iso_point_to_point_t(p, point, ball);
    iso_point_t_to_ball(p, ball, ball);
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
