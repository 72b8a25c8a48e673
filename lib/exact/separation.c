/* separation.c - from a state to the two separate oscillations of u and v, and back to a state.
 *
 * The formulas, in the order in which the code needs them (b, D, A, R, c, al, be: see separation_impl.h):
 *
 *  (1) u and v are the two roots z of sum_i gamma_i^2/(b_i - z) = 0. Multiplied by A(z) this is a quadratic
 *      polynomial in z; its value at z = b_i gives  gamma_i^2 = (b_i - u)(b_i - v)/((b_i - b_j)(b_i - b_l)).
 *  (2) The same roots are the eigenvalues of the form diag(b) on the plane across gamma. For two orthogonal unit
 *      vectors m, l across gamma:
 *          u + v = (l,bl) + (m,bm),    v - u = |X + iY|,    X = (l,bl) - (m,bm),    Y = 2 (m,bl).
 *  (3) R(b_j) + c follows from M and gamma by the formula in separation_impl.h, in which no large terms cancel next
 *      to a principal plane.
 *  (4) k = 1:   R(z) + c = c (z - al)/z, so b_j - al = b_j (R(b_j) + c)/c.
 *  (5) k = -1:  R(z) + c = eps (z - al)(be - z). With P = M^2/(2 eps) and m along M, al and be are the eigenvalues of
 *      diag(b) + P l l^T across gamma. So al + be = u + v + P and be - al = |X + P + iY|. The two distances b_j - al
 *      and be - b_j then have the known sum be - al, the known product (R(b_j) + c)/eps, and the known difference
 *      2 b_j - (al + be).
 *  (6) Along the line on which u grows, gamma moves with a speed u', and |gamma'|^2 = M^2 = u'^2 + v'^2 in arc
 *      length. Separation says  u'^2 = 2 |R(u) + c|/(v - u), and the same for v. Read backwards this gives the
 *      distances from u and v to al and be with all their digits where u or v turns.
 *  (7) Each of u and v becomes an angle by elliptic functions, see oscillation_impl.h.
 */
#include "exact/separation_impl.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vec3_impl.h"

enum { U, V };           /* the coordinates         */
enum { AL = 3, BE = 4 }; /* roots beyond b1, b2, b3 */

/* A state in the sorted axes, and what follows from it. */
typedef struct moment {
    real gamma[3], M[3];
    real gap;        /* v - u                                   */
    real z[2];       /* u and v                                 */
    real from[2][3]; /* |b_i - u| and |b_i - v|                 */
    real rate[2];    /* u' and v' of (6), with their signs      */
} moment;

/* x and y from their sum, their product and, for the signs and to a few digits, their difference. The larger one is
 * found first and the smaller one by division, so both keep all digits. */
static void split(real sum, real product, real difference, real *x, real *y)
{
    const real larger = (sum + fabsl(difference)) / 2, smaller = larger > 0 ? product / larger : 0;
    *x = difference > 0 ? larger : smaller;
    *y = difference > 0 ? smaller : larger;
}

real iso_separation_clock_rate(const separation *s, iso_clock clock, real q)
{
    if (clock == ISO_CLOCK_S) return 1;
    if (clock == ISO_CLOCK_TAU) return s->det * (s->k == -1 ? q : 1 / q);
    return s->det / (s->k == -1 ? sqrtl(q) : q * sqrtl(q));
}

/* --- from a state: constants ------------------------------------------------------------------------------------ */

/* Sets s->axis, b, off, handed and norm. */
static void sort_axes(separation *s, const double J[3])
{
    sort_by((const double[]){-s->k * J[0], -s->k * J[1], -s->k * J[2]}, s->axis);
    const real middle = J[s->axis[1]];
    for (int i = 0; i < 3; i++) {
        const real Ji = J[s->axis[i]];
        s->b[i] = s->k == -1 ? Ji : 1 / Ji;
        s->off[i] = s->k == -1 ? Ji - middle : (middle - Ji) / (middle * Ji);
    }
    const real *const b = s->off;
    s->handed = (s->axis[1] - s->axis[0] + 3) % 3 == 1 ? 1 : -1;
    for (int i = 0; i < 3; i++) s->norm[i] = (double)sqrtl(fabsl((b[i] - b[(i + 1) % 3]) * (b[i] - b[(i + 2) % 3])));
}

/* sum_i b_i^power x_i y_i for power = 1, 0, -1; for PAST_B2: sum_i (b_i - b2) x_i y_i */
enum { PAST_B2 = 2 };

static real form(const separation *s, int power, const real x[3], const real y[3])
{
    real sum = 0;
    for (int i = 0; i < 3; i++) {
        const real b = s->b[i];
        sum += (power == PAST_B2 ? s->off[i] : power > 0 ? b : power < 0 ? 1 / b : 1) * x[i] * y[i];
    }
    return sum;
}

/* gamma and M in long double and in the order of b. They are put on |gamma| = 1 and (M,gamma) = 0 and, if the level
 * is H = 0, also on that level. The signs of M's components are those of the caller's axes. */
static void read_state(const separation *s, const double point[ISO_STATE], moment *m)
{
    real *gamma = m->gamma, *M = m->M;
    for (int i = 0; i < 3; i++) M[i] = point[s->axis[i]], gamma[i] = point[3 + s->axis[i]];
    const real length = sqrtl(form(s, 0, gamma, gamma));
    for (int i = 0; i < 3; i++) gamma[i] /= length;
    const real along = form(s, 0, M, gamma);
    for (int i = 0; i < 3; i++) M[i] -= along * gamma[i];
    if (s->energy != 0) return; /* then M decides what the level is */
    const real fall = s->k == -1 ? form(s, 1, gamma, gamma) : 1 / form(s, -1, gamma, gamma);
    const real scale = sqrtl(2 * s->eps * fall / form(s, 0, M, M));
    for (int i = 0; i < 3; i++) M[i] *= scale;
}

/* (2): returns u + v - 2 b2 and sets v - u; m is along M, or where M = 0 any unit vector across gamma, l = m x gamma. */
static real find_gap(const separation *s, moment *at, real *X, real *Y)
{
    const real *g = at->gamma, *M = at->M, M2 = M[0] * M[0] + M[1] * M[1] + M[2] * M[2];
    const int flat = fabsl(g[0]) < fabsl(g[1]) ? 0 : 1; /* an axis not along gamma */
    real m[3], l[3], length = 0;
    for (int i = 0; i < 3; i++) {
        m[i] = M2 > 0 ? M[i] : (i == flat) - g[flat] * g[i];
        length += m[i] * m[i];
    }
    for (int i = 0; i < 3; i++) m[i] /= sqrtl(length);
    for (int i = 0; i < 3; i++) l[i] = m[(i + 1) % 3] * g[(i + 2) % 3] - m[(i + 2) % 3] * g[(i + 1) % 3];
    *X = form(s, PAST_B2, l, l) - form(s, PAST_B2, m, m);
    *Y = 2 * form(s, PAST_B2, m, l);
    at->gap = hypotl(*X, *Y);
    return form(s, PAST_B2, l, l) + form(s, PAST_B2, m, m);
}

/* (3): R(b_j) + c, and the size of its terms */
static real excess(const separation *s, const moment *m, int j, real *size)
{
    const real *b = s->b, E = s->k == -1 ? s->eps : s->eps / (form(s, -1, m->gamma, m->gamma) * b[j]);
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    const real past_k = s->off[j] - s->off[k], past_l = s->off[j] - s->off[l];
    const real g = E * past_k * past_l * m->gamma[j] * m->gamma[j];
    const real x = past_k * m->M[k] * m->M[k] / 2, y = past_l * m->M[l] * m->M[l] / 2;
    *size = fabsl(g) + fabsl(x) + fabsl(y);
    return x + y - g;
}

/* (4) and (5): v - u, c, and the distances of al and be from b1, b2, b3. With X + iY = (v - u) exp(i phi) the width
 * be - al of (5) is |v - u + P exp(-i phi)|. A distance that is zero to rounding says that the orbit is on a
 * separatrix. */
static void find_roots(separation *s, moment *m)
{
    s->unstable = -1;
    const real *b = s->b;
    real size, X, Y;
    const real sum = find_gap(s, m, &X, &Y), P = form(s, 0, m->M, m->M) / (2 * s->eps), gap = m->gap;
    s->width = s->k == 1 ? INFINITY : gap > 0 ? hypotl(gap + P * X / gap, P * Y / gap) : P;
    s->c = form(s, 1, m->M, m->M) / -2;
    if (s->k == 1)
        s->c += s->eps * (2 * b[1] + sum) / form(s, -1, m->gamma, m->gamma);
    else
        s->c -= s->eps * b[0] * b[1] * b[2] * form(s, -1, m->gamma, m->gamma);
    for (int j = 0; j < 3; j++) {
        const real kappa = excess(s, m, j, &size);
        const bool zero = fabsl(kappa) <= 8 * LDBL_EPSILON * size;
        if (j == 1) s->distance = kappa / (s->eps * (s->k == -1 ? b[1] * (b[0] + b[2]) : b[0] * b[2]));
        if (j == 1 && zero) s->unstable = s->axis[1];
        if (s->k == 1) {
            s->to_al[j] = kappa * b[j] / s->c;
            s->to_be[j] = INFINITY;
            continue;
        }
        const real difference = 2 * s->off[j] - sum - P;
        split(s->width, kappa / s->eps, difference, &s->to_al[j], &s->to_be[j]);
        if (j == 2 && zero && difference > 0) s->unstable = s->axis[2];
    }
}

/* --- next to an umbilic ----------------------------------------------------------------------------------------- */

/* gamma' = gamma x M and M' = gamma x dV/dgamma in the sorted axes */
static void rates(const separation *s, const real y[6], real dy[6])
{
    const real *g = y + 3, *M = y, q = form(s, -s->k, g, g);
    const real pull = s->k == -1 ? -2 * s->eps : 2 * s->eps / (q * q);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        const real steep = (s->off[l] - s->off[j]) * (s->k == -1 ? 1 : -1 / (s->b[j] * s->b[l])); /* J_l - J_j */
        dy[3 + i] = s->handed * (g[j] * M[l] - g[l] * M[j]);
        dy[i] = s->handed * pull * g[j] * g[l] * steep;
    }
}

/* Where u and v are nearly equal (gamma is next to an umbilic) the directions of u and v, and with them u', v' and
 * al, have lost their digits. A little further on they have them. So the start is carried on for a short time, once
 * for an orbit, by the classical Runge-Kutta method of order 4 in STEPS steps. The error of the method is h^5 for a
 * step and about (0.2/STEPS)^4 < 1e-17 in all.
 *
 * Why not a method of the library or of GSL: all of them take and give doubles, `taylor_extended` as well. The state
 * has to stay in long double here. Measured, J = (1, 2, 3), gamma2 = 1e-6 from an umbilic, within 15 radians: error
 * of the states against `taylor_extended` 1.2e-15 (k = -1) and 1.1e-15 (k = 1) as it is; 9.4e-15 and 5.6e-15 if the
 * state is rounded to double after this function, which is the best that such a method can do. These steps take less
 * than half of the set-up (4.8 ms) of these few orbits. */
static void carry_on(separation *s, moment *m)
{
    enum { STEPS = 4000 };
    static const real part[4] = {0, 0.5L, 0.5L, 1}, weight[4] = {1 / 6.0L, 1 / 3.0L, 1 / 3.0L, 1 / 6.0L};
    real y[6], k[6] = {0};
    real force[6], speed = sqrtl(form(s, 0, m->M, m->M));
    for (int i = 0; i < 3; i++) y[i] = m->M[i], y[3 + i] = m->gamma[i];
    rates(s, y, force);
    speed += sqrtl(sqrtl(form(s, 0, force, force))); /* if M = 0, the force alone moves gamma */
    const real h = 0.2L / speed / STEPS;
    for (int n = 0; n < STEPS; n++) {
        real sum[6] = {0};
        for (int stage = 0; stage < 4; stage++) {
            real z[6];
            for (int i = 0; i < 6; i++) z[i] = y[i] + part[stage] * h * k[i];
            rates(s, z, k);
            const real q = form(s, -s->k, z + 3, z + 3);
            for (int i = 0; i < 6; i++) sum[i] += weight[stage] * k[i];
            for (int c = 0; c < ISO_CLOCKS; c++)
                s->before[c] += weight[stage] * h * iso_separation_clock_rate(s, (iso_clock)c, q);
        }
        for (int i = 0; i < 6; i++) y[i] += h * sum[i];
    }
    for (int i = 0; i < 3; i++) m->M[i] = y[i], m->gamma[i] = y[3 + i];
}

/* Where u and v are nearly equal, the state is first carried on for a short time, which s->before then holds. */
static void find_constants(separation *s, moment *m)
{
    find_roots(s, m);
    if (!(m->gap < 1e-3L * (s->off[2] - s->off[0]))) return;
    const int unstable = s->unstable;
    carry_on(s, m);
    find_roots(s, m);
    s->unstable = unstable;
}

/* --- coordinates ------------------------------------------------------------------------------------------------ */

/* u and v, their distances from b1, b2, b3 by (1), and u', v'. False: u = v, and there are no such coordinates. The coordinate line of z has the direction
 * e_z,i = +-gamma_i/(b_i - z), made a unit vector by (1): e_u,i = +-sqrt(|b_i - v| prod_{j != i} |b_j - u|/((v - u)
 * |b_i - b_j| |b_i - b_l|)), likewise e_v. Then z' = (gamma', e_z) with gamma' = gamma x M. */
static bool find_coordinates(const separation *s, moment *m)
{
    real X, Y;
    find_gap(s, m, &X, &Y);
    const real *b = s->off, *g = m->gamma, *M = m->M, gap = m->gap;
    if (!(gap > 0)) return false;
    real n[3], *to_u = m->from[U], *to_v = m->from[V];
    for (int i = 0; i < 3; i++) n[i] = fabsl((b[i] - b[(i + 1) % 3]) * (b[i] - b[(i + 2) % 3]));
    const real sum = b[0] + b[2] - form(s, PAST_B2, g, g);
    m->z[U] = (sum - gap) / 2, m->z[V] = (sum + gap) / 2;
    to_v[0] = m->z[V] - b[0], to_u[0] = g[0] * g[0] * n[0] / to_v[0];
    to_u[2] = b[2] - m->z[U], to_v[2] = g[2] * g[2] * n[2] / to_u[2];
    split(gap, g[1] * g[1] * n[1], -sum, &to_u[1], &to_v[1]);
    m->rate[U] = m->rate[V] = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3, side = g[i] < 0 ? -1 : 1;
        const real velocity = s->handed * (g[j] * M[l] - g[l] * M[j]), scale = side / sqrtl(gap * n[i]);
        m->rate[U] += velocity * scale * (i == 0 ? 1 : -1) * sqrtl(to_v[i] * to_u[j] * to_u[l]);
        m->rate[V] += velocity * scale * (i == 2 ? -1 : 1) * sqrtl(to_u[i] * to_v[j] * to_v[l]);
    }
    return true;
}

/* --- from a state: the oscillations ----------------------------------------------------------------------------- */

/* Root j minus root i */
static real between(const separation *s, int i, int j)
{
    if (i < 3 && j < 3) return s->off[j] - s->off[i];
    if (i < 3) return j == AL ? -s->to_al[i] : s->to_be[i];
    return j < 3 ? -between(s, j, i) : j == i ? 0 : j == BE ? s->width : -s->width;
}

/* Which root belongs to sn, cn, dn and the base of an oscillation. A root that has none of these roles lies beyond
 * the root of cn or beyond that of dn; of it the distance from the root of cn is kept. */
static void set_roles(separation *s, int which, int sn, int cn, int dn, int base)
{
    const oscillation *o = &s->coordinate[which];
    const int root[4] = {sn, cn, dn, base};
    const real size[4] = {o->span, o->to_cn, o->to_dn, o->to_base};
    for (int i = 0; i < SEPARATION_ROOTS; i++) {
        s->role[which][i] = s->k == 1 && i == BE ? ROOT_NONE : ROOT_REST;
        s->size[which][i] = (double)fabsl(between(s, cn, i));
    }
    for (int i = 0; i < 4 && root[i] >= 0; i++) {
        s->role[which][root[i]] = (root_role)i;
        s->size[which][root[i]] = (double)sqrtl(size[i]);
    }
}

enum { OUTSIDE = -1 }; /* 0 or infinity */

/* The oscillation of u (7). It moves in [d, c], the next root above is b, and the base is infinity (k = -1) or 0
 * (k = 1):
 *     sn^2 = (u-d)/(c-d) times {1 | c/u},    1-m = (b-c)/(b-d) times {1 | d/c} */
static real make_lower(separation *s, int a, int b, int c, int d, int e)
{
    oscillation *o = &s->coordinate[U];
    const real bd = between(s, d, b), cd = between(s, d, c), low = s->b[d], high = low + cd;
    *o = (oscillation){
        .zero = s->b[1], .origin = s->off[d], .upwards = 1, .to_cn = cd, .to_dn = bd, .far = {between(s, c, a)}};
    o->left = s->k == 1 ? low / high : 1;
    o->span = cd * o->left;
    o->C = s->k == 1 ? s->c * bd * high : s->eps * bd;
    o->power = s->k == 1 ? -2 : 0;
    o->rests = s->k == 1 ? 1 : 2;
    if (s->k == -1) o->far[1] = between(s, c, e);
    set_roles(s, U, d, c, b, OUTSIDE);
    return between(s, c, b) / bd * o->left;
}

/* The oscillation of v (7). It moves in [b, a], the next root below is c, and the base is e > a (k = -1) or infinity
 * (k = 1):
 *     sn^2 = (a-v)/(a-b) times {(e-b)/(e-v) | 1},    1-m = (b-c)/(a-c) times {(e-a)/(e-b) | 1} */
static real make_upper(separation *s, int a, int b, int c, int d, int e)
{
    oscillation *o = &s->coordinate[V];
    const real ab = between(s, b, a), ac = between(s, c, a);
    *o = (oscillation){
        .zero = s->b[1], .origin = a == BE ? s->to_be[1] : s->off[a], .upwards = -1, .to_cn = ab, .to_dn = ac};
    const real ea = s->k == 1 ? 1 : between(s, a, e), eb = s->k == 1 ? 1 : between(s, b, e);
    o->left = ea / eb;
    o->span = ab * o->left;
    o->to_base = ea;
    o->C = s->k == 1 ? s->c * ac : s->eps * ac * eb;
    o->power = s->k == 1 ? -1 : 0;
    o->rests = 1;
    o->far[0] = between(s, d, b);
    set_roles(s, V, a, b, c, s->k == 1 ? OUTSIDE : e);
    return between(s, c, b) / ac * o->left;
}

/* The distances al - u, v - al and be - v from (6): |R(z) + c| = z'^2 (v - u)/2, and (4) or (5) for R + c. */
static void find_distances(const separation *s, const moment *m, real *al_u, real *v_al, real *be_v)
{
    const real power_u = m->rate[U] * m->rate[U] * m->gap / 2, power_v = m->rate[V] * m->rate[V] * m->gap / 2;
    *be_v = INFINITY;
    if (s->k == 1) {
        *al_u = (s->b[1] + m->z[U]) * power_u / s->c;
        *v_al = (s->b[1] + m->z[V]) * power_v / s->c;
        return;
    }
    *al_u = power_u / s->eps / (s->to_be[1] + m->from[U][1]);
    if (s->librates_low) {
        *v_al = m->from[V][1] + s->to_al[1];
        *be_v = power_v / s->eps / *v_al;
    } else
        split(s->width, power_v / s->eps, 2 * m->from[V][1] + s->to_al[1] - s->to_be[1], v_al, be_v);
}

/* theta from the distances to the roots of sn and of cn, and from the signs of sn and cn */
static real angle(const oscillation *o, real to_sn, real to_cn, int sn, int cn)
{
    if (!(o->span > 0)) return 0;
    const real xi = iso_elliptic_inverse(&o->f, sn * sqrtl(to_sn / o->span), cn * sqrtl(to_cn / o->to_cn));
    return iso_oscillation_theta(o, xi);
}

/* The angles of u and v, and the signs that the components of gamma keep. From (1), gamma_i is a product of a factor
 * of u and one of v: gamma1 goes like sn_u; gamma2 like dn_u cn_v (u librates) or cn_u dn_v (v does); gamma3 like
 * sn_v, or it keeps its sign (be < b3). So the signs of gamma and of u', v' are the signs of sn and cn. */
static void find_angles(separation *s, const moment *m)
{
    int side[3], rising[2];
    real al_u, v_al, be_v;
    for (int i = 0; i < 3; i++) side[i] = m->gamma[i] < 0 ? -1 : 1;
    for (int i = 0; i < 2; i++) rising[i] = m->rate[i] < 0 ? -1 : 1;
    find_distances(s, m, &al_u, &v_al, &be_v);
    const int cn_u = side[0] * rising[U], cn_if_low = s->below_b3 ? side[1] : -side[2] * rising[V];
    const int cn_v = s->librates_low ? cn_if_low : s->below_b3 ? -rising[V] : cn_if_low;
    oscillation *u = &s->coordinate[U], *v = &s->coordinate[V];
    u->start = angle(u, m->from[U][0], s->librates_low ? al_u : m->from[U][1], side[0], cn_u);
    v->start =
        angle(v, s->below_b3 ? be_v : m->from[V][2], s->librates_low ? m->from[V][1] : v_al, -cn_v * rising[V], cn_v);
    s->sign[0] = 1;
    s->sign[1] = side[1] * (s->librates_low ? cn_v : cn_u);
    s->sign[2] = s->below_b3 ? side[2] : 1;
}

bool iso_separation_make(separation *s, const iso_problem *problem, const double point[ISO_STATE])
{
    moment m;
    memset(s, 0, sizeof *s);
    s->k = (int)problem->p.k;
    s->eps = problem->eps;
    s->det = (real)problem->p.J[0] * problem->p.J[1] * problem->p.J[2];
    sort_axes(s, problem->p.J);
    s->energy = problem->energy;
    read_state(s, point, &m);
    find_constants(s, &m);
    if (s->unstable == s->axis[1]) s->to_al[1] = ISO_OFF_SEPARATRIX * (s->off[2] - s->off[0]);
    if (s->unstable == s->axis[2]) s->to_be[2] = ISO_OFF_SEPARATRIX * (s->off[2] - s->off[0]);
    s->librates_low = s->to_al[1] > 0;
    s->below_b3 = s->to_be[2] < 0;
    const int a = s->below_b3 ? BE : 2, e = s->below_b3 ? 2 : BE;
    const int b = s->librates_low ? 1 : AL, c = s->librates_low ? AL : 1;
    if (!find_coordinates(s, &m)) return false;
    const real m1_u = make_lower(s, a, b, c, 0, e), m1_v = make_upper(s, a, b, c, 0, e);
    s->gap = (double)between(s, c, b);
    if (!iso_oscillation_solve(&s->coordinate[U], fminl(m1_u, 1)) ||
        !iso_oscillation_solve(&s->coordinate[V], fminl(m1_v, 1)))
        return false;
    find_angles(s, &m);
    return true;
}

/* --- to a state ------------------------------------------------------------------------------------------------- */

/* The square roots r of the distances from a coordinate to all roots, with the signs with which they are smooth
 * functions of theta. (ROOT_NONE: 1/sqrt(z).) Returns the distance to the root of cn. */
static double roots_at(const separation *s, int which, real theta, double root[SEPARATION_ROOTS])
{
    const oscillation *o = &s->coordinate[which];
    double sn, cn, dn;
    iso_oscillation_at(o, theta, &sn, &cn, &dn);
    const double B2 = cn * cn + (double)o->left * sn * sn, over_B = 1 / sqrt(B2);
    const double moved = (double)o->span * sn * sn / B2, to_cn = (double)o->to_cn * cn * cn / B2;
    const double part[4] = {sn * over_B, cn * over_B, dn * over_B, over_B};
    for (int i = 0; i < SEPARATION_ROOTS; i++) {
        const root_role role = s->role[which][i];
        root[i] = role == ROOT_NONE   ? 1 / sqrt((double)(o->zero + o->origin) + o->upwards * moved)
                  : role == ROOT_REST ? sqrt(s->size[which][i] + to_cn)
                                      : s->size[which][i] * part[role];
    }
    return to_cn;
}

/* By (1) gamma_i = +-r_u,i r_v,i/norm_i. Its rate: r^2 is a distance to z, so 2 r r' = +-dz/ds, and by (2) of
 * separation_impl.h dz/dsigma is sqrt(8 c) (k = 1) or sqrt(8 eps) (k = -1) times the product of all r. Then r_i' is
 * half of that constant times the product of the other r: nothing is divided. gamma' = gamma x M and (M,gamma) = 0
 * give M = gamma' x gamma, which is taken in the caller's axes. */
void iso_separation_state(const separation *s, const real theta[2], double point[ISO_STATE])
{
    double ru[SEPARATION_ROOTS], rv[SEPARATION_ROOTS], x[3], y[3];
    const double gap = roots_at(s, U, theta[U], ru) + s->gap + roots_at(s, V, theta[V], rv);
    const double fast = sqrt(2 * (double)(s->k == 1 ? s->c : s->eps)) / gap;
    for (int i = 0; i < 3; i++) {
        double others_u = ru[AL] * ru[BE], others_v = rv[AL] * rv[BE];
        for (int j = 0; j < 3; j++)
            if (j != i) others_u *= ru[j], others_v *= rv[j];
        const double d_ru = (i == 0 ? 1 : -1) * others_u, d_rv = (i == 2 ? 1 : -1) * others_v;
        x[s->axis[i]] = s->sign[i] / s->norm[i] * ru[i] * rv[i];
        y[s->axis[i]] = s->sign[i] / s->norm[i] * fast * (d_ru * rv[i] + ru[i] * d_rv);
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        point[i] = y[j] * x[l] - y[l] * x[j];
        point[3 + i] = x[i];
    }
}
