/* oscillation.c - the series of one oscillation: from the elliptic functions of xi to the angle theta that grows
 * evenly.
 *
 *  (1) dx/dsigma is known as a function of xi = pi x/K. So dsigma/dxi = (K/pi)/(dx/dsigma) is one too; it is even,
 *      and its cosine series a_0 + sum a_n cos n xi is found from samples.
 *  (2) Integrated: sigma = (K/pi) (a_0 xi + sum (a_n/n) sin n xi). With theta = omega sigma and omega = pi/(a_0 K)
 *      this is theta = xi + sum beta_n sin n xi, beta_n = a_n/(a_0 n).
 *  (3) The inverse xi = theta + sum gamma_n sin n theta: dxi/dtheta = 1/(1 + sum n beta_n cos n xi) is sampled at
 *      even theta, where Newton's method finds xi; its cosine series gives n gamma_n. The series of z is found
 *      likewise.
 */
#include "exact/oscillation_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "exact/series_impl.h"

/* --- series ----------------------------------------------------------------------------------------------------- */

/* f(pi j/N) = sum_n a_n cos(n pi j/N), j, n = 0 ... N */
static void cosine_transform(int N, const real f[], real a[])
{
    real cosine[2 * MOST_XI_MODES];
    for (int i = 0; i < 2 * N; i++) cosine[i] = cosl(ISO_PI_LONG * i / N);
    for (int n = 0; n <= N; n++) {
        real sum = (f[0] + (n % 2 ? -f[N] : f[N])) / 2;
        for (int j = 1; j < N; j++) sum += f[j] * cosine[n * j % (2 * N)];
        a[n] = sum * (n == 0 || n == N ? 1 : 2) / N;
    }
}

/* sum_n b_n sin n x, and its derivative, by Clenshaw's rule for both parts of exp(i n x) */
static real sine_series_l(const real b[], int modes, real x, real *derivative)
{
    const real twice = 2 * cosl(x), s = sinl(x), c = cosl(x);
    real p = 0, p1 = 0, q = 0, q1 = 0;
    for (int n = modes; n >= 1; n--) {
        const real r = b[n] + twice * p - p1, t = n * b[n] + twice * q - q1;
        p1 = p, p = r;
        q1 = q, q = t;
    }
    *derivative = q * c - q1;
    return p * s;
}

real iso_oscillation_theta(const oscillation *o, real xi)
{
    real unused;
    return xi + sine_series_l(o->beta, o->modes, xi, &unused);
}

/* xi from theta: the first terms of (3), then one step of Newton's method on (2). */
static real xi_at(const oscillation *o, real theta)
{
    real slope;
    const real xi = theta + sine_series(o->gamma, o->terms, (double)theta, NULL);
    const real miss = xi + sine_series_l(o->beta, o->modes, xi, &slope) - theta;
    return xi - miss / (1 + slope);
}

void iso_oscillation_at(const oscillation *o, real theta, double *sn, double *cn, double *dn)
{
    if (o->parts > 0) {
        double cosine[MOST_PARTS + ABREAST], sine[MOST_PARTS + ABREAST];
        set_multiples((double)theta / 2, (double)theta, o->parts, cosine, sine);
        *sn = *cn = 0;
        for (int n = 0; n < o->parts; n++) {
            *sn += o->sn_part[n] * sine[n];
            *cn += o->cn_part[n] * cosine[n];
        }
        *dn = sqrt((double)o->f.m1 + (double)(1 - o->f.m1) * *cn * *cn);
        return;
    }
    real s, c, d;
    iso_elliptic_at(&o->f, xi_at(o, theta), &s, &c, &d);
    *sn = (double)s, *cn = (double)c, *dn = (double)d;
}

/* --- an oscillation --------------------------------------------------------------------------------------------- */

/* z and dx/dsigma at xi */
static real z_at(const oscillation *o, real xi, real *rate)
{
    real sn, cn, dn;
    iso_elliptic_at(&o->f, xi, &sn, &cn, &dn);
    const real B2 = cn * cn + o->left * sn * sn, moved = o->span * sn * sn / B2;
    const real z = o->origin + o->upwards * moved, near = o->to_cn * cn * cn / B2;
    real square = 2 * o->C;
    for (int i = 0; i < o->rests; i++) square *= o->far[i] + near;
    for (int i = 0; i > o->power; i--) square /= o->zero + z;
    *rate = sqrtl(square);
    return z;
}

/* xi where theta is th, in [low, pi]: Newton's method, kept in its interval */
static real invert(const oscillation *o, real th, real low, real *slope)
{
    real high = ISO_PI_LONG, xi = low, derivative;
    for (int i = 0; i < 100; i++) {
        const real miss = xi + sine_series_l(o->beta, o->modes, xi, &derivative) - th;
        *(miss > 0 ? &high : &low) = xi;
        real next = xi - miss / (1 + derivative);
        if (!(next >= low && next <= high)) next = (low + high) / 2;
        const real moved = fabsl(next - xi);
        xi = next;
        if (moved < 4 * LDBL_EPSILON) break;
    }
    *slope = 1 + derivative;
    return xi;
}

/* (1) and (2): beta and omega */
static bool find_theta(oscillation *o)
{
    real f[MOST_XI_MODES + 1], a[MOST_XI_MODES + 1];
    int N = 16;
    for (;; N *= 2) {
        for (int j = 0; j <= N; j++) {
            z_at(o, ISO_PI_LONG * j / N, &f[j]);
            f[j] = 1 / f[j];
        }
        cosine_transform(N, f, a);
        if (fabsl(a[N]) + fabsl(a[N - 1]) + fabsl(a[N - 2]) <= 1e-18L * a[0]) break;
        if (N == MOST_XI_MODES) return false;
    }
    o->omega = ISO_PI_LONG / (a[0] * o->f.K);
    o->modes = 0;
    for (int n = 1; n <= N; n++) {
        o->beta[n] = a[n] / (a[0] * n);
        if (fabsl(o->beta[n]) > LDBL_EPSILON / 8) o->modes = n;
    }
    o->samples = N;
    return true;
}

/* Terms of gamma and z below this are left out: one step of Newton's method squares the error. */
static const double FIRST = 1e-11;

/* (3) from samples at theta = pi j/N. Returns whether N is large enough. */
static bool find_xi(oscillation *o, int N)
{
    double *const slope = o->gamma, *const work = o->z, *const z = work + 2 * N; /* work, then z, in one */
    real low = 0, part, unused;
    for (int j = 0; j <= N; j++) {
        o->at[j] = z_at(o, low = invert(o, ISO_PI_LONG * j / N, low, &part), &unused);
        slope[j] = (double)(1 / part);
        z[j] = (double)o->at[j];
    }
    cosine_series(slope, N, 1, work);
    cosine_series(z, N, 1, work);
    const double most = largest_of(slope, 0, N);
    const bool enough = fabs(slope[N]) + fabs(slope[N - 1]) + fabs(slope[N - 2]) <= 1e-15 * most;
    o->samples = N;
    o->terms = 0;
    for (int n = 0; n <= N; n++) {
        o->z[n] = z[n];
        if (n > 0) o->gamma[n] = slope[n] / n;
        if (n > 0 && (fabs(o->gamma[n]) > FIRST || fabs(o->z[n]) > FIRST * (double)o->span)) o->terms = n;
    }
    return enough;
}

/* sn and cn directly as series in theta, where few terms are enough. Not where m1 is small: there sn or cn stays
 * small over long times, and a series has only absolute accuracy. */
static void find_parts(oscillation *o)
{
    enum { MOST_SAMPLES = 256 };
    double sine[4 * MOST_SAMPLES], sn[MOST_SAMPLES + 1], cn[MOST_SAMPLES + 1];
    const int N = 2 * o->samples;
    o->parts = 0;
    if (o->f.m1 < 1e-3L || N > MOST_SAMPLES) return;
    for (int i = 0; i < 4 * N; i++) sine[i] = sin(ISO_PI * i / (2 * N));
    for (int j = 0; j <= N; j++) {
        real s, c, d;
        iso_elliptic_at(&o->f, xi_at(o, ISO_PI_LONG * j / N), &s, &c, &d);
        sn[j] = (double)s, cn[j] = (double)c;
    }
    for (int n = 0; n < MOST_PARTS && n < N; n++) {
        o->sn_part[n] = sn[N] * sine[(2 * n + 1) * N % (4 * N)] / N;
        o->cn_part[n] = cn[0] / N;
        for (int j = 1; j < N; j++) {
            const int at = (2 * n + 1) * j % (4 * N);
            o->sn_part[n] += 2 * sn[j] * sine[at] / N;
            o->cn_part[n] += 2 * cn[j] * sine[(at + N) % (4 * N)] / N;
        }
        if (fabs(o->sn_part[n]) + fabs(o->cn_part[n]) > 6e-17) continue;
        o->parts = n;
        return;
    }
}

void iso_oscillation_release(oscillation *o)
{
    free(o->at);
    free(o->gamma);
    free(o->z);
    o->at = NULL, o->gamma = NULL, o->z = NULL;
}

/* Whether N samples are enough. */
static bool solve_with(oscillation *o, int N)
{
    const size_t size = (size_t)N + 1;
    iso_oscillation_release(o);
    o->at = malloc(size * sizeof *o->at);
    o->gamma = malloc(size * sizeof *o->gamma);
    o->z = malloc(3 * size * sizeof *o->z);
    o->no_memory = !o->at || !o->gamma || !o->z;
    return !o->no_memory && find_xi(o, N);
}

bool iso_oscillation_refine(oscillation *o)
{
    return o->samples < MOST_MODES && solve_with(o, 2 * o->samples);
}

bool iso_oscillation_solve(oscillation *o, real m1)
{
    iso_elliptic_set(&o->f, m1);
    if (!find_theta(o)) return false;
    for (int N = o->samples; N <= MOST_MODES; N *= 2) {
        if (solve_with(o, N)) return find_parts(o), true;
        if (o->no_memory) return false;
    }
    return false;
}
