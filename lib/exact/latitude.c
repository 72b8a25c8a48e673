/* latitude.c - the range of the swing along an axis of revolution, and its rate, from divided differences. */
#include "exact/latitude_impl.h"

#include <float.h>
#include <math.h>

/* --- divided differences of m(y) = 2 (H + eps q^power) ---------------------------------------------------------- */

real iso_latitude_q(const latitude *r, real y)
{
    return r->Je + (r->Ja - r->Je) * y;
}

/* m[y,z] = (m(z) - m(y))/(z - y): with x = (q(z) - q(y))/q(y) it is m' at y times ((1 + x)^power - 1)/(power x). */
static real slope(const latitude *r, real y, real z)
{
    const real q = iso_latitude_q(r, y), x = (r->Ja - r->Je) * (z - y) / q;
    const real part = x == 0 ? r->power : expm1l(r->power * log1pl(x)) / x;
    return 2 * r->eps * (r->Ja - r->Je) * powl(q, r->power - 1) * part;
}

/* m(y). Off the level H = 0 it is M^2 of the start plus a difference: M^2 may be small beside its two terms. */
real iso_latitude_m(const latitude *r, real y)
{
    if (r->H == 0) return 2 * r->eps * powl(iso_latitude_q(r, y), r->power);
    return r->M2 + (y - r->y0) * slope(r, y, r->y0);
}

/* m[x,y,z]: where the three are close, sum_n binomial(power, n+2) h_n(t) in the complete symmetric polynomials h_n of
 * their distances t from the middle; else from the two that are farthest apart. */
static real bend(const latitude *r, real x, real y, real z)
{
    const real low = fminl(x, fminl(y, z)), high = fmaxl(x, fmaxl(y, z)), other = x + y + z - low - high;
    const real q = iso_latitude_q(r, (low + high) / 2), scale = (r->Ja - r->Je) / q, half = (high - low) / 2;
    if (fabsl(scale) * half * fmaxl(1, fabsl(r->power)) > 0.1L)
        return (slope(r, other, high) - slope(r, other, low)) / (high - low);
    const real t[3] = {scale * half, -scale * half, scale * (other - (low + high) / 2)};
    real p[3] = {1, 1, 1}, binomial = r->power * (r->power - 1) / 2, sum = 0; /* p[i]: h_n of the first i + 1 */
    for (int n = 0; n < 40; n++) {
        sum += binomial * p[2];
        binomial *= (r->power - n - 2) / (n + 3);
        p[0] *= t[0];
        p[1] = p[0] + t[1] * p[1];
        p[2] = p[1] + t[2] * p[2];
    }
    return 2 * r->eps * scale * scale * powl(q, r->power) * sum;
}

/* P[y,z]; and P(y) as (dx/ds)^2 of the start plus a difference */
static real P_slope(const latitude *r, real y, real z)
{
    return (1 - y) * slope(r, y, z) - iso_latitude_m(r, z);
}

static real P_at(const latitude *r, real y)
{
    return y == 1 ? -r->Mx * r->Mx : r->dx0 * r->dx0 + (y - r->y0) * P_slope(r, y, r->y0);
}

/* --- the range of y --------------------------------------------------------------------------------------------- */

typedef real function(const latitude *r, real y);

static real P_rate(const latitude *r, real y)
{
    return P_slope(r, y, y);
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

/* Places between which P is monotonic. P'' = 0 at one y at most, so by Rolle P' = 0 at two at most. The first place
 * is negative, the last is 1. */
static int monotonic_parts(const latitude *r, real place[5])
{
    const real d = r->Ja - r->Je, p = r->power, low = d > 0 ? fmaxl(-1, -r->Je / (2 * d)) : -1;
    const real turn = ((p - 1) * d - 2 * r->Je) / (d * (p + 1));
    real part[3] = {low, turn > low && turn < 1 ? turn : 1, 1};
    int count = 0;
    place[count++] = low;
    for (int i = 0; i < 2; i++)
        if (part[i] < part[i + 1] && (P_rate(r, part[i]) > 0) != (P_rate(r, part[i + 1]) > 0))
            place[count++] = bisect(r, P_rate, P_rate(r, part[i + 1]) > 0, part[i], part[i + 1]);
    place[count++] = 1;
    return count;
}

/* 1 - y at a root y of P. Near the pole the difference has no digits; there it is M_x^2/m, because
 * P = (1 - y) m - M_x^2 = 0. */
static real rest_of(const latitude *r, real y)
{
    const real m = iso_latitude_m(r, y), rest = r->Mx * r->Mx / m;
    return m > 0 && fabsl(rest - (1 - y)) < 1e-14L ? rest : 1 - y;
}

/* |y0 - root| for a root of P: the difference or, where that has no digits, what P(y0) = (y0 - root) P[root,y0]
 * gives. */
real iso_latitude_distance(const latitude *r, real root)
{
    const real m = iso_latitude_m(r, r->y0), direct = fabsl(root - r->y0);
    const real steep = fabsl(rest_of(r, root) * slope(r, root, r->y0) - m);
    return direct * m >= steep ? direct : r->dx0 * r->dx0 / steep;
}

/* a and b: the first places above and below y0 where P falls to zero. If the motion turns at the
 * start, one of them is y0. */
void iso_latitude_range(latitude *r)
{
    real place[5], from = r->y0;
    const int count = monotonic_parts(r, place);
    for (int i = 0; i < count; i++) {
        if (place[i] <= r->y0) continue;
        r->a = place[i];
        if (P_at(r, place[i]) > 0) {
            from = place[i];
            continue;
        }
        r->a = place[i] == 1 && r->Mx == 0 && P_at(r, from) > 0 ? 1 : root_of_P(r, false, from, place[i]);
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
    const real P0 = P_at(r, 0), terms = r->dx0 * r->dx0 + r->y0 * fabsl(P_slope(r, 0, r->y0));
    r->homoclinic = terms > 0 && r->has_b && fabsl(P0) <= 8 * LDBL_EPSILON * terms;
    if (r->homoclinic) r->b = -ISO_OFF_SEPARATRIX * r->a;
    r->side = r->has_b && r->b > 0;
    r->rest_b = r->side ? rest_of(r, r->b) : 1;
    r->a_b = r->side ? iso_latitude_distance(r, r->a) + iso_latitude_distance(r, r->b) : r->a - r->b;
    r->distance = P0 / iso_latitude_m(r, 0);
}

/* --- along the way ---------------------------------------------------------------------------------------------- */

/* Leibniz's rule gives Q = -P[y,a,b], P = (1 - y) m - M_x^2, in three ways, one for each of the factors 1 - y, 1 - a
 * and 1 - b. The smallest of the three is 1 - a, and with it the two terms cancel least:
 *
 *     Q = m[y,b] - (1 - a) m[y,a,b],        without b:  Q = m(y) - (1 - a) m[y,a].
 *
 * (With 1 - y they cancel to 1e-8 of their size where q^(-1/k) is steep and the orbit passes the pole.) */
real iso_latitude_rate(const latitude *r, real y, real dn, real *psi)
{
    const real reach = !r->has_b ? 1 : r->side ? r->a : r->a - r->b;
    const real curved = r->has_b ? bend(r, y, r->a, r->b) : 0;
    const real Q =
        r->has_b ? slope(r, y, r->b) - r->rest_a * curved : iso_latitude_m(r, y) - r->rest_a * slope(r, y, r->a);
    const real rate = sqrtl(reach * Q);
    if (!psi) return rate;
    const real S = sqrtl(r->rest_a * r->rest_b);
    const real more = r->side ? r->rest_b * (slope(r, r->a, r->b) + y * curved) : slope(r, y, r->a);
    const real sum = fabsl(r->Mx) / rate + S * dn;
    *psi = sum > 0 ? r->rest_a * more / (reach * Q) / sum : 0;
    return rate;
}
