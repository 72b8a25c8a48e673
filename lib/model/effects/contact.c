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

/* The part of lambda that a torque x has, -(x,u)/g; and u. */
static double resisted(const iso_params *p, const double n[3], const double x[3], double u[3])
{
    diag(p->inv_J, n, u);
    return -dot(x, u) / dot(n, u);
}

void iso_contact_rigid(const iso_problem *f, const double y[], const double T[3], double dy[])
{
    double u[3];
    const double lambda = resisted(&f->p, y + 3, T, u);
    iso_system_ball.rhs(f, y, dy);
    for (int i = 0; i < 3; i++) dy[i] += f->p.inv_J[i] * T[i] + lambda * u[i];
}

double iso_contact_lambda(const iso_problem *f, const double y[], const double T[3])
{
    double Jw[3], u[3], x[3];
    diag(f->p.J, y, Jw);
    cross(Jw, y, x);
    add_scaled(x, 1, T);
    return resisted(&f->p, y + 3, x, u);
}

void iso_contact_twisting(const iso_problem *f, const double y[], const double T[3], double dy[])
{
    const iso_params *p = &f->p;
    const double *n = y + 3, D = p->D;
    double K[3], x[3], u[3];
    contact_momentum(p, y, K);
    cross(K, y, x);
    cross(n, y, dy + 3);
    scale(dy + 3, p->k);
    add_scaled(x, 1, T);
    add_scaled(x, D * dot(y, n), dy + 3);
    diag(p->inv_J, n, u);
    const double along = D * dot(u, x) / (1 - D * dot(n, u));
    for (int i = 0; i < 3; i++) dy[i] = p->inv_J[i] * x[i] + along * u[i];
}
