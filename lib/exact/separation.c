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

/* p_z dz = z'^2/(4 A) dsigma = 2 (R + c) dsigma */
real iso_separation_action(const separation *s, const oscillation *o)
{
    const real *b = s->b, D = b[0] * b[1] * b[2], S = b[0] + b[1] + b[2];
    real mean = 0;
    for (int j = 0; j <= o->samples; j++) {
        const real z = o->at[j], R = s->k == -1 ? s->eps * z * (S - z) : -s->eps * D / z;
        mean += 2 * fabsl(R + s->c) * (j % o->samples == 0 ? 0.5L : 1) / o->samples;
    }
    return mean / o->omega;
}

/* --- from a state ----------------------------------------------------------------------------------------------- */

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

/* The two oscillations. With the roots a > b > c > d = top, above, below, bottom, and w what else is in
 * (dz/dsigma)^2 = 8 |(z-a)(z-b)(z-c)(z-d)| w(z) (Byrd, Friedman, 252 and 257):
 *
 *     sn^2(x) = (a-c)(u-d)/((c-d)(a-u)),   sn^2(y) = (b-d)(a-v)/((a-b)(v-d)),   1-m = (b-c)(a-d)/((a-c)(b-d)),
 *     dx/dsigma = sqrt(2 (a-c)(b-d) w(u)),  dy/dsigma = sqrt(2 (a-c)(b-d) w(v)). */
static bool make_oscillations(separation *s, real kappa)
{
    const real *b = s->b, half = (b[0] + b[1] + b[2]) / 2;
    const bool neumann = s->k == -1;
    const real be = neumann ? half + sqrtl(half * half + s->c / s->eps) : INFINITY;  /* the other root of R + c */
    const real gap = neumann ? kappa / (s->eps * (be - b[1])) : kappa * b[1] / s->c; /* b2 - al */
    const real al = b[1] - gap;
    s->librates_low = gap > 0;
    s->below_b3 = be < b[2];
    s->distance = kappa / (neumann ? s->eps * b[1] * (b[0] + b[2]) : s->eps * b[0] * b[2]);
    const real top = s->top = fminl(b[2], be), bottom = s->bottom = b[0];
    const real below = s->below = s->librates_low ? fmaxl(al, bottom) : b[1];
    const real above = s->above = s->librates_low ? b[1] : fminl(al, top);
    if (gap == 0) return false;
    const real long_way = (top - below) * (above - bottom);
    const oscillation both = {
        .C = (neumann ? s->eps : s->c) * long_way, .e = s->below_b3 ? b[2] : be, .over_z = !neumann};
    s->u = s->v = both;
    s->u.origin = bottom;
    s->u.span = (top - bottom) * (below - bottom) / (top - below);
    s->u.bend = (below - bottom) / (top - below);
    s->v.origin = top;
    s->v.span = -(top - above) * (top - bottom) / (above - bottom);
    s->v.bend = (top - above) / (above - bottom);
    const real m1 = fminl(fabsl(gap) * (top - bottom) / long_way, 1);
    return iso_oscillation_solve(&s->u, m1) && iso_oscillation_solve(&s->v, m1);
}

/* gamma_i = size_i f_i/E, E^2 = (1 + bend_u sn_u^2)(1 + bend_v sn_v^2) = (a-d)^2/((a-u)(v-d)), f_i of sn, cn, dn. */
static void find_sizes(separation *s)
{
    const real a = s->top, b = s->above, c = s->below, d = s->bottom, b3 = s->b[2];
    const bool low = s->librates_low;
    s->size[0] = low ? sqrtl((a - d) * (c - d) / ((a - c) * (b - d))) : (a - d) / sqrtl((a - c) * (b3 - d));
    s->size[1] = low ? 1 : sqrtl((a - c) / (b3 - c));
    s->size[2] = low ? sqrtl((a - d) / (b - d)) : sqrtl((a - d) * (a - b) / ((a - c) * (b - d)));
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

/* dn at an amplitude, and its logarithmic derivative */
static real dn_at(const oscillation *o, real amplitude, real z, real *d_log)
{
    const real sn = sinl(amplitude), cn = cosl(amplitude), m = 1 - o->f.m1, dn = sqrtl(o->f.m1 + m * cn * cn);
    *d_log = -m * sn * cn / dn * iso_oscillation_rate(o, z);
    return dn;
}

/* The amplitude of v from v and its rate alone, where gamma3 keeps its side. */
static real amplitude_of_v(const separation *s, const moment *m)
{
    const oscillation *v = &s->v;
    const real ratio = (s->above - s->bottom) * (s->top - m->v) / ((s->top - s->above) * (m->v - s->bottom));
    const real square = fminl(fmaxl(ratio, 0), 1), dn = sqrtl(v->f.m1 + (1 - v->f.m1) * (1 - square));
    const real bent = 1 + v->bend * square, product = m->dv * bent * bent / (2 * v->span * dn);
    return atan2l(2 * product / iso_oscillation_rate(v, m->v), 1 - 2 * square) / 2; /* sin 2 psi, cos 2 psi */
}

/* The amplitudes at sigma = 0. Where al < b2, gamma1 ~ sn_u swings and (gamma3, gamma2) ~ (sn_v, cn_v dn_u) turn;
 * else gamma3 ~ sn_v swings, or keeps its side, and (gamma1, gamma2) ~ (sn_u, cn_u dn_v) turn. */
static void find_amplitudes(separation *s, const moment *m, real *phi, real *psi)
{
    const real *g = m->gamma, *d = m->velocity,
               E = (s->top - s->bottom) / sqrtl((s->top - m->u) * (m->v - s->bottom));
    const real L = (m->dv / (m->v - s->bottom) - m->du / (s->top - m->u)) / 2; /* of 1/E */
    const int turns = s->librates_low ? 2 : 0;
    real d_dn, dn;
    if (s->librates_low) {
        *phi = swinging(&s->u, g[0], d[0], s->size[0] / E, L, m->u);
        dn = dn_at(&s->u, *phi, m->u, &d_dn);
    } else {
        *psi = s->below_b3 ? amplitude_of_v(s, m) : swinging(&s->v, g[2], d[2], s->size[2] / E, L, m->v);
        dn = dn_at(&s->v, *psi, m->v, &d_dn);
    }
    const real sine = E / s->size[turns], cosine = E / (s->size[1] * dn);
    const real amplitude = turning(g[turns] * sine, (d[turns] - g[turns] * L) * sine, g[1] * cosine,
                                   (d[1] - g[1] * (L + d_dn)) * cosine, &s->turn);
    *(s->librates_low ? psi : phi) = amplitude;
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
    find_sizes(s);
    find_coordinates(s, M, &m);
    s->side = m.gamma[2] < 0 ? -1 : 1;
    find_amplitudes(s, &m, &phi, &psi);
    s->u.start = iso_oscillation_theta(&s->u, iso_elliptic_inverse(&s->u.f, phi));
    s->v.start = iso_oscillation_theta(&s->v, iso_elliptic_inverse(&s->v.f, psi));
    return true;
}

/* --- to a state ------------------------------------------------------------------------------------------------- */

/* A coordinate with its elliptic functions and their rates. */
typedef struct swing {
    real z, dz, sn, cn, dn, d_sn, d_cn, d_dn;
} swing;

static swing swing_at(const oscillation *o, double theta)
{
    swing w;
    iso_elliptic_at(&o->f, iso_oscillation_xi(o, theta), &w.sn, &w.cn, &w.dn);
    const real bent = 1 + o->bend * w.sn * w.sn;
    w.z = o->origin + o->span * w.sn * w.sn / bent;
    const real fast = iso_oscillation_rate(o, w.z);
    w.d_sn = w.cn * w.dn * fast;
    w.d_cn = -w.sn * w.dn * fast;
    w.d_dn = -(1 - o->f.m1) * w.sn * w.cn * fast;
    w.dz = 2 * o->span * w.sn * w.d_sn / (bent * bent);
    return w;
}

static void components(const separation *s, const swing *u, const swing *v, real g[3], real d[3])
{
    const real over_E = sqrtl((s->top - u->z) * (v->z - s->bottom)) / (s->top - s->bottom), b3 = s->b[2];
    const real L = (v->dz / (v->z - s->bottom) - u->dz / (s->top - u->z)) / 2;
    const swing *turns = s->librates_low ? v : u, *other = s->librates_low ? u : v;
    const int sine = s->librates_low ? 2 : 0;
    const real f[3] = {s->turn * turns->sn, turns->cn * other->dn, other->sn};
    const real df[3] = {s->turn * turns->d_sn, turns->d_cn * other->dn + turns->cn * other->d_dn, other->d_sn};
    for (int i = 0; i < 3; i++) {
        const int to = i == 1 ? 1 : i == 0 ? sine : 2 - sine;
        g[to] = s->size[to] * f[i] * over_E;
        d[to] = s->size[to] * df[i] * over_E + g[to] * L;
    }
    if (!s->below_b3) return;
    g[2] = s->side * sqrtl((b3 - u->z) * (b3 - v->z) / ((b3 - s->b[0]) * (b3 - s->b[1])));
    d[2] = -g[2] * (u->dz / (b3 - u->z) + v->dz / (b3 - v->z)) / 2;
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
