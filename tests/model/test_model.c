/* The equations of both systems: constraints, measure, symmetries, closed forms. Their Jacobians and clocks, with
 * effects and without: test_effects.c. */
#include "laws.h"

/* Size of the terms that y' = f is made of, which may cancel. Ball: J^-1 (J w x w) and lambda J^-1 n, up to
 * |w|^2 max J/min J. Point: (|M|^2/k) gamma x J gamma/q, where |J gamma|^2 <= max J q. */
static void sizes(const laws_case *c, double size[2])
{
    const double speed = c->system->speed(&c->problem, c->y), k = fabs(c->problem.p.k),
                 spread = laws_spread(&c->problem.p);
    const bool ball = c->system == &iso_system_ball;
    size[0] = speed * speed * (ball ? spread : sqrt(spread) / k);
    size[1] = speed * (ball ? k : 1);
}

static void value_of_q(const void *data, const double y[], double q[])
{
    const laws_case *c = data;
    q[0] = c->system->q(&c->problem.p, y, NULL);
}

static void gradient_of_q(const laws_case *c, laws_worst *worst)
{
    double gradient[ISO_STATE], slope;
    const double q = c->system->q(&c->problem.p, c->y, gradient);
    for (int j = 0; j < ISO_STATE; j++) {
        double direction[ISO_STATE] = {0};
        direction[j] = 1;
        const double h = laws_step(c, direction);
        laws_slope(value_of_q, c, 1, ISO_STATE, c->y, direction, h, &slope);
        laws_note(worst, fabs(slope - gradient[j]), 8 * DBL_EPSILON * q / h, &c->problem.p, "");
    }
}

/* (w,n) and |n| stay: the flow is tangent to them. */
static void constraints_tangent(const laws_case *c, laws_worst *worst)
{
    double f[ISO_STATE], size[2];
    c->system->rhs(&c->problem, c->y, f);
    sizes(c, size);
    laws_note(worst, fabs(dot(f, c->y + 3) + dot(c->y, f + 3)),
              8 * DBL_EPSILON * (size[0] + norm(c->y) * norm(f + 3)), &c->problem.p, "orthogonal");
    laws_note(worst, fabs(dot(f + 3, c->y + 3)), 4 * DBL_EPSILON * size[1], &c->problem.p, "unit");
}

static void own_jacobian(const laws_case *c, double jac[ISO_STATE * ISO_STATE])
{
    const iso_model m =
        iso_model_assemble(c->system, &c->problem, c->system->clock, (const bool[ISO_CLOCKS]){false, false, false});
    m.jacobian(&m, c->y, jac);
}

/* (10): div f + d/dt log g^(1/(2k)) = 0 for the ball; the point's flow keeps dM dgamma. */
static void invariant_measure(const laws_case *c, laws_worst *worst)
{
    double f[ISO_STATE], jac[ISO_STATE * ISO_STATE], dq[ISO_STATE];
    double divergence = 0, size = 0, density = 0;
    c->system->rhs(&c->problem, c->y, f);
    own_jacobian(c, jac);
    const double q = c->system->q(&c->problem.p, c->y, dq);
    for (int i = 0; i < ISO_STATE; i++) {
        divergence += jac[7 * i];
        size += fabs(jac[7 * i]);
        density -= dq[i] * f[i] / (q * 2 * c->problem.p.k); /* log g = -log q */
    }
    const bool ball = c->system == &iso_system_ball;
    if (!ball) density = 0;
    size += ball ? laws_spread(&c->problem.p) * norm(c->y) : 0;
    laws_note(worst, fabs(divergence + density), 8 * DBL_EPSILON * size + DBL_MIN, &c->problem.p, "");
}

/* ... and without the density the ball's flow does contract and expand, but for k -> infinity and equal moments. */
static void bare_divergence(const laws_case *c, laws_worst *worst)
{
    double jac[ISO_STATE * ISO_STATE], divergence = 0;
    own_jacobian(c, jac);
    for (int i = 0; i < ISO_STATE; i++) divergence += jac[7 * i];
    laws_note(worst, fabs(divergence) / norm(c->y), 0.01, &c->problem.p, "");
}

/* Theory, section 9: in the principal plane n_axis = 0 a ball that spins about the axis keeps its w, and n turns at
 * k |w|. The point's M keeps its axis too, and gamma turns in the same plane. */
static void principal_plane(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    for (int axis = 0; axis < 3; axis++) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        double y[ISO_STATE] = {0}, f[ISO_STATE];
        const double W = y[axis] = iso_random_normal(c->random), angle = iso_random_uniform(c->random, 0, 2 * M_PI);
        y[3 + i] = cos(angle), y[3 + j] = sin(angle);
        c->system->rhs(&c->problem, y, f);
        const double turn = (c->system == &iso_system_ball ? p->k : 1) * W;
        laws_note(worst, fabs(f[3 + i] - turn * y[3 + j]), 2 * DBL_EPSILON * fabs(turn), p, "turn");
        laws_note(worst, fabs(f[3 + j] + turn * y[3 + i]), 2 * DBL_EPSILON * fabs(turn), p, "turn");
        laws_note(worst, fabs(f[3 + axis]) + fabs(f[i]) + fabs(f[j]), DBL_MIN, p, "plane");
        if (c->system == &iso_system_ball) laws_note(worst, fabs(f[axis]), DBL_MIN, p, "w");
    }
}

/* Equal moments: w stays, n moves on a great circle at rate k |w|; M and q stay. */
static void equal_moments(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    if (laws_spread(p) != 1) return;
    double f[ISO_STATE];
    c->system->rhs(&c->problem, c->y, f);
    const double k = c->system == &iso_system_ball ? p->k : 1, speed = norm(c->y);
    const double force = c->system == &iso_system_ball ? speed * speed : speed * speed / fabs(p->k);
    laws_note(worst, norm(f), 4 * DBL_EPSILON * force, p, "fast");
    laws_note(worst, fabs(norm(f + 3) - fabs(k) * speed), 4 * DBL_EPSILON * fabs(k) * speed, p, "unit");
}

/* The size of each component for error control. */
static void component_size(const laws_case *c, laws_worst *worst)
{
    const iso_model m =
        iso_model_assemble(c->system, &c->problem, ISO_CLOCK_TAU, (const bool[ISO_CLOCKS]){true, true, true});
    double y[ISO_MAX_STATE] = {0}, dy[ISO_MAX_STATE], size[ISO_MAX_STATE];
    copy(c->y, y, ISO_STATE);
    y[6] = -3, y[7] = 5;
    m.rhs(&m, y, dy);
    iso_model_size(&m, y, size);
    for (int i = 0; i < 3; i++) {
        laws_note(worst, fabs(size[i] / norm(y) - 1), laws_rounding(&c->problem.p) * 4, &c->problem.p, "fast");
        laws_note(worst, fabs(size[3 + i] - 1), 4 * DBL_EPSILON, &c->problem.p, "unit");
    }
    for (int i = 6; i < 8; i++)
        laws_note(worst, fabs(size[i] - fabs(y[i]) - dy[i]), 4 * DBL_EPSILON * size[i], &c->problem.p, "clock");
}

int main(void)
{
    laws_hold("gradient of q", NULL, gradient_of_q);
    laws_hold("flow tangent to the constraints", NULL, constraints_tangent);
    laws_hold("invariant measure (10)", NULL, invariant_measure);
    laws_fail("divergence without the density", &iso_system_ball, bare_divergence);
    laws_hold("rotation in a principal plane", NULL, principal_plane);
    laws_hold("equal moments", NULL, equal_moments);
    laws_hold("component sizes", NULL, component_size);
    exit(gsl_test_summary());
}
