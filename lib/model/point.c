/* point.c - the row of the system `point`: a point on the unit sphere in the potential of Neumann and Braden (24), in
 * its own time s.
 *
 *     H = M^2/2 + V(gamma),     V = -eps q^(-1/k),     q = (gamma, J gamma)
 *     M' = gamma x dV/dgamma = a gamma x J gamma,      a = (2 eps/k) q^(-1-1/k)
 *     gamma' = gamma x M,     (M,gamma) = 0,     |gamma| = 1
 *
 * k = -1: V = -eps (gamma, J gamma), Neumann's problem;  k = 1: V = -eps/(gamma, J gamma), Braden's. An orbit on the
 * level H = 0 is a free ball's; the ball's integrals follow from (18) and, completed by terms with H, hold on every
 * level.
 */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/integrals_impl.h"
#include "model/system.h"

static double point_q(const iso_params *p, const double y[ISO_STATE], double gradient[ISO_STATE])
{
    const double *gamma = y + 3;
    if (gradient)
        for (int i = 0; i < 3; i++) {
            gradient[i] = 0;
            gradient[3 + i] = 2 * p->J[i] * gamma[i];
        }
    return dot_diag(gamma, p->J, gamma);
}

/* A second statement: `point_24` of series/recurrences_impl.h is the same at order 0. It is kept because it is
 * faster: 250 instructions a call, the recurrence needs 320. Counted as in ball.c, and held against the recurrence by
 * the same test. */
static void rhs(const iso_problem *f, const double y[ISO_STATE], double dy[ISO_STATE])
{
    const double *M = y, *gamma = y + 3, k = f->p.k;
    double Jgamma[3];
    diag(f->p.J, gamma, Jgamma);
    cross(gamma, Jgamma, dy);
    scale(dy, 2 * f->eps / k * (k == -1 ? 1 : pow(dot(gamma, Jgamma), -1 - 1 / k)));
    cross(gamma, M, dy + 3);
}

/* V. *size: the sum of the sizes of its terms, which may cancel. */
static double potential(const iso_problem *f, const double y[], double *size)
{
    const double V = -f->eps * pow(point_q(&f->p, y, NULL), -1 / f->p.k), image = iso_effects_image(f, y);
    *size = fabs(V) + fabs(image);
    return V + image;
}

static double energy(const iso_problem *f, const double y[], double *size)
{
    const double T = dot(y, y) / 2, V = potential(f, y, size);
    *size += T;
    return T + V;
}

static double spin(const iso_problem *f, const double y[], double *size)
{
    *size = iso_system_point.speed(f, y);
    return dot(y, y + 3);
}

/* (gamma', J^-1 gamma') + 2 H (gamma, J^-1 gamma), where (gamma', J^-1 gamma')' = -2 H (gamma, J^-1 gamma)' */
static double f_plane(const iso_problem *f, const double y[], double *size)
{
    const double *M = y, *gamma = y + 3, *inv_J = f->p.inv_J;
    double velocity[3], H_size;
    cross(gamma, M, velocity);
    const double kinetic = dot_diag(velocity, inv_J, velocity), shift = 2 * dot_diag(gamma, inv_J, gamma);
    const double F = kinetic + shift * energy(f, y, &H_size);
    *size = kinetic + shift * H_size;
    return F;
}

/* Neumann's integral (M, J M)/det J + 2 eps (gamma, J^-1 gamma) */
static double f_shell(const iso_problem *f, const double y[], double *size)
{
    const double *M = y, *gamma = y + 3;
    const double kinetic = dot_diag(M, f->p.J, M) / f->p.det_J,
                 rest = 2 * f->eps * dot_diag(gamma, f->p.inv_J, gamma);
    *size = kinetic + fabs(rest);
    return kinetic + rest;
}

/* M_axis divided by the factor of (18): this is the ball's integral of the same name */
static double f_axis(const iso_problem *f, const double y[], int axis, double *size)
{
    const double factor = f->p.k / (sqrt(f->p.det_J) * f->p.root_J[axis]);
    *size = fabs(factor) * iso_system_point.speed(f, y);
    return factor * y[axis];
}

ISO_OF_AXIS(1)
ISO_OF_AXIS(2)
ISO_OF_AXIS(3)

/* As for the ball: at turning points M is small, and H cannot be restored by scaling M. */
static double project(const iso_problem *f, double y[])
{
    const double length_error = make_unit(y + 3) - 1;
    const double size = iso_system_point.speed(f, y);
    if (size == 0) return fabs(length_error);
    const double correction = fmax(fabs(length_error), fabs(remove_along(y, y + 3)) / size);
    double falling;
    const double T = dot(y, y) / 2, V = potential(f, y, &falling);
    if (T == 0 || T < 0.1 * falling || f->energy <= V) return correction;
    const double stretch = sqrt((f->energy - V) / T);
    scale(y, stretch);
    return fmax(correction, fabs(stretch - 1));
}

/* |M|, or what it would be on the level H = 0: off that level M goes through zero */
static double speed(const iso_problem *f, const double y[])
{
    double falling;
    potential(f, y, &falling);
    return fmax(norm(y), sqrt(2 * falling));
}

static const char *const state_names[] = {"M1", "M2", "M3", "gamma1", "gamma2", "gamma3"};

static const iso_integral integrals[] = {
    ISO_INTEGRAL("H", 4, -2, 2, energy, .doc = "energy M^2/2 - eps (gamma,J gamma)^(-1/k) (24)"),
    ISO_INTEGRAL("M.gamma", 2, -1, 1, spin, .known = ISO_ZERO, .doc = "(M,gamma) = 0 (19)"),
    ISO_INTEGRAL("|gamma|", 0, 0, 0, unit_length, .known = ISO_ONE, .doc = "point on the unit sphere: 1 (19)"),
    ISO_INTEGRAL("F_plane", 2, 0, 2, f_plane, .holds = holds_plane,
                 .doc = "(gamma',J^-1 gamma') + 2 H (gamma,J^-1 gamma), k = 1"),
    ISO_INTEGRAL("F_shell", 3, 0, 2, f_shell, .holds = holds_shell,
                 .doc = "(M,J M)/det J + 2 eps (gamma,J^-1 gamma), k = -1"),
    ISO_AXIS_INTEGRAL(1, "k M1/sqrt(J1 det J), J2 = J3"),
    ISO_AXIS_INTEGRAL(2, "k M2/sqrt(J2 det J), J3 = J1"),
    ISO_AXIS_INTEGRAL(3, "k M3/sqrt(J3 det J), J1 = J2"),
    {0},
};

const iso_system iso_system_point = {
    .name = "point",
    .doc = "point on a sphere in the potential -eps (gamma,J gamma)^(-1/k) (24)",
    .clock = ISO_CLOCK_S,
    .state = state_names,
    .fast_dimension = {2, -1, 1},
    .integrals = integrals,
    .rhs = rhs,
    .q = point_q,
    .energy = energy,
    .project = project,
    .speed = speed,
};
