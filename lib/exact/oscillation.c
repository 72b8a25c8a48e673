#include "exact/oscillation_impl.h"

#include <float.h>
#include <math.h>

#include "exact/series_impl.h"

/* --- series ----------------------------------------------------------------------------------------------------- */

/* f(pi j/N) = sum_n a_n cos(n pi j/N), j, n = 0 ... N */
static void cosine_transform(int N, const real f[], real a[])
{
    real cosine[2 * MOST_MODES];
    for (int i = 0; i < 2 * N; i++) cosine[i] = cosl(ISO_PI * i / N);
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

double iso_oscillation_xi(const oscillation *o, double theta)
{
    return theta + sine_series(o->gamma, o->terms, theta);
}

/* --- an oscillation --------------------------------------------------------------------------------------------- */

/* z and dx/dsigma at xi */
static real z_at(const oscillation *o, real xi, real *rate)
{
    real sn, cn, dn;
    iso_elliptic_at(&o->f, xi, &sn, &cn, &dn);
    const real B2 = cn * cn + o->left * sn * sn, moved = o->span * sn * sn / B2;
    const real z = o->origin + o->upwards * moved,
               to_rest = o->far + (o->rest_by_sn ? moved : o->to_cn * cn * cn / B2);
    *rate = sqrtl(2 * o->C * (o->over_z ? 1 / z : to_rest));
    return z;
}

/* Whether a series has come down to the last digits before it ends. */
static bool resolved(const real a[], int N, real rounding)
{
    return fabsl(a[N]) + fabsl(a[N - 1]) + fabsl(a[N - 2]) <= rounding * fabsl(a[0]);
}

/* xi where theta is th, in [low, pi]: Newton's method, kept in its interval */
static real invert(const oscillation *o, real th, real low, real *slope)
{
    real high = ISO_PI, xi = low, derivative;
    for (int i = 0; i < 100; i++) {
        const real miss = xi + sine_series_l(o->beta, o->modes, xi, &derivative) - th;
        if (miss > 0)
            high = xi;
        else
            low = xi;
        real next = xi - miss / (1 + derivative);
        if (!(next >= low && next <= high)) next = (low + high) / 2;
        const real moved = fabsl(next - xi);
        xi = next;
        if (moved < 4 * LDBL_EPSILON) break;
    }
    *slope = 1 + derivative;
    return xi;
}

/* beta and omega: sigma = integral of dx/rate */
static bool find_theta(oscillation *o)
{
    real f[MOST_MODES + 1], a[MOST_MODES + 1];
    int N = 16;
    for (;; N *= 2) {
        for (int j = 0; j <= N; j++) {
            z_at(o, ISO_PI * j / N, &f[j]);
            f[j] = 1 / f[j];
        }
        cosine_transform(N, f, a);
        if (N == MOST_MODES || resolved(a, N, 1e-18L)) break;
    }
    o->omega = ISO_PI / (a[0] * o->f.K);
    o->modes = 0;
    for (int n = 1; n <= N; n++) {
        o->beta[n] = a[n] / (a[0] * n);
        if (fabsl(o->beta[n]) > LDBL_EPSILON / 8) o->modes = n;
    }
    o->samples = N;
    return resolved(a, N, 1e-17L);
}

bool iso_oscillation_solve(oscillation *o, real m1)
{
    real slope[MOST_MODES + 1], a[MOST_MODES + 1];
    iso_elliptic_set(&o->f, m1);
    if (!find_theta(o)) return false;
    for (int N = o->samples;; N *= 2) {
        real low = 0;
        o->samples = N;
        for (int j = 0; j <= N; j++) {
            real unused;
            o->at[j] = z_at(o, low = invert(o, ISO_PI * j / N, low, &slope[j]), &unused);
            slope[j] = 1 / slope[j];
        }
        cosine_transform(N, slope, a); /* dxi/dtheta */
        for (int n = 1; n <= N; n++) o->gamma[n] = (double)(a[n] / n);
        const bool enough = resolved(a, N, 1e-17L);
        if (!enough && N < MOST_MODES) continue;
        cosine_transform(N, o->at, a);
        o->terms = 0;
        for (int n = 0; n <= N; n++) {
            o->z[n] = (double)a[n];
            if (n > 0 && (fabs(o->gamma[n]) > 1e-18 || fabs(o->z[n]) > 1e-18 * fabs(o->z[0]))) o->terms = n;
        }
        return enough || resolved(a, N, 1e-15L);
    }
}
