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

#include <math.h>
#include <string.h>

#include "exact/separation_moment_impl.h"

/* --- along the motion ------------------------------------------------------------------------------------------- */

real iso_separation_rate(const separation *s, iso_clock clock, real u, real v)
{
    const real *b = s->b, far = s->off[0] + s->off[2] - u - v;
    const real q = s->k == -1 ? b[1] + far : (b[1] + u) * (b[1] + v) / (b[0] * b[1] * b[2]);
    return (v - u) * iso_separation_clock_rate(s, clock, q);
}

/* (1/2 pi) times the integral of |p_z dz| over one swing. p_z = (dz/dsigma)/(4 A), so
 * p_z dz = (dz/dsigma)^2/(4 A) dsigma = 2 (R + c) dsigma = 2 (R + c) dtheta/omega: the mean of 2 (R + c) over even
 * samples of theta, over omega. */
real iso_separation_action(const separation *s, const oscillation *o)
{
    real mean = 0;
    for (int j = 0; j <= o->samples; j++) {
        const real z = o->at[j], from_al = z + s->to_al[1];
        const real excess = s->k == -1 ? s->eps * from_al * (s->to_be[1] - z) : s->c * from_al / (s->b[1] + z);
        mean += 2 * fabsl(excess) * (j % o->samples == 0 ? 0.5L : 1) / o->samples;
    }
    return mean / o->omega;
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
static void give_roles(separation *s, int which, int sn, int cn, int dn, int base)
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
    give_roles(s, U, d, c, b, OUTSIDE);
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
    give_roles(s, V, a, b, c, s->k == 1 ? OUTSIDE : e);
    return between(s, c, b) / ac * o->left;
}

/* The distances al - u, v - al and be - v from (6): |R(z) + c| = z'^2 (v - u)/2, and (4) or (5) for R + c. */
static void find_distances(const separation *s, const separation_moment *m, real *al_u, real *v_al, real *be_v)
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
        iso_separation_split(s->width, power_v / s->eps, 2 * m->from[V][1] + s->to_al[1] - s->to_be[1], v_al, be_v);
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
static void find_angles(const separation *s, const separation_moment *m, real theta[2], double sign[3])
{
    int side[3], rising[2];
    real al_u, v_al, be_v;
    for (int i = 0; i < 3; i++) side[i] = m->gamma[i] < 0 ? -1 : 1;
    for (int i = 0; i < 2; i++) rising[i] = m->rate[i] < 0 ? -1 : 1;
    find_distances(s, m, &al_u, &v_al, &be_v);
    const int cn_u = side[0] * rising[U], cn_if_low = s->below_b3 ? side[1] : -side[2] * rising[V];
    const int cn_v = s->librates_low ? cn_if_low : s->below_b3 ? -rising[V] : cn_if_low;
    const oscillation *u = &s->coordinate[U], *v = &s->coordinate[V];
    theta[U] = angle(u, m->from[U][0], s->librates_low ? al_u : m->from[U][1], side[0], cn_u);
    theta[V] =
        angle(v, s->below_b3 ? be_v : m->from[V][2], s->librates_low ? m->from[V][1] : v_al, -cn_v * rising[V], cn_v);
    sign[0] = 1;
    sign[1] = side[1] * (s->librates_low ? cn_v : cn_u);
    sign[2] = s->below_b3 ? side[2] : 1;
}

void iso_separation_release(separation *s)
{
    for (int i = 0; i < 2; i++) iso_oscillation_release(&s->coordinate[i]);
}

bool iso_separation_make(separation *s, const iso_problem *problem, const double point[ISO_STATE])
{
    separation_moment m;
    memset(s, 0, sizeof *s);
    s->k = (int)problem->p.k;
    s->eps = problem->eps;
    s->det = (real)problem->p.J[0] * problem->p.J[1] * problem->p.J[2];
    iso_separation_sort_axes(s, problem->p.J);
    s->energy = problem->energy;
    iso_separation_read(s, point, &m);
    iso_separation_find_constants(s, &m);
    if (s->unstable == s->axis[1]) s->to_al[1] = ISO_OFF_SEPARATRIX * (s->off[2] - s->off[0]);
    if (s->unstable == s->axis[2]) s->to_be[2] = ISO_OFF_SEPARATRIX * (s->off[2] - s->off[0]);
    s->librates_low = s->to_al[1] > 0;
    s->below_b3 = s->to_be[2] < 0;
    const int a = s->below_b3 ? BE : 2, e = s->below_b3 ? 2 : BE;
    const int b = s->librates_low ? 1 : AL, c = s->librates_low ? AL : 1;
    if (!iso_separation_find_coordinates(s, &m)) return false;
    const real m1_u = make_lower(s, a, b, c, 0, e), m1_v = make_upper(s, a, b, c, 0, e);
    s->gap = (double)between(s, c, b);
    if (!iso_oscillation_solve(&s->coordinate[U], fminl(m1_u, 1)) ||
        !iso_oscillation_solve(&s->coordinate[V], fminl(m1_v, 1)))
        return false;
    real theta[2];
    find_angles(s, &m, theta, s->sign);
    for (int i = 0; i < 2; i++) s->coordinate[i].start = theta[i];
    return true;
}

bool iso_separation_angles(const separation *s, const double point[ISO_STATE], real theta[2])
{
    separation_moment m;
    double sign[3];
    iso_separation_read(s, point, &m);
    if (!iso_separation_find_coordinates(s, &m)) return false;
    find_angles(s, &m, theta, sign);
    return sign[1] == s->sign[1] && sign[2] == s->sign[2];
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
