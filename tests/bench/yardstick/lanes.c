/* lanes.c - the yardstick, compiled once for each width of vectors (LANES: 8, 4 or 2).
 *
 * In s, with dt/ds = (det J/k^2) q^(-1-1/(2k)) as a series, q = (gamma, J gamma) and r = q'/q:
 *
 *     k = -1    gamma'' = -4 eps q gamma + 2 eps J gamma
 *     k = 1     gamma'' = -2 eps q^-2 J gamma
 *
 * In t: gamma_tt = (1 + 1/(2k)) r gamma_t + (2 h k/det J) q ((1 - k) q gamma - J gamma) for other k (in s they take 1.0 to
 * 1.2 times as long). Each step ends with |gamma| = 1, (gamma,gamma') = 0 and |gamma'| as its equation says.
 */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "yardstick.h"

typedef double real __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t bits __attribute__((vector_size(LANES * sizeof(double))));

enum { MOST = 20 };

#define INLINE static inline __attribute__((always_inline))
#define UNROLLED _Pragma("GCC unroll 64")

enum form { SHELL, PLANE, IN_T }; /* k = -1, k = 1, others */

/* Eight, four or two orbits. */
typedef struct lanes {
    real k, alpha, coupling, speed, J[3], pull[3], factor; /* factor: det J/k^2; |gamma'|^2 = speed p^2 */
    real t, p, over_q;
    real n[3][MOST + 1], q[MOST + 1], r[MOST + 1], v[MOST + 1]; /* r = q'/q, v = dt/ds */
    real a[MOST + 1], x[3][MOST + 1], w[3][MOST + 1];
    real end[3], rate[3];
    size_t orbit[LANES];
} lanes;

INLINE real root(real a)
{
    for (int i = 0; i < LANES; i++) a[i] = sqrt(a[i]);
    return a;
}

INLINE real larger(real a, real b)
{
    const bits m = a > b;
    return (real)((m & (bits)a) | (~m & (bits)b));
}

INLINE real size_of(real a)
{
    return (real)((bits)a & INT64_MAX);
}

/* a^p for 0 < p < 1 to 4 %: the bits of a double, read as an integer, are about its logarithm. */
INLINE real rough_power(real a, double p)
{
    const double magic = 0x1p52;
    const int64_t magic_bits = 0x4330000000000000, one = 0x3ff00000;
    const real high =
        (real)((bits)((uint64_t __attribute__((vector_size(LANES * sizeof(double))))) a >> 32) | magic_bits) - magic;
    const real scaled = (high - (double)one) * p + (double)one;
    return (real)(((bits)(scaled + magic) ^ magic_bits) << 32);
}

INLINE real q_of(const lanes *L, const real n[3])
{
    return L->J[0] * n[0] * n[0] + L->J[1] * n[1] * n[1] + L->J[2] * n[2] * n[2];
}

/* coefficient n of a^2 */
INLINE real square_of(const real a[], int n)
{
    real even = {0}, odd = {0};
    const int half = (n + 1) / 2;
    UNROLLED for (int j = 0; j < half; j += 2) even += a[j] * a[n - j];
    UNROLLED for (int j = 1; j < half; j += 2) odd += a[j] * a[n - j];
    const real sum = (even + odd) * 2;
    return n % 2 == 0 ? sum + a[n / 2] * a[n / 2] : sum;
}

/* sum of a_j b_(n-j), j from `from` to n */
INLINE real product_of(const real a[], const real b[], int from, int n)
{
    real even = {0}, odd = {0};
    UNROLLED for (int j = from; j <= n; j += 2) even += a[j] * b[n - j];
    UNROLLED for (int j = from + 1; j <= n; j += 2) odd += a[j] * b[n - j];
    return even + odd;
}

/* q_(n+1) and r_n of r = q'/q */
INLINE void next_q_and_r(lanes *L, int n)
{
    real sum = {0};
    UNROLLED for (int i = 0; i < 3; i++) sum += L->J[i] * square_of(L->n[i], n + 1);
    L->q[n + 1] = sum;
    L->r[n] = ((double)(n + 1) * sum - product_of(L->q, L->r, 1, n)) * L->over_q;
}

/* p: q^(-1/(2k)) in s, q in t */
INLINE real power_of_q(enum form form, real q)
{
    return form == IN_T ? q : root(form == SHELL ? q : 1 / q);
}

INLINE void expand_shell(lanes *L, int order)
{
    UNROLLED for (int n = 0; n <= order - 2; n++)
    {
        if (n > 0) L->v[n] = -0.5 / n * product_of(L->r, L->v, 0, n - 1);
        UNROLLED for (int i = 0; i < 3; i++) L->n[i][n + 2] =
            (L->pull[i] * L->n[i][n] + L->coupling * product_of(L->q, L->n[i], 0, n)) * (1.0 / ((n + 1) * (n + 2)));
        next_q_and_r(L, n);
    }
}

INLINE void expand_plane(lanes *L, int order)
{
    UNROLLED for (int n = 0; n <= order - 2; n++)
    {
        if (n > 0) {
            L->v[n] = -1.5 / n * product_of(L->r, L->v, 0, n - 1);
            L->a[n] = -2.0 / n * product_of(L->r, L->a, 0, n - 1);
        }
        UNROLLED for (int i = 0; i < 3; i++) L->n[i][n + 2] =
            L->pull[i] * product_of(L->a, L->n[i], 0, n) * (1.0 / ((n + 1) * (n + 2)));
        next_q_and_r(L, n);
    }
}

INLINE void expand_in_t(lanes *L, int order)
{
    UNROLLED for (int n = 0; n <= order - 2; n++)
    {
        next_q_and_r(L, n);
        const real falling = (1 - L->k) * square_of(L->q, n);
        UNROLLED for (int i = 0; i < 3; i++)
        {
            L->w[i][n] = (double)(n + 1) * L->n[i][n + 1];
            L->x[i][n] = L->coupling * (falling - L->J[i] * L->q[n]);
            L->n[i][n + 2] = (L->alpha * product_of(L->r, L->w[i], 0, n) + product_of(L->x[i], L->n[i], 0, n)) *
                             (1.0 / ((n + 1) * (n + 2)));
        }
    }
}

INLINE void expand(lanes *L, enum form form, int order)
{
    if (form == SHELL)
        expand_shell(L, order);
    else if (form == PLANE)
        expand_plane(L, order);
    else
        expand_in_t(L, order);
}

/* The step for which the last two terms are as small as the tolerance. */
INLINE real length_of(const lanes *L, int order, double tolerance)
{
    real h = {0};
    for (int n = order - 1; n <= order; n++) {
        const real most = larger(larger(size_of(L->n[0][n]), size_of(L->n[1][n])), size_of(L->n[2][n]));
        const real longest = rough_power(tolerance / larger(most, 1e-200 - (real){0}), 1.0 / n);
        h = n == order ? -larger(-h, -longest) : longest;
    }
    return h;
}

INLINE void state_at(lanes *L, int order, real x)
{
    for (int i = 0; i < 3; i++) {
        real p = L->n[i][order], dp = {0};
        UNROLLED for (int n = order - 1; n >= 0; n--) dp = dp * x + p, p = p * x + L->n[i][n];
        L->end[i] = p, L->rate[i] = dp;
    }
}

INLINE real clock_at(const lanes *L, int order, real x)
{
    real p = {0};
    UNROLLED for (int n = order - 2; n >= 0; n--) p = p * x + L->v[n] * (1.0 / (n + 1));
    return p * x;
}

INLINE real pace_at(const lanes *L, int order, real x)
{
    real p = {0};
    UNROLLED for (int n = order - 2; n >= 0; n--) p = p * x + L->v[n];
    return p;
}

/* a b without rounding errors would be 1: what is missing, as exactly as an fma allows */
INLINE real fused(real a, real b, real c)
{
    for (int i = 0; i < LANES; i++) c[i] = fma(a[i], b[i], c[i]);
    return c;
}

INLINE real defect(const real a[3], const real b[3], real target)
{
    real sum = -target, lost = {0};
    for (int i = 0; i < 3; i++) {
        const real p = a[i] * b[i], next = sum + p, part = next - sum;
        lost += ((sum - (next - part)) + (p - part)) + fused(a[i], b[i], -p);
        sum = next;
    }
    return sum + lost;
}

INLINE void restore(lanes *L, enum form form)
{
    const real one = 1 - (real){0}, longer = 0.5 * defect(L->end, L->end, one);
    for (int i = 0; i < 3; i++) L->end[i] -= longer * L->end[i];
    const real along = defect(L->end, L->rate, (real){0});
    for (int i = 0; i < 3; i++) L->rate[i] -= along * L->end[i];
    const real q = q_of(L, L->end), p = power_of_q(form, q), square = L->speed * p * p;
    const real faster = defect(L->rate, L->rate, square) / (2 * square);
    for (int i = 0; i < 3; i++) L->rate[i] -= faster * L->rate[i];
    L->p = p;
}

/* dt/ds, or 1 */
static double pace_of(const yardstick_job *job, enum form form, double q)
{
    const double *J = job->J, det = J[0] * J[1] * J[2], k = job->k;
    return form == IN_T ? 1 : det / (k * k) * pow(q, -1 - 0.5 / k);
}

/* gamma = NN K, K = J w (18): gamma = J^(1/2) n scaled to 1; M = gamma' x gamma. */
static void begin_lane(lanes *L, const yardstick_job *job, enum form form, int lane, size_t orbit)
{
    const double *w = job->start[orbit], *n = w + 3, *J = job->J, k = job->k, det = J[0] * J[1] * J[2];
    double gamma[3], p[3], g = 0, h = 0, q = 0;
    for (int i = 0; i < 3; i++) g += n[i] * n[i] / J[i], h += w[i] * J[i] * w[i] / 2;
    for (int i = 0; i < 3; i++) {
        gamma[i] = n[i] / sqrt(J[i] * g);
        p[i] = sqrt(J[i]) * w[i];
        q += J[i] * gamma[i] * gamma[i];
    }
    const double eps = h * det / (k * k), coupling = form == IN_T ? 2 * h * k / det : 2 * eps / k;
    /* gamma_t = k r q gamma x p, r = 1/sqrt(det J) (point_t.c); gamma' = gamma_t dt/ds */
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        L->end[i][lane] = gamma[i];
        L->rate[i][lane] = k / sqrt(det) * q * (gamma[a] * p[b] - gamma[b] * p[a]) * pace_of(job, form, q);
        L->pull[i][lane] = -coupling * J[i];
    }
    L->coupling[lane] = form == SHELL ? 2 * coupling : coupling;
    L->speed[lane] = coupling * k;
    L->t[lane] = 0;
    L->orbit[lane] = orbit;
}

static void end_lane(const lanes *L, const yardstick_job *job, enum form form, int lane)
{
    double gamma[3], rate[3], q = 0, square = 0;
    const double *J = job->J, k = job->k, det = J[0] * J[1] * J[2];
    double *w = job->end[L->orbit[lane]], *n = w + 3;
    for (int i = 0; i < 3; i++) {
        gamma[i] = L->end[i][lane], rate[i] = L->rate[i][lane];
        q += J[i] * gamma[i] * gamma[i];
    }
    const double pace = pace_of(job, form, q);
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        n[i] = sqrt(J[i]) * gamma[i];
        square += n[i] * n[i];
        w[i] = (rate[a] * gamma[b] - rate[b] * gamma[a]) * sqrt(det) / (k * q * pace) / sqrt(J[i]);
    }
    for (int i = 0; i < 3; i++) n[i] /= sqrt(square);
}

INLINE void begin_step(lanes *L)
{
    for (int i = 0; i < 3; i++) L->n[i][0] = L->end[i], L->n[i][1] = L->rate[i];
    L->q[0] = q_of(L, L->end);
    L->over_q = 1 / L->q[0];
    L->v[0] = L->factor * L->p * L->over_q;
    L->a[0] = L->p * L->p * L->over_q;
}

/* The x at which t = time. */
INLINE real length_to(const lanes *L, int order, real guess, real left, enum form form)
{
    if (form == IN_T) return left;
    for (int i = 0; i < 6; i++) guess -= (clock_at(L, order, guess) - left) / pace_at(L, order, guess);
    return guess;
}

/* The lane's next orbit, if there is one. */
static bool take_next(lanes *L, const yardstick_job *job, enum form form, int lane, size_t *next)
{
    const bool found = *next < job->count;
    if (found) begin_lane(L, job, form, lane, (*next)++);
    return found;
}

INLINE void solve(yardstick_job *job, enum form form, int order)
{
    const double k = job->k;
    size_t next = 0;
    int busy = 0;
    bool at_work[LANES];
    lanes L;
    memset(&L, 0, sizeof L);
    L.k = k - (real){0}, L.alpha = 1 + 0.5 / k - (real){0};
    L.factor = job->J[0] * job->J[1] * job->J[2] / (k * k) - (real){0};
    for (int i = 0; i < 3; i++) L.J[i] = job->J[i] - (real){0};
    for (int i = 0; i < LANES; i++) {
        begin_lane(&L, job, form, i, 0);
        at_work[i] = take_next(&L, job, form, i, &next);
        busy += at_work[i];
    }
    restore(&L, form);
    while (busy > 0) {
        begin_step(&L);
        expand(&L, form, order);
        const real x = length_of(&L, order, job->tolerance), dt = form == IN_T ? x : clock_at(&L, order, x);
        const real left = job->time - L.t;
        const bits due = dt >= left;
        bool any = false;
        for (int i = 0; i < LANES; i++) any |= due[i] != 0;
        L.t += dt;
        job->steps += busy;
        if (any) {
            const real last = length_to(&L, order, x * (left / dt), left, form);
            state_at(&L, order, (real)((due & (bits)last) | (~due & (bits)x)));
            restore(&L, form);
            for (int i = 0; i < LANES; i++) {
                if (!due[i]) continue;
                if (at_work[i]) end_lane(&L, job, form, i), busy--;
                at_work[i] = take_next(&L, job, form, i, &next);
                busy += at_work[i];
            }
        } else {
            state_at(&L, order, x);
        }
        restore(&L, form);
    }
}

#define ORDER(n)                                                                                                     \
    static void solve_##n(yardstick_job *job)                                                                        \
    {                                                                                                                \
        job->steps = 0;                                                                                              \
        if (job->k == -1)                                                                                            \
            solve(job, SHELL, n);                                                                                    \
        else if (job->k == 1)                                                                                        \
            solve(job, PLANE, n);                                                                                    \
        else                                                                                                         \
            solve(job, IN_T, n);                                                                                     \
    }

ORDER(12)
ORDER(14)
ORDER(16)
ORDER(18)
ORDER(20)

static bool runs_here(void)
{
#if LANES == 8
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma");
#elif LANES == 4
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return true;
#endif
}

#define CODE(name)                                                                                                   \
    {                                                                                                                \
        name, LANES, {12, 14, 16, 18, 20}, runs_here,                                                                \
        {                                                                                                            \
            solve_12, solve_14, solve_16, solve_18, solve_20                                                         \
        }                                                                                                            \
    }

#if LANES == 8
const yardstick_code yardstick_avx512 = CODE("avx512");
#elif LANES == 4
const yardstick_code yardstick_avx2 = CODE("avx2");
#else
const yardstick_code yardstick_plain = CODE("plain");
#endif
