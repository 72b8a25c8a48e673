/* contact.c - the ball's w' under torques: with a contact that cannot twist, and with one that can.
 *
 * rigid: with u = J^-1 n, g = (n,u)
 *
 *     w' = that of the free ball (ball.c) + J^-1 T - (T,u)/g u              so that (w',n) = 0
 *     lambda = -(J w x w + T, u)/g
 *
 * loose: with s = (w,n), A = J - D n n^T, and (w,n') = 0
 *
 *     A w' = x,     x = K x w + T + D s n'
 *     A^-1 x = J^-1 x + D (u,x)/(1 - D g) u                                  (Sherman-Morrison)
 */
#include "model/contact_impl.h"

#include "base/vec3_impl.h"
#include "model/system.h"

static void turn_of_normal(const iso_field *f, const double y[], double n_dot[3])
{
    cross(y + 3, y, n_dot);
    scale(n_dot, f->p.k);
}

/* The rows of n' = k n x w; the rest of them is 0. */
static void slope_of_normal(const iso_field *f, const double y[], int dim, double jac[])
{
    for (int j = 0; j < 3; j++) {
        const double unit[3] = {j == 0, j == 1, j == 2};
        double n_unit[3], unit_w[3];
        cross(y + 3, unit, n_unit);
        cross(unit, y, unit_w);
        for (int i = 0; i < 3; i++) {
            jac[dim * (3 + i) + j] = f->p.k * n_unit[i];
            jac[dim * (3 + i) + 3 + j] = f->p.k * unit_w[i];
        }
    }
}

/* --- rigid -------------------------------------------------------------------------------------------------------- */

/* The part of lambda that a torque x has, -(x,u)/g; and u */
static double resisted(const iso_params *p, const double n[3], const double x[3], double u[3])
{
    diag(p->inv_J, n, u);
    return -dot(x, u) / dot(n, u);
}

static void rigid_solve(const iso_field *f, const double y[], const double T[3], double dy[])
{
    double u[3];
    const double lambda = resisted(&f->p, y + 3, T, u);
    iso_system_ball.rhs(f, y, dy);
    for (int i = 0; i < 3; i++) dy[i] += f->p.inv_J[i] * T[i] + lambda * u[i];
}

/* That of the free ball; of the part l of lambda that T has, dl = -(dT,u)/g, and by n_j also -(T_j/J_j + 2 l u_j)/g */
static void rigid_slope(const iso_field *f, const double y[], const double T[3], int dim, double jac[])
{
    const iso_params *p = &f->p;
    double u[3], six[ISO_STATE * ISO_STATE];
    const double lambda = resisted(p, y + 3, T, u), g = dot(y + 3, u);
    iso_system_ball.jacobian(f, y, six);
    for (int j = 0; j < dim; j++) {
        const double dT[3] = {jac[j], jac[dim + j], jac[2 * dim + j]};
        double dlambda = -dot(dT, u) / g;
        if (j >= 3 && j < 6) dlambda -= (p->inv_J[j - 3] * T[j - 3] + 2 * lambda * u[j - 3]) / g;
        for (int i = 0; i < 3; i++)
            jac[dim * i + j] = p->inv_J[i] * dT[i] + dlambda * u[i] + (j < ISO_STATE ? six[ISO_STATE * i + j] : 0);
    }
    for (int j = 0; j < 3; j++) jac[dim * j + 3 + j] += lambda * p->inv_J[j];
    slope_of_normal(f, y, dim, jac);
}

static double rigid_twist(const iso_field *f, const double y[], const double T[3])
{
    double Jw[3], u[3], x[3];
    diag(f->p.J, y, Jw);
    cross(Jw, y, x);
    add_scaled(x, 1, T);
    return resisted(&f->p, y + 3, x, u);
}

/* --- loose -------------------------------------------------------------------------------------------------------- */

/* v = A^-1 x */
static void solve_A(const iso_params *p, const double n[3], const double x[3], double v[3])
{
    double u[3];
    diag(p->inv_J, n, u);
    const double along = p->D * dot(u, x) / (1 - p->D * dot(n, u));
    for (int i = 0; i < 3; i++) v[i] = p->inv_J[i] * x[i] + along * u[i];
}

static void loose_solve(const iso_field *f, const double y[], const double T[3], double dy[])
{
    double K[3], x[3];
    contact_momentum(&f->p, y, K);
    cross(K, y, x);
    turn_of_normal(f, y, dy + 3);
    add_scaled(x, 1, T);
    add_scaled(x, f->p.D * dot(y, y + 3), dy + 3);
    solve_A(&f->p, y + 3, x, dy);
}

/* A dw' = dx - dA w',  -dA w' = D [dn (n,w') + n (dn,w')] */
static void loose_slope(const iso_field *f, const double y[], const double T[3], int dim, double jac[])
{
    const iso_params *p = &f->p;
    const double *w = y, *n = y + 3, spin = dot(w, n);
    double K[3], dy[6], x[3], column[3];
    contact_momentum(p, y, K);
    loose_solve(f, y, T, dy);
    for (int j = 0; j < dim; j++) {
        for (int i = 0; i < 3; i++) x[i] = jac[dim * i + j];
        if (j < 6) {
            const double unit[3] = {j % 3 == 0, j % 3 == 1, j % 3 == 2};
            const double dspin = j < 3 ? n[j] : w[j - 3];
            double dK[3] = {0}, part[3];
            if (j < 3) dK[j] = p->J[j];
            add_scaled(dK, -p->D * dspin, n);
            if (j >= 3) add_scaled(dK, -p->D * spin, unit);
            cross(dK, w, part);
            add_scaled(x, 1, part);
            add_scaled(x, p->D * dspin, dy + 3);
            if (j < 3) {
                cross(K, unit, part);
                add_scaled(x, 1, part);
                cross(n, unit, part);
            } else {
                add_scaled(x, p->D * dot(n, dy), unit);
                add_scaled(x, p->D * dy[j - 3], n);
                cross(unit, w, part);
            }
            add_scaled(x, p->D * spin * p->k, part);
        }
        solve_A(p, n, x, column);
        for (int i = 0; i < 3; i++) jac[dim * i + j] = column[i];
    }
    slope_of_normal(f, y, dim, jac);
}

static double loose_twist(const iso_field *f, const double y[], const double T[3])
{
    (void)T;
    const int at = f->at[ISO_TWIST];
    return at > 0 ? y[at] : -f->effects.twist * dot(y, y + 3);
}

const iso_contact iso_contact_rigid = {rigid_solve, rigid_slope, rigid_twist},
                  iso_contact_loose = {loose_solve, loose_slope, loose_twist};

const iso_contact *iso_contact_of(const iso_field *f)
{
    return f->effects.on[ISO_TWIST] ? &iso_contact_loose : &iso_contact_rigid;
}
