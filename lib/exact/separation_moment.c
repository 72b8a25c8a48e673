/* separation_moment.c - from a state to its constants and coordinates: steps (1) to (6) at the top of
 * separation.c. */
#include <float.h>
#include <math.h>

#include "base/vec3_impl.h"
#include "exact/separation_moment_impl.h"

void iso_separation_split(real sum, real product, real difference, real *x, real *y)
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

void iso_separation_sort_axes(separation *s, const double J[3])
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

void iso_separation_read(const separation *s, const double point[ISO_STATE], separation_moment *m)
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

/* The unit vectors m and l = m x gamma of (2): m is along M. Where M = 0, m is any unit vector across gamma. */
static void tangents(const separation_moment *at, real m[3], real l[3])
{
    const real *g = at->gamma, *M = at->M, M2 = M[0] * M[0] + M[1] * M[1] + M[2] * M[2];
    const int flat = fabsl(g[0]) < fabsl(g[1]) ? 0 : 1; /* an axis not along gamma */
    real length = 0;
    for (int i = 0; i < 3; i++) {
        m[i] = M2 > 0 ? M[i] : (i == flat) - g[flat] * g[i];
        length += m[i] * m[i];
    }
    for (int i = 0; i < 3; i++) m[i] /= sqrtl(length);
    for (int i = 0; i < 3; i++) l[i] = m[(i + 1) % 3] * g[(i + 2) % 3] - m[(i + 2) % 3] * g[(i + 1) % 3];
}

/* (2): gives u + v - 2 b2 and sets v - u. */
static real find_gap(const separation *s, separation_moment *m, real *X, real *Y)
{
    real unit[3], l[3];
    tangents(m, unit, l);
    *X = form(s, PAST_B2, l, l) - form(s, PAST_B2, unit, unit);
    *Y = 2 * form(s, PAST_B2, unit, l);
    m->gap = hypotl(*X, *Y);
    return form(s, PAST_B2, l, l) + form(s, PAST_B2, unit, unit);
}

/* (3): R(b_j) + c, and the size of its terms */
static real excess(const separation *s, const separation_moment *m, int j, real *size)
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
static void find_roots(separation *s, separation_moment *m)
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
        iso_separation_split(s->width, kappa / s->eps, difference, &s->to_al[j], &s->to_be[j]);
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
static void carry_on(separation *s, separation_moment *m)
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

void iso_separation_find_constants(separation *s, separation_moment *m)
{
    find_roots(s, m);
    if (!(m->gap < 1e-3L * (s->off[2] - s->off[0]))) return;
    const int unstable = s->unstable;
    carry_on(s, m);
    find_roots(s, m);
    s->unstable = unstable;
}

/* --- coordinates ------------------------------------------------------------------------------------------------ */

/* u and v, their distances from b1, b2, b3 by (1), and u', v'. The coordinate line of z has the direction
 * e_z,i = +-gamma_i/(b_i - z), made a unit vector by (1): e_u,i = +-sqrt(|b_i - v| prod_{j != i} |b_j - u|/((v - u)
 * |b_i - b_j| |b_i - b_l|)), likewise e_v. Then z' = (gamma', e_z) with gamma' = gamma x M. */
bool iso_separation_find_coordinates(const separation *s, separation_moment *m)
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
    iso_separation_split(gap, g[1] * g[1] * n[1], -sum, &to_u[1], &to_v[1]);
    m->rate[U] = m->rate[V] = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3, side = g[i] < 0 ? -1 : 1;
        const real velocity = s->handed * (g[j] * M[l] - g[l] * M[j]), scale = side / sqrtl(gap * n[i]);
        m->rate[U] += velocity * scale * (i == 0 ? 1 : -1) * sqrtl(to_v[i] * to_u[j] * to_u[l]);
        m->rate[V] += velocity * scale * (i == 2 ? -1 : 1) * sqrtl(to_u[i] * to_v[j] * to_v[l]);
    }
    return true;
}
