/* effect_field.c - a potential that is fixed in the body, U(n) = (n,Cn)/2 + (l,n): magnets in the ball, say.
 *
 *     MQ = k n x dU/dn = k n x (C n + l)
 *
 * Its image on the point (section 5 of the paper) is V = U/G with 1/G = (det J/k^2) q^(-1/k). With n = J^(1/2) gamma/sqrt(q),
 * B = J^(1/2) C J^(1/2), m = J^(1/2) l:
 *
 *     V = (det J/k^2) [ q^a (gamma,B gamma)/2 + q^b (m,gamma) ],     a = -1/k - 1,   b = -1/k - 1/2
 */
#include "base/vec3_impl.h"
#include "model/effects_impl.h"

/* dU/dn = C n + l */
static void gradient(const iso_effects *e, const double n[3], double dU[3])
{
    for (int i = 0; i < 3; i++) dU[i] = dot(e->quadratic + 3 * i, n) + e->linear[i];
}

static void torque(const iso_field *f, const double y[], double T[3])
{
    double dU[3], n_dU[3];
    gradient(&f->effects, y + 3, dU);
    cross(y + 3, dU, n_dU);
    add_scaled(T, f->p.k, n_dU);
}

static void torque_slope(const iso_field *f, const double y[], int dim, double slope[])
{
    double dU[3];
    gradient(&f->effects, y + 3, dU);
    for (int j = 0; j < 3; j++) {
        const double unit[3] = {j == 0, j == 1, j == 2};
        double unit_dU[3], n_C[3];
        cross(unit, dU, unit_dU);
        cross(y + 3, f->effects.quadratic + 3 * j, n_C); /* C is symmetric: row j is column j */
        add_column(slope, dim, 3 + j, f->p.k, unit_dU);
        add_column(slope, dim, 3 + j, f->p.k, n_C);
    }
}

static double potential(const iso_field *f, const double y[])
{
    double Cn[3];
    const double *n = y + 3;
    for (int i = 0; i < 3; i++) Cn[i] = dot(f->effects.quadratic + 3 * i, n);
    return dot(n, Cn) / 2 + dot(f->effects.linear, n);
}

static double strength(const iso_field *f, const double y[])
{
    double most = largest(f->effects.linear);
    (void)y;
    for (int i = 0; i < 9; i++) most = fmax(most, fabs(f->effects.quadratic[i]));
    return most;
}

/* --- on the point ------------------------------------------------------------------------------------------------- */

/* V and its parts at gamma: P = (gamma,B gamma)/2, L = (m,gamma), times their powers of q */
typedef struct image_parts {
    double Bgamma[3], m[3], dq[3], P, L, q, a, b, factor_a, factor_b;
} image_parts;

static image_parts parts_at(const iso_field *f, const double y[])
{
    const iso_params *p = &f->p;
    const double *gamma = y + 3;
    image_parts v = {.q = dot_diag(gamma, p->J, gamma), .a = -1 / p->k - 1, .b = -1 / p->k - 0.5};
    double x[3];
    for (int i = 0; i < 3; i++) {
        x[i] = p->root_J[i] * gamma[i];
        v.m[i] = p->root_J[i] * f->effects.linear[i];
        v.dq[i] = 2 * p->J[i] * gamma[i];
    }
    for (int i = 0; i < 3; i++) v.Bgamma[i] = p->root_J[i] * dot(f->effects.quadratic + 3 * i, x);
    v.P = dot(gamma, v.Bgamma) / 2;
    v.L = dot(v.m, gamma);
    const double scale = p->det_J / (p->k * p->k) * pow(v.q, -1 / p->k);
    v.factor_a = scale / v.q;
    v.factor_b = scale / sqrt(v.q);
    return v;
}

/* dV/dgamma = f_a (B gamma + a P dq/q) + f_b (m + b L dq/q) */
static void image_gradient(const image_parts *v, double dV[3])
{
    for (int i = 0; i < 3; i++)
        dV[i] = v->factor_a * (v->Bgamma[i] + v->a * v->P / v->q * v->dq[i]) +
                v->factor_b * (v->m[i] + v->b * v->L / v->q * v->dq[i]);
}

static void image(const iso_field *f, const double y[], double T[3])
{
    const image_parts v = parts_at(f, y);
    double dV[3], gamma_dV[3];
    image_gradient(&v, dV);
    cross(y + 3, dV, gamma_dV);
    add_scaled(T, 1, gamma_dV);
}

/* The second derivatives of q^a P and q^b L, row j, with q_ij = 2 J_i delta_ij:
 *     q^a [B_ij + (a/q)(Bg_i q_j + q_i Bg_j + P q_ij) + (a (a-1)/q^2) P q_i q_j], likewise with B = 0 for L. */
static void image_hessian(const iso_field *f, const image_parts *v, int j, double row[3])
{
    const iso_params *p = &f->p;
    const double ca = v->a / v->q, cb = v->b / v->q;
    for (int i = 0; i < 3; i++) {
        const double B = p->root_J[i] * f->effects.quadratic[3 * i + j] * p->root_J[j];
        const double qq = v->dq[i] * v->dq[j], q_ij = i == j ? 2 * p->J[i] : 0;
        row[i] = v->factor_a * (B + ca * (v->Bgamma[i] * v->dq[j] + v->dq[i] * v->Bgamma[j] + v->P * q_ij) +
                                ca * (v->a - 1) / v->q * v->P * qq) +
                 v->factor_b * (cb * (v->m[i] * v->dq[j] + v->dq[i] * v->m[j] + v->L * q_ij) +
                                cb * (v->b - 1) / v->q * v->L * qq);
    }
}

static void image_slope(const iso_field *f, const double y[], int dim, double slope[])
{
    const image_parts v = parts_at(f, y);
    double dV[3];
    image_gradient(&v, dV);
    for (int j = 0; j < 3; j++) {
        const double unit[3] = {j == 0, j == 1, j == 2};
        double row[3], unit_dV[3], gamma_row[3];
        image_hessian(f, &v, j, row);
        cross(unit, dV, unit_dV);
        cross(y + 3, row, gamma_row);
        add_column(slope, dim, 3 + j, 1, unit_dV);
        add_column(slope, dim, 3 + j, 1, gamma_row);
    }
}

static double image_potential(const iso_field *f, const double y[])
{
    const image_parts v = parts_at(f, y);
    return v.factor_a * v.P + v.factor_b * v.L;
}

static const iso_effect_number numbers[] = {
    {"quadratic", offsetof(iso_effects, quadratic), 9, {1, 0, 2}},
    {"linear", offsetof(iso_effects, linear), 3, {1, 0, 2}},
    {0},
};

const iso_effect iso_effect_field = {
    .name = "field",
    .doc = "body-fixed potential U = (n,Cn)/2 + (l,n): torque k n x dU/dn",
    .numbers = numbers,
    .torque = torque,
    .torque_slope = torque_slope,
    .potential = potential,
    .strength = strength,
    .image = image,
    .image_slope = image_slope,
    .image_potential = image_potential,
};
