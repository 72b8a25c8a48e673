/* latitude.c - the range of the swing along an axis of revolution, and its rate, from divided differences. */
#include "exact/latitude_impl.h"

#include <float.h>
#include <math.h>

/* --- divided differences of q^p, of m(y) = 2 (H + eps q^power), and of M_x -------------------------------------- */

real iso_latitude_q(const latitude *r, real y)
{
    return r->Je + (r->Ja - r->Je) * y;
}

/* f[y,z] of f = q^p/(p (J_a - J_e)), whose slope is q^(p - 1): with x = (q(z) - q(y))/q(y) it is that at y times
 * ((1 + x)^p - 1)/(p x). */
static real power_slope(const latitude *r, real p, real y, real z)
{
    const real q = iso_latitude_q(r, y), x = (r->Ja - r->Je) * (z - y) / q;
    return powl(q, p - 1) * (x == 0 ? 1 : expm1l(p * log1pl(x)) / (p * x));
}

/* f[x,y,z]: where the three are close, sum_n (p - 1) ... (p - n - 1)/(n + 2)! h_n(t) in the complete symmetric
 * polynomials h_n of their distances t from the middle; else from the two that are farthest apart. */
static real power_bend(const latitude *r, real power, real x, real y, real z)
{
    const real low = fminl(x, fminl(y, z)), high = fmaxl(x, fmaxl(y, z)), other = x + y + z - low - high;
    const real q = iso_latitude_q(r, (low + high) / 2), scale = (r->Ja - r->Je) / q, half = (high - low) / 2;
    if (fabsl(scale) * half * fmaxl(1, fabsl(power)) > 0.1L)
        return (power_slope(r, power, other, high) - power_slope(r, power, other, low)) / (high - low);
    const real t[3] = {scale * half, -scale * half, scale * (other - (low + high) / 2)};
    real p[3] = {1, 1, 1}, factor = (power - 1) / 2, sum = 0; /* p[i]: h_n of the first i + 1 */
    for (int n = 0; n < 40; n++) {
        sum += factor * p[2];
        factor *= (power - n - 2) / (n + 3);
        p[0] *= t[0];
        p[1] = p[0] + t[1] * p[1];
        p[2] = p[1] + t[2] * p[2];
    }
    return scale * powl(q, power - 1) * sum;
}

/* m[y,z] and m[x,y,z]: m is q^power/(power (J_a - J_e)) times 2 eps (J_a - J_e) power, but for a constant. */
static real slope(const latitude *r, real y, real z)
{
    return 2 * r->eps * (r->Ja - r->Je) * r->power * power_slope(r, r->power, y, z);
}

static real bend(const latitude *r, real x, real y, real z)
{
    return 2 * r->eps * (r->Ja - r->Je) * r->power * power_bend(r, r->power, x, y, z);
}

/* m(y). Off the level H = 0 it is M^2 of the start plus a difference: M^2 may be small beside its two terms. */
real iso_latitude_m(const latitude *r, real y)
{
    if (r->H == 0) return 2 * r->eps * powl(iso_latitude_q(r, y), r->power);
    return r->M2 + (y - r->y0) * slope(r, y, r->y0);
}

real iso_latitude_Mx_slope(const latitude *r, real y, real z)
{
    return r->field == 0 ? 0 : r->field * power_slope(r, r->power / 2, y, z);
}

real iso_latitude_Mx(const latitude *r, real y)
{
    return r->Mx + (y - r->y0) * iso_latitude_Mx_slope(r, y, r->y0);
}

/* M_x^2[y,z] and M_x^2[x,y,z] */
static real square_slope(const latitude *r, real y, real z)
{
    return r->field == 0 ? 0 : iso_latitude_Mx_slope(r, y, z) * (iso_latitude_Mx(r, y) + iso_latitude_Mx(r, z));
}

static real square_bend(const latitude *r, real x, real y, real z)
{
    if (r->field == 0) return 0;
    return r->field * power_bend(r, r->power / 2, x, y, z) * (iso_latitude_Mx(r, x) + iso_latitude_Mx(r, y)) +
           iso_latitude_Mx_slope(r, x, z) * iso_latitude_Mx_slope(r, y, z);
}

/* P[y,z]; and P(y) as (dx/ds)^2 of the start plus a difference */
static real P_slope(const latitude *r, real y, real z)
{
    return (1 - y) * slope(r, y, z) - iso_latitude_m(r, z) - square_slope(r, y, z);
}

static real P_at(const latitude *r, real y)
{
    const real Mx = iso_latitude_Mx(r, y);
    return y == 1 ? -Mx * Mx : r->dx0 * r->dx0 + (y - r->y0) * P_slope(r, y, r->y0);
}

/* --- the range of y --------------------------------------------------------------------------------------------- */

typedef real function(const latitude *r, real y);

static real P_rate(const latitude *r, real y)
{
    return P_slope(r, y, y);
}

/* P''/2 */
static real P_bend(const latitude *r, real y)
{
    return (1 - y) * bend(r, y, y, y) - slope(r, y, y) - square_bend(r, y, y, y);
}

/* The zero between low and high, which f passes upwards (rising) or downwards; it may be one of them. */
static real bisect(const latitude *r, function *f, bool rising, real low, real high)
{
    for (int i = 0; i < 200; i++) {
        const real middle = (low + high) / 2;
        if (middle == low || middle == high) break;
        *((f(r, middle) > 0) == rising ? &high : &low) = middle;
    }
    return (low + high) / 2;
}

/* A zero of P, by bisection and, as long as it gets better, Newton's method. */
static real root_of_P(const latitude *r, bool rising, real low, real high)
{
    real y = bisect(r, P_at, rising, low, high);
    for (int i = 0; i < 4; i++) {
        const real next = y - P_at(r, y) / P_rate(r, y);
        if (!(next >= low && next <= high && fabsl(P_at(r, next)) < fabsl(P_at(r, y)))) break;
        y = next;
    }
    return y;
}

enum { MOST_PARTS = 9 };

/* Adds to places between which the rate of f keeps its sign those where f is zero. */
static int split(const latitude *r, function *f, int count, real place[MOST_PARTS])
{
    real all[MOST_PARTS];
    int parts = 0;
    for (int i = 0; i < count; i++) {
        const bool above = f(r, place[i]) > 0, ends = i + 1 == count, then = ends ? above : f(r, place[i + 1]) > 0;
        all[parts++] = place[i];
        if (above != then) all[parts++] = bisect(r, f, then, place[i], place[i + 1]);
    }
    for (int i = 0; i < parts; i++) place[i] = all[i];
    return parts;
}

/* Places between which P is monotonic. q^(2 - power) P'' is A + B q + C q^(-power/2): its rate is zero at one y at
 * most, so by Rolle P'' is at two and P' at three at most. The first place is negative, the last is 1. */
static int monotonic_parts(const latitude *r, real place[MOST_PARTS])
{
    const real d = r->Ja - r->Je, p = r->power, low = d > 0 ? fmaxl(-1, -r->Je / (2 * d)) : -1;
    const real q0 = iso_latitude_q(r, r->y0), far = r->Mx - 2 * r->field * powl(q0, p / 2) / (p * d);
    const real q = powl((p / 2 - 1) * far * r->field / (2 * r->eps * (p + 1)), 1 / (p / 2 + 1)),
               turn = (q - r->Je) / d;
    int count = 0;
    place[count++] = low;
    if (turn > low && turn < 1) place[count++] = turn;
    place[count++] = 1;
    count = split(r, P_bend, count, place);
    return split(r, P_rate, count, place);
}

/* 1 - y at a root y of P. Near the pole the difference has no digits; there it is M_x^2/m, because
 * P = (1 - y) m - M_x^2 = 0. */
static real rest_of(const latitude *r, real y)
{
    const real m = iso_latitude_m(r, y), Mx = iso_latitude_Mx(r, y), rest = Mx * Mx / m;
    return m > 0 && fabsl(rest - (1 - y)) < 1e-14L ? rest : 1 - y;
}

/* |y0 - root| for a root of P: the difference or, where that has fewer digits, what P(y0) = (y0 - root) P[root,y0]
 * gives. The slope P[root,y0] is Q times the distance of the other root: where that root is the nearer one the slope
 * has fewer digits. Q is about m, and about (dM_x/dy)^2 in a strong field. */
real iso_latitude_distance(const latitude *r, real root)
{
    const real m = iso_latitude_m(r, r->y0), D = iso_latitude_Mx_slope(r, root, r->y0), direct = fabsl(root - r->y0);
    const real steep = fabsl(rest_of(r, root) * slope(r, root, r->y0) - m - square_slope(r, root, r->y0));
    return direct * (m + D * D) >= steep ? direct : r->dx0 * r->dx0 / steep;
}

/* a and b: the first places above and below y0 where P falls to zero. If the motion turns at the
 * start, one of them is y0. */
void iso_latitude_range(latitude *r)
{
    real place[MOST_PARTS], from = r->y0;
    const int count = monotonic_parts(r, place);
    for (int i = 0; i < count; i++) {
        if (place[i] <= r->y0) continue;
        r->a = place[i];
        if (P_at(r, place[i]) > 0) {
            from = place[i];
            continue;
        }
        r->a = place[i] == 1 && iso_latitude_Mx(r, 1) == 0 && P_at(r, from) > 0 ? 1
                                                                                : root_of_P(r, false, from, place[i]);
        break;
    }
    if (r->y0 >= 1) r->a = 1;
    from = r->y0;
    for (int i = count - 1; i >= 0 && !r->has_b; i--) {
        if (place[i] >= r->y0) continue;
        r->has_b = P_at(r, place[i]) <= 0;
        if (r->has_b) r->b = root_of_P(r, true, place[i], from);
        from = place[i];
    }
    r->rest_a = rest_of(r, r->a);
    r->sense = iso_latitude_Mx(r, r->a) > 0 ? 1 : -1;
    r->Mx_a = r->field == 0 ? fabsl(r->Mx) : sqrtl(r->rest_a * iso_latitude_m(r, r->a));
    const real P0 = P_at(r, 0), field = fabsl(square_slope(r, 0, r->y0));
    const real terms = r->dx0 * r->dx0 + r->y0 * (fabsl(P_slope(r, 0, r->y0)) + field);
    r->homoclinic = terms > 0 && r->has_b && fabsl(P0) <= 8 * LDBL_EPSILON * terms;
    if (r->homoclinic) r->b = -ISO_OFF_SEPARATRIX * r->a;
    r->side = r->has_b && r->b > 0;
    r->rest_b = r->side ? rest_of(r, r->b) : 1;
    r->a_b = r->side ? iso_latitude_distance(r, r->a) + iso_latitude_distance(r, r->b) : r->a - r->b;
    r->distance = P0 / iso_latitude_m(r, 0);
}

/* --- along the way ---------------------------------------------------------------------------------------------- */

/* Leibniz's rule gives Q = -P[y,a,b], P = (1 - y) m - M_x^2, in three ways, one for each of the factors 1 - y, 1 - a
 * and 1 - b. The smallest of the three is 1 - a, and with it the two terms of m cancel least:
 *
 *     Q = m[y,b] - (1 - a) m[y,a,b] + M_x^2[y,a,b],        without b:  Q = m(y) - (1 - a) m[y,a] + M_x^2[y,a].
 *
 * (With 1 - y they cancel to 1e-8 of their size where q^(-1/k) is steep and the orbit passes the pole.)
 *
 * With D = M_x[y,a] and A = M_x(a) + (1 - a) D, M_x = A - (1 - y) D. So psi = -D/(dx/ds) + (A/(dx/ds) - S dn)/(1 - y),
 * where the roots P(a) = P(b) = 0 give
 *
 *     A^2 - (S dn dx/ds)^2 = (1 - a) (1 - y) ((1 - b) (m[a,b] + y m[y,a,b]) + D^2 - b M_x^2[y,a,b]),   across the
 *     equator                (1 - a) (1 - y) (m[y,a] + D^2) */
real iso_latitude_rate(const latitude *r, real y, real dn, real *psi)
{
    const real a = r->a, b = r->b, curved = r->has_b ? bend(r, y, a, b) : 0, reach = r->side ? a : a - b;
    const real square = r->has_b ? reach * (slope(r, y, b) - r->rest_a * curved + square_bend(r, y, a, b))
                                 : iso_latitude_m(r, y) - r->rest_a * slope(r, y, a) + square_slope(r, y, a);
    const real rate = sqrtl(square);
    if (!psi) return rate;
    const real D = r->sense * iso_latitude_Mx_slope(r, y, a), A = r->Mx_a + r->rest_a * D;
    const real S = sqrtl(r->rest_a * r->rest_b), sum = A / rate + S * dn;
    if (A < 0) return *psi = -D / rate + (A / rate - S * dn) / (1 - y), rate;
    const real more =
        r->side ? r->rest_b * (slope(r, a, b) + y * curved) - b * square_bend(r, y, a, b) : slope(r, y, a);
    *psi = -D / rate + (sum > 0 ? r->rest_a * (more + D * D) / (rate * rate) / sum : 0);
    return rate;
}
