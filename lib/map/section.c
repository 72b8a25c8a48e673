/* section.c - the chart (l, x) of the section gamma_a = 0, its slopes, and Sturm's bounds between crossings. */
#include "map/section.h"

#include <math.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "map/section_impl.h"
#include "model/effects/effects_impl.h"

int iso_section_axis(iso_point_motion m)
{
    const double *J = m.p->J;
    const bool most = (m.eps < 0) != (m.p->k > 0);
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (most ? J[i] > J[axis] : J[i] < J[axis]) axis = i;
    return axis;
}

bool iso_section_is_global(iso_point_motion m, int axis)
{
    double W[2];
    iso_section_bounds(m, axis, W);
    return W[0] > 0 || m.p->J[axis] == m.p->J[iso_section_axis(m)];
}

bool iso_section_is_rotation(const double y[ISO_STATE], int axis)
{
    const double swing = fmax(fabs(y[(axis + 1) % 3]), fabs(y[(axis + 2) % 3])) / largest(y);
    return fmax(fabs(y[3 + axis]), swing) <= 1e-14;
}

/* q on the section, and dq/dl */
static double section_q(const iso_params *p, int axis, double l, double *slope)
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3; /* in place of 1 and 2 in the equations for a = 3 */
    const double C = cos(l), S = sin(l);
    *slope = 2 * (p->J[c] - p->J[b]) * S * C;
    return p->J[b] * C * C + p->J[c] * S * S;
}

double iso_section_momentum_at(double k, double eps, double energy, double q)
{
    if (energy == 0) return sqrt(2 * eps) * pow(q, -1 / (2 * k)); /* half the power: it fits a double for more k */
    return sqrt(2 * fmax(0, energy + eps * pow(q, -1 / k)));
}

double iso_section_momentum(iso_point_motion m, int axis, double l)
{
    double unused;
    return iso_section_momentum_at(m.p->k, m.eps, m.energy, section_q(m.p, axis, l, &unused));
}

bool iso_section_is_open(iso_point_motion m, int axis, double l)
{
    return iso_section_momentum(m, axis, l) > 0;
}

void iso_section_point(iso_point_motion m, int axis, double l, double x, double point[ISO_STATE])
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const double G = iso_section_momentum(m, axis, l), across = G * sqrt((1 - x) * (1 + x));
    double *M = point, *gamma = point + 3;
    M[b] = across * sin(l);
    M[c] = across * cos(l);
    M[axis] = G * x;
    gamma[b] = cos(l);
    gamma[c] = -sin(l);
    gamma[axis] = 0;
}

void iso_section_chart(int axis, const double point[ISO_STATE], double *l, double *x)
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    *l = atan2(0 - point[3 + c], point[3 + b]); /* 0 - 0 is +0, so l is never -pi */
    const double size = largest(point);         /* the square of M need not fit a double */
    const double M[3] = {point[0] / size, point[1] / size, point[2] / size};
    *x = M[axis] / norm(M);
}

unsigned iso_section_reversors(const iso_problem *f, int axis)
{
    unsigned holds = 0;
    for (int i = 0; i < 3; i++) { /* S1 keeps gamma_b and gamma_c, S2 turns gamma_c over, S3 turns gamma_b over */
        double sign[3] = {1, 1, 1};
        sign[axis] = -1;
        if (i > 0) sign[(axis + 3 - i) % 3] = -1;
        if (iso_effects_reversible(f, sign)) holds |= 1u << i;
    }
    return holds;
}

/* G'/G = -(q'/(2 k q)) (2 eps q^(-1/k)/G^2), and this last factor is 1 - 2 E/G^2 */
void iso_section_deviations(iso_point_motion m, int axis, double l, double x, double by_l[ISO_STATE],
                            double by_x[ISO_STATE])
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    double turn, point[ISO_STATE];
    iso_section_point(m, axis, l, x, point);
    const double q = section_q(m.p, axis, l, &turn), G = iso_section_momentum(m, axis, l);
    const double stretch = -turn / (2 * m.p->k * q) * (1 - 2 * (m.energy / G) / G);
    const double root = sqrt((1 - x) * (1 + x));
    by_l[b] = stretch * point[b] + G * root * cos(l);
    by_l[c] = stretch * point[c] - G * root * sin(l);
    by_l[axis] = stretch * point[axis];
    by_l[3 + b] = -sin(l);
    by_l[3 + c] = -cos(l);
    by_x[b] = -G * x / root * sin(l);
    by_x[c] = -G * x / root * cos(l);
    by_x[axis] = G;
    by_x[3 + b] = by_x[3 + c] = by_l[3 + axis] = by_x[3 + axis] = 0;
}

void iso_section_slope(int axis, const double point[ISO_STATE], const double rate[ISO_STATE],
                       const double deviation[ISO_STATE], double slope[2])
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    double d[ISO_STATE];
    const double ahead = deviation[3 + axis] / rate[3 + axis];
    for (int i = 0; i < ISO_STATE; i++) d[i] = deviation[i] - ahead * rate[i];
    const double *M = point, *gamma = point + 3, size = norm(M), x = M[axis] / size;
    slope[0] = (gamma[c] * d[3 + b] - gamma[b] * d[3 + c]) / (gamma[b] * gamma[b] + gamma[c] * gamma[c]);
    slope[1] = (d[axis] - x * dot(M, d) / size) / size;
}

/* W^2 at q. J_a - (1-k) q is computed as (J_a - q) + k q, which loses no digits at q = J_a for small k. */
static double frequency_square(iso_point_motion m, int axis, double q)
{
    const double k = m.p->k;
    return 2 * m.energy + 2 * m.eps * pow(q, -1 - 1 / k) * ((m.p->J[axis] - q) / k + q);
}

void iso_section_range(iso_point_motion m, double q[2])
{
    q[0] = min3(m.p->J);
    q[1] = max3(m.p->J);
    if (!(m.energy / m.eps < 0)) return;
    const double border = fmin(fmax(pow(-m.energy / m.eps, -m.p->k), q[0]), q[1]);
    q[m.eps / m.p->k > 0] = border;
}

/* The bounds come from the ends of the range of q, and from the one extreme of W^2 that may lie between them: the
 * derivative of q^(-1-1/k) [J_a - (1-k) q] is 0 at q = J_a (1+k)/(1-k), for every E. */
void iso_section_bounds(iso_point_motion m, int axis, double W[2])
{
    double range[2];
    iso_section_range(m, range);
    const double low = frequency_square(m, axis, range[0]), high = frequency_square(m, axis, range[1]);
    const double between = m.p->J[axis] * (1 + m.p->k) / (1 - m.p->k);
    double least = fmin(low, high), most = fmax(low, high);
    if (between > range[0] && between < range[1]) {
        least = fmin(least, frequency_square(m, axis, between));
        most = fmax(most, frequency_square(m, axis, between));
    }
    W[0] = sqrt(fmax(least, 0));
    W[1] = sqrt(fmax(most, 0));
}

/* --- the level -------------------------------------------------------------------------------------------------- */

static double middle(const double J[3])
{
    return fmax(fmin(J[0], J[1]), fmin(fmax(J[0], J[1]), J[2]));
}

double iso_level_energy(const iso_params *p, double level)
{
    return level == 0 ? 0 : level * pow(middle(p->J), -1 / p->k);
}

double iso_level_of(const iso_params *p, double energy)
{
    return energy == 0 ? 0 : energy * pow(middle(p->J), 1 / p->k);
}
