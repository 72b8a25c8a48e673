/* equations.h - what every rival integrates, written by hand as one who knows the problem would. C and C++.
 *
 * Ball (9):    J w' = J w x w + lambda n,  n' = k n x w,  y = (w, n), in its time t.
 * Point (24):  M' = a g x J g,  g' = g x M,  a = (2 eps/k) q^(-1-1/k),  q = (g, J g),  y = (M, g), in its time s.
 * In the ball's time the point's slopes are longer by ds/dt = (k^2/det J) q^(1+1/(2k)).
 * A variation d of the state obeys the equations of first order in d; y may hold some of them behind the state.
 */
#ifndef ISO_TESTS_RIVALS_EQUATIONS_H
#define ISO_TESTS_RIVALS_EQUATIONS_H

#include <math.h>
#include <stdbool.h>

typedef struct rival_problem {
    bool point, in_t; /* in_t: the point, in the ball's time */
    double k, J[3], eps;
    int variations; /* of the point only in its own time */
} rival_problem;

static inline void rival_cross(const double a[], const double b[], double c[])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void rival_ball(const rival_problem *p, const double y[], double dy[])
{
    const double *w = y, *n = y + 3, *J = p->J;
    const double turn[3] = {(J[1] - J[2]) * w[1] * w[2], (J[2] - J[0]) * w[2] * w[0], (J[0] - J[1]) * w[0] * w[1]};
    const double J01 = J[0] * J[1], J02 = J[0] * J[2], J12 = J[1] * J[2]; /* 1/J_i times det J */
    const double a = n[0] * J12, b = n[1] * J02, c = n[2] * J01;
    const double lambda = -(turn[0] * a + turn[1] * b + turn[2] * c) / (n[0] * a + n[1] * b + n[2] * c);
    const double over = 1 / (J01 * J[2]);
    dy[0] = (turn[0] + lambda * n[0]) * (J12 * over);
    dy[1] = (turn[1] + lambda * n[1]) * (J02 * over);
    dy[2] = (turn[2] + lambda * n[2]) * (J01 * over);
    rival_cross(n, w, dy + 3);
    for (int i = 3; i < 6; i++) dy[i] *= p->k;
}

/* q to a power. Most geometries of interest need no pow. */
static inline double rival_power(double q, double power)
{
    if (power == 0) return 1;
    if (power == 1) return q;
    if (power == 0.5) return sqrt(q);
    if (power == -0.5) return 1 / sqrt(q);
    if (power == -2) return 1 / (q * q);
    if (power == -3) return 1 / (q * q * q);
    return pow(q, power);
}

static inline void rival_point_in_t(const rival_problem *p, const double y[], double dy[])
{
    const double *M = y, *g = y + 3, *J = p->J, Jg[3] = {J[0] * g[0], J[1] * g[1], J[2] * g[2]};
    const double q = g[0] * Jg[0] + g[1] * Jg[1] + g[2] * Jg[2], root = rival_power(q, 0.5 / p->k);
    const double shared = p->k / (J[0] * J[1] * J[2]), a = 2 * p->eps * shared / root,
                 rate = p->k * shared * q * root;
    rival_cross(g, Jg, dy);
    rival_cross(g, M, dy + 3);
    for (int i = 0; i < 3; i++) dy[i] *= a, dy[3 + i] *= rate;
}

static inline void rival_point(const rival_problem *p, const double y[], double dy[])
{
    const double *M = y, *g = y + 3, *J = p->J, power = -1 - 1 / p->k;
    const double Jg[3] = {J[0] * g[0], J[1] * g[1], J[2] * g[2]};
    const double q = g[0] * Jg[0] + g[1] * Jg[1] + g[2] * Jg[2], a = 2 * p->eps / p->k * rival_power(q, power);
    double twist[3];
    rival_cross(g, Jg, twist);
    for (int i = 0; i < 3; i++) dy[i] = a * twist[i];
    rival_cross(g, M, dy + 3);
    for (int v = 1; v <= p->variations; v++) {
        const double *dM = y + 6 * v, *dg = dM + 3;
        double *to = dy + 6 * v, one[3], other[3];
        const double Jdg[3] = {J[0] * dg[0], J[1] * dg[1], J[2] * dg[2]};
        const double da = a * power * 2 * (g[0] * Jdg[0] + g[1] * Jdg[1] + g[2] * Jdg[2]) / q;
        rival_cross(dg, Jg, one);
        rival_cross(g, Jdg, other);
        for (int i = 0; i < 3; i++) to[i] = da * twist[i] + a * (one[i] + other[i]);
        rival_cross(dg, M, one);
        rival_cross(g, dM, other);
        for (int i = 0; i < 3; i++) to[3 + i] = one[i] + other[i];
    }
}

static inline void rival_rhs(const rival_problem *p, const double y[], double dy[])
{
    if (!p->point)
        rival_ball(p, y, dy);
    else if (p->in_t)
        rival_point_in_t(p, y, dy);
    else
        rival_point(p, y, dy);
}

static inline void rival_vary_ball(const rival_problem *p, const double y[], double dy[])
{
    const double *w = y, *n = y + 3, *J = p->J, over = 1 / (J[0] * J[1] * J[2]);
    const double inverse[3] = {J[1] * J[2] * over, J[0] * J[2] * over, J[0] * J[1] * over};
    const double apart[3] = {J[1] - J[2], J[2] - J[0], J[0] - J[1]};
    const double turn[3] = {apart[0] * w[1] * w[2], apart[1] * w[2] * w[0], apart[2] * w[0] * w[1]};
    const double a[3] = {n[0] * inverse[0], n[1] * inverse[1], n[2] * inverse[2]};
    const double below = -1 / (n[0] * a[0] + n[1] * a[1] + n[2] * a[2]);
    const double lambda = (turn[0] * a[0] + turn[1] * a[1] + turn[2] * a[2]) * below;
    for (int v = 1; v <= p->variations; v++) {
        const double *dw = y + 6 * v, *dn = dw + 3;
        double *to = dy + 6 * v, one[3], other[3], dlambda = 0;
        const double dturn[3] = {apart[0] * (dw[1] * w[2] + w[1] * dw[2]), apart[1] * (dw[2] * w[0] + w[2] * dw[0]),
                                 apart[2] * (dw[0] * w[1] + w[0] * dw[1])};
        for (int i = 0; i < 3; i++) dlambda += dturn[i] * a[i] + (turn[i] * inverse[i] + 2 * lambda * a[i]) * dn[i];
        dlambda *= below;
        rival_cross(dn, w, one);
        rival_cross(n, dw, other);
        for (int i = 0; i < 3; i++) to[i] = (dturn[i] + lambda * dn[i]) * inverse[i] + dlambda * a[i];
        for (int i = 0; i < 3; i++) to[3 + i] = p->k * (one[i] + other[i]);
    }
}

/* With the slopes of the variations, of the ball too. */
static inline void rival_varied(const rival_problem *p, const double y[], double dy[])
{
    rival_rhs(p, y, dy);
    if (!p->point) rival_vary_ball(p, y, dy);
}

#endif
