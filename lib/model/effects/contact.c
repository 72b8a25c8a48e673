/* contact.c - the ball's w' under torques: with a contact that cannot twist, and with one that can.
 *
 * rigid: with u = J^-1 n, g = (n,u)
 *
 *     w' = that of the free ball (ball.c) + J^-1 T - (T,u)/g u              so that (w',n) = 0
 *     lambda = -(J w x w + T, u)/g
 *
 * twisting: with s = (w,n), A = J - D n n^T, and (w,n') = 0
 *
 *     A w' = x,     x = K x w + T + D s n'
 *     A^-1 x = J^-1 x + D (u,x)/(1 - D g) u                                  (Sherman-Morrison)
 */
#include "model/effects/contact_impl.h"

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/model_impl.h"

static void turn_of_normal(const iso_problem *f, const double y[], double n_dot[3])
{
    cross(y + 3, y, n_dot);
    scale(n_dot, f->p.k);
}

/* --- rigid ------------------------------------------------------------------------------------------------------ */

/* The part of lambda that a torque x has, -(x,u)/g; and u */
static double resisted(const iso_params *p, const double n[3], const double x[3], double u[3])
{
    diag(p->inv_J, n, u);
    return -dot(x, u) / dot(n, u);
}

static void rigid_solve(const iso_problem *f, const double y[], const double T[3], double dy[])
{
    double u[3];
    const double lambda = resisted(&f->p, y + 3, T, u);
    iso_system_ball.rhs(f, y, dy);
    for (int i = 0; i < 3; i++) dy[i] += f->p.inv_J[i] * T[i] + lambda * u[i];
}

static double rigid_twist(const iso_problem *f, const double y[], const double T[3])
{
    double Jw[3], u[3], x[3];
    diag(f->p.J, y, Jw);
    cross(Jw, y, x);
    add_scaled(x, 1, T);
    return resisted(&f->p, y + 3, x, u);
}

/* --- twisting --------------------------------------------------------------------------------------------------- */

/* v = A^-1 x */
static void solve_A(const iso_params *p, const double n[3], const double x[3], double v[3])
{
    double u[3];
    diag(p->inv_J, n, u);
    const double along = p->D * dot(u, x) / (1 - p->D * dot(n, u));
    for (int i = 0; i < 3; i++) v[i] = p->inv_J[i] * x[i] + along * u[i];
}

static void twisting_solve(const iso_problem *f, const double y[], const double T[3], double dy[])
{
    double K[3], x[3];
    contact_momentum(&f->p, y, K);
    cross(K, y, x);
    turn_of_normal(f, y, dy + 3);
    add_scaled(x, 1, T);
    add_scaled(x, f->p.D * dot(y, y + 3), dy + 3);
    solve_A(&f->p, y + 3, x, dy);
}

static double twisting_twist(const iso_problem *f, const double y[], const double T[3])
{
    (void)T;
    return iso_effects_twist_torque(f, y);
}

const iso_contact iso_contact_rigid = {rigid_solve, rigid_twist},
                  iso_contact_twisting = {twisting_solve, twisting_twist};

const iso_contact *iso_contact_of(const iso_problem *f)
{
    return iso_effects_twist(&f->effects) ? &iso_contact_twisting : &iso_contact_rigid;
}
