/* effect_attitude.c - how the ball stands and where it is: asked for, it acts on nothing.
 *
 *     Q' = Q (0,w)/2,     |Q| = 1          R(Q): from body to space axes
 *     x' = R (w x n)                       on a plane: way of the centre, in units of b
 *
 * On a sphere no way has to be integrated: the contact is at a R n, the centre at (a+b) R n.
 */
#include "base/vec3_impl.h"
#include "model/attitude_impl.h"
#include "model/effects_impl.h"

/* R v = (q0^2 - |q|^2) v + 2 (q,v) q + 2 q0 q x v */
void iso_turn_to_space(const double Q[4], const double v[3], double in_space[3])
{
    const double *q = Q + 1;
    double q_v[3];
    cross(q, v, q_v);
    for (int i = 0; i < 3; i++)
        in_space[i] = (Q[0] * Q[0] - dot(q, q)) * v[i] + 2 * dot(q, v) * q[i] + 2 * Q[0] * q_v[i];
}

const double *iso_way(const iso_field *f, const double y[])
{
    return y + f->at[ISO_ATTITUDE] + 4;
}

static int states(const iso_field *f)
{
    return f->p.k == 1 ? 7 : 4;
}

static void begin(const iso_field *f, double y[])
{
    double *Q = y + f->at[ISO_ATTITUDE];
    copy(f->effects.quaternion, Q, 4);
    for (int i = 4; i < states(f); i++) Q[i] = 0;
}

static void rates(const iso_field *f, const double y[], double dy[])
{
    const double *w = y, *n = y + 3, *Q = y + f->at[ISO_ATTITUDE], *q = Q + 1;
    double *dQ = dy + f->at[ISO_ATTITUDE], q_w[3], w_n[3];
    cross(q, w, q_w);
    dQ[0] = -dot(q, w) / 2;
    for (int i = 0; i < 3; i++) dQ[1 + i] = (Q[0] * w[i] + q_w[i]) / 2;
    if (f->p.k != 1) return;
    cross(w, n, w_n);
    iso_turn_to_space(Q, w_n, dQ + 4);
}

/* d(R v)/dQ, v held, and R applied to dv/dw_j = e_j x n, dv/dn_j = w x e_j */
static void way_slope(const iso_field *f, const double y[], int dim, double jac[])
{
    const int at = f->at[ISO_ATTITUDE];
    const double *w = y, *n = y + 3, *Q = y + at, *q = Q + 1;
    double v[3], q_v[3];
    cross(w, n, v);
    cross(q, v, q_v);
    double *rows = jac + dim * (at + 4);
    for (int i = 0; i < 3; i++) rows[dim * i + at] = 2 * Q[0] * v[i] + 2 * q_v[i];
    for (int j = 0; j < 3; j++) {
        const double unit[3] = {j == 0, j == 1, j == 2};
        double unit_v[3], unit_n[3], w_unit[3], by_w[3], by_n[3];
        cross(unit, v, unit_v);
        cross(unit, n, unit_n);
        cross(w, unit, w_unit);
        iso_turn_to_space(Q, unit_n, by_w);
        iso_turn_to_space(Q, w_unit, by_n);
        for (int i = 0; i < 3; i++) {
            rows[dim * i + at + 1 + j] = 2 * (-q[j] * v[i] + v[j] * q[i] + dot(q, v) * unit[i] + Q[0] * unit_v[i]);
            rows[dim * i + j] = by_w[i];
            rows[dim * i + 3 + j] = by_n[i];
        }
    }
}

static void rates_slope(const iso_field *f, const double y[], const double dy[], int dim, double jac[])
{
    (void)dy;
    const int at = f->at[ISO_ATTITUDE];
    const double *w = y, *Q = y + at, *q = Q + 1;
    for (int j = 0; j < 3; j++) {
        const double unit[3] = {j == 0, j == 1, j == 2};
        double q_unit[3], unit_w[3];
        cross(q, unit, q_unit);
        cross(unit, w, unit_w);
        jac[dim * at + j] = -q[j] / 2;
        jac[dim * at + at + 1 + j] = -w[j] / 2;
        jac[dim * (at + 1 + j) + at] = w[j] / 2;
        for (int i = 0; i < 3; i++) {
            jac[dim * (at + 1 + i) + j] = (Q[0] * unit[i] + q_unit[i]) / 2;
            jac[dim * (at + 1 + i) + at + 1 + j] = unit_w[i] / 2;
        }
    }
    if (f->p.k == 1) way_slope(f, y, dim, jac);
}

static void size(const iso_field *f, const double y[], double size[])
{
    const int at = f->at[ISO_ATTITUDE];
    for (int i = 0; i < 4; i++) size[at + i] = 1;
    for (int i = 4; i < states(f); i++) size[at + i] = 1 + norm(iso_way(f, y));
}

static double quaternion_length(const double Q[4])
{
    return sqrt(Q[0] * Q[0] + dot(Q + 1, Q + 1));
}

static double restore(const iso_field *f, double y[])
{
    double *Q = y + f->at[ISO_ATTITUDE];
    const double length = quaternion_length(Q);
    for (int i = 0; i < 4; i++) Q[i] /= length;
    return fabs(length - 1);
}

static double unit_quaternion(const iso_field *f, const double y[], double *value_size)
{
    *value_size = 1;
    return quaternion_length(y + f->at[ISO_ATTITUDE]);
}

static const char *const state_names[] = {"q0", "q1", "q2", "q3", "x1", "x2", "x3"};

static const iso_effect_number numbers[] = {
    {"quaternion", offsetof(iso_effects, quaternion), 4, {0, 0, 0}},
    {0},
};

static const iso_integral integrals[] = {
    {.name = "|q|", .known = ISO_ONE, .doc = "unit quaternion: 1", .value = unit_quaternion},
    {0},
};

const iso_effect iso_effect_attitude = {
    .name = "attitude",
    .doc = "how the ball stands in space: quaternion, both contact curves, path of the centre",
    .numbers = numbers,
    .state = state_names,
    .states_doc = "how the ball stands, from body to space axes (q), and on a plane the way of the centre (x, in units of b)",
    .states = states,
    .begin = begin,
    .rates = rates,
    .rates_slope = rates_slope,
    .size = size,
    .restore = restore,
    .integrals = integrals,
};
