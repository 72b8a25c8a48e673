#include "exact/separation_impl.h"

#include <math.h>
#include <string.h>

/* The state in the sorted axes: velocities are d/dsigma. */
typedef struct moment {
    real gamma[3], velocity[3], u, v, du, dv;
} moment;

real iso_separation_rate(const separation *s, iso_clock clock, real u, real v)
{
    const real *b = s->b, det = s->det, q = s->k == -1 ? b[0] + b[1] + b[2] - u - v : u * v / (b[0] * b[1] * b[2]);
    if (clock == ISO_CLOCK_S) return v - u;
    if (clock == ISO_CLOCK_TAU) return det * (v - u) * (s->k == -1 ? q : 1 / q);
    return det * (v - u) / (s->k == -1 ? sqrtl(q) : q * sqrtl(q));
}

/* --- from a state
 * ----------------------------------------------------------------------------------------------------- */

static void sort_axes(separation *s, const double J[3])
{
    for (int i = 0; i < 3; i++) s->axis[i] = i;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 2; i++)
            if ((J[s->axis[i]] > J[s->axis[i + 1]]) == (s->k == -1) && J[s->axis[i]] != J[s->axis[i + 1]]) {
                const int other = s->axis[i];
                s->axis[i] = s->axis[i + 1];
                s->axis[i + 1] = other;
            }
    for (int i = 0; i < 3; i++) s->b[i] = s->k == -1 ? (real)J[s->axis[i]] : 1 / (real)J[s->axis[i]];
}

/* sum_i b_i^power x_i y_i */
static real form(const separation *s, int power, const real x[3], const real y[3])
{
    real sum = 0;
    for (int i = 0; i < 3; i++) sum += (power > 0 ? s->b[i] : power < 0 ? 1 / s->b[i] : 1) * x[i] * y[i];
    return sum;
}

/* gamma and M in long double, on |gamma| = 1, (M,gamma) = 0 and H = 0, sorted; M's components keep the caller's
 * sense */
static void take_state(const separation *s, const double point[ISO_STATE], real gamma[3], real M[3])
{
    for (int i = 0; i < 3; i++) M[i] = point[s->axis[i]], gamma[i] = point[3 + s->axis[i]];
    const real length = sqrtl(form(s, 0, gamma, gamma));
    for (int i = 0; i < 3; i++) gamma[i] /= length;
    const real along = form(s, 0, M, gamma);
    for (int i = 0; i < 3; i++) M[i] -= along * gamma[i];
    const real fall = s->k == -1 ? form(s, 1, gamma, gamma) : 1 / form(s, -1, gamma, gamma);
    const real scale = sqrtl(2 * s->eps * fall / form(s, 0, M, M));
    for (int i = 0; i < 3; i++) M[i] *= scale;
}

/* c and kappa = R(b2) + c, which decides where al lies, without its cancellation. */
static real find_constant(separation *s, const real gamma[3], const real M[3])
{
    const real *b = s->b, D = b[0] * b[1] * b[2], turning = form(s, 1, M, M) / 2;
    if (s->k == 1) {
        const real q = form(s, -1, gamma, gamma);
        s->c = s->eps * (b[0] + b[1] + b[2] - form(s, 1, gamma, gamma)) / q - turning;
        return s->c - s->eps * D / b[1];
    }
    s->c = -s->eps * D * form(s, -1, gamma, gamma) - turning;
    const real terms[3] = {b[0] * b[1], b[1] * (b[0] + b[2]) - b[0] * b[2], b[1] * b[2]};
    real kappa = -turning;
    for (int i = 0; i < 3; i++) kappa += s->eps * terms[i] * gamma[i] * gamma[i];
    return kappa;
}

/* The two oscillations: which roots bound them, which comes close. */
static bool make_oscillations(separation *s, real kappa)
{
    const real *b = s->b, b1 = b[0], b2 = b[1], b3 = b[2], half = (b1 + b2 + b3) / 2;
    const bool neumann = s->k == -1;
    const real be = neumann ? half + sqrtl(half * half + s->c / s->eps) : INFINITY; /* the other root of R + c */
    const real gap = neumann ? kappa / (s->eps * (be - b2)) : kappa * b2 / s->c;    /* b2 - al */
    const real al = b2 - gap, W = neumann ? s->eps : s->c;
    oscillation *u = &s->u, *v = &s->v;
    s->librates_low = gap > 0;
    s->below_b3 = be < b3;
    s->distance = kappa / (neumann ? s->eps * b2 * (b1 + b3) : s->eps * b1 * b3);
    u->over_z = v->over_z = !neumann;
    u->factors = v->factors = neumann ? 2 : 1;
    u->e[0] = b3, v->e[0] = b1;
    u->e[1] = be, v->e[1] = s->below_b3 ? b3 : be;
    u->origin = b1;
    if (s->librates_low) { /* b1 <= u <= al < b2 <= v <= b3 */
        u->span = fmaxl(al - b1, 0);
        u->C = W * (b2 - b1);
        v->origin = b3;
        v->span = b2 - b3;
        v->C = W * (b3 - al);
        return iso_oscillation_solve(u, fminl(gap / (b2 - b1), 1)) && iso_oscillation_solve(v, gap / (b3 - al));
    }
    v->origin = fminl(b3, be); /* b1 <= u <= b2 < al <= v */
    u->span = b2 - b1;
    u->C = W * (al - b1);
    v->span = fminl(al - v->origin, 0);
    v->C = W * (v->origin - b2);
    return gap < 0 && iso_oscillation_solve(u, -gap / (al - b1)) &&
           iso_oscillation_solve(v, fminl(-gap / (v->origin - b2), 1));
}

/* u, v as roots of z^2 - (b1+b2+b3 - (gamma,b gamma)) z + D (gamma,b^-1 gamma), and their rates */
static void find_coordinates(const separation *s, const real M[3], moment *m)
{
    const real *b = s->b, D = b[0] * b[1] * b[2];
    real g[3], p[3];
    const real sum = b[0] + b[1] + b[2] - form(s, 1, m->gamma, m->gamma), over = D * form(s, -1, m->gamma, m->gamma);
    m->v = (sum + sqrtl(fmaxl(sum * sum - 4 * over, 0))) / 2;
    m->u = over / m->v;
    for (int i = 0; i < 3; i++) g[s->axis[i]] = m->gamma[i], p[s->axis[i]] = M[i];
    const real turned[3] = {g[1] * p[2] - g[2] * p[1], g[2] * p[0] - g[0] * p[2], g[0] * p[1] - g[1] * p[0]};
    for (int i = 0; i < 3; i++) m->velocity[i] = (m->v - m->u) * turned[s->axis[i]];
    const real d_sum = -2 * form(s, 1, m->gamma, m->velocity), d_over = 2 * D * form(s, -1, m->gamma, m->velocity);
    m->du = (d_over - m->u * d_sum) / (m->v - m->u);
    m->dv = (m->v * d_sum - d_over) / (m->v - m->u);
}

/* The amplitude whose sine is x/r, where x swings: its cosine from x' = cos am dn (dx/dsigma) r + x r'/r. */
static real swinging(const oscillation *o, real x, real velocity, real r, real d_log_r, real z)
{
    if (!(r > 0)) return 0;
    const real sine = fmaxl(fminl(x / r, 1), -1), m = 1 - o->f.m1;
    const real fast = iso_oscillation_rate(o, z) * sqrtl(o->f.m1 + m * (1 - sine * sine));
    return atan2l(sine, (velocity - x * d_log_r) / (r * fast));
}

/* The amplitude of two components that turn, x ~ sense sine and y ~ cosine, and the sense in which they do. */
static real turning(real x, real dx, real y, real dy, int *sense)
{
    *sense = y * dx - x * dy < 0 ? -1 : 1;
    return atan2l(*sense * x, y);
}

/* The amplitudes at sigma = 0 where al < b2: gamma1 ~ sin phi swings, (gamma3, gamma2) ~ (sin, cos) psi turn. */
static void phases_low(separation *s, const moment *m, real *phi, real *psi)
{
    const real *g = m->gamma, *d = m->velocity, b1 = s->b[0], b3 = s->b[2];
    const real m_u = 1 - s->u.f.m1, r1 = sqrtl(m_u * fmaxl(m->v - b1, 0) / (b3 - b1));
    *phi = swinging(&s->u, g[0], d[0], r1, m->dv / (2 * (m->v - b1)), m->u);
    const real dn = sqrtl(s->u.f.m1 + m_u * cosl(*phi) * cosl(*phi)), r3 = sqrtl((b3 - m->u) / (b3 - b1));
    const real d_dn = -m_u * sinl(*phi) * cosl(*phi) * iso_oscillation_rate(&s->u, m->u);
    *psi = turning(g[2] / r3, (d[2] + g[2] * m->du / (2 * (b3 - m->u))) / r3, g[1] / dn,
                   (d[1] - g[1] / dn * d_dn) / dn, &s->turn);
}

/* ... and where al > b2: (gamma1, gamma2) ~ (sin, cos) phi turn, gamma3 ~ sin psi swings, or keeps its side. */
static void phases_high(separation *s, const moment *m, real *phi, real *psi)
{
    const real *g = m->gamma, *d = m->velocity, b1 = s->b[0], b2 = s->b[1], b3 = s->b[2];
    const real r1 = sqrtl((m->v - b1) / (b3 - b1)), r2 = sqrtl((m->v - b2) / (b3 - b2));
    *phi = turning(g[0] / r1, (d[0] - g[0] * m->dv / (2 * (m->v - b1))) / r1, g[1] / r2,
                   (d[1] - g[1] * m->dv / (2 * (m->v - b2))) / r2, &s->turn);
    const oscillation *v = &s->v;
    if (!s->below_b3) {
        const real r3 = sqrtl(-v->span / (b3 - b2) * (b3 - m->u) / (b3 - b1));
        *psi = swinging(v, g[2], d[2], r3, -m->du / (2 * (b3 - m->u)), m->v);
        return;
    }
    const real square = fminl(fmaxl((m->v - v->origin) / v->span, 0), 1); /* sin^2 psi */
    const real fast = iso_oscillation_rate(v, m->v) * sqrtl(v->f.m1 + (1 - v->f.m1) * (1 - square));
    *psi = atan2l(m->dv / (v->span * fast), 1 - 2 * square) / 2; /* sin 2 psi, cos 2 psi */
}

bool iso_separation_make(separation *s, const iso_field *field, const double point[ISO_STATE])
{
    moment m;
    real M[3], phi, psi;
    memset(s, 0, sizeof *s);
    s->k = (int)field->p.k;
    s->eps = field->eps;
    s->det = (real)field->p.J[0] * field->p.J[1] * field->p.J[2];
    sort_axes(s, field->p.J);
    take_state(s, point, m.gamma, M);
    if (!make_oscillations(s, find_constant(s, m.gamma, M))) return false;
    find_coordinates(s, M, &m);
    s->side = m.gamma[2] < 0 ? -1 : 1;
    (s->librates_low ? phases_low : phases_high)(s, &m, &phi, &psi);
    s->u.start = iso_oscillation_theta(&s->u, iso_elliptic_inverse(&s->u.f, phi));
    s->v.start = iso_oscillation_theta(&s->v, iso_elliptic_inverse(&s->v.f, psi));
    return true;
}

/* --- to a state
 * -------------------------------------------------------------------------------------------------------- */

/* A coordinate with its elliptic functions and rate. */
typedef struct swing {
    real z, dz, sn, cn, dn, fast; /* fast: dx/dsigma */
} swing;

static swing swing_at(const oscillation *o, double theta)
{
    swing w;
    iso_elliptic_at(&o->f, iso_oscillation_xi(o, theta), &w.sn, &w.cn, &w.dn);
    w.z = o->origin + o->span * w.sn * w.sn;
    w.fast = iso_oscillation_rate(o, w.z);
    w.dz = 2 * o->span * w.sn * w.cn * w.dn * w.fast;
    return w;
}

/* x = a r and its rate */
static void component(real a, real da, real r, real d_log_r, real *x, real *dx)
{
    *x = a * r;
    *dx = da * r + *x * d_log_r;
}

static void components(const separation *s, const swing *u, const swing *v, real g[3], real d[3])
{
    const real b1 = s->b[0], b2 = s->b[1], b3 = s->b[2], m_u = 1 - s->u.f.m1;
    const real r1 = sqrtl((v->z - b1) / (b3 - b1)), d1 = v->dz / (2 * (v->z - b1));
    const real r3 = sqrtl((b3 - u->z) / (b3 - b1)), d3 = -u->dz / (2 * (b3 - u->z));
    const real d_sn_u = u->cn * u->dn * u->fast, d_sn_v = v->cn * v->dn * v->fast;
    if (s->librates_low) {
        component(u->sn, d_sn_u, sqrtl(m_u) * r1, d1, &g[0], &d[0]);
        component(s->turn * v->sn, s->turn * d_sn_v, r3, d3, &g[2], &d[2]);
        g[1] = v->cn * u->dn;
        d[1] = -v->sn * v->dn * v->fast * u->dn - v->cn * m_u * u->sn * u->cn * u->fast;
        return;
    }
    component(s->turn * u->sn, s->turn * d_sn_u, r1, d1, &g[0], &d[0]);
    component(u->cn, -u->sn * u->dn * u->fast, sqrtl((v->z - b2) / (b3 - b2)), v->dz / (2 * (v->z - b2)), &g[1],
              &d[1]);
    if (!s->below_b3)
        component(v->sn, d_sn_v, sqrtl(-s->v.span / (b3 - b2)) * r3, d3, &g[2], &d[2]);
    else
        component(s->side, 0, sqrtl((b3 - v->z) / (b3 - b2)) * r3, d3 - v->dz / (2 * (b3 - v->z)), &g[2], &d[2]);
}

void iso_separation_state(const separation *s, const double theta[2], double point[ISO_STATE])
{
    const swing u = swing_at(&s->u, theta[0]), v = swing_at(&s->v, theta[1]);
    real g[3], d[3], x[3], y[3];
    components(s, &u, &v, g, d);
    for (int i = 0; i < 3; i++) x[s->axis[i]] = g[i], y[s->axis[i]] = d[i] / (v.z - u.z);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        point[i] = (double)(y[j] * x[l] - y[l] * x[j]);
        point[3 + i] = (double)x[i];
    }
}
