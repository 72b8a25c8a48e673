/* section.c - the chart (l, x) of the section gamma_a = 0, its slopes, and Sturm's bounds between crossings. */
#include "map/section.h"

#include <math.h>

#include "base/pi_impl.h"
#include "base/vec3_impl.h"

int iso_section_axis(const iso_params *p)
{
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (p->k > 0 ? p->J[i] > p->J[axis] : p->J[i] < p->J[axis]) axis = i;
    return axis;
}

bool iso_section_is_global(const iso_params *p, int axis)
{
    return p->J[axis] == p->J[iso_section_axis(p)];
}

bool iso_section_is_rotation(const double y[ISO_STATE], int axis)
{
    const double swing = fmax(fabs(y[(axis + 1) % 3]), fabs(y[(axis + 2) % 3])) / largest(y);
    return fmax(fabs(y[3 + axis]), swing) <= 1e-14;
}

/* The components b and c, which take the places of 1 and 2 in the equations for a = 3. */
static void sides(int axis, int *b, int *c)
{
    *b = (axis + 1) % 3;
    *c = (axis + 2) % 3;
}

/* q on the section, and dq/dl */
static double section_q(const iso_params *p, int axis, double l, double *slope)
{
    int b, c;
    sides(axis, &b, &c);
    const double C = cos(l), S = sin(l);
    *slope = 2 * (p->J[c] - p->J[b]) * S * C;
    return p->J[b] * C * C + p->J[c] * S * S;
}

double iso_section_momentum(const iso_params *p, double eps, int axis, double l)
{
    double unused;
    return sqrt(2 * eps) * pow(section_q(p, axis, l, &unused), -1 / (2 * p->k));
}

void iso_section_point(const iso_params *p, double eps, int axis, double l, double x, double point[ISO_STATE])
{
    int b, c;
    sides(axis, &b, &c);
    const double G = iso_section_momentum(p, eps, axis, l), across = G * sqrt((1 - x) * (1 + x));
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
    int b, c;
    sides(axis, &b, &c);
    *l = atan2(0 - point[3 + c], point[3 + b]); /* 0 - 0 is +0, so l is never -pi */
    const double size = largest(point);         /* the square of M need not fit a double */
    const double M[3] = {point[0] / size, point[1] / size, point[2] / size};
    *x = M[axis] / norm(M);
}

void iso_section_deviations(const iso_params *p, double eps, int axis, double l, double x, double by_l[ISO_STATE],
                            double by_x[ISO_STATE])
{
    int b, c;
    sides(axis, &b, &c);
    double turn, point[ISO_STATE];
    iso_section_point(p, eps, axis, l, x, point);
    const double q = section_q(p, axis, l, &turn), stretch = -turn / (2 * p->k * q); /* G'/G */
    const double G = iso_section_momentum(p, eps, axis, l), root = sqrt((1 - x) * (1 + x));
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

/* (24) */
static void flow(const iso_params *p, double eps, const double point[ISO_STATE], double rate[ISO_STATE])
{
    const double *M = point, *gamma = point + 3;
    double J_gamma[3];
    diag(p->J, gamma, J_gamma);
    cross(gamma, J_gamma, rate);
    scale(rate, 2 * eps / p->k * pow(dot(gamma, J_gamma), -1 - 1 / p->k));
    cross(gamma, M, rate + 3);
}

void iso_section_slope(const iso_params *p, double eps, int axis, const double point[ISO_STATE],
                       const double deviation[ISO_STATE], double slope[2])
{
    int b, c;
    sides(axis, &b, &c);
    double rate[ISO_STATE], d[ISO_STATE];
    flow(p, eps, point, rate);
    const double ahead = deviation[3 + axis] / rate[3 + axis];
    for (int i = 0; i < ISO_STATE; i++) d[i] = deviation[i] - ahead * rate[i];
    const double *M = point, *gamma = point + 3, size = norm(M), x = M[axis] / size;
    slope[0] = (gamma[c] * d[3 + b] - gamma[b] * d[3 + c]) / (gamma[b] * gamma[b] + gamma[c] * gamma[c]);
    slope[1] = (d[axis] - x * dot(M, d) / size) / size;
}

/* W^2 at q. J_a - (1-k) q is computed as (J_a - q) + k q, which loses no digits at q = J_a for small k. */
static double frequency_square(const iso_params *p, double eps, int axis, double q)
{
    return 2 * eps * pow(q, -1 - 1 / p->k) * ((p->J[axis] - q) / p->k + q);
}

/* Both bounds come from the ends of [min J, max J]. Between them, W^2 can have an extreme only at q = J_a
 * (1+k)/(1-k). There J_a - (1-k) q = -k J_a, and so W^2 < 0. This bracket is linear in q, so W^2 <= 0 at one of the
 * ends as well. */
void iso_section_bounds(const iso_params *p, double eps, int axis, double W[2])
{
    const double low = frequency_square(p, eps, axis, min3(p->J)), high = frequency_square(p, eps, axis, max3(p->J));
    W[0] = sqrt(fmax(fmin(low, high), 0));
    W[1] = sqrt(fmax(low, high));
}
