/* ball.c - the row of the system `ball`: the rubber Chaplygin ball (9), in its own time t.
 *
 *     J w' = J w x w + lambda n,     n' = k n x w,     (w,n) = 0,     |n| = 1
 *
 * lambda n is the torque that keeps the ball from twisting. It follows from (w,n)' = (w',n) = 0 (n' is orthogonal to
 * w), so with u = J^-1 n and g = (n, u)
 *
 *     w' = J^-1 x + lambda u,     lambda = -(x,u)/g,     x = J w x w .
 *
 * Where the moments differ much, the two terms are max J/min J times larger than their sum. But the sum is a double
 * vector product, g J^-1 x - (x,u) u = n x (J^-1 x x u) = n x J(x x n)/det J, and x x n = (n,Jw) w on (w,n) = 0:
 *
 *     w' = (n,Jw) n x Jw / (g det J) ,
 *
 * Here only (n,Jw) can cancel, where the moments are nearly equal. (n,(J - min J) w) is the same number, since (w,n)
 * = 0, and does not cancel. Where rounding errors break (w,n) = 0, this form still has (w',n) = 0, and does not turn
 * fast about n, as J w x w does.
 */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/integrals_impl.h"

/* A second statement: `ball` and `rigid` of series/recurrences_impl.h give the same at order 0. It is kept because it
 * is faster: 180 instructions a call, the recurrences need 310. rhs is 19 % of the instructions of a run by rk8pd, so
 * that the run would need 14 % more. Measured by
 *
 *     valgrind --tool=callgrind isoroll run --method rk8pd SCENE
 *
 * for a free ball, k = 0.5, J = (1.4, 2.1, 3), to t = 1000.
 * tests/model/test_effects.c holds the two against each other. */
static void rhs(const iso_problem *f, const double y[ISO_STATE], double dy[ISO_STATE])
{
    const iso_params *p = &f->p;
    const double *w = y, *n = y + 3, least = min3(p->J);
    const double beyond[3] = {p->J[0] - least, p->J[1] - least, p->J[2] - least};
    double Jw[3], n_Jw[3], turn[3];
    diag(p->J, w, Jw);
    cross(n, Jw, n_Jw);
    cross(n, w, turn);
    const double part = dot_diag(w, beyond, n) / (dot_diag(n, p->inv_J, n) * p->det_J);
    for (int i = 0; i < 3; i++) {
        dy[i] = part * n_Jw[i];
        dy[3 + i] = p->k * turn[i];
    }
}

/* q = (gamma, J gamma) = 1/(n, J^-1 n), taken at the direction of n */
static double ball_q(const iso_params *p, const double y[ISO_STATE], double gradient[ISO_STATE])
{
    const double *n = y + 3, q = 1 / dot_diag(n, p->inv_J, n);
    if (gradient)
        for (int i = 0; i < 3; i++) {
            gradient[i] = 0;
            gradient[3 + i] = -2 * q * q * p->inv_J[i] * n[i];
        }
    return q;
}

/* kinetic energy; a ball that is free to twist has (K,w)/2, K = J w - D (w,n) n */
static inline double kinetic(const iso_problem *f, const double y[])
{
    const double T = dot_diag(y, f->p.J, y) / 2;
    if (!iso_effects_twist(&f->effects)) return T;
    const double spin = dot(y, y + 3);
    return T - f->p.D * spin * spin / 2;
}

static double energy(const iso_problem *f, const double y[], double *size)
{
    const double T = kinetic(f, y), U = iso_effects_potential(f, y);
    *size = T + fmax(fabs(U), iso_effects_range(f, y));
    return T + U;
}

static bool is_rigid(const iso_problem *f)
{
    return !iso_effects_twist(&f->effects);
}

static double spin(const iso_problem *f, const double y[], double *size)
{
    (void)f;
    *size = norm(y);
    return dot(y, y + 3);
}

/* A level adds 2 c det J (u,u)/g, which is the point's 2 H (gamma,J^-1 gamma). */
static double f_plane(const iso_problem *f, const double y[], double *size)
{
    double Jw[3], K[3], u[3];
    diag(f->p.J, y, Jw);
    cross(Jw, y + 3, K);
    *size = dot(Jw, Jw);
    if (!iso_effects_have_level(&f->effects)) return dot(K, K);
    diag(f->p.inv_J, y + 3, u);
    const double rest = 2 * iso_effects_level(&f->effects) * f->p.det_J * dot(u, u) / dot(y + 3, u);
    *size += fabs(rest);
    return dot(K, K) + rest;
}

/* (11), with n^2 = 1 and 2h in place of (w,Jw): h holds the energy of a level as well */
static double f_shell(const iso_problem *f, const double y[], double *size)
{
    const double *n = y + 3;
    double Jw[3], u[3], h_size;
    diag(f->p.J, y, Jw);
    diag(f->p.inv_J, n, u);
    const double h = energy(f, y, &h_size), g = dot(n, u);
    *size = (dot(Jw, Jw) + 2 * f->p.det_J * h_size * dot(u, u)) / g;
    return (dot(Jw, Jw) + 2 * f->p.det_J * h * dot(u, u)) / g;
}

/* g^(1/(2k)) w_axis, for a body that is symmetric about that axis */
static double f_axis(const iso_problem *f, const double y[], int axis, double *size)
{
    const double density = pow(ball_q(&f->p, y, NULL), -1 / (2 * f->p.k));
    *size = density * norm(y);
    return density * y[axis];
}

ISO_OF_AXIS(1)
ISO_OF_AXIS(2)
ISO_OF_AXIS(3)

/* The three relations are restored one after the other, and none disturbs the one before: |n| = 1 by scaling n,
 * (w,n) = 0 by taking the spin out of w, h by scaling w. The spin is taken out along J^-1 n, as the contact's torque
 * does it. Along n, a rounding error of w about a light axis would become a large error of Jw about a heavy one. h is
 * not restored where the ball hardly moves, because there a small error of h is a large one of w. */
static double project(const iso_problem *f, double y[])
{
    const double length_error = make_unit(y + 3) - 1, moving = fmax(norm(y), largest(y));
    double correction = fabs(length_error);
    if (moving == 0) return correction;
    if (!iso_effects_twist(&f->effects)) {
        double u[3];
        const double spin = dot(y, y + 3);
        diag(f->p.inv_J, y + 3, u);
        add_scaled(y, -spin / dot(y + 3, u), u);
        correction = fmax(correction, fabs(spin) / moving);
    }
    const bool is_free = iso_effects_none(&f->effects);
    if (!is_free && !iso_effects_keep_energy(f)) return correction;
    const double T = kinetic(f, y), U = is_free ? 0 : iso_effects_potential(f, y);
    const double falling = is_free ? 0 : fmax(fabs(U), iso_effects_range(f, y)); /* U may be 0 by cancellation */
    if (T < 0.1 * falling || f->energy <= U) return correction;
    const double stretch = sqrt((f->energy - U) / T);
    scale(y, stretch);
    return fmax(correction, fabs(stretch - 1));
}

/* The larger one of |w| and the speed that the potentials can give: |w| is small where a ball turns back. Where
 * resistance brings the ball to rest, the square of w is too small for a double: `largest` needs none. */
static double speed(const iso_problem *f, const double y[])
{
    if (iso_effects_none(&f->effects)) return norm(y);
    return fmax(fmax(norm(y), largest(y)), sqrt(2 * iso_effects_strength(f, y) / max3(f->p.J)));
}

static const char *const state_names[] = {"omega1", "omega2", "omega3", "n1", "n2", "n3"};

static const iso_integral integrals[] = {
    ISO_INTEGRAL("h", 1, 0, 2, energy, .holds = iso_effects_keep_energy,
                 .doc = "energy (w,Jw)/2, with the potentials of its effects"),
    ISO_INTEGRAL("omega.n", 0, 0, 1, spin, .known = ISO_ZERO, .holds = is_rigid, .doc = "no twist: (w,n) = 0"),
    ISO_INTEGRAL("|n|", 0, 0, 0, unit_length, .known = ISO_ONE, .doc = "unit normal: 1"),
    ISO_INTEGRAL("F_plane", 2, 0, 2, f_plane, .holds = holds_plane, .doc = "(Jw x n, Jw x n), k = 1"),
    ISO_INTEGRAL("F_shell", 3, 0, 2, f_shell, .holds = holds_shell,
                 .doc = "[(Jw,Jw) + det J (w,Jw)(J^-1 n,J^-1 n)]/(n,J^-1 n), k = -1 (11)"),
    ISO_AXIS_INTEGRAL(1, "(n,J^-1 n)^(1/(2k)) w1, J2 = J3"),
    ISO_AXIS_INTEGRAL(2, "(n,J^-1 n)^(1/(2k)) w2, J3 = J1"),
    ISO_AXIS_INTEGRAL(3, "(n,J^-1 n)^(1/(2k)) w3, J1 = J2"),
    {0},
};

const iso_system iso_system_ball = {
    .name = "ball",
    .doc = "rubber Chaplygin ball on a sphere or plane, no slip, no twist (9)",
    .clock = ISO_CLOCK_T,
    .state = state_names,
    .fast_dimension = {0, 0, 1},
    .integrals = integrals,
    .rhs = rhs,
    .q = ball_q,
    .energy = energy,
    .project = project,
    .speed = speed,
};
